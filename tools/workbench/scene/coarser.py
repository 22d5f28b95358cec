# SPDX-License-Identifier: GPL-3.0-or-later
"""Large surfaces with fewer triangles, fast: for a picture that is drawn anew while a case is edited.
Vertices of one cell of a grid become one, in their middle. What goes together is kept, so that a tool
that is moved only is not gone through again."""

import hashlib

import numpy as np

MOST = 100_000  # triangles of a surface that is drawn as it is
SAMPLE = 20_000  # triangles by which the area is told
KEPT = 12  # surfaces

_known: dict[bytes, tuple[np.ndarray, np.ndarray]] = {}  # vertices' groups and triangles of groups


def coarser(x: np.ndarray, triangles: np.ndarray, most: int = MOST) -> tuple[np.ndarray, np.ndarray]:
    if len(triangles) <= most:
        return x, triangles
    key = hashlib.sha1(np.ascontiguousarray(triangles).tobytes() + f"{len(x)} {most}".encode()).digest()
    if key not in _known:
        while len(_known) >= KEPT:
            _known.pop(next(iter(_known)))
        _known[key] = grouped(x, triangles, most)
    group, few = _known[key]
    count = np.bincount(group)
    return np.stack([np.bincount(group, x[:, k]) / count for k in range(3)], axis=1), few


def grouped(x: np.ndarray, triangles: np.ndarray, most: int) -> tuple[np.ndarray, np.ndarray]:
    """With cells that grow until it is enough."""
    corners = x[triangles[::max(1, len(triangles) // SAMPLE)]]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    low, wide = x.min(axis=0), float((x.max(axis=0) - x.min(axis=0)).max())
    size = max(np.sqrt(areas.mean() * len(triangles) / most), wide / 2000.0, 1e-12)
    while True:
        group, few = merged(x, triangles, low, size)
        if len(few) <= most:
            return group, few
        size *= max(1.1, float(np.sqrt(len(few) / most)))


def merged(x: np.ndarray, triangles: np.ndarray, low: np.ndarray, size: float) -> tuple[np.ndarray, np.ndarray]:
    cell = ((x - low) / size).astype(np.int64)  # below 2000 along each side
    _, group = np.unique((cell[:, 0] << 40) + (cell[:, 1] << 20) + cell[:, 2], return_inverse=True)
    new = group[triangles]
    new = new[(new[:, 0] != new[:, 1]) & (new[:, 1] != new[:, 2]) & (new[:, 2] != new[:, 0])]
    _, first = np.unique(np.sort(new, axis=1), axis=0, return_index=True)
    return group, new[first]
