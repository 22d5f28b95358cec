// SPDX-License-Identifier: GPL-3.0-or-later
// The shear of formed plies in a SceneView, with its legend.

import { gradient } from "plyform/colours.js";
import { element } from "workbench/page/elements.js";

/** Moves plies { x, field } of a view to where they are and colours them from 0 to `high` degrees. */
export function showShear(view, legend, plies, high) {
  plies.forEach((ply, i) => {
    view.move(i, ply.x);
    view.colour(i, { of: "triangle", values: ply.field.map(Math.abs) }, { low: 0, high });
  });
  legend.replaceChildren("Shear angle 0", element("span", { className: "run-scale",
    style: { background: gradient("viridis", 0) } }), `${high}°`);
}
