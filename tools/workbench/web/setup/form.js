// SPDX-License-Identifier: GPL-3.0-or-later
// The form of one item of the outline, made from the table of keys.

import { button, element, tell } from "workbench/page/elements.js";
import { withoutKey } from "workbench/page/faults.js";
import { booleanInput, dial, numberInput, numbersInput, selectInput, textInput } from "workbench/setup/inputs.js";
import { defaultWords, fallbackOf, lastPart, ofColumn, valueAt } from "workbench/setup/keys_table.js";
import { namesInput, outlinesInput, pairsInput, profileInput } from "workbench/setup/lists.js";
import { filesFor, namesFor } from "workbench/setup/references.js";

const NUMBERS = ["number", "integer"];
const FABRIC = "fabrics.NAME"; // row of the table of keys

const FAR = 1e7; // ends beyond are there to keep nonsense out, and nothing to read

function rangeWords(row) {
  const far = (end) => end === null || Math.abs(end) >= FAR;
  const span = (least, most, open, shut) => (far(least) && far(most) ? "" :
    `${open ? "(" : "["}${far(least) ? "…" : least}, ${far(most) ? "…" : most}${shut ? ")" : "]"}`);
  const columns = Array.isArray(row.least) ? Math.max(row.least.length, 1) : 1;
  const texts = [];
  for (let k = 0; k < columns; ++k) {
    texts.push(span(ofColumn(row.least, k), ofColumn(row.most, k), ofColumn(row.open_least, k),
      ofColumn(row.open_most, k)));
  }
  const [least, most] = [ofColumn(row.usual_least, 0), ofColumn(row.usual_most, 0)];
  return [texts.filter(Boolean).join(", "), least === null && most === null ? "" :
    `usually ${least === null ? "…" : least} to ${most === null ? "…" : most}`].filter(Boolean).join(", ");
}

export class Form {
  /** `work`: keys, folder, main (the CaseFile of the case), fileOf(path), wrongAt(key) → [words],
   * turning(key, angle, done). */
  constructor(place, work) {
    Object.assign(this, { work });
    this.fields = element("div", { className: "fields" });
    this.help = element("p", { className: "help", id: "help", "aria-live": "polite", textContent:
      "Point at a key to read what it means." });
    place.append(this.fields, this.help);
    this.typed = new WeakMap(); // of fields with what was typed before they were drawn anew: upon which texts
    this.fields.addEventListener("change", (event) => this.leaves(event), true);
    this.fields.addEventListener("focusout", ({ target }) => this.typed.has(target) && !this.drawing &&
      document.activeElement !== target && // as when another window comes to the front
      target.dispatchEvent(new Event("change", { bubbles: true })));
    this.fields.addEventListener("focusin", (event) => this.helpOf(event.target));
    this.fields.addEventListener("pointerover", (event) => {
      if (!this.fields.contains(document.activeElement)) this.helpOf(event.target);
    });
  }

  /** What is typed is a change of what was shown when the typing began. */
  leaves(event) {
    if (this.drawing) event.stopImmediatePropagation();
    else {
      this.changing = this.typed.get(event.target);
      this.typed.delete(event.target);
      setTimeout(() => { this.changing = null; });
    }
  }

  helpOf(target) {
    const line = target.closest("[data-row]");
    const row = line && this.work.keys.row(line.dataset.row);
    if (!row) return;
    const standing = defaultWords(row);
    this.help.replaceChildren(element("b", { textContent: lastPart(row.key) }), ` ${row.meaning}. `,
      element("span", { textContent: [rangeWords(row), standing ? `default: ${standing}` : "", row.unit &&
      row.unit !== "-"
        ? row.unit : ""].filter(Boolean).join("; ") }));
  }

  /** Makes the form of an item anew, with the cursor where it was. */
  show(item) {
    this.item = item;
    const kept = this.keepFocus();
    const main = { file: this.work.main, prefix: "", key: "", pattern: "", table: this.work.main.tree };
    const parts = this.work.ofFabric ? [this.fabricNote(main.file), ...this.tableFields({ ...main, pattern: FABRIC })]
      : item === "case" ? this.caseFields(main) : this.itemFields(main, item);
    this.drawing = true; // a field that goes with what is typed in it is left, and not done
    this.fields.replaceChildren(...parts.filter(Boolean));
    this.drawing = false;
    this.fields.inert = Boolean(this.work.main.error);
    this.showWrong();
    this.giveFocus(kept);
    this.upon = this.work.shown();
  }

  keepFocus() {
    const at = document.activeElement;
    if (!at || !this.fields.contains(at) || !at.dataset.key) return null;
    return { key: at.dataset.key, part: at.dataset.part, value: at.value, shown: at.defaultValue,
      marked: at.type === "text" ? [at.selectionStart, at.selectionEnd, at.selectionDirection] : null,
      upon: this.typed.get(at) || this.upon, top: this.fields.scrollTop };
  }

  giveFocus(kept) {
    if (!kept) return;
    const at = [...this.fields.querySelectorAll("[data-key]")].find((one) => one.dataset.key === kept.key &&
      one.dataset.part === kept.part);
    if (!at) return;
    if (at.type === "text" && kept.value !== kept.shown) {
      at.value = kept.value;
      this.typed.set(at, kept.upon);
    }
    at.focus({ preventScroll: true });
    if (at.type === "text" && kept.marked) at.setSelectionRange(...kept.marked);
    this.fields.scrollTop = kept.top;
  }

  caseFields(main) {
    const rows = this.work.keys.below("").filter((row) => !["table", "tables", "map"].includes(row.kind));
    return rows.map((row) => this.line(main, row));
  }

  itemFields(main, item) {
    const { keys } = this.work;
    const [first, second] = item.split(".");
    const pattern = keys.patternOf(item);
    const row = keys.row(first);
    const value = valueAt(main.table, item);
    if (second === undefined && row && row.kind !== "table") return [this.groupWords(row)];
    if (row && row.kind === "map" && keys.row(pattern) && keys.row(pattern).kind === "fabric") {
      return this.fabricFields(main, item, value);
    }
    const rename = row && row.kind === "map" ? this.renameLine(main, item) : null;
    return [rename, ...this.tableFields({ ...main, key: item, pattern, table: value || {} }),
      first === "tool" ? this.touchButton(main, item, value) : null];
  }

  groupWords(row) {
    return element("p", { className: "note", textContent: `${row.meaning}.` });
  }

  /** A tool that moves can be set onto the stack, which plies that are added make thicker. */
  touchButton(main, item, value) {
    const gapOf = () => ((this.work.scene || {}).tools || []).find(({ key }) => key === item);
    if (!value || !value.motion || value.motion === "fixed") return null;
    return button("Set onto the stack", () => {
      const { gap, direction } = gapOf() || {};
      if (!gap || !direction) throw new Error("How far it is from the plies is known when the scene is drawn");
      const long = Math.hypot(...direction);
      const place = [0, 1, 2].map((k) => Number((((value.position || [])[k] || 0) +
        (gap.mm * direction[k]) / long).toFixed(4)));
      return this.send(main.file, [{ op: "set", key: `${item}.position`, value: place }]);
    }, { id: "touch-stack", title: "Moves it along its direction until it touches the plies, at the start" });
  }

  renameLine(main, item) {
    const input = element("input", { type: "text", value: item.split(".")[1], spellcheck: false,
      dataset: { key: item, part: "name" }, "aria-label": `name of ${item}` });
    input.addEventListener("change", () => input.value && this.send(main.file, [{ op: "rename", key: item,
      name: input.value }]).then(() => this.work.choose(`${item.split(".")[0]}.${input.value}`)));
    return this.row("NAME", "name", "", input, "");
  }

  fabricFields(main, item, value) {
    const name = item.split(".")[1];
    const prefix = `fabrics.${name}.`;
    if (value && typeof value === "object") {
      return [this.renameLine(main, item), ...this.tableFields({ ...main, key: item, pattern: FABRIC, table: value })];
    }
    const row = this.work.keys.row(FABRIC);
    const choose = selectInput({ ...row, required: true }, item, value, filesFor(this.work, "fabric"),
      (path) => this.send(main.file, [{ op: "set", key: item, value: path }]));
    const file = this.work.fileOf(value);
    const parts = [this.renameLine(main, item), this.row(FABRIC, "file", "", choose, item)];
    if (!file || !file.tree) return parts;
    return [...parts, this.fabricNote(file), ...this.tableFields({ file, prefix, key: "", pattern: FABRIC,
      table: file.tree })];
  }

  fabricNote(file) {
    return element("p", { className: "note",
      textContent: `Keys of ${file.path}: every case that uses it changes too.` });
  }

  /** Lines of all keys of one table: { file, prefix, key, pattern, table }. */
  tableFields(at) {
    const { keys } = this.work;
    const rows = keys.below(at.pattern).filter((row) => keys.holds(row, at.table) ||
      at.table[lastPart(row.key)] !== undefined);
    const done = new Set();
    const parts = [];
    for (const row of rows) {
      if (done.has(row.key)) continue;
      const others = this.alternatives(row, rows).filter((one) => !done.has(one.key));
      if (others.length === 1 && this.replaced(at, row)) continue;
      others.forEach((one) => done.add(one.key));
      if (others.length > 1 && others.every((one) => !["table",
        "tables"].includes(one.kind))) parts.push(this.eitherOr(at, others));
      else parts.push(this.line(at, row));
    }
    return parts;
  }

  /** Whether another key stands in the place of one that is not given. */
  replaced(at, row) {
    return at.table[lastPart(row.key)] === undefined &&
      (row.instead || []).some((other) => at.table[lastPart(other)] !== undefined);
  }

  alternatives(row, rows) {
    const names = (row.instead || []).map(lastPart);
    return rows.filter((one) => one === row || names.includes(lastPart(one.key)));
  }

  /** Of keys of which one is given: which, and its value. */
  eitherOr(at, rows) {
    const given = rows.find((row) => at.table[lastPart(row.key)] !== undefined) ||
      rows.find((row) => row.key === this.chosenWay) || rows[0];
    const key = this.keyOf(at, given);
    const way = element("select", { className: "way", dataset: { key, part: "way" }, "aria-label": `which of ${
      rows.map((row) => lastPart(row.key)).join(", ")}` }, ...rows.map((row) => element("option", { value: row.key,
      textContent: lastPart(row.key) })));
    way.value = given.key;
    way.addEventListener("change", () => {
      this.chosenWay = way.value;
      if (at.table[lastPart(given.key)] === undefined) this.show(this.item);
      else this.send(at.file, [{ op: "remove", key: this.localKey(at, given) }]);
    });
    const line = this.row(given.key, way, given.unit, this.control(at, given), at.prefix + key);
    line.classList.add("either");
    return line;
  }

  localKey(at, row) {
    return at.key ? `${at.key}.${lastPart(row.key)}` : lastPart(row.key);
  }

  /** Key in the case, whatever file it is in. */
  keyOf(at, row) {
    return at.prefix + this.localKey(at, row);
  }

  line(at, row) {
    if (row.kind === "table") return this.subTable(at, row);
    if (row.kind === "tables") return this.subTables(at, row);
    const line = this.row(row.key, lastPart(row.key), row.unit, this.control(at, row), this.keyOf(at, row));
    const given = at.table[lastPart(row.key)];
    if (given === undefined && row.required) line.classList.add("needed");
    if (!this.work.keys.holds(row, at.table)) {
      line.classList.add("alien");
      line.append(button("remove", () => this.send(at.file, [{ op: "remove", key: this.localKey(at, row) }]),
        { className: "small" }));
    }
    return line;
  }

  row(pattern, name, unit, control, key) {
    const label = typeof name === "string" ? element("span", { className: "name",
      textContent: name.replace(/_/g, " "),
      title: name }) : name;
    return element("div", { className: "row", dataset: { row: pattern, at: key } }, label, control,
      element("span", { className: "unit", textContent: unit && unit !== "-" && !unit.includes(",") ? unit : "" }));
  }

  /** Puts the value of a key, taking away what does not go with it. */
  put(at, row, value) {
    const key = this.localKey(at, row);
    const name = lastPart(row.key);
    if (name === "name" && row.kind === "name" && value !== null && at.table.name !== undefined) { // others name it
      return this.send(at.file, [{ op: "rename", key: at.key, name: value }]);
    }
    const edits = [value === null ? { op: "remove", key } : { op: "set", key, value }];
    const [before, after] = [at.table, { ...at.table, [name]: value === null ? undefined : value }];
    for (const other of this.work.keys.below(at.pattern)) {
      const given = at.table[lastPart(other.key)] !== undefined && other.key !== row.key;
      const goes = this.work.keys.holds(other, before) && !this.work.keys.holds(other, after);
      const instead = value !== null && (row.instead || []).map(lastPart).includes(lastPart(other.key));
      if (given && (goes || instead)) edits.push({ op: "remove", key: this.localKey(at, other) });
    }
    return this.send(at.file, edits);
  }

  send(file, edits) {
    return file.edit(edits, this.changing ? this.changing.get(file) : undefined).catch(tell);
  }

  control(at, row) {
    const key = this.keyOf(at, row);
    const value = at.table[lastPart(row.key)];
    const changed = (next) => this.put(at, row, next);
    const names = namesFor(this.work, row, at);
    if (NUMBERS.includes(row.kind)) return this.numberControl(row, key, value, changed);
    if (row.kind === "choice") return selectInput(row, key, value, row.choices, changed);
    if (row.kind === "boolean") return booleanInput(row, key, value, changed);
    if (row.kind === "numbers") return numbersInput(row, key, value, changed);
    if (row.kind === "pairs") return pairsInput(row, key, value, changed);
    if (row.kind === "profile") return profileInput(row, key, value, changed);
    if (row.kind === "outlines") return outlinesInput(row, key, value, changed);
    if (row.kind === "names") return namesInput(row, key, value, names || [], changed);
    if (row.kind === "path") return selectInput(row, key, value, filesFor(this.work, lastPart(row.key)), changed);
    if (names) return selectInput(row, key, value, names, changed);
    return textInput(row, key, value, changed);
  }

  numberControl(row, key, value, changed) {
    const words = defaultWords(row);
    const input = numberInput(row, key, value, changed, { hint: words || (row.required ? "needed" : "") });
    if (words && !this.help.title) input.title = input.title || words;
    if (row.key !== "ply[].angle") return input;
    const wheel = dial(key, value || 0, (angle, done) => {
      input.value = String(angle);
      this.work.turning(key, angle, done);
    });
    return element("span", { className: "with-dial" }, input, wheel);
  }

  subTable(at, row) {
    const name = lastPart(row.key);
    const table = at.table[name];
    const key = this.localKey(at, row);
    if (table === undefined && !row.required && row.fallback !== "{}") {
      return element("div", { className: "row", dataset: { row: row.key, at: at.prefix + key } },
        element("span", { className: "name", textContent: name.replace(/_/g, " ") }),
        button("+ add", () => this.send(at.file, [{ op: "set", key, value: {} }]), { className: "small",
          dataset: { add: at.prefix + key } }));
    }
    const inner = { ...at, key, pattern: row.key, table: table || {} };
    const remove = table === undefined ? null : button("−", () => this.send(at.file, [{ op: "remove", key }]),
      { className: "small", title: `Remove ${name}`, "aria-label": `Remove ${at.prefix + key}` });
    return element("fieldset", { dataset: { row: row.key, at: at.prefix + key } },
      element("legend", {}, name.replace(/_/g, " "), " ", remove), ...this.tableFields(inner));
  }

  subTables(at, row) {
    const name = lastPart(row.key);
    const key = this.localKey(at, row);
    const list = Array.isArray(at.table[name]) ? at.table[name] : [];
    const items = list.map((table, i) => {
      const one = `${key}.${i}`;
      const act = (text, title, edit, off) => button(text, () => this.send(at.file, [edit]),
        { className: "small", title,
        "aria-label": `${title} ${at.prefix + one}`, disabled: off });
      return element("fieldset", { dataset: { row: row.key, at: at.prefix + one } }, element("legend", {},
        `${name} ${table.name || i + 1} `, act("copy", "Copy", { op: "copy", key: one }),
        act("↑", "Move up", { op: "move", key: one, to: i - 1 }, i === 0),
        act("↓", "Move down", { op: "move", key: one, to: i + 1 }, i === list.length - 1),
        act("−", "Remove", { op: "remove", key: one })),
      ...this.tableFields({ ...at, key: one, pattern: `${row.key}[]`, table }));
    });
    const add = button(`+ ${name}`, () => this.send(at.file, [{ op: "add", key,
      value: this.firstValues(`${row.key}[]`) }]),
      { className: "small", dataset: { add: at.prefix + key }, title: row.meaning });
    return element("div", { className: "tables", dataset: { row: row.key, at: at.prefix + key } }, ...items, add);
  }

  /** What a new item needs, with values that can stand: the least of ranges where nothing is usual. */
  firstValues(pattern) {
    const value = {};
    for (const row of this.work.keys.below(pattern)) {
      if (row.required && fallbackOf(row) === "" && this.work.keys.holds(row, value) && row.kind === "choice") {
        [value[lastPart(row.key)]] = row.choices;
      }
    }
    return value;
  }

  /** Marks mistakes at their keys, with their words beneath. */
  showWrong() {
    for (const old of this.fields.querySelectorAll(".words")) old.remove();
    for (const line of this.fields.querySelectorAll("[data-at]")) {
      const wrongs = this.work.wrongAt(line.dataset.at);
      line.classList.toggle("has-wrong", wrongs.some((one) => !one.warning));
      line.classList.toggle("has-warning", wrongs.length > 0 && wrongs.every((one) => one.warning));
      for (const fault of wrongs) {
        line.append(element("p", { className: `words${fault.warning ? " warning" : ""}`,
          textContent: withoutKey(fault) }));
      }
    }
  }

  /** Brings a key to sight, or the nearest that the form has. */
  point(key, focus) {
    const lines = [...this.fields.querySelectorAll("[data-at]")].filter(({ dataset: { at } }) => at &&
      (key === at || key.startsWith(`${at}.`)));
    const line = lines.sort((a, b) => b.dataset.at.length - a.dataset.at.length)[0];
    if (!line) return;
    line.scrollIntoView({ block: "nearest" });
    const input = line.querySelector("input, select");
    if (focus && input) input.focus();
  }
}
