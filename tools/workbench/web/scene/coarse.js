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

/** Of each node the cell that it lies in, numbered; and the number of cells. */
function cellsOf(x, size, low) {
  const known = new Map();
  const of = new Uint32Array(x.length / 3);
  for (let i = 0; i < of.length; ++i) {
    const [u, v, w] = [0, 1, 2].map((k) => Math.floor((x[3 * i + k] - low[k]) / size));
    const key = u + 8192 * (v + 8192 * w);
    if (!known.has(key)) known.set(key, known.size);
    of[i] = known.get(key);
  }
  return { of, count: known.size };
}

/** A surface of about `most` triangles or fewer; itself if it has no more. */
export function coarser(x, triangles, most) {
  if (triangles.length / 3 <= most) return { x, triangles };
  const box = new THREE.Box3().setFromArray(x);
  const long = box.getSize(new THREE.Vector3()).length() || 1;
  for (let parts = 160; ; parts = Math.floor(0.75 * parts)) {
    const { of, count } = cellsOf(x, long / parts, box.min.toArray());
    const kept = [];
    for (let t = 0; t < triangles.length; t += 3) {
      const [a, b, c] = [of[triangles[t]], of[triangles[t + 1]], of[triangles[t + 2]]];
      if (a !== b && b !== c && c !== a) kept.push(a, b, c);
    }
    if (kept.length / 3 > most && parts > 8) continue;
    const places = new Float32Array(3 * count);
    for (let i = 0; i < of.length; ++i) { // any node of the cell: edges stay on edges
      for (let k = 0; k < 3; ++k) places[3 * of[i] + k] = x[3 * i + k];
    }
    return { x: places, triangles: Uint32Array.from(kept) };
  }
}
