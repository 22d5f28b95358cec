# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of tools/stability_map.py: a cell a run, coloured by what became of it."""

import numpy as np
from matplotlib import pyplot
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from plotting import looks  # noqa: F401  chooses the backend

COLOURS = {"stable": "#A6DBC8", "chatters": "#E69F00", "stopped": "#D55E00", "refused": "#C8C8C8"}
STATES = list(COLOURS)
LETTERS = ("P: a node half through a ply   X: plies cross   S: squeezed   B: energy balance   "
           "N: not finite   C: a triangle collapsed   T: took too long")


def place(values: list[float], value: float) -> float:
    """Where a value stands on an axis of equal cells, by its logarithm between them."""
    logs = np.log([v if v > 0.0 else 1e-9 for v in values])
    return float(np.interp(np.log(value), logs, np.arange(len(values))))


def box(axis, panel, defaults: dict, rows: int) -> None:
    """The defaults, and a factor of two about them. A strip's box goes over all its rows."""
    def span(key, values):
        return (place(values, panel.fixed.get(key, defaults[key]) * f) for f in (0.5, 2.0))
    left, right = span(panel.x, panel.xs)
    bottom, top = span(panel.y, panel.ys) if panel.y else (-0.42, rows - 0.58)
    axis.add_patch(Rectangle((left, bottom), right - left, top - bottom, fill=False, lw=1.5,
                             ls="--", zorder=3))
    x = place(panel.xs, defaults[panel.x])
    ys = [place(panel.ys, defaults[panel.y])] if panel.y else np.arange(rows)
    axis.plot([x] * len(ys), ys, "o", ms=13, mfc="none", mec="black", mew=1.5)


def cells(axis, panel, found: list[list]) -> None:
    """Rows of (state, letter) or None, from below."""
    grid = np.array([[np.nan if cell is None else STATES.index(cell[0]) for cell in row]
                     for row in found])
    axis.imshow(np.ma.masked_invalid(grid), origin="lower", aspect="auto", vmin=-0.5,
                vmax=len(STATES) - 0.5, cmap=ListedColormap(list(COLOURS.values())))
    for j, row in enumerate(found):
        for i, cell in enumerate(row):
            if cell is not None and cell[1]:
                axis.text(i, j, cell[1], ha="center", va="center", fontsize="small")
    axis.set_xticks(range(len(panel.xs)), [f"{x:g}" for x in panel.xs], fontsize="small",
                    rotation=60 if len(panel.xs) > 8 else 0)
    axis.set_xticks(np.arange(len(panel.xs) + 1) - 0.5, minor=True)
    axis.set_yticks(np.arange(len(found) + 1) - 0.5, minor=True)
    axis.grid(which="minor", color="white", lw=0.8)
    axis.tick_params(which="minor", length=0)
    axis.set_xlabel(panel.x)


def draw_map(panels: list, cases: dict[str, str], state_of, defaults: dict,
             largest_jump: float) -> Figure:
    """`cases`: file and title; state_of(case, settings): state and letter, or None if not run."""
    wide = [panel for panel in panels if panel.y]
    strips = [panel for panel in panels if not panel.y]
    heights = [0.8, 3.6 * len(cases), 2.6]
    figure = pyplot.figure(figsize=(13.0, sum(heights)), layout="constrained")
    head, upper, lower = figure.subfigures(3, 1, height_ratios=heights)
    axes = upper.subplots(len(cases), len(wide), squeeze=False)
    for row, (case, title) in zip(axes, cases.items()):
        for axis, panel in zip(row, wide):
            told = [state_of(case, settings) for settings in panel.settings()]
            n = len(panel.xs)
            cells(axis, panel, [told[i:i + n] for i in range(0, len(told), n)])
            axis.set_yticks(range(len(panel.ys)), [f"{y:g}" for y in panel.ys], fontsize="small")
            axis.set_ylabel(panel.y)
            axis.set_title(title)
            box(axis, panel, defaults, 1)
    for axis, panel in zip(np.ravel(lower.subplots(1, len(strips), squeeze=False)), strips):
        cells(axis, panel, [[state_of(case, s) for s in panel.settings()] for case in cases])
        axis.set_yticks(range(len(cases)), list(cases.values()))
        axis.set_title(", ".join(f"{k} {v:g}" for k, v in panel.fixed.items()) or "all else default")
        box(axis, panel, defaults, len(cases))
    means = {"stable": "stable",
             "chatters": f"chatters: die's force jumps, or blank-holder's is off, by more than "
                         f"{100 * largest_jump:g} % of the holding force",
             "stopped": "stopped by plyform", "refused": "value not allowed"}
    used = [s for s in STATES if s != "refused"]
    handles = [Patch(color=COLOURS[s], label=means[s]) for s in used]
    head.legend(handles=handles, loc="center", ncol=3, fontsize="medium", frameon=False,
                title="○ defaults; dashed: a factor of two about them.   " + LETTERS)
    return figure
