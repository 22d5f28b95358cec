// SPDX-License-Identifier: GPL-3.0-or-later
// The form that starts a run.

import { ACCURACIES } from "workbench/page/accuracies.js";
import { button, element, tell } from "workbench/page/elements.js";
import { ask, listen, send } from "workbench/page/server.js";

const field = (text, control, note = "") => element("label", {}, element("span", { textContent: text }), control,
  element("small", { textContent: note }));

export class RunStart {
  /** `started(folder)` when a run has been put into the queue. */
  constructor(started) {
    this.started = started;
    this.case = element("input", { id: "run-case", placeholder: "NAME/case.toml", required: true,
      autocomplete: "off" });
    this.case.setAttribute("list", "run-cases");
    this.cases = element("datalist", { id: "run-cases" });
    this.accuracy = element("select", { id: "run-accuracy" }, ...ACCURACIES.map(([value, textContent]) =>
      element("option", { value, textContent })));
    this.threads = element("input", { id: "run-threads", type: "number", min: 1, max: 256, step: 1 });
    this.budget = element("input", { id: "run-budget", type: "number", min: 1, step: "any", placeholder: "no limit" });
    this.verify = element("input", { id: "run-verify", type: "checkbox" });
    this.name = element("input", { id: "run-name", placeholder: "after the case", autocomplete: "off",
      pattern: "[A-Za-z0-9_][A-Za-z0-9_.\\-]{0,79}", title: "letters, digits, _, - and ." });
    this.place = element("form", { className: "runs-start", "aria-label": "Start a run", noValidate: false },
      field("Case", this.case), this.cases, field("Accuracy", this.accuracy),
      element("details", {}, element("summary", { id: "run-more", textContent: "More" }),
        field("Threads", this.threads, "the results do not depend on it"),
        field("Budget, s", this.budget, "a run that would take longer is refused, with what it would take"),
        field("Verify", this.verify, "bands of the figures from sibling runs"),
        field("Name of the results", this.name, "results/NAME")),
      button("Run", () => this.run(), { id: "run-start", className: "main" }));
    this.place.addEventListener("submit", (event) => event.preventDefault());
    listen("case", () => this.load().catch(tell));
  }

  chooseCase(path) {
    this.case.value = path;
  }

  async load() {
    if (!this.offers) {
      this.offers = await ask("runs/offers");
      this.threads.value = this.offers.threads;
    }
    let cases = [];
    try {
      ({ cases } = await ask("folder"));
    } catch (problem) {
      if (problem.code !== 404) throw problem;
    }
    this.cases.replaceChildren(...cases.map(({ path, title }) =>
      element("option", { value: path, label: title || path })));
    if (!this.case.value && cases.length) this.case.value = cases[0].path;
  }

  async run() {
    if (!this.place.reportValidity()) return;
    const number = (input) => (input.value === "" ? null : Number(input.value));
    const record = await send("runs", { case: this.case.value.trim(), accuracy: this.accuracy.value,
      threads: number(this.threads), budget: number(this.budget), verify: this.verify.checked,
      name: this.name.value.trim() });
    this.name.value = "";
    tell(null);
    this.started(record.about.output);
  }
}
