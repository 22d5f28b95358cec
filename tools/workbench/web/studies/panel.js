// SPDX-License-Identifier: GPL-3.0-or-later
// Studies: those of the folder, and of one its form, its start, and what it has found.

import { ask, listen, send } from "workbench/page/server.js";
import { button, element, labelled, select, tell } from "workbench/page/elements.js";
import { StudyForm } from "workbench/studies/form.js";
import { madeUpon } from "workbench/page/upon.js";
import { StudyResults, countsInWords } from "workbench/studies/table.js";

const LIVE = ["queued", "starting", "running"];
const PAUSE = 500; // ms after a change until it is checked

function clock(seconds) {
  if (seconds < 0.95) return "less than a second";
  if (seconds < 90) return `about ${Math.round(seconds)} s`;
  return seconds < 5400 ? `about ${Math.round(seconds / 60)} min` : `about ${(seconds / 3600).toFixed(1)} h`;
}

class Studies {
  constructor() {
    this.word = "studies";
    this.base = { text: "" };
    this.drafts = new Map();
    this.title = "Studies";
  }

  build(place) {
    this.list = element("ul", { id: "study-list", role: "list" });
    this.name = element("input", { id: "new-study-name", "aria-label": "name of the new study", placeholder: "friction",
      size: 14 });
    this.cases = select([["", "choose a case"]], "", { id: "new-study-case", "aria-label": "case of the new study" });
    const make = button("Make it", () => this.make(), { id: "new-study" });
    this.heading = element("h2", { id: "study-heading" });
    this.form = new StudyForm(element("div", { id: "study-form" }), () => this.open(this.rest));
    this.text = element("textarea", { id: "study-text", rows: 16, spellcheck: false,
      "aria-label": "text of the study file" });
    this.textPart = element("details", {}, element("summary", { textContent: "The file" }), this.text,
      button("Save the text", () => this.saveText(), { id: "study-text-save" }));
    this.startPart = element("div", { id: "study-start" });
    this.results = new StudyResults(element("div", { id: "study-results" }));
    this.none = element("p", { className: "note", textContent: "A study runs one case many times with other values " +
      "of some of its keys (friction, a force, an angle), gathers the figures of all in a table, and draws where " +
      "limits are kept. Give it a name and a case at the left." });
    this.setup = element("details", { id: "study-setup", open: true },
      element("summary", { textContent: "What is run" }), this.form.place, this.textPart);
    this.body = element("div", { hidden: true }, this.heading, this.setup, this.startPart, this.results.place);
    place.append(element("div", { className: "two-parts" },
      element("nav", { "aria-label": "Studies of this folder" }, this.list,
        element("div", { className: "make" }, element("b", { textContent: "New study" }),
          labelled("Name", this.name), labelled("Case", this.cases), make)),
      element("div", { className: "part" }, this.none, this.body)));
    this.buildStart();
    for (const kind of ["process", "study", "folder", "again"]) listen(kind, (event) => this.happened(kind, event));
  }

  buildStart() {
    this.told = element("p", { id: "study-told", role: "status" });
    this.mistakes = element("ul", { id: "study-mistakes", className: "bad" });
    this.jobs = element("input", { id: "study-jobs", type: "number", min: 1, value: 1, size: 3 });
    this.threads = element("input", { id: "study-threads", type: "number", min: 1, value: 1, size: 3 });
    this.again = element("input", { id: "study-again", type: "checkbox" });
    this.jobs.addEventListener("change", () => this.check());
    this.go = button("Start", () => this.start(), { id: "study-go", className: "main" });
    this.stop = button("Stop", () => send(`processes/${this.record.id}/stop`), { id: "study-stop" });
    this.draw = button("Pictures of what has ended", () => send("study/picture_now", { path: this.study.path }),
      { id: "study-draw" });
    this.last = element("p", { id: "study-last", className: "note" });
    this.startPart.append(this.told, this.mistakes, element("div", { className: "fields" },
      labelled("Runs at a time", this.jobs), labelled("Threads of each", this.threads),
      element("label", { className: "box" }, this.again, " repeat those that failed"), this.go, this.stop,
      this.draw), this.last);
  }

  async show(place, rest) {
    if (!this.list) this.build(place);
    await this.fill();
    if (rest) await this.open(rest);
    this.body.hidden = !rest;
    this.none.hidden = Boolean(rest);
  }

  async fill() {
    const [studies, cases] = await Promise.all([ask("studies"), ask("study/cases")]);
    const chosen = this.cases.value;
    this.cases.replaceChildren(element("option", { value: "", textContent: "choose a case" }),
      ...cases.map((path) => element("option", { value: path, textContent: path })));
    this.cases.value = cases.includes(chosen) ? chosen : cases.length === 1 ? cases[0] : "";
    this.list.replaceChildren(...studies.map((one) => element("li", {}, element("a", {
      href: `#studies/${one.path || one.output}`, textContent: one.title, dataset: { study: one.path || one.output } }),
    element("span", { className: "note", textContent: ` ${one.state}${Object.keys(one.counts).length
      ? `, ${countsInWords(one.counts)}` : ""}` }))));
    if (!studies.length) this.list.append(element("li", { className: "note", textContent: "There is no study yet." }));
  }

  async make() {
    if (!this.name.value || !this.cases.value) throw new Error("Give a name, and choose the case");
    const { path } = await send("studies", { name: this.name.value, case: this.cases.value });
    this.name.value = "";
    tell(null);
    location.hash = `#studies/${path}`;
  }

  /** A study file, or a folder of results without one. */
  async open(rest) {
    const file = rest.endsWith(".toml");
    const study = file ? await ask("study", { path: rest }) : null;
    const another = this.rest !== rest;
    if (study && another) this.setup.open = !Object.keys(study.counts).length;
    this.rest = rest;
    this.study = study;
    this.heading.textContent = study && study.plan ? study.plan.title || rest : rest;
    for (const part of [this.setup, this.startPart]) part.hidden = !file;
    if (study) {
      if (another) this.changeText(study);
      else if (this.text.value === this.base.text) this.showText(study); // else what is typed stays
      await this.form.show(study);
      this.check();
    }
    this.body.hidden = false;
    const output = study ? study.output : rest;
    await this.results.show(output, (data) => this.state(data));
  }

  /** Buttons by what the study does now. */
  state(data) {
    this.record = data.record && LIVE.includes(data.record.state) ? data.record : null;
    const live = LIVE.includes(data.state);
    const begun = Object.keys(data.counts).length > 0;
    this.go.hidden = live;
    this.go.textContent = begun ? "Go on" : "Start";
    this.stop.hidden = !this.record;
    this.draw.hidden = live || !data.counts.missing || Object.keys(data.counts).length < 2;
    if (data.record && data.record.state === "failed" && !live) this.tellEnd(data.record);
  }

  async tellEnd(record) {
    if (this.ended === record.id) return;
    this.ended = record.id;
    const { log } = await ask(`processes/${record.id}`);
    this.last.textContent = log.trim().split("\n").slice(-3).join(" ");
  }

  /** Counts the runs and asks plyform about every value, a moment after the last change. */
  check() {
    clearTimeout(this.waiting);
    const { path } = this.study;
    this.waiting = setTimeout(async () => {
      this.told.textContent = "Runs are counted and values checked …";
      this.checked = this.checking(path);
      await this.checked;
    }, PAUSE);
  }

  async checking(path) {
    const number = (this.number || 0) + 1;
    this.number = number;
    let found;
    try {
      found = await ask("study/check", { path, jobs: this.jobs.value });
    } catch (problem) {
      found = { runs: 0, mistakes: [{ line: 0, words: problem.message }] };
    }
    if (number !== this.number) return;
    this.mistakes.replaceChildren(...found.mistakes.map((one) => element("li", {
      textContent: one.line ? `line ${one.line}: ${one.words}` : one.words })));
    const left = found.runs - found.missing;
    this.told.textContent = found.mistakes.length ? "It cannot start like this:"
      : `${found.runs} run${found.runs === 1 ? "" : "s"}${left ? `, ${left} of them have ended` : ""}${found.missing
        ? `; ${clock(found.estimate_s)} for ${left ? "the others" : "all"}, each ${clock(found.of_one_s)}` : ""}`;
    this.told.dataset.runs = found.runs;
    this.go.disabled = found.mistakes.length > 0;
  }

  async start() {
    this.last.textContent = "";
    await send("study/start", { path: this.study.path, jobs: Number(this.jobs.value),
      threads: Number(this.threads.value), again: this.again.checked });
    tell(null);
    this.setup.open = false; // the table is to be seen
    await this.results.look();
  }

  /** What is typed is a change of this text. */
  showText({ path, text, version }) {
    this.text.value = text;
    this.base = { path, text: this.text.value, version }; // with ends of lines as the page has them
  }

  /** What has been typed in the text of one study is there again when it is shown again. */
  changeText(study) {
    if (this.text.value !== this.base.text) this.drafts.set(this.base.path, { text: this.text.value, base: this.base });
    this.showText(study);
    const draft = this.drafts.get(study.path);
    if (draft) Object.assign(this, { base: draft.base }).text.value = draft.text;
    this.drafts.delete(study.path);
  }

  async saveText() {
    const { path } = this.study;
    const text = this.text.value;
    const made = await madeUpon(this.base, (wish) => send("study/text", { ...wish, path, text }, { method: "PUT" }));
    tell(null);
    if (this.text.value === text && made) this.showText(made);
    await this.open(this.rest);
  }

  happened(kind, event) {
    if (kind === "process" && event.record.kind !== "study") return;
    if (kind === "process" && this.study && event.record.about.study === this.study.path) {
      this.last.textContent = event.last || "";
      this.results.look().catch(() => {});
      if (!LIVE.includes(event.record.state)) this.check();
    }
    clearTimeout(this.filling);
    this.filling = setTimeout(() => this.fill().catch(() => {}), PAUSE);
    const typing = this.body.contains(document.activeElement) && document.activeElement.tagName !== "BUTTON";
    if (kind === "study" && this.study && event.path === this.study.path && !typing) this.open(this.rest).catch(tell);
  }
}

export const studiesPanel = new Studies();
