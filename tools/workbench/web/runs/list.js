// SPDX-License-Identifier: GPL-3.0-or-later
// The queue, in its order, and all other runs, the newest first.

import { button, element } from "workbench/page/elements.js";
import { fractionOf, LIVE, progressWords, stateWord } from "workbench/runs/words.js";
import { send } from "workbench/page/server.js";

function bar(run) {
  const fraction = fractionOf(run);
  const made = element("progress", { max: 1, "aria-label": `Progress of ${run.name}` });
  if (fraction !== null) made.value = fraction;
  return made;
}

export class RunList {
  constructor(chosen) {
    this.chosen = chosen;
    this.rows = new Map();
    this.queue = element("ol", { className: "runs-list", id: "runs-queue", "aria-label": "Queue" });
    this.others = element("ul", { className: "runs-list", id: "runs-list", "aria-label": "Runs" });
    this.queueTitle = element("h2", { textContent: "Queue" });
    this.none = element("p", { className: "runs-none", textContent: "No runs yet: choose a case and press Run." });
    this.place = element("div", {}, this.queueTitle, this.queue, element("h2", { textContent: "Runs" }), this.none,
      this.others);
  }

  show(runs, chosen) {
    const kept = document.activeElement && document.activeElement.dataset.act;
    this.rows.clear();
    const waiting = runs.filter((run) => run.state === "queued").sort((a, b) => a.record.order - b.record.order);
    this.queue.replaceChildren(...waiting.map((run, k) => this.row(run, chosen,
      this.queueButtons(run, k, waiting.length))));
    this.others.replaceChildren(...runs.filter((run) => run.state !== "queued")
      .map((run) => this.row(run, chosen, [])));
    this.queueTitle.hidden = !waiting.length;
    this.none.hidden = runs.length > 0;
    if (kept) {
      const again = this.place.querySelector(`[data-act="${CSS.escape(kept)}"]`);
      if (again) again.focus();
    }
  }

  queueButtons(run, k, count) {
    const move = (to) => send(`processes/${run.record.id}/move`, {}, { query: { to } });
    const act = (word) => ({ dataset: { act: `${word} ${run.folder}` } });
    return [
      button("↑", () => move(k - 1),
        { "aria-label": `Run ${run.name} earlier`, ...act("earlier"), disabled: k === 0 }),
      button("↓", () => move(k + 1),
        { "aria-label": `Run ${run.name} later`, ...act("later"), disabled: k === count - 1 }),
      button("✕", () => send("runs/stop", {}, { query: { folder: run.folder } }),
        { "aria-label": `Take ${run.name} out of the queue`, ...act("out") }),
    ];
  }

  row(run, chosen, buttons) {
    const name = button(run.name, () => this.chosen(run.folder),
      { className: "runs-name", title: run.title || run.case || run.folder, dataset: { act: `choose ${run.folder}` } });
    const made = element("li",
      { dataset: { folder: run.folder, state: run.state }, "aria-current": String(run.folder === chosen) },
      name, element("span", { className: "runs-state", textContent: stateWord(run) }), ...buttons);
    this.rows.set(run.folder, made);
    if (LIVE.has(run.state) && run.state !== "queued") {
      made.append(bar(run), element("small", { textContent: progressWords(run) }));
    }
    return made;
  }

  progressed(run) {
    const row = this.rows.get(run.folder);
    if (!row || !row.querySelector("progress")) return;
    row.querySelector("progress").replaceWith(bar(run));
    row.querySelector("small").textContent = progressWords(run);
  }
}
