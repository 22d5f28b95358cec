# SPDX-License-Identifier: GPL-3.0-or-later
"""Readers of result folders (layout: docs/users/results.md) and of tables with named columns."""

import csv
import json
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np


class Trouble(Exception):
    """What is wrong with a result folder, a table or what was asked of them; one line."""


@dataclass(frozen=True)
class Field:
    """A value a triangle, as results.h5 and pictures call it."""
    dataset: str
    label: str
    unit: str
    factor: float = 1.0   # picture's unit over the file's
    column: str = ""      # of a table with measured or computed values; "" as dataset
    signed: bool = False  # either sign matters where it is seen from above


FIELDS = {
    "shear": Field("shear_angle_deg", "shear angle", "degrees", column="shear_deg"),
    "warp-strain": Field("warp_strain", "warp strain", "%", 100.0, signed=True),
    "weft-strain": Field("weft_strain", "weft strain", "%", 100.0, signed=True),
    "warp-tension": Field("warp_tension_N", "warp tension", "N per yarn"),
    "weft-tension": Field("weft_tension_N", "weft tension", "N per yarn"),
    "thickness": Field("thickness_mm", "thickness", "mm"),
}


@dataclass
class Ply:
    name: str
    angle_deg: float
    x0: np.ndarray         # n x 3, mm, before forming
    x: np.ndarray          # n x 3, mm
    triangles: np.ndarray  # m x 3
    value: np.ndarray      # m: the field, in its picture's unit


@dataclass
class Tool:
    name: str
    x: np.ndarray          # n x 3, mm
    triangles: np.ndarray  # m x 3


@dataclass
class State:
    folder: Path
    stroke_mm: float
    plies: list[Ply]
    tools: list[Tool]      # empty unless asked for
    turn_deg: float = 0.0  # by which the picture turns plies and tools


def file_in(folder: Path, name: str) -> Path:
    if not (folder / name).is_file():
        raise Trouble(f"{folder / name} is missing: is {folder} the folder of a run?")
    return folder / name


def read_states(folders: list[Path], field: Field, names: list[str] | None = None, frame: int = -1,
                tools: bool = False) -> list[State]:
    """A state of each folder, of the plies `names` if any: each has to be in one folder at least,
    and each folder has to have one at least."""
    states = [read_state(folder, field, frame, tools) for folder in folders]
    there = [ply.name for state in states for ply in state.plies]
    for name in names or []:
        if name not in there:
            raise Trouble(f"there is no ply {name}: it is one of {', '.join(dict.fromkeys(there))}")
    if names:
        for state in states:
            has = ", ".join(ply.name for ply in state.plies)
            state.plies = [ply for ply in state.plies if ply.name in names]
            if not state.plies:
                raise Trouble(f"{state.folder} has none of the plies {', '.join(names)}: "
                              f"it has {has}")
    return states


def read_state(folder: Path, field: Field, frame: int = -1, tools: bool = False) -> State:
    path = file_in(folder, "results.h5")
    try:
        with h5py.File(path, "r") as file:
            return state_of(file, folder, field, frame, tools)
    except (OSError, KeyError, ValueError) as problem:
        raise Trouble(f"{path} cannot be read as results of plyform: {problem}") from problem


def names(file: h5py.File, bodies: str) -> list[str]:
    """Of "plies", from the bottom of the stack, "tools" or "boundaries"."""
    # texts of any length in files of layout 1
    return [name if isinstance(name, str) else name.decode() for name in file.attrs[bodies]]


def state_of(file: h5py.File, folder: Path, field: Field, frame: int, tools: bool) -> State:
    frames = len(file["time_s"])
    number = frame if frame >= 0 else frames + frame
    if not 0 <= number < frames:
        raise Trouble(f"{folder} has no frame {frame}: it has frames 0 to {frames - 1}")
    now = file[f"frames/{number:06}"]
    plies = []
    for name in names(file, "plies"):
        fixed, ply = file["plies"][name], now["plies"][name]
        plies.append(Ply(name, float(fixed.attrs["angle_deg"]), fixed["x0"][:], ply["x"][:],
                         fixed["triangles"][:], field.factor * ply[field.dataset][:]))
        if not (np.isfinite(plies[-1].value).all() and np.isfinite(plies[-1].x).all()):
            raise Trouble(f"{folder}: a {field.label} or a position of ply {name} is not finite")
    bodies = []
    for name in names(file, "tools") if tools else []:
        tool = file["tools"][name]
        shift = np.asarray(now["tools"][name].attrs["displacement_mm"])
        bodies.append(Tool(name, tool["x0"][:] + shift, tool["triangles"][:]))
    return State(folder, float(now.attrs["stroke_mm"]), plies, bodies)


def read_summary(folder: Path) -> dict:
    path = file_in(folder, "summary.json")
    try:
        summary = json.loads(path.read_text(encoding="utf-8"))
        for key, kind in (("status", str), ("plies", list), ("tools", list), ("energy", dict),
                          ("contact", dict)):
            if not isinstance(summary[key], kind):
                raise ValueError(f"{key} is not what it should be")
        for body in [*summary["plies"], *summary["tools"], *summary.get("boundaries", [])]:
            body["name"]  # missing: a KeyError
    except (OSError, KeyError, TypeError, ValueError) as problem:
        raise Trouble(f"{path} cannot be read as a summary of plyform: "
                      f"{problem}") from problem
    return without_unknown_forces(summary)


def without_unknown_forces(summary: dict) -> dict:
    """Null in the place of forces of tools that press the plies between them: those are contact's
    stiffness, not the cloth's."""
    for tool in summary.get("tools", []):
        if "force_N" in tool and not tool.get("force_known", True):
            tool["force_N"] = tool["force_raw_N"] = None
    return summary


def known_to_s(summary: dict) -> dict[str, float]:
    """Of tools that came to press the plies between them, by name: until when their force is
    known, s."""
    return {tool["name"]: float(tool.get("force_known_to_s") or 0.0)
            for tool in summary["tools"] if not tool.get("force_known", True)}


def ended(summary: dict) -> bool:
    """Whether a run went all the way to its end, be its result doubtful or not."""
    return summary["status"] in ("done", "doubtful")


def read_table(path: Path, needed: list[str] = ()) -> dict[str, np.ndarray]:
    """Columns of a CSV file by name; empty fields are NaN, lines that start with # are left out."""
    if not path.is_file():
        raise Trouble(f"{path} is missing")
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            rows = list(csv.DictReader((line for line in file if not line.startswith("#")),
                                       skipinitialspace=True))
        table = {name: np.array([float(row[name] or "nan") for row in rows])
                 for name in (rows[0] if rows else [])}
    except (TypeError, ValueError) as problem:
        raise Trouble(f"{path} is not a table of numbers under one line of names: "
                      f"{problem}") from problem
    missing = [name for name in needed if name not in table]
    if not table or missing:
        raise Trouble(f"{path} has no {'row' if not table else 'column ' + ', '.join(missing)}"
                      + (f": it has {', '.join(table)}" if table else ""))
    return table


def read_history(folder: Path) -> dict[str, np.ndarray]:
    """Columns by name; forces of tools that press the plies between them, as the summary has it,
    are NaN from then on."""
    history = read_table(file_in(folder, "history.csv"), ["time_s", "stroke_mm"])
    if not (folder / "summary.json").is_file():
        return history
    for name, until in known_to_s(read_summary(folder)).items():
        for column in (f"{name}_force_N", f"{name}_force_raw_N"):
            if column in history:
                history[column] = np.where(history["time_s"] > until * (1.0 + 1e-6), np.nan,
                                           history[column])
    return history
