// SPDX-License-Identifier: GPL-3.0-or-later
// The report as a whole: settings, what follows from them, what is shown.

import { fieldsOf, has, nodalValuesOf, valuesOf } from "plyform/fields.js";
import { Difference } from "plyform/difference.js";
import { firstMet } from "plyform/pick.js";
import { Ply } from "plyform/ply.js";
import { plane } from "plyform/shaders.js";
import { planeOf } from "plyform/section.js";
import { showProbe, valueAt } from "plyform/probe.js";
import { Stage } from "plyform/stage.js";
import { Tool } from "plyform/tool.js";
import { View } from "plyform/view.js";

const THREE = window.THREE;

function runOf(data) {
  const run = { ...data };
  run.plies = data.plies.map((ply) => new Ply(run, ply));
  run.tools = data.tools.map((tool) => new Tool(run, tool));
  return run;
}

export class Report {
  constructor(data, page) {
    this.page = page;
    this.runs = data.runs.map(runOf);
    this.allFields = fieldsOf(data.columns);
    const [first] = this.runs;
    this.settings = {
      state: first.reached.length - 1, field: "shear", colours: "viridis", steps: 0, low: null,
      high: null, limit: null, yarns: 0, apart: 0, hidden: new Set(), tools: "outlines",
      section: { on: false, level: false, angle: 0, offset: 0 }, flatPly: first.plies.length - 1,
      difference: false, differenceOf: 1, follow: true, // differenceOf: the run that A is taken from
    };
    this.probe = null;
    this.watchers = [];
    this.busy = Promise.resolve();
  }

  async load() {
    for (const run of this.runs) {
      await Promise.all([...run.plies, ...run.tools].map((body) => body.load()));
    }
    this.stage = new Stage(this.page.canvas);
    this.box = new THREE.Box3();
    for (const run of this.runs) {
      for (const ply of run.plies) {
        for (const x of [ply.flat, ply.places.state(run.reached.length - 1)]) {
          this.box.union(new THREE.Box3().setFromArray(x));
        }
      }
    }
    this.stage.camera.fit(this.box);
    this.differencesToA = this.runs.map((run, r) => (r ? new Difference(this.runs[0], run) : null));
    this.settings.limit = this.usualLimit();
    this.makeViews();
    await this.show(["all"]);
    this.stage.draw();
  }

  makeViews() {
    this.runs.forEach((run, r) => {
      this.stage.views.push(new View(this.page.views.formed[r], run, "formed"));
      this.stage.views.push(new View(this.page.views.flat[r], run, "flat"));
    });
    if (this.difference) {
      for (const [kind, element] of Object.entries(this.page.views.difference)) {
        this.stage.views.push(new View(element, this.runs[0], kind));
      }
    }
    for (const view of this.stage.views) {
      const clicked = (event) => this.click(view, event.clientX, event.clientY);
      if (view.flat) view.element.addEventListener("click", clicked);
      else this.stage.camera.listen(view.element, clicked);
    }
  }

  /** Of the run that is set, to A; none of one run alone. */
  get difference() {
    return this.differencesToA[this.settings.differenceOf];
  }

  /** State of each run: that of the first, and of others the nearest one. */
  states() {
    const reached = this.runs[0].reached[this.settings.state];
    return this.runs.map((run, r) => {
      if (r === 0) return this.settings.state;
      const off = run.reached.map((one) => Math.abs(one - reached));
      return off.lastIndexOf(Math.min(...off));
    });
  }

  /** The state that is nearest to a stroke or time. */
  goTo(reached) {
    const off = this.runs[0].reached.map((one) => Math.abs(one - reached));
    return this.change({ state: off.indexOf(Math.min(...off)) });
  }

  /** Changes settings; the promise is kept when the picture shows them. */
  change(patch) {
    Object.assign(this.settings, patch);
    if ("field" in patch) Object.assign(this.settings, { low: null, high: null, limit: this.usualLimit() });
    const keys = Object.keys(patch);
    this.busy = this.busy.then(() => this.show(keys));
    return this.busy;
  }

  usualLimit() {
    const angles = this.runs.flatMap((run) => run.plies.map((ply) => ply.data.locking_angle)).filter(Boolean);
    return this.settings.field === "shear" && angles.length ? Math.min(...angles) : null;
  }

  /** The field that is set. */
  field() {
    return this.allFields.find((field) => field.id === this.settings.field);
  }

  /** Those that any ply has. */
  fields() {
    return this.allFields.filter((field) => this.runs.some((run) => run.plies.some((ply) => has(ply, field))));
  }

  async show(keys) {
    const changed = (...names) => keys.includes("all") || names.some((name) => keys.includes(name));
    const { settings, stage } = this;
    const states = this.states();
    const stateOf = (view) => states[this.runs.indexOf(view.run)];
    if (changed("state")) stage.views.forEach((view) => view.move(stateOf(view)));
    if (changed("state", "field", "difference", "differenceOf")) await this.colour();
    this.findScale(changed("state", "field", "difference", "low", "high", "hidden"));
    for (const view of stage.views) {
      const scale = view.difference ? this.differenceScale() : this.scale;
      view.paint(scale, settings);
      view.arrange(settings);
    }
    const { normal, offset } = planeOf(settings.section, this.box);
    plane.on.value = settings.section.on ? 1 : 0;
    plane.at.value.set(normal.x, normal.y, normal.z, offset);
    stage.views.forEach((view) => view.section(settings));
    stage.probe = this.probe;
    if (this.probe) await this.tellProbe();
    this.page.show(this);
    stage.request();
    this.watchers.forEach((watcher) => watcher(states));
  }

  async colour() {
    const field = this.field();
    const zero = (ply) => ({ of: "node", values: new Float32Array(ply.flat.length / 3) });
    this.values = await Promise.all(this.runs.map((run, r) => Promise.all(run.plies.map(
      (ply) => (has(ply, field) ? valuesOf(ply, field, this.states()[r]) : zero(ply))))));
    for (const view of this.stage.views) {
      const r = this.runs.indexOf(view.run);
      if (view.difference) continue;
      view.plies.forEach((mesh, i) => mesh.colour(this.values[r][i]));
    }
    if (!this.difference) return;
    const [stateA, stateB] = [0, this.settings.differenceOf].map((r) => this.states()[r]);
    this.differences = await Promise.all(this.difference.pairs.map(async ([a, b], i) => {
      if (!b || !has(a, field) || !has(b, field)) return zero(a);
      return this.difference.values(i, await nodalValuesOf(a, field, stateA), await nodalValuesOf(b, field, stateB));
    }));
    for (const view of this.stage.views.filter((one) => one.difference)) {
      view.plies.forEach((mesh, i) => mesh.colour(this.differences[i]));
    }
  }

  /** The scale that is set, where it is; else from the values of the plies that are shown. */
  findScale(anew) {
    const { settings } = this;
    const field = this.field();
    if (anew) {
      const range = [Infinity, -Infinity];
      this.values.forEach((run, r) => run.forEach(({ values }, i) => {
        if (settings.hidden.has(this.runs[r].plies[i].name)) return;
        for (const value of values) {
          if (value < range[0]) range[0] = value;
          if (value > range[1]) range[1] = value;
        }
      }));
      this.range = range[0] <= range[1] ? range : [0, 1];
    }
    let [low, high] = this.range;
    if (field.signed) [low, high] = [-Math.max(-low, high), Math.max(-low, high)];
    else if (low >= 0 && field.scale !== "whole") low = 0;
    if (high <= low) high = low + (field.signed ? 1 : 1e-3);
    if (settings.low !== null) ({ low } = settings);
    if (settings.high !== null) ({ high } = settings);
    this.scale = { low, high, limit: settings.limit, steps: settings.steps,
      colours: field.signed ? "diverging" : settings.colours };
  }

  differenceScale() {
    let most = 0;
    for (const { values } of this.differences) for (const value of values) most = Math.max(most, Math.abs(value));
    this.differenceRange = most || 1e-3;
    return { low: -this.differenceRange, high: this.differenceRange, limit: null,
      steps: this.settings.steps, colours: "diverging" };
  }

  /** What lies under a point of the window. */
  under(view, x, y) {
    const met = firstMet(this.stage.ray(view, x, y), view.surfaces());
    return met ? { run: this.runs.indexOf(view.run), index: met.surface.index, triangle: met.triangle,
      weights: met.weights } : null;
  }

  click(view, x, y) {
    const probe = this.under(view, x, y);
    return this.setProbe(probe);
  }

  setProbe(probe) {
    this.probe = probe;
    return this.change(probe ? { flatPly: probe.index } : {});
  }

  /** Shows a triangle that a text speaks of. */
  point(ply, triangle, run) {
    const hidden = new Set(this.settings.hidden);
    hidden.delete(this.runs[run].plies[ply].name);
    this.probe = { run, index: ply, triangle, weights: [1 / 3, 1 / 3, 1 / 3] };
    return this.change({ hidden, flatPly: ply, state: this.runs[0].reached.length - 1 });
  }

  tellProbe() {
    return showProbe(this.page.probe, this.runs[this.probe.run], this.probe, this.states()[this.probe.run],
      this.allFields);
  }

  /** Value of the field shown at a place, for the hint beside the cursor. */
  hint(probe) {
    const ply = this.runs[probe.run].plies[probe.index];
    const field = this.field();
    if (!has(ply, field)) return null;
    return valueAt(ply, field, this.states()[probe.run], probe);
  }
}
