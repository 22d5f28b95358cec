# SPDX-License-Identifier: GPL-3.0-or-later
"""Shells of a Nastran or OptiStruct bulk data file: GRID, CQUAD4, CTRIA3 and their kin, their THETA or
MCID.

Python's meshio reads these files too, but leaves out the numbers of the elements, which the next
program asks for.
"""

import re
from pathlib import Path

import numpy as np

from plotting.reading import Trouble

from exchange.bdf_axes import give_axes
from exchange.bulk_data import Entries, entries_of
from exchange.deck_lines import Fields, bounded, mended, number, whole
from exchange.deck_mesh import Deck
from exchange.part_offsets import Offsets
from exchange.shell_mesh import ShellMesh

# corners, all nodes; THETA or MCID stands in the field after the nodes, but in that of CQUAD8 four
# thicknesses stand between
SHELLS = {"CTRIA3": (3, 3), "CTRIAR": (3, 3), "CTRIA6": (3, 6), "CQUAD4": (4, 4), "CQUADR": (4, 4),
          "CQUAD8": (4, 8), "CQUAD": (4, 9)}
THETA = {name: 3 + nodes + (4 if name == "CQUAD8" else 0) for name, (_, nodes) in SHELLS.items()}
# fields of properties with the laminate's place over the nodes; elements have ZOFFS behind THETA. OptiStruct's
# PSHELL has one; PCOMP's bottom is half of the thickness below the nodes where Z0 is blank
OFFSETS = {"PSHELL": ("ZOFFS", 13), "PCOMP": ("Z0", 2), "PCOMPG": ("Z0", 2), "PCOMPP": ("Z0", 2)}
# entries that begin with C and are elements, but no shells
OTHERS = {"CHEXA", "CPENTA", "CTETRA", "CPYRA", "CPYRAM", "CBAR", "CBEAM", "CBEAM3", "CBEND",
          "CROD", "CONROD", "CTUBE", "CBUSH", "CBUSH1D", "CBUSH2D", "CELAS1", "CELAS2", "CELAS3",
          "CELAS4", "CDAMP1", "CDAMP2", "CDAMP3", "CDAMP4", "CDAMP5", "CMASS1", "CMASS2", "CMASS3",
          "CMASS4", "CONM1", "CONM2", "CGAP", "CVISC", "CWELD", "CFAST", "CSEAM", "CSHEAR", "CRAC2D",
          "CRAC3D", "CTRIAX", "CTRIAX6", "CQUADX", "CQUADX4", "CQUADX8", "CAABSF", "CHBDYE",
          "CHBDYG", "CHBDYP", "CTAXI", "CQAXI", "CGASK6", "CGASK8", "CGASK12", "CGASK16"}
NO_ELEMENTS = re.compile(r"(CORD|CELL|CSET|CSUP|CTRL|CNVR|CYJOIN|CYSYM|CYAX|CYSUP|CLOAD|CONV|"
                         r"CONTAC|CREEP|CONTRL|CAERO|CASECC|CONCTL|CSCHD|CSSCHD|CDADD|CONROT)")


def read_bdf(path: Path) -> ShellMesh:
    deck, axes, offsets, files = Deck(path), {}, Offsets(), entries_of(path)
    for entries in files:
        for name, some in entries.items():
            if name == "GRID":
                add_grids(deck, some)
            elif name == "GRDSET":
                expect_basic(some)
            elif name in SHELLS:
                add_shells(deck, some, name, axes, offsets)
            elif name in OFFSETS:
                for _, fields in some.each():
                    offsets.note(f"{OFFSETS[name][0]} of {name}", "".join(fields[OFFSETS[name][1]:][:1]))
            elif name in OTHERS:
                deck.left_out[name] += len(some.lines)
            elif re.match(r"C[A-Z]+\d*$", name) and not NO_ELEMENTS.match(name):
                raise some.line(0).wrong(f"element type {name} is not known: shells are "
                                         f"{', '.join(SHELLS)}; take other elements out of the "
                                         "file, or write them as one of these")
    mesh = deck.mesh()
    give_axes(mesh, axes, files)
    offsets.tell(mesh)
    return mesh


def expect_basic(entries: Entries) -> None:
    for line, fields in entries.each():
        if fields[2] not in ("", "0"):
            raise line.wrong(f"GRDSET puts grid points into coordinate system {fields[2]}: write "
                             "them in the basic system")


def add_grids(deck: Deck, entries: Entries) -> None:
    """Lines of small fields without continuation, and of large ones with one, all at once."""
    every = range(len(entries.lines))
    texts, more = entries.texts, entries.more
    small = [k for k in every if "," not in texts[k] and "*" not in texts[k][:8] and "\t" not in texts[k]
             and k not in more]
    large = [k for k in every if "*" in texts[k][:8] and "," not in texts[k] and "\t" not in texts[k]
             and len(more.get(k, ())) == 1 and "," not in more[k][0] and "\t" not in more[k][0]]
    done = np.zeros(len(texts), bool)
    for rows, lines, width in ((small, [texts[k] for k in small], 8),
                               (large, [texts[k][:72].ljust(72) + more[k][0][8:24] for k in large], 16)):
        if rows:
            done[rows] = add_columns(deck, entries, rows, lines, width)
    labels, places, lines = [], [], []
    for row in np.flatnonzero(~done):
        line, fields = entries.line(row), entries.fields(row)
        label = whole(line, fields[1], "a grid point's number")
        if fields[2] and whole(line, fields[2], f"the system of grid point {label}") != 0:
            raise line.wrong(f"grid point {label} stands in coordinate system {fields[2]}: write grid "
                             "points in the basic system")
        labels.append(label)
        places.append([number(line, word or "0", f"a coordinate of grid point {label}")
                       for word in fields[3:6]])
        lines.append(line.number)
    deck.add_nodes(entries.path, lines, labels, places)


def add_columns(deck: Deck, entries: Entries, rows: list[int], texts: list[str], width: int) -> bool:
    fields = Fields(texts, 8 + 5 * width)
    try:
        label, system = (fields.whole(8 + k * width, 8 + (k + 1) * width) for k in (0, 1))
        places = np.column_stack([fields.number(8 + k * width, 8 + (k + 1) * width)
                                  for k in (2, 3, 4)])
    except ValueError:
        return False
    if system.any() or (label <= 0).any():
        return False
    deck.add_nodes(entries.path, np.array(entries.lines)[rows], label, places)
    return True


def add_shells(deck: Deck, entries: Entries, name: str, axes: dict[int, float | int | str],
               offsets: Offsets) -> None:
    """`axes` gets the words of THETA or MCID by the number of the element."""
    corners, nodes = SHELLS[name]
    if nodes == corners and not entries.more and add_short(deck, entries, name, axes, offsets):
        return
    labels, parts, table, lines = [], [], [], []
    for line, fields in entries.each():
        label = whole(line, fields[1], "an element's number")
        fields += [""] * (THETA[name] + 2 - len(fields))
        offsets.note(f"ZOFFS of {name}", fields[THETA[name] + 1])
        ends = [whole(line, word or "0", f"a node of element {label}")
                for word in fields[3:3 + nodes]]
        middles = ends[corners:2 * corners]
        table.append(ends[:corners] + [0] * (4 - corners) + middles + [0] * (4 - len(middles)))
        labels.append(label)
        parts.append(whole(line, fields[2] or str(label), f"the property of element {label}"))
        lines.append(line.number)
        if fields[THETA[name]]:
            axes[label] = angle_or_system(line, fields[THETA[name]], label)
    deck.add_shells(entries.path, lines, labels, parts, table)


def add_short(deck: Deck, entries: Entries, name: str, axes: dict, offsets: Offsets) -> bool:
    """Elements on one line of small fields each, all at once."""
    if any("," in text or "*" in text[:8] or "\t" in text for text in entries.texts):
        return False
    corners, theta = SHELLS[name][0], THETA[name]
    fields = Fields(entries.texts, 8 * (theta + 2))
    try:
        label, part, *ends = (fields.whole(8 * k, 8 * k + 8) for k in range(1, 3 + corners))
    except ValueError:
        return False
    ends = np.column_stack(ends + [np.zeros(len(label), np.int64)] * (8 - corners))
    part = np.where(fields.blank(16, 24), label, part)
    words = fields.words(8 * theta, 8 * theta + 8)
    for row in np.flatnonzero(~fields.blank(8 * theta, 8 * theta + 8)):
        axes[int(label[row])] = angle_or_system(entries.line(row), words[row].decode().strip(),
                                                int(label[row]))
    off = fields.words(8 * theta + 8, 8 * theta + 16)
    for row in np.flatnonzero(~fields.blank(8 * theta + 8, 8 * theta + 16)):
        offsets.note(f"ZOFFS of {name}", off[row].decode())
    deck.add_shells(entries.path, entries.lines, label, part, ends)
    return True


def angle_or_system(line, word: str, label: int) -> float | int | str:
    """THETA has a point, MCID is a whole number; some programs give a system a name."""
    if word.isdigit():
        return int(word)
    try:
        return bounded(line, mended(word), f"THETA of element {label}")
    except Trouble:
        if not word[:1].isalpha():
            raise
        return word
