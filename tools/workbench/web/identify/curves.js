// SPDX-License-Identifier: GPL-3.0-or-later
// The curves of an identification: files and columns, and a plot of them as they are.

import { ask } from "workbench/page/server.js";
import { button, element, labelled, select, tell } from "workbench/page/elements.js";
import { drawChart } from "workbench/page/chart.js";

export class IdentifyCurves {
  constructor() {
    this.list = []; // {path, column, other, file}
    this.known = new Map(); // answers of the server by path
    this.files = select([["", "– file of a curve –"]], "", { id: "curve-file" });
    this.add_ = button("Add the curve", async () => {
      if (!this.files.value) throw new Error("Choose a file of a curve first");
      await this.add(this.files.value);
    }, { id: "curve-add" });
    this.rows = element("div", { id: "curve-rows" });
    this.x = select([], "", { id: "curve-x" });
    this.x.addEventListener("change", () => this.draw());
    this.axis = labelled("Shown over", this.x);
    this.chart = element("div", { id: "curve-chart" });
    this.place = element("fieldset", {}, element("legend", { textContent: "Curves" }),
      element("div", { className: "vary" }, this.files, this.add_), this.rows, this.axis, this.chart);
  }

  offer(paths) {
    const chosen = this.files.value;
    this.files.replaceChildren(...["", ...paths].map((path) =>
      element("option", { value: path, textContent: path || "– file of a curve –" })));
    this.files.value = paths.includes(chosen) ? chosen : "";
  }

  forTest(test) {
    this.test = test;
    if (!test.others) this.list.forEach((one) => { one.other = false; });
    this.redraw();
  }

  async add(path, column = "", other = false) {
    if (!this.known.has(path)) this.known.set(path, await ask("identify/curve", { path }));
    this.list.push({ path, column, other });
    tell(null);
    this.redraw();
  }

  async restore(curves, others) {
    this.list = [];
    for (const one of curves) await this.add(one.path, one.column);
    for (const one of others) await this.add(one.path, one.column, true);
    this.redraw();
  }

  /** As the server wants them. */
  chosen(other) {
    return this.list.filter((one) => one.other === other).map(({ path, column }) => ({ path, column }));
  }

  redraw() {
    this.rows.replaceChildren(...this.list.map((one, i) => this.row(one, i)));
    const titles = [...new Set(this.list.flatMap((one) =>
      this.known.get(one.path).columns.map((column) => column.title)))];
    const chosen = this.x.value;
    this.x.replaceChildren(...titles.map((title) => element("option", { value: title, textContent: title })));
    this.x.value = titles.includes(chosen) ? chosen : titles[0] || "";
    this.axis.hidden = !this.list.length;
    this.draw();
  }

  row(one, i) {
    const file = this.known.get(one.path);
    const columns = select([["", "as the header says"], ...file.columns.map((column) => [column.name,
      `${column.title}${column.unit ? `, ${column.unit}` : ""}`])], one.column,
    { id: `curve-${i}-column`, "aria-label": `column of the load of ${one.path}` });
    columns.addEventListener("change", () => {
      one.column = columns.value;
      this.draw();
    });
    const parts = [element("code", { textContent: one.path }), "load:", columns,
      element("span", { className: "note", textContent: `${file.rows} rows: ${file.columns.map((column) =>
        `${column.title}${column.unit ? ` (${column.unit})` : " (no unit)"}`).join(", ")}` })];
    if (this.test && this.test.others) {
      const kind = select([["", "this kind"], ["other", this.test.others.name]], one.other ? "other" : "",
        { id: `curve-${i}-kind`, title: this.test.others.words, "aria-label": `kind of specimen of ${one.path}` });
      kind.addEventListener("change", () => { one.other = kind.value === "other"; });
      parts.push(kind);
    }
    parts.push(button("Remove", () => {
      this.list.splice(i, 1);
      this.redraw();
    }, { id: `curve-${i}-remove`, "aria-label": `remove ${one.path}` }));
    return element("div", { className: "vary" }, ...parts);
  }

  /** Columns as they are in the files: the load chosen, or all but the one along. */
  draw() {
    const series = [];
    let unit = "";
    const names = new Set();
    for (const one of this.list) {
      const { columns } = this.known.get(one.path);
      const x = columns.find((column) => column.title === this.x.value);
      const wanted = columns.filter((column) => column !== x && (!one.column || column.name === one.column));
      for (const y of x ? wanted : []) {
        unit = x.unit;
        names.add(`${y.title}${y.unit ? `, ${y.unit}` : ""}`);
        series.push({ name: `${one.path.split("/").pop()}: ${y.title}`, kind: "line", x: x.values,
          y: y.values.map((value) => (value === null ? NaN : value)) });
      }
    }
    this.chart.replaceChildren();
    if (series.length) {
      drawChart(this.chart, { title: "Curves as measured", x: { name: this.x.value, unit, zero: true },
        y: { name: names.size === 1 ? [...names][0] : "columns, as in the file", zero: true }, series });
    }
  }
}
