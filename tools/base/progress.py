# SPDX-License-Identifier: GPL-3.0-or-later
"""What long work does and how far it is, on standard error: on a terminal one line that is drawn over
itself and wiped at the end, elsewhere a whole line every five seconds. Nothing of work under a second.
tools/cli/progress_line.hpp is the same for the program.

    progress = Progress("report")
    for number in range(count):
        progress.show(number / count, f"reads state {number + 1} of {count}")
        ...
    progress.end()
"""

import os
import sys
import threading
import time

FIRST_S = 1.0               # of silence
TERMINAL_S, LINES_S = 0.2, 5.0  # between what is drawn
LEAST = 0.02                # a smaller fraction tells nothing of the time left

going: list["Progress"] = []


def clock(seconds: float) -> str:
    whole = round(seconds)
    return f"{whole} s" if whole < 100 else f"{whole // 60} min" if whole < 6000 else \
        f"{whole / 3600:.1f} h"


def stream() -> int:
    """The descriptor of standard error; below 0: there is none."""
    try:
        return sys.stderr.fileno() if sys.stderr is not None else -1
    except (OSError, ValueError):  # it is kept in memory, or closed
        return -1


class Progress:
    """`what`: the work, as a user calls it. A thread draws what was shown last, as some steps take
    long; in a copy of the process (base/apart.py), where it does not run, `show` does."""

    def __init__(self, what: str):
        self.what, self.fraction, self.words = what, None, ""
        self.stream = stream()
        self.terminal = self.stream >= 0 and os.isatty(self.stream)
        self.every = TERMINAL_S if self.terminal else LINES_S
        self.begin = time.monotonic()
        self.next = self.begin + (FIRST_S if self.terminal else LINES_S)
        self.over, self.drawing = threading.Event(), threading.Lock()
        going.append(self)
        if self.stream >= 0:
            threading.Thread(target=self._tick, daemon=True).start()

    def show(self, fraction: float | None, words: str = "") -> None:
        """`fraction`: of the work done, 0 to 1; None: not known."""
        self.fraction, self.words = fraction, words
        self._draw()

    def end(self) -> None:
        """Wipes the line. May be called twice."""
        with self.drawing:
            if self.over.is_set():
                return
            self.over.set()
            going.remove(self)
            # a copy of this process may have drawn
            if self.terminal and time.monotonic() >= self.begin + FIRST_S:
                self._write("\r\033[K")

    def __enter__(self) -> "Progress":
        return self

    def __exit__(self, *_) -> None:
        self.end()

    def line(self) -> str:
        passed = time.monotonic() - self.begin
        text = f"{self.what}: {self.words}" if self.words else self.what
        if self.fraction is None:
            return f"{text}, {clock(passed)}"
        done = min(max(self.fraction, 0.0), 1.0)
        text = f"{text}, {100 * done:.0f} %"
        return text if done < LEAST else f"{text}, about {clock(passed * (1 - done) / done)} left"

    def _tick(self) -> None:
        while not self.over.wait(max(self.next - time.monotonic(), 0.05)):
            self._draw()

    def _draw(self) -> None:
        # Not waited for: in a copy of the process nobody may be left to give it back.
        if not self.drawing.acquire(blocking=False):
            return
        try:
            now = time.monotonic()
            if self.stream < 0 or self.over.is_set() or now < self.next:
                return
            self.next = now + self.every
            line = "".join(c if c.isprintable() else "?" for c in self.line())
            self._write(f"\r{line[:self._width()]}\033[K" if self.terminal else line + "\n")
        finally:
            self.drawing.release()

    def _width(self) -> int:
        try:
            return (os.get_terminal_size(self.stream).columns or 80) - 1
        except OSError:
            return 79

    def _write(self, text: str) -> None:
        try:  # in one piece, past what Python keeps; what is not taken is dropped
            os.write(self.stream, text.encode(errors="replace"))
        except OSError:
            pass


def end_all() -> None:
    """Before an error is told."""
    for progress in going[:]:
        progress.end()
