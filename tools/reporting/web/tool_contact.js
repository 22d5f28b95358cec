// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a ply lies on the tool that forms it, in words: of each tool that is driven, the ply next to
// it, how much of what faces it is on it, and where it is furthest off.

import { nodeNormals } from "plyform/ply_mesh.js";
import { written } from "plyform/numbers.js";

const ON = 0.5;       // mm: nearer is on the tool
const FACING = 0.9;   // cosine between the normal of the ply and the way to the tool
const REACH = 0.15;   // of the tool's size: further is not faced

/** Nodes of a ply that face a tool, with their gaps. */
function faced(ply, tool, state) {
  const x = ply.places.state(state);
  const normals = nodeNormals(x, ply.triangles);
  const shift = tool.data.shift[state];
  const nodes = [];
  for (let i = 0; 3 * i < x.length; ++i) {
    const away = tool.away(x[3 * i] - shift[0], x[3 * i + 1] - shift[1], x[3 * i + 2] - shift[2], REACH * tool.size);
    if (!away) continue;
    const cosine = away.along.reduce((sum, c, k) => sum + c * normals[3 * i + k], 0);
    if (away.distance > 1e-6 && Math.abs(cosine) < FACING) continue;
    nodes.push({ node: i, gap: away.distance - 0.5 * ply.data.thickness });
  }
  return nodes;
}

/** Of a run's last state: a line for each driven tool. */
export function liesOnTools(run) {
  const last = run.reached.length - 1;
  const lines = [];
  for (const tool of run.tools.filter((one) => one.data.driven)) {
    const all = [0, run.plies.length - 1].map((i) => ({ i, nodes: faced(run.plies[i], tool, last) }));
    const least = ({ nodes }) => nodes.reduce((low, { gap }) => Math.min(low, gap), Infinity);
    const { i, nodes } = least(all[0]) < least(all[1]) ? all[0] : all[1];
    if (!nodes.length) continue;
    const worst = nodes.reduce((most, one) => (one.gap > most.gap ? one : most));
    const on = nodes.filter(({ gap }) => gap < ON).length / nodes.length;
    lines.push({ tool, ply: i, on, gap: worst.gap, node: worst.node });
  }
  return lines;
}

/** Fills the card of a run, or leaves it hidden where no tool is driven. */
export function showContact(card, run, show) {
  const lines = liesOnTools(run);
  if (!lines.length) return;
  const [line] = lines;
  const ply = run.plies[line.ply];
  const x = ply.places.state(run.reached.length - 1).subarray(3 * line.node, 3 * line.node + 3);
  const place = ["x", "y", "z"].map((name, k) => `${name} ${written(x[k], 0)}`).join(", ");
  card.querySelector("h2").textContent = `On the tool: ${line.tool.name}`;
  card.querySelector(".figure").textContent = `${written(100 * line.on, 0)} %`;
  card.querySelector(".text").textContent = `of the part of ${ply.name} that faces it lies on it, ` +
    `within ${written(ON, 1)} mm. Furthest off: ${written(line.gap, 1)} mm at ${place} mm. ` +
    "Shown is the gap to the nearest tool.";
  const triangle = Math.floor(ply.triangles.indexOf(line.node) / 3);
  card.querySelector("button").addEventListener("click", () => show(line.ply, triangle));
  Object.assign(card.dataset, { gap: line.gap, ply: ply.name });
  card.hidden = false;
}
