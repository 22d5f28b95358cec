// SPDX-License-Identifier: GPL-3.0-or-later
// What a key may name: other items of the case, and files of the folder.

const FILES = { file: ["mesh", "stl"], outline_file: ["drawing"], fabric: ["toml"] };

const names = (list) => (Array.isArray(list) ? list : []).map((one) => one.name).filter(Boolean);

/** Names that the key of a pattern can be chosen from; null if it names nothing. */
export function namesFor(work, pattern, at) {
  const { tree } = work.main;
  const of = {
    "ply[].fabric": () => Object.keys(tree.fabrics || {}),
    "ply[].blank": () => Object.keys(tree.blanks || {}),
    "boundary[].ply": () => names(tree.ply),
    "load[].ply": () => names(tree.ply),
    "load[].between": () => names(tree.ply),
    "boundary[].carried_by": () => names((tree.tool || []).filter((tool) => tool.motion === "driven")),
    "contact.pair[].between": () => ["plies", "tools", ...names(tree.ply), ...names(tree.tool)],
    "fabrics.NAME.crossing[].families": () => names(familiesTable(at)),
  }[pattern];
  return of ? of() : null;
}

function familiesTable(at) {
  const tree = at.file.tree || {};
  if (at.prefix) return tree.family;
  const [, name] = at.key.split(".");
  return ((tree.fabrics || {})[name] || {}).family;
}

/** A path of the folder as a file of the case names it. */
export function fromCase(casePath, path) {
  const from = casePath.split("/").slice(0, -1);
  const to = path.split("/");
  let same = 0;
  while (same < from.length && same < to.length - 1 && from[same] === to[same]) ++same;
  return [...from.slice(same).map(() => ".."), ...to.slice(same)].join("/");
}

/** The path in the folder of one that a case names; null if it leads out. */
export function inFolder(casePath, name) {
  if (!name || name.startsWith("/")) return null;
  const parts = casePath.split("/").slice(0, -1);
  for (const part of name.split("/")) {
    if (part === "..") {
      if (!parts.length) return null;
      parts.pop();
    } else if (part !== "." && part !== "") {
      parts.push(part);
    }
  }
  return parts.join("/");
}

/** Files of the folder for a key, as the case names them. */
export function filesFor(work, name) {
  const kinds = FILES[name] || [];
  const { files = [], fabrics = [] } = work.folder || {};
  const paths = name === "fabric" ? fabrics.map((one) => one.path)
    : files.filter((one) => kinds.includes(one.kind)).map((one) => one.path);
  return paths.map((path) => fromCase(work.main.path, path));
}
