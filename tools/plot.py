#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws result folders of plyform (their layout: docs/results.md).

    plot.py plies   DIR... -o FILE   each ply from above, coloured by shear angle, and the stack
    plot.py history DIR... -o FILE   tool forces and energies over the stroke

Exit codes: 0 drawn, 1 something is missing or cannot be read, 2 wrong arguments.
"""

import argparse
import csv
import math
import sys
from dataclasses import dataclass
from pathlib import Path

try:
    import h5py
    import matplotlib
    import numpy as np
    matplotlib.use("Agg")  # draws into files, needs no screen
    from matplotlib import pyplot
    from matplotlib.cm import ScalarMappable
    from matplotlib.collections import LineCollection
    from matplotlib.colors import Normalize
    from matplotlib.lines import Line2D
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection
except ImportError as error:
    sys.exit(f"plot.py: error: {error}; install python3-h5py and python3-matplotlib")

STYLES = ["-", "--", ":", "-."]  # of overlaid folders, in turn


class Trouble(Exception):
    """What is wrong with a result folder."""


@dataclass
class Ply:
    name: str
    angle_deg: float
    x: np.ndarray          # n x 3, mm
    triangles: np.ndarray  # m x 3
    shear_deg: np.ndarray  # m, magnitudes


@dataclass
class State:
    folder: Path
    stroke_mm: float
    plies: list[Ply]
    tool_edges: list[np.ndarray]  # k x 2 x 2, mm: outlines from above, if asked for


def file_in(folder: Path, name: str) -> Path:
    if not (folder / name).is_file():
        raise Trouble(f"{folder / name} is missing: is {folder} the folder of a run?")
    return folder / name


def read_state(folder: Path, frame: int, tools: bool) -> State:
    path = file_in(folder, "results.h5")
    try:
        with h5py.File(path, "r") as file:
            return state_of(file, folder, frame, tools)
    except (OSError, KeyError) as problem:
        raise Trouble(f"{path} cannot be read as results of plyform: {problem}") from problem


def state_of(file: "h5py.File", folder: Path, frame: int, tools: bool) -> State:
    frames = len(file["time_s"])
    number = frame if frame >= 0 else frames + frame
    if not 0 <= number < frames:
        raise Trouble(f"{folder} has no frame {frame}: it has frames 0 to {frames - 1}")
    now = file[f"frames/{number:06}"]
    plies = []
    for name in file.attrs["plies"]:
        fixed, ply = file["plies"][name], now["plies"][name]
        plies.append(Ply(name, float(fixed.attrs["angle_deg"]), ply["x"][:],
                         fixed["triangles"][:], abs(ply["shear_angle_deg"][:])))
    outlines = []
    for name in file.attrs["tools"] if tools else []:
        tool = file["tools"][name]
        shift = np.asarray(now["tools"][name].attrs["displacement_mm"])
        outlines.append(outline(tool["x0"][:] + shift, tool["triangles"][:]))
    return State(folder, float(now.attrs["stroke_mm"]), plies, outlines)


def outline(x: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Edges at which a surface ends or turns over, seen along z."""
    corners = x[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    up = normals[:, 2] / np.maximum(np.linalg.norm(normals, axis=1), 1e-30)
    side = np.sign(np.where(abs(up) < 1e-6, 0.0, up))  # 0: a wall along z
    seen: dict[tuple[int, int], list[float]] = {}
    for t, s in zip(triangles, side):
        for a, b in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0])):
            seen.setdefault((min(a, b), max(a, b)), []).append(s)
    edges = [edge for edge, sides in seen.items() if len(sides) == 1 or len(set(sides)) > 1]
    return x[np.array(edges, dtype=int).reshape(-1, 2)][:, :, :2]


def read_history(folder: Path) -> dict[str, np.ndarray]:
    path = file_in(folder, "history.csv")
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    if not rows or "stroke_mm" not in rows[0]:
        raise Trouble(f"{path} has no row, or no column stroke_mm")
    try:
        return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}
    except (TypeError, ValueError) as problem:
        raise Trouble(f"{path}: {problem}") from problem


def colours_of(states: list[State], limit: float | None) -> ScalarMappable:
    largest = max(ply.shear_deg.max() for state in states for ply in state.plies)
    if not math.isfinite(largest):
        raise Trouble("a shear angle is not finite")
    top = limit or max(5.0 * math.ceil(largest / 5.0), 5.0)
    return ScalarMappable(Normalize(0.0, top), "viridis")


def draw_ply(axes, ply: Ply, state: State, colours: ScalarMappable) -> None:
    axes.tripcolor(ply.x[:, 0], ply.x[:, 1], ply.triangles, facecolors=ply.shear_deg,
                   cmap=colours.cmap, norm=colours.norm, antialiased=False, rasterized=True)
    for edges in state.tool_edges:
        axes.add_collection(LineCollection(edges, colors="tab:red", linewidths=1.0))
    low = min(other.x[:, :2].min() for other in state.plies)
    high = max(other.x[:, :2].max() for other in state.plies)
    margin = 0.04 * (high - low)
    axes.set(xlim=(low - margin, high + margin), ylim=(low - margin, high + margin),
             aspect="equal", xlabel="x (mm)", ylabel="y (mm)",
             title=f"{ply.name} at {ply.angle_deg:g}°, shear up to {ply.shear_deg.max():.1f}°")


def draw_stack(axes, state: State, colours: ScalarMappable, gap: float) -> None:
    """All plies as one collection, so that they hide each other; `gap` mm more between them."""
    faces, paint = [], []
    light = np.array([-0.4, -0.5, 0.77])
    for i, ply in enumerate(state.plies):
        corners = ply.x[ply.triangles] + [0.0, 0.0, gap * i]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
        colour = colours.to_rgba(ply.shear_deg)
        colour[:, :3] *= 0.6 + 0.4 * abs(normals @ light)[:, None]
        faces.append(corners)
        paint.append(colour)
    corners, paint = np.concatenate(faces), np.concatenate(paint)
    axes.add_collection3d(Poly3DCollection(corners, facecolors=paint, antialiased=False,
                                           linewidths=0.0, rasterized=True))
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axes.set_box_aspect(np.maximum(high - low, 1e-3 * (high - low).max()), zoom=1.1)
    axes.view_init(elev=28, azim=-60)
    axes.set_axis_off()
    apart = f",\nplies drawn {gap:g} mm further apart" if gap and len(state.plies) > 1 else ""
    axes.set_title(f"{state.stroke_mm:.1f} mm of stroke{apart}")


def draw_plies(options: argparse.Namespace) -> "matplotlib.figure.Figure":
    states = [read_state(folder, options.frame, options.tools) for folder in options.folders]
    colours = colours_of(states, options.limit)
    cells = max(len(state.plies) for state in states) + 1
    # one folder: as square as it gets; several: a row each, to be compared
    columns = cells if len(states) > 1 else math.ceil(math.sqrt(cells))
    rows_each = math.ceil(cells / columns)
    rows = rows_each * len(states)
    figure = pyplot.figure(figsize=(3.7 * columns + 0.8, 3.9 * rows), layout="constrained")
    every, beyond = [], "max" if options.limit else "neither"
    for k, state in enumerate(states):
        first = k * rows_each * columns + 1
        for i, ply in enumerate(state.plies):
            every.append(figure.add_subplot(rows, columns, first + i))
            draw_ply(every[-1], ply, state, colours)
            if len(states) > 1 and i == 0:
                every[-1].set_ylabel(f"{state.folder.name}\ny (mm)")
        every.append(figure.add_subplot(rows, columns, first + len(state.plies), projection="3d"))
        draw_stack(every[-1], state, colours, options.gap)
    figure.colorbar(colours, ax=every, shrink=0.8, aspect=35, pad=0.02, extend=beyond,
                    label="magnitude of the shear angle (degrees)")
    return figure


def draw_history(options: argparse.Namespace) -> "matplotlib.figure.Figure":
    histories = [read_history(folder) for folder in options.folders]
    columns = 1 if options.overlay else len(histories)
    figure, axes = pyplot.subplots(2, columns, sharex=True, sharey="row", squeeze=False,
                                   figsize=(5.2 * columns + 1.5, 7.0), layout="constrained")
    for k, history in enumerate(histories):
        top, bottom = axes[:, 0 if options.overlay else k]
        style = STYLES[k % len(STYLES)] if options.overlay else "-"
        for axis, unit in ((top, "_force_N"), (bottom, "_mJ")):
            for i, name in enumerate(n for n in history if n.endswith(unit)):
                axis.plot(history["stroke_mm"], history[name], style, color=f"C{i % 10}",
                          label=name.removesuffix(unit).replace("_", " "))
        bottom.set(yscale="log", xlabel="stroke (mm)")
        if not options.overlay:
            top.set_title(options.folders[k].resolve().name)
    for row, title in zip(axes, ("tool", "energy")):  # same names in the same colours everywhere
        lines = row[0].lines[:len(row[0].lines) // (len(histories) if options.overlay else 1)]
        handles = [Line2D([], [], color=line.get_color(), label=line.get_label()) for line in lines]
        if options.overlay:
            handles += [Line2D([], [], color="k", ls=STYLES[k % len(STYLES)],
                               label=folder.resolve().name)
                        for k, folder in enumerate(options.folders)]
        row[-1].legend(handles=handles, title=title, loc="upper left", bbox_to_anchor=(1.02, 1.0))
    energy = max(h[n].max() for h in histories for n in h if n.endswith("_mJ"))
    if energy > 0.0:
        axes[1, 0].set_ylim(1e-5 * energy, 3.0 * energy)
    axes[0, 0].set_ylabel("reaction against its direction (N)")
    axes[1, 0].set_ylabel("energy or work (mJ)")
    for a in axes.flat:
        a.grid(alpha=0.3)
    return figure


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="plot.py", description=__doc__.split("\n", 1)[0])
    commands = parser.add_subparsers(dest="command", required=True)
    plies = commands.add_parser("plies", help="plies coloured by shear angle, and the stack")
    plies.add_argument("--tools", action="store_true", help="with the outlines of the tools")
    plies.add_argument("--limit", type=float, metavar="DEG", help="end of the colour scale")
    plies.add_argument("--gap", type=float, default=0.0, metavar="MM",
                       help="extra distance between plies in the view of the stack")
    plies.add_argument("--frame", type=int, default=-1, help="output state, default the last")
    plies.set_defaults(draw=draw_plies)
    history = commands.add_parser("history", help="forces and energies over the stroke")
    history.add_argument("--overlay", action="store_true", help="all folders in one pair of axes")
    history.set_defaults(draw=draw_history)
    for command in (plies, history):
        command.add_argument("folders", nargs="+", type=Path, metavar="DIR", help="result folder")
        command.add_argument("-o", "--output", required=True, type=Path, metavar="FILE")
        command.add_argument("--dpi", type=int, default=110, help="of a PNG")
    options = parser.parse_args()
    if options.output.suffix not in (".png", ".svg", ".pdf"):
        parser.error(f"{options.output}: the name must end in .png, .svg or .pdf")
    return options


def main() -> None:
    options = arguments()
    try:
        options.draw(options).savefig(options.output, dpi=options.dpi)
    except (Trouble, OSError) as problem:
        sys.exit(f"plot.py: error: {problem}")


if __name__ == "__main__":
    main()
