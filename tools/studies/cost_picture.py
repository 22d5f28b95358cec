# SPDX-License-Identifier: GPL-3.0-or-later
"""Error against time, both logarithmic: a line a key, the case as a large dot, presets as diamonds
with a bar at the error that they promise, as a grey step line the runs that no other beats in both,
the reference's time on the lower edge, stopped runs as crosses on the upper one. The error of a
field, or of a figure in percent of the reference's; only the former has promises and a step line."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import LogFormatter
from matplotlib.transforms import Bbox
from plotting.looks import colour, finish
from studies.errors import main_error, mark_front
from studies.plan import Planner
from studies.ranking import is_number
from studies.shown import Picture
from studies.study_file import Study

GREY = "#7F7F7F"
AROUND = [(0, 7), (0, -7), (8, 0), (-8, 0), (7, 6), (-7, 6), (7, -6), (-7, -6), (0, 15), (0, -15)]


def place_labels(axes, points: list[tuple[float, float, str, str]]) -> None:
    """Each label beside its point where it covers least of what is there."""
    axes.figure.canvas.draw()
    renderer = axes.figure.canvas.get_renderer()
    taken = [Bbox.from_bounds(x - 4, y - 4, 8, 8)
             for x, y in axes.transData.transform([(x, y) for x, y, _, _ in points])]
    frame = axes.get_window_extent(renderer)
    for x, y, text, ink in points:
        best, least, box = None, np.inf, None
        for right, up in AROUND:
            label = axes.annotate(text, (x, y), (right, up), textcoords="offset points",
                                  fontsize=7, color=ink, annotation_clip=False,
                                  ha="center" if right == 0 else "left" if right > 0 else "right",
                                  va="center" if up == 0 else "bottom" if up > 0 else "top")
            own = label.get_window_extent(renderer)
            covers = [Bbox.intersection(own, other) for other in taken]
            cost = sum(one.width * one.height for one in covers if one) + 0.1 * np.hypot(right, up)
            inside = Bbox.intersection(own, frame)
            cost += own.width * own.height - (inside.width * inside.height if inside else 0)
            if cost < least:
                if best:
                    best.remove()
                best, least, box = label, cost, own
            else:
                label.remove()
        taken.append(box)


def errors_of_figure(name: str, rows: list[dict]) -> dict[int, float]:
    """Distances from the reference, in percent of it, by the numbers of the rows."""
    aim = next((row.get(name) for row in rows if row["line"] == "reference"), None)
    if not is_number(aim) or aim == 0:
        return {}
    return {i: 100.0 * abs(row[name] / aim - 1.0) for i, row in enumerate(rows)
            if is_number(row.get(name)) and row["line"] != "reference"}


def draw_cost(study: Study, planner: Planner, picture: Picture, rows: list[dict]):
    time = picture.x
    if not picture.figure:
        error, field = main_error(study), study.fields[study.reference.fields[0]]
        shown = f"error of the {field.label} against the reference, rms, {field.shown_unit}"
        rows = [dict(row) for row in rows]
        mark_front(rows, error, time)
    else:
        error = f"{picture.figure}, % off"
        shown = f"error of {picture.figure} against the reference, %"
        found = errors_of_figure(picture.figure, rows)
        rows = [row | {"on_front": False, "promised_error_deg": "", error: found.get(i, "")}
                for i, row in enumerate(rows)]
    figure, axes = plt.subplots(figsize=(8.0, 5.6), layout="constrained")
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis in (axes.xaxis, axes.yaxis):  # 3, not 3 x 10^0
        axis.set_major_formatter(LogFormatter(labelOnlyBase=False))
        axis.set_minor_formatter(LogFormatter(labelOnlyBase=False, minor_thresholds=(2, 0.5)))
    good = [row for row in rows if is_number(row.get(error)) and row[error] > 0]
    labels = []

    def points(own: list[dict]) -> tuple[list, list]:
        return [row[time] for row in own], [row[error] for row in own]
    case = [row for row in good if row["line"] == "case"]
    for i, one in enumerate(planner.vary):
        own = [row for row in good if row["line"] == one.name]
        line = own + (case if all(is_number(row[one.name]) for row in own + case) else [])
        if all(is_number(row[one.name]) for row in line):
            line.sort(key=lambda row: row[one.name])
        axes.plot(*points(line), color=colour(i), lw=1.2, zorder=2)
        axes.plot(*points(own), "o", color=colour(i), ms=5, label=one.name, zorder=3)
        labels += [(row[time], row[error], row["setting"], colour(i)) for row in own]
    others = [row for row in good if row["line"] in (study.method, "run")]
    axes.plot(*points(others), "o", color=GREY, ms=4, label=None if not others else study.method)
    axes.plot(*points(case), "o", color="black", ms=9, label="case" if case else None, zorder=4)
    presets = [row for row in good if row["line"] == "preset"]
    axes.plot(*points(presets), "D", color="black", ms=6, zorder=4)
    for row in presets:
        labels.append((row[time], row[error], row["setting"], "black"))
        if is_number(row.get("promised_error_deg")):
            axes.plot(row[time], row["promised_error_deg"], "_", color="black", ms=12)
    front = sorted((row for row in good if row.get("on_front")), key=lambda row: row[time])
    if front:
        axes.step(*points(front), where="post", color=GREY, lw=4, alpha=0.35, zorder=1,
                  label="best for their time")
    finish(axes)
    edge = {"transform": axes.get_xaxis_transform(), "clip_on": False, "color": "black"}
    for row in rows:
        if row["line"] == "reference" and is_number(row[time]):
            axes.plot(row[time], 0, "^", **edge)
            axes.annotate("reference", (row[time], 0), (0, 8), xycoords=axes.get_xaxis_transform(),
                          textcoords="offset points", ha="right", fontsize=7)
        if row["status"] == "stopped" and is_number(row[time]):
            axes.plot(row[time], 1, "x", **edge)
    axes.set_xlabel("wall time, s" if time == "wall_time_s" else "processor time, s")
    axes.set_ylabel(shown)
    axes.set_title(picture.title)
    axes.legend()
    if labels:
        place_labels(axes, labels)
    return figure
