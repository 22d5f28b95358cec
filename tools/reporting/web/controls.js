// SPDX-License-Identifier: GPL-3.0-or-later
// Buttons, sliders and boxes of the page, and the film.

import { STANDARD_VIEWS } from "plyform/camera.js";
import { SCALE_NAMES } from "plyform/colours.js";

const at = (id) => document.getElementById(id);
const numberOf = (input) => (input.value.trim() === "" || !Number.isFinite(input.valueAsNumber)
  ? null : input.valueAsNumber);

function option(select, value, text) {
  const made = document.createElement("option");
  made.value = value;
  made.textContent = text;
  select.append(made);
}

function plyBoxes(report) {
  const place = at("plies");
  const names = [...new Set(report.runs.flatMap((run) => run.plies.map((ply) => ply.name)))];
  for (const name of names.reverse()) { // the uppermost first, as they lie
    const label = document.createElement("label");
    const box = document.createElement("input");
    box.type = "checkbox";
    box.checked = true;
    box.dataset.ply = name;
    label.append(box, ` ${name}`);
    place.append(label);
    box.addEventListener("change", () => {
      const hidden = new Set(report.settings.hidden);
      if (box.checked) hidden.delete(name);
      else hidden.add(name);
      report.change({ hidden });
    });
  }
  report.runs[0].plies.forEach((ply, i) => option(at("flat-ply"), i, ply.name));
  at("flat-ply").addEventListener("change", (event) => report.change({ flatPly: Number(event.target.value) }));
}

function scaleControls(report) {
  for (const field of report.fields()) option(at("field"), field.id, `${field.label}, ${field.unit}`);
  for (const name of SCALE_NAMES) if (name !== "diverging") option(at("colours"), name, name);
  at("field").addEventListener("change", (event) => report.change({ field: event.target.value }));
  at("colours").addEventListener("change", (event) => report.change({ colours: event.target.value }));
  at("steps").addEventListener("change", (event) => report.change({ steps: Number(event.target.value) }));
  for (const key of ["low", "high", "limit"]) {
    at(key).addEventListener("change", (event) => report.change({ [key]: numberOf(event.target) }));
  }
  at("auto").addEventListener("click", () => report.change({ low: null, high: null }));
}

function viewControls(report) {
  const { camera } = report.stage;
  for (const name of Object.keys(STANDARD_VIEWS)) at(`view-${name}`).addEventListener("click", () => camera.set(name));
  at("view-home").addEventListener("click", () => camera.home());
  for (const key of ["apart", "yarns"]) {
    at(key).addEventListener("input", (event) => report.change({ [key]: Number(event.target.value) }));
  }
  at("tools").addEventListener("change", (event) => report.change({ tools: event.target.value }));
  const section = (patch) => report.change({ section: { ...report.settings.section, ...patch } });
  at("section-way").addEventListener("change", (event) => {
    const way = event.target.value;
    section({ on: way !== "off", level: way === "level", angle: way === "x" ? 0 : way === "y" ? 90
      : report.settings.section.angle });
  });
  at("section-offset").addEventListener("input", (event) => section({ offset: event.target.valueAsNumber }));
  at("section-angle").addEventListener("input", (event) => section({ angle: event.target.valueAsNumber }));
  const half = report.box.getSize(report.box.max.clone()).length() / 2;
  Object.assign(at("section-offset"), { min: -half, max: half, step: half / 200, value: 0 });
  if (at("difference")) {
    at("difference").addEventListener("change", (event) => report.change({ difference: event.target.checked }));
  }
  if (at("difference-of")) {
    at("difference-of").addEventListener("change", (event) =>
      report.change({ difference: true, differenceOf: Number(event.target.value) }));
  }
}

/** Plays the states, one after the other, as long as it takes to draw each. */
function film(report) {
  const button = at("film");
  let playing = false;
  const last = report.runs[0].reached.length - 1;
  const next = async () => {
    if (!playing) return;
    const { state } = report.settings;
    await report.change({ state: state >= last ? 0 : state + 1 });
    setTimeout(() => requestAnimationFrame(next), report.settings.state === last ? 900 : 90);
  };
  button.addEventListener("click", () => {
    playing = !playing;
    button.setAttribute("aria-pressed", String(playing));
    button.textContent = playing ? "Stop" : "Film";
    next();
  });
  button.disabled = last === 0;
}

function stroke(report) {
  const slider = at("stroke");
  slider.max = report.runs[0].reached.length - 1;
  slider.value = slider.max;
  slider.addEventListener("input", () => report.change({ state: Number(slider.value) }));
}

/** Keys that work anywhere but in a box that takes text. */
function keys(report) {
  const views = { 1: "oblique", 2: "top", 3: "front", 4: "side", 5: "bottom" };
  document.addEventListener("keydown", (event) => {
    if (/^(INPUT|SELECT)$/.test(event.target.tagName) || event.ctrlKey || event.metaKey || event.altKey) return;
    const step = { ",": -1, ".": 1 }[event.key];
    if (views[event.key]) report.stage.camera.set(views[event.key]);
    else if (event.key === "0") report.stage.camera.home();
    else if (step) {
      const last = report.runs[0].reached.length - 1;
      report.change({ state: Math.max(0, Math.min(last, report.settings.state + step)) });
    } else if (event.key === "t") {
      const ways = ["outlines", "solid", "hidden"];
      report.change({ tools: ways[(ways.indexOf(report.settings.tools) + 1) % 3] });
    }
  });
}

/** Shows a place that a text speaks of, coloured by what the text is about. */
export function showPlace(report, { ply, triangle, run, field }) {
  if (field) report.change({ field });
  report.point(Number(ply), Number(triangle), Number(run));
  at("part").scrollIntoView({ behavior: "smooth", block: "start" });
}

export function connect(report) {
  plyBoxes(report);
  scaleControls(report);
  viewControls(report);
  stroke(report);
  film(report);
  keys(report);
  for (const button of document.querySelectorAll("button.place")) {
    button.addEventListener("click", () => showPlace(report, button.dataset));
  }
}
