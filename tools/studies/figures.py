# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of a run by path: of summary.json, max plies.*.max_shear_deg, tools.punch.force_N; of
history.csv, max history.die_force_N, or of the second half of the stroke, jump late.die_force_N."""

import fnmatch
import math
import re
from pathlib import Path

import numpy as np
from base.summary_file import without_unknown_forces
from plotting.reading import read_history

TAKE = ("max", "min", "mean", "sum", "jump")
FIGURE = re.compile(rf"^(?:([-+.\deE]+) \* )?(?:({'|'.join(TAKE)}) )?(\S+)$")  # factor, take, path
HISTORY = ("history", "late")


def pairs_by_kind(summary: dict) -> dict:
    """Beside `pairs`, those of plies with plies (or with themselves) and those with tools."""
    plies = {ply.get("name") for ply in summary.get("plies", [])}
    pairs = summary.get("pairs", [])
    between = [{pair.get("a"), pair.get("b")} <= plies for pair in pairs]
    return summary | {
        "pairs_of_plies": [pair for pair, both in zip(pairs, between) if both],
        "pairs_with_tools": [pair for pair, both in zip(pairs, between) if not both]}


def found(at, steps: list[str], names: tuple[str, ...] = ()) -> list[tuple[str, object]]:
    """Values under a path, each with the names that * stood for. Items of lists go by their own
    name, or by number from 0."""
    if not steps:
        return [("_".join(names), at)]
    if isinstance(at, list):
        inner = {str(one.get("name", i)) if isinstance(one, dict) else str(i): one
                 for i, one in enumerate(at)}
        if steps[0].isdigit() and steps[0] not in inner and int(steps[0]) < len(at):
            return found(at[int(steps[0])], steps[1:], names)
    else:
        inner = at if isinstance(at, dict) else {}
    if "*" in steps[0]:
        return [one for name, value in inner.items() if fnmatch.fnmatchcase(name, steps[0])
                for one in found(value, steps[1:], (*names, name))]
    return found(inner[steps[0]], steps[1:], names) if steps[0] in inner else []


def number(value, factor: float) -> float | int | str:
    """Texts and whole numbers as they are; NaN for null."""
    if isinstance(value, (int, float)) and factor != 1.0:
        return factor * value
    return value if isinstance(value, (int, float, str)) else math.nan


def taken(how: str, values: list) -> float:
    """NaN if one of them is."""
    numbers = [float(value) if isinstance(value, (int, float)) else math.nan for value in values]
    if not numbers or any(map(math.isnan, numbers)):
        return math.nan
    if how == "jump":
        return largest_jump(np.array(numbers))
    return {"max": max, "min": min, "sum": sum,
            "mean": lambda them: sum(them) / len(them)}[how](numbers)


def largest_jump(values: np.ndarray) -> float:
    """Largest distance of a value from the mean of those before and after."""
    return float(abs(values[1:-1] - 0.5 * (values[:-2] + values[2:])).max(initial=0.0))


def of_history(path: str, folder: Path, jump: bool) -> list[float]:
    """Values of a column; late ones from half of the stroke on, or of the time where nothing has a stroke, for
    jumps with the one before."""
    which, _, column = path.partition(".")
    history = read_history(folder)
    if column not in history:
        return []
    reached = history["stroke_mm" if np.any(history["stroke_mm"] != 0.0) else "time_s"]
    first = 0 if which == "history" else int(np.argmax(reached >= 0.5 * reached[-1])) - jump
    return history[column][max(first, 0):].tolist()


def figures_of(wanted: dict[str, str], summary: dict, folder: Path) -> dict:
    """A column a figure; of one with * and nothing to take of them, a column each. What the run
    does not have is left out."""
    row, summary = {}, pairs_by_kind(without_unknown_forces(summary)) if summary else {}
    for name, path in wanted.items():
        factor, how, path = FIGURE.match(path).groups()
        factor = float(factor or 1.0)
        if path.startswith(tuple(f"{one}." for one in HISTORY)):
            values = [("", value) for value in of_history(path, folder, how == "jump")] \
                if summary else []
        else:
            values = found(summary, path.split("."))
        if not values:
            continue
        if how:
            row[name] = factor * taken(how, [value for _, value in values])
        else:
            row |= {f"{name}_{of}" if of else name: number(value, factor) for of, value in values}
    return row
