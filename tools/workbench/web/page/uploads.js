// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are dropped or chosen, sent into the folder.

import { agreed } from "workbench/page/dialogue.js";
import { upload } from "workbench/page/server.js";

/** Where a file has been put: { path, kind }; in the place of another of its name if that is wanted, else null. */
export async function uploaded(file, folder) {
  const name = file.name.replace(/[^A-Za-z0-9_.-]/g, "_");
  let replace = "";
  for (;;) {
    try {
      return await upload({ name, folder, replace }, file);
    } catch (problem) {
      const [there] = (problem.said && problem.said.clashes) || [];
      if (problem.code !== 409 || !there || !there.now) throw problem;
      if (!await agreed("replace", name, [problem.message], "Replace it")) return null;
      replace = there.now;
    }
  }
}

/** Takes one file after the other; what goes wrong with one is told when all have had their turn. */
export async function eachOf(files, act) {
  const wrong = [];
  for (const file of files) {
    try {
      await act(file);
    } catch (problem) {
      wrong.push(problem.message.startsWith(file.name) ? problem.message : `${file.name}: ${problem.message}`);
    }
  }
  if (wrong.length) throw new Error(wrong.join("; "));
}
