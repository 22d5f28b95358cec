// SPDX-License-Identifier: GPL-3.0-or-later
// Changes of a file, each upon the text that it was made from: the server puts together what others have
// changed meanwhile, and where both have changed the same, the page asks.

import { agreed } from "workbench/page/dialogue.js";

/** The answer of `make({ version, base, over })`, which asks the server for a change made upon `base`, { text,
 * version }; null if what is there was chosen. `taken(now)`: another text is there; `asks`: else it is thrown. */
export async function madeUpon(base, make, { taken = () => {}, asks = true } = {}) {
  let wish = { version: base.version || "" };
  for (;;) {
    try {
      return await make(wish);
    } catch (problem) {
      const { now, clashes = [] } = problem.said || {};
      if (problem.code !== 409 || !now) throw problem;
      if (wish.base === undefined) {
        wish = { ...wish, base: base.text };
        continue;
      }
      taken(now);
      if (!asks || !clashes.length || clashes.some((one) => one.lost)) throw problem;
      if (!await agreed("clash", "Changed by another too", clashes.map((one) =>
        `${one.what}: there ${one.now || "nothing"}, here ${one.wanted || "nothing"}`), "Take what is here",
      "Take what is there")) return null;
      wish = { version: now.version, base: base.text, over: true };
    }
  }
}
