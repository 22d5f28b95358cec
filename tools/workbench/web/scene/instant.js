// SPDX-License-Identifier: GPL-3.0-or-later
// The shear that each ply would have when it is formed, alone and at once, in a corner of the scene: drawn
// anew while a hand turns a ply, and after each edit. Nothing is computed while it is closed.

import { button, element, tell } from "workbench/page/elements.js";
import { unpacked } from "workbench/page/packed.js";
import { askBytes, send } from "workbench/page/server.js";
import { showShear } from "workbench/scene/shear.js";
import { SceneView } from "workbench/scene/view.js";

const PATIENCE = 700; // ms that an older question may still take before a newer one ends it
const TOGETHER = 30; // ms in which what a hand does is one question: it presses and then moves
const short = (value) => Number(value.toFixed(1)).toString();

export class InstantShear {
  constructor(place) {
    this.scene = element("div", { className: "instant-scene", id: "instant-picture" });
    this.words = element("span", { id: "instant-words", role: "status" });
    this.legend = element("div", { className: "run-legend" });
    this.toggle = button("instant shear", () => this.open(this.box.hidden), {
      id: "instant-open", "aria-pressed": "false",
      title: "Shear of each ply when formed alone, in a second; it follows a ply that is turned" });
    this.box = element("section", { className: "instant", hidden: true, "aria-label": "Instant shear" },
      element("div", { className: "bar" }, this.words, element("span", { className: "gap" }),
        button("Run a draft", () => this.run().catch(tell), { id: "instant-run",
          title: "All plies together, to some 3 degrees" }),
        button("×", () => this.open(false), { id: "instant-close", "aria-label": "Close instant shear" })),
      this.scene, this.legend);
    place.append(this.box);
    this.asked = 0; // questions so far
    this.wanted = null;
    this.only = "";
  }

  open(on) {
    this.box.hidden = !on;
    this.toggle.setAttribute("aria-pressed", String(on));
    if (on && this.file) this.ask(this.file);
  }

  /** Another case, or none. */
  clear() {
    this.asked += 1; // answers on their way are not for it
    this.since = 0;
    this.file = this.wanted = this.keys = null;
    this.words.textContent = "";
  }

  /** Shows a ply alone, or all for what is none. */
  choose(item) {
    this.only = item.startsWith("ply.") ? item : "";
    if (this.keys) this.show();
  }

  show() {
    const others = this.only ? this.keys.filter((key) => key !== this.only) : [];
    this.view.change({ marks: false, hidden: new Set(others.length < this.keys.length ? others : []) });
  }

  /** Of a version of a case; `change`: { key, value } that it has not yet. The newest question is answered. */
  ask(file, change = {}) {
    this.file = file;
    if (this.box.hidden) return;
    this.wanted = { path: file.path, version: file.version, ...change };
    const free = !this.since || performance.now() - this.since > PATIENCE;
    if (free && !this.timer) this.timer = setTimeout(() => this.next().catch(tell), TOGETHER);
  }

  async next() {
    clearTimeout(this.timer);
    this.timer = 0;
    const query = this.wanted;
    if (!query || this.box.hidden) return;
    this.wanted = null;
    const number = ++this.asked;
    this.since = performance.now();
    try {
      const state = unpacked(await askBytes("instant", query));
      if (number === this.asked) this.draw(state, query);
    } catch (problem) {
      if (problem.code === 500) throw problem;
      if (number !== this.asked || problem.code === 409) return;
      this.words.textContent = `no instant shear: ${problem.message}`;
    } finally {
      if (number === this.asked) {
        this.since = 0;
        if (this.wanted) this.next().catch(tell);
      }
    }
  }

  draw(state, query) {
    const first = !this.view;
    if (first) this.view = new SceneView(this.scene);
    this.view.show({ plies: state.plies.map((ply) => ({ ...ply, x: ply.x0 })) }, first); // meshes may be others
    this.keys = state.plies.map(({ key }) => key);
    this.show();
    const highs = state.plies.map((ply) => ply.p99_deg);
    showShear(this.view, this.legend, state.plies, Math.max(5, 5 * Math.ceil(Math.max(...highs) / 5)));
    const turned = query.key ? `at ${short(query.value)}: ` : "";
    const told = this.keys.includes(this.only) ? this.keys.indexOf(this.only) : highs.indexOf(Math.max(...highs));
    this.words.textContent = `${turned}${state.plies[told].name}, shear angles to ${short(highs[told])}° (99 %), ` +
      `known to some ${short(state.told_deg)}°`;
    Object.assign(this.scene.dataset, { drawn: Number(this.scene.dataset.drawn || 0) + 1,
      value: query.key ? query.value : "" });
  }

  /** The case as it is, all plies together. */
  async run() {
    const { about } = await send("runs", { case: this.file.path, accuracy: "draft" });
    window.location.hash = `#runs/${about.output}`;
  }
}
