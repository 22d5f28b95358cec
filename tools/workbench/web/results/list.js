// SPDX-License-Identifier: GPL-3.0-or-later
// Runs to choose from, with what they came to.

import { fittingDigits, written } from "plyform/numbers.js";
import { element } from "workbench/page/elements.js";

/** A figure as it is read: "force of punch 147 N". */
export const figureText = ({ value, unit, band }) => {
  const digits = fittingDigits(value);
  const width = Number.isFinite(band) && band !== null ? ` ± ${written(band, fittingDigits(band))}` : "";
  return `${written(value, digits)}${width}${unit === "°" ? "°" : unit ? ` ${unit}` : ""}`;
};

export const letterOf = (place) => (place < 26 ? String.fromCharCode(65 + place) : String(place + 1));

/** Its title, and the name of its folder where that says more. */
const named = ({ title, folder }) => {
  const name = folder.split("/").pop();
  return !title || title === name ? name : `${title} (${name})`;
};

const when = (date) => new Date(1000 * date).toLocaleString(undefined, { dateStyle: "short", timeStyle: "short" });

export class RunChoice {
  /** `choose(folders)`: other runs are chosen. */
  constructor(choose) {
    this.choose = choose;
    this.filter = element("input", { type: "search", id: "results-filter", placeholder: "Only those with …",
      "aria-label": "Only runs whose title or folder has this" });
    this.filter.addEventListener("input", () => this.draw());
    this.none = element("button", { type: "button", id: "results-none", textContent: "None",
      title: "Choose no run" });
    this.none.addEventListener("click", () => this.choose([]));
    this.all = element("button", { type: "button", id: "results-all", textContent: "All",
      title: "Choose all that are listed" });
    this.all.addEventListener("click", () => this.choose(this.listed().map((run) => run.folder)));
    this.made = new Map(); // items by folder, and what they were made of
    this.empty = element("li", { textContent: "No run has written results in this folder yet." });
    this.items = element("ul", { className: "runs-to-choose", id: "results-list" });
    this.place = element("aside", { className: "results-list", "aria-label": "Runs" },
      element("div", { className: "row" }, this.filter, this.all, this.none), this.items);
  }

  show(runs, chosen) {
    [this.runs, this.chosen] = [runs, chosen];
    this.draw();
  }

  listed() {
    const word = this.filter.value.trim().toLowerCase();
    return this.runs.filter((run) => `${run.title} ${run.folder}`.toLowerCase().includes(word));
  }

  /** Items stay the same elements while their runs are the same: one may be clicked just now. */
  draw() {
    const listed = this.listed();
    const items = listed.map((run) => this.kept(run));
    if (!this.runs.length) items.push(this.empty);
    if (items.length !== this.items.children.length || items.some((item, i) => item !== this.items.children[i])) {
      this.items.replaceChildren(...items);
    }
    for (const run of listed) {
      const at = this.chosen.indexOf(run.folder);
      const { box, letter } = this.made.get(run.folder);
      box.checked = at >= 0;
      letter.textContent = at >= 0 ? letterOf(at) : "";
    }
  }

  kept(run) {
    const mark = JSON.stringify([run.title, run.status, run.message, run.date, run.key_figures]);
    const known = this.made.get(run.folder);
    if (!known || known.mark !== mark) this.made.set(run.folder, { mark, ...this.item(run) });
    return this.made.get(run.folder).item;
  }

  item(run) {
    const box = element("input", { type: "checkbox", dataset: { folder: run.folder } });
    box.addEventListener("change", () => this.choose(box.checked ? [...this.chosen, run.folder]
      : this.chosen.filter((folder) => folder !== run.folder)));
    const letter = element("span", { className: "letter" });
    const figures = run.key_figures.map((one) => `${one.label} ${figureText(one)}`).join(" · ");
    const item = element("li", { title: run.message },
      element("label", {}, box, letter,
        element("span", { className: "run-words" },
          element("b", { textContent: named(run) }),
          element("span", { className: `status ${run.status}`, textContent: run.status }),
          element("small", { textContent: `${run.folder} · ${when(run.date)}` }),
          element("small", { textContent: figures }))));
    return { item, box, letter };
  }
}
