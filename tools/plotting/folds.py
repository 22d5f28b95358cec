# SPDX-License-Identifier: GPL-3.0-or-later
"""Folds of a hanging edge: how far a closed line of the ply is from a vertical axis, and which
maxima of that curve stand out."""

from dataclasses import dataclass

import numpy as np

from .numbers import border_loop, locate, mean_side
from .reading import Ply, Trouble


@dataclass
class Line:
    """A closed line of the ply; the last point is a step away from the first."""
    where: np.ndarray       # k, rises: mm along the unformed border, or degrees on a ring
    round: float            # where the line is back at its start: mm or 360
    distance: np.ndarray    # k, mm: of the formed points from the axis, horizontally
    length_mm: float        # unformed
    mean_side_mm: float     # of the unformed triangles that touch it


@dataclass
class Folds:
    depth_mm: float         # folds are maxima with more prominence than this
    reason: str             # where depth_mm comes from
    peaks: np.ndarray       # f, indices into the line, rising
    valleys: np.ndarray     # f, the lowest point after each peak and before the next
    prominence: np.ndarray  # f, mm
    amplitude_mm: float     # half the mean height of the flanks
    largest_mm: float       # half the height of the highest flank


def border_line(ply: Ply, axis: tuple[float, float]) -> Line:
    try:
        loop = border_loop(ply.x0, ply.triangles)
    except Trouble as problem:
        raise Trouble(f"ply {ply.name} {problem}") from problem
    steps = np.linalg.norm(np.roll(ply.x0[loop], -1, axis=0) - ply.x0[loop], axis=1)
    touching = ply.triangles[np.isin(ply.triangles, loop).any(axis=1)]
    return Line(np.concatenate([[0.0], np.cumsum(steps)[:-1]]), steps.sum(),
                np.hypot(*(ply.x[loop, :2] - axis).T), steps.sum(), mean_side(ply.x0, touching))


def ring_line(ply: Ply, axis: tuple[float, float], radius: float) -> Line:
    """Points on a circle of the unformed ply, two or more a triangle side, 360 at least."""
    side = mean_side(ply.x0, ply.triangles)
    count = max(360, int(np.ceil(2.0 * 2.0 * np.pi * radius / side)))
    angle = 2.0 * np.pi * np.arange(count) / count
    points = np.asarray(axis) + radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    found, weights = locate(points, ply.x0, ply.triangles)
    if (found < 0).any():
        raise Trouble(f"the ring of {radius:g} mm round ({axis[0]:g}, {axis[1]:g}) leaves the "
                      f"unformed ply {ply.name}, or meets a hole: take a smaller one")
    formed = np.einsum("pk,pkc->pc", weights, ply.x[ply.triangles[found]])
    return Line(np.degrees(angle), 360.0, np.hypot(*(formed[:, :2] - axis).T),
                2.0 * np.pi * radius, mean_side(ply.x0, ply.triangles[np.unique(found)]))


def prominences(y: np.ndarray) -> list[tuple[int, float]]:
    """Index and prominence of each maximum of a closed curve, by index.

    The level sinks from the top. Each maximum is an island that appears; where two meet, the
    lower one's prominence is its height above that place. Of two of the same height, the first
    outlives the other, so that a flat or twofold top counts once. The highest stands as high as
    the whole curve.
    """
    n = len(y)
    parent = np.full(n, -1)  # -1: still under water

    def top_of(i: int) -> int:
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    found = []
    for i in np.lexsort((np.arange(n), -y)):
        parent[i] = i
        for j in ((i - 1) % n, (i + 1) % n):
            if parent[j] < 0:
                continue
            a, b = top_of(i), top_of(j)
            if a == b:
                continue
            higher, lower = (a, b) if (-y[a], a) < (-y[b], b) else (b, a)
            parent[lower] = higher
            if y[lower] > y[i]:
                found.append((int(lower), float(y[lower] - y[i])))
    if y.max() > y.min():
        found.append((int(y.argmax()), float(y.max() - y.min())))
    return sorted(found)


def usual_depth(line: Line) -> tuple[float, str]:
    """Half a triangle side: what is shallower, the mesh cannot tell from its own facets. And a
    tenth of all that the line moves to and fro: ripples on large folds are not folds."""
    side, swing = 0.5 * line.mean_side_mm, 0.1 * float(np.ptp(line.distance))
    if side >= swing:
        return side, f"half the mean triangle side of {line.mean_side_mm:.3g} mm"
    return swing, f"a tenth of the line's whole swing of {10.0 * swing:.3g} mm"


def find_folds(line: Line, depth_mm: float | None = None) -> Folds:
    depth, reason = usual_depth(line) if depth_mm is None else (depth_mm, "--depth")
    kept = [(i, height) for i, height in prominences(line.distance) if height > depth]
    peaks = np.array([i for i, _ in kept], dtype=int)
    if len(peaks) == 0:
        return Folds(depth, reason, peaks, peaks, np.zeros(0), 0.0, 0.0)
    n, r = len(line.distance), line.distance
    valleys = []
    for peak, following in zip(peaks, np.concatenate([peaks[1:], [peaks[0] + n]])):
        between = np.arange(peak, following + 1) % n
        valleys.append(between[r[between].argmin()])
    valleys = np.array(valleys)
    flanks = np.concatenate([r[peaks] - r[valleys], r[peaks] - r[np.roll(valleys, 1)]])
    return Folds(depth, reason, peaks, valleys, np.array([height for _, height in kept]),
                 0.5 * float(flanks.mean()), 0.5 * float(flanks.max()))
