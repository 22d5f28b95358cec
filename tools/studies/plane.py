# SPDX-License-Identifier: GPL-3.0-or-later
"""Two keys as axes of a picture."""

import matplotlib.pyplot as plt
import numpy as np
from base.summary_file import SOUND
from studies.ranking import is_number
from studies.shown import Picture

MARKS = {"stopped": "x", "failed": "+", "refused": "+"}


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
    return names is None and len(values) > 0 and values.min() > 0 and values.max() >= 10 * values.min()


def edges(ticks: np.ndarray, wide: bool) -> np.ndarray:
    """Borders of cells around sorted values, at least two: half-way between, and at the outermost
    values, as nothing was run beyond them."""
    at = np.log(ticks) if wide else ticks
    inner = np.concatenate([[at[0]], 0.5 * (at[1:] + at[:-1]), [at[-1]]])
    return np.concatenate([ticks[:1], np.exp(inner[1:-1]) if wide else inner[1:-1], ticks[-1:]])


class Plane:
    """Two keys as axes, with the rows that vary them."""

    def __init__(self, picture: Picture, rows: list[dict], axes=None):
        self.picture = picture
        self.rows = [row for row in rows if row["line"] != "reference" and row[picture.x] != ""
                     and row[picture.y] != "" and row["status"] != "missing"]
        self.x, self.x_names = places(self.rows, picture.x)
        self.y, self.y_names = places(self.rows, picture.y)
        self.wide = [is_wide(self.x, self.x_names), is_wide(self.y, self.y_names)]
        self.figure, self.axes = (None, axes) if axes is not None else \
            plt.subplots(figsize=(6.4, 4.8), layout="constrained")
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
