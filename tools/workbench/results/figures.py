# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of a run that runs are compared by, from its summary.json, and how cases differ."""

import math
from dataclasses import dataclass

from base.summary_figures import Figure as Described
from base.summary_figures import described


@dataclass(frozen=True)
class Figure:
    """`band`: half of it, where a run has been verified; else none."""
    id: str
    label: str
    unit: str
    value: float
    band: float | None = None
    of_ply: bool = False  # of a single one


KEY_FIGURES = ("max_shear_deg", "wrinkle_height_mm", "draw_in_mm.mean", "wall_time_s")  # of a list of runs; and a force


def known(value: object) -> bool:
    return isinstance(value, (int, float)) and math.isfinite(value)


def figures_of(summary: dict) -> list[Figure]:
    """First those of the whole run: the worst of its plies, forces, errors; then of each ply."""
    bands = {one["name"]: one.get("band") for one in summary.get("verification", {}).get("figures", [])
             if "name" in one}
    kinds = described(summary, "plies").values()
    of_plies = [(ply["name"], [shown(one, value, bands.get(f"{one.verified} of {ply['name']}"))
                               for one in kinds if one.compared and (value := one.of(ply)) is not None])
                for ply in summary.get("plies", [])]
    labels = dict.fromkeys(one.label for _, figures in of_plies for one in figures)
    worst = [max((one for _, figures in of_plies for one in figures if one.label == label),
                 key=lambda one: one.value) for label in labels]
    forces = [Figure(f"force of {body['name']}", f"force of {body['name']}", "N", body["force_N"],
                     bands.get(f"force of {body['name']}"))
              for body in (*summary.get("tools", []), *summary.get("boundaries", []))
              if known(body.get("force_N"))]
    of_run = [shown(one, value) for one in described(summary, "run").values()
              if one.compared and (value := one.of(summary)) is not None]
    single = [Figure(f"{one.label} of {name}", f"{one.label} of {name}", one.unit, one.value, one.band, True)
              for name, figures in of_plies for one in figures]
    return [*worst, *forces, *of_run, *(single if len(of_plies) > 1 else [])]


def shown(one: Described, value: float, band: float | None = None) -> Figure:
    return Figure(one.label, one.label, one.shown_unit, value, band)


def key_figures(summary: dict) -> list[Figure]:
    kinds = described(summary, "plies") | described(summary, "run")
    labels = [kinds[name].label for name in KEY_FIGURES if name in kinds]
    of_run = {one.label: one for one in figures_of(summary)}
    found = [of_run[label] for label in labels if label in of_run]
    if force := driven_force(summary):
        found.insert(1, force)
    return found


def driven_force(summary: dict) -> Figure | None:
    """Of the tool that goes furthest: the punch, mostly."""
    tools = [tool for tool in summary.get("tools", []) if known(tool.get("displacement_mm"))
             and known(tool.get("force_N"))]
    if not tools:
        return None
    tool = max(tools, key=lambda one: abs(one["displacement_mm"]))
    return Figure("", f"force of {tool['name']}", "N", tool["force_N"])


def differences(cases: list[dict]) -> list[dict]:
    """Keys that the cases do not all give alike: {key, values: one a case, None where it is not
    given}, in the order of the cases."""
    keys = dict.fromkeys(key for case in cases for key in case)
    rows = [{"key": key, "values": [case.get(key) for case in cases]} for key in keys]
    return [row for row in rows if len(set(row["values"])) > 1]
