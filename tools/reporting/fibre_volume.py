# SPDX-License-Identifier: GPL-3.0-or-later
"""Fibre volume of plies and of their stack, of runs that know it: a card of the report, and a histogram of
the area by it."""

from dataclasses import dataclass

import numpy as np
from markupsafe import Markup

from .answers import Answer, Place, at_place, middle, percent
from .reading_run import PlyStates, Run

COLUMN, OF_STACK = "fibre_volume", "stack_fibre_volume"
STACK = "the stack in the mould"
BINS = 30     # of a histogram, about
STEPS = (0.002, 0.005, 0.01, 0.02, 0.05)  # widths of bins that can be read off


@dataclass
class Shares:
    """Values of triangles in the last state, with their areas now."""
    name: str
    values: np.ndarray  # m
    areas: np.ndarray   # m, mm2
    ply: int            # number of the ply that the triangles are of
    rows: np.ndarray    # m, numbers of the triangles

    @property
    def mean(self) -> float:
        return float((self.values * self.areas).sum() / self.areas.sum())


def areas_of(ply: PlyStates) -> np.ndarray:
    a, b, c = (ply.x[-1][ply.triangles[:, k]] for k in range(3))
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)


def of_column(run: Run, k: int, column: str, name: str) -> Shares | None:
    """Where it is not 0, which says that there is none."""
    ply = run.plies[k]
    if column not in ply.cells:
        return None
    rows = np.flatnonzero(ply.cells[column][-1] > 0.0)
    return Shares(name, ply.cells[column][-1][rows], areas_of(ply)[rows], k, rows) if len(rows) else None


def of_plies(run: Run) -> list[Shares]:
    found = [of_column(run, k, COLUMN, ply.name) for k, ply in enumerate(run.plies)]
    return [one for one in found if one]


def of_stack(run: Run) -> Shares | None:
    """By the ply that has most of it; every ply has the stack's value at its place."""
    found = [of_column(run, k, OF_STACK, STACK) for k in range(len(run.plies))]
    return max((one for one in found if one), key=lambda one: one.areas.sum(), default=None)


def card(run: Run, index: int) -> Answer | None:
    plies, stack = of_plies(run), of_stack(run)
    if not plies:
        return None
    main = stack or max(plies, key=lambda one: one.values.max())
    low, high = min(plies, key=lambda one: one.values.min()), max(plies, key=lambda one: one.values.max())
    text = Markup("Mean of <b>{}</b>").format(main.name)
    if stack:
        text += Markup(", which has {} to {}&nbsp;%").format(
            percent(float(stack.values.min()), 1), percent(float(stack.values.max()), 1))
    means = [Markup("{} {}").format(one.name, percent(one.mean, 1)) for one in plies]
    text += Markup(". Plies by themselves: least {}&nbsp;% in <b>{}</b>{}, largest {}&nbsp;% in <b>{}</b>{}; means {}"
                   "&nbsp;%.").format(
        percent(float(low.values.min()), 1), low.name, where(run, low, int(low.values.argmin())),
        percent(float(high.values.max()), 1), high.name, where(run, high, int(high.values.argmax())),
        Markup(", ").join(means))
    return Answer("Fibre volume", Markup("{}&nbsp;%").format(percent(main.mean, 1)), text,
                  Place(index, high.ply, int(high.rows[high.values.argmax()]), "fibre-volume"))


def where(run: Run, shares: Shares, k: int) -> Markup:
    return Markup(" at {}").format(at_place(middle(run.plies[shares.ply], int(shares.rows[k]))))


def histograms_of(run: Run) -> list[dict]:
    """Shares of the area (%) over the fibre volume (%), a line for each ply and for the stack."""
    plies, stack = of_plies(run), of_stack(run)
    shares = [*plies, *([stack] if stack else [])]
    if not shares:
        return []
    low, high = min(one.values.min() for one in shares), max(one.values.max() for one in shares)
    step = next((step for step in STEPS if (high - low) / step <= BINS), STEPS[-1])
    first = np.floor(low / step)
    edges = step * np.arange(first, max(np.ceil(high / step), first + 1) + 1)
    middles = 50.0 * (edges[:-1] + edges[1:])
    lines = [{"name": one.name, "values": shown(100.0 * np.histogram(one.values, edges, weights=one.areas)[0]
                                                / one.areas.sum()),
              "mean": shown(100.0 * one.mean), "least": shown(100.0 * one.values.min()),
              "largest": shown(100.0 * one.values.max())} for one in shares]
    return [{"id": "fibre-volume", "title": "Fibre volume", "unit": "% of the area", "step": shown(100.0 * step),
             "along": {"word": "fibre volume", "unit": "%"}, "at": shown(middles), "lines": lines}]


def shown(values):
    return float(f"{values:.5g}") if np.ndim(values) == 0 else [float(f"{value:.5g}") for value in values]
