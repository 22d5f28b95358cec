# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes in the middle of the sides of shells, for programs that need them."""

from dataclasses import dataclass

import numpy as np

from exchange.shell_mesh import ShellMesh, edge_keys, edges_of


@dataclass
class SecondOrder:
    """A shell mesh with a node in the middle of each side."""
    nodes: np.ndarray        # n x 3, mm: those of the mesh, then those made
    node_labels: np.ndarray  # n
    middles: np.ndarray      # m x 4: rows of nodes, of the side from each corner to the next; -1: none
    made: int                # nodes that the mesh did not have


def second_order(mesh: ShellMesh) -> SecondOrder:
    """The mesh's own nodes where it has them, also those of a neighbour; others are made half way along
    straight sides, with numbers above all of the mesh."""
    ends, owners = edges_of(mesh, mesh.corners)
    count = len(mesh.corners)
    side = np.minimum(np.arange(len(ends)) // count, 3)
    _, first, edge = np.unique(edge_keys(ends), return_index=True, return_inverse=True)
    edge = edge.ravel()
    of_edge = np.full(len(first), -1)
    if mesh.middles is not None:
        np.maximum.at(of_edge, edge, mesh.middles[owners, side])
    bare = np.flatnonzero(of_edge < 0)
    of_edge[bare] = len(mesh.nodes) + np.arange(len(bare))
    places = mesh.nodes[ends[first[bare]]].mean(axis=1)
    middles = np.full((count, 4), -1)
    middles[owners, side] = of_edge[edge]
    labels = int(mesh.node_labels.max()) + 1 + np.arange(len(bare))
    return SecondOrder(np.vstack([mesh.nodes, places.reshape(-1, 3)]),
                       np.concatenate([mesh.node_labels, labels]), middles, len(bare))
