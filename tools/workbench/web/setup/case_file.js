// SPDX-License-Identifier: GPL-3.0-or-later
// One TOML file as the server has it: changed by edits or as a whole, one after the other, each upon
// the version that the last one made.

import { ask, send } from "workbench/page/server.js";
import { tell } from "workbench/page/elements.js";

export class CaseFile {
  constructor(path) {
    this.path = path;
    this.watchers = [];
    this.busy = Promise.resolve();
  }

  /** `act(file, by)` after each change; by: "edit", "text", "back", "other". */
  watch(act) {
    this.watchers.push(act);
  }

  load(by = "other") {
    return this.after(async () => this.take(await ask("case", { path: this.path }), by));
  }

  /** Does one thing after the other. */
  after(act) {
    const done = this.busy.then(act);
    this.busy = done.catch(() => {});
    return done;
  }

  take(answer, by) {
    const { text, version, tree, error } = answer;
    Object.assign(this, { text, version, tree: tree || this.tree || {}, error: error || null,
      canUndo: answer.can_undo, canRedo: answer.can_redo });
    this.watchers.forEach((act) => act(this, by));
  }

  change(by, ask_) {
    return this.after(async () => {
      try {
        this.take(await ask_(this.version), by);
        tell(null);
      } catch (problem) {
        if (problem.code === 409) this.take(await ask("case", { path: this.path }), "other");
        else if (by === "edit") this.watchers.forEach((act) => act(this, "refused"));
        throw problem;
      }
    });
  }

  /** Edits { op, key, ... } of the server's list. */
  edit(edits) {
    return this.change("edit", (version) => send("case", { version, edits },
      { query: { path: this.path }, method: "PATCH" }));
  }

  put(text) {
    return this.change("text", (version) => send("case", { version, text },
      { query: { path: this.path }, method: "PUT" }));
  }

  undo() {
    return this.change("back", () => send("case/undo", {}, { query: { path: this.path } }));
  }

  redo() {
    return this.change("back", () => send("case/redo", {}, { query: { path: this.path } }));
  }

  /** Another program or page has changed the file. */
  heard(version) {
    return this.after(() => (version === this.version ? null
      : ask("case", { path: this.path }).then((answer) => this.take(answer, "other"))));
  }
}

/** Asks for something again and again, never twice at once; of several wishes the last one counts. */
export class Latest {
  constructor(act, wait = 60) {
    Object.assign(this, { act, wait, wanted: false, going: false });
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
      else tell(problem);
    } finally {
      this.going = false;
      if (this.wanted) this.go();
    }
  }
}
