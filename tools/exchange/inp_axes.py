# SPDX-License-Identifier: GPL-3.0-or-later
"""Material axes of an Abaqus input file: the *ORIENTATION that a shell section names, for the elements
of its set.

Abaqus takes one axis of the system for the shell's normal (the first, unless the second line of
*ORIENTATION says another), projects the one after it onto the shell as direction 1, and turns it by the
line's angle. Elements without an orientation have the global x axis projected, or z where x is within
0.1 degrees of the normal.
"""

from dataclasses import dataclass, field

import numpy as np

from plotting.reading import Trouble

from exchange.deck_lines import Line, bounded, whole
from exchange.deck_mesh import found_in
from exchange.part_axes import AxesFound, System, system_along
from exchange.shell_mesh import ShellMesh

SECTIONS = ("SHELL SECTION", "SHELL GENERAL SECTION", "MEMBRANE SECTION", "SOLID SECTION")
ALONG_NORMAL = np.cos(np.radians(0.1))
MOST_IN_A_SET = 100_000_000  # elements that a line with GENERATE may make


@dataclass
class Orientation:
    system: System | None  # none: given in a way that is not read
    normal: int = 0        # the axis along the shell's normal
    turn_deg: float = 0.0


@dataclass
class Sections:
    sets: dict[str, list] = field(default_factory=dict)  # arrays of elements, and names of sets
    orientations: dict[str, Orientation] = field(default_factory=dict)
    sections: list[tuple[str, str]] = field(default_factory=list)  # set, orientation

    def add_to_set(self, name: str, labels) -> None:
        self.sets.setdefault(name.upper(), []).append(labels)

    def note(self, block) -> None:
        """Takes what matters here of any block but nodes and elements."""
        if block.keyword == "ELSET":
            self._elements(block)
        elif block.keyword == "ORIENTATION":
            self.orientations[block.options.get("NAME", "").upper()] = orientation_of(block)
        elif block.keyword in SECTIONS and "ORIENTATION" in block.options:
            self.sections.append((block.options.get("ELSET", "").upper(),
                                  block.options["ORIENTATION"].upper()))

    def _elements(self, block) -> None:
        name = block.options.get("ELSET", "")
        for line in block.each():
            words = [word.strip() for word in line.text.split(",") if word.strip()]
            if "GENERATE" in block.options:
                ends = [whole(line, word, "an element of a set") for word in words[:3]]
                if len(ends) < 2 or (len(ends) > 2 and ends[2] <= 0) or (
                        abs(ends[1] - ends[0]) > MOST_IN_A_SET):
                    raise line.wrong(f"a set's line is {line.text.strip()[:60]!r}: with GENERATE it is "
                                     "first, last and a step of 1 or more")
                self.add_to_set(name, np.arange(ends[0], ends[1] + 1, (ends + [1])[2]))
                continue
            numbers = [int(word) for word in words if word.isdigit() and len(word) < 19]
            self.add_to_set(name, np.array(numbers, np.int64))
            for word in words:
                if not word.isdigit():
                    self.add_to_set(name, word.strip('"').upper())

    def elements(self, name: str, within: tuple[str, ...] = ()) -> np.ndarray:
        found = [np.zeros(0, np.int64)]
        for some in self.sets.get(name, []):
            if not isinstance(some, str):
                found.append(np.asarray(some, np.int64))
            elif some not in within and len(within) < 50:
                found.append(self.elements(some, (*within, name)))
        return np.concatenate(found)

    def give_axes(self, mesh: ShellMesh) -> None:
        if not self.sections:
            return
        found = AxesFound(mesh)
        for set_name, name in self.sections:
            rows, there = found_in(mesh.labels, np.unique(self.elements(set_name)))
            rows = rows[there]
            if not len(rows):
                continue
            given = self.orientations.get(name)
            words = f"*ORIENTATION {name[:40]}"
            if given is None or given.system is None:
                found.leave(len(rows), words + (" (missing)" if given is None else
                                                " (given by nodes or a distribution)"))
                continue
            raw = given.system.directions(found.middles[rows], (given.normal + 1) % 3)
            found.take(rows, found.turned(rows, raw, given.turn_deg), words)
        x = np.broadcast_to((1.0, 0.0, 0.0), mesh.nodes[mesh.corners[:, 0]].shape)
        x = np.where(np.abs(found.normals[:, :1]) > ALONG_NORMAL, (0.0, 0.0, 1.0), x)
        found.done("global x, as Abaqus takes it,", found.turned(np.arange(len(x)), x, 0.0))


def orientation_of(block) -> Orientation:
    """Its first line: points a and b, and c, the origin unless told; its second: axis, angle."""
    lines = list(block.each())
    if not lines or block.options.get("DEFINITION", "COORDINATES").upper() != "COORDINATES":
        return Orientation(None)
    try:
        values = numbers_on(lines[0])
    except Trouble:
        return Orientation(None)  # the name of a distribution
    if len(values) < 6:
        raise lines[0].wrong("an orientation has the coordinates of two points at least")
    a, b = np.array(values[:3]), np.array(values[3:6])
    c = np.array((values[6:9] + [0.0] * 3)[:3])
    kind = block.options.get("SYSTEM", "RECTANGULAR").upper()
    system = made(kind, a, b, c)
    if system is None:
        raise lines[0].wrong(f"an orientation of the system {kind[:30]} whose points lie on a line, or "
                             "which is not RECTANGULAR, Z RECTANGULAR, CYLINDRICAL or SPHERICAL")
    if len(lines) < 2:
        return Orientation(system)
    axis, angle = (numbers_on(lines[1]) + [1.0, 0.0][len(numbers_on(lines[1])):])[:2]
    axis = axis or 1.0  # a blank one
    if axis not in (1.0, 2.0, 3.0):
        raise lines[1].wrong(f"the axis of an orientation is {axis:g}, not 1, 2 or 3")
    return Orientation(system, int(axis) - 1, angle)


def made(kind: str, a: np.ndarray, b: np.ndarray, c: np.ndarray) -> System | None:
    if kind in ("RECTANGULAR", "R"):  # a on the first axis, b in the plane of first and second
        third = np.cross(a - c, b - c)
        return system_along("rectangular", c, a - c, third) if np.any(third) else None
    if kind in ("Z RECTANGULAR", "ZRECTANGULAR", "Z"):  # a on the third axis, b in its plane with 1
        return system_along("rectangular", c, b - c, a - c)
    if kind in ("CYLINDRICAL", "C", "SPHERICAL", "S"):  # a and b on the axis
        along = b - a
        if not np.any(along):
            return None
        across = np.eye(3)[np.abs(along).argmin()]
        return system_along("cylindrical" if kind[0] == "C" else "spherical", a,
                            across, along)
    return None


def numbers_on(line: Line) -> list[float]:
    return [bounded(line, word.strip() or "0", "a number of an orientation")
            for word in line.text.rstrip().rstrip(",").split(",")]
