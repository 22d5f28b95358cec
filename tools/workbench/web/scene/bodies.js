// SPDX-License-Identifier: GPL-3.0-or-later
// Plies and tools in one picture, as reports draw them; simplified while they are being turned.

import { Ply } from "plyform/ply.js";
import { PlyMesh } from "plyform/ply_mesh.js";
import { plane } from "plyform/shaders.js";
import { Tool } from "plyform/tool.js";
import { View } from "plyform/view.js";
import { coarser, outlineOnly } from "workbench/scene/coarse.js";

const THREE = window.THREE;
const MOST_TURNED = 12000; // triangles of all tools while they are being turned
const MOST_FILLED = 3000; // of plies, likewise

const COLOURS = { tool: 0xaab4bd, chosen: 0xe2b26a, wrong: 0xd9807a };
const EDGES = { ply: 0x303030, tool: 0x5b6770, chosen: 0xb35f00, wrong: 0xc00018 };

/** Colour of a ply by its angle, degrees: 0, 45, 90 and -45 are far apart. */
export function plyColour(angle) {
  const turn = (((angle % 180) + 180) % 180) / 180;
  return new THREE.Color().setHSL((0.57 + turn) % 1, 0.36, 0.62);
}

function familiesOf(body) {
  return Object.entries(body.families || {}).map(([name, direction]) => ({ name, direction }));
}

/** A ply of the picture: the outline alone while nothing is coloured or moved. */
function plyOf(body, whole) {
  const ply = new Ply(null, { name: body.name, thickness: body.thickness_mm || 0.1, families: familiesOf(body) });
  const light = whole ? null : outlineOnly(body.x, body.triangles);
  ply.lay(light ? light.x : body.x, light ? light.triangles : body.triangles);
  ply.whole = !light;
  if (light) ply.shape = light.x.filter((_, k) => k % 3 < 2).map((value) => Math.round(100 * value)).join();
  ply.body = body;
  return ply;
}

function toolOf(body, most) {
  const tool = new Tool(null, { shift: [[0, 0, 0]], above: body.above });
  tool.name = body.name;
  tool.place(body.x, body.triangles);
  const light = coarser(body.x, body.triangles, most);
  if (light.x !== body.x) {
    tool.light = new Tool(null, {});
    tool.light.place(light.x, light.triangles);
    tool.light.sharp = Math.cos((80 * Math.PI) / 180); // joined nodes make many edges that are none
  }
  tool.body = body;
  tool.shift = [0, 0, 0];
  return tool;
}

/** Of bodies those that have a surface, with their places in the list. */
const drawn = (bodies) => (bodies || []).filter((body) => body.x && body.x.length && body.triangles.length);

export class Bodies extends View {
  constructor(element, scene) {
    const [plies, tools] = [drawn(scene.plies), drawn(scene.tools)];
    const facets = tools.reduce((sum, tool) => sum + tool.triangles.length / 3, 0);
    const share = (tool) => Math.max(500, (MOST_TURNED * tool.triangles.length) / 3 / Math.max(facets, 1));
    super(element, { plies: plies.map((body) => plyOf(body, false)),
      tools: tools.map((body) => toolOf(body, facets > MOST_TURNED ? share(body) : Infinity)) }, "formed");
    this.scenery = scene;
    this.section3 = new THREE.Vector4(0, 0, 1, 1e9);
    this.x = this.plies.map((mesh) => mesh.ply.flat);
    this.ways = new Map(); // of single tools
    this.extra = new THREE.Group(); // marks
    this.scene.add(this.extra);
    for (const mesh of this.tools) if (mesh.tool.light) this.addLight(mesh);
    this.plies.forEach((mesh, i) => this.fill(i));
  }

  addLight(mesh) {
    const light = mesh.tool.light.mesh(this.uniforms.towards_eye);
    light.solid.material = mesh.solid.material;
    light.outline.material = mesh.outline.material;
    mesh.light = light;
    mesh.object.add(light.solid, light.outline);
  }

  fill(i) {
    const mesh = this.plies[i];
    mesh.move(this.x[i]);
    mesh.colour({ of: "node", values: new Float32Array(this.x[i].length / 3).fill(i % 256) });
  }

  /** The i-th ply with all its triangles, which values and places need. */
  withMesh(i) {
    const old = this.plies[i];
    if (old.ply.whole) return old;
    const mesh = new PlyMesh(plyOf(old.ply.body, true), this.uniforms, false);
    this.scene.remove(old.object);
    for (const part of [old.surface, old.outline]) part.geometry.dispose();
    this.scene.add(mesh.object);
    mesh.object.position.copy(old.object.position);
    mesh.object.visible = old.object.visible;
    this.plies[i] = mesh;
    this.x[i] = mesh.ply.flat;
    this.fill(i);
    return mesh;
  }

  /** Yarns of the i-th ply along the directions that its body has now. */
  turnYarns(i) {
    const mesh = this.plies[i];
    mesh.ply.data.families = familiesOf(mesh.ply.body);
    mesh.ply.lay(mesh.ply.flat, mesh.ply.triangles);
    mesh.layYarns();
  }

  /** Colours of plies by their angles. */
  paintPlain(settings, states) {
    const bytes = new Uint8Array(1024).fill(255);
    this.plies.forEach((mesh, i) => {
      const state = states(mesh.ply.body.key);
      const colour = plyColour(mesh.ply.body.angle_deg || 0);
      if (state === "wrong") colour.lerp(new THREE.Color(COLOURS[state]), 0.55);
      bytes.set(colour.toArray().map((c) => Math.round(255 * c)), 4 * (i % 256));
    });
    this.uniforms.scale.value.image.data.set(bytes);
    this.uniforms.scale.value.needsUpdate = true;
    this.uniforms.low.value = 0;
    this.uniforms.high.value = 255;
    this.uniforms.limit_on.value = 0;
    this.paintYarns(settings);
  }

  paintYarns(settings) {
    this.uniforms.spacing.value = settings.yarns;
    this.uniforms.line_width.value = Math.min(0.5, settings.yarns / 14);
  }

  /** Edges and tools in the colours of their states: chosen, wrong, or neither. */
  markStates(states) {
    for (const mesh of this.plies) mesh.outline.material.color.set(EDGES[states(mesh.ply.body.key) || "ply"]);
    for (const mesh of this.tools) {
      const state = states(mesh.tool.body.key) || "tool";
      mesh.solid.material.uniforms.colour.value.set(COLOURS[state]);
      mesh.outline.material.color.set(EDGES[state]);
    }
  }

  wayOf(tool, settings) {
    if (settings.hidden.has(tool.body.key || tool.name)) return "hidden";
    return settings.tools;
  }

  shiftOf(tool) {
    return tool.shift;
  }

  arrange(settings) {
    super.arrange(settings);
    for (const mesh of this.plies) {
      if (settings.hidden.has(mesh.ply.body.key)) mesh.object.visible = false;
    }
    this.ways = new Map(this.tools.map((mesh) => [mesh, this.wayOf(mesh.tool, settings)]));
    this.outlinedFor = null;
    this.prepare(this.wasFine);
  }

  /** Simplified unless nothing moves. */
  prepare(fine) {
    plane.on.value = this.cutOn ? 1 : 0;
    plane.at.value.copy(this.section3);
    if (this.wasFine !== fine) this.outlinedFor = null;
    this.wasFine = fine;
    this.fillPlies(fine);
    for (const mesh of this.tools) {
      const way = this.ways.get(mesh);
      if (!mesh.light) continue;
      mesh.solid.visible = fine && way === "solid";
      mesh.outline.visible = fine && way === "outlines";
      mesh.light.solid.visible = !fine && way === "solid";
      mesh.light.outline.visible = !fine && way === "outlines";
    }
  }

  /** While plies are turned, those that lie under another one of the same outline are not filled, and
   * of formed ones only so many, from the nearest, and the farthest: of the others one sees the edges. */
  fillPlies(fine) {
    const seen = new Set();
    let triangles = 0;
    const apart = this.plies.some((mesh) => mesh.object.position.z !== 0);
    const down = this.uniforms.towards_eye.value.z < 0;
    const order = (down ? this.plies : [...this.plies].reverse()).filter((mesh) => mesh.object.visible);
    order.forEach((mesh, i) => {
      const { shape } = mesh.ply;
      const more = triangles + mesh.ply.triangles.length / 3;
      const enough = i > 0 && i < order.length - 1 && more > MOST_FILLED;
      mesh.surface.visible = fine || apart || this.cutOn || !(enough || (shape !== undefined && seen.has(shape)));
      if (mesh.surface.visible) triangles = more;
      if (shape !== undefined) seen.add(shape);
    });
  }

  outlineTools(eye) {
    super.outlineTools(eye);
    for (const { light } of this.tools) {
      if (!light || !light.outline.visible) continue;
      light.outline.geometry.setAttribute("position",
        new THREE.BufferAttribute(light.tool.outlineSeen(eye), 3));
    }
  }

  setSection(settings, normal, offset) {
    this.cutOn = settings.section.on;
    this.section3.set(normal.x, normal.y, normal.z, offset);
    this.prepare(this.wasFine);
    this.section(settings);
  }

  /** What can be clicked: plies, and tools that are not hidden. */
  pickable() {
    const { x: nx, y: ny, z: nz, w } = this.section3;
    const keeps = (p) => !this.cutOn || p.x * nx + p.y * ny + p.z * nz <= w;
    const plies = this.plies.filter((mesh) => mesh.object.visible).map((mesh) => ({
      body: mesh.ply.body, x: this.x[this.plies.indexOf(mesh)], triangles: mesh.ply.triangles,
      lift: mesh.object.position.z, keeps, shift: [0, 0, 0] }));
    const tools = this.tools.filter((mesh) => this.ways.get(mesh) !== "hidden").map((mesh) => ({
      body: mesh.tool.body, x: mesh.tool.x, triangles: mesh.tool.triangles, lift: 0, keeps: (p) => keeps(p),
      shift: mesh.object.position.toArray(), solid: this.ways.get(mesh) === "solid" }));
    return { plies, tools };
  }

  dispose() {
    this.scene.traverse((part) => {
      if (part.geometry) part.geometry.dispose();
      if (part.material && part.material.dispose) part.material.dispose();
    });
    this.uniforms.scale.value.dispose();
  }
}
