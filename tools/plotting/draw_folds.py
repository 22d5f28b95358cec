# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts the folds of hanging edges: tells them, writes them as JSON, draws them."""

import argparse
import json

import numpy as np
from matplotlib import pyplot
from matplotlib.figure import Figure

from .folds import Folds, Line, border_line, find_folds, ring_line
from .looks import COLOURS, finish, folder_labels
from .reading import SHEAR, Ply, Trouble, read_states
from .whole_file import write_whole


def draw(options: argparse.Namespace) -> Figure:
    states = read_states(options.folders, SHEAR, options.ply, options.frame)
    measured, records = [], []
    for state, label in zip(states, folder_labels(options.folders)):
        for ply in state.plies:
            try:
                line = (border_line(ply, options.axis) if options.ring is None
                        else ring_line(ply, options.axis, options.ring))
            except Trouble as problem:
                raise Trouble(f"{state.folder}: {problem}") from problem
            folds = find_folds(line, options.depth)
            print(sentence(f"{state.folder} {ply.name}", line, folds))
            records.append(record(str(state.folder), ply, line, folds, options))
            measured.append((f"{label}, {ply.name}" if len(states) > 1 else ply.name, line, folds))
    if options.json:
        write_whole(options.json, json.dumps(records, indent=1) + "\n")
    return draw_lines(measured, options)


def noun(folds: Folds) -> str:
    return f"{len(folds.peaks)} {'fold' if len(folds.peaks) == 1 else 'folds'}"


def sides_per_fold(line: Line, folds: Folds) -> float | None:
    return line.length_mm / line.mean_side_mm / len(folds.peaks) if len(folds.peaks) else None


def sentence(name: str, line: Line, folds: Folds) -> str:
    text = f"{name}: {noun(folds)} deeper than {folds.depth_mm:.3g} mm ({folds.reason})"
    if sides := sides_per_fold(line, folds):
        text += (f", amplitude {folds.amplitude_mm:.3g} mm, largest {folds.largest_mm:.3g} mm, "
                 f"{sides:.1f} triangle sides a fold")
        if sides < 4.0:
            text += ": folds of the mesh's size, take a finer one"
    return text


def record(folder: str, ply: Ply, line: Line, folds: Folds, options: argparse.Namespace) -> dict:
    unit = "mm" if options.ring is None else "deg"
    return {
        "folder": folder, "ply": ply.name, "line": "border" if options.ring is None else "ring",
        "ring_mm": options.ring, "axis_mm": list(options.axis), "points": len(line.where),
        "length_mm": float(line.length_mm), "mean_side_mm": line.mean_side_mm,
        "depth_mm": folds.depth_mm, "depth_is": folds.reason, "folds": len(folds.peaks),
        "amplitude_mm": folds.amplitude_mm, "largest_mm": folds.largest_mm,
        "sides_per_fold": sides_per_fold(line, folds),
        "maxima": [{f"at_{unit}": float(line.where[i]), "distance_mm": float(line.distance[i]),
                    "prominence_mm": float(height)}
                   for i, height in zip(folds.peaks, folds.prominence)],
    }


def draw_lines(measured: list[tuple[str, Line, Folds]], options: argparse.Namespace) -> Figure:
    figure, axes = pyplot.subplots(len(measured), 1, sharex=True, sharey=True, squeeze=False,
                                   figsize=(9.0, 1.2 + 2.4 * len(measured)), layout="constrained")
    for axis, (name, line, folds) in zip(axes[:, 0], measured):
        axis.plot(np.append(line.where, line.round), np.append(line.distance, line.distance[0]),
                  color=COLOURS[0], lw=1.3)
        for points, mark, label in ((folds.peaks, "^", "maxima"), (folds.valleys, "v", "valleys")):
            axis.plot(line.where[points], line.distance[points], mark, ms=6, clip_on=False,
                      zorder=5, color=COLOURS[1 if mark == "^" else 2], label=label)
        axis.set_title(f"{name}: {noun(folds)} deeper than {folds.depth_mm:.3g} mm"
                       + (f", amplitude {folds.amplitude_mm:.3g} mm" if len(folds.peaks) else ""))
        axis.set_xlim(0.0, max(line.round for _, line, _ in measured))
    axes[0, 0].legend(loc="upper left", bbox_to_anchor=(1.01, 1.0))
    if options.ring is None:
        axes[-1, 0].set_xlabel("arc length of the unformed border (mm)")
    else:
        axes[-1, 0].set(xlabel=f"polar angle on the unformed ring of {options.ring:g} mm (degrees)",
                        xticks=range(0, 361, 45))
    figure.supylabel(f"distance from the axis ({options.axis[0]:g}, {options.axis[1]:g}) (mm)",
                     fontsize="medium")
    finish(axes)
    return figure
