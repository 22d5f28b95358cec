// SPDX-License-Identifier: GPL-3.0-or-later
// Still pictures for the printed page, made when printing begins.

import { written } from "plyform/numbers.js";

export function preparePrint(report) {
  window.addEventListener("beforeprint", () => {
    const { stage } = report;
    const { azimuth, elevation } = stage.camera;
    const place = document.getElementById("prints");
    place.replaceChildren();
    const add = (view, name, text) => {
      if (name) stage.camera.set(name);
      const figure = document.createElement("figure");
      const picture = document.createElement("img");
      picture.src = stage.still(view, 720, 520);
      const words = document.createElement("figcaption");
      words.textContent = text;
      figure.append(picture, words);
      place.append(figure);
    };
    for (const view of stage.views) {
      if (view.difference && !report.settings.difference) continue;
      const run = report.runs.length > 1 ? `${"AB"[report.runs.indexOf(view.run)]}: ` : "";
      const stroke = written(view.run.stroke[view.state], 2);
      if (view.flat) {
        add(view, null, `${view.difference ? "B − A: " : run}${view.run.plies[report.settings.flatPly].name}, flat`);
        continue;
      }
      for (const name of ["oblique", "top"]) {
        add(view, name, `${view.difference ? "B − A" : run}${name}, ${stroke} mm of stroke`);
      }
    }
    Object.assign(stage.camera, { azimuth, elevation });
    stage.draw();
  });
}
