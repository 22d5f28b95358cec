# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads all states of a run, as far as there are any: a run that goes on, or was killed, has no
summary yet."""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from base.ending import one_line
from base.progress import told
from base.results_file import Broken, Column, Results, read_results
from base.summary_file import known_to_s
from plotting.reading import Trouble, read_summary

# of summary.json, without which there is no report
NEEDED = ("status", "message", "version", "steps", "wall_time_s", "plies", "tools", "energy", "contact")
Numbers = dict[str, tuple[Column, np.ndarray]]  # t each, by name, as results.h5 describes them


@dataclass
class PlyStates:
    """t frames, n nodes, m triangles."""
    name: str
    angle_deg: float
    x0: np.ndarray                   # n x 3, mm, before forming
    triangles: np.ndarray            # m x 3
    x: np.ndarray                    # t x n x 3, mm
    columns: list[Column]            # of one number a triangle or node
    cells: dict[str, np.ndarray]     # t x m each, by name
    nodes: dict[str, np.ndarray]     # t x n each
    families: dict[str, np.ndarray]  # 3 each, unit vectors of the flat ply
    history: Numbers
    area: np.ndarray = field(init=False)  # m, mm², before forming

    def __post_init__(self):
        a, b, c = (self.x0[self.triangles[:, k]] for k in range(3))
        self.area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)

    def of_quantity(self, quantity: str) -> list[np.ndarray]:
        """The cells of all families, t x m each."""
        return [self.cells[column.name] for column in self.columns if column.quantity == quantity]

    def thickness(self) -> float:
        return float(self.cells["thickness_mm"][0].mean())


@dataclass
class ToolStates:
    name: str
    x0: np.ndarray         # n x 3, mm, at time 0
    triangles: np.ndarray  # m x 3
    shift: np.ndarray      # t x 3, mm, since time 0
    force_N: np.ndarray    # t, NaN where it is not known
    stroke_mm: np.ndarray  # t, along its direction


@dataclass
class Run:
    folder: Path
    summary: dict | None   # none: the run goes on, or was killed
    time_s: np.ndarray     # t
    stroke_mm: np.ndarray  # t
    plies: list[PlyStates]
    tools: list[ToolStates]
    grips: dict[str, Numbers]
    energies: Numbers

    def summary_of(self, name: str) -> dict:
        """What the summary says of a ply."""
        plies = self.summary["plies"] if self.summary else []
        return next((ply for ply in plies if ply["name"] == name), {})

    def has_stroke(self) -> bool:
        return bool(np.any(self.stroke_mm != 0.0))

    def title(self) -> str:
        return (self.summary or {}).get("title") or self.name()

    def name(self) -> str:
        """Of the folder; bytes that are no text are written out."""
        return one_line(self.folder.resolve().name)


def read_run(folder: Path) -> Run:
    run = read_results(folder, run_of)
    if (folder / "summary.json").exists():
        run.summary = read_summary(folder, NEEDED)
        check_bodies(run)
        known = known_to_s(run.summary)
        for tool in run.tools:
            if tool.name in known:
                after = run.time_s > known[tool.name] * (1.0 + 1e-6)
                tool.force_N = np.where(after, np.nan, tool.force_N)
    return run


def check_bodies(run: Run) -> None:
    """Whether summary.json and results.h5 are of one run. Raises Trouble."""
    for kind, own in (("plies", run.plies), ("tools", run.tools)):
        names = [body["name"] for body in run.summary[kind]]
        if names != [body.name for body in own]:
            raise Trouble(f"{run.folder}: summary.json and results.h5 have different {kind}: are "
                          "they of one run?")


def run_of(results: Results) -> Run:
    results.frame_number(0)  # raises where there is no state yet
    stroke_mm = results.numbers(results.file, "stroke_mm", (results.count,))
    plies = [ply_of(results, name) for name in told("reads", results.names("plies"))]
    tools = [tool_of(results, name) for name in results.names("tools")]
    if not plies:
        raise Broken("/:plies is empty")
    return Run(results.folder, None, results.time_s, stroke_mm, plies, tools,
               {name: grip_of(results, name) for name in results.names("boundaries")},
               results.history("energies"))


def ply_of(results: Results, name: str) -> PlyStates:
    x0, triangles = results.body("plies", name)
    states = [results.in_state(k, "plies", name) for k in range(results.count)]
    columns = [column for column in results.columns(name) if column.size == 1]
    for needed in ("shear_angle_deg", "thickness_mm"):
        if needed not in [column.name for column in columns if column.place == "triangle"]:
            raise Broken(f"/plies/{name}:columns has no {needed}")
    sizes = {"node": len(x0), "triangle": len(triangles)}

    def over_time(place: str) -> dict[str, np.ndarray]:
        return {column.name: np.stack([results.column(k, name, column, sizes[place])
                                       for k in range(results.count)])
                for column in columns if column.place == place}

    def direction(family: str) -> np.ndarray:
        mean = results.numbers(states[0], family, triangles.shape).mean(axis=0)
        return mean / max(float(np.linalg.norm(mean)), 1e-30)

    return PlyStates(name, results.number(results.group("plies", name), "angle_deg"), x0, triangles,
                     np.stack([results.numbers(state, "x", x0.shape) for state in states]), columns,
                     over_time("triangle"), over_time("node"),
                     {family: direction(family) for family in results.families(name)},
                     results.history("plies", name))


def grip_of(results: Results, name: str) -> Numbers:
    numbers = results.history("boundaries", name)
    if "force_N" not in numbers:
        raise Broken(f"/history/boundaries/{name} has no force_N")
    return numbers


def tool_of(results: Results, name: str) -> ToolStates:
    states = [results.in_state(k, "tools", name) for k in range(results.count)]
    return ToolStates(name, *results.body("tools", name),
                      np.stack([results.attribute(state, "displacement_mm", (3,)) for state in states]),
                      np.array([results.number(state, "force_N") for state in states]),
                      np.array([results.number(state, "stroke_mm") for state in states]))
