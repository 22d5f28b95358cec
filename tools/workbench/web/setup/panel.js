// SPDX-License-Identifier: GPL-3.0-or-later
// The set-up of a case: its outline and forms, its scene, its text.

import { agreed } from "workbench/page/dialogue.js";
import { addFabric, askRun, newCase } from "workbench/setup/case_dialogues.js";
import { CaseFile, Latest } from "workbench/setup/case_file.js";
import { button, element, tell } from "workbench/page/elements.js";
import { Form } from "workbench/setup/form.js";
import { Imports } from "workbench/setup/imports.js";
import { Keys, itemOf } from "workbench/setup/keys_table.js";
import { Outline } from "workbench/setup/outline.js";
import { Problems, faultsAt, faultsBelow, faultsOf, faultsStill } from "workbench/setup/problems.js";
import { inFolder } from "workbench/setup/references.js";
import { SceneArea } from "workbench/scene/area.js";
import { ask, listen } from "workbench/page/server.js";
import { TomlEditor } from "workbench/setup/toml_editor.js";

/** What comes after, for who is here for the first time. */
function firstSteps() {
  return element("ol", { className: "first-steps" }, ...[
    ["Set-up", "plies, angles and tools, by forms or as text; a part (STEP, IGES, STL) dropped in becomes a tool"],
    ["Runs", "the plies move while the case is run; a run goes on when this page is closed"],
    ["Results", "report, several runs beside each other, exports for analysis, flat patterns"],
    ["Studies", "many runs of one case: friction, force, angles"],
    ["Identification", "a fabric's stiffnesses from measured curves"]].map(([name, words]) =>
    element("li", {}, element("b", { textContent: name }), `: ${words}`)));
}

/** A change as if it had been made the other way. */
const turned = (change) => change && { ...change, before: change.after, after: change.before };

class Setup {
  constructor(place) {
    this.place = place;
    this.files = new Map(); // fabric files that are shown
    this.faults = [];
    this.chosen = "case";
    this.folder = { cases: [], fabrics: [], files: [] };
    this.scene = null;
    const lost = () => this.main.lost();
    this.checked = new Latest(() => this.check(), lost);
    this.drawn = new Latest(() => this.draw(true), lost);
    this.drawnWhole = new Latest(() => this.draw(false), lost, 0);
    this.make();
    listen("case", (event) => this.heard(event));
    listen("again", () => this.again());
    listen("outlook", (event) => this.lookedAhead(event));
  }

  make() {
    const left = element("div", { className: "setup-left" });
    const middle = element("div", { className: "setup-middle" });
    this.textRoom = element("div", { className: "setup-text" });
    this.body = element("div", { className: "setup-body", hidden: true }, left, middle, this.textRoom);
    this.empty = element("div", { className: "setup-empty", hidden: true }, // until the folder is known
      element("h2", { textContent: "There is no case in this folder yet" }),
      element("p", { textContent: "A case says which plies are formed between which tools. Begin with a small " +
        "hemisphere that runs in seconds, or with one of the examples, and change it." }),
      this.newButton("New case…", { className: "main", id: "first-case" }), firstSteps());
    this.place.append(this.bar(), this.body, this.empty);
    this.outline = new Outline(left, this.work());
    this.form = new Form(left, this.work());
    this.area = new SceneArea(middle, { chosen: (key) => this.choose(key || "case"),
      turned: (key, angle, done) => this.turning(`${key}.angle`, angle, done) });
    this.problems = new Problems(element("div", { className: "problems" }), (fault) => this.point(fault));
    middle.append(this.problems.list.parentElement);
    this.editor = new TomlEditor(this.textRoom);
    this.imports = new Imports(this.place, this.work(), this.chooser);
    this.place.addEventListener("keydown", (event) => this.key(event));
  }

  newButton(text, properties) {
    return button(text, () => newCase(this.folder, (path) => this.opened(path)), properties);
  }

  bar() {
    this.cases = element("select", { id: "case-list", "aria-label": "Case" });
    this.cases.addEventListener("change", () => { location.hash = `#setup/${this.cases.value}`; });
    this.undo = button("Undo", () => this.back("undo"), { id: "undo", title: "Ctrl-Z" });
    this.redo = button("Redo", () => this.back("redo"), { id: "redo", title: "Ctrl-Shift-Z" });
    this.runIt = button("Run…", () => askRun(this.main.path, this.faults.some((one) => !one.warning)),
      { id: "run-case-button", className: "main of-case" });
    this.chooser = element("input", { type: "file", id: "add-files", multiple: true });
    this.withText = button("TOML", () => this.showText(this.textRoom.hidden),
      { id: "show-toml", "aria-pressed": "true", title: "The text of the file, beside the form" });
    this.barPlace = element("div", { className: "bar" }, this.cases, this.newButton("New…", { id: "new-case-button" }),
      this.undo, this.redo, element("span", { className: "gap" }),
      element("span", { className: "note of-case", textContent: "drop files here, or" }),
      element("label", { className: "as-button of-case", title: "STEP, IGES, STL, DXF, curves, fabrics" }, "Add files…",
        this.chooser), this.withText, this.runIt);
    return this.barPlace;
  }

  /** What outline, form and imports see of this. */
  work() {
    const setup = this;
    return {
      get keys() { return setup.keys; }, get main() { return setup.main; }, get folder() { return setup.folder; },
      get scene() { return setup.scene; }, shown: () => new Map([setup.main, ...setup.files.values()].map((file) =>
        [file, file.shown()])), get ofFabric() { return setup.ofFabric; }, tell,
      choose: (key) => setup.choose(key), fileOf: (path) => setup.fileOf(path),
      wrongAt: (key) => faultsAt(setup.faults, key),
      wrongBelow: (item) => faultsBelow(setup.faults, item, (key) => itemOf(setup.keys, key)),
      turning: (key, angle, done) => setup.turning(key, angle, done), refreshFolder: () => setup.refreshFolder(),
      addFabric: () => addFabric(setup.work()),
    };
  }

  async refreshFolder() {
    this.folder = await ask("folder");
    this.listCases();
    if (this.main && this.main.tree) this.form.show(this.chosen);
  }

  listCases() {
    const fabric = this.ofFabric ? [{ path: this.main.path }] : [];
    this.cases.replaceChildren(...[...(this.folder.cases || []), ...fabric].map(({ path, title }) =>
      element("option", { value: path, textContent: path, title: title || "" })));
    if (this.main) this.cases.value = this.main.path;
  }

  async opened(path) {
    await this.refreshFolder();
    location.hash = `#setup/${path}`;
  }

  /** Shows the case of a path, or the form and text of a fabric's file alone; without a path the case shown
   * last, or the first of the folder. */
  async open(path) {
    if (!this.keys) this.keys = new Keys(await ask("keys"));
    await this.refreshFolder();
    const cases = (this.folder.cases || []).map((one) => one.path);
    const wanted = path || (this.main && cases.includes(this.main.path) ? this.main.path : cases[0]);
    this.empty.hidden = Boolean(wanted);
    this.body.hidden = this.barPlace.hidden = !wanted;
    if (!wanted || (this.main && this.main.path === wanted)) return;
    Object.assign(this, { faults: [], answer: null, seen: {}, chosen: "case", scene: null, done: [], undone: [] });
    this.area.clear();
    this.problems.wait([]);
    this.files.clear();
    this.main = new CaseFile(wanted);
    this.ofFabric = (this.folder.fabrics || []).some((one) => one.path === wanted);
    this.place.classList.toggle("of-fabric", this.ofFabric);
    this.listCases();
    this.main.watch((file, by) => file === this.main && this.changed(by, file));
    this.fresh = true;
    this.body.classList.add("unread");
    await this.main.load();
    this.body.classList.remove("unread");
    this.editor.show(this.main);
  }

  /** The fabric file that the case names so, loaded when it is first asked for. */
  fileOf(name) {
    const path = inFolder(this.main.path, name);
    if (!path) return null;
    if (!this.files.has(path)) {
      const file = new CaseFile(path);
      this.files.set(path, file);
      file.watch((_, by) => this.changed(by, file));
      file.load().catch(tell);
    }
    return this.files.get(path);
  }

  /** Takes back, or does again, the last change of this page, in the case or in a fabric's file; before
   * these, changes of the case at other times. */
  async back(way) {
    const [from, to] = way === "undo" ? [this.done, this.undone] : [this.undone, this.done];
    const change = from.pop();
    try {
      if (change) await change.file.back(way, change);
      else if (!await this.stepped(way)) return;
      to.push(change || (way === "undo" ? turned(this.main.last) : this.main.last));
    } catch (problem) {
      if (change) from.push(change);
      throw problem;
    } finally {
      this.showBack();
    }
  }

  /** By the history of the file: what others have changed while this page was open is asked about. */
  async stepped(way) {
    if (this.main.foreign && !await agreed("step", way === "undo" ? "Undo" : "Redo", ["The last change of this file " +
      "was not made on this page, but by another page or program."], way === "undo" ? "Take it back" : "Do it again")) {
      return false;
    }
    await this.main.step(way);
    return Boolean(this.main.last);
  }

  showBack() {
    const off = (list, what) => list.length === 0 && !this.main[what];
    this.undo.disabled = off(this.done, "canUndo");
    this.redo.disabled = off(this.undone, "canRedo");
  }

  changed(by, file) {
    if ((by === "edit" || by === "text") && file.last) {
      this.done.push(file.last);
      this.undone = [];
    }
    this.showBack();
    if (!this.exists(this.chosen)) this.chosen = "case";
    if (by !== "refused" && this.main.version !== this.seen.version) this.forget();
    if (!this.ofFabric) this.outline.show(this.chosen);
    this.form.show(this.chosen);
    this.showFile();
    if (by === "refused" || this.ofFabric) return;
    this.drawn.ask();
  }

  /** Of what was said of the text before, what the change has made untrue. */
  forget() {
    this.faults = faultsStill(this.faults, this.seen.tree, this.main.tree);
    this.answer = null;
    this.seen = { version: this.main.version, tree: this.main.tree };
    this.problems.wait(this.faults);
    this.markLines();
    this.area.blame(this.faults, this.chosen);
  }

  exists(item) {
    const [first, second] = item.split(".");
    const group = this.main.tree[first];
    return second === undefined || (group && group[second] !== undefined);
  }

  /** A file has changed; `others`: versions of changed files that the case of this path names. */
  heard({ path, version, others = {} }) {
    const fabric = this.files.get(path);
    if (fabric) fabric.heard(version).catch(tell);
    if (!this.main || path !== this.main.path) return;
    this.main.heard(version).catch(tell);
    for (const [name, now] of Object.entries(others)) {
      const file = this.files.get(name);
      if (file && now) file.heard(now).catch(tell);
      else this.drawn.ask(); // a mesh, or a fabric that is not shown
    }
  }

  again() {
    if (!this.main) return;
    this.main.load().catch(tell);
    for (const file of this.files.values()) file.load().catch(tell);
  }

  async check() {
    const { main } = this;
    if (main.error || main.version === undefined) return; // or not loaded yet
    let answer;
    try {
      answer = await ask("check", { path: main.path, version: main.version });
    } catch (problem) {
      if (problem.code !== 409 && main === this.main) this.problems.fail(problem.message);
      throw problem;
    }
    if (main !== this.main || answer.version !== main.version) return;
    this.answer = answer;
    this.faults = faultsOf(answer);
    this.problems.show(answer, this.faults);
    this.outline.show(this.chosen);
    this.form.showWrong();
    this.markLines();
    this.area.blame(this.faults, this.chosen);
  }

  /** How long a run takes is known later than its mistakes. */
  lookedAhead({ path, version, outlook }) {
    if (!this.main || path !== this.main.path || version !== this.main.version || !this.answer) return;
    this.answer.outlook = outlook;
    this.problems.show(this.answer, this.faults);
  }

  markLines() {
    const name = this.editor.file && this.editor.file.path.split("/").pop();
    this.editor.mark(this.faults.filter((one) => one.line && (!one.file || one.file.split("/").pop() === name)));
  }

  /** First a draft, which the next edit need not wait for, then the whole scene. */
  async draw(draft) {
    const { main } = this;
    if (main.error) {
      this.area.old("the text is no TOML");
      return;
    }
    const asked = this.area.ask(main, this.fresh, draft);
    if (draft) asked.finally(() => this.checked.ask()).catch(() => {}); // the picture comes first
    const scene = await asked;
    if (!scene || main !== this.main) return;
    this.fresh = false;
    this.scene = scene;
    this.area.choose(this.chosen);
    this.area.blame(this.faults, this.chosen);
    if (scene.draft) this.drawnWhole.ask();
  }

  /** Chooses the item that a key belongs to. */
  choose(key) {
    const item = itemOf(this.keys, key);
    this.chosen = item;
    this.outline.show(item);
    this.form.show(item);
    this.form.fields.scrollTop = 0;
    this.area.choose(item);
    this.area.blame(this.faults, item);
    this.showFile();
    if (this.editor.file === this.main && item !== "case") this.editor.pointKey(item);
  }

  /** The text of the chosen item: that of a fabric's own file as soon as it is loaded. */
  showFile() {
    const [group, name] = this.chosen.split(".");
    const value = group === "fabrics" && this.main.tree.fabrics ? this.main.tree.fabrics[name] : null;
    const file = typeof value === "string" ? this.fileOf(value) : this.main;
    const shown = file && file.text !== undefined ? file : this.main;
    if (this.editor.file === shown) return;
    this.editor.show(shown);
    this.markLines();
  }

  /** Goes to what a mistake is about: its body, its key, its line. */
  point(fault) {
    if (fault.key) {
      this.choose(fault.key);
      this.form.point(fault.key, true);
    }
    if (fault.line) this.editor.point(fault.line);
  }

  /** A ply is being turned, by its handle or its dial. */
  turning(key, angle, done) {
    const ply = key.replace(/\.angle$/, "");
    this.area.view.turn(ply, angle);
    const input = [...this.form.fields.querySelectorAll("input[data-key]")].find((one) => one.dataset.key === key);
    if (input) input.value = String(angle);
    const wheel = this.form.fields.querySelector(".dial");
    if (wheel && wheel.dataset.dial === key) wheel.show(angle);
    if (done) this.main.edit([{ op: "set", key, value: angle }]).catch(tell);
    else this.area.instant.ask(this.main, { key, value: angle });
  }

  showText(on) {
    this.textRoom.hidden = !on;
    this.body.classList.toggle("without-text", !on);
    this.withText.setAttribute("aria-pressed", String(on));
    if (on) this.editor.mirror.refresh();
  }

  key(event) {
    const typing = /^(INPUT|TEXTAREA)$/.test(event.target.tagName) && event.target.type !== "range";
    if (!(event.ctrlKey || event.metaKey) || typing || !this.main) return;
    const back = event.key.toLowerCase() === "z" && !event.shiftKey;
    const forth = event.key.toLowerCase() === "y" || (event.key.toLowerCase() === "z" && event.shiftKey);
    if (!back && !forth) return;
    event.preventDefault();
    this.back(back ? "undo" : "redo").catch(tell);
  }
}

export const setupPanel = {
  word: "setup",
  title: "Set-up",
  show(place, rest) {
    if (!this.setup) this.setup = new Setup(place);
    window.plyform_setup = this.setup; // for tests
    return this.setup.open(rest);
  },
};
