// SPDX-License-Identifier: GPL-3.0-or-later
// The panel of results: runs are chosen from a list at the left; at the right is their report, a figure
// over them, how their cases differ, or files and exports. The address says it all:
// #results/VIEW/FOLDER|FOLDER.

import { element, tell } from "workbench/page/elements.js";
import { differencesView } from "workbench/results/differences.js";
import { exportsView } from "workbench/results/exports.js";
import { figuresView } from "workbench/results/figures.js";
import { RunChoice } from "workbench/results/list.js";
import { reportView } from "workbench/results/report.js";
import { ask, listen } from "workbench/page/server.js";

const VIEWS = [reportView, figuresView, differencesView, exportsView];

const addressOf = (view, chosen) =>
  `#results/${view}/${chosen.map((folder) => encodeURIComponent(folder)).join("|")}`;

class Results {
  constructor(place) {
    const style = element("link", { rel: "stylesheet", href: "./web/results/results.css" });
    this.list = new RunChoice((chosen) => this.go(this.word, chosen));
    this.tabs = VIEWS.map(({ word, title }) =>
      element("a", { role: "tab", id: `results-${word}`, textContent: title }));
    this.rooms = VIEWS.map((view) => element("section", { className: `results-${view.word}`, hidden: true }));
    this.views = VIEWS.map((view, i) => view.made(this.rooms[i], this));
    place.append(style, element("div", { className: "results" }, this.list.place,
      element("div", { className: "results-main" },
        element("nav", { className: "results-tabs", role: "tablist", "aria-label": "Of the runs chosen" },
          ...this.tabs),
        ...this.rooms)));
    this.runs = [];
    listen("again", () => this.ask().catch(tell));
    listen("runs", () => this.askSoon());
    listen("process", (event) => this.views.forEach((view) => view.process && view.process(event)));
  }

  go(word, chosen) {
    location.hash = addressOf(word, chosen);
  }

  /** Of the address: VIEW/FOLDER|FOLDER, or a run's FOLDER, whose report is shown; nothing, by the tab of
   * the panel: what was shown last. */
  async show(rest) {
    if (!rest && this.word) {
      history.replaceState(null, "", addressOf(this.word, this.chosen));
      this.mark = null;
      await this.ask();
      return;
    }
    const [word, ...more] = rest.split("/");
    const named = VIEWS.some((view) => view.word === word);
    this.word = named ? word : VIEWS[0].word;
    this.chosen = (named ? more.join("/") : rest).split("|").filter(Boolean);
    this.mark = null;
    await this.ask();
  }

  askSoon() {
    clearTimeout(this.soon);
    this.soon = setTimeout(() => this.ask().catch(tell), 300);
  }

  async ask() {
    if (!this.word) return; // never shown yet
    const runs = await ask("results");
    const mark = JSON.stringify([this.word, this.chosen, runs]);
    if (mark === this.mark) return; // what is shown may be clicked just now
    [this.mark, this.runs] = [mark, runs];
    await this.draw();
  }

  /** Chosen runs that are there, in the order in which they were chosen. */
  chosenRuns() {
    return this.chosen.map((folder) => this.runs.find((run) => run.folder === folder)).filter(Boolean);
  }

  async draw() {
    this.list.show(this.runs, this.chosen);
    VIEWS.forEach((view, i) => {
      this.tabs[i].href = addressOf(view.word, this.chosen);
      this.tabs[i].setAttribute("aria-selected", String(view.word === this.word));
      this.rooms[i].hidden = view.word !== this.word;
    });
    const { mark } = this;
    await this.views[VIEWS.findIndex((view) => view.word === this.word)].show(this.chosenRuns(), this.runs);
    if (mark !== this.mark) return; // something else is to be shown meanwhile
    document.documentElement.dataset.results = `${this.word} ${this.chosen.length}`;
  }
}

let results = null;

export const resultsPanel = {
  word: "results",
  title: "Results",
  show(place, rest) {
    results = results || new Results(place);
    return results.show(rest);
  },
};
