// SPDX-License-Identifier: GPL-3.0-or-later
// Choosing a key of a case from its values: found by words, added by a click.

import { element } from "workbench/page/elements.js";

const MOST = 200; // that are shown at once

const shortly = (value) => {
  const text = typeof value === "string" ? value : JSON.stringify(value);
  return text.length > 40 ? `${text.slice(0, 39)}…` : text;
};

export class KeyChooser {
  constructor(choose) {
    this.choose = choose;
    this.words = "";
    this.open = false;
  }

  /** The part of the page for these keys: {key, value, unit, meaning, range, type}. */
  shown(keys, any = false) {
    const list = element("ul", { className: "keys", role: "list" });
    const search = element("input", { id: "key-search", type: "search", value: this.words, size: 30,
      placeholder: "friction, stroke, angle …", "aria-label": "find a key of the case" });
    const fill = () => {
      this.words = search.value;
      const wanted = this.words.toLowerCase().split(/\s+/).filter(Boolean);
      const found = keys.filter((one) => wanted.every((word) =>
        `${one.key} ${one.meaning} ${one.unit}`.toLowerCase().includes(word)));
      list.replaceChildren(...found.slice(0, MOST).map((one) => this.item(one)));
      if (!found.length) list.append(element("li", { className: "note", textContent: "The case has no such key." }));
    };
    search.addEventListener("input", fill);
    fill();
    const details = element("details", { id: "key-chooser", open: this.open || any },
      element("summary", { textContent: "Add a key of the case" }), search, list);
    details.addEventListener("toggle", () => { this.open = details.open; });
    return details;
  }

  item(one) {
    const made = element("button", { type: "button", className: "key", dataset: { key: one.key },
      title: [one.meaning, one.range && `range ${one.range}`].filter(Boolean).join("; ") },
    element("code", { textContent: one.key }),
    ` ${shortly(one.value)}${one.unit ? ` ${one.unit}` : ""}${one.given ? "" : " (not in the file)"} `,
    element("span", { className: "note", textContent: one.meaning }));
    made.addEventListener("click", () => this.choose(one));
    return element("li", {}, made);
  }
}
