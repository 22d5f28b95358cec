// SPDX-License-Identifier: GPL-3.0-or-later
// Controls of single values: each calls `changed(value)`, null for a key that is taken away.

import { element } from "workbench/page/elements.js";
import { defaultWords, fallbackOf, ofColumn } from "workbench/setup/keys_table.js";

const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$/;

/** A number as it is typed, with a comma or a full stop; NaN if it is none. */
export function numberOf(text) {
  const plain = text.trim().replace(",", ".");
  return NUMBER.test(plain) ? Number(plain) : NaN;
}

/** What is wrong with a number of a column, or "". */
export function wrongWith(row, value, column = 0) {
  const [least, most] = [ofColumn(row.least, column), ofColumn(row.most, column)];
  const [openLeast, openMost] = [ofColumn(row.open_least, column), ofColumn(row.open_most, column)];
  if (Number.isNaN(value)) return "no number";
  if (row.kind === "integer" && !Number.isInteger(value)) return "no whole number";
  if (least !== null && (value < least ||
    (openLeast && value === least))) return `${openLeast ? "more than" : "at least"} ${least}`;
  if (most !== null && (value > most || (openMost &&
    value === most))) return `${openMost ? "less than" : "at most"} ${most}`;
  return "";
}

export function unusual(row, value, column = 0) {
  const [least, most] = [ofColumn(row.usual_least, column), ofColumn(row.usual_most, column)];
  if ((least !== null && value < least) || (most !== null && value > most)) {
    return `usually ${least === null ? "up" : least} to ${most === null ? "any" : most}`;
  }
  return "";
}

/** Shows what is wrong or unusual beside an input. */
function judge(input, row, column) {
  const text = input.value.trim();
  const value = numberOf(text);
  const wrong = text === "" ? "" : wrongWith(row, value, column);
  const odd = text === "" || wrong ? "" : unusual(row, value, column);
  input.classList.toggle("wrong", Boolean(wrong));
  input.classList.toggle("odd", Boolean(odd));
  input.title = wrong || odd;
  return wrong;
}

/** One number; `part` tells the inputs of one key apart. */
export function numberInput(row, key, value, changed, { column = 0, part = "", empty = true, hint = "" } = {}) {
  const input = element("input", { type: "text", inputMode: "decimal", className: "number", spellcheck: false,
    autocomplete: "off", value: value === undefined || value === null ? "" : String(value), placeholder: hint,
    dataset: { key, part: String(part) }, "aria-label": `${key}${part === "" ? "" : ` ${part}`}` });
  judge(input, row, column);
  input.addEventListener("input", () => judge(input, row, column));
  input.addEventListener("keydown", (event) => {
    const step = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (event.key === "Enter") input.blur();
    if (!step || Number.isNaN(numberOf(input.value))) return;
    event.preventDefault();
    const size = event.shiftKey ? 10 : event.altKey ? 0.1 : 1;
    input.value = String(Number((numberOf(input.value) + step * size).toPrecision(12)));
    judge(input, row, column);
  });
  input.addEventListener("change", () => {
    const text = input.value.trim();
    if (text === "" && !empty) return;
    const wrong = judge(input, row, column);
    if (text === "") changed(null);
    else if (wrong !== "no number" && wrong !== "no whole number") changed(numberOf(text));
  });
  return input;
}

export function textInput(row, key, value, changed) {
  const input = element("input", { type: "text", value: value === undefined ? "" : String(value), spellcheck: false,
    autocomplete: "off", placeholder: defaultWords(row), dataset: { key, part: "" }, "aria-label": key });
  input.addEventListener("change", () => changed(input.value === "" ? null : input.value));
  input.addEventListener("keydown", (event) => event.key === "Enter" && input.blur());
  return input;
}

/** A list of values to choose from; the first line is the default, or that one must be chosen. */
export function selectInput(row, key, value, choices, changed) {
  const words = defaultWords(row);
  const select = element("select", { dataset: { key, part: "" }, "aria-label": key });
  const none = element("option", { value: "", textContent: words ? `${words} (default)` : "choose" });
  if (!row.required || value === undefined) select.append(none);
  for (const choice of choices) select.append(element("option", { value: choice, textContent: choice }));
  if (value !== undefined && !choices.includes(value)) {
    select.append(element("option", { value, textContent: `${value} (not there)` }));
  }
  select.value = value === undefined ? "" : value;
  select.addEventListener("change", () => changed(select.value === "" ? null : select.value));
  return select;
}

export function booleanInput(row, key, value, changed) {
  const given = value === undefined ? fallbackOf(row) === true : value;
  const input = element("input", { type: "checkbox", checked: given, dataset: { key, part: "" }, "aria-label": key });
  input.addEventListener("change", () => changed(input.checked));
  return input;
}

/** A fixed number of numbers in a row: sizes, places, directions. */
export function numbersInput(row, key, value, changed) {
  const standing = fallbackOf(row);
  const shown = Array.isArray(value) ? value : [];
  const count = row.count || Math.max(shown.length + 1, 2);
  const line = element("span", { className: "numbers" });
  const inputs = [];
  const commit = () => {
    const texts = inputs.map((input) => input.value.trim());
    const given = texts.filter((text) => text !== "");
    if (!given.length) changed(null);
    else if (!row.count) changed(given.map(numberOf));
    else if (given.length === row.count) changed(texts.map(numberOf));
    else if (Array.isArray(standing)) changed(texts.map((text, k) => (text === "" ? standing[k] : numberOf(text))));
  };
  for (let k = 0; k < count; ++k) {
    inputs.push(numberInput(row, key, shown[k], commit, { column: k, part: k,
      hint: Array.isArray(standing) && standing[k] !== undefined ? String(standing[k]) : "" }));
  }
  line.append(...inputs);
  return line;
}

/** A round dial for an angle in degrees: `turned(angle, done)`. */
export function dial(key, angle, turned) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  for (const [name, value] of Object.entries({ class: "dial", viewBox: "-20 -20 40 40", role: "slider", tabindex: 0,
    "aria-label": `dial of ${key}`, "data-dial": key })) svg.setAttribute(name, value);
  svg.innerHTML = '<circle r="17"/><path d="M-17 0H-13M13 0H17M0 -17V-13M0 13V17"/>' +
    '<line x1="0" y1="0"/><circle class="knob" r="4"/>';
  const show = (value) => {
    const a = (value * Math.PI) / 180;
    const [x, y] = [(13 * Math.cos(a)).toFixed(2), (-13 * Math.sin(a)).toFixed(2)];
    svg.querySelector("line").setAttribute("x2", x);
    svg.querySelector("line").setAttribute("y2", y);
    svg.querySelector(".knob").setAttribute("transform", `translate(${x} ${y})`);
    svg.setAttribute("aria-valuenow", value);
  };
  let now = angle;
  const at = (event) => {
    const box = svg.getBoundingClientRect();
    const turn = Math.atan2(box.top + box.height / 2 - event.clientY, event.clientX - box.left - box.width / 2);
    const step = event.shiftKey ? 15 : 1;
    now = step * Math.round((turn * 180) / Math.PI / step);
    show(now);
    turned(now, false);
  };
  svg.addEventListener("pointerdown", (event) => { svg.setPointerCapture(event.pointerId); at(event); });
  svg.addEventListener("pointermove", (event) => event.buttons && at(event));
  svg.addEventListener("pointerup", () => turned(now, true));
  svg.show = show;
  show(angle);
  return svg;
}
