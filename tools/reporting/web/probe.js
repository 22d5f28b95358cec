// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers of the place that the reader has clicked.

import { has, valuesOf } from "plyform/fields.js";
import { written } from "plyform/numbers.js";

const mean = (x, ply, probe) => [0, 1, 2].map((c) => [0, 1, 2].reduce(
  (sum, k) => sum + probe.weights[k] * x[3 * ply.triangles[3 * probe.triangle + k] + c], 0));

/** Value of a field at a probe. */
export async function valueAt(ply, field, state, probe) {
  const { of, values } = await valuesOf(ply, field, state);
  if (of === "triangle") return values[probe.triangle];
  return probe.weights.reduce((sum, w, k) => sum + w * values[ply.triangles[3 * probe.triangle + k]], 0);
}

function row(table, name, value, unit, raw) {
  const line = table.insertRow();
  const head = document.createElement("th");
  head.scope = "row";
  head.textContent = name;
  line.append(head);
  const cell = line.insertCell();
  cell.textContent = `${value} ${unit}`;
  if (raw !== undefined) [line.dataset.field, line.dataset.value] = raw;
}

/** From one family of yarns to another before forming, degrees. */
function flatAngle({ direction: a }, { direction: b }) {
  return (Math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]) * 180) / Math.PI;
}

/** Fills the panel. `probe`: run, index of the ply, triangle, weights. */
export async function showProbe(panel, run, probe, state, fields) {
  const ply = run.plies[probe.index];
  const table = document.createElement("table");
  const flat = mean(ply.flat, ply, probe);
  const formed = mean(ply.places.state(state), ply, probe);
  const place = (x) => x.map((c) => written(c, 1)).join("  /  ");
  row(table, "In the flat blank, x / y", place(flat.slice(0, 2)), "mm");
  row(table, "In the part, x / y / z", place(formed), "mm");
  for (const field of fields) {
    if (!has(ply, field)) continue;
    const value = await valueAt(ply, field, state, probe);
    row(table, field.label, written(value, field.digits), field.unit, [field.id, value]);
    const [one, two] = ply.data.families;
    if (field.id === "shear-signed" && ply.data.woven && two) {
      row(table, `Angle between ${one.name} and ${two.name}`, written(flatAngle(one, two) - value, 1), "°");
    }
  }
  const head = document.createElement("h3");
  head.textContent = `${ply.name}, triangle ${probe.triangle}`;
  panel.replaceChildren(head, table);
  panel.dataset.triangle = probe.triangle;
  panel.dataset.ply = ply.name;
}
