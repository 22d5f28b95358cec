# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of a study's table: cost, map, scatter, process window."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from plotting.looks import COLOURS, colour, finish
from plotting.reading import FIELDS
from studies.cost_picture import draw_cost
from studies.plan import Planner
from studies.plies_picture import draw_plies
from studies.ranking import is_number
from studies.shown import Picture
from studies.study_file import Study

SOUND = ("done", "doubtful")
MARKS = {"stopped": "x", "failed": "+", "refused": "+"}
WITHIN = "#CFE8D5"  # pale green: the window; what lies outside has stronger colours


def places(rows: list[dict], name: str) -> tuple[np.ndarray, list[str] | None]:
    """Where rows stand along a key, and names of the places where it is no number."""
    values = [row[name] for row in rows]
    if all(map(is_number, values)):
        return np.array(values, dtype=float), None
    names = list(dict.fromkeys(map(str, values)))
    return np.array([names.index(str(value)) for value in values], dtype=float), names


def short(value: float) -> str:
    """Three digits, without an exponent for what is not tiny or huge."""
    return f"{value:.0f}" if 100 <= abs(value) < 1e6 else f"{value:.3g}"


def set_axis(axis, values: np.ndarray, names: list[str] | None, label: str, wide: bool) -> None:
    axis.set_label_text(label)
    if names:
        axis.set_ticks(range(len(names)), names)
    elif wide:
        axis._set_axes_scale("log")
        ticks = np.unique(values)
        if len(ticks) <= 8:
            axis.set_ticks(ticks, list(map(short, ticks)))
            axis.set_ticks([], minor=True)


def is_wide(values: np.ndarray, names) -> bool:
    return names is None and values.min() > 0 and values.max() >= 20 * values.min()


def edges(ticks: np.ndarray, wide: bool) -> np.ndarray:
    """Borders of cells around sorted values, half-way between."""
    at = np.log(ticks) if wide else ticks
    if len(at) == 1:
        inner = np.array([at[0] - 0.5, at[0] + 0.5])
    else:
        middle = 0.5 * (at[1:] + at[:-1])
        inner = np.concatenate([[2 * at[0] - middle[0]], middle, [2 * at[-1] - middle[-1]]])
    return np.exp(inner) if wide else inner


class Plane:
    """Two keys as axes, with the rows that vary them."""

    def __init__(self, study: Study, picture: Picture, rows: list[dict]):
        self.picture = picture
        self.rows = [row for row in rows if row["line"] != "reference" and row[picture.x] != ""
                     and row[picture.y] != "" and row["status"] != "missing"]
        self.x, self.x_names = places(self.rows, picture.x)
        self.y, self.y_names = places(self.rows, picture.y)
        self.wide = [is_wide(self.x, self.x_names), is_wide(self.y, self.y_names)]
        self.figure, self.axes = plt.subplots(figsize=(6.4, 4.8), layout="constrained")
        set_axis(self.axes.xaxis, self.x, self.x_names, picture.x, self.wide[0])
        set_axis(self.axes.yaxis, self.y, self.y_names, picture.y, self.wide[1])
        self.axes.set_title(picture.title)

    def grid(self, values: np.ndarray) -> tuple | None:
        """Values by row and column, if there is one at every crossing."""
        ticks = np.unique(self.x), np.unique(self.y)
        if len(ticks[0]) * len(ticks[1]) != len(set(zip(self.x, self.y))) or \
                min(map(len, ticks)) < 2:
            return None
        table = np.full((len(ticks[1]), len(ticks[0])), np.nan)
        table[np.searchsorted(ticks[1], self.y), np.searchsorted(ticks[0], self.x)] = values
        return edges(ticks[0], self.wide[0]), edges(ticks[1], self.wide[1]), table

    def mark_lost(self) -> None:
        for status, mark in MARKS.items():
            here = np.array([row["status"] == status for row in self.rows])
            if here.any():
                self.axes.scatter(self.x[here], self.y[here], marker=mark, color="black",
                                  label=status, zorder=3)


def draw_map(study: Study, picture: Picture, rows: list[dict]):
    plane = Plane(study, picture, rows)
    values = np.array([row[picture.figure] if row["status"] in SOUND and
                       is_number(row.get(picture.figure)) else np.nan for row in plane.rows],
                      dtype=float)
    if grid := plane.grid(values):
        shown = plane.axes.pcolormesh(*grid, cmap="viridis")
        for x, y, value in zip(plane.x, plane.y, values):
            if np.isfinite(value):
                plane.axes.annotate(short(value), (x, y), ha="center", va="center", fontsize=8,
                                    bbox={"boxstyle": "round,pad=0.1", "fc": "white", "ec": "none",
                                          "alpha": 0.7})
    else:
        shown = plane.axes.scatter(plane.x, plane.y, c=values, cmap="viridis", s=60)
    plane.figure.colorbar(shown, label=picture.figure)
    plane.mark_lost()
    if plane.axes.get_legend_handles_labels()[0]:
        plane.axes.legend()
    return plane.figure


def draw_window(study: Study, picture: Picture, rows: list[dict]):
    """Where all limits are kept, and elsewhere the first that is not."""
    plane = Plane(study, picture, rows)
    kinds = ["", *study.limits, *MARKS]
    which = np.array([kinds.index(row["breaks"]) for row in plane.rows])
    looks = [WITHIN, *(colour(i) for i in range(len(study.limits))), *(["#DDDDDD"] * len(MARKS))]
    grid = plane.grid(which.astype(float))
    for kind in sorted(set(which)):
        limit = study.limits.get(kinds[kind])
        label = "within all limits" if kind == 0 else f"ended {kinds[kind]}" if limit is None else \
            f"{kinds[kind]} above {limit.at_most:g}" if np.isfinite(limit.at_most) and \
            not np.isfinite(limit.at_least) else f"{kinds[kind]} out of limits"
        here = which == kind
        plane.axes.scatter(plane.x[here], plane.y[here], marker="s" if not grid else "o",
                           s=60 if not grid else 25, color=looks[kind], edgecolor="black",
                           linewidth=0.6, label=label, zorder=3)
    if grid:
        from matplotlib.colors import BoundaryNorm, ListedColormap
        plane.axes.pcolormesh(*grid, cmap=ListedColormap(looks), alpha=0.75,
                              norm=BoundaryNorm(np.arange(len(looks) + 1) - 0.5, len(looks)))
    plane.axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=2)
    return plane.figure


def draw_scatter(study: Study, picture: Picture, rows: list[dict]):
    own = [row for row in rows if row["status"] in SOUND and row["line"] != "reference" and
           row.get(picture.x, "") != "" and row.get(picture.y, "") != ""]
    figure, axes = plt.subplots(figsize=(6.4, 4.8), layout="constrained")
    x, x_names = places(own, picture.x)
    y, y_names = places(own, picture.y)
    lines = list(dict.fromkeys(row["line"] for row in own))
    for i, line in enumerate(lines):
        here = np.array([row["line"] == line for row in own])
        axes.scatter(x[here], y[here], color=COLOURS[i % len(COLOURS)], label=line)
    set_axis(axes.xaxis, x, x_names, picture.x, len(own) > 0 and is_wide(x, x_names))
    set_axis(axes.yaxis, y, y_names, picture.y, False)
    axes.set_title(picture.title)
    finish(axes)
    if len(lines) > 1:
        axes.legend()
    return figure


def draw_all(study: Study, planner: Planner, rows: list[dict], folder: Path) -> None:
    for picture in study.pictures:
        if picture.kind == "cost":
            field = study.reference.fields[0]
            figure = draw_cost(study, planner, picture, rows, FIELDS[field])
        elif picture.kind == "plies":
            figure = draw_plies(study, picture, rows, [one.name for one in planner.vary])
        else:
            figure = {"map": draw_map, "window": draw_window,
                      "scatter": draw_scatter}[picture.kind](study, picture, rows)
        figure.savefig(folder / picture.file, dpi=80 if picture.kind == "plies" else 100)
        plt.close(figure)
