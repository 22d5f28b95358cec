// SPDX-License-Identifier: GPL-3.0-or-later
// Files of a run: exported for other programs, mapped onto a part mesh, flat patterns, and what its
// folder holds, to be saved.

import { drawDrawing } from "workbench/results/dxf_drawing.js";
import { button, element, tell } from "workbench/page/elements.js";
import { FORMS } from "workbench/results/forms.js";
import { ask, askBytes, send } from "workbench/page/server.js";

const sizeText = (bytes) => (bytes < 1e6 ? `${Math.ceil(bytes / 1000)} kB` : `${(bytes / 1e6).toFixed(1)} MB`);
const LIVE = ["queued", "starting", "running"];

class ExportsView {
  constructor(place) {
    this.run = element("select", { id: "exports-run", "aria-label": "Run" });
    this.run.addEventListener("change", () => this.showRun().catch(tell));
    this.forms = element("div", { className: "forms" });
    this.files = element("table", { id: "exports-files" });
    this.drawing = element("figure", { id: "exports-drawing", hidden: true });
    this.none = element("p", { className: "note", id: "exports-none", textContent: "Choose a run in the list." });
    this.all = element("div", {},
      element("div", { className: "row" }, element("label", { textContent: "Run " }, this.run)),
      this.forms, element("h2", { textContent: "Files of the run" }), this.drawing,
      element("div", { className: "wide" }, this.files));
    place.append(this.none, this.all);
    this.processes = new Map(); // places of words, by number of the process
  }

  async show(chosen) {
    this.none.hidden = chosen.length > 0;
    this.all.hidden = !chosen.length;
    if (!chosen.length) return;
    const before = this.run.value;
    this.run.replaceChildren(...chosen.map(({ folder, title }) =>
      element("option", { value: folder, textContent: `${title} (${folder})` })));
    if (chosen.some(({ folder }) => folder === before)) this.run.value = before;
    await this.offer();
    await this.showRun();
  }

  /** What can be chosen: files may have come into the folder since. */
  async offer() {
    const offers = await ask("results/offers");
    if (!this.offered) {
      this.offered = [];
      this.forms.replaceChildren(...FORMS.map((form) => this.form(form, offers)));
    }
    for (const field of this.offered) field.offer(offers);
  }

  async showRun() {
    if (this.shown !== this.run.value) this.drawing.hidden = true;
    this.shown = this.run.value;
    const files = await ask("results/files", { folder: this.run.value });
    this.files.replaceChildren(element("tbody", {}, ...files.map((file) => this.file(file))));
  }

  file({ name, size }) {
    const folder = this.run.value;
    const query = new URLSearchParams({ folder, name });
    const link = element("a", { href: `./api/results/file?${query}`, download: name.split("/").pop(),
      textContent: name });
    const look = name.toLowerCase().endsWith(".dxf")
      ? button("Show", () => this.draw(folder, name), { "aria-label": `Show ${name}` }) : null;
    return element("tr", { dataset: { name } }, element("td", {}, link), element("td", { textContent: sizeText(size) }),
      element("td", {}, look));
  }

  async draw(folder, name) {
    const text = new TextDecoder().decode(await askBytes("results/drawing", { folder, name }));
    const place = element("div");
    const words = drawDrawing(place, text, name);
    this.drawing.replaceChildren(place, element("figcaption", { textContent: words }));
    this.drawing.hidden = false;
    this.drawing.scrollIntoView({ block: "nearest" });
  }

  form({ what, title, fields }, offers) {
    const inputs = fields(offers);
    this.offered.push(...inputs.filter((field) => field.offer));
    const words = element("p", { className: "note", role: "status", id: `${what}-words` });
    const command = element("code", { className: "command" });
    const go = button(title, async () => {
      const wish = { what, folder: this.run.value };
      for (const { key, value } of inputs) if (key) wish[key] = value();
      words.classList.remove("bad");
      words.textContent = "";
      const { id } = await send("results/export", wish);
      tell(null);
      this.processes.set(id, { words, command });
      await this.look(id);
    }, { id: `${what}-go`, className: "main" });
    return element("form", { id: `${what}-form`, onsubmit: () => false }, element("h2", { textContent: title }),
      ...inputs.map(({ place }) => place), go, words, command);
  }

  process({ record, last }) {
    const place = this.processes.get(record.id);
    if (!place) return;
    if (LIVE.includes(record.state)) place.words.textContent = last || "It goes on …";
    else this.look(record.id).catch(tell);
  }

  async look(id) {
    const place = this.processes.get(id);
    if (!place) return;
    const { state, error, log, command } = await ask("results/ended", { process: id });
    place.command.textContent = command;
    if (LIVE.includes(state)) {
      place.words.textContent = place.words.textContent || "It goes on …";
      return;
    }
    this.processes.delete(id);
    place.words.classList.toggle("bad", state !== "done");
    const said = log.split("\n").filter((line) => line.trim() && !line.startsWith("/"));
    place.words.textContent = state === "done" ? ["Done.", ...said].join("\n") : error || state;
    await this.showRun();
  }
}

export const exportsView = { word: "files", title: "Exports and files",
  made: (place) => new ExportsView(place) };
