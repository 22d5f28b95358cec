#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the convergence of the bias test's load from tables of locking_study sizes.

    locking_plot.py FILE.csv... -o PICTURE
"""

import argparse
import csv
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")  # draws into a file, needs no screen
import matplotlib.pyplot as plt  # noqa: E402

COLOURS = {"shaken": "#0072B2", "free": "#D55E00"}


def main() -> None:
    parser = argparse.ArgumentParser(prog="locking_plot.py", description=__doc__.split("\n", 1)[0])
    parser.add_argument("tables", nargs="+", type=Path)
    parser.add_argument("-o", type=Path, required=True, dest="picture")
    options = parser.parse_args()
    rows = [row for table in options.tables for row in csv.DictReader(table.open())]
    figure, axes = plt.subplots(1, 3, figsize=(11, 3.6), sharey=True)
    for axis, angle in zip(axes, (10, 20, 30)):
        for element, style in (("plain", "--"), ("averaged", "-")):
            for mesh, colour in COLOURS.items():
                errors = {}
                for row in rows:
                    if (row["element"], row["mesh"]) == (element, mesh):
                        errors.setdefault(float(row["elements_a_width"]), []).append(
                            abs(float(row[f"load_{angle}"]) - 1.0))
                sizes = np.array(sorted(errors))
                if len(sizes) == 0:
                    continue
                rms = np.array([np.sqrt(np.nanmean(np.square(errors[n]))) for n in sizes])
                rate = -np.polyfit(np.log(sizes), np.log(rms), 1)[0]
                axis.loglog(sizes, 100.0 * rms, style, marker="o", color=colour,
                            label=f"{element}, {mesh} mesh: rate {rate:.1f}")
                print(f"{element},{mesh},{angle}," +
                      ",".join(f"{n:g}:{100 * e:.2f} %" for n, e in zip(sizes, rms)) +
                      f",rate {rate:.2f}")
        axis.set_title(f"shear angle {angle}°")
        axis.set_xlabel("elements a width")
        axis.set_xticks([5, 10, 20, 40], ["5", "10", "20", "40"])
        axis.minorticks_off()
        axis.grid(alpha=0.3)
        axis.legend(fontsize=7)
    axes[0].set_ylabel("error of the load, rms over angles, %")
    figure.tight_layout()
    figure.savefig(options.picture, dpi=75)


main()
