// SPDX-License-Identifier: GPL-3.0-or-later
// Identification: from measured curves to a fabric file, by plyform identify.

import { ask, listen, send } from "workbench/page/server.js";
import { button, element, labelled, select, tell } from "workbench/page/elements.js";
import { eachOf, uploaded } from "workbench/page/uploads.js";
import { IdentifyCurves } from "workbench/identify/curves.js";
import { IdentifyResult } from "workbench/identify/result.js";

const LIVE = ["queued", "starting", "running"];
const CURVES = "curves"; // folder for files that are dropped in

class Identify {
  constructor() {
    this.word = "identify";
    this.title = "Identification";
  }

  async build(place) {
    this.tests = await ask("identify/tests");
    this.test = select(this.tests.map((one) => [one.word, one.title]), this.tests[0].word, { id: "identify-test" });
    this.test.addEventListener("change", () => this.changeTest());
    this.what = element("p", { id: "identify-what", className: "note" });
    this.sizes = element("div", { id: "identify-sizes", className: "fields" });
    this.corrections = element("div", { className: "fields" });
    this.curves = new IdentifyCurves();
    this.fabric = select([], "", { id: "identify-fabric" });
    this.output = element("input", { id: "identify-output", size: 20, placeholder: "new_fabric.toml" });
    this.start_ = labelled("Fabric to start from (all else is kept)", this.fabric);
    this.written = labelled("", this.output);
    this.replace = element("input", { id: "identify-replace", type: "checkbox" });
    this.output.addEventListener("change", () => { this.replace.checked = false; }); // another one is another question
    this.go = button("Identify", () => this.start(), { id: "identify-go", className: "main" });
    this.stop = button("Stop", () => send(`processes/${this.number}/stop`), { id: "identify-stop", hidden: true });
    this.result = new IdentifyResult();
    this.before = element("ul", { id: "identify-before", role: "list" });
    place.append(element("div", { className: "two-parts" },
      element("nav", { "aria-label": "Identifications so far" }, this.drop(),
        element("h3", { textContent: "So far" }), this.before),
      element("div", { className: "part" }, ...this.parts(), this.result.place)));
    this.changeTest();
    listen("process", (event) => this.happened(event.record));
    for (const kind of ["again", "folder"]) listen(kind, () => this.fill().catch(tell));
  }

  parts() {
    return [
      element("div", { className: "fields" }, labelled("Test", this.test)), this.what, this.sizes, this.curves.place,
      element("details", { id: "identify-more" },
        element("summary", { textContent: "Law, rows that count, what the machine adds" }), this.corrections),
      element("div", { className: "fields" }, this.start_, this.written,
        element("label", { className: "box" }, this.replace, " may replace a file"), this.go, this.stop)];
  }

  /** Where files are dropped, or chosen. */
  drop() {
    const input = element("input", { id: "identify-upload", type: "file", multiple: true, accept: ".csv,.txt,.dat,.tsv",
      "aria-label": "files of measured curves" });
    const place = element("div", { id: "identify-drop", className: "drop" },
      element("p", { textContent: "Drop files of curves here (CSV), or choose them:" }), input);
    const take = async (files) => {
      tell(null);
      await eachOf(files, async (file) => {
        const sent = await uploaded(file, CURVES);
        if (!sent) return;
        await this.fill();
        await this.curves.add(sent.path);
      }).catch(tell);
    };
    input.addEventListener("change", async () => {
      await take([...input.files]);
      input.value = ""; // the same file may be chosen again
    });
    place.addEventListener("dragover", (event) => event.preventDefault());
    place.addEventListener("drop", (event) => {
      event.preventDefault();
      take([...event.dataTransfer.files]); // which are gone after the drop
    });
    return place;
  }

  /** `rest`: empty, the number of an identification, or curve/PATHS of files to begin with, a line each. */
  async show(place, rest) {
    if (!this.test) {
      this.building = this.building || this.build(place);
      await this.building;
    }
    await this.fill();
    if (/^\d+$/.test(rest)) await this.open(rest);
    else if (rest.startsWith("curve/")) for (const path of rest.slice(6).split("\n")) await this.curves.add(path);
  }

  async fill() {
    const [files, records] = await Promise.all([ask("identify/files"), ask("processes", { kind: "identify" })]);
    this.curves.offer(files.curves);
    const chosen = this.fabric.value;
    this.fabric.replaceChildren(...["", ...files.fabrics].map((path) =>
      element("option", { value: path, textContent: path || "– fabric file –" })));
    this.fabric.value = files.fabrics.includes(chosen) ? chosen : "";
    this.before.replaceChildren(...records.reverse().map((one) => element("li", {},
      element("a", { href: `#identify/${one.id}`, textContent: one.about.output }),
      element("span", { className: "note", textContent: ` ${one.about.test}, ${one.state}` }))));
    if (!records.length) this.before.append(element("li", { className: "note", textContent: "Nothing yet." }));
  }

  chosen() {
    return this.tests.find((one) => one.word === this.test.value);
  }

  changeTest() {
    const test = this.chosen();
    this.what.textContent = `Gives: ${test.gives}. Curves: ${test.curve}.`;
    this.start_.hidden = !test.fabric;
    this.written.firstChild.textContent = test.fabric ? "New fabric file, beside that one"
      : "New file of the law, beside the first curve";
    this.fields = new Map();
    this.sizes.replaceChildren(...test.sizes.map((one) => this.field(one)));
    this.corrections.replaceChildren(...test.corrections.map((one) => this.field(one)));
    this.curves.forTest(test);
  }

  /** One option of the command. */
  field(option) {
    const id = `option-${option.name}`;
    const title = `${option.name}${option.unit ? `, ${option.unit}` : ""}${option.required ? "" : " (may be empty)"}`;
    let control;
    if (option.kind === "flag") {
      control = element("input", { type: "checkbox", id });
      this.fields.set(option.name, () => control.checked);
      return element("label", { className: "box" }, control, ` ${option.words}`);
    }
    if (option.kind === "choice") control = select([["", "–"], ...option.choices.map((one) => [one, one])], "", { id });
    else if (option.kind === "only fit") control = select([["", "–"], ["fit", "find it"]], "", { id });
    else {
      control = element("input", { id, size: 12, autocomplete: "off",
        placeholder: { fit: "number or fit", numbers: "1,2,3" }[option.kind] || "" });
    }
    this.fields.set(option.name, () => control.value.trim());
    const made = labelled(title, control);
    made.append(element("span", { className: "note", textContent: option.words }));
    return made;
  }

  async start() {
    const values = {};
    for (const [name, value] of this.fields) {
      if (value() !== "" && value() !== false) values[name] = value();
    }
    const record = await send("identify", { test: this.test.value, curves: this.curves.chosen(false),
      others: this.curves.chosen(true), values, fabric: this.fabric.value, output: this.output.value,
      replace: this.replace.checked });
    tell(null);
    location.hash = `#identify/${record.id}`;
  }

  async open(number) {
    const another = this.number !== number;
    this.number = number;
    const asked = this.asked = (this.asked || 0) + 1;
    const found = await ask("identify/result", { number });
    if (this.number !== number) return;
    if (another) await this.restore(found.record.about.order);
    if (asked !== this.asked) return; // what is asked later, as when it has ended, is newer
    this.stop.hidden = !LIVE.includes(found.record.state);
    this.result.show(found);
  }

  /** The form as it was, so that the next try changes one thing. */
  async restore(order) {
    this.test.value = order.test;
    this.changeTest();
    for (const [name, value] of Object.entries(order.values || {})) {
      const control = document.getElementById(`option-${name}`);
      if (control && control.type === "checkbox") control.checked = value;
      else if (control) control.value = value;
    }
    this.fabric.value = order.fabric;
    this.output.value = order.output;
    await this.curves.restore(order.curves, order.others || []);
  }

  happened(record) {
    if (record.kind !== "identify") return;
    if (record.id === this.number) this.open(record.id).catch(tell);
    clearTimeout(this.filling);
    this.filling = setTimeout(() => this.fill().catch(tell), 300);
  }
}

export const identifyPanel = new Identify();
