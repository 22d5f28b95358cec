// SPDX-License-Identifier: GPL-3.0-or-later
// A picture of plies and tools: before a run as they are set up, and while they are being formed.

import { firstMet } from "plyform/pick.js";
import { planeOf } from "plyform/section.js";
import { Stage } from "plyform/stage.js";
import { Bodies } from "workbench/scene/bodies.js";
import { arrowOf, boundaryParts } from "workbench/scene/boundary_marks.js";
import { element } from "workbench/page/elements.js";
import { AngleHandle, Marks } from "workbench/scene/marks.js";

const THREE = window.THREE;
export const VIEW_KEYS = { 1: "oblique", 2: "top", 3: "front", 4: "side", 5: "bottom" };
const TOOL_WAYS = ["outlines", "solid", "hidden"];

/** A round number near a 40th of the size: mm between the yarns that are drawn. */
function yarnSpacing(size) {
  const ten = 10 ** Math.floor(Math.log10(Math.max(size / 40, 1e-3)));
  return [1, 2, 5, 10].map((k) => k * ten).find((step) => step >= size / 40);
}

function boxOf(scene) {
  const box = new THREE.Box3();
  for (const ply of scene.plies || []) if (ply.x) box.union(new THREE.Box3().setFromArray(ply.x));
  const room = box.isEmpty() ? null
    : box.clone().expandByScalar(0.15 * box.getSize(new THREE.Vector3()).length());
  for (const tool of scene.tools || []) { // no farther than that: a plane may be a thousand times wider
    if (!tool.x || !tool.x.length) continue;
    const one = new THREE.Box3().setFromArray(tool.x);
    if (room) one.intersect(room);
    if (!one.isEmpty()) box.union(one);
  }
  return box.isEmpty() ? new THREE.Box3(new THREE.Vector3(-100, -100, -100), new THREE.Vector3(100, 100, 100)) : box;
}

/** A shift at a share of the duration, between the places that are known. */
function shiftAt({ shares, shifts }, share) {
  if (!shares || !shifts || !shares.length) return [0, 0, 0];
  let k = 0;
  while (k < shares.length - 2 && shares[k + 1] < share) ++k;
  const next = Math.min(k + 1, shares.length - 1);
  const wide = shares[next] - shares[k];
  const part = wide > 0 ? Math.min(1, Math.max(0, (share - shares[k]) / wide)) : 0;
  return [0, 1, 2].map((c) => shifts[3 * k + c] + part * (shifts[3 * next + c] - shifts[3 * k + c]));
}

export class SceneView {
  /**
   * Fills `place`, an element of any size. `acts`: chosen(key) when a body or call-out is clicked ("" beside
   * all), measured(words), changed(settings), turned(key, degrees, done) by the handle of a chosen ply.
   */
  constructor(place, acts = {}) {
    this.place = place;
    this.acts = { chosen() {}, measured() {}, changed() {}, turned() {}, ...acts };
    place.classList.add("scene-view");
    const canvas = element("canvas", { "aria-hidden": "true" });
    this.pane = element("div", { className: "scene-pane", tabIndex: 0, role: "application", "aria-label":
      "Plies and tools: arrow keys turn, shift and arrow keys move, plus and minus zoom, 1 to 5 and 0 views, " +
      "t tools, m measures" });
    place.append(canvas, this.pane);
    this.marks = new Marks(place);
    this.stage = new Stage(canvas);
    this.stage.drawn = () => this.drawMarks();
    this.stage.camera.listen(this.pane, (event) => this.click(event));
    this.pane.addEventListener("keydown", (event) => this.key(event));
    this.settings = { tools: "outlines", hidden: new Set(), yarns: 0, apart: 0, marks: true, measure: false,
      section: { on: false, level: false, angle: 0, offset: 0 } };
    this.share = 0;
    this.states = () => null;
    new ResizeObserver(() => this.stage.request()).observe(place);
  }

  /** Shows a scene as api/scene and unpacked() give it: { plies, tools, boundaries }. The camera stays
   * where it is unless `fit`, or nothing was shown before. */
  show(scene, fit = false) {
    const before = this.bodies;
    this.box = boxOf(scene);
    this.bodies = new Bodies(this.pane, scene);
    this.stage.views = [this.bodies];
    if (before) before.dispose();
    this.addMarks(scene);
    const { fitted } = this.stage.camera;
    this.box.getCenter(fitted.target);
    fitted.radius = 0.5 * this.box.getSize(new THREE.Vector3()).length();
    if (fit || !before) {
      this.stage.camera.fit(this.box);
      this.settings.yarns = yarnSpacing(this.box.getSize(new THREE.Vector3()).length());
      this.acts.changed(this.settings);
    }
    this.plain = true;
    this.update();
  }

  addMarks(scene) {
    const parts = (scene.boundaries || []).flatMap((one) => boundaryParts(one, scene.plies || [], this.box));
    parts.forEach((part) => this.bodies.extra.add(part));
    this.arrows = this.bodies.tools.map((mesh) => arrowOf(mesh.tool.body, this.box));
    this.arrows.forEach((arrow, i) => arrow && this.bodies.tools[i].object.add(arrow));
  }

  /** Changes settings: tools (solid, outlines, hidden), hidden (keys), yarns (mm, 0: none), apart (mm),
   * marks, measure, section { on, level, angle, offset }. */
  change(patch) {
    Object.assign(this.settings, patch);
    if ("measure" in patch) {
      this.marks.measured = [];
      this.pane.classList.toggle("measuring", this.settings.measure);
    }
    this.update();
    this.acts.changed(this.settings);
  }

  /** Tools at a share of their programme, 0 to 1. */
  at(share) {
    this.share = share;
    this.placeTools();
    this.update();
  }

  placeTools() {
    for (const { tool } of this.bodies.tools) tool.shift = shiftAt(tool.body, this.share);
  }

  update() {
    const { bodies, settings } = this;
    if (!bodies) return;
    if (this.plain) {
      this.placeTools();
      bodies.paintPlain(settings, this.states);
    } else {
      bodies.paintYarns(settings);
    }
    bodies.markStates(this.states);
    bodies.arrange(settings);
    bodies.extra.visible = settings.marks;
    this.arrows.forEach((arrow, i) => {
      if (arrow) arrow.visible = settings.marks && bodies.ways.get(bodies.tools[i]) !== "hidden";
    });
    const { normal, offset } = planeOf(settings.section, this.box);
    bodies.setSection(settings, normal, offset);
    this.stage.request();
  }

  /** Where the nodes of a ply are now, mm. */
  move(i, x) {
    const mesh = this.bodies.withMesh(i);
    this.bodies.x[i] = x;
    mesh.move(x);
    this.stage.request();
  }

  /** How far a tool has gone, mm. */
  shift(i, vector) {
    this.plain = false;
    this.bodies.tools[i].tool.shift = vector;
    this.bodies.tools[i].object.position.fromArray(vector);
    this.bodies.outlinedFor = null;
    this.stage.request();
  }

  /** Colours a ply by values of its nodes or triangles, as { of, values } or as they are, on a scale
   * { low, high, colours, steps, limit } that all plies share; without values: plain again. */
  colour(i, values, scale) {
    const mesh = this.bodies.withMesh(i);
    if (!values) {
      this.plain = true;
      this.bodies.fill(i);
      this.update();
      return;
    }
    this.plain = false;
    const of = values.of || (values.length === mesh.ply.triangles.length / 3 ? "triangle" : "node");
    mesh.colour({ of, values: ArrayBuffer.isView(values) ? values : values.values }); // arrays have values(), too
    this.bodies.paint({ colours: "viridis", steps: 0, limit: null, ...scale }, this.settings);
    this.bodies.paintYarns(this.settings);
    this.stage.request();
  }

  /** `states(key)` of a body: "chosen", "wrong" or null. */
  mark(states) {
    this.states = states;
    this.update();
  }

  /** Call-outs { at: [x, y, z], text, kind, key, tool: the name of the one that they move with }. */
  callOut(list) {
    this.marks.set(list.map((one) => ({ ...one, at: new THREE.Vector3().fromArray(one.at) })),
      (key) => this.acts.chosen(key));
    this.stage.request();
  }

  /** A handle that turns the yarns of a ply, or none. */
  handle(key) {
    const { handle } = this.marks;
    if (handle && handle.held && this.handleOf === key) return; // it is being dragged
    const mesh = key === null ? null : this.bodies && this.bodies.plies.find((one) => one.ply.body.key === key);
    this.handleOf = mesh ? key : null;
    this.marks.setHandle(null);
    if (mesh) {
      const box = new THREE.Box3().setFromArray(mesh.ply.flat);
      const size = box.getSize(new THREE.Vector3());
      this.marks.setHandle(new AngleHandle(box.getCenter(new THREE.Vector3()), 0.42 * Math.min(size.x, size.y),
        mesh.ply.body.angle_deg || 0, (x, y) => this.stage.ray(this.bodies, x, y), (angle, done) => {
          this.turn(key, angle);
          this.acts.turned(key, angle, done);
        }));
    }
    this.drawMarks();
    this.stage.request();
  }

  /** Shows the yarns of a ply at another angle, degrees. */
  turn(key, angle) {
    const i = this.bodies.plies.findIndex((one) => one.ply.body.key === key);
    if (i < 0) return;
    const { body } = this.bodies.plies[i].ply;
    const by = ((angle - (body.angle_deg || 0)) * Math.PI) / 180;
    const turned = ([x, y, z]) => [x * Math.cos(by) - y * Math.sin(by), x * Math.sin(by) + y * Math.cos(by), z];
    body.families = Object.fromEntries(Object.entries(body.families || {}).map(([name, way]) => [name, turned(way)]));
    body.angle_deg = angle;
    this.bodies.turnYarns(i);
    if (this.marks.handle && this.handleOf === key) this.marks.handle.angle = angle;
    this.update();
  }

  drawMarks() {
    if (!this.bodies) return;
    const frame = this.place.getBoundingClientRect();
    const pixel = (point) => {
      const at = this.stage.pixelOf(this.bodies, point);
      return { x: at.x - frame.left, y: at.y - frame.top };
    };
    this.marks.texts.hidden = !this.settings.marks;
    if (frame.width > 1) this.marks.draw(pixel, frame.width, frame.height);
  }

  /** The body and point under a place of the window: { body, point } or null. Solid tools hide plies;
   * outlined ones are met where no ply is. */
  under(x, y) {
    const { plies, tools } = this.bodies.pickable();
    const ray = this.stage.ray(this.bodies, x, y);
    const met = (surfaces) => surfaces.map((surface) => {
      const own = ray.clone();
      own.origin.sub(new THREE.Vector3().fromArray(surface.shift));
      const found = firstMet(own, [{ ...surface, keeps: (p) => surface.keeps(
        p.clone().add(new THREE.Vector3().fromArray(surface.shift))) }]);
      return found && { ...found, surface };
    }).filter(Boolean).sort((a, b) => a.distance - b.distance)[0];
    const first = met([...plies, ...tools.filter((tool) => tool.solid)]) || met(tools);
    if (!first) return null;
    const point = ray.origin.clone().addScaledVector(ray.direction, first.distance);
    return { body: first.surface.body, point: this.snapped(first.surface, point) };
  }

  /** The node of the body that is nearest to a point if that is less than 8 pixels, else the point. */
  snapped(surface, point) {
    const { x, shift, lift } = surface;
    const [px, py, pz] = [point.x - shift[0], point.y - shift[1], point.z - shift[2] - lift];
    let [best, square] = [-1, (8 * this.stage.camera.millimetres) ** 2];
    for (let i = 0; i < x.length; i += 3) {
      const far = (x[i] - px) ** 2 + (x[i + 1] - py) ** 2 + (x[i + 2] - pz) ** 2;
      if (far < square) [best, square] = [i, far];
    }
    if (best < 0) return point;
    return new THREE.Vector3(x[best] + shift[0], x[best + 1] + shift[1], x[best + 2] + shift[2] + lift);
  }

  click(event) {
    if (!this.bodies) return;
    const found = this.under(event.clientX, event.clientY);
    if (!this.settings.measure) {
      this.acts.chosen(found ? found.body.key || found.body.name : "");
      return;
    }
    if (!found) return;
    if (this.marks.measured.length > 1) this.marks.measured = [];
    this.marks.measured.push(found.point);
    this.acts.measured(this.marks.measureWords());
    this.stage.request();
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { tools, measure } = this.settings;
    if (VIEW_KEYS[event.key]) this.stage.camera.set(VIEW_KEYS[event.key]);
    else if (event.key === "0") this.home();
    else if (event.key === "t") this.change({ tools: TOOL_WAYS[(TOOL_WAYS.indexOf(tools) + 1) % 3] });
    else if (event.key === "m") this.change({ measure: !measure });
    else return;
    event.preventDefault();
  }

  /** Diagonal of what is shown, mm. */
  size() {
    return this.box ? this.box.getSize(new THREE.Vector3()).length() : 1;
  }

  home() {
    if (this.box) this.stage.camera.fit(this.box);
  }

  seenFrom(name) {
    this.stage.camera.set(name);
  }
}
