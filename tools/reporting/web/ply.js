// SPDX-License-Identifier: GPL-3.0-or-later
// A ply of a run: its stored arrays, and what follows from them.

import { loadBlock } from "plyform/decode.js";
import { Wrinkles } from "plyform/wrinkles.js";

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

/** Of each node of the flat ply, mm: place along weft and along warp, in directions of the yarns. */
function yarnPlaces(flat, warp, weft) {
  const across = warp[0] * weft[1] - warp[1] * weft[0];
  const sine = Math.abs(across) > 1e-6 ? across : 1;
  const places = new Float32Array((flat.length / 3) * 2);
  for (let i = 0; 3 * i < flat.length; ++i) {
    const [x, y] = [flat[3 * i], flat[3 * i + 1]];
    // distances from the lines through the origin along warp and along weft
    places[2 * i] = (warp[0] * y - warp[1] * x) * Math.sign(sine);
    places[2 * i + 1] = (x * weft[1] - y * weft[0]) * Math.sign(sine);
  }
  return places;
}

export class Ply {
  constructor(run, told) {
    this.run = run;
    this.told = told;
    this.name = told.name;
    this.blocks = new Map();
    this.computedOfState = new Map();
  }

  /** Geometry, needed for the first picture. */
  async load() {
    const [flat, triangles, places] = await Promise.all(
      [this.told.x0, this.told.triangles, this.told.x].map(loadBlock));
    this.flat = flat.state(0);
    this.triangles = triangles.integers();
    this.places = places;
    this.border = borderEdges(this.triangles);
    this.yarns = yarnPlaces(this.flat, this.told.warp, this.told.weft);
  }

  /** A stored array by its name in results.h5, decoded once. */
  block(name) {
    if (!this.blocks.has(name)) {
      this.blocks.set(name, loadBlock(this.told.cells[name] || this.told.nodes[name]));
    }
    return this.blocks.get(name);
  }

  /** A field of nodes that is not stored, in a state, computed once: gap or wrinkles. */
  computed(what, state) {
    const key = `${what} ${state}`;
    if (!this.computedOfState.has(key)) this.computedOfState.set(key, this[what](state));
    return this.computedOfState.get(key);
  }

  /** Gap of each node to the nearest tool. */
  gap(state) {
    const values = new Float32Array(this.flat.length / 3).fill(30);
    const x = this.places.state(state);
    for (const tool of this.run.tools) tool.nearest(x, tool.told.shift[state], values);
    const half = 0.5 * this.told.thickness;
    return values.map((distance) => distance - half);
  }

  wrinkles(state) {
    if (!this.searcher) this.searcher = new Wrinkles(this);
    return this.searcher.heights(state);
  }
}
