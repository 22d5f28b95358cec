# SPDX-License-Identifier: GPL-3.0-or-later
"""What the commands map, pattern and export share: the state to read."""

import argparse
from pathlib import Path

from base.ending import NotReached, ended, one_line
from exchange.formed import FormedStack, read_formed
from exchange.mirror import mirrored

__all__ = ["NotReached", "add_state", "ended", "read_state", "source_words"]


def add_state(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("results", type=Path, metavar="DIR", help="folder of a run")
    parser.add_argument("--frame", type=int, default=-1, help="number of the state, from 0 [last]")
    parser.add_argument("--ply", action="append", metavar="NAME",
                        help="this ply only; may be given again [all that have fibres]")
    parser.add_argument("--mirror", action="append", choices=["x", "y"], default=[],
                        help="the run modelled one side of x = 0, or of y = 0; both for a quarter")


def read_state(options: argparse.Namespace) -> FormedStack:
    """The plies that add_state's options ask for. Raises Trouble."""
    stack = read_formed(options.results, options.frame, options.ply)
    if not options.ply:
        stack.leave_out_aids()
    for axis in options.mirror:
        stack.plies = [mirrored(ply, axis) for ply in stack.plies]
    return stack


def source_words(stack: FormedStack) -> str:
    """Of which state files are, and what of it is not in them."""
    name, without = one_line(stack.folder.resolve().name, 200), stack.left_out_words()
    return (f"run {name}, frame {stack.frame} at {stack.stroke_mm:.6g} mm of stroke"
            + (f"; {without}" if without else ""))
