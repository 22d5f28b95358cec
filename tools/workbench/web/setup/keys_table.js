// SPDX-License-Identifier: GPL-3.0-or-later
// The table of keys, from which forms are made. Patterns: tool[].radius, blanks.NAME.size.

const GROUPS = ["tables", "map"]; // kinds that hold items
const TITLES = { fabrics: "Fabrics", blanks: "Blanks", ply: "Plies", tool: "Tools", boundary: "Boundaries",
  load: "Loads", stack: "Stack", contact: "Contact", process: "Process", solver: "Solver", accuracy: "Accuracy" };

export const lastPart = (pattern) => pattern.split(".").pop();

/** The value at a dotted key; undefined where there is none. */
export function valueAt(tree, key) {
  let at = tree;
  for (const part of key ? key.split(".") : []) {
    if (at === null || typeof at !== "object") return undefined;
    at = at[part];
  }
  return at;
}

/** Of a number, or of numbers a column, that of a column; the last holds for all further ones. */
export function ofColumn(value, column) {
  if (!Array.isArray(value)) return value === undefined ? null : value;
  return value.length ? value[Math.min(column, value.length - 1)] : null;
}

/** The value of a fallback, which is written as TOML. */
export function fallbackOf(row) {
  if (typeof row.fallback !== "string") return row.fallback;
  try {
    return JSON.parse(row.fallback);
  } catch (ignored) {
    return row.fallback;
  }
}

/** What holds when a key is not given, in words. */
export function defaultWords(row) {
  if (row.otherwise) return row.otherwise;
  const value = fallbackOf(row);
  if (row.implied && row.implied_by && row.implied_by.length) {
    return `${row.fallback}; with ${row.implied_by.map(lastPart).join(" or ")} ${row.implied}`;
  }
  return value === undefined || value === null || row.fallback === "" ? ""
    : Array.isArray(value) ? value.join(", ") : String(value);
}

/** A row as the server gives it, with the bounds of its columns as lists. */
function rowOf(given) {
  const columns = given.columns || [];
  const bounds = ["least", "most", "open_least", "open_most", "usual_least", "usual_most"];
  const lists = columns.length ? Object.fromEntries(bounds.map((name) => [name, columns.map((one) => one[name])])) : {};
  return { ...given, ...lists, with: given.with || given.of_values || [] };
}

export class Keys {
  constructor(rows) {
    this.rows = new Map(rows.map((row) => [row.key, rowOf(row)]));
  }

  row(pattern) {
    return this.rows.get(pattern);
  }

  /** Rows one level below a pattern. */
  below(pattern) {
    const head = pattern ? `${pattern}.` : "";
    return [...this.rows.values()].filter(({ key }) => key.startsWith(head) && key !== pattern &&
      !/[.[]/.test(key.slice(head.length)));
  }

  /** Pattern of a dotted key with numbers: tool.1.stroke is of tool[].stroke. */
  patternOf(key, base = "") {
    let pattern = base;
    for (const part of key ? key.split(".") : []) {
      const row = this.rows.get(pattern);
      if (row && row.kind === "map") pattern = `${pattern}.NAME`;
      else if (row && /^\d+$/.test(part)) pattern = `${pattern}[]`;
      else pattern = pattern ? `${pattern}.${part}` : part;
    }
    return pattern;
  }

  /** Choice key that a row depends on, in the same table. */
  holds(row, table) {
    if (!row.of || !row.with || !row.with.length) return true;
    const name = lastPart(row.of);
    const pattern = row.key.slice(0, row.key.length - lastPart(row.key).length) + name;
    const choice = this.rows.get(pattern);
    const value = table && table[name] !== undefined ? table[name] : choice && fallbackOf(choice);
    return row.with.includes(value);
  }
}

/** What the outline shows: groups of items, and single tables. Title and gravity are the case itself. */
export function sectionsOf(keys) {
  const order = Object.keys(TITLES);
  const rank = ({ key }) => (order.includes(key) ? order.indexOf(key) : order.length);
  const rows = keys.below("").filter((row) => row.kind === "table" || GROUPS.includes(row.kind));
  return rows.sort((a, b) => rank(a) - rank(b)).map((row) => ({
    key: row.key, title: TITLES[row.key] || row.key, group: GROUPS.includes(row.kind), kind: row.kind, row }));
}

/** The item of the outline that a key belongs to: tool.1 of tool.1.stroke, case of title. */
export function itemOf(keys, key) {
  const [first, second] = key.split(".");
  const row = keys.row(first);
  if (!row || row.kind === "text" || row.kind === "numbers") return "case";
  if (GROUPS.includes(row.kind)) return second === undefined ? first : `${first}.${second}`;
  return first;
}
