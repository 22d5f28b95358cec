// SPDX-License-Identifier: GPL-3.0-or-later
// A tool: solid, as its outline seen from here, and how far points are from it.

import { loadBlock } from "plyform/decode.js";
import { Facets } from "plyform/facets.js";
import { toolMaterial } from "plyform/shaders.js";

const THREE = window.THREE;
const SHARP = Math.cos((35 * Math.PI) / 180); // an edge that is always drawn

/** Edges with the normals of the one or two triangles at them. */
function edgesOf(x, triangles) {
  const normals = [];
  const edges = new Map();
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => new THREE.Vector3().fromArray(x, 3 * triangles[t + k]));
    normals.push(b.clone().sub(a).cross(c.sub(a)).normalize());
    for (let k = 0; k < 3; ++k) {
      const [p, q] = [triangles[t + k], triangles[t + ((k + 1) % 3)]];
      const key = Math.min(p, q) * 4294967296 + Math.max(p, q);
      if (!edges.has(key)) edges.set(key, { a: p, b: q, first: t / 3, second: -1 });
      else edges.get(key).second = t / 3;
    }
  }
  return { edges: [...edges.values()], normals };
}

export class Tool {
  constructor(run, told) {
    this.run = run;
    this.told = told;
    this.name = told.name;
  }

  async load() {
    const [x, triangles] = await Promise.all([this.told.x0, this.told.triangles].map(loadBlock));
    this.x = x.state(0);
    this.triangles = triangles.integers();
  }

  /** Makes `distances` of points less where this tool, moved by `shift`, is nearer. */
  nearest(points, shift, distances) {
    if (!this.facets) this.facets = new Facets(this.x, this.triangles);
    for (let i = 0; i < distances.length; ++i) {
      distances[i] = this.facets.distance(points[3 * i] - shift[0], points[3 * i + 1] - shift[1],
        points[3 * i + 2] - shift[2], distances[i]);
    }
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
    const { edges, normals } = this.edges;
    const facing = normals.map((normal) => normal.dot(eye));
    const lines = [];
    for (const { a, b, first, second } of edges) {
      if (second < 0 || facing[first] * facing[second] < 0 ||
          normals[first].dot(normals[second]) < SHARP) {
        for (const node of [a, b]) {
          lines.push(this.x[3 * node], this.x[3 * node + 1], this.x[3 * node + 2]);
        }
      }
    }
    return new Float32Array(lines);
  }
}
