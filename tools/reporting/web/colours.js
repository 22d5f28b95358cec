// SPDX-License-Identifier: GPL-3.0-or-later
// Colour scales that colour-blind people can read: viridis and cividis (matplotlib's, at 17 places)
// and, for values of both signs, blue over white to orange.

const stops = (text) => text.split(" ").map((hex) =>
  [0, 2, 4].map((k) => parseInt(hex.slice(k, k + 2), 16)));

const SCALES = {
  viridis: stops("440154 48186a 472d7b 424086 3b528b 33638d 2c728e 26828e 21918c 1fa088 28ae80 " +
    "3fbc73 5ec962 84d44b addc30 d8e219 fde725"),
  cividis: stops("00224e 002e6a 1a386f 32436d 434e6c 535a6d 61656f 6f7073 7d7c78 8c8878 9b9476 " +
    "aba072 bcae6c cdbb63 dec958 f0d846 fee838"),
  grey: stops("f2f2f2 1a1a1a"),
  diverging: stops("08306b 2166ac 5a9bd0 a6cbe3 f4f4f2 f7c690 e88d3a b8560c 6b2d04"),
};

export const SCALE_NAMES = Object.keys(SCALES);

function colourAt(scale, share) {
  const at = share * (scale.length - 1);
  const k = Math.min(Math.floor(at), scale.length - 2);
  return scale[k].map((low, c) => low + (at - k) * (scale[k + 1][c] - low));
}

/** 256 colours, RGBA, in steps if there are any. */
export function table(name, steps) {
  const bytes = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; ++i) {
    let share = i / 255;
    if (steps > 1) share = Math.min(Math.floor(share * steps), steps - 1) / (steps - 1);
    bytes.set([...colourAt(SCALES[name], share).map(Math.round), 255], 4 * i);
  }
  return bytes;
}

/** The same as a picture across, for the legend. */
export function gradient(name, steps) {
  const bytes = table(name, steps);
  const parts = [];
  for (let i = 0; i < 256; i += 1) {
    const colour = `rgb(${bytes[4 * i]},${bytes[4 * i + 1]},${bytes[4 * i + 2]})`;
    parts.push(`${colour} ${(100 * i) / 256}%`, `${colour} ${(100 * (i + 1)) / 256}%`);
  }
  return `linear-gradient(to right, ${parts.join(",")})`;
}

/** Lines of curves: told apart by colour-blind people, and by their dashes (Okabe and Ito 2008). */
export const LINES = [["#0072b2", ""], ["#d55e00", "6 3"], ["#009e73", "2 3"], ["#cc79a7", "8 3 2 3"],
  ["#56b4e9", "12 4"], ["#000000", "1 4"], ["#e69f00", "4 2 1 2"], ["#666666", "10 2 2 2"]];
export const lineStyle = (k) => LINES[k % LINES.length];
