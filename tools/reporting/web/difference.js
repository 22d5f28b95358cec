// SPDX-License-Identifier: GPL-3.0-or-later
// The difference of two runs on the material, as plyform difference has it
// (core/results/field_difference.cpp): values of triangles are evened out to nodes by area, and at each
// node of A's flat ply stands the value of B there less that of A; beyond B's border, of the nearest
// place of it. Values of single triangles scatter, and the largest of their differences says nothing.

const CELL = 64; // squares along a side of the grid that triangles are looked up in

const cornersOf = (ply, t) => [0, 1, 2].map((k) => {
  const node = 3 * ply.triangles[3 * t + k];
  return [ply.flat[node], ply.flat[node + 1]];
});

const cross = (u, v) => u[0] * v[1] - u[1] * v[0];
const less = (p, q) => [p[0] - q[0], p[1] - q[1]];

/** Means by area, at the nodes, of a value a triangle. */
export function nodalMeans(ply, values) {
  const sums = new Float64Array(ply.flat.length / 3);
  const areas = new Float64Array(sums.length);
  for (let t = 0; t < values.length; ++t) {
    const [a, b, c] = cornersOf(ply, t);
    const area = Math.abs(cross(less(b, a), less(c, a)));
    for (let k = 0; k < 3; ++k) {
      sums[ply.triangles[3 * t + k]] += area * values[t];
      areas[ply.triangles[3 * t + k]] += area;
    }
  }
  return sums.map((sum, i) => (areas[i] > 0 ? sum / areas[i] : 0));
}

/** The squares of a grid over a ply, with the triangles whose boxes touch them. */
function gridOf(ply) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (let i = 0; i < ply.flat.length; i += 3) {
    for (let k = 0; k < 2; ++k) {
      box[k] = Math.min(box[k], ply.flat[i + k]);
      box[2 + k] = Math.max(box[2 + k], ply.flat[i + k]);
    }
  }
  const square = (value, k) => Math.max(0, Math.min(CELL - 1,
    Math.floor(((value - box[k]) / (box[2 + k] - box[k] || 1)) * CELL)));
  const grid = new Map();
  for (let t = 0; t < ply.triangles.length / 3; ++t) {
    const corners = cornersOf(ply, t);
    const at = [0, 1].map((k) => corners.map((corner) => square(corner[k], k)));
    for (let i = Math.min(...at[0]); i <= Math.max(...at[0]); ++i) {
      for (let j = Math.min(...at[1]); j <= Math.max(...at[1]); ++j) {
        const key = i * CELL + j;
        if (!grid.has(key)) grid.set(key, []);
        grid.get(key).push(t);
      }
    }
  }
  return (p) => grid.get(square(p[0], 0) * CELL + square(p[1], 1)) || [];
}

/** Shares of the corners in a point: all at least 0 inside. */
function sharesOf([a, b, c], p) {
  const whole = cross(less(b, a), less(c, a));
  const [one, two] = [cross(less(p, a), less(c, a)) / whole, cross(less(b, a), less(p, a)) / whole];
  return [1 - one - two, one, two];
}

function nearestOnSide(a, b, p) {
  const side = less(b, a);
  const long = side[0] * side[0] + side[1] * side[1];
  const from = less(p, a);
  const share = Math.max(0, Math.min(1, (side[0] * from[0] + side[1] * from[1]) / long));
  return [a[0] + share * side[0], a[1] + share * side[1]];
}

/** Over all triangles: few points are outside, those between a coarse mesh and a round outline. */
function nearestOf(p, ply) {
  let best = { far: Infinity };
  for (let t = 0; t < ply.triangles.length / 3; ++t) {
    const corners = cornersOf(ply, t);
    for (let k = 0; k < 3; ++k) {
      const place = nearestOnSide(corners[k], corners[(k + 1) % 3], p);
      const far = Math.hypot(...less(p, place));
      if (far < best.far) best = { far, triangle: t, weights: sharesOf(corners, place) };
    }
  }
  return best;
}

function holderOf(p, ply, triangles) {
  for (const t of triangles) {
    const weights = sharesOf(cornersOf(ply, t), p);
    if (Math.min(...weights) > -1e-4) return { triangle: t, weights };
  }
  return nearestOf(p, ply);
}

/** For each node of A: the triangle of B that holds it, and the shares of its corners. */
function matched(a, b) {
  const near = gridOf(b);
  const found = [];
  for (let i = 0; i < a.flat.length; i += 3) {
    const p = [a.flat[i], a.flat[i + 1]];
    found.push(holderOf(p, b, near(p)));
  }
  return found;
}

export class Difference {
  constructor(a, b) {
    this.pairs = a.plies.map((ply, i) =>
      [ply, b.plies.find((other) => other.name === ply.name) || b.plies[i] || null]);
    this.matches = new Map();
  }

  /** B less A of ply i of A at its nodes, from values at the nodes of both; 0 without such a ply. */
  values(i, ofA, ofB) {
    const [a, b] = this.pairs[i];
    const values = new Float32Array(a.flat.length / 3);
    if (!b) return { of: "node", values };
    if (!this.matches.has(i)) this.matches.set(i, matched(a, b));
    this.matches.get(i).forEach(({ triangle, weights }, node) => {
      const there = weights.reduce((sum, w, k) => sum + w * ofB[b.triangles[3 * triangle + k]], 0);
      values[node] = there - ofA[node];
    });
    return { of: "node", values };
  }
}
