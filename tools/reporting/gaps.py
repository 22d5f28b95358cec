# SPDX-License-Identifier: GPL-3.0-or-later
"""How far plies are from tools: the distance of points from triangles, exact for the triangles.

Points and triangles are looked at in groups of neighbours. A group of triangles is left out where a
sphere round it is further from the sphere round the points than another one is at most; single
triangles likewise.
"""

import numpy as np

from .reading_run import PlyStates, ToolStates
from .simplify import simplified

MOST = 30.0       # mm: whatever is further from a tool is at this distance
TOLERANCE = 0.1   # mm: of the simplified tool
GROUP = 64        # points
FACETS = 32       # triangles


class Surface:
    """The triangles of a tool at time 0, in groups."""

    def __init__(self, tool: ToolStates):
        x, triangles = simplified(tool.x0, tool.triangles, TOLERANCE)
        order = along_curve(x[triangles].mean(axis=1))
        self.corners = x[triangles[order]]                      # m x 3 x 3
        self.middle = self.corners.mean(axis=1)
        self.radius = np.linalg.norm(self.corners - self.middle[:, None], axis=2).max(axis=1)
        self.groups = [slice(k, k + FACETS) for k in range(0, len(self.corners), FACETS)]
        self.centre = np.array([self.middle[g].mean(axis=0) for g in self.groups])
        self.reach = np.array([(np.linalg.norm(self.middle[g] - c, axis=1) + self.radius[g]).max()
                               for g, c in zip(self.groups, self.centre)])

    def nearest(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Distance of each point, MOST at most, and the triangle that it is from (-1: none)."""
        distance, facet = np.full(len(points), MOST), np.full(len(points), -1)
        starts = range(0, len(points), GROUP)
        centre = np.array([points[k:k + GROUP].mean(axis=0) for k in starts])
        apart = np.linalg.norm(centre[:, None] - self.centre, axis=2)
        for k, start in enumerate(starts):
            part = slice(start, start + GROUP)
            self.nearest_of_group(points[part], centre[k], apart[k], distance[part], facet[part])
        return distance, facet

    def nearest_of_group(self, points, centre, apart, distance, facet):
        """Fills `distance` and `facet` of neighbouring points."""
        reach = np.linalg.norm(points - centre, axis=1).max()
        least, most = apart - self.reach - reach, (apart + self.reach).min() + reach
        groups = np.flatnonzero(least <= min(most, MOST))
        if len(groups) == 0:
            return
        some = np.concatenate([np.arange(len(self.corners))[self.groups[g]] for g in groups])
        far = np.sqrt(np.maximum(squares_between(points, self.middle[some]), 0.0))
        limit = np.minimum((far + self.radius[some]).min(axis=1), MOST)
        point, column = np.nonzero(far - self.radius[some] <= limit[:, None] + 1e-6)
        if len(point) == 0:
            return
        d = distance_to_triangles(points[point], self.corners[some[column]])
        order = np.lexsort((d, point))
        first = order[np.unique(point[order], return_index=True)[1]]
        near = first[d[first] < MOST]
        distance[point[near]] = d[near]
        facet[point[near]] = some[column[near]]


def along_curve(points: np.ndarray) -> np.ndarray:
    """An order that keeps neighbours together: bits of the coordinates in turn."""
    size = max(float(np.ptp(points, axis=0).max()), 1e-30)
    cells = np.minimum((points - points.min(axis=0)) / size * 1023.0, 1023.0).astype(np.int64)
    code = np.zeros(len(points), dtype=np.int64)
    for bit in range(10):
        for k in range(points.shape[1]):
            code |= ((cells[:, k] >> bit) & 1) << (points.shape[1] * bit + k)
    return np.argsort(code, kind="stable")


def squares_between(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    origin = a.mean(axis=0)
    a, b = a - origin, b - origin
    return (a * a).sum(axis=1)[:, None] + (b * b).sum(axis=1) - 2.0 * a @ b.T


def distance_to_triangles(p: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Of each point from its triangle: from the plane if its foot is inside, else from a side."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    normal = np.cross(b - a, c - a)
    length = np.maximum(np.linalg.norm(normal, axis=1), 1e-30)
    best, inside = np.full(len(p), np.inf), np.ones(len(p), dtype=bool)
    for start, end in ((a, b), (b, c), (c, a)):
        side, to = end - start, p - start
        share = (side * to).sum(axis=1) / np.maximum((side * side).sum(axis=1), 1e-30)
        foot = to - np.clip(share, 0.0, 1.0)[:, None] * side
        best = np.minimum(best, np.linalg.norm(foot, axis=1))
        inside &= (np.cross(side, to) * normal).sum(axis=1) >= 0.0
    return np.where(inside, abs(((p - a) * normal).sum(axis=1)) / length, best)


def gaps_of(ply: PlyStates, tools: list[ToolStates], surfaces: list[Surface]):
    """t x n: gap between the face of the ply (half a thickness from its nodes) and each tool."""
    order = along_curve(ply.x0)
    half = 0.5 * ply.thickness()
    gaps = []
    for tool, surface in zip(tools, surfaces):
        gap = np.empty(ply.x.shape[:2])
        for k in range(len(ply.x)):
            gap[k, order] = surface.nearest(ply.x[k, order] - tool.shift[k])[0] - half
        gaps.append(gap)
    return gaps
