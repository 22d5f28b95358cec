# SPDX-License-Identifier: GPL-3.0-or-later
"""Shells of an Ansys archive (CDWRITE): ET, NBLOCK and EBLOCK, in the widths that the blocks state."""

import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from exchange.deck_lines import Fields, Line, number, texts_of, whole
from exchange.deck_mesh import Deck
from exchange.part_offsets import Offsets
from exchange.shell_mesh import ShellMesh

SHELLS = {28, 41, 43, 63, 91, 93, 99, 131, 132, 157, 181, 208, 209, 281}
OTHERS = {1, 4, 8, 10, 11, 13, 14, 21, 23, 24, 25, 27, 30, 33, 34, 37, 38, 39, 40, 44, 45, 46, 54,
          62, 65, 68, 70, 71, 87, 90, 92, 94, 95, 116, 122, 123, 147, 148, 151, 152, 153, 154, 156,
          159, 160, 161, 162, 164, 165, 166, 167, 168, 169, 170, 171, 172, 173, 174, 175, 176, 177,
          178, 179, 180, 182, 183, 184, 185, 186, 187, 188, 189, 190, 194, 195, 200, 201, 202, 203,
          204, 205, 212, 213, 214, 215, 216, 217, 218, 220, 221, 223, 225, 226, 227, 228, 230, 231,
          232, 233, 236, 237, 238, 239, 240, 241, 250, 251, 252, 257, 263, 264, 265, 272, 273, 278,
          279, 285, 288, 289, 290, 291, 292, 293}


@dataclass
class Archive:
    """The lines of a file, and what its blocks refer to."""
    deck: Deck
    texts: list[str]
    types: dict[int, int] = field(default_factory=dict)
    systems: int = 0  # elements with a coordinate system of their own

    def line(self, row: int) -> Line:
        return Line(self.deck.path, row + 1, self.texts[row] if row < len(self.texts) else "")

    def end_of(self, row: int, marks: tuple[str, ...], what: str) -> int:
        """The row that ends the block whose first line of data is at `row`."""
        for k in range(row, len(self.texts)):
            if self.texts[k].lstrip()[:2] in marks:
                return k
        raise self.line(row - 2).wrong(f"the block of {what} has no end: the file is cut off")


def read_cdb(path: Path) -> ShellMesh:
    archive, offsets, row = Archive(Deck(path), texts_of(path)), Offsets(), 0
    while row < len(archive.texts):
        line = archive.line(row)
        words = [word.strip() for word in line.text.split(",")]
        command = words[0].upper()
        row += 1
        if command == "ET" and len(words) >= 3:
            archive.types[whole(line, words[1], "an element type")] = whole(
                line, re.sub(r"^[A-Za-z]+", "", words[2]), "an element")
        elif command.startswith("SECO"):  # ..., TOP, or BOT, or USER with a number
            offsets.note("SECOFFSET", words[2] if words[1:2] == ["USER"] and len(words) > 2 else "".join(words[1:2]))
        elif command == "NBLOCK":
            row = read_nodes(archive, row)
        elif command == "EBLOCK":
            row = read_elements(archive, row, len(words) > 2 and words[2].upper() == "SOLID")
        elif command in ("N", "E", "EN", "NGEN", "EGEN"):
            raise line.wrong(f"{command} commands are not read: write the mesh with CDWRITE,DB, "
                             "which makes blocks")
    mesh = archive.deck.mesh()
    if archive.systems:
        mesh.notes.append(f"ESYS, the coordinate systems of {archive.systems} elements: not used")
    offsets.tell(mesh)
    return mesh


def widths_of(archive: Archive, row: int) -> tuple[int, int, int]:
    """How many whole numbers stand first, their width, the width of the others."""
    form = archive.line(row)
    found = re.match(r"\s*\((\d{1,3})i(\d{1,3})(?:,\d*e(\d{1,3})\.\d+(?:e\d+)?)?\)\s*$", form.text,
                     re.IGNORECASE)
    if not found or int(found[2]) == 0:
        raise form.wrong(f"a block's widths are {form.text.strip()[:60]!r}: expected such as "
                         "(3i9,6e21.13e3) or (19i9)")
    return int(found[1]), int(found[2]), int(found[3] or 0)


def read_nodes(archive: Archive, row: int) -> int:
    heads, narrow, wide = widths_of(archive, row)
    if not wide:
        raise archive.line(row).wrong("the widths of a block of nodes name no coordinates")
    last = archive.end_of(row + 1, ("N,", "n,", "-1"), "nodes")
    texts, lines = archive.texts[row + 1:last], np.arange(row + 2, last + 1)
    if not texts:
        return last + 1
    first = heads * narrow
    spans = [(first + k * wide, first + (k + 1) * wide) for k in range(3)]
    try:
        fields = Fields(texts, spans[-1][1])
        labels, places = fields.whole(0, narrow), np.column_stack([fields.number(*at) for at in spans])
    except ValueError:
        labels, places = [], []
        for k, text in enumerate(texts, row + 1):
            labels.append(whole(archive.line(k), text[:narrow], "a node's number"))
            places.append([number(archive.line(k), text[a:b].strip() or "0", "a coordinate")
                           for a, b in spans])
    archive.deck.add_nodes(archive.deck.path, lines, labels, places)
    return last + 1


def read_elements(archive: Archive, row: int, solid: bool) -> int:
    """With SOLID: material, type, real, section, system, birth and death, reference, shape, number
    of nodes, blank, element, nodes. Without: element, type, real, material, system, nodes."""
    _, width, _ = widths_of(archive, row)
    last = archive.end_of(row + 1, ("-1",), "elements")
    table = all_alike(archive.texts[row + 1:last], width, solid)
    if table is not None:
        add(archive, np.arange(row + 1, last), table)
        return last + 1
    k, rows, made = row + 1, [], []
    while k < last:
        line, values = archive.line(k), numbers(archive.line(k), width)
        if len(values) < (13 if solid else 8):
            raise line.wrong(f"an element has {len(values)} numbers, too few")
        rows.append(k)
        if solid:
            kind, part, system, label, nodes = values[1], values[3], values[4], values[10], values[11:]
            while len(nodes) < values[8] and k + 1 < last:
                k += 1
                nodes += numbers(archive.line(k), width)
            nodes = nodes[:max(values[8], 0)]
        else:
            label, kind, part, system, nodes = *values[:3], values[4], values[5:]
        made.append([label, kind, part, system, *(nodes + [0] * 8)[:8]])
        k += 1
    add(archive, np.array(rows, int), np.array(made, np.int64).reshape(-1, 12))
    return last + 1


def all_alike(texts: list[str], width: int, solid: bool) -> np.ndarray | None:
    """m x 12: element, type, part, system, nodes; none unless each line is an element of as many
    nodes."""
    if not texts:
        return None
    size = len(texts[0].rstrip())
    count, odd = divmod(size, width)
    most = 19 if solid else 13
    if odd or not (14 if solid else 8) <= count <= most or any(len(t.rstrip()) != size for t in texts):
        return None
    try:
        fields = Fields(texts, size)
        values = [fields.whole(k * width, (k + 1) * width) for k in range(count)]
    except ValueError:
        return None
    if solid and (values[8] != count - 11).any():
        return None
    heads = [10, 1, 3, 4] if solid else [0, 1, 2, 4]
    nodes = values[11:] if solid else values[5:]
    empty = np.zeros(len(texts), np.int64)
    return np.column_stack([*(values[k] for k in heads), *nodes, *[empty] * (8 - len(nodes))])


def add(archive: Archive, rows: np.ndarray, table: np.ndarray) -> None:
    """Elements (m x 12) by their types. Raises Trouble for types that are not known."""
    types, back = np.unique(table[:, 1], return_inverse=True)
    for k, kind in enumerate(types.tolist()):
        here = back.ravel() == k
        first, label = archive.line(rows[here][0]), table[here][0, 0]
        if kind not in archive.types:
            raise first.wrong(f"element {label} is of type {kind}, which no ET line above defines")
        element = archive.types[kind]
        if element in OTHERS:
            archive.deck.left_out[f"type {element}"] += int(here.sum())
        elif element in SHELLS:
            ends = table[here][:, 4:]
            ends[ends[:, 3] == 0, 7] = 0
            archive.systems += int((table[here][:, 3] != 0).sum())
            archive.deck.add_shells(archive.deck.path, rows[here] + 1, table[here][:, 0],
                                    table[here][:, 2], ends)
        else:
            raise first.wrong(f"element {label} is of type {element}, which is not known: shells "
                              f"are {', '.join(map(str, sorted(SHELLS)))}; take other elements out "
                              "of the file, or write them as one of these")


def numbers(row: Line, width: int) -> list[int]:
    text = row.text.rstrip()
    return [whole(row, text[k:k + width], "a number of an element")
            for k in range(0, len(text), width)]
