# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes and shells of an input deck as its reader finds them, and the mesh that they make."""

from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from plotting.reading import Trouble

from exchange.deck_lines import FARTHEST, Line
from exchange.shell_mesh import ShellMesh


@dataclass
class Places:
    """Lines of files that rows are from, to name them."""
    files: list[Path] = field(default_factory=list)
    blocks: list[tuple[np.ndarray, int]] = field(default_factory=list)  # lines, file

    def add(self, path: Path, lines) -> None:
        if path not in self.files:
            self.files.append(path)
        self.blocks.append((np.asarray(lines, np.int64), self.files.index(path)))

    def line(self, row: int) -> Line:
        for lines, file in self.blocks:
            if row < len(lines):
                return Line(self.files[file], int(lines[row]), "")
            row -= len(lines)
        raise IndexError(row)

    def order(self) -> np.ndarray:
        """Rows in the order of files and lines."""
        lines = np.concatenate([lines for lines, _ in self.blocks])
        files = np.concatenate([np.full(len(lines), file) for lines, file in self.blocks])
        return np.lexsort((lines, files))


@dataclass
class Deck:
    """Blocks of nodes and shells, with the file's numbers."""
    path: Path
    nodes: list[tuple[np.ndarray, np.ndarray]] = field(default_factory=list)   # numbers, n x 3
    shells: list[tuple[np.ndarray, ...]] = field(default_factory=list)
    node_places: Places = field(default_factory=Places)
    shell_places: Places = field(default_factory=Places)
    left_out: Counter = field(default_factory=Counter)

    def add_nodes(self, path: Path, lines, labels, places) -> None:
        """`lines` (k) of the file, `labels` (k), `places` (k x 3)."""
        if len(labels):
            self.nodes.append((np.asarray(labels, np.int64), np.asarray(places, float)))
            self.node_places.add(path, lines)

    def add_shells(self, path: Path, lines, labels, parts, ends) -> None:
        """`ends` (k x 8): four corners, the last 0 in triangles, and the nodes in the middle of the
        sides from each corner to the next, 0 where there is none."""
        if len(labels):
            self.shells.append((np.asarray(labels, np.int64), np.asarray(parts, np.int64),
                                np.asarray(ends, np.int64).reshape(-1, 8)))
            self.shell_places.add(path, lines)

    def mesh(self) -> ShellMesh:
        """Raises Trouble: no shells, numbers twice, corners that are missing or no three or four
        different ones, coordinates that are no lengths. In the order of the file."""
        labels, places = self._nodes()
        if not self.shells:
            others = ", ".join(f"{n} {kind}" for kind, n in self.left_out.items())
            raise Trouble(f"{self.path} has no shell element"
                          + (f" (it has {others}, which are none)" if others else "")
                          + ": plies are mapped onto shells of three or four corners")
        order = self.shell_places.order()
        shells, parts, ends = (np.concatenate(some)[order] for some in zip(*self.shells))
        self._expect_once(shells, order)
        ends = self._without_repeats(shells, ends, order)
        used = ends != 0
        rows, there = found_in(labels, ends)
        if (used & ~there).any():
            row, k = np.argwhere(used & ~there)[0]
            raise self.shell_places.line(order[row]).wrong(
                f"element {shells[row]} has node {ends[row, k]}, which is not in the file")
        rows = np.where(used, rows, -1)
        middles = rows[:, 4:] if used[:, 4:].any() else None
        return ShellMesh(places, rows[:, :4], shells, labels, parts, self.path, self.left_out, middles)

    def _nodes(self) -> tuple[np.ndarray, np.ndarray]:
        if not self.nodes:
            return np.zeros(0, np.int64), np.zeros((0, 3))
        labels, places = (np.concatenate(some) for some in zip(*self.nodes))
        far = np.flatnonzero(~(np.abs(places) < FARTHEST).all(axis=1))
        if len(far):
            raise self.node_places.line(far[0]).wrong(
                f"node {labels[far[0]]} has a coordinate that is no length: "
                f"{tuple(places[far[0]].tolist())}")
        order = np.argsort(labels, kind="stable")
        again = order[1:][labels[order][1:] == labels[order][:-1]]
        before = order[:-1][labels[order][1:] == labels[order][:-1]]
        moved = (places[again] != places[before]).any(axis=1)
        if moved.any():
            row = again[moved].min()
            raise self.node_places.line(row).wrong(
                f"node {labels[row]} is there twice, at different places: numbers must be unique "
                "(write parts and instances flat)")
        keep = np.ones(len(labels), bool)
        keep[again] = False
        return labels[keep], places[keep]

    def _expect_once(self, shells: np.ndarray, order: np.ndarray) -> None:
        sort = np.argsort(shells, kind="stable")
        again = sort[1:][shells[sort][1:] == shells[sort][:-1]]
        if len(again):
            row = again.min()
            raise self.shell_places.line(order[row]).wrong(
                f"element {shells[row]} is there twice: numbers must be unique (write parts and "
                "instances flat)")

    def _without_repeats(self, shells: np.ndarray, ends: np.ndarray, order: np.ndarray) -> np.ndarray:
        """A quadrilateral with two neighbouring corners in one node is a triangle."""
        made = ends.copy()
        for k in range(4):
            quad = made[:, 3] != 0
            same = quad & (made[:, k] == made[:, (k + 1) % 4])
            gone = min(k + 1, 3)
            kept = [j for j in range(4) if j != gone] + [4 + j for j in range(4) if j != k]
            made[same] = np.insert(made[same][:, kept], [3, 6], 0, axis=1)
        first, twice = made[:, :3], np.zeros(len(made), bool)
        for k in range(3):
            twice |= first[:, k] == first[:, (k + 1) % 3]
            twice |= first[:, k] == made[:, 3]
            twice |= first[:, k] == 0
        if twice.any():
            row = int(np.flatnonzero(twice)[0])
            corners = ends[row, :4] if ends[row, 3] else ends[row, :3]
            raise self.shell_places.line(order[row]).wrong(
                f"element {shells[row]} has the corners {', '.join(map(str, corners))}: a shell has "
                "three or four different ones")
        return made


def found_in(labels: np.ndarray, wanted: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rows of `labels` (each once) at which the wanted ones are, and whether they are."""
    if not len(labels):
        return np.zeros(wanted.shape, np.int64), np.zeros(wanted.shape, bool)
    order = np.argsort(labels)
    at = np.minimum(np.searchsorted(labels, wanted, sorter=order), len(labels) - 1)
    rows = order[at]
    return rows, labels[rows] == wanted
