// SPDX-License-Identifier: GPL-3.0-or-later
// A figure over runs: a chart and a table of what any number of runs came to, over the order in which
// they were made or over a key in which their cases differ.

import { drawChart } from "workbench/page/chart.js";
import { element, tell } from "workbench/page/elements.js";
import { figureText } from "workbench/results/list.js";
import { send } from "workbench/page/server.js";

const ORDER = "";

/** A value as a case file has it, as a number if it is one. */
const numberOf = (text) => (text !== null && text.trim() !== "" && Number.isFinite(Number(text)) ? Number(text) : null);

/** "a;b" in a cell of CSV. */
const cell = (value) => {
  const text = value === null || value === undefined ? "" : String(value);
  return /[",\n\r]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
};

/** Rows of a table of runs: what is told of each, keys that differ, all figures with their bands. */
export function tableOf(runs, rows, figures) {
  const banded = (id) => runs.some((run) => run.figures.some((one) => one.id === id && one.band !== null));
  const head = ["number", "run", "title", "status", ...rows.map((row) => row.key),
    ...figures.flatMap(({ id, label, unit }) => {
      const name = unit ? `${label}, ${unit}` : label;
      return banded(id) ? [name, `band of ${name}`] : [name];
    })];
  const body = runs.map((run, i) => [i + 1, run.folder, run.title, run.status, ...rows.map((row) => row.values[i]),
    ...figures.flatMap(({ id }) => {
      const one = run.figures.find((figure) => figure.id === id) || { value: null, band: null };
      return banded(id) ? [one.value, one.band] : [one.value];
    })]);
  return { head, body };
}

export const csvOf = ({ head, body }) => `${[head, ...body].map((row) => row.map(cell).join(",")).join("\n")}\n`;

class FiguresView {
  constructor(place, panel) {
    this.panel = panel;
    this.runs = [];
    this.figure = element("select", { id: "figures-figure" });
    this.over = element("select", { id: "figures-over" });
    this.csv = element("button", { type: "button", id: "figures-csv", textContent: "Save as CSV" });
    this.words = element("p", { className: "note", id: "figures-words" });
    this.chart = element("div", { id: "figures-chart" });
    this.table = element("table", { id: "figures-table" });
    for (const select of [this.figure, this.over]) select.addEventListener("change", () => this.draw());
    this.csv.addEventListener("click", () => this.save());
    place.append(element("div", { className: "row" }, element("label", { textContent: "Figure " }, this.figure),
      element("label", { textContent: "over " }, this.over), this.csv), this.words, this.chart,
    element("div", { className: "wide" }, this.table));
  }

  /** The runs chosen, else all; the oldest is number 1. */
  async show(chosen, all) {
    const runs = (chosen.length ? [...chosen] : [...all]).filter((run) => run.figures.length)
      .sort((a, b) => a.date - b.date);
    this.asked = runs;
    const found = runs.length > 1
      ? await send("results/differences", { folders: runs.map((run) => run.folder) }) : { rows: [], folders: [] };
    if (runs !== this.asked) return; // others were chosen meanwhile
    this.runs = runs;
    this.rows = found.rows.map((row) => ({ key: row.key, values: this.runs.map((run) => {
      const at = found.folders.indexOf(run.folder);
      return at < 0 ? null : row.values[at];
    }) }));
    const ids = new Map(this.runs.flatMap((run) => run.figures.map((one) => [one.id, one])));
    this.figures = [...ids.values()];
    this.fill(this.figure, this.figures.map(({ id, label, unit }) => [id, unit ? `${label}, ${unit}` : label]));
    this.fill(this.over, [[ORDER, "the order in which they were made"], ...this.rows.map(({ key }) => [key, key])]);
    this.draw();
  }

  fill(select, options) {
    const before = select.value;
    select.replaceChildren(...options.map(([value, text]) => element("option", { value, textContent: text })));
    if (options.some(([value]) => value === before)) select.value = before;
  }

  /** Places along the axis, one a run; null: it has none. */
  along() {
    const row = this.rows.find(({ key }) => key === this.over.value);
    if (!row) return { what: { name: "run" }, places: this.runs.map((_, i) => i + 1) };
    const numbers = row.values.map(numberOf);
    if (row.values.every((value, i) => value === null || numbers[i] !== null)) {
      return { what: { name: row.key }, places: numbers };
    }
    const words = [...new Set(row.values.filter((value) => value !== null))];
    return { what: { name: row.key, words },
      places: row.values.map((value) => (value === null ? null : words.indexOf(value))) };
  }

  draw() {
    this.csv.disabled = !this.runs.length;
    if (!this.runs.length) {
      this.words.textContent = "No run has ended yet.";
      this.chart.replaceChildren();
      this.table.replaceChildren();
      return;
    }
    const figure = this.figures.find(({ id }) => id === this.figure.value) || this.figures[0];
    const { what, places } = this.along();
    const shown = this.runs.map((run, i) => ({ run, place: places[i],
      one: run.figures.find(({ id }) => id === figure.id) })).filter(({ one, place }) => one && place !== null);
    const missing = this.runs.length - shown.length;
    const bands = shown.filter(({ one }) => one.band !== null);
    this.words.textContent = `${shown.length} ${shown.length === 1 ? "run" : "runs"}${missing
      ? `; ${missing} ${missing === 1 ? "has" : "have"} no such figure, or no such key` : ""}. ` +
      `Hollow: doubtful, or not ended.${bands.length ? " Lines up and down: bands of verified runs." : ""}`;
    drawChart(this.chart, { title: figure.label, x: what, y: { name: figure.label, unit: figure.unit },
      series: [{ kind: "points", x: shown.map(({ place }) => place), y: shown.map(({ one }) => one.value),
        labels: shown.map(({ run }) => run.folder), hollow: shown.map(({ run }) => run.status !== "done") },
      ...bands.map(({ one, place }) => ({ kind: "line", dashes: "", colour: "#5b6772", x: [place, place],
        y: [one.value - one.band, one.value + one.band] }))],
      pick: (series, i) => this.panel.go("report", [shown[i].run.folder]) });
    this.drawTable();
  }

  /** Without the figures of single plies, which the CSV has. */
  drawTable() {
    const figures = this.figures.filter(({ of_ply: ofPly }) => !ofPly);
    const { head, body } = tableOf(this.runs, this.rows, figures);
    const textOf = (value) => (typeof value === "number" ? figureText({ value, unit: "", band: null }) : value || "–");
    const row = (cells, kind) =>
      element("tr", {}, ...cells.map((value) => element(kind, { textContent: textOf(value) })));
    this.table.replaceChildren(element("thead", {}, row(head, "th")),
      element("tbody", {}, ...body.map((cells) => row([String(cells[0]), ...cells.slice(1)], "td"))));
  }

  save() {
    const text = csvOf(tableOf(this.runs, this.rows, this.figures));
    const address = URL.createObjectURL(new Blob([text], { type: "text/csv" }));
    const link = element("a", { href: address, download: "runs.csv" });
    document.body.append(link);
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(address), 10000);
    tell(null);
  }
}

export const figuresView = { word: "figures", title: "Figures over runs",
  made: (place, panel) => new FiguresView(place, panel) };
