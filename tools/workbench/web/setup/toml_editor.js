// SPDX-License-Identifier: GPL-3.0-or-later
// The text of a file beside its form. What is typed is saved 0.4 s later if it is TOML, as a change of the
// text that was shown when the typing began; until then it is kept, whatever is shown meanwhile.

import { button, element, tell } from "workbench/page/elements.js";

const WAIT = 400; // ms

/** Line (from 0) at which an item of a case begins, by its header; -1 if it is not found. */
export function lineOf(text, key) {
  const [first, second, ...rest] = key.split(".");
  const lines = text.split("\n");
  let seen = -1;
  let at = -1;
  for (let i = 0; i < lines.length; ++i) {
    const line = lines[i].replace(/#.*/, "").trim();
    if (line === `[[${first}]]`) seen += 1;
    if (/^\d+$/.test(second || "") && line === `[[${first}]]` && seen === Number(second)) at = i;
    if (line === `[${first}.${second}]` || line === `[${first}]`) at = i;
  }
  const name = rest.length ? rest[0] : second;
  for (let i = Math.max(at, 0); i < lines.length && name; ++i) {
    if (i > at && at >= 0 && /^\s*\[/.test(lines[i])) break;
    if (new RegExp(`^\\s*${name.replace(/[^\w-]/g, "")}\\s*=`).test(lines[i])) return i;
  }
  return at;
}

export class TomlEditor {
  constructor(place) {
    this.name = element("span", { className: "file-name", id: "toml-file" });
    this.note = element("span", { className: "note", id: "toml-note", role: "status" });
    this.revert = element("button", { type: "button", id: "toml-revert", className: "small",
      textContent: "Take back the text",
      hidden: true });
    this.revert.addEventListener("click", () => this.fill());
    this.keep = button("Keep this text", () => this.save(true), { id: "toml-keep", className: "small", hidden: true,
      title: "in these lines in the place of what another page or program has written" });
    place.append(element("div", { className: "bar" }, this.name, this.note, this.revert, this.keep));
    this.room = element("div", { className: "toml", id: "toml" });
    place.append(this.room);
    this.mirror = window.CodeMirror(this.room, { mode: "toml", lineNumbers: true,
      gutters: ["CodeMirror-linenumbers", "faults"],
      indentUnit: 2, viewportMargin: 40, inputStyle: "textarea" });
    this.mirror.getInputField().setAttribute("aria-label", "TOML of the file");
    this.mirror.on("change", (_, change) => change.origin !== "setValue" && this.typed());
    this.marked = [];
    this.drafts = new Map(); // what has been typed in files that are not shown, and upon which text, by path
    this.followed = new WeakSet();
    window.addEventListener("beforeunload", (event) => (this.dirty || this.drafts.size) && event.preventDefault());
  }

  /** Shows a CaseFile, and follows it. */
  show(file) {
    if (this.file === file) return;
    if (this.dirty) this.drafts.set(this.file.path, { text: this.mirror.getValue(), upon: this.upon });
    this.save();
    this.file = file;
    if (!this.followed.has(file)) file.watch((changed, by) => changed === this.file && this.changed(by));
    this.followed.add(file);
    const draft = this.drafts.get(file.path);
    this.drafts.delete(file.path);
    this.fill();
    if (draft && draft.text !== file.text) {
      this.mirror.setValue(draft.text);
      Object.assign(this, { dirty: true, upon: draft.upon });
      this.save();
    }
    this.mirror.clearHistory();
  }

  changed(by) {
    if (by === "refused") return;
    if (!this.dirty) this.fill();
    else if (by !== "text") this.note.textContent = "the file has been changed beside this text, which is not saved";
  }

  fill() {
    if (!this.file || this.file.text === undefined) return;
    this.dirty = false;
    this.upon = { text: this.file.text, version: this.file.version };
    this.name.textContent = this.file.path;
    const { mirror } = this;
    if (mirror.getValue() !== this.file.text) {
      const [cursor, scroll] = [mirror.getCursor(), mirror.getScrollInfo()];
      mirror.setValue(this.file.text);
      mirror.setCursor(cursor, undefined, { scroll: false });
      mirror.scrollTo(scroll.left, scroll.top);
    }
    this.settled();
  }

  settled() {
    this.dirty = false;
    this.revert.hidden = this.keep.hidden = true;
    this.problem(this.file.error);
  }

  typed() {
    this.dirty = true;
    this.note.textContent = "";
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.save(), WAIT);
  }

  /** `over`: in the place of what others have written in the same lines. */
  async save(over = false) {
    clearTimeout(this.timer);
    if (!this.dirty || !this.file) return;
    const text = this.mirror.getValue();
    const { file, upon } = this;
    try {
      await file.put(text, upon, over);
      this.drafts.delete(file.path);
      if (file === this.file && this.mirror.getValue() === text) this.fill();
      else if (file === this.file) this.upon = { text, version: file.text === text ? file.version : "" };
    } catch (problem) {
      if (file === this.file) this.refused(problem);
      else tell(new Error(`${file.path}: what was typed is not saved: ${problem.message}`));
    }
  }

  /** What is typed stays, and is not saved. */
  refused(problem) {
    const { line, error } = problem.said || {};
    this.problem({ line: line || 0, words: error || problem.message });
    this.revert.hidden = false;
    this.keep.hidden = !(problem.code === 409 && problem.said && problem.said.now);
  }

  /** What is not TOML, or nothing. */
  problem(error) {
    this.error = error;
    this.note.classList.toggle("wrong", Boolean(error));
    const words = error && (error.words || error.error || "no TOML");
    this.note.textContent = error ? `${error.line ? `line ${error.line}: ` : ""}${words}; not saved` : "saved";
    this.draw();
  }

  /** Mistakes { line, text, warning } as marks beside the lines. */
  mark(faults) {
    this.faults = faults;
    this.draw();
  }

  draw() {
    const { mirror } = this;
    mirror.clearGutter("faults");
    for (const line of this.marked) mirror.removeLineClass(line, "background");
    this.marked = [];
    const all = [...(this.faults || []), ...(this.error && this.error.line ? [{ line: this.error.line,
      text: this.error.words || this.error.error }] : [])];
    const byLine = new Map();
    for (const fault of all) byLine.set(fault.line, [...(byLine.get(fault.line) || []), fault]);
    for (const [line, faults] of byLine) {
      if (line < 1 || line > mirror.lineCount()) continue;
      const wrong = faults.some((one) => !one.warning);
      const words = faults.map((one) => one.text).join("\n");
      mirror.setGutterMarker(line - 1, "faults", element("span", { className: wrong ? "fault" : "fault warning",
        textContent: wrong ? "●" : "▲", title: words, role: "img", "aria-label": words,
        dataset: { line: String(line) } }));
      this.marked.push(mirror.addLineClass(line - 1, "background", wrong ? "fault-line" : "warning-line"));
    }
  }

  /** Brings a line (from 1) to sight. */
  point(line) {
    if (line < 1) return;
    this.mirror.scrollIntoView({ line: line - 1, ch: 0 }, 60);
    const handle = this.mirror.addLineClass(line - 1, "wrap", "pointed");
    setTimeout(() => this.mirror.removeLineClass(handle, "wrap", "pointed"), 1200);
  }

  pointKey(key) {
    this.point(lineOf(this.mirror.getValue(), key) + 1);
  }
}
