# SPDX-License-Identifier: GPL-3.0-or-later
"""Questions that are answered by a process of their own, within a time, so that no file that a page
names can hold or end the server."""

import json
import subprocess
import sys
from pathlib import Path

from base.ending import one_line

from .project import Refused

MOST_S = 120.0


def answered(script: Path, *words, cwd: Path, most_s: float = MOST_S) -> dict:
    """Of a script, which prints JSON; {"error": WORDS} of it is refused. Raises Refused."""
    try:
        done = subprocess.run([sys.executable, "-B", script, *map(str, words)], cwd=cwd,
                              stdin=subprocess.DEVNULL, capture_output=True, timeout=most_s, check=False)
    except subprocess.TimeoutExpired as problem:
        raise Refused(f"this takes more than {most_s:.0f} s", 422) from problem
    try:
        told = json.loads(done.stdout)
    except ValueError as problem:
        lines = done.stderr.decode("utf-8", "replace").strip().splitlines() or ["it has said nothing"]
        raise Refused(f"this is a fault of plyform, not of your files: {one_line(lines[-1], 300)}; "
                      "please report it", 500) from problem
    if "error" in told:
        raise Refused(one_line(told["error"]), 422)
    return told
