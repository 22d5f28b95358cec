// SPDX-License-Identifier: GPL-3.0-or-later
// One TOML file as the server has it: changed by edits or as a whole, one after the other. Each change goes
// with the text that it was made upon: where somebody else has changed the same meanwhile, the page asks.

import { ask, send } from "workbench/page/server.js";
import { tell } from "workbench/page/elements.js";
import { madeUpon } from "workbench/page/upon.js";

export class CaseFile {
  constructor(path) {
    this.path = path;
    this.watchers = [];
    this.busy = Promise.resolve();
    this.foreign = 0; // changes of others
  }

  /** `act(file, by)` after each change; by: "edit", "text", "back", "other". */
  watch(act) {
    this.watchers.push(act);
  }

  load(by = "other") {
    return this.after(() => this.fetched(by));
  }

  async fetched(by) {
    const { gone } = this;
    try {
      this.take(await ask("case", { path: this.path }), by);
      this.gone = false;
      if (gone) tell(null); // that it was missing
    } catch (problem) {
      this.gone = problem.code === 404;
      throw problem;
    }
  }

  /** An answer about the file says that it is missing, whether or not that has been heard: it may be back. */
  lost() {
    this.gone = true;
    return this.load();
  }

  /** Does one thing after the other. */
  after(act) {
    const done = this.busy.then(act);
    this.busy = done.catch(() => {});
    return done;
  }

  /** What a change is made upon: the text as it is shown now. */
  shown() {
    return { text: this.text, version: this.version, foreign: this.foreign };
  }

  take(answer, by) {
    const { text, version, tree, error } = answer;
    const others = answer.before !== undefined || (by === "other" && version !== this.version);
    if (others && this.version !== undefined) this.foreign += 1;
    const before = answer.before === undefined ? { text: this.text, version: this.version }
      : { text: answer.before, version: null };
    this.last = version === this.version ? null : { file: this, before, after: { text, version } };
    Object.assign(this, { text, version, tree: tree || this.tree || {}, error: error || null,
      canUndo: answer.can_undo, canRedo: answer.can_redo });
    this.watchers.forEach((act) => act(this, by));
  }

  /** `make({ version, base, over })` asks the server for a change that was made upon `base`. */
  change(by, make, upon = this.shown()) {
    return this.after(async () => {
      const base = upon.foreign === this.foreign ? this.shown() : upon; // changes of this page go on
      try {
        const answer = await madeUpon(base, make, { taken: (now) => this.take(now, "other"), asks: by !== "text" });
        if (!answer) return; // what is there was chosen
        this.take(answer, by);
        tell(null);
      } catch (problem) {
        if (by === "edit" && problem.code !== 409) this.watchers.forEach((act) => act(this, "refused"));
        throw problem;
      }
    });
  }

  /** Edits { op, key, ... } of the server's list, made upon what was shown then. */
  edit(edits, upon) {
    return this.change("edit", (wish) => send("case", { ...wish, edits },
      { query: { path: this.path }, method: "PATCH" }), upon);
  }

  /** The whole text, made from that of `upon`; `over` what others have changed in the same lines. */
  put(text, upon, over = false) {
    const shown = this.version;
    return this.change("text", (wish) => send("case", { ...wish, text,
      ...(over ? { version: shown, base: upon.text, over } : {}) },
    { query: { path: this.path }, method: "PUT" }), upon);
  }

  /** To the text before or after this one in the file's history, whoever has made it. */
  step(way, wanted) {
    const upon = this.shown();
    return this.change("back", ({ version }) => send(`case/${way}`, { version, wanted },
      { query: { path: this.path } }), upon);
  }

  /** Takes back, or does again, one change { before, after } of this page; what others have done since stays. */
  async back(way, { before, after }) {
    const [here, there] = way === "undo" ? [after, before] : [before, after];
    if (this.version === here.version && there.version) {
      try {
        await this.step(way, there.version);
        return;
      } catch (problem) {
        if (problem.code !== 409) throw problem;
      }
    }
    await this.change("back", (wish) => send("case", { ...wish, text: there.text },
      { query: { path: this.path }, method: "PUT" }), here);
  }

  /** Another program or page has changed the file, or taken it away. */
  heard(version) {
    return this.after(() => (version === this.version && !this.gone ? null : this.fetched("other")));
  }
}

/** Asks for something about a file again and again, never twice at once; of several wishes the last one
 *  counts. `lost()` where the file is missing. */
export class Latest {
  constructor(act, lost, wait = 60) {
    Object.assign(this, { act, lost, wait, wanted: false, going: false });
  }

  ask() {
    this.wanted = true;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.go(), this.wait);
  }

  async go() {
    if (this.going || !this.wanted) return;
    this.going = true;
    this.wanted = false;
    try {
      await this.act();
    } catch (problem) {
      if (problem.code === 409) this.ask(); // the file has changed meanwhile
      else if (problem.code === 404) this.lost().catch(tell);
      else tell(problem);
    } finally {
      this.going = false;
      if (this.wanted) this.go();
    }
  }
}
