// SPDX-License-Identifier: GPL-3.0-or-later
// Fewer triangles that look alike: the outline of a flat ply, filled; and a surface whose nodes are
// joined where they share a cell of a grid, for what is drawn while it is being turned.

import { borderEdges } from "plyform/ply.js";

const THREE = window.THREE;

/** Nodes of border edges in closed loops; null if they do not close. */
function loopsOf(border) {
  const next = new Map();
  for (let i = 0; i < border.length; i += 2) {
    for (const [a, b] of [[border[i], border[i + 1]], [border[i + 1], border[i]]]) {
      if (!next.has(a)) next.set(a, []);
      next.get(a).push(b);
    }
  }
  const loops = [];
  const done = new Set();
  for (const first of next.keys()) {
    if (done.has(first)) continue;
    const loop = [];
    for (let at = first; at !== undefined; at = next.get(at).find((node) => !done.has(node))) {
      if (next.get(at).length !== 2) return null;
      done.add(at);
      loop.push(at);
    }
    loops.push(loop);
  }
  return loops;
}

/** A loop without the nodes that lie on straight sides, which would only make slivers of triangles. */
function cornersOf(loop, x) {
  const straight = (node, i) => {
    const [before, after] = [loop[(i + loop.length - 1) % loop.length], loop[(i + 1) % loop.length]];
    const [ux, uy] = [x[3 * node] - x[3 * before], x[3 * node + 1] - x[3 * before + 1]];
    const [vx, vy] = [x[3 * after] - x[3 * node], x[3 * after + 1] - x[3 * node + 1]];
    return Math.abs(ux * vy - uy * vx) <= 1e-4 * Math.hypot(ux, uy) * Math.hypot(vx, vy);
  };
  return loop.filter((node, i) => !straight(node, i));
}

/** A flat ply { x, triangles } by its outline and holes alone; null if it is not flat or not of one
 * piece. */
export function outlineOnly(x, triangles) {
  for (let i = 5; i < x.length; i += 3) if (Math.abs(x[i] - x[2]) > 1e-4) return null;
  const whole = loopsOf(borderEdges(triangles));
  if (!whole || !whole.length) return null;
  const loops = whole.map((loop) => cornersOf(loop, x));
  const paths = loops.map((loop) => loop.map((node) => new THREE.Vector2(x[3 * node], x[3 * node + 1])));
  const area = (path) => Math.abs(THREE.ShapeUtils.area(path));
  const order = paths.map((_, i) => i).sort((i, j) => area(paths[j]) - area(paths[i]));
  const [outer, ...holes] = order.map((i) => paths[i]);
  const filled = THREE.ShapeUtils.triangulateShape(outer, holes);
  if (Math.abs(sum(filled, [outer, ...holes].flat()) - areaOf(x, triangles)) > 1e-3 * area(outer)) return null;
  const nodes = order.flatMap((i) => loops[i]);
  const places = new Float32Array(3 * nodes.length);
  nodes.forEach((node, i) => places.set(x.subarray(3 * node, 3 * node + 3), 3 * i));
  return { x: places, triangles: Uint32Array.from(filled.flat()), nodes };
}

const half = (ax, ay, bx, by) => 0.5 * Math.abs(ax * by - ay * bx);

function sum(faces, points) {
  return faces.reduce((total, [a, b, c]) => total + half(points[b].x - points[a].x, points[b].y - points[a].y,
    points[c].x - points[a].x, points[c].y - points[a].y), 0);
}

function areaOf(x, triangles) {
  let total = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    total += half(x[b] - x[a], x[b + 1] - x[a + 1], x[c] - x[a], x[c + 1] - x[a + 1]);
  }
  return total;
}

/** Of each node which way it faces: 0 to 5, the axis that its normal is nearest to. */
function facesOf(x, triangles) {
  const normals = new Float64Array(x.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const [ux, uy, uz] = [x[b] - x[a], x[b + 1] - x[a + 1], x[b + 2] - x[a + 2]];
    const [vx, vy, vz] = [x[c] - x[a], x[c + 1] - x[a + 1], x[c + 2] - x[a + 2]];
    const normal = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const node of [a, b, c]) for (let k = 0; k < 3; ++k) normals[node + k] += normal[k];
  }
  return Uint8Array.from({ length: x.length / 3 }, (_, i) => {
    const sizes = [0, 1, 2].map((k) => Math.abs(normals[3 * i + k]));
    const axis = sizes.indexOf(Math.max(...sizes));
    return 2 * axis + (normals[3 * i + axis] < 0 ? 1 : 0);
  });
}

/** Of each node the cell that it lies in, numbered; and the number of cells. The two sides of a thin
 * plate have cells of their own. */
function cellsOf(x, size, low, faces) {
  const known = new Map();
  const of = new Uint32Array(x.length / 3);
  for (let i = 0; i < of.length; ++i) {
    const [u, v, w] = [0, 1, 2].map((k) => Math.floor((x[3 * i + k] - low[k]) / size));
    const key = 6 * (u + 8192 * (v + 8192 * w)) + faces[i];
    if (!known.has(key)) known.set(key, known.size);
    of[i] = known.get(key);
  }
  return { of, count: known.size };
}

/** Means of the nodes of each cell: of those on borders alone where it has some, so that borders stay. */
function meansOf(x, triangles, of, count) {
  const border = new Uint8Array(of.length);
  for (const node of borderEdges(triangles)) border[node] = 1;
  const borders = new Uint8Array(count);
  for (let i = 0; i < of.length; ++i) if (border[i]) borders[of[i]] = 1;
  const means = new Float64Array(3 * count);
  const members = new Uint32Array(count);
  for (let i = 0; i < of.length; ++i) {
    if (borders[of[i]] && !border[i]) continue;
    members[of[i]] += 1;
    for (let k = 0; k < 3; ++k) means[3 * of[i] + k] += x[3 * i + k];
  }
  return means.map((sum_, i) => sum_ / members[Math.floor(i / 3)]);
}

/** Solves the symmetric [a b c; b d e; c e f] u = [g h i]. */
function solved(a, b, c, d, e, f, g, h, i) {
  const [p, q, r] = [d * f - e * e, c * e - b * f, b * e - c * d];
  const whole = a * p + b * q + c * r;
  return [g * p + h * q + i * r, g * q + h * (a * f - c * c) + i * (b * c - a * e),
    g * r + h * (b * c - a * e) + i * (a * d - b * b)].map((value) => value / whole);
}

/** Where a cell's node lies: nearest to the planes of the triangles there, so that sharp edges and
 * roundings stay, and near the mean where planes leave it free (Lindstrom 2000). */
function placesOf(x, triangles, of, count, size) {
  const means = meansOf(x, triangles, of, count);
  const sums = new Float64Array(9 * count); // xx xy xz yy yz zz, and the right hand side
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const [ux, uy, uz] = [x[b] - x[a], x[b + 1] - x[a + 1], x[b + 2] - x[a + 2]];
    const [vx, vy, vz] = [x[c] - x[a], x[c + 1] - x[a + 1], x[c + 2] - x[a + 2]];
    const [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const area = Math.hypot(nx, ny, nz) || 1; // each plane counts by its area
    for (let k = 0; k < 3; ++k) {
      const cell = of[triangles[t + k]];
      const off = (nx * (x[a] - means[3 * cell]) + ny * (x[a + 1] - means[3 * cell + 1]) +
        nz * (x[a + 2] - means[3 * cell + 2])) / area;
      [nx * nx, nx * ny, nx * nz, ny * ny, ny * nz, nz * nz, nx * off, ny * off, nz * off].forEach((part, j) => {
        sums[9 * cell + j] += j < 6 ? part / area : part;
      });
    }
  }
  const places = new Float32Array(3 * count);
  for (let cell = 0; cell < count; ++cell) {
    const [a, b, c, d, e, f, g, h, i] = sums.subarray(9 * cell, 9 * cell + 9);
    const free = 1e-2 * (a + d + f) + 1e-12;
    const moved = solved(a + free, b, c, d + free, e, f + free, g, h, i);
    for (let k = 0; k < 3; ++k) {
      places[3 * cell + k] = means[3 * cell + k] + Math.max(-size, Math.min(size, moved[k]));
    }
  }
  return places;
}

/** A surface of about `most` triangles or fewer; itself if it has no more. */
export function coarser(x, triangles, most) {
  if (triangles.length / 3 <= most) return { x, triangles };
  const box = new THREE.Box3().setFromArray(x);
  const long = box.getSize(new THREE.Vector3()).length() || 1;
  const faces = facesOf(x, triangles);
  for (let parts = 160; ; parts = Math.floor(0.75 * parts)) {
    const { of, count } = cellsOf(x, long / parts, box.min.toArray(), faces);
    const kept = [];
    for (let t = 0; t < triangles.length; t += 3) {
      const [a, b, c] = [of[triangles[t]], of[triangles[t + 1]], of[triangles[t + 2]]];
      if (a !== b && b !== c && c !== a) kept.push(a, b, c);
    }
    if (kept.length / 3 > most && parts > 8) continue;
    const places = placesOf(x, triangles, of, count, long / parts);
    return { x: places, triangles: Uint32Array.from(kept) };
  }
}
