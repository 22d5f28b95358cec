// SPDX-License-Identifier: GPL-3.0-or-later
// The form of a study file: what varies, which figures, which limits. Each change is saved at once.

import { ask, send } from "workbench/page/server.js";
import { button, element, labelled, select, tell } from "workbench/page/elements.js";
import { madeUpon } from "workbench/page/upon.js";
import { KeyChooser } from "workbench/studies/keys.js";

export const METHODS = [
  ["one at a time", "one at a time: the case, and each value with all else as the case has it"],
  ["grid", "grid: every combination of the values"],
  ["list", "list: the first values together, then the second ones"],
  ["latin hypercube", "Latin hypercube: runs drawn from the ranges"],
  ["sobol", "Sobol: runs drawn from the ranges; more of them keep the former ones"]];
const DRAWN = ["latin hypercube", "sobol"];
const ACCURACIES = [["", "as the case has it"], ["draft", "draft"], ["standard", "standard"],
  ["reference", "reference"]];
const ALWAYS = [{ name: "largest_shear_deg", words: "largest shear angle of any ply, °" }];
const PICTURES = { window: ["x", "y"], map: ["x", "y", "figure"], scatter: ["x", "y"] };

/** Values as they are typed: 0.1, 0.2 or [0, 45], [0, 90] or words. Throws Error. */
export function valuesIn(text) {
  try {
    return JSON.parse(`[${text}]`);
  } catch (problem) {
    if (/[[\]{}"]/.test(text)) throw new Error(`"${text}" are no values: write 0.1, 0.2 or [0, 45], [0, 90]`);
    return text.split(",").map((word) => word.trim()).filter(Boolean).map((word) =>
      (Number.isFinite(Number(word)) ? Number(word) : word));
  }
}

export const written = (values) => (values || []).map((value) =>
  (typeof value === "string" && !/[",[\]{}]/.test(value) ? value : JSON.stringify(value))).join(", ");

function numberIn(text, words) {
  const value = Number(text.replace(",", "."));
  if (text.trim() === "" || !Number.isFinite(value)) throw new Error(`${words}: "${text}" is no number`);
  return value;
}

export class StudyForm {
  /** `changed()` is called after each change that is saved. */
  constructor(place, changed) {
    Object.assign(this, { place, changed, waiting: [], busy: Promise.resolve() });
    this.own = new Map(); // what the changes of this page have made, by the version before
    this.chooser = new KeyChooser((key) => this.told(() => this.addVary(key)));
  }

  async show(study) {
    const another = !this.study || this.study.path !== study.path;
    if (another) this.waiting = [];
    this.study = study;
    this.plan = study.plan && Object.assign(study.plan, ...this.waiting);
    if (another || this.case !== study.case) {
      this.case = study.case;
      this.known = study.case ? await ask("study/keys", { case: study.case }) : { keys: [], figures: [] };
    }
    this.draw();
  }

  /** Saves what has been changed of the plan as it was shown, upon what the change before has made. */
  async save(change) {
    const { study } = this;
    Object.assign(this.plan, change);
    this.waiting.push(change);
    const done = this.busy.then(async () => {
      let base = study;
      while (this.own.has(base.version)) base = this.own.get(base.version);
      try {
        const made = await madeUpon(base, (wish) => send("study", { ...wish, path: study.path, plan: change },
          { method: "PUT" }));
        if (made && !made.merged && made.version !== base.version) this.own.set(base.version, made);
      } finally {
        this.waiting = this.waiting.filter((one) => one !== change);
      }
      await this.changed();
    });
    this.busy = done.catch(() => {});
    await done;
  }

  draw() {
    const { plan } = this;
    if (!plan) {
      this.place.replaceChildren(element("p", { className: "bad", textContent: this.study.error }));
      return;
    }
    this.place.replaceChildren(this.general(), this.varied(), this.figures(), this.limits(), this.pictures());
    if (plan.other.length) {
      this.place.append(element("p", { className: "note",
        textContent: `Beside these the file has ${plan.other.join(", ")}: see its text.` }));
    }
  }

  input(id, value, act, properties = {}) {
    const text = value === undefined || value === null ? "" : String(value);
    const made = element("input", { id, value: text, autocomplete: "off", ...properties });
    made.addEventListener("change", () => this.told(() => act(made.value)));
    return made;
  }

  /** What is typed wrong is told beside the form, and nothing is saved. */
  async told(act) {
    try {
      await act();
      tell(null);
    } catch (problem) {
      if (problem.code === 409) await this.changed();
      tell(problem);
    }
  }

  /** `change(value)`: what of the plan it changes. */
  chosen(id, choices, value, change) {
    const made = select(choices, value || choices[0][0], { id });
    made.addEventListener("change", () => this.told(() => this.save(change(made.value))));
    return made;
  }

  /** Runs that are drawn want a range of each key, the others values. */
  withMethod(method) {
    const drawn = DRAWN.includes(method);
    const vary = (this.plan.vary || []).map((one) => {
      if (one.range) return { ...one, count: drawn ? undefined : one.count || 3 };
      const entry = this.known.keys.find((known) => known.key === one.key);
      return drawn ? { ...one, ...this.otherKind(one, "range", entry), names: undefined, count: undefined } : one;
    });
    return { method, vary, runs: drawn ? this.plan.runs || 20 : null, seed: drawn ? this.plan.seed : null };
  }

  general() {
    const { plan } = this;
    const drawn = DRAWN.includes(plan.method);
    const parts = [
      labelled("Title", this.input("study-title", plan.title, (text) => this.save({ title: text }))),
      labelled("Runs", this.chosen("study-method", METHODS, plan.method, (method) => this.withMethod(method))),
      labelled("Accuracy", this.chosen("study-accuracy", ACCURACIES, plan.accuracy, (accuracy) => ({ accuracy })))];
    if (drawn) {
      parts.push(labelled("Number of runs", this.input("study-runs", plan.runs, (text) =>
        this.save({ runs: numberIn(text, "number of runs") }), { inputMode: "numeric" })));
      parts.push(labelled("Seed of the draws", this.input("study-seed", plan.seed === undefined ? 1 : plan.seed,
        (text) => this.save({ seed: numberIn(text, "seed") }), { inputMode: "numeric" })));
    }
    return element("div", { className: "fields" }, ...parts);
  }

  varied() {
    const rows = (this.plan.vary || []).map((one, i) => this.varyRow(one, i));
    return element("fieldset", { id: "study-vary" }, element("legend", { textContent: "What varies" }),
      ...(rows.length ? rows : [element("p", { className: "note", textContent: "Choose a key below." })]),
      this.chooser.shown(this.known.keys, !rows.length));
  }

  varyRow(one, i) {
    const key = one.key || one.each || (one.keys || []).join(" ");
    const entry = this.known.keys.find((known) => known.key === key);
    const range = Boolean(one.range);
    const kind = select([["values", "values"], ["factors", "factors of its value"], ["range", "from, to"]],
      range ? "range" : one.factors ? "factors" : "values",
      { "aria-label": `how ${key} varies`, id: `vary-${i}-kind` });
    kind.addEventListener("change", () => this.told(() => this.change(i, this.otherKind(one, kind.value, entry))));
    const parts = [
      this.input(`vary-${i}-name`, one.name || key, (text) => this.change(i, { name: text }),
        { "aria-label": "name of the column" }),
      element("code", { textContent: key }), kind];
    if (range) parts.push(...this.rangeInputs(one, i));
    else {
      const list = one.factors ? "factors" : "values";
      parts.push(this.input(`vary-${i}-values`, written(one[list]), (text) =>
        this.change(i, { [list]: valuesIn(text) }), { "aria-label": `values of ${key}, parted by commas`, size: 26 }));
    }
    if (entry) {
      parts.push(element("span", { className: "note", title: entry.meaning,
        textContent: `${entry.unit ? `${entry.unit}; ` : ""}the case has ${written([entry.value])}` }));
    }
    parts.push(button("Remove", () => this.save({ vary: this.plan.vary.filter((_, k) => k !== i) }),
      { id: `vary-${i}-remove`, "aria-label": `remove ${key}` }));
    return element("div", { className: "vary", dataset: { key } }, ...parts);
  }

  rangeInputs(one, i) {
    const end = (k) => this.input(`vary-${i}-${k ? "to" : "from"}`, one.range[k], (text) => this.change(i, {
      range: one.range.map((value, at) => (at === k ? numberIn(text, k ? "to" : "from") : value)) }),
    { "aria-label": k ? "to" : "from", size: 8 });
    const scale = select([["linear", "evenly"], ["log", "evenly in the logarithm"]], one.scale || "linear",
      { id: `vary-${i}-scale`, "aria-label": "scale" });
    scale.addEventListener("change", () => this.told(() => this.change(i, {
      scale: scale.value === "log" ? "log" : undefined })));
    const parts = [end(0), "to", end(1), scale];
    if (!DRAWN.includes(this.plan.method)) {
      const act = (text) => this.change(i, { count: numberIn(text, "count") });
      parts.push(this.input(`vary-${i}-count`, one.count, act, { "aria-label": "number of values", size: 3 }),
        "values");
    }
    return parts;
  }

  /** The same key given in another way. */
  otherKind(one, kind, entry) {
    const own = entry && typeof entry.value === "number" ? entry.value : 1;
    const none = { values: undefined, factors: undefined, range: undefined, count: undefined, scale: undefined };
    if (kind === "range") {
      const numbers = (one.values || []).filter((value) => typeof value === "number");
      const low = numbers.length > 1 ? Math.min(...numbers) : 0.5 * own;
      const high = numbers.length > 1 ? Math.max(...numbers) : 1.5 * own || 1;
      return { ...none, range: [low, high], count: DRAWN.includes(this.plan.method) ? undefined : 3 };
    }
    return kind === "factors" ? { ...none, factors: [0.5, 1, 2] } : { ...none, values: [own] };
  }

  change(i, change) {
    const vary = this.plan.vary.map((one, k) => (k === i ? { ...one, ...change } : one));
    return this.save({ vary });
  }

  async addVary(entry) {
    const drawn = DRAWN.includes(this.plan.method);
    const own = entry.value;
    const steps = typeof own === "number" && own !== 0
      ? [0.8, 1, 1.2].map((k) => Number((k * own).toPrecision(4))) : [own];
    const name = `${entry.key.split(".").slice(-2).join(" ")}${entry.unit ? `, ${entry.unit}` : ""}`;
    const one = { name, key: entry.key, note: entry.meaning };
    if (drawn) one.range = typeof own === "number" && own !== 0 ? [steps[0], steps[2]].sort((a, b) => a - b) : [0, 1];
    else one.values = steps;
    await this.save({ vary: [...(this.plan.vary || []), one] });
  }

  figures() {
    const chosen = this.plan.figures || {};
    const offered = this.known.figures.filter((one) => !Object.values(chosen).includes(one.path));
    const own = Object.entries(chosen).map(([name, path]) => {
      const known = this.known.figures.find((one) => one.path === path);
      return this.figureBox(name, path, known ? known.words : "", true);
    });
    const name = element("input", { id: "figure-name", size: 14, "aria-label": "name of another figure",
      placeholder: "name" });
    const path = element("input", { id: "figure-path", size: 34, "aria-label": "path in summary.json",
      placeholder: "max plies.*.max_shear_deg" });
    const add = button("Add", () => this.save({ figures: { ...chosen, [name.value]: path.value } }),
      { id: "figure-add" });
    return element("fieldset", { id: "study-figures" },
      element("legend", { textContent: "Figures: columns of the table" }), ...own,
      ...offered.map((one) => this.figureBox(one.name, one.path, one.words, false)),
      element("div", { className: "vary" }, "Another: ", name, path, add));
  }

  figureBox(name, path, words, on) {
    const box = element("input", { type: "checkbox", checked: on, id: `figure-${name}` });
    box.addEventListener("change", () => this.told(() => {
      const figures = { ...(this.plan.figures || {}) };
      const limits = { ...(this.plan.limits || {}) };
      if (box.checked) figures[name] = path;
      else {
        delete figures[name];
        delete limits[name];
      }
      return this.save(box.checked ? { figures } : { figures, limits });
    }));
    return element("label", { className: "box" }, box, ` ${name} `,
      element("span", { className: "note", textContent: words || path, title: path }));
  }

  limits() {
    const limits = this.plan.limits || {};
    const names = [...new Set([...ALWAYS.map((one) => one.name), ...Object.keys(this.plan.figures || {}),
      ...Object.keys(limits)])];
    const rows = names.map((name) => {
      const own = typeof limits[name] === "number" ? { at_most: limits[name] } : limits[name] || {};
      const end = (key, words) => this.input(`limit-${name}-${key}`, own[key], (text) => {
        const next = { ...own, [key]: text.trim() === "" ? undefined : numberIn(text, `${name}, ${words}`) };
        if (next[key] === undefined) delete next[key];
        const all = { ...limits, [name]: next };
        if (next.at_most === undefined && next.at_least === undefined) delete all[name];
        return this.save({ limits: all });
      }, { "aria-label": `${name} ${words}`, size: 8 });
      return element("div", { className: "vary" }, element("code", { textContent: name }), "at least",
        end("at_least", "at least"), "at most", end("at_most", "at most"));
    });
    return element("fieldset", { id: "study-limits" },
      element("legend", { textContent: "Limits: within them a run is good" }), ...rows);
  }

  pictures() {
    const keys = (this.plan.vary || []).map((one) => one.name || one.key);
    const columns = [...new Set(["largest_shear_deg", ...Object.keys(this.plan.figures || {})])];
    const own = this.plan.picture || [];
    const rows = own.map((one, i) => element("div", { className: "vary" }, element("code", { textContent: one.kind }),
      Object.entries(one).filter(([key]) => key !== "kind").map(([key, value]) => `${key}: ${value}`).join(", "),
      button("Remove", () => this.save({ picture: own.filter((_, k) => k !== i) }),
        { id: `picture-${i}-remove`, "aria-label": `remove the picture ${one.kind}` })));
    const add = Object.keys(PICTURES).map((kind) => button(
      { window: "Add a process window", map: "Add a map", scatter: "Add a scatter plot" }[kind],
      () => this.addPicture(kind, keys, columns), { id: `picture-add-${kind}`,
        title: kind === "window" ? "where all limits are kept: needs two keys and a limit" : "" }));
    return element("fieldset", { id: "study-pictures" }, element("legend", { textContent: "Pictures" }), ...rows,
      element("div", { className: "vary" }, ...add));
  }

  addPicture(kind, keys, columns) {
    if (kind !== "scatter" && keys.length < 2) throw new Error("This picture has two keys: let two vary");
    if (kind === "window" && !Object.keys(this.plan.limits || {}).length) {
      throw new Error("A process window is where limits are kept: give a limit first");
    }
    const own = this.plan.picture || [];
    const used = own.filter((one) => one.kind === kind).length;
    const one = { kind, x: keys[0] || columns[0], y: kind === "scatter" ? columns[columns.length - 1] : keys[1] };
    if (kind === "map") one.figure = columns[columns.length - 1];
    if (used) one.file = `${kind}_${used + 1}.png`;
    return this.save({ picture: [...own, one] });
  }
}
