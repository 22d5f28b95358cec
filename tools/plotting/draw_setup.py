# SPDX-License-Identifier: GPL-3.0-or-later
"""The section of a case like cases/hemisphere_0, its ply drawn thicker, labelled with its keys."""

import argparse
from pathlib import Path

import numpy as np
from matplotlib import pyplot
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, Polygon

from base.files import read_toml

from .looks import COLOURS
from .reading import Trouble

PLY = 6.0        # mm, drawn thickness: 0.6 mm would be a line
EDGE = 190.0     # mm, where the picture ends on either side
TOOLS = "#C9CFD6"
KEY = {"family": "monospace", "fontsize": 10}


def draw(options: argparse.Namespace) -> Figure:
    try:
        return drawn(read_toml(options.case))
    except (KeyError, IndexError, TypeError, AttributeError, ValueError) as problem:
        raise Trouble(f"{options.case} is no case such as the sketch shows, of a sphere, a profile "
                      f"and an annulus: {type(problem).__name__} {problem}") from problem


def drawn(case: dict) -> Figure:
    punch, die, holder = (tool_of(case, shape) for shape in ("sphere", "profile", "annulus"))
    figure, axes = pyplot.subplots(figsize=(8.0, 5.1), layout="constrained")
    half = case["blanks"][case["ply"][0]["blank"]]["size"][0] / 2.0
    radius = punch["radius"]
    centre = PLY + radius
    angles = np.linspace(0.0, 2.0 * np.pi, 200)
    solid(axes, radius * np.cos(angles), centre + radius * np.sin(angles))
    hole, fillet = die["points"][0][0], die["points"][1][2]
    bend = np.linspace(np.pi, np.pi / 2.0, 30)
    wall = np.concatenate([[[hole, -70.0]], np.column_stack(
        [hole + fillet + fillet * np.cos(bend), -fillet + fillet * np.sin(bend)]),
        [[EDGE, 0.0], [EDGE, -70.0]]])
    inner = holder["inner_radius"]
    for side in (-1.0, 1.0):
        solid(axes, side * wall[:, 0], wall[:, 1])
        solid(axes, side * np.array([inner, EDGE, EDGE, inner]),
              PLY + holder["thickness"] * np.array([0.0, 0.0, 1.0, 1.0]))
    axes.add_patch(Polygon([[-half, 0.0], [half, 0.0], [half, PLY], [-half, PLY]],
                           color=COLOURS[1], zorder=3))
    label(axes, punch, die, holder, case, centre)
    axes.set(xlim=(-EDGE, EDGE), ylim=(-72.0, 168.0), aspect="equal")
    axes.axis("off")
    return figure


def tool_of(case: dict, shape: str) -> dict:
    for tool in case.get("tool", []):
        if tool["shape"] == shape:
            return tool
    raise Trouble(f"the case has no tool of shape {shape}, which the sketch shows")


def solid(axes, r, z) -> None:
    axes.add_patch(Polygon(np.column_stack([r, z]), facecolor=TOOLS, edgecolor="#5A6470", lw=1.2))


def arrow(axes, start, end, colour="black", width=1.4) -> None:
    axes.add_patch(FancyArrowPatch(start, end, arrowstyle="-|>", mutation_scale=14, lw=width,
                                   color=colour, shrinkA=0, shrinkB=0, zorder=5))


def body(axes, x, z, name, keys, colour="black") -> None:
    """Name of a body in bold, its keys below."""
    behind = {"facecolor": "white", "edgecolor": "none", "pad": 1.0} if colour != "black" else None
    axes.text(x, z, name, ha="center", va="bottom", weight="bold", color=colour, zorder=6,
              bbox=behind)
    axes.text(x, z - 2.0, "\n".join(keys), ha="center", va="top", color=colour, zorder=6,
              linespacing=1.25, bbox=behind, **KEY)


def label(axes, punch, die, holder, case, centre) -> None:
    radius, inner, top = punch["radius"], holder["inner_radius"], PLY + holder["thickness"]
    outer = 0.5 * (inner + EDGE)
    axes.plot([0.0, 0.0], [-72.0, centre], "-.", color="#5A6470", lw=0.9, zorder=4)
    body(axes, 4.0, centre + 32.0, "[[tool]] punch", ['shape = "sphere"', 'motion = "driven"'])
    arrow(axes, (0.0, centre), (radius * np.cos(0.6), centre - radius * np.sin(0.6)))
    axes.text(-4.0, centre - 14.0, f"radius = {radius:g}", ha="right", **KEY)
    side = -radius - 12.0
    arrow(axes, (side, centre + 30.0), (side, centre + 30.0 - punch["stroke"]), COLOURS[0], 2.4)
    axes.text(side - 5.0, centre - 14.0, f"stroke = {punch['stroke']:g}\ndirection\n = [0, 0, -1]",
              ha="right", va="center", color=COLOURS[0], linespacing=1.25, **KEY)
    for x in (inner + 14.0, EDGE - 16.0):
        arrow(axes, (x, top + 26.0), (x, top), COLOURS[0], 2.4)
    body(axes, outer - 2.0, top + 72.0, "[[tool]] blank_holder",
         ['shape = "annulus"', 'motion = "force"', f"force = {holder['force']:g}"])
    arrow(axes, (0.0, top + 7.0), (-inner, top + 7.0))
    axes.text(-inner - 3.0, top + 4.5, f"inner_radius = {inner:g}", ha="right", **KEY)
    body(axes, -outer, -28.0, "[[tool]] die", ['shape = "profile"', "points = [...]"])
    places = [(die["points"][0][0], -70.0), (die["points"][1][0], 0.0), (EDGE - 3.0, 0.0)]
    for (r, z), point, (ha, up) in zip(places, die["points"],
                                       [("left", 3.0), ("left", -22.0), ("right", -14.0)]):
        axes.plot([r], [z], "o", color="black", ms=5, zorder=6, clip_on=False)
        words = "[" + ", ".join(f"{number:g}" for number in point) + "]"
        axes.text(r + 5.0 if ha == "left" else r, z + up, words, ha=ha, zorder=6, **KEY)
    axes.text(places[1][0] + 5.0, -34.0, " r, z, fillet", va="bottom", style="italic", zorder=6)
    ply = case["ply"][0]
    size = case["blanks"][ply["blank"]]["size"]
    body(axes, 0.0, -27.0, f"[[ply]], [blanks.{ply['blank']}]",
         [f"size = [{size[0]:g}, {size[1]:g}]", f"fabric = \"{ply['fabric']}\"",
          f"angle = {ply['angle']:g}"], COLOURS[1])
    arrow(axes, (0.0, -15.0), (0.0, -1.0), COLOURS[1])
    corner = (12.0 - EDGE, 124.0)
    for axis, end in (("x", (corner[0] + 26.0, corner[1])), ("z", (corner[0], corner[1] + 26.0))):
        arrow(axes, corner, end, width=1.2)
        axes.text(end[0] + 4.0, end[1] - 3.0, axis, fontsize=11)
