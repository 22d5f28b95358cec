# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of each ply over a key: a column of plots a ply, a row of plots a figure or a value of
another key, a line for each combination of the keys that are left."""

import matplotlib.pyplot as plt
from base.summary_file import SOUND
from plotting.looks import STYLES, colour, finish
from plotting.reading import Trouble
from studies.discs import APART
from studies.ranking import is_number
from studies.shown import Picture
from studies.study_file import Study

SIDE = 2.6  # inches of a plot
NONE = "none"


def values_of(rows: list[dict], name: str) -> list:
    """In rising order, as far as they are numbers; what a run does not have last."""
    found = list(dict.fromkeys(row[name] for row in rows if row[name] != ""))
    found = sorted(found) if all(map(is_number, found)) else found
    return found + ([""] if any(row[name] == "" for row in rows) else [])


def text_of(value) -> str:
    return f"{value:g}" if is_number(value) else str(value) or NONE


def number_of(row: dict, figure: str, ply: str) -> float:
    """Of what is compared with nothing, as it is the reference itself, 0."""
    if figure == APART and not row.get("against"):
        return 0.0
    value = row.get(f"{figure}_{ply}")
    return value if is_number(value) else float("nan")


def draw_lines(axis, rows: list[dict], x: str, others: list[str], figure: str, ply: str) -> None:
    places = values_of(rows, x)
    levels = [values_of(rows, name) for name in others]
    for key in dict.fromkeys(tuple(row[name] for name in others) for row in rows):
        line = sorted((row for row in rows if tuple(row[name] for name in others) == key),
                      key=lambda row: places.index(row[x]))
        first, second = ([*(levels[i].index(key[i]) for i in range(min(2, len(key)))), 0, 0])[:2]
        axis.plot([places.index(row[x]) for row in line],
                  [number_of(row, figure, ply) for row in line], "o" + STYLES[second % len(STYLES)],
                  ms=4, color=colour(first), mfc="white" if second else None,
                  label=", ".join(f"{name} {text_of(value)}" for name, value in zip(others, key)))
    axis.set_xticks(range(len(places)), list(map(text_of, places)),
                    rotation=60 if len(places) > 5 else 0)


def draw_plies(study: Study, picture: Picture, rows: list[dict], keys: list[str]):
    own = [row for row in rows if row["line"] not in ("reference", "run", "preset") and
           row["status"] in SOUND]
    plies = list(dict.fromkeys(name.removeprefix(f"{figure}_") for figure in picture.figures
                               for row in own for name in row if name.startswith(f"{figure}_")))
    if not plies:
        raise Trouble(f"no run has {picture.figures[0]} of a ply; a picture of kind plies needs it")
    levels = values_of(own, picture.rows) if picture.rows else [None]
    bands = [(figure, level) for figure in picture.figures for level in levels]
    others = [name for name in keys if name not in (picture.x, picture.rows) and
              len({str(row[name]) for row in own}) > 1]
    head = 0.5 if others else 0.0
    figure = plt.figure(figsize=(SIDE * len(plies), SIDE * len(bands) + head), layout="constrained")
    upper, body = figure.subfigures(2, 1, height_ratios=[head, SIDE * len(bands)]) if head else \
        (None, figure)
    axes = body.subplots(len(bands), len(plies), sharex=True, sharey="row", squeeze=False)
    finish(axes)
    for line, (name, level) in zip(axes, bands):
        for axis, ply in zip(line, plies):
            draw_lines(axis, [row for row in own if level is None or row[picture.rows] == level],
                       picture.x, others, name, ply)
        line[0].set_ylabel(name if level is None else f"{picture.rows} {text_of(level)}\n{name}")
    for name in picture.figures:  # rows of one figure have one scale
        same = [line[0] for line, band in zip(axes, bands) if band[0] == name]
        top = max(axis.get_ylim()[1] for axis in same)
        for axis in same:
            axis.set_ylim(0.0, top)
    for axis, ply in zip(axes[0], plies):
        axis.set_title(ply)
    for axis in axes[-1]:
        axis.set_xlabel(picture.x)
    if upper:
        known = dict(zip(*reversed(axes[0][0].get_legend_handles_labels())))
        upper.legend(known.values(), known, loc="center", ncol=len(known), frameon=False)
    return figure
