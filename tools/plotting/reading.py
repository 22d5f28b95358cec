# SPDX-License-Identifier: GPL-3.0-or-later
"""Readers of result folders (layout: docs/users/results.md) and of tables with named columns."""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from base.ending import Trouble
from base.files import TABLE, check_file, read_text
from base.results_file import Column, Results, read_results
from base.summary_file import SOUND, known_to_s, read_summary

__all__ = ["SHEAR", "Ply", "State", "Tool", "Trouble", "ended", "file_in", "read_history",
           "read_state", "read_states", "read_summary", "read_table"]


SHEAR = "shear"  # the field that pictures show unless told


@dataclass
class Ply:
    name: str
    angle_deg: float
    x0: np.ndarray         # n x 3, mm, before forming
    x: np.ndarray          # n x 3, mm
    triangles: np.ndarray  # m x 3
    value: np.ndarray      # m: the field, in the unit it is shown in


@dataclass
class Tool:
    name: str
    x: np.ndarray          # n x 3, mm
    triangles: np.ndarray  # m x 3


@dataclass
class State:
    folder: Path
    stroke_mm: float
    time_s: float
    plies: list[Ply]
    tools: list[Tool]      # empty unless asked for
    field: Column
    turn_deg: float = 0.0  # by which the picture turns plies and tools


def file_in(folder: Path, name: str) -> Path:
    if not (folder / name).exists():
        raise Trouble(f"{folder / name} is missing: is {folder} the folder of a run?")
    return check_file(folder / name)


def read_states(folders: list[Path], field: str, names: list[str] | None = None, frame: int = -1,
                tools: bool = False) -> list[State]:
    """A state of each folder with the field of this word or name, of the plies `names` if any: each has to be in one folder at least,
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


def read_state(folder: Path, field: str, frame: int = -1, tools: bool = False) -> State:
    return read_results(folder, lambda results: state_of(results, field, frame, tools))


def column_called(results: Results, ply: str, field: str) -> Column:
    columns = [column for column in results.columns(ply) if column.size == 1]
    for column in columns:
        if field in (column.word, column.name):
            return column
    raise Trouble(f"{results.folder}: ply {ply} has no field {field}: it has "
                  f"{', '.join(column.word for column in columns)}")


def values_of(results: Results, number: int, ply: str, column: Column, nodes: int,
              triangles: np.ndarray) -> np.ndarray:
    """A value a triangle in the unit that is shown, of what is at nodes the mean of its corners."""
    count = nodes if column.place == "node" else len(triangles)
    values = column.factor * results.column(number, ply, column, count)
    return values[triangles].mean(axis=1) if column.place == "node" else values


def state_of(results: Results, field: str, frame: int, tools: bool) -> State:
    number = results.frame_number(frame)
    now = results.state(number)
    plies, column = [], None
    for name in results.names("plies"):
        x0, triangles = results.body("plies", name)
        ply = results.in_state(number, "plies", name)
        column = column_called(results, name, field)
        plies.append(Ply(name, results.number(results.group("plies", name), "angle_deg"), x0,
                         results.numbers(ply, "x", x0.shape), triangles,
                         values_of(results, number, name, column, len(x0), triangles)))
    if column is None:
        raise Trouble(f"{results.folder} has no ply")
    bodies = []
    for name in results.names("tools") if tools else []:
        x0, triangles = results.body("tools", name)
        tool = results.in_state(number, "tools", name)
        bodies.append(Tool(name, x0 + results.attribute(tool, "displacement_mm", (3,)), triangles))
    return State(results.folder, results.number(now, "stroke_mm"), float(results.time_s[number]),
                 plies, bodies, column)


def ended(summary: dict) -> bool:
    """Whether a run went all the way to its end, be its result doubtful or not."""
    return summary["status"] in SOUND


def read_table(path: Path, needed: list[str] = ()) -> dict[str, np.ndarray]:
    """Columns of a CSV file by name; empty fields are NaN, lines that start with # are left out."""
    text = read_text(path, TABLE)
    try:
        rows = list(csv.reader((line for line in text.splitlines() if not line.startswith("#")),
                               skipinitialspace=True))
        names, rows = (rows[0], [row for row in rows[1:] if row]) if rows else ([], [])
        if any(len(row) > len(names) for row in rows):
            raise ValueError("a line has more fields than names stand above")
        table = {name: np.array([float((row[k] if k < len(row) else "") or "nan") for row in rows])
                 for k, name in enumerate(names)} if rows else {}
    except (csv.Error, ValueError) as problem:
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
    for name, until in known_to_s(read_summary(folder, ())).items():
        for column in (f"{name}_force_N", f"{name}_force_raw_N"):
            if column in history:
                history[column] = np.where(history["time_s"] > until * (1.0 + 1e-6), np.nan,
                                           history[column])
    return history
