// SPDX-License-Identifier: GPL-3.0-or-later
// Plots of any two columns as SVG: axes with units, points, lines, bands, limits; texts or numbers
// along, linear or logarithmic. Curves over the stroke are in plyform/charts.js.

import { lineStyle } from "plyform/colours.js";
import { ticks } from "plyform/charts.js";
import { fittingDigits, written } from "plyform/numbers.js";

const NAMES = "http://www.w3.org/2000/svg";
const ROOM = { width: 560, height: 320, left: 70, right: 14, top: 12, bottom: 46 };
const FEW = 60; // points that are reached by the Tab key; of more the picture's own name speaks

function part(name, attributes, parent, text) {
  const made = document.createElementNS(NAMES, name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value !== undefined) made.setAttribute(key, value);
  }
  if (text !== undefined) made.textContent = text;
  parent.append(made);
  return made;
}

/** "load, N", or the name alone. */
export const titled = ({ name, unit }) => (unit ? `${name}, ${unit}` : name);

/** One axis: from values to pixels. `words`: values are places in a list of texts. */
class Axis {
  constructor(what, values, from, to) {
    Object.assign(this, { ...what, from, to });
    this.log = Boolean(what.log) && values.some((value) => value > 0);
    const fit = values.filter((value) => Number.isFinite(value) && (!this.log || value > 0));
    this.low = what.words ? -0.5 : Math.min(...fit);
    this.high = what.words ? what.words.length - 0.5 : Math.max(...fit);
    if (!Number.isFinite(this.low)) [this.low, this.high] = [0, 1];
    if (what.zero && !this.log && !what.words) {
      this.low = Math.min(0, this.low);
      this.high = Math.max(0, this.high);
    }
    this.widen();
  }

  /** So that no point lies on the frame. */
  widen() {
    if (this.words) return;
    if (this.log) {
      const more = (this.high / this.low) ** 0.04 || 1;
      this.low /= more === 1 ? 2 : more;
      this.high *= more === 1 ? 2 : more;
      return;
    }
    const more = 0.04 * (this.high - this.low) || 0.5 * Math.abs(this.high) || 1;
    if (!(this.zero && this.low === 0)) this.low -= more;
    if (!(this.zero && this.high === 0)) this.high += more;
  }

  /** NaN for what this axis cannot show. */
  at(value) {
    if (this.log && !(value > 0)) return NaN;
    const share = this.log ? Math.log(value / this.low) / Math.log(this.high / this.low)
      : (value - this.low) / (this.high - this.low);
    return this.from + share * (this.to - this.from);
  }

  /** Values that are written, with their texts. */
  marks() {
    if (this.words) return this.words.map((text, i) => [i, text.length > 14 ? `${text.slice(0, 13)}…` : text]);
    if (!this.log) {
      const { places, digits } = ticks(this.low, this.high);
      return places.map((value) => [value, written(value, digits)]);
    }
    const found = [];
    for (let power = Math.floor(Math.log10(this.low)); power <= Math.log10(this.high); ++power) {
      for (const step of [1, 2, 5]) {
        const value = step * 10 ** power;
        const text = written(value, Math.max(0, -power));
        if (value >= this.low && value <= this.high) found.push([value, text]);
      }
    }
    return found.length > 9 ? found.filter(([value]) => Math.log10(value) % 1 === 0) : found;
  }

  /** A value as it is read out. */
  said(value) {
    if (this.words) return this.words[value];
    return `${written(value, fittingDigits(value))}${this.unit ? ` ${this.unit}` : ""}`;
  }
}

function drawAxes(svg, x, y) {
  for (const [value, text] of y.marks()) {
    part("line", { class: "grid", x1: ROOM.left, x2: ROOM.width - ROOM.right, y1: y.at(value), y2: y.at(value) }, svg);
    part("text", { x: ROOM.left - 6, y: y.at(value) + 4, "text-anchor": "end" }, svg, text);
  }
  for (const [value, text] of x.marks()) {
    part("line", { class: "grid", x1: x.at(value), x2: x.at(value), y1: ROOM.top,
      y2: ROOM.height - ROOM.bottom }, svg);
    part("text", { x: x.at(value), y: ROOM.height - ROOM.bottom + 16, "text-anchor": "middle" }, svg, text);
  }
  part("text", { class: "of-axis", x: (ROOM.left + ROOM.width - ROOM.right) / 2, y: ROOM.height - 8,
    "text-anchor": "middle" }, svg, titled(x));
  part("text", { class: "of-axis", "text-anchor": "middle",
    transform: `translate(14 ${(ROOM.top + ROOM.height - ROOM.bottom) / 2}) rotate(-90)` }, svg, titled(y));
}

/** Corners of a line; a value that is not known parts it. */
function pieces(x, y, series, values) {
  const found = [[]];
  series.x.forEach((place, i) => {
    const corner = [x.at(place), y.at(values[i])];
    if (corner.every(Number.isFinite)) found[found.length - 1].push(corner.join(","));
    else if (found[found.length - 1].length) found.push([]);
  });
  return found.filter((corners) => corners.length);
}

function drawPoints(svg, x, y, series, colour, pick) {
  const few = series.x.length <= FEW;
  series.x.forEach((place, i) => {
    const [cx, cy] = [x.at(place), y.at(series.y[i])];
    if (!Number.isFinite(cx) || !Number.isFinite(cy)) return;
    const hollow = series.hollow === true || Boolean(series.hollow && series.hollow[i]);
    const text = `${series.labels ? `${series.labels[i]}: ` : ""}${x.said(place)}; ${y.said(series.y[i])}`;
    const point = part("circle", { cx, cy, r: few ? 5 : 3, class: "point", stroke: colour, "stroke-width": 1.6,
      fill: hollow ? "#fff" : colour, "fill-opacity": hollow ? 0.6 : 0.85 }, svg);
    part("title", {}, point, text);
    if (!pick) return;
    point.dataset.index = i;
    point.classList.add("picked");
    if (few) Object.entries({ tabindex: 0, role: "button", "aria-label": text })
      .forEach(([key, value]) => point.setAttribute(key, value));
    point.addEventListener("click", () => pick(series, i));
    point.addEventListener("keydown", (event) => {
      if (event.key === "Enter") pick(series, i);
    });
  });
}

function drawSeries(svg, x, y, series, k, pick) {
  const [own, dashes] = lineStyle(k);
  const colour = series.colour || own;
  if (series.kind === "band") {
    const up = series.x.map((place, i) => [x.at(place), y.at(series.high[i])]);
    const down = series.x.map((place, i) => [x.at(place), y.at(series.low[i])]).reverse();
    const corners = [...up, ...down].filter((corner) => corner.every(Number.isFinite));
    part("polygon", { points: corners.join(" "), fill: colour, "fill-opacity": 0.15, stroke: "none" }, svg);
    return;
  }
  if (series.kind === "points") {
    drawPoints(svg, x, y, series, colour, pick);
    return;
  }
  for (const corners of pieces(x, y, series, series.y)) {
    part("polyline", { points: corners.join(" "), fill: "none", stroke: colour, "stroke-width": 2,
      "stroke-dasharray": series.dashes === undefined ? dashes : series.dashes }, svg);
  }
}

function drawLimits(svg, y, limits) {
  for (const { value, text } of limits) {
    const at = y.at(value);
    if (!(at >= ROOM.top && at <= ROOM.height - ROOM.bottom)) continue;
    part("line", { class: "limit", x1: ROOM.left, x2: ROOM.width - ROOM.right, y1: at, y2: at }, svg);
    part("text", { class: "limit", x: ROOM.width - ROOM.right - 4, y: at - 4, "text-anchor": "end" }, svg, text);
  }
}

function legend(place, all) {
  if (all.filter((series) => series.name).length < 2) return;
  const list = document.createElement("ul");
  list.className = "legend-of-lines";
  all.forEach((series, k) => {
    if (!series.name) return;
    const [own, dashes] = lineStyle(k);
    const colour = series.colour || own;
    const item = document.createElement("li");
    const sample = part("svg", { viewBox: "0 0 28 10", width: 28, height: 10, "aria-hidden": "true" }, item);
    if (series.kind === "points") {
      part("circle", { cx: 14, cy: 5, r: 4, stroke: colour, "stroke-width": 1.6,
        fill: series.hollow === true ? "#fff" : colour }, sample);
    } else if (series.kind === "band") {
      part("rect", { width: 28, height: 10, fill: colour, "fill-opacity": 0.2 }, sample);
    } else {
      part("line", { x1: 0, x2: 28, y1: 5, y2: 5, stroke: colour, "stroke-width": 2,
        "stroke-dasharray": series.dashes === undefined ? dashes : series.dashes }, sample);
    }
    item.append(` ${series.name}`);
    list.append(item);
  });
  place.append(list);
}

/** Draws into `place` (what was there goes) and returns the <svg>.
 * `what`: {title, x, y: {name, unit, log, zero (0 is shown), words (a list of texts; values are then
 * places in it)}, series: [{name, kind: "line" | "points" | "band", x, y (of a band low and high),
 * labels, hollow (true, or a list), colour, dashes}], limits: [{value, text}] (lines across),
 * pick(series, index): a point is clicked}. What is no number, or not above 0 on a logarithmic axis,
 * is left out. */
export function drawChart(place, what) {
  place.replaceChildren();
  const all = what.series;
  const svg = part("svg", { viewBox: `0 0 ${ROOM.width} ${ROOM.height}`, class: "chart",
    role: what.pick ? "group" : "img",
    "aria-label": `${what.title}: ${titled(what.y)} over ${titled(what.x)}` }, place);
  const limits = what.limits || [];
  const x = new Axis(what.x, all.flatMap((series) => series.x), ROOM.left, ROOM.width - ROOM.right);
  const y = new Axis(what.y, [...all.flatMap((series) => (series.kind === "band" ? [...series.low, ...series.high]
    : series.y)), ...limits.map(({ value }) => value)], ROOM.height - ROOM.bottom, ROOM.top);
  drawAxes(svg, x, y);
  drawLimits(svg, y, limits);
  all.forEach((series, k) => drawSeries(svg, x, y, series, k, what.pick));
  legend(place, all);
  return svg;
}
