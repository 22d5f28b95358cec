// SPDX-License-Identifier: GPL-3.0-or-later
// A ply of a run: its stored arrays, and what follows from them.

import { loadBlock } from "plyform/decode.js";

/** Nodes of the edges that one triangle has, in pairs. */
export function borderEdges(triangles) {
  const count = new Map();
  const number = 4294967296;
  for (let i = 0; i < triangles.length; i += 3) {
    for (let k = 0; k < 3; ++k) {
      const a = triangles[i + k];
      const b = triangles[i + ((k + 1) % 3)];
      const key = Math.min(a, b) * number + Math.max(a, b);
      count.set(key, (count.get(key) || 0) + 1);
    }
  }
  const edges = [];
  for (const [key, times] of count) {
    if (times === 1) edges.push(Math.floor(key / number), key % number);
  }
  return edges;
}

export const MOST_FAMILIES = 4; // of yarns that are drawn
const NO_YARN = 1e9; // mm, where there is no such family: as shaders.js has it

/** Of each node of the flat ply, mm: its distance from the line through the origin along the yarns of
 * each family. */
function yarnPlaces(flat, families) {
  const places = new Float32Array((flat.length / 3) * MOST_FAMILIES).fill(NO_YARN);
  families.slice(0, MOST_FAMILIES).forEach(({ direction: [u, v] }, k) => {
    for (let i = 0; 3 * i < flat.length; ++i) {
      places[MOST_FAMILIES * i + k] = u * flat[3 * i + 1] - v * flat[3 * i];
    }
  });
  return places;
}

export class Ply {
  constructor(run, data) {
    this.run = run;
    this.data = data;
    this.name = data.name;
    this.blocks = new Map();
    this.computedOfState = new Map();
  }

  /** Geometry, needed for the first picture. */
  async load() {
    const [flat, triangles, places] = await Promise.all(
      [this.data.x0, this.data.triangles, this.data.x].map(loadBlock));
    this.places = places;
    this.lay(flat.state(0), triangles.integers());
  }

  /** As it lies before forming, and what follows from that. */
  lay(flat, triangles) {
    this.flat = flat;
    this.triangles = triangles;
    this.border = borderEdges(triangles);
    this.yarns = yarnPlaces(flat, this.data.families);
  }

  /** A stored array by its name in results.h5, decoded once. */
  block(name) {
    if (!this.blocks.has(name)) {
      this.blocks.set(name, loadBlock(this.data.cells[name] || this.data.nodes[name]));
    }
    return this.blocks.get(name);
  }

  /** A field of nodes that is not stored, in a state, computed once: the gap. */
  computed(what, state) {
    const key = `${what} ${state}`;
    if (!this.computedOfState.has(key)) this.computedOfState.set(key, this[what](state));
    return this.computedOfState.get(key);
  }

  /** Gap of each node to the nearest tool. */
  gap(state) {
    const values = new Float32Array(this.flat.length / 3).fill(30);
    const x = this.places.state(state);
    for (const tool of this.run.tools) tool.nearest(x, tool.data.shift[state], values);
    const half = 0.5 * this.data.thickness;
    return values.map((distance) => distance - half);
  }
}
