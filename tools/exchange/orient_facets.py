# SPDX-License-Identifier: GPL-3.0-or-later
"""Facets of a tool that go round alike. Lengths in mm."""

from pathlib import Path

import numpy as np

from plotting.reading import Trouble


def oriented(path: Path, x: np.ndarray, triangles: np.ndarray,
             closed: bool = True) -> tuple[np.ndarray, np.ndarray]:
    """Used points only, and triangles in their order that go round alike, outwards if they are to be
    closed. Raises Trouble if they are not, or are no surface in one piece."""
    used, corners = np.unique(triangles, return_inverse=True)
    x, triangles = x[used], corners.reshape(-1, 3).copy()
    sides: dict[tuple[int, int], list[int]] = {}
    for number, (a, b, c) in enumerate(triangles.tolist()):
        for one, two in ((a, b), (b, c), (c, a)):
            sides.setdefault((min(one, two), max(one, two)), []).append(number)
    most = max(map(len, sides.values()), default=0)
    if most > 2 and not closed:
        raise Trouble(f"{path}: {most} of its triangles meet at one edge: a tool has one surface; take "
                      "ribs and walls between its faces away in the CAD program")
    open_sides = sum(len(at) != 2 for at in sides.values())
    if (open_sides and closed) or not len(triangles):
        raise Trouble(f"{path}: its facets are not closed ({open_sides} edges without two "
                      "triangles): heal the part in the CAD program, or export STL from there")
    turned, seen, todo = np.zeros(len(triangles), bool), np.zeros(len(triangles), bool), [0]
    seen[0] = True
    while todo:
        number = todo.pop()
        for one, two in directed(triangles[number], turned[number]):
            for other in sides[(min(one, two), max(one, two))]:
                if not seen[other]:
                    seen[other] = True
                    turned[other] = (one, two) in directed(triangles[other], False)
                    todo.append(other)
    if not seen.all() and not closed:
        raise Trouble(f"{path}: its faces are in several pieces, which edges within 0.01 mm do not "
                      "join: save one shell, or sew them in the CAD program")
    if not seen.all():
        raise Trouble(f"{path}: its solid has a hollow inside, which no tool needs: fill it in the "
                      "CAD program")
    triangles[turned] = triangles[turned][:, ::-1]
    if closed and signed_volume(x, triangles) < 0:
        triangles = triangles[:, ::-1].copy()
    return x, triangles


def directed(corners, turned: bool) -> list[tuple[int, int]]:
    a, b, c = (int(n) for n in (corners[::-1] if turned else corners))
    return [(a, b), (b, c), (c, a)]


def signed_volume(x: np.ndarray, triangles: np.ndarray) -> float:
    a, b, c = (x[triangles[:, k]] for k in range(3))
    return float((a * np.cross(b, c)).sum() / 6)
