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
             "strain": ("strain", 100.0, "strain (%)")}


def draw(options: argparse.Namespace) -> Figure:
    table = read_table(options.fit, ["measured_N", "fitted_N"])
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
    top.plot(x, table["measured_N"], "o", mfc="none", ms=5, color="black", label="measured")
    top.plot(x[along], table["fitted_N"][along], color=COLOURS[1], label="fitted")
    top.set_ylabel("force (N)")
    top.set_title(options.fit.stem)
    top.legend()
    bottom.plot(x, deviation(table["fitted_N"], table["measured_N"]),
                "." if "specimen" in table else ".-", color=COLOURS[1])
    bottom.axhline(0.0, color="black", lw=0.8)
    bottom.set(xlabel=label, ylabel="fitted / measured − 1 (%)")
    limit_deviation(bottom, options.limit)
    finish((top, bottom))
    return figure
