# SPDX-License-Identifier: GPL-3.0-or-later
"""Tools with fewer triangles: results.h5 has them fine enough to compute with, a picture needs less.

Vertices are merged cell by cell of an octree, from the finest cells up, as long as the merged
vertex stays within a tolerance of the planes of all triangles that meet there (quadric error:
Garland and Heckbert 1997; clustering: Lindstrom 2000). Borders count as planes at right angles to
their triangles, so that outlines stay.
"""

import numpy as np

FINEST = 0.004  # of the tool's size: the smallest cell
LEVELS = 9


def simplified(x: np.ndarray, triangles: np.ndarray, tolerance: float):
    """Vertices and triangles within about `tolerance` (mm) of the surface given."""
    quadrics = quadrics_of(x, triangles)
    size = float(np.ptp(x, axis=0).max())
    origin = x.min(axis=0) - 1e-6 * size
    group = np.arange(len(x))  # of each vertex, the group that it is merged into
    place = x.copy()           # of each group
    open_groups = np.ones(len(x), dtype=bool)
    for level in range(LEVELS):
        cell = np.floor((place - origin) / (FINEST * size * 2.0**level)).astype(np.int64)
        cell = (cell[:, 0] * 1048576 + cell[:, 1]) * 1048576 + cell[:, 2]
        cell = np.where(open_groups, cell, -1 - np.arange(len(cell)))
        _, new, count = np.unique(cell, return_inverse=True, return_counts=True)
        merged, weight = sums(quadrics, new), np.bincount(new)
        middle = sums(place, new) / weight[:, None]
        best, error = best_places(merged, middle)
        good = (count > 1) & (error <= tolerance)
        keep = ~good[new] & (count[new] > 1)  # groups of cells that stay apart
        open_groups = open_groups & ~keep
        target = np.where(keep, len(count) + np.arange(len(new)), new)
        _, target = np.unique(target, return_inverse=True)
        place_of = np.zeros((target.max() + 1, 3))
        place_of[target] = np.where(good[new][:, None], best[new], place)
        still = np.zeros(len(place_of), dtype=bool)
        still[target] = open_groups
        quadrics, place, open_groups = sums(quadrics, target), place_of, still
        group = target[group]
    return without_loose(place, whole_triangles(group[triangles]))


def quadrics_of(x: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """4 x 4, of each vertex: the sum over its triangles' planes, weighted by nothing, so that the
    error is a distance."""
    a, b, c = (x[triangles[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30)
    plane = np.concatenate([normal, -(normal * a).sum(axis=1, keepdims=True)], axis=1)
    products = plane[:, :, None] * plane[:, None, :]
    quadrics = np.zeros((len(x), 4, 4))
    for k in range(3):
        np.add.at(quadrics, triangles[:, k], products)
    sides = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    _, of_side, count = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True,
                                  return_counts=True)
    border = np.flatnonzero(count[of_side.reshape(-1)] == 1)
    start, end = x[sides[border, 0]], x[sides[border, 1]]
    across = np.cross(end - start, normal[border // 3])
    across /= np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-30)
    plane = np.concatenate([across, -(across * start).sum(axis=1, keepdims=True)], axis=1)
    products = plane[:, :, None] * plane[:, None, :]
    for k in range(2):
        np.add.at(quadrics, sides[border, k], products)
    return quadrics


def sums(values: np.ndarray, group: np.ndarray) -> np.ndarray:
    flat = values.reshape(len(values), -1)
    columns = [np.bincount(group, column) for column in flat.T]
    return np.stack(columns, axis=1).reshape(-1, *values.shape[1:])


def best_places(quadrics: np.ndarray, middle: np.ndarray):
    """Where each quadric is least, near the middle where it does not care; and the distance from
    the planes there that no plane exceeds."""
    matrix = quadrics[:, :3, :3]
    weight = np.maximum(np.trace(matrix, axis1=1, axis2=2), 1e-30)
    pull = 1e-3 * weight[:, None, None] * np.eye(3)
    right = -quadrics[:, :3, 3] + 1e-3 * weight[:, None] * middle
    best = np.linalg.solve(matrix + pull, right[:, :, None])[:, :, 0]
    at = np.concatenate([best, np.ones((len(best), 1))], axis=1)
    squares = np.einsum("ni,nij,nj->n", at, quadrics, at)
    return best, np.sqrt(np.maximum(squares, 0.0))


def whole_triangles(triangles: np.ndarray) -> np.ndarray:
    """Those with three different corners, each once."""
    a, b, c = triangles.T
    triangles = triangles[(a != b) & (b != c) & (c != a)]
    _, first = np.unique(np.sort(triangles, axis=1), axis=0, return_index=True)
    return triangles[np.sort(first)]


def without_loose(x: np.ndarray, triangles: np.ndarray):
    used, numbers = np.unique(triangles, return_inverse=True)
    return x[used], numbers.reshape(triangles.shape)
