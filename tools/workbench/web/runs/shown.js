// SPDX-License-Identifier: GPL-3.0-or-later
// The run that is chosen: what it does, its picture, what it says, and what can be done with it.

import { button, element, tell } from "workbench/page/elements.js";
import { RunPicture } from "workbench/runs/picture.js";
import { fractionOf, LIVE, progressWords, stateWord } from "workbench/runs/words.js";
import { ask, send } from "workbench/page/server.js";

const LISTS = [["doubts", "What not to trust"], ["advice", "What would make it better"],
  ["could_be_left_out", "What could be left out"], ["assumed", "What is assumed"]];

const list = (title, lines) => (lines.length ? element("section", {}, element("h3", { textContent: title }),
  element("ul", {}, ...lines.map((textContent) => element("li", { textContent })))) : null);

export class RunShown {
  constructor() {
    this.run = null;
    this.title = element("h2", { id: "run-title" });
    this.state = element("span", { id: "run-state", role: "status" });
    this.words = element("p", { id: "run-words" });
    this.bar = element("progress", { id: "run-progress", max: 1, "aria-label": "Progress" });
    this.message = element("p", { id: "run-message" });
    this.acts = element("div", { className: "run-acts" });
    this.said = element("div", { id: "run-said" });
    this.log = element("pre", { id: "run-log", tabIndex: 0, "aria-label": "What the run has printed" });
    this.command = element("code", { id: "run-command" });
    this.cwd = element("code", {});
    this.picture = new RunPicture();
    this.none = element("p", { className: "runs-none", id: "run-none" });
    this.all = element("div", { className: "run-all" },
      element("header", {}, this.title, this.state, this.acts), this.words, this.bar, this.message, this.picture.place,
      this.said, element("details", { open: true, id: "run-printed" },
        element("summary", { textContent: "What it has printed" }), this.log),
      element("section", {}, element("h3", { textContent: "The same by command line" }),
        element("p", {}, "in ", this.cwd), element("p", {}, this.command, " ",
          button("Copy", () => navigator.clipboard.writeText(this.command.textContent), { id: "run-copy" }))));
    this.place = element("article", { className: "runs-shown", id: "run-shown" }, this.none, this.all);
  }

  show(run, folder) {
    const other = !run || !this.run || this.run.folder !== run.folder;
    const news = other || this.run.state !== run.state || (run.record && run.record.stops) !== this.stops;
    this.run = run;
    this.stops = run && run.record ? run.record.stops : 0;
    this.all.hidden = !run;
    this.none.hidden = Boolean(run) || !folder;
    this.none.textContent = `There is no run ${folder} any more.`;
    this.picture.follow(run);
    if (!run) return;
    this.place.dataset.folder = run.folder;
    this.place.dataset.state = run.state;
    this.title.textContent = run.name;
    this.title.title = run.title || run.folder;
    this.state.textContent = stateWord(run);
    this.state.dataset.state = run.state;
    if (news) this.complaint = ""; // of its log, where it has ended without a message
    this.tellMessage(run);
    if (news) this.acts.replaceChildren(...this.buttons(run));
    this.progressed(run);
    if (news) this.load(run, other).catch(tell);
  }

  progressed(run) {
    const live = LIVE.has(run.state);
    this.bar.hidden = !live || run.state === "queued";
    this.words.hidden = !live;
    const stroke = run.progress && run.progress.stroke_mm ? run.progress.stroke_mm : null;
    this.words.textContent = [progressWords(run), Number.isFinite(stroke) ? `stroke ${stroke.toFixed(1)} mm` : "",
      run.states ? `${run.states} state${run.states > 1 ? "s" : ""}` : ""].filter(Boolean).join(" · ");
    const fraction = fractionOf(run);
    if (fraction === null) this.bar.removeAttribute("value");
    else this.bar.value = fraction;
    this.picture.news(run);
  }

  /** What can be done in its state. */
  buttons(run) {
    const query = { folder: run.folder };
    const stops = run.record ? run.record.stops : 0;
    if (LIVE.has(run.state)) {
      if (!run.record || !LIVE.has(run.record.state)) {
        return [element("small", { textContent: "begun by a command line: Ctrl-C there ends it" })];
      }
      const word = run.state === "queued" ? "Take out" : ["Stop", "Stop at once", "Kill"][Math.min(stops, 2)];
      return [button(word, () => send("runs/stop", {}, { query }), { id: "run-stop", title:
        run.state === "queued" ? "" : "as Ctrl-C: the state reached is kept, and Resume goes on from there" })];
    }
    return [
      run.can_resume ? button("Resume", () => send("runs/resume", {}, { query }),
        { id: "run-resume", className: "main" }) : null,
      run.states && run.state !== "damaged" ? element("a", { id: "run-results", textContent: "Results",
        href: `#results/report/${encodeURIComponent(run.folder)}` }) : null,
      button("Delete", () => this.askToDelete(run), { id: "run-delete" }),
    ].filter(Boolean);
  }

  askToDelete(run) {
    const end = () => this.acts.replaceChildren(...this.buttons(run));
    const really = button("Delete for good", async () => {
      const { stay } = await send("runs/remove", {}, { query: { folder: run.folder } });
      tell(stay.length ? new Error(`${run.folder} keeps what is not of the run: ${stay.join(", ")}`) : null);
    }, { id: "run-delete-really", className: "bad" });
    const keep = button("Keep", end, { id: "run-keep" });
    this.acts.replaceChildren(element("span", { role: "alert", textContent: `Delete the results in ${run.folder}?` }),
      really, keep);
    keep.focus();
  }

  async load(run, other) {
    if (other) this.said.replaceChildren();
    const said = await ask("runs/messages", { folder: run.folder });
    if (!this.run || this.run.folder !== run.folder) return; // another was chosen meanwhile
    const unsaid = (line) => !said.message.includes(line); // stands above the lists
    this.said.replaceChildren(...LISTS.map(([key, title]) => list(title, said[key].filter(unsaid))).filter(Boolean));
    this.command.textContent = said.command;
    this.cwd.textContent = said.cwd;
    this.print(said.log);
    if (run.state === "failed") this.complaint = lastWords(said.log);
    this.tellMessage(this.run);
  }

  tellMessage(run) {
    this.message.textContent = run.message || this.complaint;
    this.message.hidden = !this.message.textContent;
  }

  print(log) {
    const low = this.log.scrollTop + this.log.clientHeight >= this.log.scrollHeight - 8;
    this.log.textContent = log.replace(/[^\n]*\r/g, "").trimEnd(); // lines that were drawn over
    if (low) this.log.scrollTop = this.log.scrollHeight;
  }

  /** The process of the run has printed more. */
  printed(record) {
    if (!this.run || !this.run.record || record.id !== this.run.record.id || this.asked) return;
    this.asked = setTimeout(async () => {
      this.asked = null;
      try {
        const { log } = await ask(`processes/${record.id}`);
        if (this.run && this.run.record && this.run.record.id === record.id) this.print(log);
      } catch (problem) {
        if (problem.code !== 404) tell(problem);
      }
    }, 300);
  }
}

/** The lines that begin with a complaint. */
function lastWords(log) {
  const lines = log.split("\n").filter((line) => /error/i.test(line));
  return lines.slice(-3).join("\n");
}
