# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads all states of a run, as far as there are any: a run that goes on, or was killed, has no
summary yet."""

from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

from plotting.reading import Trouble, file_in, known_to_s, names, read_history, read_summary

CELL_FIELDS = ["shear_angle_deg", "warp_strain", "weft_strain", "warp_tension_N",
               "weft_tension_N", "thickness_mm"]


@dataclass
class PlyStates:
    """t frames, n nodes, m triangles."""
    name: str
    angle_deg: float
    x0: np.ndarray                   # n x 3, mm, before forming
    triangles: np.ndarray            # m x 3
    x: np.ndarray                    # t x n x 3, mm
    cells: dict[str, np.ndarray]     # t x m each, by the name in results.h5
    nodes: dict[str, np.ndarray]     # t x n each
    warp: np.ndarray                 # 3, unit vectors of the flat ply
    weft: np.ndarray
    area: np.ndarray = field(init=False)  # m, mm², before forming

    def __post_init__(self):
        a, b, c = (self.x0[self.triangles[:, k]] for k in range(3))
        self.area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)

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
    history: dict | None   # columns of history.csv
    time_s: np.ndarray     # t
    stroke_mm: np.ndarray  # t
    plies: list[PlyStates]
    tools: list[ToolStates]
    grips: list[str]

    def told(self, name: str) -> dict:
        """What the summary says of a ply."""
        plies = self.summary["plies"] if self.summary else []
        return next((ply for ply in plies if ply["name"] == name), {})

    def title(self) -> str:
        return (self.summary or {}).get("title") or self.folder.resolve().name


def read_run(folder: Path) -> Run:
    path = file_in(folder, "results.h5")
    try:
        with h5py.File(path, "r") as file:
            run = run_of(file, folder)
    except (OSError, KeyError, ValueError) as problem:
        raise Trouble(f"{path} cannot be read as results of plyform: {problem}") from problem
    if (folder / "summary.json").is_file():
        run.summary = read_summary(folder)
        known = known_to_s(run.summary)
        for tool in run.tools:
            if tool.name in known:
                after = run.time_s > known[tool.name] * (1.0 + 1e-6)
                tool.force_N = np.where(after, np.nan, tool.force_N)
    if (folder / "history.csv").is_file():
        run.history = read_history(folder)
    return run


def run_of(file: h5py.File, folder: Path) -> Run:
    count = len(file["time_s"])
    if count == 0:
        raise Trouble(f"{folder}/results.h5 has no state yet: wait for the run's first output")
    frames = [file[f"frames/{k:06}"] for k in range(count)]
    plies = [ply_of(file["plies"][name], [frame["plies"][name] for frame in frames], name)
             for name in names(file, "plies")]
    for ply in plies:
        if not all(np.isfinite(values).all() for values in (ply.x, *ply.cells.values())):
            raise Trouble(f"{folder}: a value of ply {ply.name} is not finite: the run is broken")
    tools = [tool_of(file["tools"][name], [frame["tools"][name] for frame in frames], name)
             for name in names(file, "tools")]
    return Run(folder, None, None, file["time_s"][:], file["stroke_mm"][:], plies, tools,
               names(file, "boundaries"))


def ply_of(fixed: h5py.Group, states: list[h5py.Group], name: str) -> PlyStates:
    def over_time(dataset: str) -> np.ndarray:
        return np.stack([state[dataset][:] for state in states])

    def direction(dataset: str) -> np.ndarray:
        mean = states[0][dataset][:].mean(axis=0)
        return mean / max(float(np.linalg.norm(mean)), 1e-30)

    return PlyStates(name, float(fixed.attrs["angle_deg"]), fixed["x0"][:],
                     fixed["triangles"][:].astype(np.int64), over_time("x"),
                     {one: over_time(one) for one in CELL_FIELDS},
                     {"contact_pressure": over_time("contact_pressure")},
                     direction("warp"), direction("weft"))


def tool_of(fixed: h5py.Group, states: list[h5py.Group], name: str) -> ToolStates:
    return ToolStates(name, fixed["x0"][:], fixed["triangles"][:].astype(np.int64),
                      np.stack([np.asarray(state.attrs["displacement_mm"]) for state in states]),
                      np.array([float(state.attrs["force_N"]) for state in states]),
                      np.array([float(state.attrs["stroke_mm"]) for state in states]))
