// SPDX-License-Identifier: GPL-3.0-or-later
// Where the page begins.

import { Chart } from "plyform/charts.js";
import { connect, showPlace } from "plyform/controls.js";
import { drawHistogram } from "plyform/histogram.js";
import { localise, written } from "plyform/numbers.js";
import { Page } from "plyform/page.js";
import { preparePrint } from "plyform/print.js";
import { showContact } from "plyform/tool_contact.js";
import { Report } from "plyform/report.js";

function drawCharts(report, scene) {
  const ids = [...new Set(scene.runs.flatMap((run) => run.charts.map((chart) => chart.id)))];
  const charts = ids.map((id) => {
    const of = scene.runs.map((run) => run.charts.find((chart) => chart.id === id));
    const runs = scene.runs.map((run, r) => ({ reached: run.reached, lines: of[r] ? of[r].lines : [] }));
    return new Chart(document.getElementById(`chart-${id}`), of.find(Boolean), runs, scene.along,
      (reached) => report.goTo(reached));
  });
  report.watchers.push((states) => charts.forEach((chart) =>
    chart.show(report.runs[0].reached[states[0]], states)));
}

function drawHistograms(scene) {
  const ids = [...new Set(scene.runs.flatMap((run) => run.histograms.map((one) => one.id)))];
  for (const id of ids) {
    drawHistogram(document.getElementById(`histogram-${id}`),
      scene.runs.map((run) => run.histograms.find((one) => one.id === id)));
  }
}

/** The value under the cursor, while it rests on a ply. */
function hints(report) {
  const hint = document.getElementById("hint");
  let asked = 0;
  for (const view of report.stage.views.filter((one) => !one.difference)) {
    view.element.addEventListener("pointerleave", () => { hint.hidden = true; asked += 1; });
    view.element.addEventListener("pointermove", async (event) => {
      asked += 1;
      const mine = asked;
      hint.hidden = true;
      if (event.buttons) return;
      await new Promise((go) => { setTimeout(go, 60); });
      if (mine !== asked) return;
      const probe = report.under(view, event.clientX, event.clientY);
      const value = probe ? await report.hint(probe) : null;
      if (value === null || mine !== asked) return;
      const field = report.field();
      hint.textContent = `${written(value, field.digits)} ${field.unit}`;
      hint.dataset.value = value;
      Object.assign(hint.style, { left: `${event.clientX + 14}px`, top: `${event.clientY + 14}px` });
      hint.hidden = false;
    });
  }
}

async function start() {
  localise(document);
  if (!window.WebGLRenderingContext || !window.DecompressionStream) {
    throw new Error("this browser lacks WebGL or DecompressionStream: take one of 2023 or later");
  }
  const scene = JSON.parse(document.getElementById("scene").textContent);
  const report = new Report(scene, new Page(scene));
  await report.load();
  document.documentElement.dataset.picture = String(Math.round(performance.now()));
  connect(report);
  drawCharts(report, scene);
  drawHistograms(scene);
  hints(report);
  preparePrint(report);
  await report.change({});
  report.runs.forEach((run, r) => showContact(document.getElementById(`contact-${r}`), run,
    (ply, triangle) => showPlace(report, { ply, triangle, run: r, field: "gap" })));
  document.documentElement.dataset.ready = String(Math.round(performance.now()));
  window.plyform_report = report; // for tests
}

start().catch((problem) => {
  const place = document.getElementById("trouble");
  place.textContent = `No pictures: ${problem.message}`;
  place.hidden = false;
  document.documentElement.dataset.ready = "failed";
  throw problem;
});
