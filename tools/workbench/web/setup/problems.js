// SPDX-License-Identifier: GPL-3.0-or-later
// What check says of a case: mistakes and warnings by their keys, and their list.

import { element } from "workbench/page/elements.js";
import { withoutKey } from "workbench/page/faults.js";
import { valueAt } from "workbench/setup/keys_table.js";

const PLACE = /^(.*?):(\d+):\d+: (?:warning: |error: )?(.*)$/s; // file, line, words

/** Mistakes and warnings of api/check as one list: { key, line, file, text, rule, warning }. */
export function faultsOf(answer) {
  const words = (one) => one.text || [one.value === undefined ? "" : String(one.value), one.rule,
    one.remedy].filter(Boolean).join("; ");
  const plain = (one) => {
    const text = typeof one === "string" ? one : one.text || "";
    const [, file, line, rest] = text.match(PLACE) || [];
    return { ...(file ? { file, line: Number(line) } : {}), ...(typeof one === "string" ? {} : one), text: rest ||
      text };
  };
  const of = (list, warning) => (list || []).map(plain).map((one) => ({ ...one, text: words(one), warning,
    key: one.key || "" }));
  return [...of(answer.mistakes, false), ...of(answer.warnings, true)];
}

/** Faults but those at keys that have another value since. */
export const faultsStill = (faults, before, now) => faults.filter(({ key }) => !key ||
  JSON.stringify(valueAt(before, key)) === JSON.stringify(valueAt(now, key)));

/** Faults at a key itself. */
export const faultsAt = (faults, key) => faults.filter((one) => one.key === key);

/** How many faults an item and what is below it have; null if none. */
export function faultsBelow(faults, key, itemOf) {
  const of = faults.filter((one) => one.key && itemOf(one.key) === key);
  return of.length ? { count: of.length, only: of.every((one) => one.warning),
    words: of.map((one) => one.text).join("\n") } : null;
}

function stateWords(faults, answer) {
  const wrong = faults.filter((one) => !one.warning).length;
  const odd = faults.length - wrong;
  const count = (n, word) => (n ? `${n} ${word}${n > 1 ? "s" : ""}` : "");
  const found = [count(wrong, "mistake"), count(odd, "warning")].filter(Boolean).join(", ");
  const { outlook } = answer;
  const ahead = outlook && outlook.steps ? `, ${Math.round(outlook.steps).toLocaleString("en")} steps` : "";
  const long = outlook && outlook.estimated_s ? `, about ${durationWords(outlook.estimated_s)}` : "";
  return `${found || "no mistakes"}${ahead}${long}`;
}

export function durationWords(seconds) {
  if (seconds < 90) return `${Math.max(1, Math.round(seconds))} s`;
  return seconds < 5400 ? `${Math.round(seconds / 60)} min` : `${(seconds / 3600).toFixed(1)} h`;
}

export class Problems {
  /** `point(fault)` when one is clicked. */
  constructor(place, point) {
    this.state = element("p", { className: "check-state", id: "check-state", role: "status" });
    this.list = element("ul", { className: "faults", "aria-label": "Mistakes and warnings" });
    place.append(this.state, this.list);
    this.point = point;
  }

  /** Until the file as it is now has been checked; `faults`: what still can be so. */
  wait(faults) {
    this.state.textContent = "checking…";
    this.state.title = "";
    this.state.classList.add("waiting");
    this.state.classList.remove("wrong");
    this.list.replaceChildren(...faults.map((one) => this.line(one)));
  }

  /** It could not be checked. */
  fail(words) {
    this.wait([]);
    this.state.classList.add("wrong");
    this.state.textContent = `not checked: ${words}`;
  }

  show(answer, faults) {
    this.state.classList.remove("waiting");
    this.state.textContent = stateWords(faults, answer);
    this.state.classList.toggle("wrong", faults.some((one) => !one.warning));
    const notes = [...(answer.notes || []), ...(answer.assumed || [])].map((one) =>
      (typeof one === "string" ? one : one.text));
    const outlook = answer.outlook && answer.outlook.lines ? answer.outlook.lines : [];
    this.state.title = [...outlook].join("\n");
    this.list.replaceChildren(...faults.map((one) => this.line(one)),
      ...notes.filter(Boolean).map((text) => element("li", { className: "note", textContent: text })));
  }

  line(fault) {
    const where = [fault.file && fault.file.split("/").pop(), fault.line && `line ${fault.line}`].filter(Boolean)
      .join(", ");
    const made = element("button", { type: "button", className: fault.warning ? "fault-words warning" : "fault-words",
      dataset: { key: fault.key } }, element("b", { textContent: fault.key || where }),
    ` ${withoutKey(fault)}`);
    made.addEventListener("click", () => this.point(fault));
    return element("li", {}, made);
  }
}
