# SPDX-License-Identifier: GPL-3.0-or-later
"""Tools with fewer triangles: results.h5 has them fine enough to compute with, a picture needs less.

Vertices move along an edge into a neighbour, many at a time that do not touch each other, as long as
the neighbour is within a tolerance of the planes of all triangles that have come together in it
(quadric error: Garland and Heckbert 1997) and no triangle turns over. Borders count as planes at
right angles to their triangles, so that outlines stay.
"""

import hashlib

import numpy as np

ROUNDS = 40
ENOUGH = 6000  # triangles: a picture is drawn fast enough
PASSES = 3  # in a round, over what its costs are known of
FEW = 0.01  # of the vertices: when fewer move in a round, it was the last


_found: dict = {}  # of surfaces already asked for: two runs that are compared often share their tools


def simplified(x: np.ndarray, triangles: np.ndarray, tolerance: float):
    """Vertices and triangles within about `tolerance` (mm) of the surface given."""
    bytes_of = hashlib.sha256(x.tobytes())
    bytes_of.update(triangles.tobytes())
    key = bytes_of.digest(), tolerance
    if key not in _found:
        _found[key] = compute(x, triangles, tolerance)
    return _found[key]


def compute(x: np.ndarray, triangles: np.ndarray, tolerance: float):
    quadrics, chance = quadrics_of(x, triangles), np.random.default_rng(1)
    for _ in range(ROUNDS):
        moved, to = collapses(x, triangles, quadrics, tolerance, chance)
        if len(moved) <= FEW * len(triangles) or len(triangles) < ENOUGH:
            break
        target = np.arange(len(x))
        target[moved] = to
        quadrics += sums(quadrics[moved], to, len(x))
        triangles = whole_triangles(target[triangles])
    return without_loose(x, triangles)


def collapses(x, triangles, quadrics, tolerance, chance):
    """Vertices that can move, none in a triangle with another one, and where to."""
    start, end = triangles.reshape(-1), triangles[:, [1, 2, 0]].reshape(-1)
    at = np.concatenate([x[end], np.ones((len(end), 1))], axis=1)
    error = np.maximum((np.matmul(quadrics[start], at[:, :, None])[:, :, 0] * at).sum(axis=1), 0.0)
    good = error <= tolerance**2
    start, end, error = start[good], end[good], error[good]
    length = np.linalg.norm(x[end] - x[start], axis=1)
    cost = (error + 1e-3 * tolerance * length) * chance.uniform(0.5, 1.5, len(error))
    order = np.argsort(-cost)  # the last that is written stays: the least
    best, target = np.full(len(x), np.inf), np.arange(len(x))
    best[start[order]], target[start[order]] = cost[order], end[order]
    turned = np.zeros(len(x), dtype=bool)
    for k in range(3):
        turned[triangles[turns_over(x, triangles, k, target), k]] = True
    best[turned] = np.inf
    wins = np.zeros(len(x), dtype=bool)
    for _ in range(PASSES):  # of those that are left the cheapest of their triangles
        of_corner = best[triangles]
        of_triangle = of_corner.min(axis=1)
        loses = np.zeros(len(x), dtype=bool)
        for k in range(3):
            loses[triangles[of_corner[:, k] > of_triangle, k]] = True
        now = np.isfinite(best) & ~loses
        wins |= now
        best[triangles[now[triangles].any(axis=1)]] = np.inf
    moved = np.flatnonzero(wins)
    return moved, target[moved]


def turns_over(x, triangles, k, target) -> np.ndarray:
    """Which triangles would face another way if their corner k moved."""
    here, there = triangles[:, k], target[triangles[:, k]]
    b, c = triangles[:, (k + 1) % 3], triangles[:, (k + 2) % 3]
    before = np.cross(x[b] - x[here], x[c] - x[here])
    after = np.cross(x[b] - x[there], x[c] - x[there])
    sizes = np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1)
    stays = (there != b) & (there != c)
    return stays & ((before * after).sum(axis=1) <= 0.5 * sizes)


def quadrics_of(x: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """4 x 4, of each vertex: the sum over its triangles' planes, weighted by nothing, so that the
    error is a distance."""
    a, b, c = (x[triangles[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30)
    plane = np.concatenate([normal, -(normal * a).sum(axis=1, keepdims=True)], axis=1)
    products = plane[:, :, None] * plane[:, None, :]
    quadrics = sum(sums(products, triangles[:, k], len(x)) for k in range(3))
    sides = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    _, of_side, count = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True,
                                  return_counts=True)
    border = np.flatnonzero(count[of_side.reshape(-1)] == 1)
    start, end = x[sides[border, 0]], x[sides[border, 1]]
    across = np.cross(end - start, normal[border // 3])
    across /= np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-30)
    plane = np.concatenate([across, -(across * start).sum(axis=1, keepdims=True)], axis=1)
    products = plane[:, :, None] * plane[:, None, :]
    return quadrics + sum(sums(products, sides[border, k], len(x)) for k in range(2))


def sums(values: np.ndarray, group: np.ndarray, count: int) -> np.ndarray:
    flat = values.reshape(len(values), 16)
    columns = [np.bincount(group, column, count) for column in flat.T]
    return np.stack(columns, axis=1).reshape(count, 4, 4)


def whole_triangles(triangles: np.ndarray) -> np.ndarray:
    """Those with three different corners, each once."""
    a, b, c = triangles.T
    triangles = triangles[(a != b) & (b != c) & (c != a)]
    _, first = np.unique(np.sort(triangles, axis=1), axis=0, return_index=True)
    return triangles[np.sort(first)]


def without_loose(x: np.ndarray, triangles: np.ndarray):
    used, numbers = np.unique(triangles, return_inverse=True)
    return x[used], numbers.reshape(triangles.shape)
