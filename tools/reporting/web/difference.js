// SPDX-License-Identifier: GPL-3.0-or-later
// The difference of two runs on the material: the value of B less that of A at the same place of the
// flat ply, at the middles of A's triangles.

const CELL = 64; // squares along a side of the grid that triangles are looked up in

/** For each triangle of A: the triangle of B that holds its middle, and the weights; -1: none. */
function matched(a, b) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (let i = 0; i < b.flat.length; i += 3) {
    for (let k = 0; k < 2; ++k) {
      box[k] = Math.min(box[k], b.flat[i + k]);
      box[2 + k] = Math.max(box[2 + k], b.flat[i + k]);
    }
  }
  const square = (value, k) => Math.max(0, Math.min(CELL - 1,
    Math.floor(((value - box[k]) / (box[2 + k] - box[k] || 1)) * CELL)));
  const grid = new Map();
  for (let t = 0; t < b.triangles.length / 3; ++t) {
    const at = [0, 1].map((k) => [0, 1, 2].map((c) => square(b.flat[3 * b.triangles[3 * t + c] + k], k)));
    for (let i = Math.min(...at[0]); i <= Math.max(...at[0]); ++i) {
      for (let j = Math.min(...at[1]); j <= Math.max(...at[1]); ++j) {
        const key = i * CELL + j;
        if (!grid.has(key)) grid.set(key, []);
        grid.get(key).push(t);
      }
    }
  }
  const found = [];
  for (let t = 0; t < a.triangles.length / 3; ++t) {
    const p = [0, 1].map((k) => [0, 1, 2].reduce((sum, c) => sum + a.flat[3 * a.triangles[3 * t + c] + k] / 3, 0));
    const near = grid.get(square(p[0], 0) * CELL + square(p[1], 1)) || [];
    found.push(holderOf(p, b, near));
  }
  return found;
}

function holderOf(p, ply, triangles) {
  for (const t of triangles) {
    const [a, b, c] = [0, 1, 2].map((k) => {
      const node = 3 * ply.triangles[3 * t + k];
      return [ply.flat[node] - p[0], ply.flat[node + 1] - p[1]];
    });
    const area = (u, v) => u[0] * v[1] - u[1] * v[0];
    const parts = [area(b, c), area(c, a), area(a, b)];
    const whole = parts[0] + parts[1] + parts[2];
    const weights = parts.map((part) => part / whole);
    if (Math.min(...weights) > -1e-4) return { triangle: t, weights };
  }
  return { triangle: -1, weights: [0, 0, 0] };
}

const atPlace = ({ of, values }, ply, { triangle, weights }) => {
  if (of === "triangle") return values[triangle];
  return weights.reduce((sum, w, k) => sum + w * values[ply.triangles[3 * triangle + k]], 0);
};

const THIRD = [1 / 3, 1 / 3, 1 / 3];

export class Difference {
  constructor(a, b) {
    this.pairs = a.plies.map((ply, i) =>
      [ply, b.plies.find((other) => other.name === ply.name) || b.plies[i] || null]);
    this.matches = new Map();
  }

  /** B less A of ply i of A, a value a triangle of A; 0 where B has no material. */
  values(i, ofA, ofB) {
    const [a, b] = this.pairs[i];
    const count = a.triangles.length / 3;
    const values = new Float32Array(count);
    if (!b) return { of: "triangle", values };
    if (!this.matches.has(i)) this.matches.set(i, matched(a, b));
    const match = this.matches.get(i);
    for (let t = 0; t < count; ++t) {
      if (match[t].triangle < 0) continue;
      values[t] = atPlace(ofB, b, match[t]) - atPlace(ofA, a, { triangle: t, weights: THIRD });
    }
    return { of: "triangle", values };
  }
}
