# SPDX-License-Identifier: GPL-3.0-or-later
"""Material axes of a Nastran or OptiStruct file: THETA turns the side from corner 1 to corner 2 about the
normal, MCID names a system whose x axis is projected onto the element; where both are blank it is that
side. Of a cylindrical or spherical system x is the radial direction at the middle of the element.
"""

import numpy as np

from exchange.bulk_data import Entries
from exchange.deck_lines import Line, bounded, whole
from exchange.deck_mesh import found_in
from exchange.part_axes import AxesFound, System, system_of
from exchange.shell_mesh import ShellMesh

KINDS = {"R": "rectangular", "C": "cylindrical", "S": "spherical"}


def give_axes(mesh: ShellMesh, axes: dict[int, float | int | str],
              files: list[dict[str, Entries]]) -> None:
    if not axes:
        return
    found = AxesFound(mesh)
    rows = found_in(mesh.labels, np.array(list(axes), np.int64))[0]
    given = list(axes.values())
    angle = np.array([isinstance(one, float) for one in given])
    if angle.any():
        degrees = np.array([one for one in given if isinstance(one, float)])
        found.take(rows[angle], found.from_sides(rows[angle], degrees), "THETA")
    systems = systems_of(mesh, files)
    for name in sorted({one for one in given if not isinstance(one, float)}, key=str):
        here = rows[[not isinstance(one, float) and one == name for one in given]]
        system = systems.get(str(name))
        if system is None:
            found.leave(len(here), f"MCID {str(name)[:20]} (no such coordinate system, or of a kind "
                        "that is not read)")
            continue
        raw = system.directions(found.middles[here], 0)
        kind = "" if system.kind == "rectangular" else f" ({system.kind}: its radial direction)"
        found.take(here, found.turned(here, raw, 0.0), f"MCID {name}{kind}")
    found.done("side from corner 1 to corner 2")


def systems_of(mesh: ShellMesh, files: list[dict[str, Entries]]) -> dict[str, System]:
    """By number: CORD1R, C, S by grid points, CORD2R, C, S by points in another system."""
    systems: dict[str, System] = {"0": System("rectangular", np.zeros(3), np.eye(3))}
    waiting = []
    for entries in files:
        for name, some in entries.items():
            if name[:5] == "CORD1" and name[5:] in KINDS:
                for line, fields in some.each():
                    add_by_grids(systems, mesh, line, fields, KINDS[name[5:]])
            elif name[:5] == "CORD2" and name[5:] in KINDS:
                waiting += [(KINDS[name[5:]], line, fields) for line, fields in some.each()]
    while waiting:
        left = [one for one in waiting if not add_by_points(systems, *one)]
        if len(left) == len(waiting):
            break  # their own systems are missing
        waiting = left
    return systems


def add_by_grids(systems: dict[str, System], mesh: ShellMesh, line: Line, fields: list[str],
                 kind: str) -> None:
    for k in (1, 5):
        words = fields[k:k + 4]
        if len(words) < 4 or not words[0]:
            continue
        grids = np.array([whole(line, word, "a grid point of a coordinate system")
                          for word in words[1:]])
        rows, there = found_in(mesh.node_labels, grids)
        if there.all():
            add(systems, words[0], system_of(kind, *mesh.nodes[rows]), line)


def add_by_points(systems: dict[str, System], kind: str, line: Line, fields: list[str]) -> bool:
    base = systems.get(fields[2] or "0")
    if base is None:
        return False
    fields = fields + [""] * (12 - len(fields))
    values = [bounded(line, word or "0", "a coordinate of a coordinate system") for word in fields[3:12]]
    points = [base.place(np.array(values[k:k + 3])) for k in (0, 3, 6)]
    add(systems, fields[1], system_of(kind, *points), line)
    return True


def add(systems: dict[str, System], name: str, system: System | None, line: Line) -> None:
    if system is None:
        raise line.wrong(f"the three points of coordinate system {name[:20]} lie on a line")
    systems[name] = system
