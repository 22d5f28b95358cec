// SPDX-License-Identifier: GPL-3.0-or-later
// What differs between the cases of the runs chosen, and what came of it.

import { fittingDigits, written } from "plyform/numbers.js";
import { element } from "workbench/page/elements.js";
import { figureText, letterOf } from "workbench/results/list.js";
import { send } from "workbench/page/server.js";

const head = (first, names) => element("thead", {}, element("tr", {},
  ...[first, ...names].map((name) => element("th", { scope: "col", textContent: name }))));

function apart(one, first) {
  if (!one || !first) return "–";
  const value = one.value - first.value;
  const digits = fittingDigits(Math.max(Math.abs(one.value), Math.abs(first.value)));
  const unit = one.unit === "°" ? "°" : one.unit ? ` ${one.unit}` : "";
  return value === 0 ? "same" : `${value > 0 ? "+" : ""}${written(value, digits)}${unit}`;
}

class DifferencesView {
  constructor(place) {
    this.words = element("p", { className: "note", id: "differences-words", role: "status" });
    this.keys = element("table", { id: "differences-keys" });
    this.figures = element("table", { id: "differences-figures" });
    place.append(this.words, element("h2", { textContent: "Keys of the cases" }),
      element("div", { className: "wide" }, this.keys), element("h2", { textContent: "Figures" }),
      element("div", { className: "wide" }, this.figures));
  }

  async show(chosen) {
    this.chosen = chosen;
    if (chosen.length < 2) {
      this.keys.replaceChildren();
      this.figures.replaceChildren();
      this.words.textContent = "Choose two runs or more in the list.";
      return;
    }
    const { rows, folders, unknown } = await send("results/differences", { folders: chosen.map((run) => run.folder) });
    if (chosen !== this.chosen) return; // others were chosen meanwhile
    const letters = folders.map((folder) => letterOf(chosen.findIndex((run) => run.folder === folder)));
    const differ = rows.length ? `${rows.length} ${rows.length === 1 ? "key differs" : "keys differ"}. `
      : "The cases give the same. ";
    this.words.textContent = (folders.length < 2 ? "" : differ) + (unknown.length ? `${unknown.join(", ")}: what the ` +
      "case was is not known; runs tell it that have ended, and were made by this version." : "");
    this.keys.replaceChildren();
    if (rows.length) {
      this.keys.append(head("Key", letters), element("tbody", {}, ...rows.map((row) => element("tr", {},
        element("th", { scope: "row", textContent: row.key }),
        ...row.values.map((value) => element("td", { textContent: value === null ? "not given" : value }))))));
    }
    this.drawFigures(chosen);
  }

  drawFigures(chosen) {
    const figures = new Map(chosen.flatMap((run) => run.figures.map((one) => [one.id, one])));
    const less = chosen.slice(1).map((_, i) => `${letterOf(i + 1)} − A`);
    const of = (run, id) => run.figures.find((one) => one.id === id);
    this.figures.replaceChildren(head("Figure", [...chosen.map((_, i) => letterOf(i)), ...less]),
      element("tbody", {}, ...[...figures.values()].map(({ id, label }) => element("tr", {},
        element("th", { scope: "row", textContent: label }),
        ...chosen.map((run) => element("td", { textContent: of(run, id) ? figureText(of(run, id)) : "–" })),
        ...chosen.slice(1).map((run) => element("td", {
          textContent: apart(of(run, id), of(chosen[0], id)) }))))));
  }
}

export const differencesView = { word: "differences", title: "Differences",
  made: (place) => new DifferencesView(place) };
