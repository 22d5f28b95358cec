# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours, labels and styles that all pictures share."""

import os
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")  # draws into files, needs no screen

# Okabe and Ito's colours for all kinds of colour vision, without the yellow, too pale on white
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#7F7F7F"]
STYLES = ["-", "--", ":", "-."]  # of overlaid folders, in turn
CURVE_STYLES = ["--", ":", "-.", (0, (5, 1, 1, 1, 1, 1))]  # of theory and measurements, in turn

matplotlib.rcParams["axes.prop_cycle"] = matplotlib.cycler(color=COLOURS)
matplotlib.rcParams["axes.titlesize"] = "medium"
matplotlib.rcParams["legend.fontsize"] = "small"


def colour(i: int) -> str:
    return COLOURS[i % len(COLOURS)]


def folder_labels(folders: list[Path]) -> list[str]:
    """The last part of each path, or as many as it takes to tell them apart."""
    parts = [Path(os.path.abspath(folder)).parts for folder in folders]  # links keep their names
    for depth in range(1, max(map(len, parts)) + 1):
        labels = ["/".join(p[-depth:]) for p in parts]
        if len(set(labels)) == len(set(parts)):
            break
    return labels


def body_name(name: str) -> str:
    return name.replace("_", " ")


def line_looks(groups: list[list[str]]) -> list[list[dict]]:
    """Colour and style of each line (a ply) of each group (a folder). The same ply has the same
    colour everywhere; where every folder has one ply, the folders have the colours."""
    if len(groups) > 1 and all(len(group) == 1 for group in groups):
        return [[{"color": colour(k), "ls": "-"}] for k in range(len(groups))]
    names = list(dict.fromkeys(name for group in groups for name in group))
    return [[{"color": colour(names.index(name)), "ls": STYLES[k % len(STYLES)]} for name in group]
            for k, group in enumerate(groups)]


def finish(axes) -> None:
    for axis in np.ravel(axes):
        axis.grid(alpha=0.3)


def limit_deviation(axis, largest: float) -> None:
    """Ends an axis of percents at ± `largest` where its lines go beyond."""
    values = np.concatenate([line.get_ydata() for line in axis.lines] + [np.zeros(1)])
    top = np.nanmax(abs(np.asarray(values, dtype=float)))
    top = min(largest, max(1.1 * top, 1.0))
    axis.set_ylim(-top, top)
