# SPDX-License-Identifier: GPL-3.0-or-later
"""Forces and energies of runs over the stroke or the time, and force-displacement curves."""

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import numpy as np
from matplotlib import pyplot
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from .looks import (CURVE_STYLES, STYLES, body_name, colour, finish, folder_labels,
                    limit_deviation)
from .numbers import deviation, interpolate
from .reading import Trouble, read_history, read_table

History = dict[str, np.ndarray]


@dataclass
class Row:
    """A row of axes, one a folder, with the same lines in each."""
    title: str
    label: str                                # of the axis
    lines: Callable[[History], History]       # by name
    log_decades: float | None = None          # None: linear; else decades below the largest


def forces(history: History) -> History:
    return {body_name(name.removesuffix("_force_N")): values
            for name, values in history.items() if name.endswith("_force_N")}


def energies(history: History) -> History:
    return {body_name(name.removesuffix("_mJ")): values
            for name, values in history.items() if name.endswith("_mJ")}


def ratios(history: History) -> History:
    """Kinetic over shear energy, and the balance error; not where there is next to no energy yet:
    both are quotients of round-off there."""
    total = np.max([abs(values) for values in energies(history).values()], axis=0)
    enough = total > 1e-9 * total.max()
    kinetic, shear = history["kinetic_mJ"], history["shear_mJ"]
    ratio = np.divide(kinetic, shear, out=np.full(len(shear), np.nan), where=enough & (shear > 0.0))
    balance = np.where(enough, abs(history["balance_error"]), np.nan)
    return {"kinetic / shear": ratio, "balance error, magnitude": balance}


FORCES = Row("body", "reaction against its direction (N)", forces)
ENERGIES = Row("energy", "energy or work (mJ)", energies, 5.0)
RATIOS = Row("ratio", "ratio of energies", ratios, 8.0)
ABSCISSAE = {"stroke": ("stroke_mm", 1.0, "stroke (mm)"), "time": ("time_s", 1e3, "time (ms)")}


def draw_history(options: argparse.Namespace) -> Figure:
    return draw_rows(options, [FORCES, ENERGIES])


def draw_energy(options: argparse.Namespace) -> Figure:
    return draw_rows(options, [ENERGIES, RATIOS])


def draw_rows(options: argparse.Namespace, rows: list[Row]) -> Figure:
    histories = [read_history(folder) for folder in options.folders]
    for folder, history in zip(options.folders, histories):
        if not energies(history):
            raise Trouble(f"{folder / 'history.csv'} has no column of an energy, NAME_mJ")
    if options.against is None:
        moves = all(np.any(history["stroke_mm"] != 0.0) for history in histories)
        options.against = "stroke" if moves else "time"
    labels = folder_labels(options.folders)
    columns = 1 if options.overlay else len(histories)
    figure, axes = pyplot.subplots(len(rows), columns, sharex=True, sharey="row", squeeze=False,
                                   figsize=(5.2 * columns + 1.5, 3.5 * len(rows)),
                                   layout="constrained")
    for row, line in zip(rows, axes):
        try:
            draw_row(row, line, histories, options, labels)
        except KeyError as problem:
            raise Trouble(f"a history.csv has no column {problem}") from problem
    for k, axis in enumerate(axes[0]):
        if not options.overlay:
            axis.set_title(labels[k])
    for axis in axes[-1]:
        axis.set_xlabel(ABSCISSAE[options.against][2])
    finish(axes)
    return figure


def draw_row(row: Row, axes, histories: list[History], options: argparse.Namespace,
             labels: list[str]) -> None:
    column, factor, _ = ABSCISSAE[options.against]
    drawn = [row.lines(history) for history in histories]
    top = max([np.nanmax(v, initial=0.0) for lines in drawn for v in lines.values()], default=0.0)
    if row.log_decades:  # what is zero but for round-off: no line from far below
        drawn = [{name: np.where(v > 1e-12 * top, v, np.nan) for name, v in lines.items()}
                 for lines in drawn]
    names = list(dict.fromkeys(name for lines in drawn for name in lines))
    for k, (history, lines) in enumerate(zip(histories, drawn)):
        for name, values in lines.items():
            axes[0 if options.overlay else k].plot(
                factor * history[column], values, color=colour(names.index(name)),
                ls=STYLES[k % len(STYLES)] if options.overlay else "-")
    handles = [Line2D([], [], color=colour(i), label=name) for i, name in enumerate(names)]
    if options.overlay:
        handles += [Line2D([], [], color="grey", ls=STYLES[k % len(STYLES)], label=label)
                    for k, label in enumerate(labels)]
    axes[-1].legend(handles=handles, title=row.title, loc="upper left", bbox_to_anchor=(1.02, 1.0))
    axes[0].set_ylabel(row.label)
    if row.log_decades and top > 0.0:
        axes[0].set_yscale("log")
        values = np.concatenate([v for lines in drawn for v in lines.values()])
        least = values[values > 0.0].min()
        axes[0].set_ylim(max(10.0 ** -row.log_decades * top, 0.5 * least), 3.0 * top)


def body_of(history: History, name: str | None, folder: Path) -> str:
    """The body asked for, or the first driven one: whose displacement is the stroke; else the
    first that moves at all (a body that a force holds down gives way a little)."""
    bodies = [n.removesuffix("_force_N") for n in history if n.endswith("_force_N")]
    bodies = [body for body in bodies if f"{body}_displacement_mm" in history]
    if name is not None:
        if name not in bodies:
            raise Trouble(f"{folder} has no body {name}: it has {', '.join(bodies) or 'none'}")
        return name
    moves = {body: history[f"{body}_displacement_mm"] for body in bodies}
    most = max([np.ptp(u) for u in moves.values()], default=0.0)
    if most == 0.0:
        raise Trouble(f"{folder}: no tool or boundary moves; name one with --of")
    moving = [body for body in bodies if np.ptp(moves[body]) > 1e-3 * most]
    driven = [body for body in moving
              if np.allclose(moves[body], history["stroke_mm"], rtol=1e-6, atol=1e-6 * most)]
    return (driven or moving)[0]


def draw_load(options: argparse.Namespace) -> Figure:
    curves = [read_table(path, ["displacement_mm", "force_N"]) for path in options.curve]
    shear_of = None
    if options.against == "shear":
        shear_of = next(((path, curve) for path, curve in zip(options.curve, curves)
                         if "shear_deg" in curve), None)
        if shear_of is None:
            raise Trouble("--against shear takes a --curve with a column shear_deg, which tells "
                          "the angle at a displacement")
    figure, axes = pyplot.subplots(2 if curves else 1, 1, sharex=True, squeeze=False,
                                   gridspec_kw={"height_ratios": [2.2, 1]} if curves else None,
                                   figsize=(7.5, 6.5 if curves else 4.6), layout="constrained")
    top, bottom, labels = axes[0, 0], axes[-1, 0], folder_labels(options.folders)
    for k, folder in enumerate(options.folders):
        history = read_history(folder)
        body = body_of(history, options.of, folder)
        moved, force = history[f"{body}_displacement_mm"], history[f"{body}_force_N"]
        x = abscissa(moved, shear_of)
        top.plot(x, force, color=colour(k), marker="." if len(moved) < 60 else "",
                 label=f"{labels[k]}: {body_name(body)}")
        for i, (path, curve) in enumerate(zip(options.curve, curves)):
            bottom.plot(x, deviation(force, on_curve(moved, path, curve, "force_N")),
                        color=colour(k), ls=CURVE_STYLES[i % len(CURVE_STYLES)])
    for i, (path, curve) in enumerate(zip(options.curve, curves)):
        x = curve.get("shear_deg") if shear_of else None
        top.plot(abscissa(curve["displacement_mm"], shear_of) if x is None else x,
                 curve["force_N"], color="black", ls=CURVE_STYLES[i % len(CURVE_STYLES)],
                 label=path.stem)
    top.set_ylabel("force against the body's direction (N)")
    top.legend()
    bottom.set_xlabel("shear angle (degrees)" if shear_of else "displacement (mm)")
    if curves:
        bottom.set_ylabel("load / curve − 1 (%)")
        bottom.axhline(0.0, color="black", lw=0.8)
        limit_deviation(bottom, options.limit)
    finish(axes)
    return figure


def abscissa(moved: np.ndarray, shear_of: tuple[Path, History] | None) -> np.ndarray:
    return moved if shear_of is None else on_curve(moved, *shear_of, "shear_deg")


def on_curve(moved: np.ndarray, path: Path, curve: History, column: str) -> np.ndarray:
    try:
        return interpolate(moved, curve["displacement_mm"], curve[column])
    except Trouble as problem:
        raise Trouble(f"{path}: displacement_mm {problem}") from problem
