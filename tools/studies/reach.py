# SPDX-License-Identifier: GPL-3.0-or-later
"""How far each key of a grid goes from the case's own value, all else as the case has it, before a
run does not keep the limits."""

import math

from compare import table
from studies.plan import Planner
from studies.ranking import is_number
from studies.study_file import Study

LOST = ("missing", "failed", "refused")


def same(a, b) -> bool:
    return math.isclose(a, b, rel_tol=1e-6) if is_number(a) and is_number(b) else a == b


def numbers_and_names(planner: Planner, rows: list[dict]) -> tuple[dict, list[str]]:
    """The case's own value of each key that is a number, and the keys that are none."""
    own = {one.name: planner.own(one, planner.base) for one in planner.vary}
    numbers = {name: value for name, value in own.items()
               if is_number(value) and all(is_number(row[name]) for row in rows)}
    return numbers, [name for name in own if name not in numbers]


def one_way(rows: list[dict], key: str, own: float, up: bool) -> dict:
    """The last value that keeps all limits, the next one and what breaks there."""
    ways = {"last_within": "", "next": "", "breaks": ""}
    there = sorted((row for row in rows if same(row[key], own) or (row[key] > own) == up),
                   key=lambda row: row[key], reverse=not up)
    for row in there:
        if row["status"] in LOST:
            break
        if row["breaks"]:
            return ways | {"next": row[key],
                           "breaks": f"{row['breaks']} {row.get('stop', '')}".strip()}
        ways["last_within"] = row[key]
    return ways


def reach(study: Study, planner: Planner, rows: list[dict]) -> list[dict]:
    """Rows of reach.csv."""
    rows = [row for row in rows if row["line"] == "grid"]
    if not (rows and study.limits):
        return []
    numbers, names = numbers_and_names(planner, rows)
    ways = []
    for key, own in numbers.items():
        for up in (False, True):
            for group in dict.fromkeys(tuple(row[name] for name in names) for row in rows):
                along = [row for row in rows if group == tuple(row[name] for name in names) and
                         all(same(row[name], value) for name, value in numbers.items()
                             if name != key)]
                if along:
                    ways.append({"key": key, "own": own, "direction": "up" if up else "down",
                                 **dict(zip(names, group)), **one_way(along, key, own, up)})
    return ways


def cell(row: dict) -> str:
    beyond = f"{row['breaks']} at {row['next']:g}" if row["breaks"] else "none seen"
    if row["last_within"] == "":
        return beyond if row["breaks"] else "–"
    return f"{row['last_within']:g} (×{row['last_within'] / row['own']:.2g}), {beyond}"


def markdown(rows: list[dict]) -> str:
    """A line a key and direction, a column for each combination of what is no number."""
    fixed = ("key", "own", "direction", "last_within", "next", "breaks")
    groups = list(dict.fromkeys(tuple(str(value) for name, value in row.items()
                                      if name not in fixed) for row in rows))
    lines: dict[tuple, list[str]] = {}
    for row in rows:
        lines.setdefault((row["key"], row["own"], row["direction"]), []).append(cell(row))
    return table(["setting", "direction", *(", ".join(group) or "limits" for group in groups)],
                 [[f"`{key}` {own:g}", way, *cells] for (key, own, way), cells in lines.items()],
                 2 + len(groups))
