// SPDX-License-Identifier: GPL-3.0-or-later
// The outline of a case: its items, with what can be done to the chosen one.

import { button, element, tell } from "workbench/page/elements.js";
import { fallbackOf, lastPart, sectionsOf } from "workbench/setup/keys_table.js";

const NEW = { ply: "ply", tool: "tool", boundary: "boundary", load: "load", fabrics: "fabric", blanks: "blank" };

const INSTEAD_FIRST = { "tool[].motion": "fixed", "load[].ply": "", "load[].side": "" };

/** A value that can stand for a key that is needed: the first choice, a middling number. */
function startValue(row) {
  if (row.kind === "choice") return row.choices[0];
  if (row.kind === "numbers") return Array.from({ length: row.count || 1 }, () => 100);
  if (row.kind === "number") return 10;
  return undefined;
}

/** Keys that a new item needs so that it can be drawn at once. */
export function newItem(keys, group, tree) {
  const value = {};
  const pattern = keys.row(group).kind === "map" ? `${group}.NAME` : `${group}[]`;
  const refs = { fabric: Object.keys(tree.fabrics || {})[0], blank: Object.keys(tree.blanks || {})[0],
    ply: ((tree.ply || [])[0] || {}).name };
  if (group === "ply") return { name: freeName(tree.ply, "ply"), fabric: refs.fabric || "", blank: refs.blank || "",
    angle: 0 };
  if (group === "tool") return { name: freeName(tree.tool, "tool"), shape: "sphere", radius: 50,
    position: [0, 0, 100] };
  if (group === "blanks") return { size: [300, 300], element_size: 10 };
  for (const row of keys.below(pattern)) {
    const name = lastPart(row.key);
    const needed = row.required && fallbackOf(row) === "" && keys.holds(row, value);
    if (!needed && !(row.key in INSTEAD_FIRST)) continue;
    const start = name === "name" ? freeName(tree[group], group) : refs[name] !== undefined ? refs[name]
      : startValue(row);
    if (start !== undefined) value[name] = start;
  }
  if (group === "load") value.pressure = 0.01;
  return value;
}

export function freeName(list, word) {
  const taken = new Set((Array.isArray(list) ? list : []).map((one) => one.name).concat(Object.keys(list || {})));
  for (let k = (list || []).length || 1; ; ++k) if (!taken.has(`${word}${k}`)) return `${word}${k}`;
}

export class Outline {
  /** `work` as the form has it, and choose(key). */
  constructor(place, work) {
    Object.assign(this, { work });
    this.list = element("ul", { className: "outline", role: "tree", "aria-label": "Items of the case" });
    place.append(this.list);
  }

  show(chosen) {
    this.chosen = chosen;
    const { keys, main } = this.work;
    const lines = [this.line("case", "Case", main.tree.title || "")];
    for (const section of sectionsOf(keys)) {
      if (!section.group) {
        lines.push(this.line(section.key, section.title, main.tree[section.key] === undefined ? "default" : ""));
      } else {
        lines.push(this.groupLine(section), ...this.itemsOf(section).map((item) => this.itemLine(section, item)));
      }
    }
    const top = this.list.scrollTop;
    this.list.replaceChildren(...lines);
    this.list.scrollTop = top;
  }

  itemsOf({ key, kind }) {
    const value = this.work.main.tree[key];
    if (kind === "map") {
      return Object.keys(value || {}).map((name) => ({ key: `${key}.${name}`, name,
        note: this.noteOf(key, value[name]) }));
    }
    return (Array.isArray(value) ? value : []).map((one, i) => ({ key: `${key}.${i}`, name: one.name || String(i + 1),
      note: this.noteOf(key, one), at: i, last: value.length - 1 }));
  }

  noteOf(group, value) {
    if (group === "ply") return `${value.angle === undefined ? "?" : value.angle}°`;
    if (group === "tool") return [value.shape, value.motion].filter(Boolean).join(", ");
    if (group === "boundary") return value.kind || "";
    if (group === "fabrics") return typeof value === "string" ? value.split("/").pop() : "";
    if (group === "blanks") return Array.isArray(value.size) ? value.size.join(" × ") : "";
    return "";
  }

  line(key, name, note) {
    const wrongs = this.work.wrongBelow(key);
    const made = element("li", { role: "treeitem", "aria-selected": String(this.chosen === key),
      dataset: { item: key } },
      element("button", { type: "button", className: "item", dataset: { item: key } },
        element("span", { textContent: name }),
        element("small", { textContent: note }), wrongs ? element("b", { className: wrongs.only ? "odd" : "wrong",
          textContent: String(wrongs.count), title: wrongs.words }) : null));
    made.firstChild.addEventListener("click", () => this.work.choose(key));
    return made;
  }

  groupLine({ key, title, row }) {
    const made = element("li", { className: "group", dataset: { group: key } },
      element("span", { textContent: title, title: row.meaning }),
      button("+", () => this.add(key), { className: "small", title: `Add a ${NEW[key] || key}`,
        "aria-label": `Add a ${NEW[key] || key}`,
        dataset: { add: key } }));
    return made;
  }

  itemLine(section, item) {
    const made = this.line(item.key, item.name, item.note);
    made.classList.add("below");
    if (this.chosen !== item.key) return made;
    const act = (text, title, name, edit, next, off = false) => button(text, () => this.edit([edit], next),
      { className: "small",
      title: `${title} ${item.name}`, "aria-label": `${title} ${item.name}`, dataset: { act: name }, disabled: off });
    const list = section.kind === "tables";
    const beside = (by) => `${section.key}.${item.at + by}`;
    made.append(element("span", { className: "acts" },
      act("copy", "Copy", "copy", { op: "copy", key: item.key }, () => (list ? beside(1) : item.key)),
      list ? act("↑", "Move up", "up", { op: "move", key: item.key, to: item.at - 1 }, () => beside(-1),
        item.at === 0) : null,
      list ? act("↓", "Move down", "down", { op: "move", key: item.key, to: item.at + 1 }, () => beside(1),
        item.at === item.last) : null,
      act("−", "Remove", "remove", { op: "remove", key: item.key }, () => "case")));
    return made;
  }

  edit(edits, next) {
    return this.work.main.edit(edits).then(() => this.work.choose(next())).catch(tell);
  }

  add(group) {
    const { main, keys } = this.work;
    if (group === "fabrics") return this.work.addFabric();
    const value = newItem(keys, group, main.tree);
    const map = keys.row(group).kind === "map";
    const name = map ? freeName(main.tree[group], NEW[group] || group) : undefined;
    const count = (main.tree[group] || []).length || 0;
    return this.edit([{ op: "add", key: group, value, ...(map ? { name } : {}) }], () =>
      `${group}.${map ? name : count}`);
  }
}
