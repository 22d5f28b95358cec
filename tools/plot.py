#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws result folders of plyform (their layout, and an example of each: docs/users/results.md).

    plot.py plies   DIR... -o FILE   each ply from above, coloured by a field, and the stack
    plot.py history DIR... -o FILE   forces and energies over the stroke
    plot.py load    DIR... -o FILE   force of a tool or boundary over its displacement
    plot.py energy  DIR... -o FILE   energies, and the ratios by which to judge a run
    plot.py section DIR... -o FILE   a field along a straight cut, and the formed profile
    plot.py folds   DIR... -o FILE   folds of a hanging edge, counted
    plot.py fit     FIT.csv -o FILE  measured against fitted forces
    plot.py laboratories TABLE.csv -o FILE  laws of several laboratories, mean and scatter
    plot.py setup   CASE.toml -o FILE  the section of a case, with the names of its keys

Exit codes: 0 drawn, 1 something is missing or cannot be read, 2 wrong arguments.
"""

import argparse
import sys
from pathlib import Path

try:
    from base.ending import EXIT_OTHER, ended
    from plotting import (draw_fit, draw_folds, draw_history, draw_laboratories, draw_plies,
                          draw_section, draw_setup)
    from plotting.reading import SHEAR
    from plotting.whole_file import make_whole
except ImportError as error:
    sys.exit(f"plot.py: error: {error}; install python3-h5py and python3-matplotlib")


def add_plies(commands) -> argparse.ArgumentParser:
    plies = commands.add_parser("plies", help="plies coloured by a field, and the stack")
    plies.add_argument("--tools", action="store_true", help="with the outlines of the tools")
    plies.add_argument("--limit", type=positive, metavar="VALUE",
                       help="end of the colour scale, in its unit")
    plies.add_argument("--gap", type=float, default=0.0, metavar="MM",
                       help="extra distance between plies in the view of the stack")
    plies.add_argument("--turn", type=float, action="append", metavar="DEG",
                       help="turn about the z axis; once, or once a folder")
    plies.add_argument("--view", type=float, nargs=2, default=(28.0, -60.0),
                       metavar=("ELEV", "AZIM"), help="of the stack, in degrees")
    plies.add_argument("--only", choices=("3d", "above"), help="without the other view")
    plies.set_defaults(draw=draw_plies.draw)
    return plies


def add_histories(commands) -> list[argparse.ArgumentParser]:
    history = commands.add_parser("history", help="forces and energies over the stroke or the time")
    history.set_defaults(draw=draw_history.draw_history)
    energy = commands.add_parser("energy", help="energies, and the ratios by which to judge a run")
    energy.set_defaults(draw=draw_history.draw_energy)
    for command in (history, energy):
        command.add_argument("--overlay", action="store_true", help="all folders in one column")
        command.add_argument("--against", choices=("stroke", "time"),
                             help="default the stroke, or the time where nothing has one")
    load = commands.add_parser("load", help="force over displacement")
    load.add_argument("--of", metavar="NAME", help="tool or boundary, default the first driven")
    load.add_argument("--curve", type=Path, action="append", default=[], metavar="CSV",
                      help="theory or test: displacement_mm, force_N and perhaps shear_deg")
    load.add_argument("--against", choices=("displacement", "shear"), default="displacement",
                      help="shear: the angle that a curve tells at the displacement")
    add_percent_limit(load)
    load.set_defaults(draw=draw_history.draw_load)
    return [history, energy, load]


def add_section(commands) -> argparse.ArgumentParser:
    section = commands.add_parser("section", help="a field along a straight cut")
    section.add_argument("--through", type=float, nargs=2, required=True, metavar=("X0", "Y0"),
                         help="a point of the unformed ply, mm")
    section.add_argument("--direction", type=float, required=True, metavar="DEG", help="from x")
    section.add_argument("--against", choices=("distance", "angle"), default="distance",
                         help="angle: of the formed point, seen from --centre, from the vertical")
    section.add_argument("--centre", type=float, nargs=3, metavar=("X", "Y", "Z"))
    section.add_argument("--magnitude", action="store_true", help="without signs")
    section.add_argument("--curve", type=Path, action="append", default=[], metavar="CSV",
                         help="distance_mm or angle_deg, and shear_deg (other fields: their name)")
    section.set_defaults(draw=draw_section.draw)
    return section


def add_folds(commands) -> argparse.ArgumentParser:
    folds = commands.add_parser("folds", help="folds of a hanging edge, counted")
    folds.add_argument("--axis", type=float, nargs=2, default=(0.0, 0.0), metavar=("X", "Y"),
                       help="the vertical axis that distances are from")
    folds.add_argument("--ring", type=positive, metavar="RADIUS",
                       help="along a circle of the unformed ply round the axis, not the border")
    folds.add_argument("--depth", type=positive, metavar="MM",
                       help="folds stand out by more than this; default: half a triangle side, "
                       "or a tenth of the line's whole swing if that is more")
    folds.add_argument("--json", type=Path, metavar="FILE", help="the numbers")
    folds.set_defaults(draw=draw_folds.draw)
    return folds


def add_fit(commands) -> argparse.ArgumentParser:
    fit = commands.add_parser("fit", help="measured against fitted forces")
    fit.add_argument("fit", type=Path, metavar="FIT.csv")
    fit.add_argument("--against", choices=tuple(draw_fit.ABSCISSAE),
                     help="default: the first of them that FIT.csv has")
    add_percent_limit(fit)
    fit.set_defaults(draw=draw_fit.draw)
    return fit


def add_laboratories(commands) -> argparse.ArgumentParser:
    laws = commands.add_parser("laboratories", help="laws of several, mean and scatter")
    laws.add_argument("table", type=Path, metavar="TABLE.csv")
    laws.set_defaults(draw=draw_laboratories.draw)
    return laws


def add_setup(commands) -> argparse.ArgumentParser:
    setup = commands.add_parser("setup", help="the section of a case, with the names of its keys")
    setup.add_argument("case", type=Path, metavar="CASE.toml",
                       help="of a sphere, a profile and an annulus")
    setup.set_defaults(draw=draw_setup.draw)
    return setup


def add_percent_limit(command: argparse.ArgumentParser) -> None:
    command.add_argument("--limit", type=positive, default=50.0, metavar="PERCENT",
                         help="where the lower axes end at the latest, default 50")


def positive(text: str) -> float:
    number = float(text)
    if not 0.0 < number < float("inf"):
        raise argparse.ArgumentTypeError(f"{text} is not above 0")
    return number


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="plot.py", description=__doc__.split("\n", 1)[0])
    commands = parser.add_subparsers(dest="command", required=True)
    plies, section, folds = add_plies(commands), add_section(commands), add_folds(commands)
    of_state = [plies, section, folds]
    of_folders = [*of_state, *add_histories(commands)]
    for command in (plies, section):
        command.add_argument("--field", default=SHEAR, metavar="WORD",
                             help="shear, warp-strain, weft-tension, thickness, ... or the name of a "
                             "column; one that there is none of lists all")
    for command in of_state:
        command.add_argument("--ply", action="append", metavar="NAME",
                             help="only this ply; may be given several times")
        command.add_argument("--frame", type=int, default=-1, help="output state, default the last")
    for command in of_folders:
        command.add_argument("folders", nargs="+", type=Path, metavar="DIR", help="result folder")
    for command in (*of_folders, add_fit(commands), add_laboratories(commands),
                    add_setup(commands)):
        command.add_argument("-o", "--output", required=True, type=Path, metavar="FILE",
                             help=".png, .svg or .pdf")
        command.add_argument("--dpi", type=int, default=110, help="of a PNG")
    options = parser.parse_args()
    if options.output.suffix not in (".png", ".svg", ".pdf"):
        parser.error(f"{options.output}: the name must end in .png, .svg or .pdf")
    return options


def run() -> None:
    options = arguments()
    figure = options.draw(options)
    # tight: where axes have to be square, the layout alone may cut their titles off
    make_whole(options.output,
               lambda part: figure.savefig(part, dpi=options.dpi, bbox_inches="tight"))


def main() -> None:
    ended("plot.py", run, wrong=EXIT_OTHER)


if __name__ == "__main__":
    main()
