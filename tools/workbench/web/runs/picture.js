// SPDX-License-Identifier: GPL-3.0-or-later
// The plies and tools of a run: as they are now while it goes on, and in each of its states. Before it has
// any, those of the fast run with coarse elements that looks where small ones are needed.

import { button, element, tell } from "workbench/page/elements.js";
import { unpacked } from "workbench/page/packed.js";
import { showShear } from "workbench/scene/shear.js";
import { SceneView } from "workbench/scene/view.js";
import { askBytes } from "workbench/page/server.js";

const PERIOD = 300; // ms, between two looks at a run that goes on
const VIEWS = [["oblique", "Oblique"], ["top", "Top"], ["front", "Front"], ["side", "Side"]];

/** Bodies of a picture of that run: it has meshes of its own, and no tools of many facets. */
function scoutBodies(state) {
  const empty = { x: new Float32Array(0), triangles: new Uint32Array(0) };
  return { plies: state.plies.map(({ name, x0, triangles }, i) => ({ name, key: `ply.${i}`, x: x0, triangles })),
    tools: state.tools.map((tool, i) => ({ ...empty, ...tool, key: `tool.${i}` })) };
}

/** How far a state is: its stroke, or the time where nothing has one. */
function reachedWords(state) {
  return state.stroke_mm || !state.time_s ? `${state.stroke_mm.toFixed(2)} mm of stroke`
    : `${(1e3 * state.time_s).toFixed(1)} ms`;
}

export class RunPicture {
  constructor() {
    this.run = null;
    this.scene = element("div", { className: "run-scene", id: "run-picture" });
    this.words = element("span", { id: "run-state-words" });
    this.slider = element("input",
      { id: "run-states", type: "range", min: 0, max: 0, step: 1, value: 0, "aria-label": "State" });
    this.slider.addEventListener("input", () => this.slide().catch(tell));
    this.play = button("Play", () => this.playAll(), { id: "run-play" });
    this.tools = element("select", { id: "run-tools", "aria-label": "Tools" }, ...["outlines", "solid", "hidden"].map(
      (value) => element("option", { value, textContent: `Tools ${value === "outlines" ? "as outlines" : value}` })));
    this.tools.addEventListener("change", () => this.view && this.view.change({ tools: this.tools.value }));
    const views = VIEWS.map(([word, text]) => button(text, () => this.view && this.view.seenFrom(word),
      { dataset: { view: word } }));
    this.legend = element("div", { className: "run-legend" });
    this.high = 10;
    this.place = element("section", { className: "run-picture", hidden: true, "aria-label": "Picture" }, this.scene,
      element("div", { className: "run-controls" }, this.play, this.slider, this.words),
      element("div", { className: "run-controls" }, ...views, this.tools, this.legend));
  }

  /** Shows another run, or the same in another state. */
  follow(run) {
    const other = !run || !this.run || run.folder !== this.run.folder;
    const was = this.run && this.run.state;
    this.run = run;
    if (other) this.clear();
    if (!run) return;
    this.news(run);
    if (!other && was === "running" && run.state !== "running") this.last().catch(tell);
  }

  clear() {
    this.bodies = null;
    this.whole = false; // bodies are those of the results
    this.step = -1;
    this.following = true;
    this.high = 10;
    this.place.hidden = true;
    for (const key of ["state", "step", "moved", "scouting"]) delete this.scene.dataset[key];
    clearTimeout(this.timer);
    this.timer = null;
  }

  /** Of how many states there are. */
  news(run) {
    this.run = run;
    if (run.state === "damaged" || run.state === "queued") return;
    this.slider.max = Math.max(0, run.states - 1);
    if (run.states && !this.whole && !this.beginning) this.begin().catch((problem) => this.failed(problem));
    if (run.state === "running" && !this.timer) this.again();
  }

  /** A run may have been removed, or begun anew, between two questions. */
  failed(problem) {
    if (problem.code !== 404 && problem.code !== 409 && problem.code !== 422) tell(problem);
  }

  async begin() {
    const { folder } = this.run;
    this.beginning = true;
    try {
      const bodies = unpacked(await askBytes("runs/bodies", { folder }));
      if (!this.run || this.run.folder !== folder) return;
      this.bodies = bodies;
      this.whole = true;
      this.step = -1;
      delete this.scene.dataset.scouting;
      this.slider.max = Math.max(Number(this.slider.max), bodies.count - 1);
      this.display(bodies, this.place.hidden);
    } finally {
      this.beginning = false;
    }
    await this.last();
    if (this.run && this.run.state === "running") this.again();
  }

  display(bodies, fit) {
    this.place.hidden = false;
    if (!this.view) this.view = new SceneView(this.scene, { changed: ({ tools }) => { this.tools.value = tools; } });
    this.view.show(bodies, fit);
  }

  again() {
    clearTimeout(this.timer);
    this.timer = setTimeout(async () => {
      try {
        await (this.whole ? this.look() : this.lookAtScout());
      } catch (problem) {
        this.failed(problem);
      }
      this.timer = null;
      if (this.run && this.run.state === "running") this.again();
    }, PERIOD);
  }

  /** What the run looks like now. */
  async look() {
    if (!this.following || !this.place.offsetParent) return; // nobody sees it
    const { folder } = this.run;
    const bytes = await askBytes("runs/picture", { folder, after: this.step });
    if (!bytes.byteLength || !this.run || this.run.folder !== folder || !this.following) return;
    const state = unpacked(bytes);
    if (state.scouting) return; // the last of them, not replaced yet
    this.step = state.step;
    this.draw(state, `now: ${reachedWords(state)}`);
    this.scene.dataset.step = state.step;
  }

  /** What the run before the run looks like now. */
  async lookAtScout() {
    const { folder } = this.run;
    const bytes = await askBytes("runs/picture", { folder, after: this.step });
    if (!bytes.byteLength || !this.run || this.run.folder !== folder || this.whole) return;
    const state = unpacked(bytes);
    if (!state.scouting) return;
    const { dataset } = this.scene;
    if (dataset.scouting !== String(state.scouting)) {
      this.bodies = scoutBodies(state);
      this.display(this.bodies, this.place.hidden);
      dataset.scouting = state.scouting;
    }
    this.step = state.step;
    const large = this.bodies.tools.some((tool) => !tool.x.length) ? "; tools of many facets are not drawn yet" : "";
    this.draw(state, `a fast run with coarse elements: ${reachedWords(state)}${large}`);
  }

  async last() {
    this.following = true;
    await this.state(-1);
    this.slider.value = this.slider.max;
  }

  async slide() {
    const number = Number(this.slider.value);
    this.following = this.run.state === "running" && number === Number(this.slider.max);
    await this.state(number);
  }

  /** Shows a state; the one asked for last, however long others took. */
  async state(number) {
    if (!this.whole) return;
    const { folder } = this.run;
    this.wanted = number;
    const state = unpacked(await askBytes("runs/state", { folder, number }));
    if (!this.run || this.run.folder !== folder || this.wanted !== number) return;
    this.draw(state, `state ${state.number + 1} of ${state.count}: ${reachedWords(state)}`);
    this.slider.max = state.count - 1;
    this.scene.dataset.state = state.number;
  }

  async playAll() {
    for (let k = 0; k <= Number(this.slider.max) && this.whole; ++k) {
      this.slider.value = k;
      await this.slide();
      await new Promise((go) => { setTimeout(go, 100); });
    }
  }

  draw(state, words) {
    const { plies, tools } = this.bodies;
    if (state.plies.some((ply, i) => !plies[i] || ply.x.length !== plies[i].x.length)) {
      this.clear(); // of another run in the same folder
      this.begin().catch((problem) => this.failed(problem));
      return;
    }
    let moved = 0;
    state.plies.forEach((ply, i) => {
      for (let k = 0; k < ply.x.length; ++k) moved = Math.max(moved, Math.abs(ply.x[k] - plies[i].x[k]));
      for (const angle of ply.field) this.high = Math.max(this.high, 5 * Math.ceil(Math.abs(angle) / 5));
    });
    showShear(this.view, this.legend, state.plies, this.high);
    state.tools.forEach((tool, i) => tools[i] && this.view.shift(i, tool.shift));
    this.words.textContent = words;
    this.scene.dataset.moved = moved.toFixed(6);
    this.scene.dataset.drawn = Number(this.scene.dataset.drawn || 0) + 1;
  }
}
