# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of shell elements with three or four corners, and their geometry. Lengths in mm."""

from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import breadth_first_order, connected_components


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

    def triangular(self) -> np.ndarray:
        return self.corners[:, 3] < 0

    def size(self) -> float:
        """Diagonal of the box round all elements, mm."""
        used = self.nodes[np.unique(self.corners[self.corners >= 0])]
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


def edges_of(mesh: ShellMesh) -> tuple[np.ndarray, np.ndarray]:
    """Directed edges (k x 2) in the order of the corners, and the element of each (k)."""
    triangular = mesh.triangular()
    ends, owners = [], []
    for k in range(4):
        there = np.arange(len(mesh.corners)) if k < 3 else np.flatnonzero(~triangular)
        last = np.where(triangular[there] & (k == 2), 0, (k + 1) % 4)
        ends.append(np.column_stack([mesh.corners[there, k], mesh.corners[there, last]]))
        owners.append(there)
    return np.vstack(ends), np.concatenate(owners)


def patches(mesh: ShellMesh) -> tuple[np.ndarray, np.ndarray]:
    """The patch of each element (m), and whether its corners run the other way round than those of
    the patch's first element (m). A patch is what hangs together by edges of exactly two elements:
    where three meet, at the foot of a rib, patches end."""
    ends, owners = edges_of(mesh)
    count = len(mesh.corners)
    key = np.sort(ends, axis=1)
    order = np.lexsort(key.T)
    same = np.all(key[order][1:] == key[order][:-1], axis=1)
    first = np.flatnonzero(same & ~np.r_[False, same[:-1]] & ~np.r_[same[1:], False])
    one, two = order[first], order[first + 1]
    # neighbours that agree walk along their edge in opposite directions
    differ = ends[one, 0] == ends[two, 0]
    a, b = owners[one], owners[two]
    link = coo_matrix((np.where(differ, 2, 1), (a, b)), shape=(count, count)).tocsr()
    link = link.maximum(link.T)
    amount, patch = connected_components(link, directed=False)
    turned = np.zeros(count, bool)
    _, starts = np.unique(patch, return_index=True)
    for start in starts[:amount]:
        walk, before = breadth_first_order(link, start, directed=False)
        differs = np.asarray(link[walk[1:], before[walk[1:]]]).ravel() == 2
        for element, parent, other in zip(walk[1:], before[walk[1:]], differs):
            turned[element] = turned[parent] ^ other
    return patch, turned


def border_edges(triangles: np.ndarray) -> np.ndarray:
    """m x 3 booleans: whether edge k of a triangle, from corner k to the next, has it alone."""
    ends = np.vstack([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    _, back, count = np.unique(np.sort(ends, axis=1), axis=0, return_inverse=True,
                               return_counts=True)
    return (count[back.ravel()] == 1).reshape(3, -1).T
