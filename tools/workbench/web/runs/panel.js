// SPDX-License-Identifier: GPL-3.0-or-later
// The panel of runs: a form that starts them, the queue and the list of all, and the one that is chosen.
// Addresses: #runs/FOLDER shows a run, #runs/+/CASE has that case in the form.

import { element, tell } from "workbench/page/elements.js";
import { RunList } from "workbench/runs/list.js";
import { RunShown } from "workbench/runs/shown.js";
import { RunStart } from "workbench/runs/start.js";
import { ask, listen } from "workbench/page/server.js";

class Panel {
  constructor(place) {
    this.runs = [];
    this.chosen = "";
    this.start = new RunStart((folder) => this.choose(folder));
    this.list = new RunList((folder) => this.choose(folder));
    this.shown = new RunShown();
    place.classList.add("runs");
    place.append(
      element("div", { className: "runs-side" }, this.start.place, this.list.place), this.shown.place);
    for (const kind of ["runs", "again"]) listen(kind, () => this.load());
    listen("process", ({ record, last }) => {
      if (record.kind === "run" || record.state === "forgotten") this.load();
      this.shown.printed(record, last);
    });
    listen("progress", (event) => this.progressed(event));
  }

  choose(folder) {
    location.hash = `#runs/${folder.split("/").map(encodeURIComponent).join("/")}`;
  }

  /** Once at a time; what is asked for meanwhile comes right after. */
  async load() {
    this.again = true;
    if (this.loading) return;
    this.loading = true;
    try {
      while (this.again) {
        this.again = false;
        this.runs = await ask("runs");
        this.update();
      }
    } catch (problem) {
      tell(problem);
    } finally {
      this.loading = false;
    }
  }

  progressed({ folder, progress, states }) {
    const run = this.runs.find((one) => one.folder === folder);
    if (!run) return;
    Object.assign(run, { progress, states });
    this.list.progressed(run);
    if (folder === this.chosen) this.shown.progressed(run);
  }

  update() {
    const run = this.runs.find((one) => one.folder === this.chosen) || null;
    this.list.show(this.runs, this.chosen);
    this.shown.show(run, this.chosen);
  }

  async go(rest) {
    if (rest.startsWith("+/")) this.start.chooseCase(rest.slice(2));
    else if (rest) this.chosen = rest;
    await Promise.all([this.start.load(), this.load()]);
    if (!rest && !this.chosen && this.runs.length) {
      this.chosen = this.runs[0].folder;
      this.update();
    }
  }
}

export const runs = {
  word: "runs",
  title: "Runs",
  panel: null,
  show(place, rest) {
    if (!this.panel) this.panel = new Panel(place);
    return this.panel.go(rest);
  },
};
