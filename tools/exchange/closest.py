# SPDX-License-Identifier: GPL-3.0-or-later
"""Closest points on triangles, exact, by a k-d tree of their centroids."""

import numpy as np
from scipy.spatial import cKDTree

CHUNK = 400000  # point-triangle pairs at once: some 100 MB


def closest_on_triangles(p: np.ndarray, a: np.ndarray, b: np.ndarray,
                         c: np.ndarray) -> np.ndarray:
    """Barycentric coordinates (... x 3) of the points of triangles abc that are closest to p, all
    of shape ... x 3. The point in the plane where it is inside, else the closest of three edges."""
    ab, ac, ap = b - a, c - a, p - a
    d00, d01, d11 = (ab * ab).sum(-1), (ab * ac).sum(-1), (ac * ac).sum(-1)
    d20, d21 = (ap * ab).sum(-1), (ap * ac).sum(-1)
    area = np.maximum(d00 * d11 - d01 * d01, 1e-300)
    v, w = (d11 * d20 - d01 * d21) / area, (d00 * d21 - d01 * d20) / area
    best = np.stack([1 - v - w, v, w], axis=-1)
    inside = (best >= 0).all(axis=-1)
    least = np.full(inside.shape, np.inf)
    edges = np.zeros_like(best)
    corners = (a, b, c)
    for k in range(3):
        start, end = corners[k], corners[(k + 1) % 3]
        along = end - start
        t = ((p - start) * along).sum(-1) / np.maximum((along * along).sum(-1), 1e-300)
        t = np.clip(t, 0, 1)
        square = ((start + t[..., None] * along - p) ** 2).sum(-1)
        nearer = square < least
        least = np.where(nearer, square, least)
        there = np.zeros_like(best)
        there[..., k], there[..., (k + 1) % 3] = 1 - t, t
        edges = np.where(nearer[..., None], there, edges)
    return np.where(inside[..., None], best, edges)


class Surface:
    """Triangles (m x 3) over points x (n x 3), asked for the closest of them."""

    def __init__(self, x: np.ndarray, triangles: np.ndarray, normals: np.ndarray):
        self.corners = x[triangles]  # m x 3 x 3
        self.normals = normals
        middle = self.corners.mean(axis=1)
        self.reach = float(np.linalg.norm(self.corners - middle[:, None], axis=2).max())
        self.tree = cKDTree(middle)

    def closest(self, p: np.ndarray, limit: float, facing: np.ndarray | None = None,
                least_cosine: float = 0.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Of points p (k x 3) the triangle (k; -1: none within the limit), barycentric coordinates
        (k x 3) and distance (k, inf where none). With directions `facing` (k x 3) only triangles
        whose normal is within acos(least_cosine) of them."""
        triangle = np.full(len(p), -1)
        weights = np.zeros((len(p), 3))
        distance = np.full(len(p), np.inf)
        todo, count = np.arange(len(p)), min(8, self.tree.n)
        while len(todo):
            parts = np.array_split(todo, -(-len(todo) * count // CHUNK))
            left = [self._ask(p, limit, facing, least_cosine, part, count,
                              (triangle, weights, distance)) for part in parts]
            if count == self.tree.n:
                break
            todo, count = np.concatenate(left), min(4 * count, self.tree.n)
        return triangle, weights, distance

    def _ask(self, p, limit, facing, least_cosine, todo, count, found) -> np.ndarray:
        """Fills in `found` from the `count` triangles of nearest centroids; returns those points
        for which a triangle further down the list could still be closer."""
        triangle, weights, distance = found
        to_middle, near = self.tree.query(p[todo], k=count)
        to_middle, near = to_middle.reshape(len(todo), -1), near.reshape(len(todo), -1)
        corners = self.corners[near]
        w = closest_on_triangles(np.broadcast_to(p[todo, None], corners[:, :, 0].shape),
                                 corners[:, :, 0], corners[:, :, 1], corners[:, :, 2])
        d = np.linalg.norm((w[..., None] * corners).sum(axis=2) - p[todo, None], axis=2)
        if facing is not None:
            cosine = (self.normals[near] * facing[todo, None]).sum(axis=2)
            d = np.where(cosine >= least_cosine, d, np.inf)
        best = d.argmin(axis=1)
        row = np.arange(len(todo))
        least = d[row, best]
        hit = least <= limit
        triangle[todo[hit]] = near[row, best][hit]
        weights[todo[hit]] = w[row, best][hit]
        distance[todo[hit]] = least[hit]
        # a triangle is not nearer than its centroid less the reach
        return todo[to_middle[:, -1] - self.reach < np.minimum(least, limit)]
