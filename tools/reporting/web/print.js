// SPDX-License-Identifier: GPL-3.0-or-later
// Still pictures for the printed page, made when printing begins.

import { differenceName, prefixOf } from "plyform/letters.js";

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
      const run = prefixOf(report.runs.indexOf(view.run), report.runs);
      const difference = differenceName(report.settings.differenceOf);
      const reached = report.page.reached(view.run.reached[view.state]);
      if (view.flat) {
        const { name } = view.run.plies[report.settings.flatPly];
        add(view, null, `${view.difference ? `${difference}: ` : run}${name}, flat`);
        continue;
      }
      for (const name of ["oblique", "top"]) {
        add(view, name, `${view.difference ? `${difference}, ` : run}${name}, ${reached}`);
      }
    }
    Object.assign(stage.camera, { azimuth, elevation });
    stage.draw();
  });
}
