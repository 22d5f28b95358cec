# SPDX-License-Identifier: GPL-3.0-or-later
"""A field along a straight section of the unformed plies, and the formed profile there."""

import argparse

import numpy as np
from matplotlib import pyplot
from matplotlib.figure import Figure

from base.results_file import Column

from .looks import CURVE_STYLES, finish, folder_labels, line_looks
from .numbers import Section, polar_angle, section
from .reading import Trouble, read_states, read_table


def draw(options: argparse.Namespace) -> Figure:
    angle = options.against == "angle"
    if angle != (options.centre is not None):
        raise Trouble("--against angle and --centre X Y Z go together")
    states = read_states(options.folders, options.field, options.ply, options.frame)
    field = states[0].field
    looks = line_looks([[ply.name for ply in state.plies] for state in states])
    figure, axes = pyplot.subplots(2, 1, figsize=(8.5, 7.5), layout="constrained")
    for state, label, styles in zip(states, folder_labels(options.folders), looks):
        for ply, look in zip(state.plies, styles):
            try:
                cut = section(ply.x0, ply.x, ply.triangles, ply.value, options.through,
                              options.direction)
            except Trouble as problem:
                raise Trouble(f"{state.folder}, ply {ply.name}: {problem}") from problem
            x = polar_angle(cut.formed, cut.ends, np.array(options.centre)) if angle else cut.ends
            name = f"{label}: {ply.name}" if len(states) > 1 else ply.name
            axes[0].plot(*steps(x, abs(cut.value) if options.magnitude else cut.value, cut),
                         label=name, lw=1.3, **look)
            axes[1].plot(*profile(cut, options), label=name, lw=1.3, **look)
    add_curves(axes[0], field, options)
    axes[0].set_xlabel(f"polar angle seen from ({', '.join(f'{c:g}' for c in options.centre)}) mm "
                       "(degrees)" if angle else distance_label(options))
    axes[0].set_ylabel(f"{'magnitude of the ' if options.magnitude else ''}{field.label} "
                       f"({field.shown_unit})")
    axes[0].legend(loc="upper left", bbox_to_anchor=(1.01, 1.0))
    axes[1].set(xlabel="horizontal distance along the section, formed (mm)", ylabel="height z (mm)")
    axes[1].set_aspect("equal", adjustable="datalim")
    finish(axes)
    return figure


def distance_label(options: argparse.Namespace) -> str:
    x, y = options.through
    return f"distance from ({x:g}, {y:g}) at {options.direction:g}° in the unformed ply (mm)"


def steps(x: np.ndarray, value: np.ndarray, cut: Section) -> tuple[np.ndarray, np.ndarray]:
    """A level line over each piece, with a break at holes."""
    x, y = x.reshape(-1), np.repeat(value, 2)
    holes = np.flatnonzero(gaps(cut)) + 1
    return np.insert(x, 2 * holes, np.nan), np.insert(y, 2 * holes, np.nan)


def profile(cut: Section, options: argparse.Namespace) -> tuple[np.ndarray, np.ndarray]:
    direction = np.radians(options.direction)
    points = cut.formed.reshape(-1, 3)
    along = (points[:, :2] - options.through) @ [np.cos(direction), np.sin(direction)]
    holes = np.flatnonzero(gaps(cut)) + 1
    return np.insert(along, 2 * holes, np.nan), np.insert(points[:, 2], 2 * holes, np.nan)


def gaps(cut: Section) -> np.ndarray:
    return cut.ends[1:, 0] - cut.ends[:-1, 1] > 1e-6 * np.ptp(cut.ends)


def add_curves(axis, field: Column, options: argparse.Namespace) -> None:
    where = "angle_deg" if options.against == "angle" else "distance_mm"
    column = "shear_deg" if field.name == "shear_angle_deg" else field.name  # as tests call it
    for i, path in enumerate(options.curve):
        curve = read_table(path, [where, column])
        y = curve[column] * field.factor
        axis.plot(curve[where], abs(y) if options.magnitude else y, color="black", lw=1.5,
                  ls=CURVE_STYLES[i % len(CURVE_STYLES)], label=path.stem)
