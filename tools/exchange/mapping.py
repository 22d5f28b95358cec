# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps formed plies onto the shell elements of another mesh.

The directions and thickness of a ply are constant in each of its triangles. They are smoothed first:
a node has the mean of the triangles round it, weighted by their area, and between nodes they are
linear. An element is cut into small triangles, no larger than half of the ply's; from the middle of
each the closest point of the ply is taken among triangles that face the same way; directions are
turned by the least turn from the ply's normal there to the element's; and the element has the mean
of its small triangles, weighted by their area.
"""

from dataclasses import dataclass

import numpy as np

from exchange.closest import Surface
from exchange.formed import FormedPly
from exchange.shell_mesh import (ShellMesh, border_edges, centroids, element_normals, patches,
                                 split, triangle_normals, unit)

LEAST_COSINE = 0.3   # between the normals of ply and element: 73 degrees, as at sharp corners
MOST_CUTS = 8        # along a side of an element: 64 closest points each, a minute of 100 000
NEARNESS = 0.05      # of the largest distance: nearer elements do not count more
OVERHANG = 0.02      # of a triangle's side: beyond the ply's border by more is not covered


@dataclass
class MappedPly:
    """One ply on m elements. Where `share` is below the least one asked for, nothing is covered and
    all but `share` is NaN."""
    name: str
    nominal_angle_deg: float
    nominal_thickness: float
    yarn_angle_deg: float
    share: np.ndarray      # m: of the element's area that the ply covers
    warp: np.ndarray       # m x 3, unit vectors in the element's plane
    weft: np.ndarray       # m x 3
    thickness: np.ndarray  # m, mm
    shear_deg: np.ndarray  # m
    distance: np.ndarray   # m, mm: mean of those from the element to the ply
    side: np.ndarray       # m: 1 if the element's normal points up the stack, -1 if down, 0 unknown
    woven: bool = True     # else the layer of one family of yarns
    areal_weight: np.ndarray | None = None  # m, g/m2
    fibre_density: float | None = None      # kg/m3
    gap: np.ndarray | None = None           # m, mm, of the closed mould; NaN where there is none

    def covered(self) -> np.ndarray:
        return np.isfinite(self.thickness)

    def fibre_volume(self) -> np.ndarray | None:
        """m: of the layer by itself, by its areal weight and thickness; None where it is not known."""
        if self.areal_weight is None or self.fibre_density is None:
            return None
        return self.areal_weight / (self.fibre_density * self.thickness)


class SmoothPly:
    """A formed ply with values at its nodes, linear between them."""

    def __init__(self, ply: FormedPly):
        self.ply = ply
        self.normals, areas = triangle_normals(ply.x, ply.triangles)
        self.surface = Surface(ply.x, ply.triangles, self.normals)
        self.node_normals = unit(self._at_nodes(self.normals, areas))
        self.warp = self._at_nodes(ply.warp, areas)
        self.weft = self._at_nodes(ply.weft, areas)
        self.thickness = self._at_nodes(ply.thickness[:, None], areas)[:, 0]
        self.areal_weight = (None if ply.areal_weight is None else
                             self._at_nodes(ply.areal_weight[:, None], areas)[:, 0])
        self.gap = None if ply.gap is None else self._known_at_nodes(ply.gap, areas)
        self.border = border_edges(ply.triangles)
        sides = ply.x[ply.triangles] - ply.x[np.roll(ply.triangles, -1, axis=1)]
        self.side = float(np.linalg.norm(sides, axis=2).mean())

    def _at_nodes(self, values: np.ndarray, areas: np.ndarray) -> np.ndarray:
        nodes, count = self.ply.triangles.T.ravel(), len(self.ply.x)
        weight = np.bincount(nodes, np.tile(areas, 3), count)
        total = np.column_stack([np.bincount(nodes, np.tile(areas * one, 3), count)
                                 for one in values.T])
        return total / np.maximum(weight, 1e-300)[:, None]

    def _known_at_nodes(self, values: np.ndarray, areas: np.ndarray) -> np.ndarray:
        """Of the triangles round a node those where the value is known."""
        known = np.isfinite(values)
        there = np.where(known, areas, 0.0)
        mean = self._at_nodes(np.where(known, values, 0.0)[:, None], there)[:, 0]
        return np.where(mean > 0, mean, np.nan)

    def at(self, triangle: np.ndarray, weights: np.ndarray) -> tuple[np.ndarray, ...]:
        """Normal, warp, weft (k x 3, unit vectors, yarns along the ply) and thickness (k)."""
        nodes = self.ply.triangles[triangle]
        def mean(values):
            return np.einsum("ij,ijk->ik", weights, values[nodes])
        normal = unit(mean(self.node_normals))
        yarns = [unit(v - (v * normal).sum(axis=1, keepdims=True) * normal)
                 for v in (mean(self.warp), mean(self.weft))]
        return normal, *yarns, (weights * self.thickness[nodes]).sum(axis=1)

    def beside(self, p: np.ndarray, triangle: np.ndarray, weights: np.ndarray) -> np.ndarray:
        """Whether points p lie beyond the ply's border: their closest points are on it, and they
        are off to the side rather than above or below."""
        corners = self.surface.corners[triangle]
        off = p - np.einsum("ij,ijk->ik", weights, corners)
        normal = self.normals[triangle]
        along = np.linalg.norm(off - (off * normal).sum(axis=1, keepdims=True) * normal, axis=1)
        on_border = (self.border[triangle] & (weights[:, [2, 0, 1]] < 1e-9)).any(axis=1)
        return on_border & (along > OVERHANG * self.side)


@dataclass
class Samples:
    """Small triangles of elements: k of them."""
    points: np.ndarray   # k x 3, mm: their middles
    areas: np.ndarray    # k, mm2
    element: np.ndarray  # k


def sample(mesh: ShellMesh, size: float, most: int = MOST_CUTS) -> Samples:
    """Cuts each element into triangles with sides of some `size` mm at most, its sides into `most`
    parts at most. A quadrilateral of half that size stays whole."""
    triangles, owner = split(mesh)
    corners = mesh.nodes[triangles]
    longest = np.sqrt(((corners - np.roll(corners, -1, axis=1)) ** 2).sum(axis=2).max(axis=1))
    areas, count = triangle_normals(mesh.nodes, triangles)[1], len(mesh.corners)
    worst, total = longest[:count].copy(), np.bincount(owner, areas, count)
    worst[owner[count:]] = np.maximum(worst[owner[count:]], longest[count:])
    whole = ~mesh.triangular() & (worst <= 0.5 * size)
    points, parts, owners = [centroids(mesh)[whole]], [total[whole]], [np.flatnonzero(whole)]
    cuts = np.where(whole[owner], 0, np.clip(np.ceil(longest / size), 1, most)).astype(int)
    for n in np.unique(cuts[cuts > 0]):
        middles = small_triangles(n)
        there = np.flatnonzero(cuts == n)
        points.append(np.einsum("sk,tkx->tsx", middles, corners[there]).reshape(-1, 3))
        parts.append(np.repeat(areas[there] / n**2, n**2))
        owners.append(np.repeat(owner[there], n**2))
    return Samples(np.vstack(points), np.concatenate(parts), np.concatenate(owners))


def small_triangles(n: int) -> np.ndarray:
    """n² x 3: barycentric coordinates of the middles of n² equal parts of a triangle."""
    middles = [(i + 1 / 3, j + 1 / 3) for i in range(n) for j in range(n - i)]
    middles += [(i + 2 / 3, j + 2 / 3) for i in range(n) for j in range(n - 1 - i)]
    v, w = np.array(middles).T / n
    return np.column_stack([1 - v - w, v, w])


def sides_of(mesh: ShellMesh, plies: list[SmoothPly], limit: float,
             trust_normals: bool) -> np.ndarray:
    """m: 1 where an element's normal points up the stack, -1 where down, 0 where no ply is near.
    Each patch of elements is taken to have one side, whichever way round its elements run; it is
    the one that most of the area beside a ply shows, the more the nearer it is: of a closed skin the
    face that the ply lies on. With trust_normals the whole mesh is one
    patch whose elements all run the right way round."""
    normals, areas = element_normals(mesh)
    patch, turned = patches(mesh)
    if trust_normals:
        patch, turned = np.zeros(len(areas), int), np.zeros(len(areas), bool)
    sign = np.where(turned, -1, 1)
    middles = centroids(mesh)
    votes = np.zeros(patch.max() + 1)
    for ply in plies:
        triangle, _, distance = ply.surface.closest(middles, limit)
        there = triangle >= 0
        near = 1.0 / (distance[there] + NEARNESS * limit)
        element = np.flatnonzero(there)
        cosine = (ply.normals[triangle[there]] * normals[element]).sum(axis=1) * sign[element]
        clear = np.abs(cosine) >= LEAST_COSINE
        votes += np.bincount(patch[element[clear]], (cosine * areas[element] * near)[clear],
                             len(votes))
    return (np.sign(votes)[patch] * sign).astype(int)


def map_ply(ply: SmoothPly, mesh: ShellMesh, side: np.ndarray, limit: float,
            least_share: float = 0.5, most_cuts: int = MOST_CUTS) -> MappedPly:
    """`side` as of sides_of; `limit`: the largest distance to map over, mm; `most_cuts`: along a
    side of an element."""
    count = len(mesh.corners)
    normals, areas = element_normals(mesh)
    up = normals * side[:, None]
    samples = sample(mesh, 0.5 * ply.side, most_cuts)
    there = side[samples.element] != 0
    points, element = samples.points[there], samples.element[there]
    triangle, weights, distance = ply.surface.closest(points, limit, up[element], LEAST_COSINE)
    hit = triangle >= 0
    hit[hit] = ~ply.beside(points[hit], triangle[hit], weights[hit])
    element, area = element[hit], samples.areas[there][hit]
    normal, warp, weft, thickness = ply.at(triangle[hit], weights[hit])

    def mean(values):
        if values.ndim == 1:
            return np.bincount(element, values * area, count)
        return np.column_stack([np.bincount(element, one * area, count) for one in values.T])
    weight = mean(np.ones(len(element)))
    total = np.bincount(samples.element, samples.areas, count)
    share = weight / np.maximum(total, 1e-300)
    bare = (share < least_share) | (weight == 0)
    share = np.where(weight == 0, 0.0, share)
    off = np.where(bare, np.nan, 1.0)
    weight = np.maximum(weight, 1e-300)
    warp = unit(mean(turn(warp, normal, up[element]))) * off[:, None]
    weft = unit(mean(turn(weft, normal, up[element]))) * off[:, None]
    between = np.degrees(np.arccos(np.clip((warp * weft).sum(axis=1), -1, 1)))
    of, nodes = ply.ply, ply.ply.triangles[triangle[hit]]

    def values_of(at_nodes):
        """Means over what is known, where that is most of the element."""
        if at_nodes is None:
            return None
        values = (weights[hit] * at_nodes[nodes]).sum(axis=1)
        known = np.isfinite(values)
        part = mean(np.where(known, 1.0, 0.0))
        found = mean(np.where(known, values, 0.0)) / np.maximum(part, 1e-300)
        return np.where(part >= 0.5 * weight, found, np.nan) * off
    return MappedPly(of.name, of.angle_deg, of.nominal_thickness, of.yarn_angle_deg, share, warp,
                     weft, mean(thickness) / weight * off, of.yarn_angle_deg - between,
                     mean(distance[hit]) / weight * off, np.where(bare, 0, side), of.woven,
                     values_of(ply.areal_weight), of.fibre_density, values_of(ply.gap))


def turn(vectors: np.ndarray, start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Vectors (k x 3) turned by the least turn that takes unit vectors start to end, which are not
    opposite (Rodrigues)."""
    axis = np.cross(start, end)
    cosine = (start * end).sum(axis=1, keepdims=True)
    return (cosine * vectors + np.cross(axis, vectors)
            + axis * (axis * vectors).sum(axis=1, keepdims=True) / (1 + cosine))


def on_own_mesh(ply: FormedPly) -> MappedPly:
    """As the run has it, triangle by triangle: nothing is smoothed."""
    count = len(ply.triangles)
    return MappedPly(ply.name, ply.angle_deg, ply.nominal_thickness, ply.yarn_angle_deg,
                     np.ones(count), ply.warp, ply.weft, ply.thickness, ply.shear_deg,
                     np.zeros(count), np.ones(count, int), ply.woven, ply.areal_weight,
                     ply.fibre_density, ply.gap)
