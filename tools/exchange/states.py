# SPDX-License-Identifier: GPL-3.0-or-later
"""All fields of plies and tools of a state in results.h5, for export."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from plotting.reading import Trouble, file_in, names

from exchange.formed import frame_number


@dataclass
class Body:
    """n nodes, m triangles."""
    name: str
    points: np.ndarray            # n x 3, mm
    triangles: np.ndarray         # m x 3
    nodes: dict[str, np.ndarray]  # fields a node, by their names in results.h5
    cells: dict[str, np.ndarray]  # fields a triangle; none of tools
    tool: bool


@dataclass
class State:
    number: int
    time_s: float
    stroke_mm: float
    bodies: list[Body]  # plies from the bottom of the stack, then tools


def read_states(folder: Path, frame: str) -> Iterator[State]:
    """One state, by its number from 0 (-1: the last), or "all". Raises Trouble."""
    path = file_in(folder, "results.h5")
    try:
        with h5py.File(path, "r") as file:
            if frame == "all":
                numbers = range(len(file["time_s"]))
            else:
                numbers = [frame_number(file, folder, whole(frame))]
            for number in numbers:
                yield state_of(file, number)
    except (OSError, KeyError, ValueError) as problem:
        raise Trouble(f"{path} cannot be read as results of plyform: {problem}") from problem


def whole(word: str) -> int:
    try:
        return int(word)
    except ValueError:
        raise Trouble(f"--frame {word}: a number from 0, -1 for the last, or all") from None


def state_of(file: h5py.File, number: int) -> State:
    now = file[f"frames/{number:06}"]
    bodies = []
    for name in names(file, "plies"):
        fixed, ply = file["plies"][name], now["plies"][name]
        points, triangles = ply["x"][:], fixed["triangles"][:].astype(np.int64)
        fields = {key: ply[key][:] for key in ply if key != "x"}
        nodes = {key: value for key, value in fields.items()
                 if key in ("contact_pressure", "reaction_N")}
        nodes["x0"] = fixed["x0"][:]
        cells = {key: value for key, value in fields.items() if key not in nodes}
        if not all(np.isfinite(value).all() for value in (points, *fields.values())):
            raise Trouble(f"a value of ply {name} is not finite: the run is broken")
        bodies.append(Body(name, points, triangles, nodes, cells, False))
    for name in names(file, "tools"):
        fixed = file["tools"][name]
        shift = np.asarray(now["tools"][name].attrs["displacement_mm"])
        bodies.append(Body(name, fixed["x0"][:] + shift, fixed["triangles"][:].astype(np.int64), {},
                           {}, True))
    return State(number, float(now.attrs["time_s"]), float(now.attrs["stroke_mm"]), bodies)
