# SPDX-License-Identifier: GPL-3.0-or-later
"""Laws of several laboratories with mean and scatter, as `plyform identify` writes them."""

import argparse
import csv

import numpy as np
from matplotlib import pyplot
from matplotlib.figure import Figure

from .looks import COLOURS, finish
from .reading import Trouble

KNOWN = ["shear_deg", "mean_Nmm", "between_Nmm", "within_Nmm", "laboratories"]


def draw(options: argparse.Namespace) -> Figure:
    with open(options.table, encoding="utf-8", newline="") as file:
        names, *rows = list(csv.reader(file)) or [[]]
    if names[:len(KNOWN)] != KNOWN or not rows:
        raise Trouble(f"{options.table} is no table of laboratories: its columns must be "
                      f"{', '.join(KNOWN)} and one for each")
    try:
        values = np.array([[float(cell) if cell else np.nan for cell in row] for row in rows])
    except ValueError as error:
        raise Trouble(f"{options.table}: {error}") from error
    angle, mean, between = values[:, 0], values[:, 1], values[:, 2]
    figure, axes = pyplot.subplots(figsize=(7.5, 5.0), layout="constrained")
    axes.fill_between(angle, mean - between, mean + between, color="black", alpha=0.12, lw=0,
                      label="± one standard deviation")
    for number, name in enumerate(names[len(KNOWN):]):
        axes.plot(angle, values[:, len(KNOWN) + number], lw=1.2,
                  color=COLOURS[number % len(COLOURS)], label=name)
    axes.plot(angle, mean, color="black", lw=2.2, label="mean")
    axes.set(xlabel="shear angle (degrees)", ylabel="torque of a cell (N mm)",
             title=options.table.stem)
    axes.legend(frameon=False)
    finish((axes,))
    return figure
