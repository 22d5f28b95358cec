# SPDX-License-Identifier: GPL-3.0-or-later
"""How far a field of one run is from that of another, on whatever meshes.

    A_t    area of triangle t before forming, mm^2
    f_i    value at node i:   f_i = sum_t A_t f_t / sum_t A_t over the triangles around i      (1)
    w_i    area of node i:    w_i = 1/3 sum_t A_t over the same                               (2)
    d_i    difference at node i of the reference, the run's field interpolated there
    rms^2 = sum_i w_i d_i^2 / sum_i w_i                                                       (3)
"""

import numpy as np
from plotting.reading import Ply, State, Trouble

ROUNDING = 1e-9  # of a triangle: on a side shared by two, either will do
SHARE = 0.99     # of the area, that has at most this difference


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


class Sheet:
    """A ply before forming, from above."""

    def __init__(self, ply: Ply):
        if len(ply.triangles) == 0:
            raise Trouble(f"ply {ply.name} has no triangles")
        self.x0, self.triangles, self.values = ply.x0[:, :2], ply.triangles, ply.value
        self.corners = self.x0[self.triangles]  # m x 3 x 2
        a, b, c = self.corners.transpose(1, 0, 2)
        self.area = 0.5 * abs(cross(b - a, c - a))
        self.node_area = np.bincount(self.triangles.ravel(), np.repeat(self.area, 3),
                                     len(self.x0))  # three times (2)

    def nodal(self) -> np.ndarray:
        sums = np.bincount(self.triangles.ravel(), np.repeat(self.area * self.values, 3),
                           len(self.x0))
        return sums / self.node_area  # (1)

    def shares(self, triangles: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Of the corners in a point each; all at least 0 inside."""
        a, b, c = self.corners[triangles].transpose(1, 0, 2)
        whole = cross(b - a, c - a)
        second, third = cross(points - a, c - a) / whole, cross(b - a, points - a) / whole
        return np.stack([1.0 - second - third, second, third], axis=1)

    def cells(self, points: np.ndarray, low: np.ndarray, size: float, count: np.ndarray):
        return np.clip(((points - low) / size).astype(np.int64), 0, count - 1)

    def find(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Triangle of each point and the shares there; of one outside, at the nearest place."""
        low, high = self.x0.min(axis=0), self.x0.max(axis=0)
        size = float(np.sqrt(np.prod(high - low) / len(self.triangles)))  # a triangle a cell
        count = ((high - low) / size).astype(np.int64) + 1
        more = 1e-6 * size  # a hair, for points that rounding puts beyond the border
        first = self.cells(self.corners.min(axis=1) - more, low, size, count)
        last = self.cells(self.corners.max(axis=1) + more, low, size, count)
        wide, tall = (last - first + 1).T
        triangle, place = spread(wide * tall)
        column = first[triangle, 0] + place % wide[triangle]
        cell = (first[triangle, 1] + place // wide[triangle]) * count[0] + column
        order = np.argsort(cell, kind="stable")
        cell, triangle = cell[order], triangle[order]
        own = self.cells(points, low, size, count)
        own = own[:, 1] * count[0] + own[:, 0]
        begin = np.searchsorted(cell, own)
        point, place = spread(np.searchsorted(cell, own, "right") - begin)
        candidate = triangle[begin[point] + place]
        share = self.shares(candidate, points[point])
        inside = np.flatnonzero(share.min(axis=1) >= -ROUNDING)
        found, which = np.unique(point[inside], return_index=True)
        result = np.full(len(points), -1), np.zeros((len(points), 3))
        result[0][found] = candidate[inside[which]]
        result[1][found] = share[inside[which]]
        for i in np.flatnonzero(result[0] < 0):
            result[0][i], result[1][i] = self.nearest(points[i])
        return result

    def nearest(self, point: np.ndarray) -> tuple[int, np.ndarray]:
        """Over all triangles: few points are outside, those between a coarse mesh and a round
        outline."""
        start = self.corners
        side = np.roll(start, -1, axis=1) - start
        along = np.clip((side * (point - start)).sum(axis=2) / (side**2).sum(axis=2), 0.0, 1.0)
        places = start + along[:, :, None] * side
        best = int(((places - point)**2).sum(axis=2).argmin())
        triangle, corner = divmod(best, 3)
        return triangle, self.shares(np.array([triangle]), places[triangle, corner][None])[0]

    def interpolate(self, points: np.ndarray) -> np.ndarray:
        """The field, linear in each triangle."""
        triangle, share = self.find(points)
        return (share * self.nodal()[self.triangles[triangle]]).sum(axis=1)


def spread(counts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """0 0 0 1 1 ... and 0 1 2 0 1 ... for counts 3 2 ..."""
    of = np.repeat(np.arange(len(counts)), counts)
    return of, np.arange(len(of)) - np.repeat(np.cumsum(counts) - counts, counts)


def percentile(differences: np.ndarray, areas: np.ndarray) -> float:
    """The magnitude that SHARE of the area has at most."""
    order = np.argsort(abs(differences), kind="stable")
    below = np.cumsum(areas[order])
    # rounding of the sum must not push an exact share to the next value
    at = int(np.argmax(below >= SHARE * below[-1] * (1.0 - 1e-12)))
    return float(abs(differences[order[at]]))


def difference(run: State, reference: State) -> dict[str, float]:
    """rms, p99 and max over all plies, in the unit of the field."""
    if len(run.plies) != len(reference.plies):
        raise Trouble(f"a run of {len(run.plies)} plies cannot be compared with one of "
                      f"{len(reference.plies)}")
    apart, areas = [], []
    for ply, other in zip(run.plies, reference.plies):
        wanted = Sheet(other)
        apart.append(Sheet(ply).interpolate(wanted.x0) - wanted.nodal())
        areas.append(wanted.node_area)
    d, w = np.concatenate(apart), np.concatenate(areas)
    return {"rms": float(np.sqrt(np.average(d**2, weights=w))), "p99": percentile(d, w),
            "max": float(abs(d).max())}
