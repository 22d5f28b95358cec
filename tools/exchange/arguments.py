# SPDX-License-Identifier: GPL-3.0-or-later
"""What the commands map, pattern and export share: their exit codes, and the state to read."""

import argparse
import sys
from collections.abc import Callable
from pathlib import Path

from plotting.reading import Trouble

from exchange.formed import FormedStack, read_formed
from exchange.mirror import mirrored

EXIT_OTHER, EXIT_WRONG = 1, 2


class NotReached(Exception):
    """What was asked for was tried and not reached; one line."""


def ended(command: str, act: Callable[[], None]) -> None:
    """Runs a command. What is wrong with files or arguments gives one line and exit code 2, what
    was not reached and a file that cannot be written exit code 1."""
    try:
        act()
    except Trouble as problem:
        print(f"{command}: error: {problem}", file=sys.stderr)
        sys.exit(EXIT_WRONG)
    except KeyboardInterrupt:
        sys.exit(EXIT_OTHER)
    except (OSError, NotReached) as problem:
        print(f"{command}: error: {problem}", file=sys.stderr)
        sys.exit(EXIT_OTHER)


def add_state(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("results", type=Path, metavar="DIR", help="folder of a run")
    parser.add_argument("--frame", type=int, default=-1, help="number of the state, from 0 [last]")
    parser.add_argument("--ply", action="append", metavar="NAME",
                        help="this ply only; may be given again [all]")
    parser.add_argument("--mirror", action="append", choices=["x", "y"], default=[],
                        help="the run modelled one side of x = 0, or of y = 0; both for a quarter")


def read_state(options: argparse.Namespace) -> FormedStack:
    """The plies that add_state's options ask for. Raises Trouble."""
    stack = read_formed(options.results, options.frame, options.ply)
    for axis in options.mirror:
        stack.plies = [mirrored(ply, axis) for ply in stack.plies]
    return stack


def source_words(folder: Path, frame: int, stroke: float) -> str:
    return f"run {folder.resolve().name}, frame {frame} at {stroke:.6g} mm of stroke"
