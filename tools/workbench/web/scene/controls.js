// SPDX-License-Identifier: GPL-3.0-or-later
// Buttons and boxes of a SceneView: from where it is seen, tools, section, yarns, measuring.

import { element } from "workbench/page/elements.js";
import { VIEW_KEYS } from "workbench/scene/view.js";

const SECTIONS = { off: "no section", x: "along x", y: "along y", angle: "at an angle", level: "level" };
const YARNS = [0, 2, 5, 10, 20, 50];

function selectOf(id, title, options, act) {
  const made = element("select", { id, title, "aria-label": title },
    ...Object.entries(options).map(([value, textContent]) => element("option", { value, textContent })));
  made.addEventListener("change", () => act(made.value));
  return made;
}

function toggle(id, textContent, title, act) {
  const made = element("button", { type: "button", id, textContent, title, "aria-pressed": "false" });
  made.addEventListener("click", () => act(made.getAttribute("aria-pressed") !== "true"));
  return made;
}

/** Controls of the section: which way, and how far it is shifted. */
function sectionControls(view, name) {
  const set = (patch) => view.change({ section: { ...view.settings.section, ...patch } });
  const offset = element("input", { type: "range", id: `${name}-section-offset`, min: -100, max: 100, step: 0.5,
    value: 0, hidden: true,
    title: "Section shifted", "aria-label": "Section shifted" });
  const angle = element("input", { type: "range", id: `${name}-section-angle`, min: 0, max: 180, step: 1, value: 0,
    hidden: true,
    title: "Angle of the section", "aria-label": "Angle of the section" });
  const way = selectOf(`${name}-section`, "Section", SECTIONS, (value) => {
    offset.hidden = value === "off";
    angle.hidden = value !== "angle";
    set({ on: value !== "off", level: value === "level", angle: { x: 0, y: 90 }[value] ||
      (value === "angle" ? angle.valueAsNumber : 0) });
  });
  offset.addEventListener("input", () => set({ offset: (offset.valueAsNumber / 200) * view.size() }));
  angle.addEventListener("input", () => set({ angle: angle.valueAsNumber }));
  return [way, offset, angle];
}

/** A bar of controls above a view; ids begin with `name`. */
export function sceneControls(view, name = "scene") {
  const views = element("span", { className: "buttons" }, ...Object.values(VIEW_KEYS).map((one, i) => {
    const made = element("button", { type: "button", id: `${name}-view-${one}`, textContent: one,
      title: `Seen ${one} (key ${i + 1})` });
    made.addEventListener("click", () => view.seenFrom(one));
    return made;
  }));
  const home = element("button", { type: "button", id: `${name}-view-home`, textContent: "whole",
    title: "All of it (key 0)" });
  home.addEventListener("click", () => view.home());
  views.append(home);
  const tools = selectOf(`${name}-tools`, "Tools (key t)", { outlines: "tools: outlines", solid: "tools: solid",
    hidden: "tools: hidden" }, (value) => view.change({ tools: value }));
  const yarns = selectOf(`${name}-yarns`, "Lines along the yarns", Object.fromEntries(YARNS.map((step) => [step,
    step ? `yarns: ${step} mm` : "yarns: none"])), (value) => view.change({ yarns: Number(value) }));
  const apart = element("input", { type: "range", id: `${name}-apart`, min: 0, max: 60, step: 1, value: 0,
    title: "Plies drawn apart",
    "aria-label": "Plies drawn apart" });
  apart.addEventListener("input", () => view.change({ apart: apart.valueAsNumber * view.size() / 600 }));
  const measure = toggle(`${name}-measure`, "measure", "Distance between two clicked points (key m)", (on) =>
    view.change({ measure: on }));
  const labels = toggle(`${name}-labels`, "labels", "Gaps, first contacts, boundaries", (on) =>
    view.change({ marks: on }));
  const bar = element("div", { className: "scene-controls", role: "toolbar", "aria-label": "Picture" },
    element("span", { className: "line" }, views, measure, labels),
    element("span", { className: "line" }, tools, yarns, ...sectionControls(view, name),
      element("label", { className: "slide", title: "Plies drawn apart" }, "plies apart ", apart)));
  const follow = (settings) => {
    tools.value = settings.tools;
    if (![...yarns.options].some((one) => Number(one.value) === settings.yarns)) {
      yarns.append(element("option", { value: settings.yarns, textContent: `yarns: ${settings.yarns} mm` }));
    }
    yarns.value = String(settings.yarns);
    measure.setAttribute("aria-pressed", String(settings.measure));
    labels.setAttribute("aria-pressed", String(settings.marks));
  };
  view.acts.changed = follow;
  follow(view.settings);
  return bar;
}

/** The slider of the tools' programme. */
export function strokeControl(view, name = "scene") {
  const slider = element("input", { type: "range", id: `${name}-stroke`, min: 0, max: 100, step: 0.5, value: 0,
    "aria-label": "Place of the tools, % of their programme" });
  const words = element("output", { id: `${name}-stroke-words`, textContent: "0 %" });
  slider.addEventListener("input", () => {
    words.textContent = `${slider.value} %`;
    view.at(slider.valueAsNumber / 100);
  });
  return element("div", { className: "bar stroke" }, element("span", { textContent: "Tools at",
    title: "Tools on their way: 0 % at the start, 100 % at the end of the stroke" }), slider, words);
}
