# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the parallel surface of a sheet would cross itself, and how far it is from the sheet. Lengths
in mm."""

from dataclasses import dataclass

import numpy as np

from exchange.closest import Surface
from exchange.offset_facets import TANGENT, Parallel, Sheet, edge_bends, sides_of
from plotting.reading import Trouble

MOST_ROOM = 0.98  # of a radius: nearer to it all facets shrink to points
NEAR = 1.1        # rooms: most points are nearer than that
DEEP = 2.0        # deflections: so much too near is no matter of facets


@dataclass
class Gap:
    """From each of two surfaces to the other: room that is there less room that was asked for."""
    distance: np.ndarray  # k
    error: np.ndarray     # k
    place: np.ndarray     # k x 3


def told(place: np.ndarray) -> str:
    return "(" + ", ".join(f"{value:.4g}" for value in place + 0.0) + ")"


def expect_no_crossing(path, sheet: Sheet, room: np.ndarray, other: str) -> None:
    """Raises Trouble for edges that the room is on the inner side of, and for curvature that is
    sharper than the room. `other`: the tool that is to be the room away, and its way out, in words."""
    sides = sides_of(sheet.triangles)
    normals = sheet.normals.reshape(-1, 3)
    cosine = np.minimum((normals[sides.a_first] * normals[sides.a_second]).sum(axis=1),
                        (normals[sides.b_first] * normals[sides.b_second]).sum(axis=1))
    inner = np.flatnonzero((cosine < TANGENT) & (edge_bends(sheet, sides) < 0))
    if len(inner):
        worst = inner[cosine[inner].argmin()]
        length = np.linalg.norm(sheet.x[sides.b[inner]] - sheet.x[sides.a[inner]], axis=1).sum()
        need = room[sides.a[worst]] / MOST_ROOM
        raise Trouble(f"{path}: {length:.4g} mm of inner edges, which a surface {room[sides.a[worst]]:.4g} "
                      f"mm away would cross itself at, the sharpest of "
                      f"{np.degrees(np.arccos(np.clip(cosine[worst], -1, 1))):.0f} degrees near "
                      f"{told(sheet.x[sides.a[worst]])}: round them with a radius of {need:.4g} mm or "
                      f"more in the CAD program, or {other}")
    bend, here = sheet.curvature[..., 0].ravel(), room[sheet.triangles].ravel()
    worst = int((-bend * here).argmax())
    if -bend[worst] * here[worst] > MOST_ROOM:
        raise Trouble(f"{path}: the radius of {-1 / bend[worst]:.4g} mm near "
                      f"{told(sheet.x[sheet.triangles.ravel()[worst]])} is too small for a surface "
                      f"{here[worst]:.4g} mm away, which would cross itself: the least radius that "
                      f"allows it is {here[worst] / MOST_ROOM:.4g} mm; enlarge it in the CAD program, "
                      f"or {other}")


def points_on(triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Corners, middles of sides and of triangles, each once: triangles (k) and weights (k x 3)."""
    corner = np.unique(triangles, return_index=True)[1]
    ends = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2), axis=2).reshape(-1, 2)
    side = np.unique(ends[:, 0] * (int(triangles.max()) + 1) + ends[:, 1], return_index=True)[1]
    of_corner, of_side = np.eye(3), (np.eye(3) + np.roll(np.eye(3), 1, axis=1)) / 2
    count = len(triangles)
    return (np.concatenate([corner // 3, side // 3, np.arange(count)]),
            np.concatenate([of_corner[corner % 3], of_side[side % 3], np.full((count, 3), 1 / 3)]))


def at(x: np.ndarray, corners: np.ndarray, weights: np.ndarray) -> np.ndarray:
    return np.einsum("kc,kc...->k...", weights, x[corners])


def closest(x: np.ndarray, triangles: np.ndarray, p: np.ndarray,
            near: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """As Surface.closest, of points most of which are nearer than `near`. Triangles of like size are
    searched together, as a few large ones would make all points look far."""
    corner = x[triangles]
    radius = np.linalg.norm(corner - corner.mean(axis=1, keepdims=True), axis=2).max(axis=1)
    size = np.floor(np.log2(np.maximum(radius, 1e-12))).astype(int)
    found = np.full(len(p), -1), np.zeros((len(p), 3)), np.full(len(p), np.inf)
    for limit in (near, np.inf):
        todo = np.flatnonzero(found[0] < 0)
        for one in np.unique(size) if len(todo) else []:
            rows = np.flatnonzero(size == one)
            surface = Surface(x, triangles[rows], np.zeros((len(rows), 3)))
            triangle, weights, distance = surface.closest(p[todo], limit)
            better = distance < found[2][todo]
            at_better = todo[better]
            found[0][at_better] = rows[triangle[better]]
            found[1][at_better], found[2][at_better] = weights[better], distance[better]
    return found


def gap_of(sheet: Sheet, room: np.ndarray, other: Parallel) -> tuple[Gap, Gap]:
    """From the parallel surface to the sheet, and back; at corners and middles of all triangles and
    sides. The room that was asked for is that of the closest point of the sheet."""
    near = NEAR * float(room.max())
    number, weights = points_on(other.triangles)
    place = at(other.x, other.triangles[number], weights)
    hit, weights, distance = closest(sheet.x, sheet.triangles, place, near)
    there = Gap(distance, distance - at(room, sheet.triangles[hit], weights), place)
    number, weights = points_on(sheet.triangles)
    place = at(sheet.x, sheet.triangles[number], weights)
    away = closest(other.x, other.triangles, place, near)[2]
    return there, Gap(away, away - at(room, sheet.triangles[number], weights), place)


def expect_room(path, gap: Gap, deflection: float, other: str) -> None:
    """Raises Trouble where the parallel surface comes nearer to the sheet than the room: there two
    parts of it cross."""
    worst = int(gap.error.argmin())
    if gap.error[worst] >= -DEEP * deflection:
        return
    wanted = gap.distance[worst] - gap.error[worst]
    raise Trouble(f"{path}: a surface {wanted:.4g} mm away would cross itself near "
                  f"{told(gap.place[worst])}, which is {gap.distance[worst]:.4g} mm from another place "
                  f"of the part: faces opposite one another need more than {2 * wanted:.4g} mm between "
                  f"them, and radii more than {wanted:.4g} mm; change the part there, or {other}")
