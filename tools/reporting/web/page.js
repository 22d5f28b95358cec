// SPDX-License-Identifier: GPL-3.0-or-later
// The page around the pictures: what it shows follows the settings.

import { fittingDigits, written } from "plyform/numbers.js";
import { gradient } from "plyform/colours.js";
import { differenceName } from "plyform/letters.js";

const at = (id) => document.getElementById(id);

export class Page {
  constructor({ runs, along }) {
    this.along = along;
    this.canvas = at("canvas");
    this.probe = at("probe");
    this.views = {
      formed: runs.map((_, r) => at(`formed-${r}`)), flat: runs.map((_, r) => at(`flat-${r}`)),
      difference: { difference: at("formed-difference"), "flat-difference": at("flat-difference") },
    };
  }

  /** Controls and legends as the settings are. */
  show(report) {
    const { settings, scale } = report;
    const field = report.field();
    const set = { field: settings.field, colours: settings.colours, steps: settings.steps,
      stroke: settings.state, apart: settings.apart, yarns: settings.yarns, tools: settings.tools,
      "flat-ply": settings.flatPly, "section-angle": settings.section.angle };
    for (const [id, value] of Object.entries(set)) if (at(id).value !== String(value)) at(id).value = value;
    for (const box of document.querySelectorAll("#plies input")) box.checked = !settings.hidden.has(box.dataset.ply);
    at("colours").disabled = Boolean(field.signed);
    const digits = fittingDigits(Math.max(Math.abs(scale.low), Math.abs(scale.high)));
    for (const key of ["low", "high"]) {
      if (document.activeElement !== at(key)) at(key).value = settings[key] === null ? "" : settings[key];
      at(key).placeholder = scale[key].toFixed(digits);
    }
    if (document.activeElement !== at("limit")) at("limit").value = settings.limit === null ? "" : settings.limit;
    at("section-angle-row").hidden = !settings.section.on || settings.section.level;
    at("section-offset-row").hidden = !settings.section.on;
    at("field-note").textContent = field.note;
    this.legend(at("legend"), scale, `${field.label}, ${field.unit}`, digits);
    this.tellState(report);
    if (at("formed-difference")) {
      const name = differenceName(settings.differenceOf);
      for (const id of ["formed-difference", "flat-difference"]) {
        at(id).hidden = !settings.difference;
        at(id).querySelector(".which").textContent = name;
      }
      document.body.classList.toggle("with-difference", settings.difference);
      at("difference").checked = settings.difference;
      if (at("difference-of")) at("difference-of").value = settings.differenceOf;
      const range = report.differenceRange;
      this.legend(at("legend-difference"), { low: -range, high: range, steps: settings.steps,
        colours: "diverging", limit: null }, `${name}: ${field.label}, ${field.unit}`, fittingDigits(range));
      at("legend-difference").hidden = !settings.difference;
    }
  }

  /** How far a state is, in words. */
  reached(value) {
    return `${written(value, 2)} ${this.along.unit}${this.along.word === "stroke" ? " of stroke" : ""}`;
  }

  tellState(report) {
    const [first] = report.runs;
    const { state } = report.settings;
    at("state").textContent = this.reached(first.reached[state]);
    at("state-number").textContent = `state ${state + 1} of ${first.reached.length}`;
    report.states().forEach((one, r) => {
      const label = at(`formed-${r}`).querySelector(".reached");
      if (label) label.textContent = `${written(report.runs[r].reached[one], 2)} ${this.along.unit}`;
    });
  }

  legend(place, scale, title, digits) {
    place.querySelector(".legend-title").textContent = title;
    place.querySelector(".legend-bar").style.background = gradient(scale.colours, scale.steps);
    const numbers = place.querySelector(".legend-numbers");
    numbers.replaceChildren(...[0, 0.25, 0.5, 0.75, 1].map((share) => {
      const number = document.createElement("span");
      number.textContent = written(scale.low + share * (scale.high - scale.low), digits);
      return number;
    }));
    const over = place.querySelector(".legend-limit");
    if (!over) return;
    over.hidden = scale.limit === null;
    over.querySelector("b").textContent = scale.limit === null ? "" : written(scale.limit, digits);
  }
}
