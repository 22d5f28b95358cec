# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of shell elements with three or four corners, and their geometry. Lengths in mm."""

from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

SAME_PLACE = 1e-6  # of the mesh's diagonal: nodes so near are one where patches are looked for


@dataclass
class ShellMesh:
    """n nodes, m elements."""
    nodes: np.ndarray                 # n x 3, mm
    corners: np.ndarray               # m x 4, rows of nodes; -1 in the last of triangles
    labels: np.ndarray                # m, the file's numbers of the elements
    node_labels: np.ndarray           # n
    parts: np.ndarray                 # m, the file's part or property of each element
    path: Path | None = None          # none: a ply's own mesh
    left_out: Counter = field(default_factory=Counter)  # elements that are no shells, by type
    middles: np.ndarray | None = None  # m x 4, rows of nodes: that of the side from a corner to the
    #                                    next, -1 where there is none; none: no element has any
    axes: np.ndarray | None = None     # m x 3: along the material axes of the file; none: it has none
    axes_words: str = ""               # where these are from
    notes: list[str] = field(default_factory=list)  # of the file, what was not read

    def triangular(self) -> np.ndarray:
        return self.corners[:, 3] < 0

    def size(self) -> float:
        """Diagonal of the box round all elements, mm."""
        used = self.nodes[self.corners[self.corners >= 0]]
        return float(np.linalg.norm(used.max(axis=0) - used.min(axis=0)))


def unit(vectors: np.ndarray) -> np.ndarray:
    """Of k x 3; a vector without length stays zero."""
    return vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-300)


def split(mesh: ShellMesh) -> tuple[np.ndarray, np.ndarray]:
    """Triangles (k x 3) and the element of each (k); a quadrilateral makes two."""
    quads = np.flatnonzero(~mesh.triangular())
    triangles = np.vstack([mesh.corners[:, :3], mesh.corners[quads][:, [0, 2, 3]]])
    return triangles, np.concatenate([np.arange(len(mesh.corners)), quads])


def triangle_normals(x: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Unit normals (k x 3) and areas (k)."""
    a, b, c = (x[triangles[:, k]] for k in range(3))
    cross = np.cross(b - a, c - a)
    return unit(cross), 0.5 * np.linalg.norm(cross, axis=1)


def element_normals(mesh: ShellMesh) -> tuple[np.ndarray, np.ndarray]:
    """Unit normals (m x 3) by the right-hand rule along the corners, and areas (m). Of a
    quadrilateral the normal to both diagonals, as all programs take it."""
    a, b, c, d = (mesh.nodes[mesh.corners[:, k]] for k in range(4))
    triangular = mesh.triangular()[:, None]
    cross = np.where(triangular, np.cross(b - a, c - a), np.cross(c - a, d - b))
    return unit(cross), 0.5 * np.linalg.norm(cross, axis=1)


def centroids(mesh: ShellMesh) -> np.ndarray:
    """m x 3: means of the corners."""
    corners = mesh.nodes[mesh.corners]
    corners[mesh.triangular(), 3] = 0.0
    return corners.sum(axis=1) / np.where(mesh.triangular(), 3, 4)[:, None]


def crossed(mesh: ShellMesh) -> np.ndarray:
    """Rows of quadrilaterals whose sides cross, as those of a bow-tie: of the turns at their corners
    two are against the other two. A quadrilateral with one corner pushed in has one such turn."""
    quads = np.flatnonzero(~mesh.triangular())
    x = mesh.nodes[mesh.corners[quads]]
    ahead = np.roll(x, -1, axis=1) - x
    turns = np.cross(np.roll(ahead, 1, axis=1), ahead)
    along = (turns * turns[:, :1]).sum(axis=2)
    return quads[(along < 0).sum(axis=1) == 2]


def edges_of(mesh: ShellMesh, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Directed edges (k x 2) in the order of `corners` (m x 4), and the element of each (k)."""
    triangular = mesh.triangular()
    ends, owners = [], []
    for k in range(4):
        there = np.arange(len(corners)) if k < 3 else np.flatnonzero(~triangular)
        last = np.where(triangular[there] & (k == 2), 0, (k + 1) % 4)
        ends.append(np.column_stack([corners[there, k], corners[there, last]]))
        owners.append(there)
    return np.vstack(ends), np.concatenate(owners)


def edge_keys(ends: np.ndarray) -> np.ndarray:
    """A number for each edge (k x 2), the same whichever way it runs."""
    return ends.min(axis=1) * (int(ends.max()) + 1) + ends.max(axis=1)


def one_a_place(mesh: ShellMesh) -> np.ndarray:
    """Corners (m x 4) in which nodes at the same place are one: meshes with unmerged nodes hang
    together as they look."""
    low = mesh.nodes[mesh.corners[:, :3]].reshape(-1, 3).min(axis=0)
    step = max(SAME_PLACE * mesh.size(), 1e-300)
    cell = np.round((mesh.nodes - low) / step)
    cell = np.clip(cell, -1, 1 / SAME_PLACE + 1).astype(np.int64) + 1  # nodes that are not used
    key = (cell[:, 0] << 42) | (cell[:, 1] << 21) | cell[:, 2]
    _, row = np.unique(key, return_inverse=True)
    return np.where(mesh.corners >= 0, row[mesh.corners], -1)


def neighbours(mesh: ShellMesh) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Pairs of elements (k, k) that share an edge with each other and with no third, and whether
    they walk round differently (k). An element that is there twice is no neighbour of itself."""
    corners = one_a_place(mesh)
    ends, owners = edges_of(mesh, corners)
    long = ends[:, 0] != ends[:, 1]
    ends, owners = ends[long], owners[long]
    key = edge_keys(ends)
    order = np.argsort(key, kind="stable")
    same = key[order][1:] == key[order][:-1]
    first = np.flatnonzero(same & ~np.r_[False, same[:-1]] & ~np.r_[same[1:], False])
    one, two = order[first], order[first + 1]
    apart = (np.sort(corners[owners[one]], axis=1) != np.sort(corners[owners[two]], axis=1)).any(axis=1)
    one, two = one[apart], two[apart]
    # neighbours that agree walk along their edge in opposite directions
    return owners[one], owners[two], ends[one, 0] == ends[two, 0]


def patches(mesh: ShellMesh) -> tuple[np.ndarray, np.ndarray]:
    """The patch of each element (m), and whether its corners run the other way round than those of
    the patch's first element (m). A patch is what hangs together by edges of exactly two elements:
    where three meet, at the foot of a rib, patches end; an element that shares none is one by
    itself. So is each element of a strip with one side only (Moebius)."""
    count = len(mesh.corners)
    a, b, differ = neighbours(mesh)
    # each element twice, as it runs and turned round: what agrees hangs together in both copies
    other = np.where(differ, count, 0)
    pairs = (np.concatenate([a, a + count]), np.concatenate([b + other, b + count - other]))
    link = coo_matrix((np.ones(len(pairs[0]), np.int8), pairs), shape=(2 * count, 2 * count))
    _, part = connected_components(link, directed=False)
    straight, turned = part[:count], part[count:]
    patch = np.minimum(straight, turned)
    alone = straight == turned
    patch[alone] = part.max() + 1 + np.flatnonzero(alone)
    _, starts, patch = np.unique(patch, return_index=True, return_inverse=True)
    patch = patch.ravel()
    return patch, ~alone & (straight != straight[starts][patch])


def border_edges(triangles: np.ndarray) -> np.ndarray:
    """m x 3 booleans: whether edge k of a triangle, from corner k to the next, has it alone."""
    ends = np.vstack([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    _, back, count = np.unique(edge_keys(ends), return_inverse=True, return_counts=True)
    return (count[back.ravel()] == 1).reshape(3, -1).T
