# SPDX-License-Identifier: GPL-3.0-or-later
"""The body of a tool behind its surface: walls from the rim along the direction of pressing to a flat
back. Lengths in mm."""

from dataclasses import dataclass

import gmsh
import numpy as np

from exchange.shell_mesh import triangle_normals

UPRIGHT = 0.1     # of the cosine of a facet of a wall: those of round walls lean


@dataclass
class Body:
    x: np.ndarray
    triangles: np.ndarray
    closed: bool
    why_open: str = ""


def body_of(x: np.ndarray, triangles: np.ndarray, back: np.ndarray, depth: float) -> Body:
    """Of triangles (m x 3) over points x that face the cloth, away from the unit vector `back`. The back
    is `depth` behind the hindmost point. Open where walls would cross the surface. gmsh must not have a
    model open."""
    used, corners = np.unique(triangles, return_inverse=True)
    x, triangles = x[used], corners.reshape(-1, 3)
    normals, area = triangle_normals(x, triangles)
    away = np.where(area > 1e-9 * area.max(), -(normals @ back), 1.0)
    rim = rim_of(triangles)
    if wall_behind(x, triangles, rim, away, back):
        return Body(x, triangles, False, "a wall along the direction of pressing ends at its rim (a flange "
                    "there would make it one)")
    height = x @ back
    level = height.max() + depth
    foot = x[rim[:, 0]] + (level - height[rim[:, 0]])[:, None] * back
    number = {int(point): len(x) + k for k, point in enumerate(rim[:, 0])}
    b, a = rim[:, 0], rim[:, 1]  # the walls go round the other way
    below_a, below_b = (np.array([number[int(point)] for point in some]) for some in (a, b))
    walls = np.concatenate([np.stack([a, b, below_b], axis=1), np.stack([a, below_b, below_a], axis=1)])
    try:
        plate, inner = back_plate(foot, np.stack([below_b, below_a], axis=1) - len(x), back)
    except Exception:  # of gmsh: rims that cross one another in the plane of the back
        return Body(x, triangles, False, "its rim crosses itself, seen along the direction of pressing")
    return Body(np.vstack([x, foot, inner]), np.vstack([triangles, walls, plate + len(x)]), True)


def rim_of(triangles: np.ndarray) -> np.ndarray:
    """k x 2: sides that one triangle has alone, in its order."""
    start, end = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    size = int(triangles.max()) + 1
    alone = ~np.isin(start * size + end, end * size + start)
    return np.stack([start[alone], end[alone]], axis=1)


def loops_of(rim: np.ndarray) -> list[list[int]]:
    """Points of each loop in the order of its sides. Raises ValueError where loops touch."""
    after = dict(rim.tolist())
    if len(after) != len(rim):
        raise ValueError("loops touch")
    loops = []
    while after:
        start, point = after.popitem()
        loop = [start]
        while point != start:
            loop.append(point)
            point = after.pop(point)
        loops.append(loop)
    return loops


def wall_behind(x, triangles, rim, away, back) -> bool:
    """Whether a triangle at the rim stands upright, behind it: where the walls are to go."""
    size = int(triangles.max()) + 1
    keys = set((rim[:, 0] * size + rim[:, 1]).tolist())
    for k in range(3):
        a, b, c = (triangles[:, (k + n) % 3] for n in range(3))
        at_rim = np.array([key in keys for key in (a * size + b).tolist()])
        behind = ((x[c] - x[a]) @ back > 0) & (np.abs(away) < UPRIGHT)
        if (at_rim & behind).any():
            return True
    return False


def back_plate(foot: np.ndarray, sides: np.ndarray,
               back: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Triangles that face `back`, of points `foot` (in one plane) and of new ones behind them, which are
    returned too. sides: k x 2, rows of foot, with the plate to the left seen against `back`."""
    one = np.cross(back, np.eye(3)[np.abs(back).argmin()])
    one /= np.linalg.norm(one)
    two = np.cross(back, one)
    flat = np.column_stack([foot @ one, foot @ two])
    gmsh.initialize([], False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        geo = gmsh.model.geo
        size = float(np.ptp(flat, axis=0).max())
        points = [geo.addPoint(u, v, 0.0, size) for u, v in flat.tolist()]
        loops = sorted(loops_of(sides), key=lambda loop: -abs(area_of(flat[loop])))
        curves = []
        for loop in loops:
            lines = [geo.addLine(points[a], points[b]) for a, b in zip(loop, loop[1:] + loop[:1])]
            for line in lines:
                geo.mesh.setTransfiniteCurve(line, 2)
            curves.append(geo.addCurveLoop(lines))
        surface = geo.addPlaneSurface(curves)
        geo.synchronize()
        gmsh.option.setNumber("Mesh.MeshSizeExtendFromBoundary", 1)
        gmsh.model.mesh.generate(2)
        return plate_of(surface, points, foot, flat, (one, two))
    finally:
        gmsh.finalize()


def plate_of(surface: int, points: list[int], foot: np.ndarray, flat: np.ndarray,
             axes: tuple[np.ndarray, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """What gmsh has meshed, as back_plate returns it."""
    row = {int(gmsh.model.mesh.getNodes(0, tag)[0][0]): k for k, tag in enumerate(points)}
    tags, places, _ = gmsh.model.mesh.getNodes(2, surface)
    inner = np.array(places).reshape(-1, 3)[:, :2] - flat[0]
    row.update({int(tag): len(foot) + k for k, tag in enumerate(tags)})
    corners = gmsh.model.mesh.getElementsByType(2, surface)[1]
    plate = np.array([row[int(tag)] for tag in corners]).reshape(-1, 3)
    every = np.vstack([flat, inner + flat[0]])
    turns = area_of(every[plate[0]]) < 0
    return plate[:, ::-1] if turns else plate, foot[0] + inner @ np.array(axes)


def area_of(polygon: np.ndarray) -> float:
    """Above 0: it goes round anticlockwise."""
    after = np.roll(polygon, -1, axis=0)
    return float((polygon[:, 0] * after[:, 1] - polygon[:, 1] * after[:, 0]).sum() / 2)
