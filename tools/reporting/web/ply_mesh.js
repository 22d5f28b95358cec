// SPDX-License-Identifier: GPL-3.0-or-later
// A ply as three.js draws it: three vertices of its own for each triangle, so that a value a
// triangle is one colour.

import { MOST_FAMILIES } from "plyform/ply.js";
import { plyMaterial } from "plyform/shaders.js";

const THREE = window.THREE;

function spread(values, triangles, size) {
  const out = new Float32Array(triangles.length * size);
  for (let i = 0; i < triangles.length; ++i) {
    for (let k = 0; k < size; ++k) out[size * i + k] = values[size * triangles[i] + k];
  }
  return out;
}

/** Unit normals of nodes: the sum over their triangles, weighted by areas. */
export function nodeNormals(x, triangles) {
  const normals = new Float32Array(x.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const [ux, uy, uz] = [x[b] - x[a], x[b + 1] - x[a + 1], x[b + 2] - x[a + 2]];
    const [vx, vy, vz] = [x[c] - x[a], x[c + 1] - x[a + 1], x[c + 2] - x[a + 2]];
    const [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const node of [a, b, c]) {
      normals[node] += nx;
      normals[node + 1] += ny;
      normals[node + 2] += nz;
    }
  }
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
    for (let k = 0; k < 3; ++k) normals[i + k] /= length;
  }
  return normals;
}

export class PlyMesh {
  /** `flat`: shows the ply before forming, with the outline of the formed one over it. */
  constructor(ply, uniforms, flat) {
    this.ply = ply;
    this.flat = flat;
    const geometry = new THREE.BufferGeometry();
    const count = ply.triangles.length;
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
    geometry.setAttribute("normal", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
    geometry.setAttribute("value", new THREE.BufferAttribute(new Float32Array(count), 1));
    geometry.setAttribute("yarn", new THREE.BufferAttribute(new Float32Array(MOST_FAMILIES * count), MOST_FAMILIES));
    this.surface = new THREE.Mesh(geometry, plyMaterial(uniforms));
    const line = new THREE.BufferGeometry();
    this.outline = flat
      ? new THREE.Mesh(line, new THREE.MeshBasicMaterial({ color: 0xe0218a, side: THREE.DoubleSide }))
      : new THREE.LineSegments(line, new THREE.LineBasicMaterial({ color: 0x303030 }));
    line.setAttribute("position",
      new THREE.BufferAttribute(new Float32Array((flat ? 9 : 3) * ply.border.length), 3));
    this.object = new THREE.Group();
    this.object.add(this.surface, this.outline);
    for (const part of [this.surface, this.outline]) part.frustumCulled = false;
    this.layYarns();
    if (flat) this.move(ply.flat);
  }

  layYarns() {
    this.set("yarn", spread(this.ply.yarns, this.ply.triangles, MOST_FAMILIES));
  }

  set(attribute, values) {
    const to = this.surface.geometry.getAttribute(attribute);
    to.array.set(values);
    to.needsUpdate = true;
  }

  move(x) {
    const { triangles } = this.ply;
    this.set("position", spread(x, triangles, 3));
    this.set("normal", spread(nodeNormals(x, triangles), triangles, 3));
    if (this.flat) return;
    const to = this.outline.geometry.getAttribute("position");
    this.ply.border.forEach((node, i) => to.array.set(x.subarray(3 * node, 3 * node + 3), 3 * i));
    to.needsUpdate = true;
  }

  /** The border of the formed ply, seen from above, as a band over the flat one. */
  drawFormedOutline(x, level, wide) {
    const to = this.outline.geometry.getAttribute("position");
    const { border } = this.ply;
    for (let i = 0; i < border.length; i += 2) {
      const [a, b] = [3 * border[i], 3 * border[i + 1]];
      const [dx, dy] = [x[b] - x[a], x[b + 1] - x[a + 1]];
      const long = Math.hypot(dx, dy) || 1;
      const [ax, ay] = [(0.5 * wide * dx) / long, (0.5 * wide * dy) / long];
      const corners = [[a, -1, 1], [a, -1, -1], [b, 1, -1], [a, -1, 1], [b, 1, -1], [b, 1, 1]];
      corners.forEach(([node, along, side], k) => to.array.set(
        [x[node] + along * ax - side * ay, x[node + 1] + along * ay + side * ax, level], 9 * i + 3 * k));
    }
    to.needsUpdate = true;
  }

  colour({ of, values }) {
    const { triangles } = this.ply;
    const to = this.surface.geometry.getAttribute("value");
    for (let i = 0; i < triangles.length; ++i) {
      to.array[i] = of === "triangle" ? values[Math.floor(i / 3)] : values[triangles[i]];
    }
    to.needsUpdate = true;
  }
}
