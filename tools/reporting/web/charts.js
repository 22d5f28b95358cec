// SPDX-License-Identifier: GPL-3.0-or-later
// Curves over the stroke, or the time, as SVG; a line marks the state shown, a click goes to another.

import { lineStyle } from "plyform/colours.js";
import { prefixOf } from "plyform/letters.js";
import { fittingDigits, written } from "plyform/numbers.js";

const NAMES = "http://www.w3.org/2000/svg";
const SIZE = { width: 420, height: 230, left: 56, right: 10, top: 10, bottom: 34 };

function part(name, attributes, parent, text) {
  const made = document.createElementNS(NAMES, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  parent.append(made);
  return made;
}

/** Round numbers from low to high, five or so. */
export function ticks(low, high) {
  const rough = (high - low) / 4 || 1;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 2.5, 5, 10].map((k) => k * power).find((size) => size >= rough);
  const places = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) places.push(k * step);
  return { places, digits: Math.max(0, -Math.floor(Math.log10(step) + 1e-9) + (step / power === 2.5 ? 1 : 0)) };
}

/** What tells the lines of C and D from those of A (thick) and B (thin): circles, squares. */
function mark(run, x, y, colour, parent) {
  if (run === 2) part("circle", { class: "mark", cx: x, cy: y, r: 2.6, fill: "#fff", stroke: colour }, parent);
  if (run === 3) part("rect", { class: "mark", x: x - 2.3, y: y - 2.3, width: 4.6, height: 4.6, fill: colour }, parent);
}

export class Chart {
  /**
   * `runs`: of each run, how far its states are (along: { word, unit }) and the lines of this chart.
   * `go(reached)`: shows a state.
   */
  constructor(place, chart, runs, along, go) {
    this.svg = part("svg", { viewBox: `0 0 ${SIZE.width} ${SIZE.height}`, role: "img",
      "aria-label": `${chart.title}, ${chart.unit}, over the ${along.word}` }, place);
    this.unit = chart.unit;
    this.along = along;
    this.runs = runs;
    const reached = runs.flatMap((run) => run.reached);
    const values = runs.flatMap((run) => run.lines.flatMap((line) => line.values.filter(Number.isFinite)));
    [this.low, this.high] = [Math.min(0, ...values), Math.max(0, ...values)];
    if (this.high === this.low) this.high = this.low + 1;
    [this.from, this.to] = [Math.min(...reached), Math.max(...reached)];
    if (this.to === this.from) this.to = this.from + 1;
    this.axes();
    this.lines();
    this.mark = part("line", { class: "state", y1: SIZE.top, y2: SIZE.height - SIZE.bottom }, this.svg);
    this.legend(place);
    this.svg.addEventListener("click", (event) => {
      const room = this.svg.getBoundingClientRect();
      const x = ((event.clientX - room.left) / room.width) * SIZE.width;
      const share = (x - SIZE.left) / (SIZE.width - SIZE.left - SIZE.right);
      go(this.from + share * (this.to - this.from));
    });
  }

  x(reached) {
    return SIZE.left + ((reached - this.from) / (this.to - this.from)) * (SIZE.width - SIZE.left - SIZE.right);
  }

  y(value) {
    return SIZE.height - SIZE.bottom -
      ((value - this.low) / (this.high - this.low)) * (SIZE.height - SIZE.top - SIZE.bottom);
  }

  axes() {
    const up = ticks(this.low, this.high);
    for (const value of up.places) {
      const y = this.y(value);
      part("line", { class: "grid", x1: SIZE.left, x2: SIZE.width - SIZE.right, y1: y, y2: y }, this.svg);
      part("text", { x: SIZE.left - 6, y: y + 4, "text-anchor": "end" }, this.svg, written(value, up.digits));
    }
    const along = ticks(this.from, this.to);
    for (const value of along.places) {
      part("text", { x: this.x(value), y: SIZE.height - SIZE.bottom + 16, "text-anchor": "middle" },
        this.svg, written(value, along.digits));
    }
    part("text", { x: SIZE.width - SIZE.right, y: SIZE.height - 3, "text-anchor": "end" }, this.svg,
      `${this.along.word}, ${this.along.unit}`);
  }

  lines() {
    this.runs.forEach((run, r) => run.lines.forEach((line, k) => {
      const [colour, dashes] = lineStyle(k);
      const points = line.values.flatMap((value, i) => (Number.isFinite(value) // else not known
        ? [`${this.x(run.reached[i])},${this.y(value)}`] : [])).join(" ");
      part("polyline", { points, fill: "none", stroke: colour, "stroke-width": r ? 1.2 : 2.2,
        "stroke-dasharray": dashes, "stroke-opacity": r ? 0.75 : 1 }, this.svg);
      line.values.forEach((value, i) => {
        if (Number.isFinite(value)) mark(r, this.x(run.reached[i]), this.y(value), colour, this.svg);
      });
    }));
  }

  legend(place) {
    const list = document.createElement("ul");
    list.className = "legend-of-lines";
    this.numbers = [];
    this.runs.forEach((run, r) => run.lines.forEach((line, k) => {
      const item = document.createElement("li");
      const sample = part("svg", { viewBox: "0 0 28 8", width: 28, height: 8, "aria-hidden": "true" }, item);
      const [colour, dashes] = lineStyle(k);
      part("line", { x1: 0, x2: 28, y1: 4, y2: 4, stroke: colour, "stroke-width": r ? 1.2 : 2.2,
        "stroke-dasharray": dashes }, sample);
      mark(r, 14, 4, colour, sample);
      item.append(` ${prefixOf(r, this.runs)}${line.name} `);
      const number = document.createElement("b");
      item.append(number);
      list.append(item);
      this.numbers.push({ number, run, line, r });
    }));
    place.append(list);
  }

  /** The line, and the values beside the names. */
  show(reached, states) {
    this.mark.setAttribute("x1", this.x(reached));
    this.mark.setAttribute("x2", this.x(reached));
    const digits = fittingDigits(Math.max(Math.abs(this.low), Math.abs(this.high)));
    for (const { number, line, r } of this.numbers) {
      const value = line.values[states[r]];
      number.textContent = Number.isFinite(value) ? `${written(value, digits)} ${this.unit}` : "not known";
    }
  }
}
