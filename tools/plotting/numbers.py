# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines across plies, and ratios of curves: numbers without pictures.

Lengths in mm, angles in degrees. x0 and x are n x 3, triangles m x 3.
"""

from dataclasses import dataclass

import numpy as np

from .reading import Trouble


def outline(x: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Edges (k x 2 x 2, mm) at which a surface ends or turns over, seen along z."""
    corners = x[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    up = normals[:, 2] / np.maximum(np.linalg.norm(normals, axis=1), 1e-30)
    side = np.sign(np.where(abs(up) < 1e-6, 0.0, up))  # 0: a wall along z
    edges, of_side, count = edges_of(triangles)
    low, high = np.full(len(edges), 2.0), np.full(len(edges), -2.0)
    np.minimum.at(low, of_side, np.repeat(side, 3))
    np.maximum.at(high, of_side, np.repeat(side, 3))
    return x[edges[(count == 1) | (low < high)]][:, :, :2]


def edges_of(triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The edges (nodes in order), the edge of each side of each triangle (3 m) and how many
    triangles each edge has."""
    sides = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, of_side, count = np.unique(sides, axis=0, return_inverse=True, return_counts=True)
    return edges, of_side.reshape(-1), count


def border_loop(x0: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Nodes of the outer border in order, anticlockwise seen along -z: of the loops of edges that
    one triangle has, the one round the largest area."""
    edges, _, count = edges_of(triangles)
    edges = edges[count == 1]
    neighbours: dict[int, list[int]] = {}
    for a, b in edges.tolist():
        neighbours.setdefault(a, []).append(b)
        neighbours.setdefault(b, []).append(a)
    if not neighbours or any(len(n) != 2 for n in neighbours.values()):
        raise Trouble("has no border that meets itself nowhere; take a ring")
    best, best_area = np.zeros(0, dtype=int), 0.0
    while neighbours:
        loop = [next(iter(neighbours))]
        ahead = neighbours.pop(loop[0])
        while following := [n for n in ahead if n in neighbours]:
            loop.append(following[0])
            ahead = neighbours.pop(loop[-1])
        x, y = x0[loop, 0], x0[loop, 1]
        area = 0.5 * np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)
        if abs(area) > abs(best_area):
            best, best_area = np.array(loop), area
    return best if best_area > 0.0 else best[::-1]


def mean_side(x0: np.ndarray, triangles: np.ndarray) -> float:
    corners = x0[triangles]
    return float(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean())


def locate(points: np.ndarray, x0: np.ndarray, triangles: np.ndarray):
    """Triangle (-1: none) and three weights of points (p x 2) in the unformed ply from above."""
    a, b, c = (x0[triangles[:, k], :2] for k in range(3))
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    area = np.where(area == 0.0, np.nan, area)  # a triangle on edge holds no point
    found, weights = np.full(len(points), -1), np.zeros((len(points), 3))
    for i, p in enumerate(points):
        to_a, to_b, to_c = a - p, b - p, c - p
        w = np.stack([to_b[:, 0] * to_c[:, 1] - to_b[:, 1] * to_c[:, 0],
                      to_c[:, 0] * to_a[:, 1] - to_c[:, 1] * to_a[:, 0],
                      to_a[:, 0] * to_b[:, 1] - to_a[:, 1] * to_b[:, 0]], axis=1) / area[:, None]
        smallest = np.nan_to_num(w.min(axis=1), nan=-np.inf)
        if smallest.max() >= -1e-9:  # else round-off would lose points on edges
            found[i] = smallest.argmax()
            weights[i] = w[found[i]]
    return found, weights


@dataclass
class Section:
    """A straight cut through the unformed ply, in pieces between the edges that it crosses."""
    ends: np.ndarray    # k x 2: distance of each piece's ends from the point the line goes through
    value: np.ndarray   # k: mean of the triangles that hold the piece: two where it runs on an edge
    formed: np.ndarray  # k x 2 x 3: where the ends of each piece are in the formed ply


def section(x0: np.ndarray, x: np.ndarray, triangles: np.ndarray, value: np.ndarray,
            through: tuple[float, float], direction_deg: float) -> Section:
    """Cuts along the line through `through` at `direction_deg` from x; pieces in its direction."""
    angle = np.radians(direction_deg)
    along = np.array([np.cos(angle), np.sin(angle)])
    across = np.array([-along[1], along[0]])
    size = np.ptp(x0[:, :2], axis=0).max()
    s, d = (x0[:, :2] - through) @ along, (x0[:, :2] - through) @ across
    d[abs(d) < 1e-9 * size] = 0.0  # nodes on the line but for round-off
    cuts = []  # of each triangle that the line cuts: number, two distances, two formed points
    sides = d[triangles]
    for t in np.flatnonzero((sides.min(axis=1) <= 0.0) & (sides.max(axis=1) >= 0.0)):
        meets = [(s[n], x[n]) for n in triangles[t] if d[n] == 0.0]
        for a, b in zip(triangles[t], np.roll(triangles[t], -1)):
            if d[a] * d[b] < 0.0:
                w = d[a] / (d[a] - d[b])
                meets.append(((1.0 - w) * s[a] + w * s[b], (1.0 - w) * x[a] + w * x[b]))
        meets.sort(key=lambda meet: meet[0])
        if len(meets) > 1 and meets[-1][0] - meets[0][0] > 1e-9 * size:
            cuts.append((t, meets[0], meets[-1]))
    if not cuts:
        raise Trouble("the section does not cross it")
    return pieces_of(cuts, value, 1e-9 * size)


def pieces_of(cuts: list, value: np.ndarray, same: float) -> Section:
    number = np.array([t for t, _, _ in cuts])
    start, end = (np.array([cut[k][0] for cut in cuts]) for k in (1, 2))
    x_start, x_end = (np.array([cut[k][1] for cut in cuts]) for k in (1, 2))
    breaks = np.sort(np.concatenate([start, end]))
    breaks = breaks[np.concatenate([[True], np.diff(breaks) > same])]
    ends, means, formed = [], [], []
    for low, high in zip(breaks[:-1], breaks[1:]):
        middle = 0.5 * (low + high)
        holds = np.flatnonzero((start < middle) & (middle < end))
        if len(holds) == 0:
            continue  # a hole
        h = holds[0]
        share = (np.array([low, high]) - start[h]) / (end[h] - start[h])
        ends.append((low, high))
        means.append(value[number[holds]].mean())
        formed.append(x_start[h] + share[:, None] * (x_end[h] - x_start[h]))
    return Section(np.array(ends), np.array(means), np.array(formed))


def polar_angle(points: np.ndarray, ends: np.ndarray, centre: np.ndarray) -> np.ndarray:
    """Angle (k x 2) of the formed points of a section at `centre`, from the vertical through it on
    the side where the section comes nearest to it; negative before that place, positive after."""
    from_centre = points - centre
    off_axis = np.hypot(from_centre[..., 0], from_centre[..., 1])
    pole = np.unravel_index(off_axis.argmin(), off_axis.shape)
    up = 1.0 if from_centre[pole][2] >= 0.0 else -1.0
    angle = np.degrees(np.arctan2(off_axis, up * from_centre[..., 2]))
    return np.where(ends < ends[pole], -angle, angle)


def interpolate(at: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """y(x) at `at`; NaN outside. x must rise."""
    known = np.isfinite(x) & np.isfinite(y)
    x, y = x[known], y[known]
    if len(x) == 0 or np.any(np.diff(x) <= 0.0):
        raise Trouble("does not rise from row to row")
    return np.interp(at, x, y, left=np.nan, right=np.nan)


def deviation(value: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """value / reference - 1 in percent; NaN where the reference is a thousandth of its largest
    magnitude or less, where the ratio of two small numbers says nothing."""
    small = 1e-3 * np.nanmax(abs(reference), initial=0.0)
    safe = np.where(abs(reference) > small, reference, np.nan)
    return 100.0 * (value / safe - 1.0)


def nodal_means(x0: np.ndarray, triangles: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Means by area of a value a triangle at the nodes of the unformed ply."""
    corners = x0[triangles][:, :, :2]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    weight = np.bincount(triangles.ravel(), np.repeat(area, 3), len(x0))
    return np.bincount(triangles.ravel(), np.repeat(area * values, 3), len(x0)) / weight


def values_at(points: np.ndarray, x0: np.ndarray, triangles: np.ndarray,
              values: np.ndarray) -> np.ndarray:
    """A value a triangle at points (p x 2) of the unformed ply, linear between its nodal means;
    NaN outside. Meshes of any kind can so be compared."""
    at_node = nodal_means(x0, triangles, values)
    found, weights = locate(points, x0, triangles)
    return np.where(found >= 0, (at_node[triangles[found]] * weights).sum(axis=1), np.nan)
