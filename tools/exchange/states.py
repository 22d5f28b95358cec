# SPDX-License-Identifier: GPL-3.0-or-later
"""All fields of plies and tools of a state in results.h5, for export."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from base.progress import told
from base.results_file import Results, read_results
from plotting.reading import Trouble


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


def read_states(folder: Path, frame: str) -> list[State]:
    """One state, by its number from 0 (-1: the last), or "all". Raises Trouble."""
    asked = None if frame == "all" else whole(frame)
    return read_results(folder, lambda results: [
        state_of(results, number) for number in
        told("reads state", list(range(results.count)) if asked is None else
             [results.frame_number(asked)])])


def whole(word: str) -> int:
    try:
        return int(word)
    except ValueError:
        raise Trouble(f"--frame {word}: a number from 0, -1 for the last, or all") from None


def fields_of(results: Results, number: int, name: str, place: str,
              count: int) -> dict[str, np.ndarray]:
    return {column.name: results.column(number, name, column, count)
            for column in results.columns(name) if column.place == place}


def state_of(results: Results, number: int) -> State:
    now = results.state(number)
    bodies = []
    for name in results.names("plies"):
        x0, triangles = results.body("plies", name)
        points = results.numbers(results.in_state(number, "plies", name), "x", x0.shape)
        nodes = {**fields_of(results, number, name, "node", len(x0)), "x0": x0}
        bodies.append(Body(name, points, triangles, nodes,
                           fields_of(results, number, name, "triangle", len(triangles)), False))
    for name in results.names("tools"):
        x0, triangles = results.body("tools", name)
        shift = results.attribute(results.in_state(number, "tools", name), "displacement_mm", (3,))
        bodies.append(Body(name, x0 + shift, triangles, {}, {}, True))
    names = [body.name for body in bodies]
    if len(set(names)) < len(names):
        raise Trouble(f"{results.path}: a ply and a tool have one name, and so would their files")
    return State(number, results.number(now, "time_s"), results.number(now, "stroke_mm"), bodies)
