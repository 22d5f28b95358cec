# SPDX-License-Identifier: GPL-3.0-or-later
"""Shells of an LS-DYNA keyword file: *NODE, *ELEMENT_SHELL with its options.

After an element's first card come, with THICKNESS, BETA or MCID, a card with thicknesses at its corners
and with BETA or MCID in its fifth field; one more with those at the nodes N5 to N8 if the first card has
any of them but zeros; one with OFFSET; one with DOF; with COMPOSITE as many as there are plies.
"""

from pathlib import Path

import numpy as np

from exchange.deck_lines import Fields, Line, are_whole, number, numbers_of, whole
from exchange.deck_mesh import Deck
from exchange.k_axes import Axes
from exchange.keyword_file import Cards, blocks_of
from exchange.part_offsets import Offsets
from exchange.shell_mesh import ShellMesh

OTHERS = ("SOLID", "BEAM", "TSHELL", "DISCRETE", "MASS", "INERTIA", "SEATBELT", "SPH", "PLOTEL",
          "TRIM", "LANCING", "GENERALIZED", "INTERPOLATION", "BEARING", "BLANKING", "DIRECT", "RIGID")
THICK = {"THICKNESS", "BETA", "MCID"}
OPTIONS = [*sorted(THICK), "OFFSET", "DOF", "COMPOSITE"]
NO_CARDS = {"LONG", "ID", "TITLE", "TO", "SHL4", "SHL8"}
ELEMENT = [8] * 10
CORNERS = 6  # fields of an element's first card: number, part, four corners


def read_k(path: Path) -> ShellMesh:
    deck, axes, offsets = Deck(path), Axes(), Offsets()
    for block in blocks_of(path):
        if block.keyword == "NODE":
            add_nodes(deck, block)
        elif block.keyword.startswith("ELEMENT_"):
            add_elements(deck, block, axes, offsets)
        elif block.keyword.startswith("SECTION_SHELL"):
            note_faces(block, offsets)
        else:
            axes.note(block)
    mesh = deck.mesh()
    axes.give(mesh)
    offsets.tell(mesh)
    return mesh


def note_faces(block: Cards, offsets: Offsets) -> None:
    """NLOC, the fifth field of a section's second card: the face that the nodes are on."""
    first = 1 if block.keyword.endswith("_TITLE") else 0
    if first + 1 < len(block.texts):
        offsets.note("NLOC of *SECTION_SHELL", block.words(first + 1, block.widths(ELEMENT))[4])


def add_nodes(deck: Deck, block: Cards) -> None:
    widths, rows = block.widths([8, 16, 16, 16]), range(len(block.texts))
    ends = np.cumsum(widths)
    commas = np.array(["," in text for text in block.texts], bool)
    if not commas.any() and len(block.texts):
        fields = Fields(block.texts, int(ends[-1]))
        try:
            label = fields.whole(0, ends[0])
            places = np.column_stack([fields.number(a, b) for a, b in zip(ends, ends[1:])])
            deck.add_nodes(block.head.path, block.lines, label, places)
            return
        except ValueError:
            pass
    elif commas.all() and len(block.texts) and add_by_commas(deck, block):
        return
    labels, places = [], []
    for row in rows:
        line, words = block.line(row), block.words(row, widths)
        labels.append(whole(line, words[0], "a node's number"))
        places.append([number(line, word or "0", "a coordinate") for word in words[1:4]])
    deck.add_nodes(block.head.path, block.lines, labels, places)


def add_by_commas(deck: Deck, block: Cards) -> bool:
    four = [",".join(text.split(",", 4)[:4]) for text in block.texts]
    if any(text.count(",") != 3 for text in four):
        return False
    table = numbers_of(",".join(four), ",", (len(four), 4))
    if table is None or not are_whole(table[:, 0]):
        return False
    deck.add_nodes(block.head.path, block.lines, table[:, 0], table[:, 1:])
    return True


def add_elements(deck: Deck, block: Cards, axes: Axes, offsets: Offsets) -> None:
    options = options_of(block.head, block.keyword)
    if options is None:
        deck.left_out[block.keyword] += len(block.texts)
        return
    if not options - NO_CARDS and add_all_at_once(deck, block):
        return
    widths, row = block.widths(ELEMENT), 0
    labels, parts, table, lines = [], [], [], []
    seen: set[int] = set()
    while row < len(block.texts):
        line, words = block.line(row), block.words(row, widths)
        row += 1
        if "COMPOSITE" in options and not is_element(words, seen):
            continue
        label = whole(line, words[0], "an element's number")
        parts.append(whole(line, words[1] or "0", f"the part of element {label}"))
        ends = [whole(line, word or "0", f"a node of element {label}") for word in words[2:10]]
        table.append(in_order(ends))
        labels.append(label)
        lines.append(line.number)
        seen.add(label)
        if "COMPOSITE" in options:
            continue
        if options & THICK:
            axes.of_card(block, row, label, options)
            row += 2 if any(ends[4:]) else 1
        if "OFFSET" in options and row < len(block.texts):
            offsets.note("OFFSET of *ELEMENT_SHELL", block.words(row, [16])[0])
        row += ("OFFSET" in options) + ("DOF" in options)
    if row > len(block.texts):
        raise block.line(len(block.texts) - 1).wrong(
            f"the cards of element {labels[-1]} are cut off: *{block.keyword} has more of them")
    deck.add_shells(block.head.path, lines, labels, parts, table)


def options_of(line: Line, keyword: str) -> set[str] | None:
    """Of *ELEMENT_SHELL_...; none of elements that are no shells. Raises Trouble for those that are not
    known."""
    kind, *options = keyword.split("_")[1:]
    if kind in OTHERS:
        return None
    if kind != "SHELL" or set(options) - {*OPTIONS, *NO_CARDS}:
        raise line.wrong(f"*{keyword[:60]} is not known: shells are *ELEMENT_SHELL with "
                         f"{', '.join(OPTIONS)}; take other elements out of the file, or write them "
                         "as one of these")
    return set(options)


def in_order(ends: list[int]) -> list[int]:
    """Corners and middles of N1 to N8: a triangle has its third corner as its fourth, and with middles
    four of them, or three."""
    corners, middles = ends[:4], ends[4:]
    if corners[3] == 0:
        middles = [*middles[:3], 0]
    return corners + middles


def add_all_at_once(deck: Deck, block: Cards) -> bool:
    """Elements of one card each."""
    texts = block.texts
    if not texts:
        return True
    if all("," in text for text in texts):
        counts = {text.rstrip(", ").count(",") for text in texts}
        if len(counts) != 1 or not 4 <= min(counts) <= 9:
            return False
        shape = (len(texts), min(counts) + 1)
        table = numbers_of(",".join([text.rstrip(", ") for text in texts]), ",", shape)
        if table is None or not are_whole(table):
            return False
    elif any("," in text for text in texts):
        return False
    else:
        ends = np.cumsum([0, *block.widths(ELEMENT)])
        fields = Fields(texts, int(ends[-1]))
        try:
            table = np.column_stack([fields.whole(a, b) for a, b in zip(ends, ends[1:])])
        except ValueError:
            return False
    table = np.pad(table, ((0, 0), (0, 10 - table.shape[1]))).astype(np.int64)
    nodes = table[:, 2:]
    nodes[nodes[:, 3] == 0, 7] = 0
    deck.add_shells(block.head.path, block.lines, table[:, 0], table[:, 1], nodes)
    return True


def is_element(words: list[str], seen: set[int]) -> bool:
    """Tells an element's card from the plies below it, whose fields are wider: number, part and three
    corners, whole and without gaps, and new in the file."""
    return (all(word.lstrip("+-").isdigit() for word in words[:5])
            and all(word.lstrip("+-").isdigit() for word in words[5:CORNERS] if word)
            and int(words[0]) not in seen)
