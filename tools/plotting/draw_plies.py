# SPDX-License-Identifier: GPL-3.0-or-later
"""Plies from above, coloured by a field, and the stack in 3-D; one scale for all folders."""

import argparse
import math
from dataclasses import dataclass

import numpy as np
from matplotlib import pyplot
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from base.results_file import Column

from .looks import folder_labels
from .numbers import outline
from .reading import State, Trouble, read_states



@dataclass
class Scale:
    """What all axes have in common."""
    field: Column
    colours: ScalarMappable
    low: np.ndarray   # 3, mm: corners of the box round all plies of all folders
    high: np.ndarray


def seen(values: np.ndarray, field: Column) -> np.ndarray:
    """Without signs where both are as bad: shear to the left and to the right."""
    return abs(values) if field.scale == "magnitude" else values


def colours_of(states: list[State], field: Column, limit: float | None) -> ScalarMappable:
    values = [seen(ply.value, field) for state in states for ply in state.plies]
    least, largest = min(v.min() for v in values), max(v.max() for v in values)
    if field.quantity == "shear":
        return ScalarMappable(Normalize(0.0, limit or max(5.0 * math.ceil(largest / 5.0), 5.0)),
                              "viridis")
    if field.scale == "both ways":  # white is zero
        top = limit or max(nice_range(0.0, max(largest, -least))[1], 1e-6)
        return ScalarMappable(Normalize(-top, top), "RdBu_r")
    if field.scale != "whole":
        least = min(least, 0.0)
    low, high = nice_range(least, limit or largest)
    if low >= high:
        raise Trouble(f"--limit {limit:g} is below the smallest {field.label}")
    return ScalarMappable(Normalize(low, high), "viridis")


def nice_range(low: float, high: float) -> tuple[float, float]:
    if high < low:
        return low, high
    if high - low <= 1e-9 * max(abs(low), abs(high)):  # the same everywhere
        low, high = low - 0.01 * abs(low), high + max(0.01 * abs(high), 1e-6)
    ticks = MaxNLocator(8, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
    return float(ticks[ticks <= low + 1e-12].max(initial=ticks[0])), float(ticks[-1])


def summary_of(values: np.ndarray, field: Column) -> str:
    if field.quantity == "shear":
        return f"shear up to {values.max():.1f}°"
    ends = f"{values.min():.3g} to {values.max():.3g}".replace("-", "−")
    return f"{field.label} {ends} {field.shown_unit}"


def turned(points: np.ndarray, degrees: float) -> np.ndarray:
    """Points (... x 3) turned about the z axis, anticlockwise from above."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return points @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])


def turn_states(states: list[State], turns: list[float] | None) -> None:
    turns = turns or [0.0]
    if len(turns) not in (1, len(states)):
        raise Trouble(f"--turn is given {len(turns)} times for {len(states)} folders: "
                      "give it once, or once a folder")
    for k, state in enumerate(states):
        state.turn_deg = turns[k % len(turns)]
        for part in state.plies + state.tools:
            part.x = turned(part.x, state.turn_deg)


def draw_ply(axes, state: State, number: int, edges: list[np.ndarray], scale: Scale) -> None:
    ply = state.plies[number]
    values = seen(ply.value, scale.field)
    axes.tripcolor(ply.x[:, 0], ply.x[:, 1], ply.triangles, facecolors=values,
                   cmap=scale.colours.cmap, norm=scale.colours.norm, antialiased=False,
                   rasterized=True)
    for lines in edges:
        axes.add_collection(LineCollection(lines, colors="tab:red", linewidths=1.0))
    margin = 0.04 * (scale.high - scale.low)[:2].max()
    axes.set(xlim=(scale.low[0] - margin, scale.high[0] + margin),
             ylim=(scale.low[1] - margin, scale.high[1] + margin),
             aspect="equal", xlabel="x (mm)", ylabel="y (mm)")
    short = scale.field.quantity == "shear"
    apart = ", " if short else "\n"
    axes.set_title(f"{ply.name} at {ply.angle_deg:g}°{apart}"
                   f"{summary_of(values, scale.field)}{turn_note(state)}",
                   fontsize="large" if short else "medium")


def turn_note(state: State) -> str:
    return f",\nturned by {state.turn_deg:g}°" if state.turn_deg else ""


def draw_stack(axes, state: State, scale: Scale, options: argparse.Namespace) -> None:
    """All plies as one collection, so that they hide each other; `gap` mm more between them."""
    faces, paint = [], []
    light = np.array([-0.4, -0.5, 0.77])
    for i, ply in enumerate(state.plies):
        corners = ply.x[ply.triangles] + [0.0, 0.0, options.gap * i]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
        colour = scale.colours.to_rgba(seen(ply.value, scale.field))
        colour[:, :3] *= 0.6 + 0.4 * abs(normals @ light)[:, None]
        faces.append(corners)
        paint.append(colour)
    corners, paint = np.concatenate(faces), np.concatenate(paint)
    axes.add_collection3d(Poly3DCollection(corners, facecolors=paint, antialiased=False,
                                           linewidths=0.0, rasterized=True))
    size = np.maximum(scale.high - scale.low, 1e-3 * (scale.high - scale.low).max())
    high = scale.low + size
    axes.set(xlim=(scale.low[0], high[0]), ylim=(scale.low[1], high[1]),
             zlim=(scale.low[2], high[2]))
    axes.set_box_aspect(size, zoom=zoom_for(size, *options.view))
    axes.view_init(*options.view)
    axes.set_axis_off()
    gap = options.gap
    apart = f",\nplies drawn {gap:g} mm further apart" if gap and len(state.plies) > 1 else ""
    reached = f"{state.stroke_mm:.1f} mm of stroke" if state.stroke_mm else f"{1e3 * state.time_s:.1f} ms"
    axes.set_title(f"{reached}{apart}{turn_note(state)}",
                   fontsize="large" if scale.field.quantity == "shear" else "medium")


def zoom_for(size: np.ndarray, elevation: float, azimuth: float) -> float:
    """So that the box just fills its axes: matplotlib scales by the box's diagonal alone."""
    e, a = np.radians(elevation), np.radians(azimuth)
    width = abs(np.sin(a)) * size[0] + abs(np.cos(a)) * size[1]
    depth = abs(np.cos(a)) * size[0] + abs(np.sin(a)) * size[1]
    height = abs(np.sin(e)) * depth + abs(np.cos(e)) * size[2]
    return 0.97 * float(np.linalg.norm(size) / max(width, height))


def box_of(states: list[State], gap: float) -> tuple[np.ndarray, np.ndarray]:
    shift = [np.array([0.0, 0.0, gap * i]) for i in range(max(len(s.plies) for s in states))]
    ends = [(ply.x.min(axis=0) + shift[i], ply.x.max(axis=0) + shift[i])
            for state in states for i, ply in enumerate(state.plies)]
    return np.min([low for low, _ in ends], axis=0), np.max([high for _, high in ends], axis=0)


def draw(options: argparse.Namespace) -> Figure:
    states = read_states(options.folders, options.field, options.ply, options.frame, options.tools)
    field = states[0].field
    turn_states(states, options.turn)
    scale = Scale(field, colours_of(states, field, options.limit), *box_of(states, options.gap))
    above, stack = options.only != "3d", options.only != "above"
    cells = (max(len(state.plies) for state in states) if above else 0) + stack
    # one folder: as square as it gets; several: a row each, to be compared
    in_rows = len(states) > 1 and cells > 1
    together = max(cells, len(states))
    columns = cells if in_rows else together if together < 4 else math.ceil(math.sqrt(together))
    rows = len(states) if in_rows else math.ceil(together / columns)
    flat = (scale.high - scale.low)[:2] / (scale.high - scale.low)[:2].max()
    height_of_words = 1.1 if field.quantity == "shear" and not options.turn else 1.4
    width, height = 0.9 + 2.8 * max(flat[0], 0.55), height_of_words + 3.0 * max(flat[1], 0.55)
    width = max(width, 3.7) if above else 3.7  # a title has to fit
    figure = pyplot.figure(figsize=(width * columns + 0.8, height * rows), layout="constrained")
    every, labels = [], folder_labels(options.folders)
    for k, state in enumerate(states):
        place = 1 + (k * columns if in_rows else k)
        edges = [outline(tool.x, tool.triangles) for tool in state.tools] if above else []
        first = len(every)
        for i in range(len(state.plies) if above else 0):
            every.append(figure.add_subplot(rows, columns, place + i))
            draw_ply(every[-1], state, i, edges, scale)
        if stack:
            place += len(state.plies) if above else 0
            every.append(figure.add_subplot(rows, columns, place, projection="3d"))
            draw_stack(every[-1], state, scale, options)
        if len(states) > 1 and above:
            every[first].set_ylabel(f"{labels[k]}\ny (mm)")
        elif len(states) > 1:
            every[first].set_title(f"{labels[k]}, {every[first].get_title()}", fontsize="medium")
    what = f"magnitude of the {field.label}" if field.scale == "magnitude" else field.label
    if figure.get_figheight() < 3.6:
        what = what.replace("of the ", "of the\n")  # else longer than the scale
    figure.colorbar(scale.colours, ax=every, shrink=0.8, aspect=35, pad=0.02,
                    extend=extend_of(states, scale), label=f"{what} ({field.shown_unit})")
    return figure


def extend_of(states: list[State], scale: Scale) -> str:
    values = [seen(ply.value, scale.field) for state in states for ply in state.plies]
    norm = scale.colours.norm
    over = max(v.max() for v in values) > norm.vmax
    under = min(v.min() for v in values) < norm.vmin
    return {(0, 0): "neither", (0, 1): "max", (1, 0): "min", (1, 1): "both"}[under, over]
