// SPDX-License-Identifier: GPL-3.0-or-later
// Where the page begins: the panels, one shown at a time, and the address of what is shown (#setup/CASE).

import { connect } from "workbench/page/server.js";
import { element, tell } from "workbench/page/elements.js";
import { identifyPanel } from "workbench/identify/panel.js";
import { resultsPanel } from "workbench/results/panel.js";
import { runs } from "workbench/runs/panel.js";
import { setupPanel } from "workbench/setup/panel.js";
import { studiesPanel } from "workbench/studies/panel.js";

/** A panel: `word` in the address, `title`, `show(place, rest)`, which fills an element once and is
 * called again with another rest of the address. */
const panels = [setupPanel, runs, resultsPanel, studiesPanel, identifyPanel];

function shown() {
  const [word, ...rest] = decodeURIComponent(location.hash.slice(1)).split("/");
  return { panel: panels.find((one) => one.word === word) || panels[0], rest: rest.join("/") };
}

function show() {
  const { panel, rest } = shown();
  if (!panel) return;
  for (const one of panels) {
    one.place.hidden = one !== panel;
    one.tab.setAttribute("aria-selected", String(one === panel));
  }
  Promise.resolve(panel.show(panel.place, rest)).catch(tell);
}

function start() {
  for (const panel of panels) {
    panel.place = element("section", { id: `panel-${panel.word}`, hidden: true });
    panel.tab = element("a", { href: `#${panel.word}`, role: "tab", textContent: panel.title });
    document.getElementById("panels").append(panel.tab);
    document.getElementById("panel").append(panel.place);
  }
  window.addEventListener("hashchange", show);
  connect();
  show();
  document.documentElement.dataset.ready = String(Math.round(performance.now()));
}

start();
