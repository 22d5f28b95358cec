# SPDX-License-Identifier: GPL-3.0-or-later
"""Where all limits of a study are kept over two keys, and elsewhere the first that is not; a plot
for each value of a third key."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.patches import Rectangle
from plotting.looks import colour
from studies.plan import Planner
from studies.plane import MARKS, Plane
from studies.ranking import is_number
from studies.shown import Picture
from studies.study_file import Study

WITHIN = "#CFE8D5"  # pale green: the window; what lies outside has stronger colours


class Kinds:
    """What can become of a run: within all limits, outside of one, or how it ended."""

    def __init__(self, study: Study):
        self.limits, self.names = study.limits, ["", *study.limits, *MARKS]
        self.colours = [WITHIN, *(colour(i) for i in range(len(study.limits))),
                        *(["#DDDDDD"] * len(MARKS))]

    def label(self, kind: int) -> str:
        limit = self.limits.get(self.names[kind])
        if limit is None:
            return "within all limits" if kind == 0 else f"ended {self.names[kind]}"
        above = np.isfinite(limit.at_most) and not np.isfinite(limit.at_least)
        return f"{limit.name} above {limit.at_most:g}" if above else f"{limit.name} out of limits"


def draw_panel(plane: Plane, kinds: Kinds) -> None:
    which = np.array([kinds.names.index(row["breaks"]) for row in plane.rows])
    grid = plane.grid(which.astype(float))
    for kind in sorted(set(which)):
        here = which == kind
        plane.axes.scatter(plane.x[here], plane.y[here], marker="s" if not grid else "o",
                           s=60 if not grid else 25, color=kinds.colours[kind],
                           edgecolor="black", linewidth=0.6, label=kinds.label(kind), zorder=3)
    if grid:
        looks = kinds.colours
        plane.axes.pcolormesh(*grid, cmap=ListedColormap(looks), alpha=0.75,
                              norm=BoundaryNorm(np.arange(len(looks) + 1) - 0.5, len(looks)))
    for x, y, row in zip(plane.x, plane.y, plane.rows):
        if row.get("stop"):
            plane.axes.annotate(row["stop"], (x, y), xytext=(0, 5), textcoords="offset points",
                                ha="center", fontsize="small", zorder=4)


def draw_box(axes, planner: Planner, picture: Picture) -> None:
    """A circle round the case's own values, and a dashed box of a factor about them."""
    own = {one.name: planner.own(one, planner.base) for one in planner.vary}
    x, y, factor = own[picture.x], own[picture.y], picture.around
    if not (factor and is_number(x) and is_number(y)):
        return
    axes.plot([x], [y], "o", ms=13, mfc="none", mec="black", mew=1.5, zorder=4)
    axes.add_patch(Rectangle((x / factor, y / factor), x * (factor - 1 / factor),
                             y * (factor - 1 / factor), fill=False, ls="--", lw=1.5, zorder=4))


def draw_window(study: Study, planner: Planner, picture: Picture, rows: list[dict]):
    values = list(dict.fromkeys(row[picture.panels] for row in rows
                                if row["line"] != "reference")) if picture.panels else [None]
    figure, axes = plt.subplots(1, len(values), figsize=(6.4 if len(values) == 1 else
                                                         4.3 * len(values), 4.8),
                                squeeze=False, layout="constrained")
    kinds, known = Kinds(study), {}
    for axis, value in zip(axes[0], values):
        own = [row for row in rows if value is None or row[picture.panels] == value]
        draw_panel(Plane(picture, own, axis), kinds)
        draw_box(axis, planner, picture)
        if value is not None:
            axis.set_title(str(value))
            figure.suptitle(picture.title, fontsize="medium")
        known.update({text: line for line, text in zip(*axis.get_legend_handles_labels())})
    axes[0][len(values) // 2].legend(known.values(), known, loc="upper center",
                                     bbox_to_anchor=(0.5, -0.13), ncols=2)
    return figure
