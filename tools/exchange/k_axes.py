# SPDX-License-Identifier: GPL-3.0-or-later
"""Material axes of an LS-DYNA file: MCID names a coordinate system whose x axis is projected onto the
shell; BETA turns the axes of the material, which are the side from corner 1 to corner 2 if its AOPT is
0, as is taken here. AOPT itself is not read, which is told where materials that have one are in the file.
"""

import numpy as np

from exchange.deck_lines import Line, bounded, whole
from exchange.deck_mesh import found_in
from exchange.keyword_file import Cards
from exchange.part_axes import AxesFound, System, system_along
from exchange.shell_mesh import ShellMesh

# materials of shells with axes of their own, by number and name
WITH_AXES = {"2", "002", "22", "022", "23", "023", "33", "033", "34", "034", "36", "036", "37", "037",
             "40", "040", "54", "054", "55", "055", "58", "058", "59", "059", "103", "108", "113", "116",
             "117", "118", "122", "133", "135", "157", "158", "190", "221", "233", "234", "235", "249",
             "261", "262", "278", "293"}
NAMES = ("ORTHO", "ANISO", "COMPOSITE", "FABRIC", "LAMINATED", "ENHANCED", "BARLAT", "LAYERED", "FIBER",
         "REINFORCED", "MICROMECHANICS", "VISCOELASTIC_FABRIC", "RATE_SENSITIVE_COMPOSITE", "MAT_COHFABRIC")


class Axes:
    def __init__(self) -> None:
        self.beta: dict[int, float] = {}
        self.mcid: dict[int, int] = {}
        self.systems: dict[int, tuple] = {}
        self.materials: list[str] = []

    def of_card(self, block: Cards, row: int, label: int, options: set[str]) -> None:
        """From the card with thicknesses: its fifth field."""
        if not options & {"BETA", "MCID"} or row >= len(block.texts):
            return
        words = block.words(row, block.widths([16] * 5))
        if not words[4]:
            return
        value = bounded(block.line(row), words[4], f"BETA or MCID of element {label}")
        if "MCID" in options:
            self.mcid[label] = int(value)
        else:
            self.beta[label] = value

    def note(self, block: Cards) -> None:
        """Systems, and materials with axes."""
        keyword = block.keyword
        if keyword.startswith("DEFINE_COORDINATE_"):
            rows = range(1 if keyword.endswith("_TITLE") else 0, len(block.texts))
            kind = keyword.split("_")[2]
            reader = {"SYSTEM": of_system, "NODES": of_nodes, "VECTOR": of_vectors}.get(kind)
            if reader:
                self.systems.update(reader(block, list(rows)))
        elif keyword.startswith("MAT_"):
            word = keyword[4:].removesuffix("_TITLE")
            if word in WITH_AXES or any(name in word for name in NAMES):
                self.materials.append(keyword.removesuffix("_TITLE"))

    def give(self, mesh: ShellMesh) -> None:
        if self.materials:
            mesh.notes.append(f"AOPT of *{', *'.join(sorted(set(self.materials))[:3])} is not read: "
                              "sides, and BETA, are taken as with AOPT = 0")
        if not self.beta and not self.mcid:
            return
        found = AxesFound(mesh)
        if self.beta:
            rows = found_in(mesh.labels, np.array(list(self.beta), np.int64))[0]
            found.take(rows, found.from_sides(rows, np.array(list(self.beta.values()))),
                       "BETA, from the side from corner 1 to corner 2 as with AOPT = 0,")
        for name in sorted(set(self.mcid.values())):
            labels = [label for label, one in self.mcid.items() if one == name]
            rows = found_in(mesh.labels, np.array(labels, np.int64))[0]
            system = self._system(mesh, name)
            if system is None:
                found.leave(len(rows), f"MCID {name} (no such coordinate system in the file)")
                continue
            found.take(rows, found.turned(rows, system.directions(found.middles[rows], 0), 0.0),
                       f"MCID {name}")
        found.done("side from corner 1 to corner 2")

    def _system(self, mesh: ShellMesh, name: int) -> System | None:
        """0 is the global one."""
        if name == 0:
            return System("rectangular", np.zeros(3), np.eye(3))
        if name not in self.systems:
            return None
        line, points = self.systems[name]
        if isinstance(points, list):  # numbers of nodes
            rows, there = found_in(mesh.node_labels, np.array(points, np.int64))
            if not there.all():
                return None
            points = mesh.nodes[rows]
        origin, on_x, in_xy = points
        third = np.cross(on_x - origin, in_xy - origin)
        system = system_along("rectangular", origin, on_x - origin, third) if np.any(third) else None
        if system is None:
            raise line.wrong(f"the three points of coordinate system {name} lie on a line")
        return system


def values_of(block: Cards, row: int, count: int) -> tuple[Line, list[float]]:
    line, words = block.line(row), block.words(row, [20 if block.form == "long" else 10] * 8)
    return line, [bounded(line, word or "0", "a number of a coordinate system") for word in words[:count]]


def of_system(block: Cards, rows: list[int]) -> dict[int, tuple]:
    """CID, origin, a point on x; below, a point in the plane of x and y."""
    found = {}
    for one, two in zip(rows[::2], rows[1::2]):
        line, values = values_of(block, one, 7)
        below = values_of(block, two, 3)[1]
        found[int(values[0])] = (line, np.array([values[1:4], values[4:7], below]))
    return found


def of_vectors(block: Cards, rows: list[int]) -> dict[int, tuple]:
    """CID, direction of x, a direction in the plane of x and y."""
    found = {}
    for row in rows:
        line, values = values_of(block, row, 7)
        found[int(values[0])] = (line, np.array([(0.0, 0.0, 0.0), values[1:4], values[4:7]]))
    return found


def of_nodes(block: Cards, rows: list[int]) -> dict[int, tuple]:
    """CID, nodes at the origin, on x, and in the plane of x and y."""
    found = {}
    for row in rows:
        line, words = block.line(row), block.words(row, [20 if block.form == "long" else 10] * 8)
        name, *nodes = (whole(line, word, "a number of a coordinate system") for word in words[:4])
        found[name] = (line, nodes)
    return found
