# SPDX-License-Identifier: GPL-3.0-or-later
"""What the readers of input decks share: lines with their places, numbers, and the mesh under
construction. Every complaint is a Trouble with file, line, value, rule and remedy."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from plotting.reading import Trouble

from exchange.shell_mesh import ShellMesh

MOST_INCLUDES = 8  # one in another
FARTHEST = 1e9     # mm


@dataclass
class Line:
    path: Path
    number: int
    text: str

    def wrong(self, what: str) -> Trouble:
        return Trouble(f"{self.path}:{self.number}: {what}")


def lines_of(path: Path) -> list[Line]:
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError as problem:
        raise Trouble(f"{path} cannot be read: {problem.strerror or problem}") from problem
    return [Line(path, k, line) for k, line in enumerate(text.splitlines(), 1)]


def included(line: Line, name: str, depth: int) -> Iterator[Line]:
    """The lines of a file that a line names, seen from its own folder."""
    if depth >= MOST_INCLUDES:
        raise line.wrong(f"includes go {depth} files deep: put the mesh into one file")
    path = line.path.parent / name.strip().strip("'\"")
    if not path.is_file():
        raise line.wrong(f"includes {path}, which is missing")
    return lines_of(path)


def whole(line: Line, text: str, what: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise line.wrong(f"{what} is {text.strip()!r}, not a whole number") from None


def number(line: Line, text: str, what: str) -> float:
    """Also 1.5-3 for 1.5e-3 and 1.0D2, as Nastran writes them."""
    text = text.strip()
    try:
        return float(text)
    except ValueError:
        pass
    mended = text.upper().replace("D", "E")
    if "E" not in mended:
        cut = max(mended.rfind("+"), mended.rfind("-"))
        if cut > 0:
            mended = mended[:cut] + "E" + mended[cut:]
    try:
        return float(mended)
    except ValueError:
        raise line.wrong(f"{what} is {text!r}, not a number") from None


@dataclass
class Deck:
    """Nodes and shells as they are read."""
    path: Path
    nodes: dict[int, tuple[float, float, float]] = field(default_factory=dict)
    shells: dict[int, tuple[list[int], int, Line]] = field(default_factory=dict)
    left_out: Counter = field(default_factory=Counter)

    def add_node(self, line: Line, label: int, place: tuple[float, float, float]) -> None:
        if not np.abs(place).max() < FARTHEST:
            raise line.wrong(f"node {label} has a coordinate that is no length: {place}")
        if self.nodes.setdefault(label, place) != place:
            raise line.wrong(f"node {label} is there twice, at different places: numbers must be "
                             "unique (write parts and instances flat)")

    def add_shell(self, line: Line, label: int, corners: list[int], part: int) -> None:
        """Three or four corners; a quadrilateral whose last two are one is a triangle."""
        if len(corners) == 4 and (corners[3] in (0, corners[2])):
            corners = corners[:3]
        if len(corners) not in (3, 4) or len(set(corners)) != len(corners):
            raise line.wrong(f"element {label} has the corners "
                             f"{', '.join(map(str, corners)) or 'none'}: a shell has three or four "
                             "different ones")
        if label in self.shells:
            raise line.wrong(f"element {label} is there twice: numbers must be unique (write parts "
                             "and instances flat)")
        self.shells[label] = (corners, part, line)

    def mesh(self) -> ShellMesh:
        if not self.shells:
            others = ", ".join(f"{n} {kind}" for kind, n in self.left_out.items())
            raise Trouble(f"{self.path} has no shell element"
                          + (f" (it has {others}, which are none)" if others else "")
                          + ": plies are mapped onto shells of three or four corners")
        labels = np.array(list(self.nodes), np.int64)
        row = {label: k for k, label in enumerate(self.nodes)}
        corners = np.full((len(self.shells), 4), -1, np.int64)
        for k, (label, (ends, _, line)) in enumerate(self.shells.items()):
            for j, end in enumerate(ends):
                if end not in row:
                    raise line.wrong(f"element {label} has node {end}, which is not in the file")
                corners[k, j] = row[end]
        return ShellMesh(np.array(list(self.nodes.values())), corners,
                         np.array(list(self.shells), np.int64), labels,
                         np.array([part for _, part, _ in self.shells.values()], np.int64),
                         self.path, self.left_out)
