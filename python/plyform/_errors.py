# SPDX-License-Identifier: GPL-3.0-or-later
"""The exit codes of the program as exceptions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Sequence

if TYPE_CHECKING:
    from ._plyform import Mistake
    from ._run import Result


class Error(Exception):
    """What the program ends with exit code 1 for: a file that cannot be read or written, ..."""

    #: The program's exit code for it.
    exit_code = 1


class CaseError(Error):
    """A case, a fabric or a curve is wrong (exit code 2); the text has a line for each mistake."""

    exit_code = 2

    def __init__(self, mistakes: Sequence[Mistake]):
        super().__init__("\n".join(str(mistake) for mistake in mistakes))
        #: All mistakes, with place and remedy.
        self.mistakes: list[Mistake] = list(mistakes)


class Stopped(Error):
    """A simulation stopped itself (exit code 3)."""

    exit_code = 3

    def __init__(self, message: str, result: Result):
        super().__init__(message)
        #: The last good state.
        self.result: Result = result
