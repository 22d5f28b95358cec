// SPDX-License-Identifier: GPL-3.0-or-later
// Shares of the area over a value, of the last state: a line of steps for each ply, with its mean and range.

import { Chart } from "plyform/charts.js";
import { written } from "plyform/numbers.js";

/** A bin as two corners, from zero to zero at the ends. */
function stepped({ at, step, lines }) {
  const half = step / 2;
  return { reached: [at[0] - half, ...at.flatMap((x) => [x - half, x + half]), at[at.length - 1] + half],
    lines: lines.map((line) => ({ ...line, values: [0, ...line.values.flatMap((share) => [share, share]), 0] })) };
}

/** `of`: of each run its histogram, or nothing. */
export function drawHistogram(place, of) {
  const one = of.find(Boolean);
  const runs = of.map((histogram) => (histogram ? stepped(histogram) : { reached: [], lines: [] }));
  const chart = new Chart(place, one, runs, one.along, () => {});
  chart.mark.remove(); // there is no state to go to
  for (const { number, line } of chart.numbers) {
    number.textContent = `${written(line.mean, 1)} ${one.along.unit}, ` +
      `${written(line.least, 1)} to ${written(line.largest, 1)}`;
  }
}
