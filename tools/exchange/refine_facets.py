# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles brought to a curved surface: sides that miss it are halved, and the middles put on it.

gmsh leaves triangles round the pole of a sphere larger than asked for, whatever the mesher."""

from collections.abc import Callable

import numpy as np

ROUNDS = 12     # each halves sides
MOST = 1000000  # triangles from which no more sides are halved
SHARE = 0.7  # of the deflection that sides and middles of triangles may have: room for other places

RIM = -1  # in the place of the face that is beyond the rim of an open surface

# project(tags of faces, points) -> points on them: one tag for the inside of a face, two for the
# curve between two faces, or between a face and RIM
Project = Callable[[tuple[int, ...], np.ndarray], np.ndarray]


def refined(x: np.ndarray, triangles: np.ndarray, face: np.ndarray, project: Project,
            deflection: float | dict[int, float]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points (mm), triangles and their faces, such that the middles of sides and of triangles are
    within SHARE of the deflection, which each face may have its own of, from the surface, as far as
    ROUNDS rounds take it."""
    known: dict[tuple[int, int], np.ndarray] = {}
    for _ in range(ROUNDS):
        limit = SHARE * np.array([deflection[tag] for tag in face.tolist()]
                                 if isinstance(deflection, dict) else [deflection] * len(face))
        sides, side_limit = sides_of(triangles, limit)
        project_sides(x, sides, triangles, face, project, known)
        middles = 0.5 * (x[sides[:, 0]] + x[sides[:, 1]])
        on_surface = np.array([known[side] for side in map(tuple, sides.tolist())])
        split = np.linalg.norm(on_surface - middles, axis=1) > side_limit
        split |= longest_of(x, sides, triangles, bulging(x, triangles, face, project, limit))
        if not split.any() or len(triangles) > MOST:
            break
        number = {tuple(side): len(x) + k for k, side in enumerate(sides[split].tolist())}
        x = np.vstack([x, on_surface[split]])
        parts = [(part, tag) for corners, tag in zip(triangles.tolist(), face.tolist())
                 for part in cut(corners, number)]
        triangles = np.array([part for part, _ in parts])
        face = np.array([tag for _, tag in parts])
    return x, triangles, face


def sides_of(triangles: np.ndarray, limit: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Sides (k x 2), and the least limit of the triangles at each."""
    every = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]],
                                    triangles[:, [2, 0]]]), axis=1)
    sides, number = np.unique(every, axis=0, return_inverse=True)
    least = np.full(len(sides), np.inf)
    np.minimum.at(least, number.ravel(), np.tile(limit, 3))
    return sides, least


def project_sides(x: np.ndarray, sides: np.ndarray, triangles: np.ndarray, face: np.ndarray,
                  project: Project, known: dict[tuple[int, int], np.ndarray]) -> None:
    """Adds to `known` the points of the surface next to the middles of sides."""
    tags: dict[tuple[int, int], list[int]] = {}
    for (a, b, c), tag in zip(triangles.tolist(), face.tolist()):
        for one, two in ((a, b), (b, c), (c, a)):
            tags.setdefault((min(one, two), max(one, two)), []).append(tag)
    groups: dict[tuple[int, ...], list[tuple[int, int]]] = {}
    for side in map(tuple, sides.tolist()):
        if side not in known:
            beside = tags[side] if len(tags[side]) > 1 else [*tags[side], RIM]
            groups.setdefault(tuple(sorted(set(beside))), []).append(side)
    for tag, some in groups.items():
        ends = np.array(some)
        points = project(tag, 0.5 * (x[ends[:, 0]] + x[ends[:, 1]]))
        known.update(zip(some, points))


def bulging(x: np.ndarray, triangles: np.ndarray, face: np.ndarray, project: Project,
            limit: np.ndarray) -> np.ndarray:
    """Whether the middles of triangles miss the surface by more than their limits."""
    middles, away = x[triangles].mean(axis=1), np.zeros(len(triangles))
    for tag in np.unique(face):
        here = face == tag
        away[here] = np.linalg.norm(project((int(tag),), middles[here]) - middles[here], axis=1)
    return away > limit


def longest_of(x: np.ndarray, sides: np.ndarray, triangles: np.ndarray,
               chosen: np.ndarray) -> np.ndarray:
    """Which sides are the longest of a chosen triangle."""
    corners = triangles[chosen]
    pairs = np.stack([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]], axis=1)
    lengths = np.linalg.norm(x[pairs[..., 0]] - x[pairs[..., 1]], axis=-1)
    longest = np.sort(pairs[np.arange(len(pairs)), lengths.argmax(axis=1)], axis=1)
    return np.isin(sides[:, 0] * (len(x) + 1) + sides[:, 1],
                   longest[:, 0] * (len(x) + 1) + longest[:, 1])


def cut(corners: list[int], number: dict[tuple[int, int], int]) -> list[list[int]]:
    """The triangle, or its parts: `number` has the new points of sides."""
    a, b, c = corners
    ab, bc, ca = (number.get((min(one, two), max(one, two)))
                  for one, two in ((a, b), (b, c), (c, a)))
    count = sum(middle is not None for middle in (ab, bc, ca))
    if count == 0:
        return [corners]
    if count == 3:
        return [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    while ab is None or (count == 2 and bc is None):  # turn the first new points to the front
        a, b, c, ab, bc, ca = b, c, a, bc, ca, ab
    if count == 1:
        return [[a, ab, c], [ab, b, c]]
    return [[ab, b, bc], [a, ab, bc], [a, bc, c]]
