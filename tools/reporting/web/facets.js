// SPDX-License-Identifier: GPL-3.0-or-later
// Distance of points from triangles, by a tree of boxes.

const LEAF = 8;

function boxOf(corners, order, from, to) {
  const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
  for (let i = from; i < to; ++i) {
    for (let k = 0; k < 9; ++k) {
      const value = corners[9 * order[i] + k];
      if (value < box[k % 3]) box[k % 3] = value;
      if (value > box[3 + (k % 3)]) box[3 + (k % 3)] = value;
    }
  }
  return box;
}

function squareFromSegment(p, a, b) {
  const [dx, dy, dz] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
  const [px, py, pz] = [p[0] - a[0], p[1] - a[1], p[2] - a[2]];
  const long = dx * dx + dy * dy + dz * dz;
  const share = long > 0 ? Math.min(1, Math.max(0, (px * dx + py * dy + pz * dz) / long)) : 0;
  return (px - share * dx) ** 2 + (py - share * dy) ** 2 + (pz - share * dz) ** 2;
}

const cross = (u, v) => [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
const minus = (u, v) => [u[0] - v[0], u[1] - v[1], u[2] - v[2]];
const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];

/** Square of the distance of p from the triangle a b c. */
export function squareFromTriangle(p, a, b, c) {
  const normal = cross(minus(b, a), minus(c, a));
  const size = dot(normal, normal);
  const inside = size > 0 && [[a, b], [b, c], [c, a]].every(([from, to]) =>
    dot(cross(minus(to, from), minus(p, from)), normal) >= 0);
  if (inside) return dot(minus(p, a), normal) ** 2 / size;
  return Math.min(squareFromSegment(p, a, b), squareFromSegment(p, b, c), squareFromSegment(p, c, a));
}

export class Facets {
  constructor(x, triangles) {
    const count = triangles.length / 3;
    this.corners = new Float32Array(9 * count);
    for (let i = 0; i < triangles.length; ++i) {
      for (let k = 0; k < 3; ++k) this.corners[3 * i + k] = x[3 * triangles[i] + k];
    }
    this.order = Uint32Array.from({ length: count }, (_, i) => i);
    this.boxes = [];
    this.parts = [];
    this.build(0, count);
  }

  build(from, to) {
    const number = this.boxes.length;
    const box = boxOf(this.corners, this.order, from, to);
    this.boxes.push(box);
    this.parts.push(null);
    if (to - from <= LEAF) {
      this.parts[number] = { from, to };
      return number;
    }
    const sizes = [0, 1, 2].map((k) => box[3 + k] - box[k]);
    const axis = sizes.indexOf(Math.max(...sizes));
    const middle = (t) => this.corners[9 * t + axis] + this.corners[9 * t + 3 + axis] +
      this.corners[9 * t + 6 + axis];
    this.order.subarray(from, to).sort((s, t) => middle(s) - middle(t));
    const half = (from + to) >> 1;
    const left = this.build(from, half);
    this.parts[number] = { left, right: this.build(half, to) };
    return number;
  }

  squareFromBox(p, number) {
    const box = this.boxes[number];
    let sum = 0;
    for (let k = 0; k < 3; ++k) {
      const outside = Math.max(box[k] - p[k], 0, p[k] - box[3 + k]);
      sum += outside * outside;
    }
    return sum;
  }

  /** Distance of a point, or `most` if it is further away. */
  distance(x, y, z, most) {
    const p = [x, y, z];
    let best = most * most;
    const open = [0];
    while (open.length) {
      const number = open.pop();
      if (this.squareFromBox(p, number) >= best) continue;
      const part = this.parts[number];
      if (part.left === undefined) {
        for (let i = part.from; i < part.to; ++i) best = Math.min(best, this.squareFrom(p, this.order[i]));
      } else {
        const nearerLeft = this.squareFromBox(p, part.left) < this.squareFromBox(p, part.right);
        open.push(nearerLeft ? part.right : part.left, nearerLeft ? part.left : part.right);
      }
    }
    return Math.sqrt(best);
  }

  squareFrom(p, triangle) {
    const [a, b, c] = [0, 3, 6].map((k) => this.corners.subarray(9 * triangle + k, 9 * triangle + k + 3));
    return squareFromTriangle(p, a, b, c);
  }
}
