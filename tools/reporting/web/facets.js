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

/** Square of the distance of p from the side from a to b, corners of c from the places i and j. */
function squareFromSide(px, py, pz, c, i, j) {
  const [dx, dy, dz] = [c[j] - c[i], c[j + 1] - c[i + 1], c[j + 2] - c[i + 2]];
  const [x, y, z] = [px - c[i], py - c[i + 1], pz - c[i + 2]];
  const long = dx * dx + dy * dy + dz * dz;
  const share = long > 0 ? Math.min(1, Math.max(0, (x * dx + y * dy + z * dz) / long)) : 0;
  return (x - share * dx) ** 2 + (y - share * dy) ** 2 + (z - share * dz) ** 2;
}

/** Whether p is on the inner side of the side from i to j, in the direction of the normal n. */
function isInside(px, py, pz, c, i, j, nx, ny, nz) {
  const [dx, dy, dz] = [c[j] - c[i], c[j + 1] - c[i + 1], c[j + 2] - c[i + 2]];
  const [x, y, z] = [px - c[i], py - c[i + 1], pz - c[i + 2]];
  return (dy * z - dz * y) * nx + (dz * x - dx * z) * ny + (dx * y - dy * x) * nz >= 0;
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

  squareFromBox(x, y, z, number) {
    const box = this.boxes[number];
    const dx = Math.max(box[0] - x, 0, x - box[3]);
    const dy = Math.max(box[1] - y, 0, y - box[4]);
    const dz = Math.max(box[2] - z, 0, z - box[5]);
    return dx * dx + dy * dy + dz * dz;
  }

  /** Distance of a point, or `most` if it is further away; `found` is then the triangle, or -1. */
  distance(x, y, z, most) {
    let best = most * most;
    this.found = -1;
    const open = [0];
    while (open.length) {
      const number = open.pop();
      if (this.squareFromBox(x, y, z, number) >= best) continue;
      const part = this.parts[number];
      if (part.left === undefined) {
        for (let i = part.from; i < part.to; ++i) {
          const square = this.squareFrom(x, y, z, this.order[i]);
          if (square < best) [best, this.found] = [square, this.order[i]];
        }
      } else {
        const nearerLeft = this.squareFromBox(x, y, z, part.left) < this.squareFromBox(x, y, z, part.right);
        open.push(nearerLeft ? part.right : part.left, nearerLeft ? part.left : part.right);
      }
    }
    return Math.sqrt(best);
  }

  /** Normal of a triangle, as long as twice its area. */
  normal(triangle) {
    const [c, a] = [this.corners, 9 * triangle];
    const [ux, uy, uz] = [c[a + 3] - c[a], c[a + 4] - c[a + 1], c[a + 5] - c[a + 2]];
    const [vx, vy, vz] = [c[a + 6] - c[a], c[a + 7] - c[a + 1], c[a + 8] - c[a + 2]];
    return [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
  }

  /** The point of a triangle that is nearest to p. */
  foot(p, triangle) {
    const corners = [0, 3, 6].map((k) => [...this.corners.subarray(9 * triangle + k, 9 * triangle + k + 3)]);
    const n = this.normal(triangle);
    const off = n.reduce((sum, c, k) => sum + c * (p[k] - corners[0][k]), 0) / (n[0] ** 2 + n[1] ** 2 + n[2] ** 2 || 1);
    const feet = [p.map((c, k) => c - off * n[k])]; // if it is inside, nothing is nearer
    for (let k = 0; k < 3; ++k) {
      const [a, b] = [corners[k], corners[(k + 1) % 3]];
      const side = b.map((c, i) => c - a[i]);
      const long = side.reduce((sum, c) => sum + c * c, 0);
      const share = side.reduce((sum, c, i) => sum + c * (p[i] - a[i]), 0) / (long || 1);
      feet.push(a.map((c, i) => c + Math.min(1, Math.max(0, share)) * side[i]));
    }
    const far = (foot) => foot.reduce((sum, c, k) => sum + (p[k] - c) ** 2, 0);
    const least = this.squareFrom(...p, triangle);
    return feet.find((foot, k) => k > 0 && far(foot) <= least + 1e-9) || feet[0];
  }

  squareFrom(x, y, z, triangle) {
    const c = this.corners;
    const a = 9 * triangle;
    const [nx, ny, nz] = this.normal(triangle);
    const size = nx * nx + ny * ny + nz * nz;
    if (size > 0 && isInside(x, y, z, c, a, a + 3, nx, ny, nz) &&
        isInside(x, y, z, c, a + 3, a + 6, nx, ny, nz) && isInside(x, y, z, c, a + 6, a, nx, ny, nz)) {
      return ((x - c[a]) * nx + (y - c[a + 1]) * ny + (z - c[a + 2]) * nz) ** 2 / size;
    }
    return Math.min(squareFromSide(x, y, z, c, a, a + 3), squareFromSide(x, y, z, c, a + 3, a + 6),
      squareFromSide(x, y, z, c, a + 6, a));
  }
}
