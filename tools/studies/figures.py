# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of summary.json by path: max plies.*.max_shear_deg, tools.punch.force_N."""

import math


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
    if steps[0] == "*":
        return [one for name, value in inner.items()
                for one in found(value, steps[1:], (*names, name))]
    return found(inner[steps[0]], steps[1:], names) if steps[0] in inner else []


def number(value) -> float | int | str:
    """Texts and whole numbers as they are; NaN for null."""
    if isinstance(value, (int, float, str)):
        return value
    return math.nan


def taken(how: str, values: list) -> float:
    """NaN if one of them is."""
    numbers = [float(value) if isinstance(value, (int, float)) else math.nan for value in values]
    if not numbers or any(map(math.isnan, numbers)):
        return math.nan
    return {"max": max, "min": min, "sum": sum,
            "mean": lambda them: sum(them) / len(them)}[how](numbers)


def figures_of(wanted: dict[str, str], summary: dict) -> dict:
    """A column a figure; of one with * and nothing to take of them, a column each. What the
    summary does not have is left out."""
    row = {}
    for name, path in wanted.items():
        how, _, path = path.rpartition(" ")
        values = found(summary, path.split("."))
        if not values:
            continue
        if how:
            row[name] = taken(how, [value for _, value in values])
        else:
            row |= {f"{name}_{of}" if of else name: number(value) for of, value in values}
    return row
