// SPDX-License-Identifier: GPL-3.0-or-later
// A drawing in the exchange format DXF, drawn: lines, polylines with arcs, circles, arcs, texts. What
// else is in it is told. Numbers of groups: AutoCAD 2012 DXF Reference.

const NAMES = "http://www.w3.org/2000/svg";
const COLOURS = ["#a4003e", "#00629b", "#1d2b36", "#8a5300", "#20683c", "#5b6772"]; // of layers, in their order
const STEP = Math.PI / 36; // of arcs

/** [code, text] of each pair of lines. */
function groupsOf(text) {
  const lines = text.split(/\r\n|\n|\r/);
  const groups = [];
  for (let i = 0; i + 1 < lines.length; i += 2) groups.push([Number(lines[i]), lines[i + 1].trim()]);
  return groups;
}

/** Entities of the section ENTITIES: kind and groups. */
function entitiesOf(text) {
  const found = [];
  let inside = false;
  for (const [code, value] of groupsOf(text)) {
    if (code === 2 && value === "ENTITIES") inside = true;
    else if (code === 0 && value === "ENDSEC") inside = false;
    else if (inside && code === 0) found.push({ kind: value, groups: [] });
    else if (inside && found.length) found[found.length - 1].groups.push([code, value]);
  }
  return found;
}

const all = (one, code) => one.groups.filter(([c]) => c === code).map(([, value]) => Number(value));
const first = (one, code, otherwise = 0) => {
  const [value] = all(one, code);
  return Number.isFinite(value) ? value : otherwise;
};
const word = (one, code) => (one.groups.find(([c]) => c === code) || [0, ""])[1];

function arc(x, y, radius, from, to) {
  const count = Math.max(2, Math.ceil(Math.abs(to - from) / STEP) + 1);
  return Array.from({ length: count }, (_, i) => from + ((to - from) * i) / (count - 1))
    .map((angle) => [x + radius * Math.cos(angle), y + radius * Math.sin(angle)]);
}

/** From a to b with a bulge: the tangent of a quarter of the angle that the arc turns. */
function bulged(a, b, bulge) {
  if (!bulge) return [a];
  const turn = 4 * Math.atan(bulge);
  const along = Math.atan2(b[1] - a[1], b[0] - a[0]);
  const radius = Math.hypot(b[0] - a[0], b[1] - a[1]) / 2 / Math.sin(turn / 2);
  const from = along - turn / 2 - Math.PI / 2;
  const [x, y] = [a[0] - radius * Math.cos(from), a[1] - radius * Math.sin(from)];
  return arc(x, y, radius, from, from + turn).slice(0, -1);
}

function polyline(corners, closed) {
  const next = closed ? [...corners.slice(1), corners[0]] : corners.slice(1);
  const points = next.flatMap((b, i) => bulged(corners[i].at, b.at, corners[i].bulge));
  points.push((closed ? corners[0] : corners[corners.length - 1]).at);
  return points;
}

/** Corners of LWPOLYLINE: a bulge belongs to the corner before it. */
function lightCorners(one) {
  const corners = [];
  for (const [code, value] of one.groups) {
    if (code === 10) corners.push({ at: [Number(value), 0], bulge: 0 });
    else if (corners.length && code === 20) corners[corners.length - 1].at[1] = Number(value);
    else if (corners.length && code === 42) corners[corners.length - 1].bulge = Number(value);
  }
  return corners;
}

const point = (one, code = 10) => [first(one, code), first(one, code + 10)];
const degrees = (angle) => (angle * Math.PI) / 180;

/** {lines: [{layer, points}], texts: [{layer, at, height, text}], left: kinds that are not drawn}. */
export function readDrawing(text) {
  const drawing = { lines: [], texts: [], left: new Set() };
  let vertices = null;
  for (const one of entitiesOf(text)) {
    const layer = word(one, 8);
    const add = (points) => { if (points.length > 1) drawing.lines.push({ layer, points }); };
    if (one.kind === "VERTEX" && vertices) vertices.corners.push({ at: point(one), bulge: first(one, 42) });
    else if (one.kind === "SEQEND" && vertices) {
      const { corners, closed } = vertices;
      if (corners.length) drawing.lines.push({ layer: vertices.layer, points: polyline(corners, closed) });
      vertices = null;
    } else if (one.kind === "POLYLINE") vertices = { layer, closed: first(one, 70) & 1, corners: [] };
    else if (one.kind === "LWPOLYLINE") {
      const corners = lightCorners(one);
      if (corners.length) add(polyline(corners, first(one, 70) & 1));
    } else if (one.kind === "LINE") add([point(one), point(one, 11)]);
    else if (one.kind === "CIRCLE") add(arc(...point(one), first(one, 40), 0, 2 * Math.PI));
    else if (one.kind === "ARC") {
      const [from, to] = [degrees(first(one, 50)), degrees(first(one, 51))];
      add(arc(...point(one), first(one, 40), from, to < from ? to + 2 * Math.PI : to));
    } else if (one.kind === "TEXT" || one.kind === "MTEXT") {
      drawing.texts.push({ layer, at: point(one), height: first(one, 40, 1), text: word(one, 1) });
    } else drawing.left.add(one.kind);
  }
  drawing.lines = drawing.lines.filter(({ points }) => points.flat().every(Number.isFinite));
  return drawing;
}

function part(name, attributes, parent, text) {
  const made = document.createElementNS(NAMES, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  parent.append(made);
  return made;
}

/** Draws it into `place`; what the drawing is, in words. */
export function drawDrawing(place, text, name) {
  const { lines, texts, left } = readDrawing(text);
  place.replaceChildren();
  if (!lines.length) return `${name}: nothing in it that can be drawn`;
  const points = lines.flatMap((line) => line.points);
  const [low, high] = [Math.min, Math.max].map((of) =>
    [0, 1].map((k) => points.reduce((best, p) => of(best, p[k]), points[0][k])));
  const [wide, tall] = [high[0] - low[0], high[1] - low[1]];
  const margin = 0.05 * Math.max(wide, tall, 1e-9);
  const svg = part("svg", { class: "drawing", role: "img",
    "aria-label": `${name}, ${wide.toFixed(1)} by ${tall.toFixed(1)}`,
    viewBox: `${low[0] - margin} ${-high[1] - margin} ${wide + 2 * margin} ${tall + 2 * margin}` }, place);
  const layers = [...new Set([...lines, ...texts].map(({ layer }) => layer))];
  const colour = (layer) => COLOURS[layers.indexOf(layer) % COLOURS.length];
  for (const line of lines) {
    part("polyline", { points: line.points.map(([x, y]) => `${x},${-y}`).join(" "), fill: "none",
      stroke: colour(line.layer), "vector-effect": "non-scaling-stroke", "data-layer": line.layer }, svg);
  }
  for (const one of texts) {
    part("text", { x: one.at[0], y: -one.at[1], "font-size": one.height, fill: colour(one.layer) }, svg, one.text);
  }
  const size = `${wide.toFixed(1)} × ${tall.toFixed(1)} in the unit of the drawing`;
  return `${name}: ${size}; layers ${layers.join(", ")}${left.size ? `; not drawn: ${[...left].join(", ")}` : ""}`;
}
