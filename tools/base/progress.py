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

import mmap
import os
import struct
import sys
import threading
import time
from collections import deque
from collections.abc import Iterator

FIRST_S = 1.0               # of silence
TERMINAL_S, LINES_S = 0.2, 5.0  # between what is drawn
LEAST = 0.02                # a smaller fraction tells nothing of the time left
LATE, POINTS = 1 / 3, 200   # of the time so far, by which what is left is told; of them at most

SHOWN, HEAD = 4096, struct.Struct("dI")  # bytes: fraction, below 0 for none, and length of the words

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


class TimeLeft:
    """How long work will still take: by how fast it was in the last third of its time, not from its
    start. base/time_left.hpp is the same."""

    def __init__(self):
        self.seen: deque[tuple[float, float]] = deque()

    def show(self, seconds: float, fraction: float) -> None:
        if len(self.seen) >= 2 and seconds - self.seen[-2][0] < seconds / POINTS:
            self.seen.pop()
        self.seen.append((seconds, fraction))
        while len(self.seen) > 2 and self.seen[1][0] <= (1.0 - LATE) * seconds:
            self.seen.popleft()

    def left(self, seconds: float) -> float | None:
        """None as long as too little of the work is done."""
        if not self.seen or self.seen[-1][1] < LEAST:
            return None
        begin, since = self.seen[0] if len(self.seen) > 1 else (0.0, 0.0)
        done = self.seen[-1][1]
        speed = (done - since) / (seconds - begin) if done > since and seconds > begin else done / seconds
        return (1.0 - done) / speed


class Progress:
    """`what`: the work, as a user calls it. staged: its fractions are those of stages, of which nobody
    knows how long they take; then what has passed is told in the place of what is left. A thread draws
    what was shown last, as some steps take long. What a copy of the process shows (base/apart.py) is
    drawn too: it stands in shared memory."""

    def __init__(self, what: str, staged: bool = False):
        self.what, self.process, self.shown = what, os.getpid(), mmap.mmap(-1, SHOWN)
        self._keep(None, "")
        self.staged, self.left = staged, TimeLeft()
        self.stream = stream()
        self.terminal = self.stream >= 0 and os.isatty(self.stream)
        self.every = TERMINAL_S if self.terminal else LINES_S
        self.begin = time.monotonic()
        self.next = self.begin + (FIRST_S if self.terminal else LINES_S)
        self.drawn, self.over, self.drawing = False, threading.Event(), threading.Lock()
        going.append(self)
        if self.stream >= 0:
            threading.Thread(target=self._tick, daemon=True).start()

    def show(self, fraction: float | None, words: str = "") -> None:
        """`fraction`: of the work done, 0 to 1; None: not known."""
        self._keep(fraction, words)
        if os.getpid() == self.process:
            self._draw()

    def end(self) -> None:
        """Wipes the line. May be called twice."""
        with self.drawing:
            if self.over.is_set():
                return
            self.over.set()
            going.remove(self)
            if self.terminal and self.drawn:
                self._write("\r\033[K")

    def __enter__(self) -> "Progress":
        return self

    def __exit__(self, *_) -> None:
        self.end()

    def _keep(self, fraction: float | None, words: str) -> None:
        text = words.encode(errors="replace")[:SHOWN - HEAD.size]
        done = -1.0 if fraction is None else min(max(fraction, 0.0), 1.0)
        self.shown[:HEAD.size + len(text)] = HEAD.pack(done, len(text)) + text

    def line(self) -> str:
        passed = time.monotonic() - self.begin
        done, length = HEAD.unpack_from(self.shown)
        words = self.shown[HEAD.size:HEAD.size + length].decode(errors="replace")
        text = f"{self.what}: {words}" if words else self.what
        if done < 0.0:
            return f"{text}, {clock(passed)}"
        text = f"{text}, {100 * done:.0f} %"
        if self.staged:
            return f"{text}, {clock(passed)}"
        self.left.show(passed, done)
        left = self.left.left(passed)
        return text if left is None else f"{text}, about {clock(left)} left"

    def _tick(self) -> None:
        while not self.over.wait(max(self.next - time.monotonic(), 0.05)):
            self._draw()

    def _draw(self) -> None:
        with self.drawing:
            now = time.monotonic()
            if self.stream < 0 or self.over.is_set() or now < self.next:
                return
            self.next, self.drawn = now + self.every, True
            line = "".join(c if c.isprintable() else "?" for c in self.line())
            self._write(f"\r{line[:self._width()]}\033[K" if self.terminal else line + "\n")

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


def doing(words: str, fraction: float | None = None) -> None:
    """`show` of the work that goes on, if any does: for those who do not know who has called them."""
    if going:
        going[-1].show(fraction, words)


def told(what: str, things: list) -> Iterator:
    """The things, names or with a name, each told as what is done now: "reads ply1, 1 of 5"."""
    for number, thing in enumerate(things):
        doing(f"{what} {getattr(thing, 'name', thing)}, {number + 1} of {len(things)}")
        yield thing


def end_all() -> None:
    """Before an error is told."""
    for progress in going[:]:
        progress.end()
