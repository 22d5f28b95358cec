# SPDX-License-Identifier: GPL-3.0-or-later
"""The parallel surface of facets: the points that are a given room away on the side of the normals.
Lengths in mm.

A corner of a facet goes along the exact normal there. At an edge where faces meet at an angle, on the
outer side of it, the parallel surface is round the edge: strips on circles of the room as radius, and
parts of balls at corners. On the inner side it would cross itself: offset_crossings.py tells."""

from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from exchange.shell_mesh import unit

TANGENT = np.cos(np.radians(3.0))  # of the normals of faces that meet in no edge
ARC_SHARE = 0.25  # of the deflection, that chords of circles round edges may take


@dataclass
class Sheet:
    """n points, m triangles with the side that the room is on to the left of their corners' turn."""
    x: np.ndarray          # n x 3
    triangles: np.ndarray  # m x 3
    normals: np.ndarray    # m x 3 x 3: unit, of each triangle's own face at its corners
    face: np.ndarray       # m: tags, from 1
    curvature: np.ndarray  # m x 3 x 2, 1/mm, at the corners: the least and the largest principal
    #                        curvature of the face, below 0 where the room is on the inner side

    def turned(self) -> "Sheet":
        """The same with the room on the other side."""
        return Sheet(self.x, self.triangles[:, ::-1].copy(), -self.normals[:, ::-1], self.face,
                     -self.curvature[:, ::-1, ::-1])

    def part(self, rows: np.ndarray) -> "Sheet":
        """Some of the triangles."""
        used, corners = np.unique(self.triangles[rows], return_inverse=True)
        return Sheet(self.x[used], corners.reshape(-1, 3), self.normals[rows], self.face[rows],
                     self.curvature[rows])


@dataclass
class Sides:
    """k sides with two triangles: from a to b in the order of the first, from b to a in that of the
    second; `place` are the corners, 3 t + c, of each end in each triangle."""
    a: np.ndarray
    b: np.ndarray
    a_first: np.ndarray
    b_first: np.ndarray
    a_second: np.ndarray
    b_second: np.ndarray


@dataclass
class Parallel:
    """The facets that the room is behind, in the order of the sheet; then those round edges."""
    x: np.ndarray
    triangles: np.ndarray
    face: np.ndarray       # 0: round an edge
    strips: int = 0        # edges rounded


@dataclass
class Growing:
    """Points and triangles as they come."""
    x: list = field(default_factory=list)
    triangles: list = field(default_factory=list)

    def point(self, place: np.ndarray) -> int:
        self.x.append(place)
        return len(self.x) - 1


def sides_of(triangles: np.ndarray) -> Sides:
    """Of triangles that go round alike."""
    count = len(triangles)
    start, end = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    corner = np.arange(3 * count)
    after = 3 * (corner // 3) + (corner + 1) % 3
    size = int(triangles.max()) + 1
    key, back = start * size + end, end * size + start
    order = np.argsort(key)
    at = np.minimum(np.searchsorted(key[order], back), 3 * count - 1)
    other = order[at]
    one = np.flatnonzero((key[other] == back) & (start < end))
    two = other[one]
    return Sides(start[one], end[one], one, after[one], after[two], two)


def fans_of(sheet: Sheet, sides: Sides) -> np.ndarray:
    """m x 3: the fan of each corner. Corners of triangles round a point that meet in no edge are one."""
    normals, count = sheet.normals.reshape(-1, 3), 3 * len(sheet.triangles)
    one = np.concatenate([sides.a_first, sides.b_first])
    two = np.concatenate([sides.a_second, sides.b_second])
    alike = (normals[one] * normals[two]).sum(axis=1) >= TANGENT
    link = coo_matrix((np.ones(alike.sum(), np.int8), (one[alike], two[alike])), shape=(count, count))
    return connected_components(link, directed=False)[1].reshape(-1, 3)


def fan_normals(sheet: Sheet, fans: np.ndarray) -> np.ndarray:
    total = np.zeros((int(fans.max()) + 1, 3))
    np.add.at(total, fans.ravel(), sheet.normals.reshape(-1, 3))
    return unit(total)


def edge_bends(sheet: Sheet, sides: Sides) -> np.ndarray:
    """k: sine of the angle by which the surface turns away from the room at sides; above 0: the room is
    on the outer side of an edge there."""
    along = unit(sheet.x[sides.b] - sheet.x[sides.a])
    normals = sheet.normals.reshape(-1, 3)
    turn = np.cross(normals[sides.a_first] + normals[sides.b_first],
                    normals[sides.a_second] + normals[sides.b_second]) / 4
    return (turn * along).sum(axis=1)


def parallel(sheet: Sheet, room: np.ndarray, deflection: float) -> Parallel:
    """room: n, of each point, above 0."""
    sides = sides_of(sheet.triangles)
    fans = fans_of(sheet, sides)
    normals = fan_normals(sheet, fans)
    point_of = np.zeros(len(normals), int)
    point_of[fans.ravel()] = sheet.triangles.ravel()
    x = sheet.x[point_of] + room[point_of, None] * normals
    flat = fans.ravel()
    ends = np.stack([flat[sides.a_first], flat[sides.a_second], flat[sides.b_first],
                     flat[sides.b_second]], axis=1)
    sharp = np.flatnonzero((ends[:, 0] != ends[:, 1]) | (ends[:, 2] != ends[:, 3]))
    if not len(sharp):
        return Parallel(x, fans, sheet.face)
    growing = Growing(list(x))
    arcs = Arcs(sheet.x, room, normals, deflection, growing)
    beside: dict[int, list[tuple[int, int]]] = {}
    for side in sharp.tolist():
        a, b = int(sides.a[side]), int(sides.b[side])
        one_a, two_a, one_b, two_b = ends[side].tolist()
        strip(growing, arcs.between(a, one_a, two_a), arcs.between(b, one_b, two_b))
        beside.setdefault(a, []).append((two_a, one_a))
        beside.setdefault(b, []).append((one_b, two_b))
    for point, pairs in beside.items():
        ball_part(growing, arcs, point, [pair for pair in pairs if pair[0] != pair[1]])
    made = np.array(growing.triangles, int).reshape(-1, 3)
    return Parallel(np.array(growing.x), np.vstack([fans, made]),
                    np.concatenate([sheet.face, np.zeros(len(made), int)]), len(sharp))


class Arcs:
    """Points on circles round points of edges, from the normal of a fan to that of another."""

    def __init__(self, x, room, normals, deflection: float, growing: Growing):
        self.x, self.room, self.normals, self.growing = x, room, normals, growing
        self.deflection = deflection
        self.known: dict[tuple[int, int, int], list[int]] = {}

    def steps(self, point: int, angle: float) -> int:
        chord = 2 * np.arccos(max(1 - ARC_SHARE * self.deflection / self.room[point], 0.5))
        return max(1, int(np.ceil(angle / chord)))

    def between(self, point: int, one: int, two: int) -> list[int]:
        if one == two:
            return [one]
        key = (point, min(one, two), max(one, two))
        if key not in self.known:
            ends = self.normals[key[1]], self.normals[key[2]]
            inner = [self.at(point, slerp(*ends, part)) for part in self.parts(point, *ends)]
            self.known[key] = [key[1], *inner, key[2]]
        return self.known[key] if one < two else self.known[key][::-1]

    def parts(self, point: int, one: np.ndarray, two: np.ndarray) -> np.ndarray:
        count = self.steps(point, angle_of(one, two))
        return np.arange(1, count) / count

    def at(self, point: int, normal: np.ndarray) -> int:
        return self.growing.point(self.x[point] + self.room[point] * normal)

    def normal_of(self, point: int, number: int) -> np.ndarray:
        return unit(self.growing.x[number] - self.x[point])


def angle_of(one: np.ndarray, two: np.ndarray) -> float:
    return float(np.arctan2(np.linalg.norm(np.cross(one, two)), one @ two))


def slerp(one: np.ndarray, two: np.ndarray, part: float) -> np.ndarray:
    angle = angle_of(one, two)
    return unit(np.sin((1 - part) * angle) * one + np.sin(part * angle) * two)


def strip(growing: Growing, p: list[int], q: list[int]) -> None:
    """Triangles between two rows of points, p where the first triangle's side begins."""
    i = j = 0
    while i + 1 < len(p) or j + 1 < len(q):
        if j + 1 == len(q) or (i + 1 < len(p) and (i + 1) * (len(q) - 1) <= (j + 1) * (len(p) - 1)):
            growing.triangles.append((q[j], p[i], p[i + 1]))
            i += 1
        else:
            growing.triangles.append((q[j], p[i], q[j + 1]))
            j += 1


def ball_part(growing: Growing, arcs: Arcs, point: int, pairs: list[tuple[int, int]]) -> None:
    """Closes what three or more arcs leave open round the point of a corner."""
    if len(pairs) < 3 or {one for one, _ in pairs} != {two for _, two in pairs}:
        return  # no corner, or one at the rim
    centre = unit(sum(arcs.normals[one] for one, _ in pairs))
    middle = arcs.at(point, centre)
    rows: dict[int, list[int]] = {}
    most = max(angle_of(arcs.normals[one], centre) for one, _ in pairs)
    count = arcs.steps(point, most)
    for one, two in pairs:
        ends = arcs.between(point, one, two)
        for number in ends:
            if number not in rows:
                normal = arcs.normal_of(point, number)
                inner = [arcs.at(point, slerp(normal, centre, k / count)) for k in range(1, count)]
                rows[number] = [number, *inner, middle]
        for a, b in zip(ends, ends[1:]):
            for k in range(count):
                growing.triangles.append((rows[a][k], rows[b][k], rows[a][k + 1]))
                if k + 1 < count:
                    growing.triangles.append((rows[b][k], rows[b][k + 1], rows[a][k + 1]))
