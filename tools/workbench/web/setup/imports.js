// SPDX-License-Identifier: GPL-3.0-or-later
// Files dropped onto the page: uploaded into the folder of the case, made into tools, blanks and
// fabrics by the program's tools, and added to the case.

import { dialogue } from "workbench/page/dialogue.js";
import { numberOf } from "workbench/setup/inputs.js";
import { freeFabric } from "workbench/setup/case_dialogues.js";
import { ask, listen, send } from "workbench/page/server.js";
import { eachOf, uploaded } from "workbench/page/uploads.js";

const UNITS = [["mm", "mm"], ["cm", "cm"], ["m", "m"], ["inch", "inch"]];

const folderOf = (path) => path.split("/").slice(0, -1).join("/");

function positive(text, word) {
  const value = numberOf(text);
  if (!(value > 0)) throw new Error(`${word}: ${text || "nothing"} is no number above 0`);
  return value;
}

function directionOf(text) {
  const values = text.trim().split(/[\s;]+/).map(numberOf);
  if (values.length !== 3 || values.some(Number.isNaN) || !values.some(Boolean)) {
    throw new Error(`Direction of pressing: ${text}: three numbers that are not all 0`);
  }
  return values;
}

function angleOf(text) {
  const value = numberOf(text || "0");
  if (!(value >= 0 && value <= 80)) throw new Error(`Plies sheared by: ${text}: 0 to 80 degrees`);
  return value;
}

const ON_PAGE = [[/--on (\w+)/g, '"The surface is that of" the $1'], [/--on\b/g, '"The surface is that of"'],
  [/--solid part\b/g, '"A solid is" the formed part'], [/--solid tool\b/g, '"A solid is" the body of that tool'],
  [/--offset\b/g, '"Distance"'], [/--(stack|run)\b/g, '"Make"'], [/--shear\b/g, '"Plies sheared by"'],
  [/--deflection\b/g, '"Deflection"'], [/--direction\b/g, '"Direction of pressing"'],
  [/ or more --minutes\b/g, ""]];

/** What mesh_tool.py says, with its options as the page calls them. */
const asOnPage = (words) => ON_PAGE.reduce((text, [option, word]) => text.replace(option, word), words);

/** Until a process has ended: its record, having told how far it is. Its end may come before the
 * answer to the request that began it. */
async function ended(record, tell) {
  const live = (one) => ["queued", "starting", "running"].includes(one.state);
  let stop;
  const last = await new Promise((done) => {
    stop = listen("process", (event) => {
      if (event.record.id !== record.id) return;
      tell(event.last || event.record.state);
      if (!live(event.record)) done(event.record);
    });
    ask(`processes/${record.id}`).then((one) => !live(one) && done(one), () => {});
  });
  stop();
  if (last.state === "done") return last;
  const { log } = await ask(`processes/${record.id}`);
  throw new Error(asOnPage((log || "").trim().split("\n").pop()) || `it has ${last.state}`);
}

/** Runs what api/import begins: the files written, and what was said of them. */
async function made(body, tell) {
  const { process, outputs } = await send("import", body);
  await ended(process, tell);
  const { log } = await ask(`processes/${process.id}`);
  const said = log.split("\n").map((line) => line.split("\r").pop().trim());
  return { outputs, said: said.filter((line) => line && !outputs.some((path) => path.endsWith(line))) };
}

const PLACED = /stack\.bottom = (\S+); punch: position = (\[.*?\]), direction = (\[.*?\]), stroke = (\S+)/;

/** Where die and punch have to be so that they are closed at the end of the stroke, as mesh_tool.py tells it. */
function placeOf(said) {
  const [, bottom, position, direction, stroke] = said.join("\n").match(PLACED) || [];
  return bottom === undefined ? { bottom: null, punch: {} } : { bottom: Number(bottom), punch: {
    position: JSON.parse(position), direction: JSON.parse(direction), stroke: Number(stroke) } };
}

export class Imports {
  /** `work` as the form has it. `chooser`: an input of files, for those who do not drop. */
  constructor(place, work, chooser) {
    this.work = work;
    chooser.addEventListener("change", () => {
      this.take([...chooser.files]).catch(work.tell);
      chooser.value = "";
    });
    place.addEventListener("dragover", (event) => {
      event.preventDefault();
      place.classList.add("dropping");
    });
    place.addEventListener("dragleave", () => place.classList.remove("dropping"));
    place.addEventListener("drop", (event) => {
      event.preventDefault();
      place.classList.remove("dropping");
      this.take([...event.dataTransfer.files]).catch(work.tell);
    });
  }

  async take(files) {
    if (!this.work.main || this.work.ofFabric) throw new Error("Open or make a case first, into which the file can go");
    const curves = [];
    await eachOf(files, async (file) => {
      const sent = await uploaded(file, folderOf(this.work.main.path));
      if (!sent) return;
      await this.work.refreshFolder();
      if (sent.kind === "curve") curves.push(sent.path);
      else await this.ask(sent.kind, sent.path);
    }).finally(() => {
      if (curves.length) location.hash = `#identify/curve/${encodeURI(curves.join("\n"))}`;
    });
  }

  ask(kind, path) {
    const name = path.split("/").pop();
    const acts = { part: () => this.askPart(path, name), mesh: () => this.askMesh(path, name),
      drawing: () => this.askDrawing(path, name), toml: () => this.askFabric(path, name) };
    return acts[kind]();
  }

  async askPart(path, name) {
    const thick = this.stackThickness();
    const runs = (await ask("results").catch(() => [])).filter((run) => run.has_states);
    const window_ = dialogue("import-part", `Tools from ${name}`, [
      { name: "make", title: "Make", kind: "select", choices: [["tool", "one tool of this shape"],
        ["offset", "die and punch, a distance apart"], ["stack", "die and punch with room for this case's plies"],
        ...(runs.length ? [["run", "die and punch with room for the formed plies of a run"]] : [])] },
      { name: "offset", title: "Distance", kind: "number", unit: "mm", value: thick,
        note: "of die and punch, measured across the part" },
      { name: "shear", title: "Plies sheared by", kind: "number", unit: "°", value: 30,
        note: "where plies shear they grow thicker: the room is for plies sheared so" },
      { name: "run", title: "Run", kind: "select", choices: runs.map(({ folder, title }) => [folder,
        `${folder}${title ? ` (${title})` : ""}`]), note: "room by place, as thick as its plies were formed" },
      { name: "on", title: "The surface is that of", kind: "select", choices: [["die", "the die"],
        ["punch", "the punch"]] },
      { name: "solid", title: "A solid is", kind: "select", choices: [["part", "the formed part, with its thickness"],
        ["tool", "the body of that tool"]], note: "an open shell is taken as it is" },
      { name: "direction", title: "Direction of pressing", kind: "text", value: "0 0 -1",
        note: "x y z, from the punch to the die" },
      { name: "tools", title: "Tools that there are", kind: "select", choices: [["go", "go"], ["stay", "stay beside"]],
        note: (this.work.main.tree.tool || []).map((one) => one.name).join(", ") },
      { name: "deflection", title: "Deflection", kind: "number", unit: "mm", value: 0.05,
        note: "how far triangles may lie from the shape, at most" },
      { name: "replace", title: "Replace", kind: "checkbox", note: "meshes of an earlier time" },
    ], "Make tools", async ({ make, offset, shear, run, on, solid, direction, tools, deflection, replace }, tell) => {
      const body = { path, case: this.work.main.path, as: "tool", deflection: positive(deflection, "Deflection"),
        replace };
      if (make === "offset") Object.assign(body, { offset: positive(offset, "Distance"), on, solid });
      if (make === "stack") Object.assign(body, { stack: true, shear: angleOf(shear), on, solid });
      if (make === "run") Object.assign(body, { run, on, solid });
      const way = directionOf(direction);
      if (make !== "tool") body.direction = way;
      tell("begun");
      const { outputs, said } = await made(body, tell);
      await this.addMeshes(outputs, placeOf(said), way, make !== "tool" && tools === "go");
      dialogue("import-told", `Tools from ${name}`, said.map((title) => ({ kind: "note", title })), "Close", null);
    });
    const follow = () => {
      const make = window_.querySelector("#import-part-make").value;
      for (const one of ["offset", "shear", "run"]) {
        window_.querySelector(`#import-part-${one}`).closest(".asked").parentElement.hidden = make !== (one ===
          "shear" ? "stack" : one);
      }
      for (const one of ["on", "solid", "direction", "tools"]) {
        window_.querySelector(`#import-part-${one}`).disabled = make === "tool";
      }
    };
    window_.querySelector("#import-part-make").addEventListener("change", follow);
    follow();
  }

  stackThickness() {
    const { scene } = this.work;
    return scene && scene.stack_thickness_mm ? Number(scene.stack_thickness_mm.toFixed(3)) : undefined;
  }

  /** The box tells a wrong unit. */
  askMesh(path, name) {
    const wish = (unit) => ({ path, case: this.work.main.path, as: "tool", unit });
    const window_ = dialogue("import-mesh", `Tool from ${name}`, [
      { name: "unit", title: "Unit of the file", kind: "select", choices: UNITS, note: " " },
    ], "Add the tool", async ({ unit }) => this.add(await send("import", wish(unit))));
    const [unit, note] = [window_.querySelector("#import-mesh-unit"), window_.querySelector(".note")];
    const show = async () => {
      const { facets, box_mm: box } = await send("import", wish(unit.value));
      const size = box && box[1].map((high, k) => Number((high - box[0][k]).toPrecision(4)));
      note.textContent = size ? `${size.join(" × ")} mm, ${facets} facets` : "";
    };
    unit.addEventListener("change", () => show().catch(this.work.tell));
    show().catch(this.work.tell);
  }

  /** The unit that the drawing says is shown, and respected; another one is written into the case. */
  async askDrawing(path, name) {
    const { unit: said } = await send("import", { path, as: "blank", case: this.work.main.path });
    const others = UNITS.filter(([unit]) => unit !== said);
    dialogue("import-drawing", `Blank from ${name}`, [
      { name: "unit", title: "Unit of the drawing", kind: "select",
        choices: said ? [[said, `${said}, as the drawing says`], ...others] : UNITS,
        note: said ? "" : "the drawing says none" },
      { name: "element_size", title: "Element size", kind: "number", unit: "mm", value: 10 },
    ], "Add the blank", async ({ unit, element_size: size }) => this.add(await send("import",
      { path, as: "blank", unit,
      case: this.work.main.path, element_size: positive(size, "Element size") })));
  }

  async askFabric(path, name) {
    const wish = await send("import", { path, as: "fabric", case: this.work.main.path });
    dialogue("import-fabric", `Fabric ${name}`, [{ name: "name", title: "Name in this case", kind: "text",
      value: freeFabric(this.work.main.tree, wish.name) }], "Add the fabric",
    (values) => this.add({ ...wish, name: values.name }));
  }

  /** Adds { key, name, value } to the case. */
  async add({ key, name, value }) {
    const { main } = this.work;
    if (key === "fabrics") {
      await main.edit([{ op: "set", key: `fabrics.${name}`, value }]);
      this.work.choose(`fabrics.${name}`);
    } else if (key === "blanks") {
      const free = freeWord(Object.keys(main.tree.blanks || {}), name);
      await main.edit([{ op: "add", key, name: free, value }]);
      this.work.choose(`blanks.${free}`);
    } else {
      const names = (main.tree.tool || []).map((one) => one.name);
      await main.edit([{ op: "add", key, value: { name: freeWord(names, name), ...value } }]);
      this.work.choose(`tool.${names.length}`);
    }
  }

  /** Adds meshes that were made; a punch is driven from where it clears the stack. A tool of the same file stays
   * what it is; with `alone` the new ones take the place of those of their names, and of all others. */
  async addMeshes(paths, { bottom, punch }, direction, alone) {
    await this.work.refreshFolder();
    const { main } = this.work;
    const before = main.tree.tool || [];
    const [edits, kept] = [[], new Set()];
    let last;
    for (const path of paths) {
      const [, word] = path.match(/_(die|punch)\.\w+$/) || [];
      const wish = await send("import", { path, as: "tool", unit: "mm", case: main.path });
      const moves = word === "punch" ? { motion: "driven", direction, stroke: 10, ...punch } : {};
      const value = { ...wish.value, ...moves };
      const name = word || wish.name;
      const there = before.find((one) => one.file === value.file) || (alone && before.find((one) => one.name === name));
      if (there && there.file === value.file) {
        edits.push(...Object.entries(value).map(([key, part]) => ({ op: "set", key: `tool.${there.name}.${key}`,
          value: part })));
      } else if (there) {
        edits.push({ op: "set", key: `tool.${there.name}`, value: { name, ...value } });
      } else {
        edits.push({ op: "add", key: "tool", value: { name: freeWord(alone ? [] : before.map((one) => one.name), name),
          ...value } });
      }
      if (there) kept.add(there.name);
      last = value.file;
    }
    const gone = alone ? before.filter(({ name }) => !kept.has(name)) : [];
    if (bottom !== null && ((main.tree.stack || {}).bottom || 0) !== bottom) {
      edits.push({ op: "set", key: "stack.bottom", value: bottom });
    }
    await main.edit([...gone.map(({ name }) => ({ op: "remove", key: `tool.${name}` })), ...edits]);
    this.work.choose(`tool.${Math.max(0, (main.tree.tool || []).findIndex(({ file }) => file === last))}`);
  }
}

function freeWord(taken, word) {
  if (!taken.includes(word)) return word;
  for (let k = 2; ; ++k) if (!taken.includes(`${word}_${k}`)) return `${word}_${k}`;
}
