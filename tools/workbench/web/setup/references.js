// SPDX-License-Identifier: GPL-3.0-or-later
// What a key may name: other items of the case, and files of the folder.

const FILES = { file: ["mesh", "stl"], outline_file: ["drawing"], fabric: ["toml"] };

const names = (list) => (Array.isArray(list) ? list : []).map((one) => one.name).filter(Boolean);

const namesOf = (part) => (Array.isArray(part) ? names(part) : Object.keys(part || {}));

/** Names that a key can be chosen from, by what its row says that it refers to; null if it names nothing. */
export function namesFor(work, row, at) {
  const refers = row.refers || [];
  if (!refers.length) return null;
  const found = refers.flatMap((pattern) => namesOf(partOf(work, pattern, at)));
  return [...(row.choices || []), ...found];
}

/** The list or table of a pattern. NAME is that of the key which refers; a fabric's file has what is below. */
function partOf(work, pattern, at) {
  const words = pattern.split(".");
  const ofFile = words[0] === "fabrics" && words.length > 2 && (at.prefix || work.ofFabric);
  const way = at.key.split(".");
  return (ofFile ? words.slice(2) : words.map((word, k) => (word === "NAME" ? way[k] : word)))
    .reduce((part, word) => (part || {})[word], ofFile ? at.file.tree : work.main.tree);
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
