// SPDX-License-Identifier: GPL-3.0-or-later
// What plyform identify has found: the law over the measured rows, residuals, limits of each number,
// warnings; or why it has refused the curve, with the remedy.

import { element, labelled, select } from "workbench/page/elements.js";
import { drawChart } from "workbench/page/chart.js";
import { fittingDigits, written } from "plyform/numbers.js";

/** Columns of the rows that are places along, with name, unit and factor. */
const ALONG = {
  shear_deg: ["shear angle", "°", 1], displacement_mm: ["displacement", "mm", 1], strain: ["strain", "%", 100],
  stretch: ["stretch", "", 1], time_s: ["time after the stop", "s", 1],
  overhang_mm: ["overhang", "mm", 1], distance_mm: ["distance along the yarn", "mm", 1], force_N: ["force", "N", 1],
  warp_strain: ["warp strain", "%", 100], weft_strain: ["weft strain", "%", 100],
  hersey_mm: ["Hersey number", "mm", 1],
};
const OVER_DECADES = ["hersey_mm"]; // shown along a logarithmic axis

/** Pairs of columns, measured and fitted, with name and unit. */
const PAIRS = [["measured_N", "fitted_N", "load", "N"], ["measured_MPa", "fitted_MPa", "nominal stress", "MPa"],
  ["measured_mm", "fitted_mm", "deflection", "mm"],
  ["measured_deg", "fitted_deg", "shear angle", "°"], ["measured_N_mm", "fitted_N_mm", "bending stiffness", "N mm"],
  ["warp_N", "warp_fitted_N", "warp load", "N"], ["weft_N", "weft_fitted_N", "weft load", "N"],
  ["measured", "fitted", "friction coefficient", ""]];

/** Of any other column: its words and unit, thickness_mm; it is measured where fitted_thickness_mm stands beside. */
const UNITS = [["_N_mm2", "N/mm²"], ["_mm", "mm"], ["_deg", "°"], ["_N", "N"]];
const ofName = (column) => {
  const [end, unit] = UNITS.find(([one]) => column.endsWith(one)) || ["", ""];
  return [column.slice(0, column.length - end.length).replaceAll("_", " "), unit, 1];
};
const pairsOf = (fit) => [...PAIRS.filter(([measured]) => fit[measured]),
  ...Object.keys(fit).filter((column) => fit[`fitted_${column}`]).map((column) =>
    [column, `fitted_${column}`, ...ofName(column)])];
const alongOf = (fit) => {
  const known = Object.keys(ALONG).filter((name) => fit[name]);
  const shown = pairsOf(fit).flat();
  return known.length ? known
    : Object.keys(fit).filter((name) => !shown.includes(name) && !["specimen", "side"].includes(name));
};

const figure = (value) => written(value, Math.min(5, fittingDigits(value)));

export class IdentifyResult {
  constructor() {
    this.state = element("p", { id: "identify-state", role: "status" });
    this.command = element("code", { id: "identify-command", className: "command" });
    this.told = element("div", { id: "identify-told" });
    this.axes = element("div", { className: "fields" });
    this.chart = element("div", { id: "identify-chart" });
    this.residuals = element("div", { id: "identify-residuals" });
    this.place = element("section", { id: "identify-result", hidden: true, "aria-label": "what was found" },
      element("h2", { textContent: "Result" }), this.state, this.command, this.told, this.axes, this.chart,
      this.residuals);
  }

  show({ record, report, fit, text, log }) {
    this.place.hidden = false;
    this.command.textContent = record.command.map((word) => (/[\s'"]/.test(word) ? JSON.stringify(word) : word))
      .join(" ");
    this.state.textContent = this.words(record, report);
    this.state.className = record.state === "failed" ? "bad" : "";
    this.told.replaceChildren(...(report ? this.parts(report, record.about.output, text) : []));
    if (!report && record.state === "failed") {
      this.told.append(element("pre", { className: "bad", textContent: log.trim() }));
    }
    this.fit = fit;
    this.drawAxes();
  }

  words(record, report) {
    if (["queued", "starting", "running"].includes(record.state)) return "It is computed …";
    if (record.state === "stopped") return "Stopped.";
    if (report && report.status === "refused") return "Refused: nothing is written.";
    return report ? `${report.title}: ${report.words}. Written: ${record.about.output}` : "It has failed:";
  }

  /** forCase: text of a file that is no fabric's, but goes into a case. */
  parts(report, output, forCase) {
    const parts = [];
    for (const one of report.errors) {
      const place = `${one.file}${one.line > 1 ? `, line ${one.line}` : ""}`;
      parts.push(element("div", { className: "mistake" }, element("p", { className: "bad",
        textContent: `${place}: ${one.item}${one.value ? ` = ${one.value}` : ""}: ${one.rule}` }),
        element("p", { textContent: `Remedy: ${one.remedy}` })));
    }
    for (const text of report.warnings) parts.push(element("p", { className: "warning", textContent: text }));
    if (report.status !== "done") return parts;
    parts.push(element("p", { id: "identify-law", textContent: report.law }), this.numbers(report.numbers),
      element("ul", { id: "identify-figures" }, ...report.figures.map((text) => element("li", { textContent: text }))),
      element("details", {}, element("summary", { textContent: "More of it" }),
        element("ul", {}, ...report.notes.map((text) => element("li", { textContent: text })))));
    for (const law of report.missing) {
      parts.push(element("p", { className: "warning",
        textContent: `Still without a law: ${law}; no case can use the fabric before.` }));
    }
    if (forCase) {
      parts.push(element("p", { textContent: "Put this into a case, and name the law in contact.friction_law or in a "
        + "[[contact.pair]]:" }), element("pre", { id: "identify-text", textContent: forCase }));
      return parts;
    }
    parts.push(element("p", {}, element("a", { href: `#setup/${output}`,
      textContent: `Look at ${output}`, id: "identify-open" })));
    return parts;
  }

  numbers(numbers) {
    const head = ["number", "value", "95 % limits", "", "of the value"];
    const rows = numbers.map((one) => element("tr", {}, element("th", { scope: "row", textContent: one.name }),
      element("td", { className: "number",
        textContent: Number.isInteger(one.value) ? written(one.value, 0) : figure(one.value) }),
      element("td", { className: "number", textContent: one.limits === null ? "" : `± ${figure(one.limits)}` }),
      element("td", { textContent: one.unit }),
      element("td", { className: "number", textContent: one.limits === null || !one.value ? ""
        : `± ${written(Math.abs(100 * one.limits / one.value), 1)} %` })));
    return element("div", { className: "scroll" }, element("table", { id: "identify-numbers" },
      element("thead", {}, element("tr", {}, ...head.map((text) =>
        element("th", { scope: "col", textContent: text })))),
      element("tbody", {}, ...rows)));
  }

  drawAxes() {
    const names = this.fit ? alongOf(this.fit) : [];
    const before = this.x ? this.x.value : "";
    const log = Boolean(this.log && this.log.checked);
    this.axes.replaceChildren();
    if (names.length) {
      this.x = select(names.map((name) => [name, (ALONG[name] || ofName(name))[0]]),
        names.includes(before) ? before : names[0],
        { id: "identify-x" });
      this.x.addEventListener("change", () => this.draw());
      this.log = element("input", { type: "checkbox", id: "identify-log", checked: log });
      this.log.addEventListener("change", () => this.draw());
      this.axes.append(labelled("Over", this.x), element("label", { className: "box" }, this.log,
        ` logarithmic ${this.fit.measured ? "coefficient" : "load"}`));
    }
    this.draw();
  }

  draw() {
    this.chart.replaceChildren();
    this.residuals.replaceChildren();
    if (!this.fit || !this.axes.childElementCount) return;
    const [name, unit, factor] = ALONG[this.x.value] || ofName(this.x.value);
    const x = { name, unit, zero: true, log: OVER_DECADES.includes(this.x.value) };
    const curves = this.curves(factor);
    drawChart(this.chart, { title: "Measured and fitted", x, series: curves.flatMap((one) => one.both),
      y: { name: curves[0].what, unit: curves[0].unit, zero: true, log: this.log.checked } });
    drawChart(this.residuals, { title: "Residuals", x, y: { name: "fitted / measured − 1", unit: "%", zero: true },
      series: curves.map((one) => ({ ...one.rest, kind: "points" })) });
  }

  /** Of each specimen and pair of columns: points measured, a line fitted, residuals. */
  curves(factor) {
    const { side } = this.fit;
    const alone = new Set(this.fit.specimen).size === (this.fit.specimen || []).length; // a row each: one curve
    const specimen = alone ? undefined : this.fit.specimen;
    const pairs = pairsOf(this.fit);
    const groupOf = (i) => [side ? side[i] : "", specimen ? `specimen ${specimen[i]}` : ""].filter(Boolean).join(", ");
    const groups = [...new Set(this.fit[pairs[0][0]].map((_, i) => groupOf(i)))];
    return groups.flatMap((group) => pairs.map(([measured, fitted, what, unit]) => {
      const rows = this.fit[measured].map((_, i) => i).filter((i) =>
        groupOf(i) === group && this.fit[measured][i] !== null).sort((a, b) =>
        this.fit[this.x.value][a] - this.fit[this.x.value][b]);
      const of = (column, k = 1) => rows.map((i) => (this.fit[column][i] === null ? NaN : k * this.fit[column][i]));
      const along = of(this.x.value, factor);
      const [a, b] = [of(measured), of(fitted)];
      const words = [pairs.length > 1 ? what : "", groups.length > 1 ? group : ""].filter(Boolean).join(", ");
      const least = 0.01 * Math.max(...a.map(Math.abs));
      return { what: pairs.length > 1 ? "load" : what, unit, rest: { name: words || "rows", x: along,
        y: a.map((value, i) => (Math.abs(value) > least ? 100 * (b[i] / value - 1) : NaN)) },
      both: [{ name: `measured ${words}`.trim(), kind: "points", hollow: true, x: along, y: a },
        { name: `fitted ${words}`.trim(), kind: "line", dashes: "", x: along, y: b }] };
    }));
  }
}
