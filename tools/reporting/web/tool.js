// SPDX-License-Identifier: GPL-3.0-or-later
// A tool: solid, as its outline seen from here, and how far points are from it.

import { loadBlock } from "plyform/decode.js";
import { Facets } from "plyform/facets.js";
import { toolMaterial } from "plyform/shaders.js";

const THREE = window.THREE;
const SHARP = Math.cos((35 * Math.PI) / 180); // an edge that is always drawn

/** Edges (two nodes, one or two triangles; -1: none) and unit normals of triangles, in a row each. */
function edgesOf(x, triangles) {
  const normals = new Float32Array(triangles.length);
  const known = new Map();
  const edges = [];
  const [u, v] = [new THREE.Vector3(), new THREE.Vector3()];
  const corner = (k) => new THREE.Vector3().fromArray(x, 3 * triangles[k]);
  for (let t = 0; t < triangles.length; t += 3) {
    const a = corner(t);
    u.subVectors(corner(t + 1), a).cross(v.subVectors(corner(t + 2), a)).normalize().toArray(normals, t);
    for (let k = 0; k < 3; ++k) {
      const [p, q] = [triangles[t + k], triangles[t + ((k + 1) % 3)]];
      const key = Math.min(p, q) * 4294967296 + Math.max(p, q);
      if (known.has(key)) {
        edges[known.get(key) + 3] = t;
      } else {
        known.set(key, edges.length);
        edges.push(p, q, t, -1);
      }
    }
  }
  return { edges: Int32Array.from(edges), normals };
}

/** Lines (pairs of nodes) without short bits that hang together with nothing. */
function withoutBits(lines, x, least) {
  const parent = new Map();
  const top = (node) => {
    let at = node;
    while (parent.get(at) !== at) {
      parent.set(at, parent.get(parent.get(at)));
      at = parent.get(at);
    }
    return at;
  };
  for (const node of lines) parent.set(node, node);
  for (let i = 0; i < lines.length; i += 2) parent.set(top(lines[i]), top(lines[i + 1]));
  const length = new Map();
  for (let i = 0; i < lines.length; i += 2) {
    const [p, q, root] = [3 * lines[i], 3 * lines[i + 1], top(lines[i])];
    const long = Math.hypot(x[p] - x[q], x[p + 1] - x[q + 1], x[p + 2] - x[q + 2]);
    length.set(root, (length.get(root) || 0) + long);
  }
  return lines.filter((node) => length.get(top(node)) > least);
}

export class Tool {
  constructor(run, data) {
    this.run = run;
    this.data = data;
    this.name = data.name;
    this.sharp = SHARP;
  }

  async load() {
    const [x, triangles] = await Promise.all([this.data.x0, this.data.triangles].map(loadBlock));
    this.place(x.state(0), triangles.integers());
  }

  /** Its surface at time 0. */
  place(x, triangles) {
    this.x = x;
    this.triangles = triangles;
    this.size = new THREE.Box3().setFromArray(this.x).getSize(new THREE.Vector3()).length();
  }

  /** Makes `distances` of points less where this tool, moved by `shift`, is nearer. */
  nearest(points, shift, distances) {
    if (!this.facets) this.facets = new Facets(this.x, this.triangles);
    for (let i = 0; i < distances.length; ++i) {
      distances[i] = this.facets.distance(points[3 * i] - shift[0], points[3 * i + 1] - shift[1],
        points[3 * i + 2] - shift[2], distances[i]);
    }
  }

  /** Distance of a point from the tool at time 0, and the unit vector from there to the point; null
   * if further than `most`. */
  away(x, y, z, most) {
    if (!this.facets) this.facets = new Facets(this.x, this.triangles);
    const distance = this.facets.distance(x, y, z, most);
    if (this.facets.found < 0) return null;
    const foot = this.facets.foot([x, y, z], this.facets.found);
    return { distance, along: [x - foot[0], y - foot[1], z - foot[2]].map((c) => c / (distance || 1)) };
  }

  /** What is drawn in one picture. */
  mesh(towardsEye) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(this.x, 3));
    geometry.setIndex(new THREE.BufferAttribute(this.triangles, 1));
    const solid = new THREE.Mesh(geometry, toolMaterial(0xaab4bd, towardsEye));
    const outline = new THREE.LineSegments(new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({ color: 0x5b6770 }));
    for (const part of [solid, outline]) part.frustumCulled = false;
    const object = new THREE.Group();
    object.add(solid, outline);
    return { tool: this, object, solid, outline };
  }

  /** Edges between what faces the eye and what does not, sharp edges and borders. */
  outlineSeen(eye) {
    if (!this.edges) this.edges = edgesOf(this.x, this.triangles);
    const { edges, normals: n } = this.edges;
    const facing = (t) => n[t] * eye.x + n[t + 1] * eye.y + n[t + 2] * eye.z;
    const lines = [];
    for (let i = 0; i < edges.length; i += 4) {
      const [s, t] = [edges[i + 2], edges[i + 3]];
      if (t < 0 || facing(s) * facing(t) < 0 ||
          n[s] * n[t] + n[s + 1] * n[t + 1] + n[s + 2] * n[t + 2] < this.sharp) {
        lines.push(edges[i], edges[i + 1]);
      }
    }
    const kept = withoutBits(lines, this.x, 0.15 * this.size);
    const places = new Float32Array(3 * kept.length);
    kept.forEach((node, i) => places.set(this.x.subarray(3 * node, 3 * node + 3), 3 * i));
    return places;
  }
}
