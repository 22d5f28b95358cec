// SPDX-License-Identifier: GPL-3.0-or-later
// What a study has found so far: how far it is, its table, a figure over a key, ranking, pictures.

import { ask } from "workbench/page/server.js";
import { element, labelled, select } from "workbench/page/elements.js";
import { drawChart } from "workbench/page/chart.js";
import { fittingDigits, written } from "plyform/numbers.js";

const PERIOD = 1000; // ms, between two looks at results that are shown
const BAD = ["failed", "refused", "stopped", "missing", "doubtful"];
const HIDDEN = ["line", "setting", "folder", "cpu_s", "against"]; // columns that the first two say
const COSTS = ["wall_time_s", "cpu_s", "steps", "elements", "within_limits"]; // offered last
const MOST_ROWS = 500;

const shown = (value) => (typeof value === "number" ? written(value, Number.isInteger(value) ? 0
  : fittingDigits(value)) : value === null || value === undefined ? "" : String(value));

/** "7 done, 2 doubtful of 9 runs". */
export function countsInWords(counts) {
  const all = Object.values(counts).reduce((sum, one) => sum + one, 0);
  if (!all) return "no run has ended yet";
  const words = ["done", ...BAD].filter((word) => counts[word]).map((word) => `${counts[word]} ${word}`);
  return `${words.join(", ")} of ${all} runs`;
}

const titleOf = (row) => (row.line === row.setting ? row.line : `${row.line} ${row.setting}`);

export class StudyResults {
  constructor(place) {
    this.place = place;
    this.state = element("p", { id: "study-progress", role: "status" });
    this.chart = element("div", { id: "study-chart" });
    this.axes = element("div", { className: "vary" });
    this.table = element("div", { id: "study-table", className: "scroll" });
    this.ranking = element("div", { id: "study-ranking" });
    this.pictures = element("div", { id: "study-pictures-drawn", className: "vary" });
    place.replaceChildren(this.state, this.axes, this.chart, this.table, this.ranking, this.pictures);
  }

  /** Shows a folder of results and keeps it new while it is on the page. */
  async show(folder, told = () => {}) {
    if (this.folder !== folder) Object.assign(this, { folder, version: "", data: null, axesOf: "", chosen: {} });
    this.told = told;
    await this.look();
    clearTimeout(this.timer);
    const again = async () => {
      if (this.place.offsetParent) await this.look().catch(() => {});
      this.timer = setTimeout(again, PERIOD);
    };
    this.timer = setTimeout(again, PERIOD);
  }

  async look() {
    const { folder } = this;
    const data = await ask("study/table", { folder, version: this.version });
    if (folder !== this.folder) return;
    this.state.textContent = this.words(data);
    this.told(data);
    if (!data.rows || (this.data && data.version === this.version)) return;
    Object.assign(this, { data, version: data.version });
    this.draw();
  }

  words(data) {
    const where = data.elsewhere ? "goes on, begun by the command line: " : data.state === "queued"
      ? "waits for other runs to end: " : data.state === "running" || data.state === "starting" ? "goes on: " : "";
    return `${where}${countsInWords(data.counts)}`;
  }

  draw() {
    this.drawAxes();
    this.drawTable();
    this.drawRanking();
    this.pictures.replaceChildren(...this.data.pictures.filter((name) => name.endsWith(".png")).map((name) =>
      element("figure", {}, element("img", { alt: `${name} of the study`, className: "drawn",
        src: `./api/study/picture?${new URLSearchParams({ folder: this.folder, name, version: this.version })}` }),
      element("figcaption", { textContent: name }))));
  }

  /** Columns with numbers, and those of what varies, which stand before the status. */
  columns() {
    const { columns, rows } = this.data;
    const keys = columns.slice(2, columns.indexOf("status"));
    const numbers = columns.slice(columns.indexOf("status") + 1).filter((name) =>
      rows.some((row) => typeof row[name] === "number"));
    return { keys, numbers };
  }

  drawAxes() {
    const { keys, numbers } = this.columns();
    const mark = JSON.stringify([keys, numbers]);
    if (mark !== this.axesOf && numbers.length && keys.length) {
      this.axesOf = mark;
      const over = (id, words, choices, value) => {
        const list = select(choices.map((name) => [name, name]), choices.includes(value) ? value : choices[0], { id });
        list.addEventListener("change", () => {
          this.chosen[id] = list.value; // by the reader: kept when columns come
          this.drawChart();
          this.drawRanking();
        });
        return [labelled(words, list), list];
      };
      const figures = numbers.filter((name) => !COSTS.includes(name));
      const [first, y] = over("chart-y", "Figure", [...figures, ...numbers.filter((name) => COSTS.includes(name))],
        this.chosen["chart-y"]);
      const [second, x] = over("chart-x", "over", [...keys, ...numbers], this.chosen["chart-x"]);
      const [third, by] = over("chart-by", "a line for each", ["–", ...keys],
        this.chosen["chart-by"] || keys[1] || "–");
      Object.assign(this, { x, y, by });
      this.axes.replaceChildren(first, second, third);
    }
    if (!numbers.length || !keys.length) this.axes.replaceChildren();
    this.drawChart();
  }

  drawChart() {
    if (!this.x || !this.axes.childElementCount) {
      this.chart.replaceChildren();
      return;
    }
    const [x, y, by] = [this.x.value, this.y.value, this.by.value];
    const rows = this.data.rows.filter((row) => typeof row[y] === "number" && !["", "null", "undefined"]
      .includes(String(row[x])));
    const words = rows.some((row) => typeof row[x] !== "number")
      ? [...new Set(rows.map((row) => String(row[x])))] : null;
    const groups = new Map();
    for (const row of rows) {
      const name = by === "–" || by === x ? "" : `${by}: ${row[by] === null ? "as the case has it" : row[by]}`;
      groups.set(name, [...(groups.get(name) || []), row]);
    }
    const at = (row) => (words ? words.indexOf(String(row[x])) : row[x]);
    const series = [...groups].map(([name, own]) => {
      const order = [...own].sort((a, b) => at(a) - at(b));
      return { name, kind: "points", x: order.map(at), y: order.map((row) => row[y]), rows: order,
        labels: order.map((row) => titleOf(row)),
        hollow: order.map((row) => row.status !== "done" || row.within_limits === 0) };
    });
    drawChart(this.chart, { title: "Runs of the study", x: { name: x, words }, y: { name: y }, series,
      pick: (one, i) => this.open(one.rows[i]) });
    if (series.some((one) => one.hollow.some(Boolean))) {
      this.chart.append(element("p", { className: "note",
        textContent: "Hollow: doubtful, stopped, or not within the limits." }));
    }
  }

  open(row) {
    location.hash = this.addressOf(row);
  }

  /** The run's report in the panel of results. */
  addressOf(row) {
    return `#results/report/${encodeURIComponent(`${this.folder}/${row.folder}`)}`;
  }

  drawTable() {
    const { columns, rows } = this.data;
    const { keys } = this.columns();
    const kept = columns.filter((name) => !HIDDEN.includes(name));
    const head = element("tr", {}, element("th", { textContent: "run", scope: "col" }),
      ...kept.map((name) => element("th", { textContent: name, scope: "col" })));
    const body = rows.slice(0, MOST_ROWS).map((row) => {
      const name = element("a", { href: this.addressOf(row), textContent: titleOf(row) });
      if (row.status === "missing") name.removeAttribute("href");
      const kind = BAD.includes(row.status) ? `is-${row.status}` : "";
      const cells = kept.map((column) => element("td", {
        textContent: keys.includes(column) && row[column] !== null ? String(row[column]) : shown(row[column]),
        title: column === "message" ? shown(row[column]) : "",
        className: typeof row[column] === "number" ? "number" : column === "message" ? "message" : "" }));
      return element("tr", { className: kind, dataset: { run: row.folder } },
        element("th", { scope: "row" }, name), ...cells);
    });
    const more = rows.length > MOST_ROWS ? [element("p", { className: "note",
      textContent: `${rows.length - MOST_ROWS} more rows stand in ${this.folder}/table.csv.` })] : [];
    this.table.replaceChildren(...(rows.length ? [element("table", {}, element("thead", {}, head),
      element("tbody", {}, ...body)), ...more] : []));
  }

  drawRanking() {
    const { ranking } = this.data;
    const y = this.y ? this.y.value : "";
    const own = ranking.filter((row) => row.figure === y);
    const parts = own.length ? [element("h3", { textContent: `What moves ${y} most` }),
      element("ol", {}, ...own.map((row) => element("li", {
        textContent: `${row.key}: ${shown(row.effect)}${row.explained
          ? ` (explains ${shown(100 * row.explained)} % with the others)` : ""}` })))] : [];
    const { columns, rows } = this.data.reach || {};
    if (rows && rows.length) {
      parts.push(element("h3", { textContent: "How far each key goes within the limits" }),
        element("table", {}, element("thead", {}, element("tr", {}, ...columns.map((name) =>
          element("th", { textContent: name, scope: "col" })))), element("tbody", {}, ...rows.map((row) =>
          element("tr", {}, ...columns.map((name) => element("td", { textContent: shown(row[name]) })))))));
    }
    this.ranking.replaceChildren(...parts);
  }
}
