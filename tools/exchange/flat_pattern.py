# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a ply must be cut so that the formed part ends at its trim line: the trim line on the formed
ply, taken back to the flat blank; and how far a formed edge is from a trim line."""

from dataclasses import dataclass, field, replace

import numpy as np

from scipy.spatial import cKDTree

from plotting.reading import Trouble

from exchange.closest import Surface
from exchange.formed import FormedPly
from exchange.outline import TrimLine, area_of, crosses_itself, distance_to, divided
from exchange.shell_mesh import border_edges, triangle_normals

AROUND = 24         # triangles
MOST_BEYOND = 15.0  # mm that a trim line may lie outside of the formed ply: it is continued so far


@dataclass
class Pattern:
    """Of one ply, in the plane of its blank."""
    ply: str
    yarns: str             # name of its first family: warp
    angle_deg: float       # from x to these yarns
    outline: np.ndarray    # k x 2, mm, anticlockwise
    blank_area: float      # mm2, of the ply that was formed
    area: float            # mm2
    strip_area: float      # mm2, of the pattern's box along and across these yarns
    blank_strip_area: float  # mm2, of the formed ply's
    beyond: float          # mm: how far the trim line lies outside of the formed ply, at most
    holes: list[np.ndarray] = field(default_factory=list)  # of the blank that lie in it, each k x 2
    notched: int = 0       # holes of the blank that its outline runs through: they are not cut


def flat_pattern(ply: FormedPly, trim: TrimLine, spacing: float) -> Pattern:
    """With points some `spacing` mm apart along the trim line. Raises Trouble where the ply is too
    small for the trim line."""
    points = divided(trim.points, spacing)
    x = ply.x * (1.0, 1.0, 0.0) if trim.above else ply.x
    normals = triangle_normals(ply.x, ply.triangles)[0]
    triangle, weights, distance = Surface(x, ply.triangles, normals).closest(points, np.inf)
    worst = int(distance.argmax())
    if distance[worst] > MOST_BEYOND:
        where = ", ".join(f"{value:.1f}" for value in points[worst][:2 if trim.above else 3])
        raise Trouble(f"the trim line lies {distance[worst]:.1f} mm outside of ply {ply.name} at "
                      f"({where}): form a larger blank first, or mend the trim line")
    nodes = ply.triangles[triangle]
    flat = (weights[:, :, None] * ply.x0[nodes]).sum(axis=1)[:, :2]
    off = points - (weights[:, :, None] * x[nodes]).sum(axis=1)
    beyond = distance > 1e-6
    if beyond.any():
        flat[beyond] += continued(off[beyond], points[beyond], x, ply)
    flat = flat if area_of(flat) > 0 else flat[::-1]
    if crosses_itself(flat):
        raise Trouble(f"the pattern of ply {ply.name} crosses itself: the trim line runs over a "
                      "fold of the ply, where it has no one place on the blank")
    angle = ply.angles_deg[0]
    holes, notched = holes_in(ply, flat)
    return Pattern(ply.name, ply.families[0], angle, flat, blank_area(ply), area_with(flat, holes),
                   strip_area(flat, angle), strip_area(ply.x0[:, :2], angle),
                   float(distance.max()), holes, notched)


def area_with(outline: np.ndarray, holes: list[np.ndarray]) -> float:
    return abs(area_of(outline)) - sum(abs(area_of(hole)) for hole in holes)


def holes_in(ply: FormedPly, outline: np.ndarray) -> tuple[list[np.ndarray], int]:
    """The holes of the flat blank that lie in the outline, and how many it runs through."""
    flat, outer = ply.x0[:, :2], set(outer_border(ply).tolist())
    holes = [flat[loop] for loop in borders(ply) if loop[0] not in outer]
    there = [inside(hole, outline) for hole in holes]
    return ([hole for hole, inner in zip(holes, there) if inner.all()],
            sum(inner.any() and not inner.all() for inner in there))


def inside(points: np.ndarray, curve: np.ndarray) -> np.ndarray:
    """Whether points (k x 2) are in a closed curve (c x 2): a line along x from each crosses it an odd
    number of times."""
    a, b = curve, np.roll(curve, -1, axis=0)
    x, y = points[:, :1], points[:, 1:]
    spans = (a[:, 1] <= y) != (b[:, 1] <= y)
    rise = np.where(a[:, 1] == b[:, 1], 1.0, b[:, 1] - a[:, 1])
    at = a[:, 0] + (y - a[:, 1]) * (b[:, 0] - a[:, 0]) / rise
    return (spans & (at > x)).sum(axis=1) % 2 == 1


def blend(one: Pattern, two: Pattern, part: float) -> Pattern:
    """Between two patterns of a ply of the same trim line and spacing, `part` of the way from the first:
    their points are those of the same points of the trim line."""
    outline = one.outline + part * (two.outline - one.outline)
    return replace(two, outline=outline, area=area_with(outline, two.holes),
                   strip_area=strip_area(outline, two.angle_deg))


def continued(off: np.ndarray, points: np.ndarray, x: np.ndarray, ply: FormedPly) -> np.ndarray:
    """What vectors `off` (k x 3, mm), from the border of the formed ply x to points beyond it, are on
    the blank (k x 2): as the triangles there are deformed, by the mean of some around, since single
    ones scatter."""
    corners, flat = x[ply.triangles], ply.x0[ply.triangles][:, :, :2]
    sides = np.stack([corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]], axis=2)
    before = np.stack([flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]], axis=2)
    back = before @ np.linalg.pinv(sides)  # m x 2 x 3: from the formed ply to the blank
    count = min(AROUND, len(corners))
    _, near = cKDTree(corners.mean(axis=1)).query(points, k=count)
    return np.einsum("kij,kj->ki", back[near.reshape(len(points), count)].mean(axis=1), off)


def blank_area(ply: FormedPly) -> float:
    return float(triangle_normals(ply.x0, ply.triangles)[1].sum())


def strip_area(flat: np.ndarray, angle_deg: float) -> float:
    """Of the box along and across the yarns, as it is cut from a roll."""
    c, s = np.cos(np.radians(angle_deg)), np.sin(np.radians(angle_deg))
    along, across = flat @ (c, s), flat @ (-s, c)
    return float(np.ptp(along) * np.ptp(across))


def edge_error(ply: FormedPly, trim: TrimLine) -> tuple[float, float]:
    """Largest and rms distance, mm, between the formed ply's outer border and the trim line: of the
    border from the line, and of the line from the border. From above, horizontal distances."""
    keep = 2 if trim.above else 3
    edge = outer_border(ply)
    formed, line = ply.x[edge][:, :keep], trim.points[:, :keep]
    spacing = 0.5 * np.linalg.norm(formed - np.roll(formed, 1, axis=0), axis=1).mean()
    off = np.r_[distance_to(divided(formed, spacing), line),
                distance_to(divided(line, spacing), formed)]
    return float(off.max()), float(np.sqrt((off**2).mean()))


def outer_border(ply: FormedPly) -> np.ndarray:
    """Nodes of the border round it all, in order."""
    loops = borders(ply)
    return loops[int(np.argmax([abs(area_of(ply.x0[loop][:, :2])) for loop in loops]))]


def borders(ply: FormedPly) -> list[np.ndarray]:
    """Nodes of each closed border, in order."""
    alone = border_edges(ply.triangles)
    ends = np.vstack([ply.triangles[:, [k, (k + 1) % 3]][alone[:, k]] for k in range(3)])
    after = dict(ends.tolist())
    loops = []
    while after:
        start, node = next(iter(after.items()))
        loop = [start]
        after.pop(start)
        while node != start and node in after:
            loop.append(node)
            node = after.pop(node)
        loops.append(np.array(loop))
    return loops
