# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of a study's table: cost, map, scatter, process window."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from plotting.looks import COLOURS, finish
from plotting.whole_file import make_in
from studies.cost_picture import draw_cost
from studies.plan import Planner
from studies.plies_picture import draw_plies
from studies.plane import SOUND, Plane, is_wide, places, set_axis, short
from studies.ranking import is_number
from studies.shown import Picture
from studies.study_file import Study
from studies.window_picture import draw_window


def draw_map(study: Study, picture: Picture, rows: list[dict]):
    plane = Plane(picture, rows)
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
            figure = draw_cost(study, planner, picture, rows)
        elif picture.kind == "plies":
            figure = draw_plies(study, picture, rows, [one.name for one in planner.vary])
        elif picture.kind == "window":
            figure = draw_window(study, planner, picture, rows)
        else:
            figure = {"map": draw_map, "scatter": draw_scatter}[picture.kind](study, picture, rows)
        dots = 80 if picture.kind == "plies" else 100
        make_in(folder, picture.file, lambda part: figure.savefig(part, dpi=dots))
        plt.close(figure)
