#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""tools/base/progress.py: on a pseudo-terminal one line that is drawn over itself and wiped, elsewhere
whole lines, and nothing of what takes no second.

    progress_test.py TOOLS
"""

import os
import subprocess
import sys
import time

from on_terminal import on_terminal

WORK = """
import os, sys, time
sys.path.insert(0, {tools!r})
import base.progress as p
from base.ending import Trouble, ended
p.LINES_S = 1.2
def act():
    progress = p.Progress("maps")
    end = time.monotonic() + {seconds}
    progress.show({fraction}, "ply 1 of 2\\n" + 60 * "long ")
    while time.monotonic() < end:
        time.sleep(0.05)
    {last}
ended("work", act)
print("ready")
"""


def command(tools: str, seconds: float, fraction: str = "0.25", last: str = "progress.end()"):
    return [sys.executable, "-c", WORK.format(tools=tools, seconds=seconds, fraction=fraction,
                                              last=last)]


def piped(words: list[str]) -> tuple[str, str]:
    done = subprocess.run(words, capture_output=True, text=True)
    return done.stdout, done.stderr


def check_left(tools: str) -> None:
    """Work that slows down to a quarter of its speed halfway: from then on what is told is right within a
    factor of 1.5, and falls. Stages tell what has passed."""
    sys.path.insert(0, tools)
    from base.progress import Progress, TimeLeft

    left, whole, told = TimeLeft(), 250.0, []
    for second in range(1, 250):
        left.show(second, second / 100 if second <= 50 else 0.5 + (second - 50) / 400)
        told.append(left.left(second))
    assert told[0] is None and 49 <= told[49] <= 51, told[:50]
    for second, words in enumerate(told, 1):
        if second >= 110:
            assert whole - second <= 1.5 * words and words <= 1.5 * (whole - second), (second, words)
        if second >= 111:
            assert words <= told[second - 2], (second, words)
    staged = Progress("mesh_tool", staged=True)
    staged.show(0.5, "refines")
    assert staged.line() == "mesh_tool: refines, 50 %, 0 s", staged.line()
    staged.end()


def main() -> None:
    tools = sys.argv[1]
    text = on_terminal(command(tools, 1.9))[1]
    drawn = text.split("\r")
    assert len(drawn) > 3 and drawn[1].startswith("maps: ply 1 of 2?long"), text
    assert all(len(line.removesuffix("\033[K")) < 80 for line in drawn), text
    assert text.endswith("\033[K\r\033[Kready\r\n"), text
    assert "\n" not in text[:-10], text
    # an error is told on a line of its own
    text = on_terminal(command(tools, 1.3, last='raise Trouble("x")'))[1]
    assert "\033[K\r\033[Kwork: error: x\r\n" in text, text
    out, error = piped(command(tools, 2.8, "None"))
    lines = error.splitlines()
    assert len(lines) == 2 and error.endswith("\n") and "\r" not in error and "\033" not in error, error
    assert all(line.startswith("maps: ply 1 of 2") and line.endswith(" s") for line in lines), error
    assert out == "ready\n"
    _, error = piped(command(tools, 1.5, "0.5"))
    assert error.endswith("50 %, about 1 s left\n"), error
    check_left(tools)
    # what a copy of the process shows is drawn
    copy = ("pid = os.fork()\n    if pid == 0:\n        progress.show(0.5, 'of the copy')\n"
            "        os._exit(0)\n    os.waitpid(pid, 0)\n    time.sleep(1.5)\n    progress.end()")
    assert "maps: of the copy, 50 %" in on_terminal(command(tools, 0.0, last=copy))[1]
    for fraction in ("None", "1.0"):  # under a second: nothing
        assert on_terminal(command(tools, 0.4, fraction))[1] == "ready\r\n"
        assert piped(command(tools, 0.4, fraction))[1] == ""
    begin = time.monotonic()  # nobody to write to: no error
    process = subprocess.run([*command(tools, 1.5), ], stdout=subprocess.PIPE,
                             preexec_fn=lambda: os.close(2))
    assert process.returncode == 0 and process.stdout == b"ready\n"
    assert time.monotonic() - begin > 1.5


if __name__ == "__main__":
    main()
