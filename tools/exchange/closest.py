# SPDX-License-Identifier: GPL-3.0-or-later
"""Closest points on triangles, exact, by a k-d tree of their centroids."""

import numpy as np
from scipy.spatial import cKDTree

CHUNK = 400000   # points at once: some 200 MB
FIRST, MORE = 6, 4  # triangles asked for a point, and times more for those that need them
ROUNDING = 1.000001  # of a distance that decides whether a triangle is asked at all


def dot(one: np.ndarray, two: np.ndarray) -> np.ndarray:
    """k of k x 3 each."""
    return np.einsum("ij,ij->i", one, two)


def on_edges(p: np.ndarray, a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Barycentric coordinates (k x 3) of the points of the edges of triangles abc that are closest to
    p, all k x 3."""
    least, found = np.full(len(p), np.inf), np.zeros((len(p), 3))
    corners = (a, b, c)
    for k in range(3):
        start, end = corners[k], corners[(k + 1) % 3]
        along = end - start
        t = dot(p - start, along) / np.maximum(dot(along, along), 1e-300)
        t = np.clip(t, 0, 1)
        off = start + t[:, None] * along - p
        square = dot(off, off)
        nearer = square < least
        least = np.where(nearer, square, least)
        there = np.zeros((len(p), 3))
        there[:, k], there[:, (k + 1) % 3] = 1 - t, t
        found[nearer] = there[nearer]
    return found


class Surface:
    """Triangles (m x 3) over points x (n x 3), asked for the closest of them."""

    def __init__(self, x: np.ndarray, triangles: np.ndarray, normals: np.ndarray):
        self.corners = x[triangles]  # m x 3 x 3
        self.normals = normals
        middle = self.corners.mean(axis=1)
        self.radius = np.sqrt(((self.corners - middle[:, None]) ** 2).sum(axis=2).max(axis=1))
        self.reach = float(self.radius.max())
        self.tree = cKDTree(middle, balanced_tree=False)  # twice as fast to build
        a = self.corners[:, 0]
        self.ab, self.ac = self.corners[:, 1] - a, self.corners[:, 2] - a
        self.products = np.column_stack([dot(self.ab, self.ab), dot(self.ab, self.ac),
                                         dot(self.ac, self.ac)])
        self.square = np.maximum(self.products[:, 0] * self.products[:, 2]
                                 - self.products[:, 1] ** 2, 1e-300)  # of twice the area
        facing = self.corners[:, [1, 2, 0]] - self.corners[:, [2, 0, 1]]
        # of each corner over the edge that faces it
        self.heights = np.sqrt(self.square[:, None] / np.maximum((facing ** 2).sum(axis=2), 1e-300))

    def closest(self, p: np.ndarray, limit: float, facing: np.ndarray | None = None,
                least_cosine: float = 0.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Of points p (k x 3) the triangle (k; -1: none within the limit), barycentric coordinates
        (k x 3) and distance (k, inf where none). With directions `facing` (k x 3) only triangles
        whose normal is within acos(least_cosine) of them."""
        triangle = np.full(len(p), -1)
        weights = np.zeros((len(p), 3))
        distance = np.full(len(p), np.inf)
        for first in range(0, len(p), CHUNK):
            part = slice(first, first + CHUNK)
            faced = None if facing is None else (facing[part], least_cosine)
            self._ask(p[part], limit, faced, (triangle[part], weights[part], distance[part]))
        return triangle, weights, distance

    def _ask(self, p, limit, faced, found) -> None:
        """Fills in `found`. A triangle is not nearer than its centroid less its radius: candidates are
        gone through in the order of their centroids, and only where they can be nearer than what was
        found before."""
        todo, before, count = np.arange(len(p)), 0, min(FIRST, self.tree.n)
        while len(todo):
            # further away nothing counts; the tree gives n for what is not there
            to_middle, near = self.tree.query(p[todo], k=np.arange(before + 1, count + 1),
                                              distance_upper_bound=1.0000001 * limit + self.reach,
                                              workers=-1)
            for k in range(count - before):
                self._try(p, limit, faced, found, todo, to_middle[:, k], near[:, k])
            if count == self.tree.n:
                return
            todo = todo[to_middle[:, -1] - self.reach < np.minimum(found[2][todo], limit)]
            before, count = count, min(MORE * count, self.tree.n)

    def _try(self, p, limit, faced, found, todo, to_middle, near) -> None:
        """One triangle `near` a point, `to_middle` from it."""
        triangle, weights, distance = found
        at = np.flatnonzero(near < self.tree.n)
        at = at[to_middle[at] - self.radius[near[at]] < np.minimum(distance[todo[at]], limit)]
        if faced is not None and len(at):
            at = at[dot(self.normals[near[at]], faced[0][todo[at]]) >= faced[1]]
        if not len(at):
            return
        point, some = todo[at], near[at]
        w, d = self._nearest(p[point], some, np.minimum(distance[point], limit))
        better = d < distance[point]
        point = point[better]
        triangle[point], weights[point], distance[point] = some[better], w[better], d[better]

    def _nearest(self, p: np.ndarray, some: np.ndarray,
                 least: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Barycentric coordinates (k x 3) of the points of triangles `some` (k) closest to p (k x 3),
        and distances; inf where that is not below `least`. The foot in the plane where it is inside,
        else the closest point of three edges, where that can be near enough: a foot is outside of an
        edge by its negative coordinate times the height over it, at least."""
        off = p - self.corners[some, 0]
        ab, ac = self.ab[some], self.ac[some]
        d00, d01, d11 = self.products[some].T
        d20, d21 = dot(off, ab), dot(off, ac)
        v, w = ((d11 * d20 - d01 * d21) / self.square[some],
                (d00 * d21 - d01 * d20) / self.square[some])
        best = np.column_stack([1 - v - w, v, w])
        off -= v[:, None] * ab
        off -= w[:, None] * ac
        d = np.sqrt(dot(off, off))
        out = np.minimum(best, 0.0)
        outside = np.flatnonzero(out.any(axis=1))
        away = (out[outside] * self.heights[some[outside]]).min(axis=1)
        near = d[outside] ** 2 + away ** 2 < (ROUNDING * least[outside]) ** 2
        d[outside[~near]] = np.inf
        outside = outside[near]
        corners = self.corners[some[outside]]
        best[outside] = on_edges(p[outside], corners[:, 0], corners[:, 1], corners[:, 2])
        apart = np.einsum("ij,ijk->ik", best[outside], corners) - p[outside]
        d[outside] = np.sqrt(dot(apart, apart))
        d[d > least] = np.inf
        return best, d
