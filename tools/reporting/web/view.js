// SPDX-License-Identifier: GPL-3.0-or-later
// One picture: a run formed, or one of its flat blanks, or the difference of two runs.

import { MOST_FAMILIES } from "plyform/ply.js";
import { PlyMesh } from "plyform/ply_mesh.js";
import { bands, cutsOf } from "plyform/section.js";
import { cutting, plane, plyMaterial, sharedUniforms } from "plyform/shaders.js";
import { table } from "plyform/colours.js";

const THREE = window.THREE;

/** A small cross where the reader has clicked. */
function markerMesh() {
  const shape = new THREE.SphereGeometry(1, 16, 12);
  const mesh = new THREE.Mesh(shape, new THREE.MeshBasicMaterial({ color: 0xd0021b, depthTest: false }));
  mesh.renderOrder = 10;
  mesh.visible = false;
  return mesh;
}

export class View {
  constructor(element, run, kind) {
    Object.assign(this, { element, run, kind, flat: kind.startsWith("flat"),
      difference: kind.endsWith("difference") });
    this.scene = new THREE.Scene();
    this.uniforms = sharedUniforms();
    if (this.flat) {
      this.uniforms.plane_on = { value: 0 };
      this.uniforms.lit.value = 0;
    }
    this.plies = run.plies.map((ply) => new PlyMesh(ply, this.uniforms, this.flat));
    this.tools = this.flat ? [] : run.tools.map((tool) => tool.mesh(this.uniforms.towards_eye));
    this.cut = new THREE.Group();
    this.marker = markerMesh();
    this.scene.add(...this.plies.map((ply) => ply.object), ...this.tools.map((tool) => tool.object),
      this.cut, this.marker);
  }

  /** Scale and yarns. */
  paint(scale, settings) {
    const { uniforms } = this;
    uniforms.scale.value.image.data.set(table(scale.colours, scale.steps));
    uniforms.scale.value.needsUpdate = true;
    uniforms.low.value = scale.low;
    uniforms.high.value = scale.high;
    uniforms.limit_on.value = scale.limit === null ? 0 : 1;
    uniforms.limit.value = scale.limit === null ? 0 : scale.limit;
    uniforms.spacing.value = settings.yarns;
    uniforms.line_width.value = Math.min(0.5, settings.yarns / 12);
  }

  /** Which bodies are there, and how far apart plies are drawn. */
  arrange(settings) {
    this.plies.forEach((mesh, i) => {
      mesh.object.visible = this.flat ? i === settings.flatPly : !settings.hidden.has(mesh.ply.name);
      mesh.outline.visible = this.flat || !settings.section.on;
      mesh.object.position.z = this.flat ? 0 : i * settings.apart;
    });
    for (const tool of this.tools) {
      const way = this.wayOf(tool.tool, settings);
      tool.solid.visible = way === "solid";
      tool.outline.visible = way === "outlines";
      tool.object.position.fromArray(this.shiftOf(tool.tool));
      if (settings.apart > 0) tool.object.position.z += this.liftOf(tool.tool, settings.apart);
    }
  }

  /** How a tool is drawn: solid, outlines, hidden. */
  wayOf(tool, settings) {
    return settings.tools;
  }

  shiftOf(tool) {
    return tool.data.shift[this.state];
  }

  /** Tools above the stack go up with the uppermost ply when plies are drawn apart. */
  liftOf(tool, apart) {
    const last = this.run.plies.length - 1;
    return tool.data.above ? last * apart : 0;
  }

  move(state) {
    this.state = state;
    this.x = this.run.plies.map((ply) => ply.places.state(state));
    this.plies.forEach((mesh, i) => {
      if (this.flat) mesh.drawFormedOutline(this.x[i], mesh.ply.flat[2] + 0.5, mesh.ply.data.size / 150);
      else mesh.move(this.x[i]);
    });
  }

  /** Cut faces of plies and tools at the plane. */
  section(settings) {
    for (const part of this.cut.children) part.geometry.dispose();
    if (this.cut.children.length) this.cut.remove(...this.cut.children);
    const parts = [...this.plies.map((mesh) => mesh.surface), ...this.tools.map((tool) => tool.solid)];
    for (const part of parts) cutting(part.material, settings.section.on && !this.flat);
    if (this.flat || !settings.section.on) return;
    const normal = new THREE.Vector3(plane.at.value.x, plane.at.value.y, plane.at.value.z);
    this.plies.forEach((mesh, i) => {
      if (!mesh.object.visible) return;
      const lift = mesh.object.position.z;
      const cuts = cutsOf(this.x[i], mesh.ply.triangles, normal, plane.at.value.w - lift * normal.z);
      this.addBand(mesh, cuts, normal, lift);
    });
    for (const { tool, object } of this.tools) {
      if (this.wayOf(tool, settings) === "hidden") continue;
      const cuts = cutsOf(tool.x, tool.triangles, normal,
        plane.at.value.w - object.position.dot(normal));
      this.addLines(cuts.map((cut) => cut.ends), object.position);
    }
  }

  addBand(mesh, cuts, normal, lift) {
    const { positions, of } = bands(cuts, normal, mesh.ply.data.thickness);
    const values = mesh.surface.geometry.getAttribute("value").array;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
    geometry.setAttribute("normal",
      new THREE.BufferAttribute(new Float32Array(positions.length).fill(1), 3));
    geometry.setAttribute("value",
      new THREE.BufferAttribute(Float32Array.from(of, (triangle) => values[3 * triangle]), 1));
    const yarns = new Float32Array(MOST_FAMILIES * of.length);
    geometry.setAttribute("yarn", new THREE.BufferAttribute(yarns, MOST_FAMILIES));
    const uniforms = { ...this.uniforms, spacing: { value: 0 }, plane_on: { value: 0 }, lit: { value: 0 } };
    const band = new THREE.Mesh(geometry, plyMaterial(uniforms));
    band.frustumCulled = false;
    band.position.z = lift;
    this.cut.add(band);
  }

  addLines(ends, place) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position",
      new THREE.BufferAttribute(new Float32Array(ends.flat(2)), 3));
    const lines = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: 0x1d2b36 }));
    lines.frustumCulled = false;
    lines.position.copy(place);
    this.cut.add(lines);
  }

  /** Before each picture; fine: nothing moves. */
  prepare() {}

  /** Outlines of tools depend on where they are seen from. */
  outlineTools(eye) {
    for (const { tool, outline } of this.tools) {
      if (!outline.visible) continue;
      outline.geometry.setAttribute("position", new THREE.BufferAttribute(tool.outlineSeen(eye), 3));
    }
  }

  /** Surfaces that can be picked, with those in front of the section left out. */
  surfaces() {
    const { x: nx, y: ny, z: nz, w } = plane.at.value;
    const keeps = (p) => this.flat || plane.on.value < 0.5 || p.x * nx + p.y * ny + p.z * nz <= w;
    return this.plies.flatMap((mesh, i) => (mesh.object.visible ? [{
      ply: mesh.ply, index: i, x: this.flat ? mesh.ply.flat : this.x[i],
      triangles: mesh.ply.triangles, lift: mesh.object.position.z, keeps,
    }] : []));
  }

  /** Puts the marker on a point of the material. */
  mark(probe, pixel) {
    this.marker.visible = Boolean(probe) && this.plies[probe.index] !== undefined &&
      this.plies[probe.index].object.visible;
    if (!this.marker.visible) return;
    const mesh = this.plies[probe.index];
    const x = this.flat ? mesh.ply.flat : this.x[probe.index];
    const place = new THREE.Vector3(0, 0, mesh.object.position.z);
    for (let k = 0; k < 3; ++k) {
      const node = mesh.ply.triangles[3 * probe.triangle + k];
      place.addScaledVector(new THREE.Vector3().fromArray(x, 3 * node), probe.weights[k]);
    }
    this.marker.position.copy(place);
    this.marker.scale.setScalar(4 * pixel);
  }
}
