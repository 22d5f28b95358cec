# SPDX-License-Identifier: GPL-3.0-or-later
"""Shells of a Nastran or OptiStruct bulk data file: GRID, CQUAD4, CTRIA3 and their kin, INCLUDE;
small and large fields, and fields with commas.

Python's meshio reads these files too, but leaves out the numbers of the elements, which the next
program asks for.
"""

import re
from collections.abc import Iterator
from pathlib import Path

from exchange.deck_lines import Deck, Line, included, lines_of, number, whole
from exchange.shell_mesh import ShellMesh

CORNERS = {"CTRIA3": 3, "CTRIAR": 3, "CTRIA6": 3, "CQUAD4": 4, "CQUADR": 4, "CQUAD8": 4, "CQUAD": 4}
# entries that begin with C and are elements, but no shells
OTHERS = {"CHEXA", "CPENTA", "CTETRA", "CPYRA", "CPYRAM", "CBAR", "CBEAM", "CBEAM3", "CBEND",
          "CROD", "CONROD", "CTUBE", "CBUSH", "CBUSH1D", "CELAS1", "CELAS2", "CELAS3", "CELAS4",
          "CDAMP1", "CDAMP2", "CDAMP3", "CDAMP4", "CDAMP5", "CMASS1", "CMASS2", "CMASS3", "CMASS4",
          "CONM1", "CONM2", "CGAP", "CVISC", "CWELD", "CFAST", "CSEAM", "CSHEAR", "CRAC2D",
          "CRAC3D", "CTRIAX", "CTRIAX6", "CQUADX", "CQUADX4", "CQUADX8", "CAABSF", "CHBDYE",
          "CHBDYG", "CHBDYP", "CTAXI", "CGASK6", "CGASK8", "CGASK12", "CGASK16"}
NO_ELEMENTS = re.compile(r"(CORD|CELL|CSET|CSUP|CTRL|CNVR|CYJOIN|CYSYM|CYAX|CYSUP|CLOAD|CONV|"
                         r"CONTAC|CREEP|CONTRL|CAERO|CASECC|CONCTL|CSCHD|CSSCHD|CDADD|CONROT)")


def read_bdf(path: Path) -> ShellMesh:
    deck = Deck(path)
    for line, fields in entries(list(cards(path, 0))):
        name = fields[0].rstrip("*").upper()
        if name == "GRID":
            add_grid(deck, line, fields)
        elif name in CORNERS:
            label = whole(line, fields[1], "an element's number")
            part = whole(line, fields[2] or str(label), f"the property of element {label}")
            ends = [whole(line, word or "0", f"a corner of element {label}")
                    for word in fields[3:3 + CORNERS[name]]]
            deck.add_shell(line, label, ends, part)
        elif name in OTHERS:
            deck.left_out[name] += 1
        elif re.match(r"C[A-Z]+\d*$", name) and not NO_ELEMENTS.match(name):
            raise line.wrong(f"element type {name} is not known: shells are {', '.join(CORNERS)}; "
                             "take other elements out of the file, or write them as one of these")
    return deck.mesh()


def add_grid(deck: Deck, line: Line, fields: list[str]) -> None:
    label = whole(line, fields[1], "a grid point's number")
    if fields[2] and whole(line, fields[2], f"the system of grid point {label}") != 0:
        raise line.wrong(f"grid point {label} stands in coordinate system {fields[2]}: write grid "
                         "points in the basic system")
    deck.add_node(line, label, tuple(number(line, word or "0", f"a coordinate of grid point {label}")
                                     for word in fields[3:6]))


def cards(path: Path, depth: int, lines: list[Line] | None = None) -> Iterator[Line]:
    """Lines of bulk data: those of executive and case control, before BEGIN BULK, are left out."""
    lines = lines if lines is not None else lines_of(path)
    begin = next((k for k, line in enumerate(lines)
                  if re.match(r"\s*BEGIN\s+BULK", line.text, re.IGNORECASE)), -1)
    for line in lines[begin + 1:]:
        text = line.text.split("$", 1)[0].rstrip()
        if not text:
            continue
        if text.upper().startswith("ENDDATA"):
            return
        name = re.match(r"INCLUDE\s*(.+)", text, re.IGNORECASE)
        if name:
            yield from cards(path, depth + 1, included(line, name[1], depth))
        else:
            yield Line(line.path, line.number, text)


def entries(lines: list[Line]) -> Iterator[tuple[Line, list[str]]]:
    """Fields of each entry, with those of its continuations; at least nine."""
    held, first = [], None
    for line in lines:
        words = fields_of(line)
        if words[0][:1] in ("", "+", "*") and held:
            held += words[1:]
            continue
        if held:
            yield first, held + [""] * (9 - len(held))
        held, first = words, line
    if held:
        yield first, held + [""] * (9 - len(held))


def fields_of(line: Line) -> list[str]:
    """Name and eight fields (four of large ones); the tenth, which names continuations, is left
    out."""
    text = line.text.expandtabs(8)
    if "," in text:
        words = [word.strip() for word in text.split(",")]
        large = words[0].endswith("*")
        return (words + [""] * 9)[:5 if large else 9]
    name = text[:8].strip()
    width, count = (16, 4) if name.endswith("*") or name.startswith("*") else (8, 8)
    return [name, *(text[8 + k * width:8 + (k + 1) * width].strip() for k in range(count))]
