#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws which shear angle is positive, for docs/users/fabrics.md.

    shear_sign_picture.py -o PICTURE
"""

import argparse
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")  # draws into a file, needs no screen
import matplotlib.pyplot as plt  # noqa: E402

FIRST, SECOND, DIAGONAL = "#0072B2", "#D55E00", "#009E73"


def cell(axis: plt.Axes, gamma: float, title: str) -> None:
    """A unit cell sheared by gamma (degrees) about its diagonal first + second."""
    half = np.radians(45.0 - 0.5 * gamma)
    first = np.array([np.cos(half), -np.sin(half)])
    second = np.array([np.cos(half), np.sin(half)])
    corner = -0.5 * (first + second)
    for offset in np.linspace(0.0, 1.0, 5):
        for along, beside, colour in ((first, second, FIRST), (second, first, SECOND)):
            start = corner + offset * beside
            axis.plot(*zip(start, start + along), color=colour, lw=1.2, alpha=0.5)
    for along, colour, name in ((first, FIRST, "first"), (second, SECOND, "second")):
        axis.annotate("", corner + along, corner,
                      arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 2.5})
        axis.text(*(corner + 0.55 * along + (0.0, 0.16 * np.sign(along[1]))), name, color=colour,
                  ha="right", va="center", fontsize=11)
    axis.annotate("", corner + first + second, corner,
                  arrowprops={"arrowstyle": "<|-|>", "color": DIAGONAL, "lw": 1.5, "ls": "--"})
    axis.set_title(title, fontsize=11)
    axis.set_xlim(-1.05, 1.05)
    axis.set_ylim(-0.95, 0.95)
    axis.set_aspect("equal")
    axis.axis("off")


def main() -> None:
    parser = argparse.ArgumentParser(prog="shear_sign_picture.py",
                                     description=__doc__.split("\n", 1)[0])
    parser.add_argument("-o", type=Path, required=True, dest="picture")
    options = parser.parse_args()
    figure, axes = plt.subplots(1, 3, figsize=(9, 3.2))
    cell(axes[0], -35.0, "γ < 0: the angle opens,\nfirst + second gets shorter")
    cell(axes[1], 0.0, "γ = 0\nas the fabric comes")
    cell(axes[2], 35.0, "γ > 0: the angle closes,\nfirst + second gets longer")
    figure.tight_layout()
    figure.savefig(options.picture, dpi=90, bbox_inches="tight")


if __name__ == "__main__":
    main()
