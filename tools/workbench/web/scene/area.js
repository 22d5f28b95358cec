// SPDX-License-Identifier: GPL-3.0-or-later
// The scene of a case with its controls: asked for anew after each edit; what was drawn last stays.

import { element } from "workbench/page/elements.js";
import { withoutKey } from "workbench/page/faults.js";
import { unpacked } from "workbench/page/packed.js";
import { sceneControls, strokeControl } from "workbench/scene/controls.js";
import { InstantShear } from "workbench/scene/instant.js";
import { SceneView } from "workbench/scene/view.js";
import { askBytes } from "workbench/page/server.js";

const short = (value) => Number(value.toFixed(Math.abs(value) < 10 ? 2 : 1)).toString();

/** Call-outs of gaps and first contacts. */
function calloutsOf(scene) {
  const list = [];
  for (const tool of scene.tools || []) {
    const { gap, first_contact: met, name, key } = tool;
    if (gap && gap.place && gap.mm < 1e4) {
      const words = gap.mm < 0 ? `${name} is ${short(-gap.mm)} mm in` : `${name} ${short(gap.mm)} mm from`;
      const other = gap.ply === undefined || gap.ply === null ? "the stack" : gap.ply;
      list.push({ at: gap.place, text: `${words} ${other}`, kind: gap.mm < -1e-6 ? "wrong" : "gap", key });
    }
    if (met && met.place) {
      const share = met.share === undefined || met.share === null ? "" : ` (${short(100 * met.share)} %)`;
      list.push({ at: met.place, text: `${name}: first contact at ${short(met.stroke_mm)} mm${share}`,
        kind: "contact", key });
    }
  }
  for (const { a, b, mm, place } of scene.gaps || []) {
    if (place && mm < 0) list.push({ at: place, text: `${a} and ${b} overlap by ${short(-mm)} mm`, kind: "wrong",
      key: "" });
  }
  for (const boundary of scene.boundaries || []) {
    const at = placeOf(boundary, scene.plies || []);
    if (at) list.push({ at, text: `${boundary.name} (${boundary.kind})`, kind: "boundary", key: boundary.key });
  }
  return list;
}

/** A place of a boundary: the middle of the nodes that it holds, else its anchor. */
function placeOf({ nodes, places }, plies) {
  for (const [i, held] of (Array.isArray(nodes) ? nodes : []).entries()) {
    const x = plies[i] && plies[i].x;
    if (x && held && held.length) {
      const node = held[Math.floor(held.length / 2)];
      return [...x.slice(3 * node, 3 * node + 3)];
    }
  }
  return places && places.length > 2 ? [...places.slice(0, 3)] : null;
}

function centreOf(x) {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  for (let i = 0; i < x.length; ++i) {
    low[i % 3] = Math.min(low[i % 3], x[i]);
    high[i % 3] = Math.max(high[i % 3], x[i]);
  }
  return low.map((value, k) => 0.5 * (value + high[k]));
}

export class SceneArea {
  constructor(place, acts) {
    this.room = element("div", { className: "scene-room", id: "scene" });
    this.note = element("p", { className: "scene-note", id: "scene-note", role: "status", hidden: true });
    this.measured = element("output", { id: "measured", className: "measured" });
    this.view = new SceneView(this.room, { ...acts, measured: (words) => { this.measured.textContent = words; } });
    this.stroke = strokeControl(this.view);
    this.stroke.append(this.measured);
    const controls = sceneControls(this.view);
    place.append(controls, this.room, this.stroke);
    this.room.append(this.note);
    this.instant = new InstantShear(this.room);
    controls.firstElementChild.append(this.instant.toggle);
  }

  /** The scene of a version of a case, shown; null if there is none, and then the last one stays. A draft
   * comes at once, also of tools of very many facets, of whose gaps it says nothing. */
  async ask(file, fit, draft) {
    let scene;
    const { path, version } = file;
    try {
      scene = unpacked(await askBytes("scene", draft ? { path, version, draft } : { path, version }));
    } catch (problem) {
      if (problem.code === 409) throw problem;
      this.old(problem.message);
      return null;
    }
    if (scene.version && file.version && scene.version !== file.version) return null;
    const bodies = [...(scene.plies || []), ...(scene.tools || [])].filter((one) => one.x && one.x.length);
    if (!bodies.length && !fit) {
      this.old((scene.missing || []).join("; ") || "nothing of this can be drawn");
      return null;
    }
    this.scene = scene;
    this.room.classList.remove("nothing");
    this.view.show(scene, fit);
    this.callouts = calloutsOf(scene);
    this.view.callOut(this.callouts);
    const missing = (scene.missing || []).map((one) => (typeof one === "string" ? one : one.words ||
      JSON.stringify(one)));
    const notes = scene.draft ? ["tools of many facets are being looked at: gaps and first contacts follow"] : [];
    if (missing.length) notes.push(`not drawn: ${missing.join("; ")}`);
    this.say(notes.join("; "));
    this.instant.ask({ path, version });
    return scene;
  }

  /** Nothing of another case stays. */
  clear() {
    this.scene = null;
    this.callouts = [];
    this.instant.clear();
    this.room.classList.add("nothing");
    this.say("");
  }

  say(words) {
    this.note.textContent = words;
    this.note.hidden = !words;
  }

  /** What is shown is not what the file says. */
  old(words) {
    this.say(`${this.scene ? "last scene that could be drawn; " : ""}${words}`);
  }

  choose(item) {
    this.chosen = item;
    this.view.handle(item.startsWith("ply.") ? item : null);
    this.instant.choose(item);
  }

  /** Marks bodies that are chosen or have mistakes, and writes the mistakes beside them. */
  blame(faults, chosen) {
    if (!this.scene) return;
    const wrong = new Map();
    for (const fault of faults) {
      const { key, warning } = fault;
      const body = key.split(".").slice(0, 2).join(".");
      if (!warning && !wrong.has(body)) wrong.set(body, withoutKey(fault));
    }
    this.view.mark((key) => (wrong.has(key) ? "wrong" : key === chosen ? "chosen" : null));
    const bodies = [...(this.scene.plies || []), ...(this.scene.tools || [])];
    const wordsOf = ({ name, key }) => (wrong.get(key).startsWith(`${name}: `) ? "" : `${name}: `) + wrong.get(key);
    const marks = bodies.filter((one) => one.x && one.x.length && wrong.has(one.key)).map((one) => ({
      at: centreOf(one.x), text: wordsOf(one), kind: "wrong", key: one.key }));
    this.view.callOut([...(this.callouts || []), ...marks]);
  }
}
