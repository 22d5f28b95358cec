// SPDX-License-Identifier: GPL-3.0-or-later
// What plies are coloured by: the columns that results.h5 describes, and what follows from them.
//
// of: from the values of the columns of a ply to the value shown; digits: decimals in numbers; signed:
// a scale with zero in its middle.

import { nodalMeans } from "plyform/difference.js";

const largest = (values) => Math.max(...values);
const first = ([value]) => value;

/** Fields of the families' columns of one quantity, taken together. */
const TOGETHER = {
  strain: [
    { id: "pressed", label: "Pressed strain", yarns: true, of: (strains) => Math.max(0, -Math.min(...strains)),
      note: "by how much the most pressed family of yarns is shorter" },
    { id: "tensile", label: "Tensile strain", of: (strains) => Math.max(0, ...strains),
      note: "by how much the most stretched family of yarns is longer" }],
  tension: [{ id: "tension", label: "Tension", of: largest, note: "the largest of all families" }],
};

const GAP = { id: "gap", label: "Gap to the nearest tool", unit: "mm", digits: 2, computed: "gap",
  note: "from the face of the ply; of inner plies, other plies included; 30 mm and more are alike" };

/** The fields that a column is shown as. */
function fieldsOfColumn(column) {
  const field = { ...column, id: column.word, names: () => [column.name], of: first,
    signed: column.scale === "both ways" };
  if (column.scale !== "magnitude") return [field];
  return [
    { ...field, of: ([value]) => Math.abs(value), note: "magnitude, without the sign" },
    { ...field, id: `${column.word}-signed`, label: `${column.label}, signed`, signed: true }];
}

/** All fields of a page. columns: as its data describe them. */
export function fieldsOf(columns) {
  const fields = [];
  const seen = new Set();
  const sorted = [...columns].sort((a, b) => (a.place === "node") - (b.place === "node"));
  for (const column of sorted) {
    if (!seen.has(column.quantity)) {
      seen.add(column.quantity);
      const same = sorted.filter((other) => other.quantity === column.quantity).map((other) => other.name);
      for (const field of TOGETHER[column.quantity] || []) {
        const names = (ply) => same.filter((name) => name in ply.data.cells);
        fields.push({ ...column, signed: false, ...field, names });
      }
    }
    fields.push(...fieldsOfColumn(column));
  }
  return [...fields, GAP];
}

/** Whether a ply has what a field needs. */
export function has(ply, field) {
  if (field.computed) return ply.run.tools.length > 0;
  if (field.yarns && !ply.data.woven) return false;
  const names = field.names(ply);
  return names.length > 0 && names.every((name) => name in ply.data.cells || name in ply.data.nodes);
}

/** Values of the columns of a field in a state, an array each. */
async function columnsOf(ply, field, state) {
  const blocks = await Promise.all(field.names(ply).map((name) => ply.block(name)));
  return blocks.map((block) => block.state(state));
}

function combined(field, arrays) {
  return arrays[0].map((_, i) => field.factor * field.of(arrays.map((values) => values[i])));
}

/** Values of a field at the nodes of a ply: what it is made of is evened out first. */
export async function nodalValuesOf(ply, field, state) {
  if (field.computed || field.place === "node") return (await valuesOf(ply, field, state)).values;
  const arrays = await columnsOf(ply, field, state);
  return combined(field, arrays.map((values) => nodalMeans(ply, values)));
}

/** Values of a field in a state, and whether they are of triangles or nodes. */
export async function valuesOf(ply, field, state) {
  if (field.computed) return { of: "node", values: ply.computed(field.computed, state).slice() };
  return { of: field.place, values: combined(field, await columnsOf(ply, field, state)) };
}
