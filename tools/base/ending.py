# SPDX-License-Identifier: GPL-3.0-or-later
"""How every Python program ends: one line for what is wrong, and its exit code. No traceback, but
with PLYFORM_TRACEBACK=1 in the environment."""

import io
import os
import sys
import traceback
from collections.abc import Callable
from pathlib import Path

from base.progress import end_all

EXIT_OTHER, EXIT_WRONG, EXIT_INTERRUPTED = 1, 2, 130
TOOLS = Path(__file__).resolve().parents[1]
LONGEST = 2000  # characters of a message: more is not read on a screen


class Trouble(Exception):
    """What is wrong with a file, an argument or what was asked for; one line."""


class Mistake(Trouble):
    """A mistake in a file that a person wrote, at its place: FILE:LINE: RULE; REMEDY."""


class NotReached(Exception):
    """What was asked for was tried and not reached; one line."""


def one_line(text: object, most: int = LONGEST) -> str:
    """Any text in one line that a terminal, a deck or a script can take: what controls them, ends
    lines or is no character is written out, as \\x1b is."""
    line = "".join(c if c.isprintable() else ascii(c)[1:-1] for c in str(text))
    return line if len(line) <= most else line[:most] + " ..."


def words_of(problem: BaseException) -> str:
    if isinstance(problem, MemoryError):
        return "there is not enough memory for this"
    if isinstance(problem, OSError) and problem.strerror:
        names = [os.fsdecode(name) for name in (problem.filename, problem.filename2)
                 if isinstance(name, (str, bytes, os.PathLike))]
        return ": ".join([*names[-1:], problem.strerror])
    return str(problem) or type(problem).__name__


def place_of(problem: BaseException) -> str:
    """The last line of ours that a fault went through."""
    if place := getattr(problem, "place", ""):  # in another process
        return place
    own = [step for step in traceback.extract_tb(problem.__traceback__)
           if Path(step.filename).resolve().is_relative_to(TOOLS)]
    if not own:
        return "?"
    return f"tools/{Path(own[-1].filename).resolve().relative_to(TOOLS)}:{own[-1].lineno}"


def code_of(problem: BaseException, wrong: int) -> int:
    if isinstance(problem, KeyboardInterrupt):
        return EXIT_INTERRUPTED
    if isinstance(problem, Mistake):
        return EXIT_WRONG
    return wrong if isinstance(problem, Trouble) else EXIT_OTHER


def tell(command: str, problem: BaseException) -> None:
    if os.environ.get("PLYFORM_TRACEBACK") == "1":
        traceback.print_exception(problem)
    known = (Trouble, NotReached, OSError, MemoryError)
    words = words_of(problem) if isinstance(problem, known) else \
        (f"this is a fault of plyform, not of your files: {type(problem).__name__}: {problem}, at "
         f"{place_of(problem)}; please report it, with what PLYFORM_TRACEBACK=1 prints")
    print(f"{command}: error: {one_line(words)}", file=sys.stderr)


def forgiving_streams() -> None:
    """Names of files may have bytes that are no text: they are written out."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def give_up_output() -> None:
    """What could not be written is not tried again, with a traceback, when Python ends."""
    if isinstance(sys.stdout, io.TextIOWrapper):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def ended(command: str, act: Callable[[], int | None], wrong: int = EXIT_WRONG) -> None:
    """Runs a program to its end: every one of tools/ calls this, and only this. `act` returns its
    exit code, or None for 0. `wrong`: the exit code of a Trouble that is no Mistake."""
    forgiving_streams()
    if sys.stderr is None:  # closed by the caller
        sys.stderr = open(os.devnull, "w", encoding="utf-8")
    try:
        code = act()
        end_all()
        if sys.stdout is not None:
            sys.stdout.flush()
    except BrokenPipeError:  # who reads has left
        give_up_output()
        sys.exit(EXIT_OTHER)
    except (Exception, KeyboardInterrupt) as problem:
        end_all()
        if not isinstance(problem, KeyboardInterrupt):
            tell(command, problem)
        try:
            if sys.stdout is not None:
                sys.stdout.flush()
        except OSError:
            give_up_output()
        sys.exit(code_of(problem, wrong))
    if code:
        sys.exit(code)
