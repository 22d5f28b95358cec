# SPDX-License-Identifier: GPL-3.0-or-later
"""Shells of an Abaqus input file: *NODE, *ELEMENT, *INCLUDE; one part, not moved.

Python's meshio reads these files too, but leaves out the numbers of the elements, which the next
program asks for.
"""

import re
from collections.abc import Iterator
from pathlib import Path

from exchange.deck_lines import Deck, Line, included, lines_of, number, whole
from exchange.shell_mesh import ShellMesh

# corners, all nodes
SHELLS = {**dict.fromkeys(("S3", "S3R", "S3RS", "S3T", "S3RT", "STRI3", "R3D3", "M3D3", "DS3"),
                          (3, 3)),
          **dict.fromkeys(("S4", "S4R", "S4RS", "S4RSW", "S4R5", "S4T", "S4RT", "R3D4", "M3D4",
                           "M3D4R", "DS4"), (4, 4)),
          **dict.fromkeys(("STRI65", "M3D6", "DS6"), (3, 6)),
          **dict.fromkeys(("S8R", "S8R5", "S8RT", "M3D8", "M3D8R", "DS8"), (4, 8))}
OTHERS = re.compile(r"(C3D|CPE|CPS|CAX|CPEG|COH|SC[68]R|CSS8|DC|AC|B[23]|PIPE|FRAME|ELBOW|T[23]D|"
                    r"CONN|SPRING|DASHPOT|MASS|ROTARYI|HEATCAP|GAP|ITS|JOINT|SFM|SURF|RB|R2D|RAX|"
                    r"CCL|F[23]D|EC3D|PC3D)")


def read_inp(path: Path) -> ShellMesh:
    deck, parts = Deck(path), {}
    keyword, options, held, start = "", {}, [], None
    for line in decks(path, 0):
        text = line.text.strip()
        if text.startswith("*"):
            keyword, options = keyword_of(text)
            refuse(line, keyword, options, parts)
            if keyword == "ELEMENT":
                nodes_of(line, options)
            continue
        if keyword == "NODE":
            words = [word.strip() for word in text.split(",")]
            if len(words) < 4:
                raise line.wrong(f"a node has a number and three coordinates: {text!r}")
            deck.add_node(line, whole(line, words[0], "a node's number"),
                          tuple(number(line, word or "0", "a coordinate") for word in words[1:4]))
        elif keyword == "ELEMENT":
            start = start if held else line
            held += [word.strip() for word in text.rstrip(",").split(",")]
            if text.endswith(","):
                continue
            add_element(deck, start, held, options)
            held = []
    return deck.mesh()


def decks(path: Path, depth: int, lines: list[Line] | None = None) -> Iterator[Line]:
    for line in lines if lines is not None else lines_of(path):
        if line.text.startswith("**") or not line.text.strip():
            continue
        keyword, options = keyword_of(line.text) if line.text.startswith("*") else ("", {})
        if keyword == "INCLUDE":
            yield from decks(path, depth + 1, included(line, options.get("INPUT", ""), depth))
        else:
            yield line


def keyword_of(text: str) -> tuple[str, dict[str, str]]:
    words = [word.strip() for word in text.lstrip("* ").split(",")]
    options = [word.partition("=") for word in words[1:]]
    return (" ".join(words[0].upper().split()),
            {name.strip().upper(): value.strip() for name, _, value in options})


def nodes_of(line: Line, options: dict[str, str]) -> tuple[int, int] | None:
    """Corners and nodes of a shell, none of what is no shell. Raises Trouble for other types."""
    kind = options.get("TYPE", "").upper()
    if kind in SHELLS:
        return SHELLS[kind]
    if OTHERS.match(kind):
        return None
    raise line.wrong(f"element type {kind or 'missing'} is not known: shells are "
                     f"{', '.join(SHELLS)}; take other elements out of the file, or write them as "
                     "one of these")


def refuse(line: Line, keyword: str, options: dict[str, str], parts: dict[str, int]) -> None:
    if keyword in ("NGEN", "NCOPY", "NFILL", "NMAP", "ELGEN", "ELCOPY", "SYSTEM"):
        raise line.wrong(f"*{keyword} makes or moves nodes or elements: write the mesh as *NODE "
                         "and *ELEMENT (a flattened input file)")
    if keyword == "NODE" and options.get("SYSTEM", "R").upper() != "R":
        raise line.wrong("nodes in a cylindrical or spherical system: write them in x, y, z")
    if keyword in ("PART", "INSTANCE"):
        parts[keyword] = parts.get(keyword, 0) + 1
        if parts[keyword] > 1:
            raise line.wrong(f"a second *{keyword}: numbers are no longer unique; write the model "
                             "flat, without parts and instances, or only the part that is mapped on")


def add_element(deck: Deck, line: Line, words: list[str], options: dict[str, str]) -> None:
    counts = nodes_of(line, options)
    label = whole(line, words[0], "an element's number")
    if counts is None:
        deck.left_out[options["TYPE"].upper()] += 1
        return
    corners, nodes = counts
    if len(words) - 1 != nodes:
        raise line.wrong(f"element {label} has {len(words) - 1} nodes: {options['TYPE']} has "
                         f"{nodes}")
    ends = [whole(line, word, f"a node of element {label}") for word in words[1:corners + 1]]
    deck.add_shell(line, label, ends, 1)
