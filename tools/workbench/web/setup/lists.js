// SPDX-License-Identifier: GPL-3.0-or-later
// Values that are lists, as tables: pairs, points of profiles and outlines with their arcs, holes.

import { button, element } from "workbench/page/elements.js";
import { numberInput, numberOf } from "workbench/setup/inputs.js";

const unitsOf = (row) => (row.unit || "-").split(",").map((unit) => unit.trim());

const small = (text, title, act, name) => button(text, act, { className: "small", title, "aria-label": title,
  dataset: { act: name } });

/** Rows of numbers copied from a spreadsheet; null if it is one value. */
function pasted(text) {
  const rows = text.trim().split(/\r?\n/).map((line) => line.trim().split(/[\t; ]+/).map(numberOf));
  return rows.flat().length > 1 && rows.flat().every((value) => !Number.isNaN(value)) ? rows : null;
}

/** A list of [a, b]; `columns` names them. */
export function pairsInput(row, key, value, changed) {
  const rows = (Array.isArray(value) ? value : []).map((pair) => [...pair]);
  const units = unitsOf(row);
  const body = element("tbody");
  const commit = () => {
    const whole = rows.filter((pair) => pair.length > 1 && pair.every((one) => one !== null && one !== undefined));
    if (whole.length === rows.length) changed(rows.length ? rows : null);
  };
  rows.forEach((pair, i) => body.append(element("tr", {}, ...[0, 1].map((k) => element("td", {},
    numberInput(row, key, pair[k], (given) => { pair[k] = given; commit(); },
      { column: k, part: `${i}.${k}`, empty: false }))),
  element("td", {}, small("−", `Remove row ${i + 1}`, () => { rows.splice(i, 1); commit(); }, "remove-row")))));
  const last = rows.length ? rows[rows.length - 1] : null;
  const more = small("+ row", "Add a row", () => {
    rows.push(last ? [...last] : [0, 0]);
    changed(rows);
  }, "add-row");
  const table = element("table", { className: "list", dataset: { list: key } }, element("thead", {}, element("tr", {},
    ...[0, 1].map((k) => element("th", { textContent: units[Math.min(k, units.length - 1)] })), element("th", {}))),
    body);
  table.addEventListener("paste", (event) => {
    const found = pasted(event.clipboardData.getData("text"));
    if (!found || found.some((one) => one.length !== 2)) return;
    event.preventDefault();
    changed(found);
  });
  return element("div", { className: "list-of" }, table, more);
}

const isArc = (point) => !Array.isArray(point);

/** Inputs of one point of a profile or outline: [a, b], [a, b, fillet] or an arc. */
function pointInputs(row, key, point, i, put) {
  const number = (value, part, act, hint) => numberInput(row, key, value, act,
    { part: `${i}.${part}`, empty: part === "fillet",
    hint });
  if (!isArc(point)) {
    return [number(point[0], "a", (v) => put([v, ...point.slice(1)])), number(point[1], "b", (v) => put([point[0], v,
      ...point.slice(2)])), number(point[2], "fillet", (v) => put(v === null ? point.slice(0, 2) : [point[0],
      point[1], v]), "fillet")];
  }
  const turn = element("select", { dataset: { key, part: `${i}.turn` }, "aria-label": `${key} ${i} turn` },
    ...["left", "right"].map((way) => element("option", { value: way, textContent: way })));
  turn.value = point.turn || "left";
  turn.addEventListener("change", () => put({ ...point, turn: turn.value }));
  const pair = (name) => [0, 1].map((k) => number((point[name] || [])[k], `${name}${k}`, (v) => {
    const now = [...(point[name] || [0, 0])];
    now[k] = v;
    put({ ...point, [name]: now });
  }));
  return [...pair("to"), element("small", { textContent: "about" }), ...pair("centre"), turn];
}

export function profileInput(row, key, value, changed, part = "") {
  const points = Array.isArray(value) ? [...value] : [];
  const list = element("div", { className: "points", dataset: { list: key + part } });
  points.forEach((point, i) => {
    const put = (next) => { points[i] = next; changed(points); };
    const kind = element("select", { className: "kind", dataset: { key, part: `${part}${i}.kind` },
      "aria-label": `${key} ${part}${i} kind` }, element("option", { value: "point", textContent: "point" }),
    element("option", { value: "arc", textContent: "arc" }));
    kind.value = isArc(point) ? "arc" : "point";
    kind.addEventListener("change", () => put(kind.value === "arc"
      ? { to: point.slice(0, 2), centre: [0, 0], turn: "left" } : [...(point.to || [0, 0])]));
    list.append(element("div", { className: "point" }, kind, ...pointInputs(row, key, point, part + i, put),
      small("−", `Remove point ${i + 1}`, () => { points.splice(i, 1); changed(points.length ? points : null); },
      "remove-row")));
  });
  list.append(small("+ point", "Add a point", () => {
    const last = points[points.length - 1];
    points.push(last ? [...(isArc(last) ? last.to : last.slice(0, 2))] : [0, 0]);
    changed(points);
  }, "add-row"));
  return list;
}

/** Holes: circles and outlines. */
export function outlinesInput(row, key, value, changed) {
  const holes = Array.isArray(value) ? [...value] : [];
  const list = element("div", { className: "holes", dataset: { list: key } });
  holes.forEach((hole, i) => {
    const put = (next) => { holes[i] = next; changed(holes); };
    const remove = small("−", `Remove hole ${i + 1}`, () => { holes.splice(i, 1); changed(holes.length ? holes
      : null); }, "remove-row");
    if (Array.isArray(hole)) {
      list.append(element("fieldset", {}, element("legend", {}, `hole ${i + 1} `, remove),
        profileInput(row, key, hole, put, `${i}.`)));
      return;
    }
    const number = (now, part, act) => numberInput(row, key, now, act, { part: `${i}.${part}`, empty: false });
    const centre = hole.centre || [0, 0];
    list.append(element("div", { className: "point" }, element("small", { textContent: "circle" }),
      number(centre[0], "x", (v) => put({ ...hole, centre: [v, centre[1]] })),
      number(centre[1], "y", (v) => put({ ...hole, centre: [centre[0], v] })),
        element("small", { textContent: "radius" }),
      number(hole.radius, "radius", (v) => put({ ...hole, radius: v })), remove));
  });
  list.append(small("+ round hole", "Add a round hole", () => changed([...holes, { centre: [0, 0], radius: 10 }]),
    "add-circle"),
    small("+ hole", "Add a hole with corners", () => changed([...holes, [[-5, -5], [5, -5], [5, 5], [-5, 5]]]),
      "add-outline"));
  return list;
}

/** Names, of a fixed number or any. */
export function namesInput(row, key, value, choices, changed) {
  const names = Array.isArray(value) ? [...value] : [];
  const count = row.count || names.length + 1;
  const line = element("span", { className: "numbers" });
  for (let k = 0; k < count; ++k) {
    const select = element("select", { dataset: { key, part: String(k) }, "aria-label": `${key} ${k}` },
      element("option", { value: "", textContent: "choose" }),
      ...[...new Set([...choices, ...names])].map((name) => element("option", { value: name, textContent: name })));
    select.value = names[k] || "";
    select.addEventListener("change", () => {
      names[k] = select.value;
      const given = names.filter(Boolean);
      if (!row.count || given.length === row.count) changed(given.length ? given : null);
    });
    line.append(select);
  }
  return line;
}
