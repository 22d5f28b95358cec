# SPDX-License-Identifier: GPL-3.0-or-later
"""Measured against fitted forces, as `plyform identify` writes them."""

import argparse

import numpy as np
from matplotlib import pyplot
from matplotlib.figure import Figure

from .looks import COLOURS, finish, limit_deviation
from .numbers import deviation
from .reading import Trouble, read_table

ABSCISSAE = {"shear": ("shear_deg", 1.0, "shear angle (degrees)"),
             "displacement": ("displacement_mm", 1.0, "displacement (mm)"),
             "strain": ("strain", 100.0, "strain (%)"),
             "stretch": ("stretch", 1.0, "stretch"),
             "time": ("time_s", 1.0, "time after the stop (s)")}


def draw(options: argparse.Namespace) -> Figure:
    table = read_table(options.fit, [])
    unit = "MPa" if "measured_MPa" in table else "N"
    table = read_table(options.fit, [f"measured_{unit}", f"fitted_{unit}"])
    measured, fitted = table[f"measured_{unit}"], table[f"fitted_{unit}"]
    there = [name for name, (column, _, _) in ABSCISSAE.items() if column in table]
    against = options.against or (there[0] if there else "shear")
    if against not in there:
        raise Trouble(f"{options.fit} has no column {ABSCISSAE[against][0]}: "
                      f"it has {', '.join(table)}")
    column, factor, label = ABSCISSAE[against]
    figure, (top, bottom) = pyplot.subplots(2, 1, sharex=True, figsize=(7.5, 6.5),
                                            gridspec_kw={"height_ratios": [2.2, 1]},
                                            layout="constrained")
    x = factor * table[column]
    along = np.argsort(x, kind="stable")  # rows of several specimens follow each other
    top.plot(x, measured, "o", mfc="none", ms=5, color="black", label="measured")
    top.plot(x[along], fitted[along], color=COLOURS[1], label="fitted")
    top.set_ylabel("force (N)" if unit == "N" else "nominal stress (MPa)")
    top.set_title(options.fit.stem)
    top.legend()
    bottom.plot(x, deviation(fitted, measured),
                "." if "specimen" in table else ".-", color=COLOURS[1])
    bottom.axhline(0.0, color="black", lw=0.8)
    bottom.set(xlabel=label, ylabel="fitted / measured − 1 (%)")
    limit_deviation(bottom, options.limit)
    finish((top, bottom))
    return figure
