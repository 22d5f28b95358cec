# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls a Python program of tools/ as the command line would, without the time that starting takes."""

import contextlib
import io
import sys
from types import SimpleNamespace


def call(program, *arguments):
    """main() of a module with these arguments: exit code and what it printed."""
    out, err, code = io.StringIO(), io.StringIO(), 0
    before, sys.argv = sys.argv, [program.__name__ + ".py", *map(str, arguments)]
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            program.main()
    except SystemExit as leaving:
        code = leaving.code if isinstance(leaving.code, int) else 1
        err.write("" if isinstance(leaving.code, int) else str(leaving.code))
    finally:
        sys.argv = before
    return SimpleNamespace(code=code, out=out.getvalue(), err=err.getvalue())
