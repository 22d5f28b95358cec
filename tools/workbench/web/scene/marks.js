// SPDX-License-Identifier: GPL-3.0-or-later
// What is written and drawn over the picture: call-outs with a line to their place, the measure, and a
// handle that turns a ply. All of it follows the camera.

import { element } from "workbench/page/elements.js";

const THREE = window.THREE;
const SVG = "http://www.w3.org/2000/svg";
const ROW = 19; // px, of a call-out

function drawing(kind, properties = {}) {
  const made = document.createElementNS(SVG, kind);
  for (const [name, value] of Object.entries(properties)) made.setAttribute(name, value);
  return made;
}

const round = (value) => Number(value.toFixed(Math.abs(value) < 10 ? 2 : 1)).toString();

export class Marks {
  constructor(place) {
    this.lines = drawing("g");
    this.knobs = drawing("g"); // stay where they are, or a pointer that holds one would lose it
    this.svg = drawing("svg", { class: "marks" });
    this.svg.append(this.lines, this.knobs);
    this.texts = element("div", { className: "callouts" });
    place.append(this.texts, this.svg); // the handle lies above the call-outs
    this.callouts = [];
    this.measured = [];
    this.handle = null;
  }

  /** Call-outs { at: Vector3, text, kind: "gap"|"contact"|"wrong", key }. */
  set(callouts, clicked) {
    this.callouts = callouts;
    this.texts.replaceChildren(...callouts.map((one) => {
      const made = element("button", { type: "button", className: `callout ${one.kind}`, textContent: one.text,
        title: one.title || one.text, dataset: { key: one.key || "" } });
      made.addEventListener("click", () => clicked(one.key));
      return made;
    }));
  }

  /** Distance of two points, Vector3, as it is written beside the line. */
  measureWords() {
    if (this.measured.length < 2) return "";
    const d = this.measured[1].clone().sub(this.measured[0]);
    return `${round(d.length())} mm   dx ${round(d.x)}  dy ${round(d.y)}  dz ${round(d.z)}`;
  }

  /** Puts all of it where the camera sees its place: `pixel(Vector3)` within the picture. */
  draw(pixel, width, height) {
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const parts = [...this.drawCallouts(pixel, width, height), ...this.drawMeasure(pixel)];
    if (this.handle) parts.push(...this.handle.draw(pixel));
    this.lines.replaceChildren(...parts);
  }

  /** The handle of a ply, or none. */
  setHandle(handle) {
    this.handle = handle;
    this.knobs.replaceChildren(...(handle ? [handle.knob] : []));
  }

  drawCallouts(pixel, width, height) {
    const buttons = [...this.texts.children];
    const places = this.callouts.map((one) => pixel(one.at));
    const order = places.map((_, i) => i).sort((i, j) => places[i].y - places[j].y);
    let free = 8;
    const lines = [];
    order.forEach((i, rank) => {
      const least = height - 30 - ROW * (order.length - rank);
      const y = Math.max(free, Math.min(places[i].y - ROW / 2, least));
      free = y + ROW;
      buttons[i].style.top = `${Math.round(y)}px`;
      const x = width - 12 - (buttons[i].offsetWidth || 120);
      lines.push(drawing("path", { class: this.callouts[i].kind,
        d: `M${x} ${y + ROW / 2}H${x - 10}L${places[i].x} ${places[i].y}` }),
      drawing("circle", { class: this.callouts[i].kind, cx: places[i].x, cy: places[i].y, r: 3 }));
    });
    return lines;
  }

  drawMeasure(pixel) {
    const ends = this.measured.map(pixel);
    const parts = ends.map((end) => drawing("circle", { class: "measure", cx: end.x, cy: end.y, r: 4 }));
    if (ends.length < 2) return parts;
    const [a, b] = ends;
    const text = drawing("text", { class: "measure", x: 0.5 * (a.x + b.x) + 8, y: 0.5 * (a.y + b.y) - 6 });
    text.textContent = this.measureWords();
    return [drawing("path", { class: "measure", d: `M${a.x} ${a.y}L${b.x} ${b.y}` }), text, ...parts];
  }
}

/** A round handle at the end of a ply's first yarn direction, in the plane of the ply. */
export class AngleHandle {
  /** `turned(angle, done)`: degrees, while it is dragged and when it is let go. */
  constructor(middle, radius, angle, rayAt, turned) {
    Object.assign(this, { middle, radius, angle, rayAt, turned });
    this.knob = drawing("circle", { class: "handle", r: 7, "data-handle": "angle", tabindex: 0, role: "slider",
      "aria-label": "Angle of the ply" });
    this.knob.addEventListener("pointerdown", (event) => this.grip(event));
    this.knob.addEventListener("pointermove", (event) => this.drag(event));
    this.knob.addEventListener("pointerup", (event) => this.drop(event));
    this.knob.addEventListener("keydown", (event) => this.key(event));
  }

  end() {
    const a = (this.angle * Math.PI) / 180;
    return new THREE.Vector3(Math.cos(a), Math.sin(a), 0).multiplyScalar(this.radius).add(this.middle);
  }

  draw(pixel) {
    const [from, to] = [pixel(this.middle), pixel(this.end())];
    const path = [];
    for (let k = 0; k <= 72; ++k) {
      const a = (k * Math.PI) / 36;
      const at = pixel(new THREE.Vector3(Math.cos(a), Math.sin(a), 0).multiplyScalar(this.radius).add(this.middle));
      path.push(`${k ? "L" : "M"}${at.x.toFixed(1)} ${at.y.toFixed(1)}`);
    }
    this.knob.setAttribute("cx", to.x);
    this.knob.setAttribute("cy", to.y);
    this.knob.setAttribute("aria-valuenow", this.angle);
    const text = drawing("text", { class: "handle", x: to.x + 11, y: to.y - 8 });
    text.textContent = `${round(this.angle)}°`;
    return [drawing("path", { class: "handle ring", d: path.join("") }),
      drawing("path", { class: "handle", d: `M${from.x} ${from.y}L${to.x} ${to.y}` }), text];
  }

  /** Angle under the pointer, to whole degrees, to multiples of 15 with shift. */
  angleOf(event) {
    const ray = this.rayAt(event.clientX, event.clientY);
    if (Math.abs(ray.direction.z) < 0.02) return this.angle;
    const along = (this.middle.z - ray.origin.z) / ray.direction.z;
    const at = ray.origin.clone().addScaledVector(ray.direction, along).sub(this.middle);
    const step = event.shiftKey ? 15 : 1;
    return step * Math.round(((Math.atan2(at.y, at.x) * 180) / Math.PI) / step);
  }

  grip(event) {
    event.stopPropagation();
    this.held = true;
    this.knob.setPointerCapture(event.pointerId);
  }

  drag(event) {
    if (!this.held) return;
    this.angle = this.angleOf(event);
    this.turned(this.angle, false);
  }

  drop() {
    if (!this.held) return;
    this.held = false;
    this.turned(this.angle, true);
  }

  key(event) {
    const step = { ArrowLeft: 1, ArrowUp: 1, ArrowRight: -1, ArrowDown: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    this.angle += event.shiftKey ? 15 * step : step;
    this.turned(this.angle, true);
  }
}
