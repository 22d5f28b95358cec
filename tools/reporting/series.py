# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of each state: what the curves of a report show."""

import numpy as np

from .reading_run import Run

UNITS = {"deg": "°", "1": "%", "mJ": "J"}  # as pages have them
FACTORS = {"1": 100.0, "mJ": 1e-3}


def charts_of(run: Run) -> list[dict]:
    """Curves over the states: title, unit, and a list of names with values. Of plies every number
    that results.h5 has."""
    charts = []
    forces = [(tool.name, tool.force_N) for tool in run.tools]
    forces += [(name, numbers["force_N"][1]) for name, numbers in run.grips.items()]
    if forces:
        charts.append(chart("forces", "forces", "N", forces))
    named = {name: column for ply in run.plies for name, (column, _) in ply.history.items()}
    for name, column in named.items():
        curves = [(ply.name, ply.history[name][1]) for ply in run.plies if name in ply.history]
        curves = [(ply, values) for ply, values in curves if np.isfinite(values).any()]
        if curves:
            charts.append(chart(column.word, column.label, column.unit, curves))
    energies = [(column.label, values) for column, values in run.energies.values()
                if np.nanmax(abs(values), initial=0.0) > 0.0]
    if energies:
        charts.append(chart("energies", "energies", "mJ", energies))
    return charts


def chart(word: str, label: str, unit: str, curves) -> dict:
    factor = FACTORS.get(unit, 1.0)
    return {"id": word, "title": label[:1].upper() + label[1:], "unit": UNITS.get(unit, unit),
            "lines": lines((name, factor * values) for name, values in curves)}


def lines(named) -> list[dict]:
    """None where a value is not known."""
    return [{"name": name, "values": [float(f"{v:.7g}") if np.isfinite(v) else None for v in values]}
            for name, values in named]
