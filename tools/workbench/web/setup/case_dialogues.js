// SPDX-License-Identifier: GPL-3.0-or-later
// Asking for a new case, a fabric, a run.

import { ACCURACIES } from "workbench/page/accuracies.js";
import { dialogue } from "workbench/page/dialogue.js";
import { numberOf } from "workbench/setup/inputs.js";
import { fromCase } from "workbench/setup/references.js";
import { ask, send } from "workbench/page/server.js";

export async function newCase(folder, opened) {
  const examples = await ask("examples").catch(() => []);
  const froms = [["", "a small hemisphere: one ply, punch, die, holder"],
    ...(folder.cases || []).map(({ path, title }) => [path, `copy of ${path}${title ? ` (${title})` : ""}`]),
    ...examples.map(({ name, title }) => [`example:${name}`, `example: ${title || name} (${name})`])];
  dialogue("new-case", "New case", [{ name: "name", title: "Name", kind: "text", value: freeCase(folder), note:
    "letters, digits, _, - and .; it becomes a folder" }, { name: "from", title: "Start from", kind: "select",
      choices: froms }],
  "Make it", async ({ name, from }) => opened((await send("cases", { name, from })).path));
}

function freeCase(folder) {
  const taken = new Set((folder.cases || []).map(({ path }) => path.split("/")[0].replace(/\.toml$/, "")));
  for (let k = 1; ; ++k) if (!taken.has(`case${k}`)) return `case${k}`;
}

export function addFabric(work) {
  const fabrics = (work.folder.fabrics || []).map(({ path, name }) => [fromCase(work.main.path, path),
    `${path}${name ? ` (${name})` : ""}`]);
  if (!fabrics.length) throw new Error("There is no fabric file in the folder: drop one onto the page");
  dialogue("add-fabric", "Add a fabric", [{ name: "path", title: "File", kind: "select", choices: fabrics },
    { name: "name", title: "Name in this case", kind: "text", value: freeFabric(work.main.tree) }], "Add it",
  async ({ path, name }) => {
    await work.main.edit([{ op: "set", key: `fabrics.${name}`, value: path }]);
    work.choose(`fabrics.${name}`);
  });
}

export function freeFabric(tree, word = "fabric") {
  const taken = Object.keys(tree.fabrics || {});
  if (!taken.includes(word)) return word;
  for (let k = 2; ; ++k) if (!taken.includes(`${word}${k}`)) return `${word}${k}`;
}

export function askRun(path, count) {
  const numeric = (text, word) => {
    if (text === "") return undefined;
    const value = numberOf(text);
    if (Number.isNaN(value)) throw new Error(`${word}: ${text} is no number`);
    return value;
  };
  dialogue("ask-run", "Run the case", [
    { name: "name", title: "Name of the results", kind: "text", hint: "after the case",
      note: "letters, digits, _, - and .; a name that is free if you give none" },
    { name: "accuracy", title: "Accuracy", kind: "select", choices: ACCURACIES },
    { name: "threads", title: "Threads", kind: "number", hint: "all", note: "results do not depend on it" },
    { name: "budget", title: "Budget", kind: "number", unit: "s", hint: "none",
      note: "a run that would take longer is refused" },
    { name: "verify", title: "Verify", kind: "checkbox",
      note: "runs it again with coarser parameters, so that each figure gets a band; takes longer" },
  ], count ? "Run in spite of mistakes" : "Run", async ({ name, accuracy, threads, budget, verify }) => {
    const { about } = await send("runs", { case: path, name, accuracy, verify, threads: numeric(threads, "threads"),
      budget: numeric(budget, "budget") });
    location.hash = `#runs/${about.output}`;
  });
}
