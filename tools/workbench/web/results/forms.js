// SPDX-License-Identifier: GPL-3.0-or-later
// What exports, lay-ups and patterns are asked by. A field: place (its part of the page), key and value().

import { element } from "workbench/page/elements.js";

const labelled = (text, input, title = "") =>
  element("label", { title }, element("span", { textContent: text }), input);

function choices(key, text, id, words, chosen) {
  const boxes = words.map((word) => element("input", { type: "checkbox", id: `${id}-${word}`, value: word,
    checked: chosen.includes(word) }));
  return { key, value: () => boxes.filter((box) => box.checked).map((box) => box.value),
    place: element("fieldset", {}, element("legend", { textContent: text }),
      ...boxes.map((box) => element("label", {}, box, ` ${box.value}`))) };
}

/** `optionsOf(offers)`: [value, words] of each. What is chosen stays while it is offered. */
function select(key, text, id, offers, optionsOf, title = "") {
  const input = element("select", { id });
  const offer = (now) => {
    const before = input.value;
    const options = optionsOf(now);
    input.replaceChildren(...options.map(([value, words]) => element("option", { value, textContent: words })));
    if (options.some(([value]) => value === before)) input.value = before;
  };
  offer(offers);
  return { key, value: () => input.value, offer, place: labelled(text, input, title) };
}

function number(key, text, id, value, attributes = {}) {
  const input = element("input", { type: "number", id, value, step: "any", ...attributes });
  return { key, value: () => (Number.isFinite(input.valueAsNumber) ? input.valueAsNumber : undefined),
    place: labelled(text, input) };
}

function three(key, text, id) {
  const inputs = ["x", "y", "z"].map((axis) => element("input", { type: "number", step: "any", value: 0,
    id: `${id}-${axis}`, "aria-label": `${text}, ${axis}` }));
  return { key, value: () => inputs.map((input) => input.valueAsNumber || 0),
    place: element("div", { className: "three" }, element("span", { textContent: text }), ...inputs) };
}

function tick(key, text, id) {
  const input = element("input", { type: "checkbox", id });
  return { key, value: () => input.checked, place: element("label", {}, input, ` ${text}`) };
}

/** "", "all", or the number of a state. */
function frame(id, all) {
  const input = element("input", { id, placeholder: "last", size: 6, pattern: all ? "[0-9]*|all" : "[0-9]*" });
  return { key: "frame", value: () => (/^[0-9]+$/.test(input.value.trim()) ? Number(input.value) : input.value.trim()),
    place: labelled(all ? "State, from 0, or all" : "State, from 0", input) };
}

const files = (names, none) => [["", none], ...names.map((name) => [name, name])];
const mirror = (id) => choices("mirror", "Half model, mirrored at", id, ["x", "y"], []);

export const FORMS = [
  { what: "export", title: "Export states", fields: (offers) => [
    choices("formats", "Formats", "export", offers.states, ["vtu"]), frame("export-frame", true)] },
  { what: "map", title: "Lay-up for analysis", fields: (offers) => [
    select("part", "Part mesh", "map-part", offers, ({ parts }) => files(parts, "none: the plies' own meshes")),
    choices("formats", "Formats", "map", offers.layups, ["csv"]),
    select("reference", "Angles from", "map-reference", offers,
      ({ references }) => references.map((one) => [one, one || "as the part gives, else x"])),
    number("scale", "Unit of the mesh, mm", "map-scale", 1), three("turn", "Turned, °", "map-turn"),
    three("move", "Moved, mm", "map-move"), tick("two", "Each woven ply as two UD plies", "map-two"),
    mirror("map-mirror"), frame("map-frame", false)] },
  { what: "pattern", title: "Flat patterns", fields: (offers) => [
    select("trim", "Trim line", "pattern-trim", offers,
      ({ outlines }) => files(outlines, "choose a .csv or .dxf file")),
    tick("space", "It is a curve in space", "pattern-space"),
    select("case", "Corrected by runs of", "pattern-case", offers,
      ({ cases }) => files(cases, "no case: unfolded once"),
      "The case of this run: it is run with the patterns as blanks until the edge is right"),
    number("tolerance", "Edge within, mm", "pattern-tolerance", 1),
    number("iterations", "Runs at most", "pattern-iterations", 4, { step: 1 }),
    mirror("pattern-mirror"), frame("pattern-frame", false)] },
];
