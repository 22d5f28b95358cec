// SPDX-License-Identifier: GPL-3.0-or-later
// The report of the runs chosen, as plyform report makes it, in a frame that can do nothing but show it.

import { button, element, tell } from "workbench/page/elements.js";
import { ask, send } from "workbench/page/server.js";

const MOST = 4;
const SANDBOX = "allow-scripts allow-modals"; // no origin: its scripts can ask this server for nothing

const foldersOf = (runs) => runs.map((run) => run.folder).join("|");

class ReportView {
  constructor(place, panel) {
    this.panel = panel;
    this.words = element("p", { className: "note", id: "report-words", role: "status" });
    this.anew = button("Make anew", () => this.make(this.runs), { id: "report-anew", hidden: true });
    this.alone = element("a", { id: "report-alone", target: "_blank", rel: "noopener", hidden: true,
      textContent: "In a tab of its own" });
    this.file = element("a", { id: "report-file", textContent: "Save as a file", hidden: true });
    this.room = element("div", { className: "report-room" });
    place.append(element("div", { className: "row" }, this.words, this.anew, this.alone, this.file), this.room);
  }

  async show(chosen) {
    const runs = chosen.filter((run) => run.has_states).slice(0, MOST);
    const same = foldersOf(runs) === foldersOf(this.runs || []);
    this.left = chosen.length - runs.length;
    this.runs = runs;
    if (!runs.length) {
      this.clear(chosen.length ? "The runs chosen have no state yet."
        : "Choose a run in the list, or up to four to see them beside each other.");
      return;
    }
    const date = Math.max(...runs.map((run) => run.date));
    if (!same) await this.make(runs);
    else if (date > this.date && !this.waiting) this.later();
  }

  clear(words) {
    this.say(words);
    this.room.replaceChildren();
    this.waiting = this.key = null;
    for (const one of [this.anew, this.alone, this.file]) one.hidden = true;
  }

  say(words) {
    this.words.textContent = words;
  }

  later() {
    this.say("More has been written since this was made.");
    this.anew.hidden = false;
  }

  async make(runs) {
    this.clear("The report is being made …");
    this.date = Math.max(...runs.map((run) => run.date));
    const wanted = () => foldersOf(runs) === foldersOf(this.runs);
    try {
      const answer = await send("results/report", { folders: runs.map((run) => run.folder) });
      if (wanted()) this.take(answer); // else others were chosen meanwhile
    } catch (problem) {
      if (wanted()) this.clear(problem.message);
    }
  }

  take({ key, ready, process }) {
    this.key = key;
    this.waiting = ready ? null : process.id;
    if (ready) this.place();
    else this.look(process.id).catch(tell); // it may have ended before this page heard of it
  }

  process({ record }) {
    if (record.id === this.waiting && !["queued", "starting", "running"].includes(record.state)) {
      this.look(record.id).catch(tell);
    }
  }

  async look(id) {
    const { state, error } = await ask("results/ended", { process: id });
    if (id !== this.waiting || ["queued", "starting", "running"].includes(state)) return;
    this.waiting = null;
    if (state === "done") this.place();
    else this.clear(`No report: ${error || state}`);
  }

  place() {
    const address = `./api/results/report/${this.key}`;
    const names = this.runs.map((run) => run.title).join(", ");
    const frame = element("iframe", { id: "report-frame", src: address, title: `Report of ${names}` });
    frame.setAttribute("sandbox", SANDBOX);
    this.room.replaceChildren(frame);
    const goes = this.runs.some((run) => run.status === "unfinished");
    this.say([this.left > 0 ? `Four at most: ${this.left} of those chosen are not shown.` : "",
      goes ? "As far as results have been written." : ""].filter(Boolean).join(" "));
    this.anew.hidden = !goes;
    this.alone.href = this.file.href = address;
    this.file.download = `${this.runs.map((run) => run.folder.split("/").pop()).join("_")}_report.html`;
    this.alone.hidden = this.file.hidden = false;
  }
}

export const reportView = { word: "report", title: "Report", made: (place, panel) => new ReportView(place, panel) };
