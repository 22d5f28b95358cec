// SPDX-License-Identifier: GPL-3.0-or-later
// Height of wrinkles over a ply: the measure of core/results/wrinkles.hpp, whose largest is in
// summary.json, at every place in the place of the largest. Where a line of five points of the flat
// ply, half a wave apart, goes up and down in turn, the least of its three heights over the chords
// counts, and no wave counts that a tool close by has itself, nor the share that tools have of a wave
// between them that is not closed yet.

import { nodeNormals } from "plyform/ply_mesh.js";

const LEAST = 0.3; // mm: lower waves are of the mesh, on fillets
const FACING = Math.SQRT1_2;
const GROWTH = 1.2;
const NEAR_WAVES = 2; // half waves: tools nearer than that may have a wave's shape
const CLOSE = 1; // sides of triangles: a ply is through a tool by less

function meanSide({ flat, triangles }) {
  let sum = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    for (let k = 0; k < 3; ++k) {
      const [a, b] = [3 * triangles[t + k], 3 * triangles[t + ((k + 1) % 3)]];
      sum += Math.hypot(flat[a] - flat[b], flat[a + 1] - flat[b + 1], flat[a + 2] - flat[b + 2]);
    }
  }
  return sum / triangles.length;
}

/** How far a tool's surface lies from p along d, from `behind` before p to `most`; else Infinity. */
function wayTo(tool, p, d, behind, most) {
  const near = 1e-3 * most;
  let gone = -behind;
  for (let i = 0; i < 200 && gone < most; ++i) {
    const told = tool.away(...p.map((c, k) => c + gone * d[k]), most);
    if (told && told.distance <= near) return gone;
    gone += told ? told.distance : most;
  }
  return gone < most ? gone : Infinity;
}

const heightOf = (before, here, after) => (before * here >= 0 || after * here >= 0 ? 0
  : Math.min(Math.abs(here), 2 * Math.abs(before), 2 * Math.abs(after)));

export class Wrinkles {
  /** A square grid over the flat ply, its rows along warp. */
  constructor(ply) {
    this.ply = ply;
    this.side = meanSide(ply);
    this.step = 0.5 * this.side;
    const [cos, sin] = ply.told.warp;
    const count = ply.flat.length / 3;
    this.flat = [new Float64Array(count), new Float64Array(count)];
    for (let i = 0; i < count; ++i) {
      const [x, y] = [ply.flat[3 * i], ply.flat[3 * i + 1]];
      this.flat[0][i] = cos * x + sin * y;
      this.flat[1][i] = cos * y - sin * x;
    }
    const range = this.flat.map((values) => values.reduce(([low, high], v) =>
      [Math.min(low, v), Math.max(high, v)], [Infinity, -Infinity]));
    this.size = range.map(([low, high]) => Math.floor((high - low) / this.step) + 1);
    this.low = range.map(([low, high], k) => low + 0.5 * (high - low - this.step * (this.size[k] - 1)));
    this.owner = new Int32Array(this.size[0] * this.size[1]).fill(-1);
    this.weights = new Float64Array(3 * this.owner.length);
    for (let t = 0; t < ply.triangles.length; t += 3) this.fill(t);
  }

  /** Notes which points of the grid lie in a triangle. */
  fill(t) {
    const [u, v] = this.flat;
    const [a, b, c] = [0, 1, 2].map((k) => this.ply.triangles[t + k]);
    const whole = (u[b] - u[a]) * (v[c] - v[a]) - (v[b] - v[a]) * (u[c] - u[a]);
    const ends = [0, 1].map((k) => [a, b, c].map((node) => (this.flat[k][node] - this.low[k]) / this.step));
    const from = ends.map((e) => Math.max(0, Math.ceil(Math.min(...e))));
    const to = ends.map((e, k) => Math.min(this.size[k] - 1, Math.floor(Math.max(...e))));
    for (let j = from[1]; j <= to[1]; ++j) {
      for (let i = from[0]; i <= to[0]; ++i) {
        const [p, q] = [this.low[0] + this.step * i - u[a], this.low[1] + this.step * j - v[a]];
        const wb = (p * (v[c] - v[a]) - q * (u[c] - u[a])) / whole;
        const wc = ((u[b] - u[a]) * q - (v[b] - v[a]) * p) / whole;
        if (Math.min(wb, wc, 1 - wb - wc) < -1e-6) continue;
        this.owner[j * this.size[0] + i] = t;
        this.weights.set([1 - wb - wc, wb, wc], 3 * (j * this.size[0] + i));
      }
    }
  }

  /** Points and normals of the smooth surface at the grid; NaN where there is no ply. */
  places(x) {
    const normals = nodeNormals(x, this.ply.triangles);
    const [points, facing] = [0, 1].map(() => new Float64Array(3 * this.owner.length).fill(NaN));
    const p = [0, 0, 0];
    for (let g = 0; g < this.owner.length; ++g) {
      const t = this.owner[g];
      if (t < 0) continue;
      const nodes = [0, 1, 2].map((k) => 3 * this.ply.triangles[t + k]);
      const w = [0, 1, 2].map((k) => this.weights[3 * g + k]);
      for (let c = 0; c < 3; ++c) p[c] = w[0] * x[nodes[0] + c] + w[1] * x[nodes[1] + c] + w[2] * x[nodes[2] + c];
      const [q, n] = [[0, 0, 0], [0, 0, 0]];
      nodes.forEach((node, k) => {
        let off = 0;
        for (let c = 0; c < 3; ++c) off += normals[node + c] * (p[c] - x[node + c]);
        for (let c = 0; c < 3; ++c) {
          q[c] += w[k] * (p[c] - off * normals[node + c]);
          n[c] += w[k] * normals[node + c];
        }
      });
      const long = Math.hypot(...n) || 1;
      for (let c = 0; c < 3; ++c) {
        points[3 * g + c] = 0.5 * (p[c] + q[c]);
        facing[3 * g + c] = n[c] / long;
      }
    }
    return { points, facing };
  }

  /** Of each node: the height of the highest wave whose crest or valley is in a triangle at it. */
  heights(state) {
    const x = this.ply.places.state(state);
    const grid = this.places(x);
    const found = new Float64Array(this.owner.length);
    const longest = Math.max(4 * this.side, 30);
    for (let half = 1.5 * this.side; half <= longest; half *= GROWTH) {
      const straight = Math.round(half / this.step);
      const slanted = Math.round(half / this.step / Math.SQRT2);
      for (const way of [[straight, 0], [0, straight], [slanted, slanted], [slanted, -slanted]]) {
        this.searchAlong(way, grid, state, found);
      }
    }
    const heights = new Float32Array(this.ply.flat.length / 3);
    found.forEach((height, g) => {
      if (height < LEAST) return;
      for (let k = 0; k < 3; ++k) {
        const node = this.ply.triangles[this.owner[g] + k];
        heights[node] = Math.max(heights[node], height);
      }
    });
    return heights;
  }

  searchAlong([di, dj], { points, facing }, state, found) {
    const [columns, rows] = this.size;
    const apart = dj * columns + di;
    const half = this.step * Math.hypot(di, dj);
    for (let j = 2 * Math.abs(dj); j < rows - 2 * Math.abs(dj); ++j) {
      for (let i = 2 * di; i < columns - 2 * di; ++i) {
        const g = j * columns + i;
        const d = [-1, 0, 1].map((k) => {
          const [here, before, after] = [g + k * apart, g + (k - 1) * apart, g + (k + 1) * apart];
          let sum = 0;
          for (let c = 0; c < 3; ++c) {
            sum += facing[3 * here + c] *
              (points[3 * here + c] - 0.5 * (points[3 * before + c] + points[3 * after + c]));
          }
          return sum;
        });
        let height = heightOf(...d); // NaN where the line leaves the ply
        if (!(height > Math.max(found[g], LEAST))) continue;
        const line = [-2, -1, 0, 1, 2].map((k) => 3 * (g + k * apart));
        height = Math.min(height, this.heightOfTools(line, points, facing, state, half));
        if (height > found[g]) height *= 1 - this.shareOfTools(line, d, points, facing, state, half);
        if (height > found[g]) found[g] = height;
      }
    }
  }

  /** (3) of wrinkles.hpp: the share of a wave, with heights d over its chords, that tools have. */
  shareOfTools(line, d, points, facing, state, half) {
    let share = 1;
    for (let k = 0; k < 3 && share > 0; ++k) {
      let most = 0;
      for (const tool of this.ply.run.tools) {
        most = Math.max(most, this.heightOfTool(tool, line.slice(k, k + 3), points, facing, state, half) / d[k]);
      }
      share = Math.min(share, most);
    }
    return share;
  }

  /** Height over the chord of a tool's surface along the normal at the middle one of three places; 0
   * if the tool is not near or does not face it. */
  heightOfTool(tool, line, points, facing, state, half) {
    const shift = tool.told.shift[state];
    const place = (at) => [0, 1, 2].map((c) => points[at + c] - shift[c]);
    const normal = [0, 1, 2].map((c) => facing[line[1] + c]);
    const dot = (u) => u.reduce((sum, c, k) => sum + c * normal[k], 0);
    const here = place(line[1]);
    const nearest = tool.away(...here, NEAR_WAVES * half);
    if (!nearest || Math.abs(dot(nearest.along)) < FACING) return 0;
    const side = dot(nearest.along) > 0 ? -1 : 1; // of the tool, unless the ply is through it
    const towards = normal.map((c) => side * c);
    const z = line.map((at) => {
      const p = place(at);
      return dot(p.map((c, k) => c - here[k])) +
        side * wayTo(tool, p, towards, CLOSE * this.side, 2 * NEAR_WAVES * half);
    });
    return Number.isFinite(z[1]) ? z[1] - 0.5 * (z[0] + z[2]) : 0;
  }

  /** The least height that the distances from a tool which faces the ply have; infinite if none does.
   * Distances are negative where the ply is through the tool. */
  heightOfTools(line, points, facing, state, half) {
    let least = Infinity;
    for (const tool of this.ply.run.tools) {
      const shift = tool.told.shift[state];
      const away = (at) => {
        const told = tool.away(points[at] - shift[0], points[at + 1] - shift[1],
          points[at + 2] - shift[2], 5 * half);
        if (told) told.facing = told.along.reduce((sum, c, k) => sum + c * facing[at + k], 0);
        return told;
      };
      const middle = away(line[2]);
      if (!middle || middle.distance > half || Math.abs(middle.facing) < FACING) continue;
      const all = line.map(away);
      if (all.some((one) => !one)) continue;
      const f = all.map(({ distance, facing: to }) =>
        (distance < CLOSE * this.side && to * middle.facing < 0 ? -distance : distance));
      const d = [1, 2, 3].map((k) => f[k] - 0.5 * (f[k - 1] + f[k + 1]));
      least = Math.min(least, heightOf(...d));
    }
    return least;
  }
}
