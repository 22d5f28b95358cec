# SPDX-License-Identifier: GPL-3.0-or-later
"""Shells of an Abaqus, CalculiX or gmsh input file: *NODE, *ELEMENT, *INCLUDE, and the *ORIENTATION of
shell sections; one part, not moved.

Python's meshio reads these files too, but leaves out the numbers of the elements, which the next
program asks for.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from exchange.deck_lines import Line, are_whole, by_commas, included, number, texts_of, whole
from exchange.deck_mesh import Deck
from exchange.inp_axes import SECTIONS, Sections
from exchange.part_offsets import Offsets
from exchange.shell_mesh import ShellMesh

# shells, heat shells, membranes, rigid ones, and plane elements, which meshers write for surfaces
SHELLS = re.compile(r"(?:S|DS|M3D|R3D|CPS|CPE|US)([34689])(?:R|RS|RSW|R5|RT|T|M|H|MH|RH|RP|P|PH|E|I|IH|"
                    r"HT|RHT)?$|(STRI)(3|65)$")
OTHERS = re.compile(r"(C3D|CAX|CPEG|COH|SC[68]R|CSS8|DC|AC|B[23]|PIPE|FRAME|ELBOW|T[23]D|"
                    r"CONN|SPRING|DASHPOT|MASS|ROTARYI|HEATCAP|GAP|ITS|JOINT|SFM|SURF|RB|R2D|RAX|"
                    r"CCL|F[23]D|EC3D|PC3D|D$|DCOUP|NETWORK)")


@dataclass
class Block:
    """A keyword and the lines of data below it."""
    head: Line
    keyword: str
    options: dict[str, str]
    lines: list[int] = field(default_factory=list)
    texts: list[str] = field(default_factory=list)

    def each(self) -> Iterator[Line]:
        return (Line(self.head.path, at, text) for at, text in zip(self.lines, self.texts))


def read_inp(path: Path) -> ShellMesh:
    deck, parts, sections, offsets = Deck(path), {}, Sections(), Offsets()
    for block in blocks_of(path, 0, path.parent):
        refuse(block, parts)
        if block.keyword == "NODE":
            add_nodes(deck, block)
        elif block.keyword == "ELEMENT":
            add_elements(deck, block, sections)
        else:
            sections.note(block)
            if block.keyword in SECTIONS:
                offsets.note(f"OFFSET of *{block.keyword}", block.options.get("OFFSET", ""))
    mesh = deck.mesh()
    sections.give_axes(mesh)
    offsets.tell(mesh)
    return mesh


def blocks_of(path: Path, depth: int, beside: Path) -> Iterator[Block]:
    texts = texts_of(path)
    heads = [k for k, text in enumerate(texts) if text[:1] == "*" and text[:2] != "**"]
    for at, after in zip(heads, [*heads[1:], len(texts)]):
        first, text = at + 1, texts[at].rstrip()
        while text.endswith(",") and first < after:  # options go on
            text, first = text + texts[first].strip(), first + 1
        keyword, options = keyword_of(text)
        head = Line(path, at + 1, text)
        if keyword == "INCLUDE":
            yield from blocks_of(included(head, options.get("INPUT", ""), depth, beside), depth + 1,
                                 beside)
            continue
        rows = [k for k in range(first, after) if texts[k][:2] != "**" and texts[k].strip()]
        yield Block(head, keyword, options, [k + 1 for k in rows], [texts[k] for k in rows])


def keyword_of(text: str) -> tuple[str, dict[str, str]]:
    words = [word.strip() for word in text.lstrip("* ").split(",")]
    options = [word.partition("=") for word in words[1:]]
    return (" ".join(words[0].upper().split()),
            {name.strip().upper(): value.strip().strip('"') for name, _, value in options})


def refuse(block: Block, parts: dict[str, int]) -> None:
    keyword, line = block.keyword, block.head
    if keyword in ("NGEN", "NCOPY", "NFILL", "NMAP", "ELGEN", "ELCOPY", "SYSTEM"):
        raise line.wrong(f"*{keyword} makes or moves nodes or elements: write the mesh as *NODE "
                         "and *ELEMENT (a flattened input file)")
    if keyword == "NODE" and block.options.get("SYSTEM", "R").upper() != "R":
        raise line.wrong("nodes in a cylindrical or spherical system: write them in x, y, z")
    if keyword in ("PART", "INSTANCE"):
        parts[keyword] = parts.get(keyword, 0) + 1
        if parts[keyword] > 1:
            raise line.wrong(f"a second *{keyword}: numbers are no longer unique; write the model "
                             "flat, without parts and instances, or only the part that is mapped on")
    if keyword == "INSTANCE":
        for row in block.each():
            words = [word.strip() for word in row.text.split(",")]
            if any(number(row, word or "0", "a shift of the instance") for word in words):
                raise row.wrong("the instance is moved or turned: write the model flat, without "
                                "parts and instances, or map onto the part and give --move and --turn")


def add_nodes(deck: Deck, block: Block) -> None:
    if not block.texts:
        return
    table = by_commas(block.texts)
    if table is not None and table.shape[1] >= 4 and are_whole(table[:, 0]):
        deck.add_nodes(block.head.path, block.lines, table[:, 0], table[:, 1:4])
        return
    labels, places = [], []
    for line in block.each():
        words = [word.strip() for word in line.text.split(",")]
        if len(words) < 2:
            raise line.wrong(f"a node has a number and three coordinates: {line.text.strip()[:60]!r}")
        words += ["0"] * (4 - len(words))
        labels.append(whole(line, words[0], "a node's number"))
        places.append([number(line, word or "0", "a coordinate") for word in words[1:4]])
    deck.add_nodes(block.head.path, block.lines, labels, places)


def nodes_of(line: Line, kind: str) -> tuple[int, int] | None:
    """Corners and nodes of a shell, none of what is no shell. Raises Trouble for other types."""
    found = SHELLS.match(kind)
    if found:
        count = 6 if found[3] == "65" else int(found[1] or found[3])
        return (3 if count in (3, 6) else 4), count
    if OTHERS.match(kind):
        return None
    raise line.wrong(f"element type {kind[:20] or 'missing'} is not known: shells are S3, S4R, S6, S8, "
                     "S8R, STRI65, M3D, R3D, CPS, CPE and their kin; take other elements out of the "
                     "file, or write them as one of these")


def add_elements(deck: Deck, block: Block, sections: Sections) -> None:
    kind = block.options.get("TYPE", "").upper()
    counts = nodes_of(block.head, kind)
    if counts is None:
        deck.left_out[kind] += len(block.texts)
        return
    corners, nodes = counts
    table = by_commas(block.texts) if block.texts else None
    if table is not None and table.shape[1] == nodes + 1 and are_whole(table):
        lines, table = block.lines, table.astype(np.int64)
    else:
        lines, table = one_by_one(block, kind, nodes)
    ends = np.zeros((len(table), 8), np.int64)
    ends[:, :corners] = table[:, 1:corners + 1]
    middles = min(nodes, 2 * corners) - corners  # a ninth node is in the middle of the element
    ends[:, 4:4 + middles] = table[:, corners + 1:corners + 1 + middles]
    deck.add_shells(block.head.path, lines, table[:, 0], np.ones(len(table)), ends)
    if "ELSET" in block.options:
        sections.add_to_set(block.options["ELSET"], table[:, 0])


def one_by_one(block: Block, kind: str, nodes: int) -> tuple[list[int], np.ndarray]:
    held, start, lines, table = [], None, [], []
    for line in block.each():
        text = line.text.strip()
        start = start if held else line
        held += [word.strip() for word in text.rstrip(",").split(",")]
        if text.endswith(",") and len(held) <= nodes:
            continue
        label = whole(start, held[0], "an element's number")
        if len(held) - 1 != nodes:
            raise start.wrong(f"element {label} has {len(held) - 1} nodes: {kind} has {nodes}")
        table.append([label, *(whole(start, word, f"a node of element {label}")
                               for word in held[1:])])
        lines.append(start.number)
        held = []
    if held:
        raise start.wrong(f"element {held[0][:20]} has {len(held) - 1} nodes: {kind} has {nodes}")
    return lines, np.array(table, np.int64).reshape(-1, nodes + 1)
