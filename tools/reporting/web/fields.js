// SPDX-License-Identifier: GPL-3.0-or-later
// What plies are coloured by, and how it follows from what results.h5 holds.
//
// needs: names of stored arrays, a value a triangle (cells) or a node (nodes); of: from these to the
// value shown; digits: decimals in numbers; signed: a scale with zero in its middle.

import { nodalMeans } from "plyform/difference.js";

const largest = (a, b) => Math.max(a, b);

export const FIELDS = [
  { id: "shear", label: "Shear angle", unit: "°", digits: 2, cells: ["shear_angle_deg"],
    of: (shear) => Math.abs(shear), note: "magnitude of the change of the angle between warp and weft" },
  { id: "shear-signed", label: "Shear angle, signed", unit: "°", digits: 2, signed: true,
    cells: ["shear_angle_deg"], of: (shear) => shear, note: "negative: the angle opens" },
  { id: "pressed", label: "Pressed strain", unit: "%", digits: 3, yarns: true,
    cells: ["warp_strain", "weft_strain"], of: (warp, weft) => 100 * largest(0, -Math.min(warp, weft)),
    note: "by how much the more pressed yarn, warp or weft, is shorter" },
  { id: "tensile", label: "Tensile strain", unit: "%", digits: 3,
    cells: ["warp_strain", "weft_strain"], of: (warp, weft) => 100 * largest(0, largest(warp, weft)),
    note: "by how much the more stretched yarn is longer" },
  { id: "warp-strain", label: "Warp strain", unit: "%", digits: 3, signed: true,
    cells: ["warp_strain"], of: (warp) => 100 * warp, note: "negative: shorter" },
  { id: "weft-strain", label: "Weft strain", unit: "%", digits: 3, signed: true,
    cells: ["weft_strain"], of: (weft) => 100 * weft, note: "negative: shorter" },
  { id: "tension", label: "Tension", unit: "N per yarn", digits: 3,
    cells: ["warp_tension_N", "weft_tension_N"], of: largest, note: "the larger of warp and weft" },
  { id: "warp-tension", label: "Warp tension", unit: "N per yarn", digits: 3, signed: true,
    cells: ["warp_tension_N"], of: (warp) => warp, note: "negative: compression" },
  { id: "weft-tension", label: "Weft tension", unit: "N per yarn", digits: 3, signed: true,
    cells: ["weft_tension_N"], of: (weft) => weft, note: "negative: compression" },
  { id: "wrinkle", label: "Wrinkle height", unit: "mm", digits: 2, computed: "wrinkles",
    note: "from valley to crest, of the waves that the mesh shows and no tool has; under 0.3 mm as 0" },
  { id: "gap", label: "Gap to the nearest tool", unit: "mm", digits: 2, computed: "gap",
    note: "from the face of the ply; of inner plies, other plies included; 30 mm and more are alike" },
  { id: "pressure", label: "Contact pressure", unit: "N/mm²", digits: 4,
    nodes: ["contact_pressure"], of: (pressure) => pressure,
    note: "normal force of all contacts over the node's area" },
  { id: "thickness", label: "Thickness", unit: "mm", digits: 3, cells: ["thickness_mm"],
    of: (thickness) => thickness, note: "from constant volume" },
];

export const fieldCalled = (id) => FIELDS.find((field) => field.id === id);

/** Whether a ply has what a field needs. */
export function has(ply, field) {
  if (field.computed === "gap") return ply.run.tools.length > 0;
  if (field.computed) return true;
  if (field.yarns && !ply.told.woven) return false;
  return (field.cells || []).every((name) => name in ply.told.cells) &&
    (field.nodes || []).every((name) => name in ply.told.nodes);
}

/** Values of a field at the nodes of a ply: what it is made of is evened out first. */
export async function nodalValuesOf(ply, field, state) {
  if (!field.cells) return (await valuesOf(ply, field, state)).values;
  const blocks = await Promise.all(field.cells.map((name) => ply.block(name)));
  const arrays = blocks.map((block) => nodalMeans(ply, block.state(state)));
  const [values, other = values] = arrays;
  return values.map((value, i) => field.of(value, other[i]));
}

/** Values of a field in a state, and whether they are of triangles or nodes. */
export async function valuesOf(ply, field, state) {
  if (field.computed) return { of: "node", values: ply.computed(field.computed, state).slice() };
  const cells = Boolean(field.cells);
  const blocks = await Promise.all((field.cells || field.nodes).map((name) => ply.block(name)));
  const arrays = blocks.map((block) => block.state(state));
  const [values, other = values] = arrays;
  for (let i = 0; i < values.length; ++i) values[i] = field.of(values[i], other[i]);
  return { of: cells ? "triangle" : "node", values };
}
