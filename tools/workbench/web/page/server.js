// SPDX-License-Identifier: GPL-3.0-or-later
// Asking the server, and hearing what happens. All addresses are relative: the token is in the path.

const listeners = new Map(); // functions by kind of event

/** Calls `act` with every event of a kind; returns what ends it. */
export function listen(kind, act) {
  if (!listeners.has(kind)) listeners.set(kind, new Set());
  listeners.get(kind).add(act);
  return () => listeners.get(kind).delete(act);
}

function happened(event) {
  for (const act of listeners.get(event.kind) || []) act(event);
}

/** Keeps a WebSocket open; {kind: "again"} says that events may have been missed. */
export function connect() {
  const place = document.getElementById("connection");
  const address = new URL("./events", location.href);
  address.protocol = "ws:";
  address.hash = "";
  const socket = new WebSocket(address);
  socket.addEventListener("open", () => {
    place.textContent = "";
    document.body.classList.remove("alone");
    happened({ kind: "again" });
  });
  socket.addEventListener("message", (message) => {
    const event = JSON.parse(message.data);
    happened(event.kind === "lost" ? { kind: "again" } : event);
  });
  socket.addEventListener("close", () => {
    place.textContent = "The server does not answer: start plyform studio again";
    document.body.classList.add("alone");
    setTimeout(connect, 1000);
  });
}

function withQuery(path, query) {
  const words = new URLSearchParams(query).toString();
  return `./api/${path}${words ? `?${words}` : ""}`;
}

async function checked(response) {
  if (response.ok) return response;
  let words = `${response.status} ${response.statusText}`;
  let said = {};
  try {
    said = await response.json();
    words = said.error || JSON.stringify(said.detail) || words;
  } catch (ignored) { /* no JSON */ }
  const problem = new Error(words);
  problem.code = response.status;
  problem.said = said;
  throw problem;
}

/** The answer of GET api/PATH as JSON. */
export async function ask(path, query = {}) {
  return (await checked(await fetch(withQuery(path, query)))).json();
}

/** Likewise as bytes. */
export async function askBytes(path, query = {}) {
  return (await checked(await fetch(withQuery(path, query)))).arrayBuffer();
}

/** Sends JSON by POST, or another method. */
export async function send(path, body = {}, { query = {}, method = "POST" } = {}) {
  return (await checked(await fetch(withQuery(path, query), {
    method, headers: { "Content-Type": "application/json" }, body: JSON.stringify(body),
  }))).json();
}

/** Sends a file as it is. */
export async function upload(query, file) {
  return (await checked(await fetch(withQuery("upload", query), { method: "POST", body: file }))).json();
}
