# SPDX-License-Identifier: GPL-3.0-or-later
"""Programs on a terminal, for the tests of what they draw there."""

import os
import pty
import subprocess


def on_terminal(words: list[str], stdout=None) -> tuple[int, str]:
    """Exit code, and all that a program writes to a terminal of 80 columns; stdout: where its output
    goes instead."""
    ours, theirs = pty.openpty()
    process = subprocess.Popen(words, stdin=theirs, stdout=theirs if stdout is None else stdout, stderr=theirs)
    os.close(theirs)
    text = b""
    try:
        while piece := os.read(ours, 4096):
            text += piece
    except OSError:  # the other end is closed
        pass
    return process.wait(), text.decode()
