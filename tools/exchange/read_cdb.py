# SPDX-License-Identifier: GPL-3.0-or-later
"""Shells of an Ansys archive (CDWRITE): ET, NBLOCK and EBLOCK, in the widths that the blocks state."""

import re
from collections.abc import Iterator
from pathlib import Path

from exchange.deck_lines import Deck, Line, lines_of, number, whole
from exchange.shell_mesh import ShellMesh

SHELLS = {28, 41, 43, 63, 91, 93, 99, 131, 132, 157, 181, 208, 209, 281}
OTHERS = {1, 4, 8, 10, 11, 13, 14, 21, 23, 24, 25, 27, 30, 33, 34, 37, 38, 39, 40, 44, 45, 46, 54,
          62, 65, 68, 70, 71, 87, 90, 92, 94, 95, 116, 122, 123, 147, 148, 151, 152, 153, 154, 156,
          159, 160, 161, 162, 164, 165, 166, 167, 168, 169, 170, 171, 172, 173, 174, 175, 176, 177,
          178, 179, 180, 182, 183, 184, 185, 186, 187, 188, 189, 190, 194, 195, 200, 201, 202, 203,
          204, 205, 212, 213, 214, 215, 216, 217, 218, 220, 221, 223, 225, 226, 227, 228, 230, 231,
          232, 233, 236, 237, 238, 239, 240, 241, 250, 251, 252, 257, 263, 264, 265, 272, 273, 278,
          279, 285, 288, 289, 290, 291, 292, 293}


def read_cdb(path: Path) -> ShellMesh:
    deck, types = Deck(path), {}
    lines = iter(lines_of(path))
    for line in lines:
        words = [word.strip() for word in line.text.split(",")]
        command = words[0].upper()
        if command == "ET" and len(words) >= 3:
            types[whole(line, words[1], "an element type")] = whole(
                line, re.sub(r"^[A-Za-z]+", "", words[2]), "an element")
        elif command == "NBLOCK":
            read_nodes(deck, line, lines)
        elif command == "EBLOCK":
            read_elements(deck, line, words, lines, types)
        elif command in ("N", "E", "EN", "NGEN", "EGEN"):
            raise line.wrong(f"{command} commands are not read: write the mesh with CDWRITE,DB, "
                             "which makes blocks")
    return deck.mesh()


def widths_of(lines: Iterator[Line], line: Line) -> tuple[int, int, int, Line]:
    """How many whole numbers stand first, their width, the width of the others."""
    form = next(lines, line)
    found = re.match(r"\s*\((\d+)i(\d+)(?:,\d*e(\d+)\.\d+(?:e\d+)?)?\)\s*$", form.text,
                     re.IGNORECASE)
    if not found:
        raise form.wrong(f"a block's widths are {form.text.strip()!r}: expected such as "
                         "(3i9,6e21.13e3) or (19i9)")
    return int(found[1]), int(found[2]), int(found[3] or 0), form


def read_nodes(deck: Deck, line: Line, lines: Iterator[Line]) -> None:
    heads, narrow, wide, form = widths_of(lines, line)
    if not wide:
        raise form.wrong("the widths of a block of nodes name no coordinates")
    for row in lines:
        text = row.text
        if text.strip().startswith(("N,", "-1")):
            return
        label = whole(row, text[:narrow], "a node's number")
        place = [text[heads * narrow + k * wide:heads * narrow + (k + 1) * wide] for k in range(3)]
        deck.add_node(row, label, tuple(number(row, part.strip() or "0", "a coordinate")
                                        for part in place))
    raise line.wrong("the block of nodes has no end: the file is cut off")


def read_elements(deck: Deck, line: Line, words: list[str], lines: Iterator[Line],
                  types: dict[int, int]) -> None:
    """With SOLID: material, type, real, section, system, birth and death, reference, shape, number
    of nodes, blank, element, nodes. Without: element, type, real, material, system, nodes."""
    solid = len(words) > 2 and words[2].upper() == "SOLID"
    _, width, _, _ = widths_of(lines, line)
    for row in lines:
        values = numbers(row, width)
        if values[:1] == [-1]:
            return
        if len(values) < (13 if solid else 8):
            raise row.wrong(f"an element has {len(values)} numbers, too few")
        if solid:
            kind, part, label = values[1], values[3], values[10]
            nodes = values[11:11 + values[8]]
            while len(nodes) < values[8]:
                nodes += numbers(next(lines, row), width)
        else:
            label, kind, part, nodes = values[0], values[1], values[2], values[5:]
        if kind not in types:
            raise row.wrong(f"element {label} is of type {kind}, which no ET line above defines")
        if types[kind] in OTHERS:
            deck.left_out[f"type {types[kind]}"] += 1
        elif types[kind] in SHELLS:
            deck.add_shell(row, label, nodes[:4], part)
        else:
            raise row.wrong(f"element {label} is of type {types[kind]}, which is not known: shells "
                            f"are {', '.join(map(str, sorted(SHELLS)))}; take other elements out "
                            "of the file, or write them as one of these")
    raise line.wrong("the block of elements has no end: the file is cut off")


def numbers(row: Line, width: int) -> list[int]:
    text = row.text.rstrip()
    return [whole(row, text[k:k + width], "a number of an element")
            for k in range(0, len(text), width)]
