# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a ply must be cut so that the formed part ends at its trim line: the trim line on the formed
ply, taken back to the flat blank; and how far a formed edge is from a trim line."""

from dataclasses import dataclass

import numpy as np

from plotting.reading import Trouble

from exchange.closest import Surface
from exchange.formed import FormedPly
from exchange.outline import TrimLine, area_of, crosses_itself, distance_to, divided
from exchange.shell_mesh import border_edges, triangle_normals

MOST_BEYOND = 15.0  # mm that a trim line may lie outside of the formed ply: it is continued so far


@dataclass
class Pattern:
    """Of one ply, in the plane of its blank."""
    ply: str
    angle_deg: float
    outline: np.ndarray    # k x 2, mm, anticlockwise
    blank_area: float      # mm2, of the ply that was formed
    area: float            # mm2
    strip_area: float      # mm2, of the pattern's box along and across the warp
    blank_strip_area: float  # mm2, of the formed ply's
    beyond: float          # mm: how far the trim line lies outside of the formed ply, at most


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
    beyond = distance > 1e-6
    weights[beyond] = continued(points[beyond], x[ply.triangles[triangle[beyond]]])
    flat = (weights[:, :, None] * ply.x0[ply.triangles[triangle]]).sum(axis=1)[:, :2]
    flat = flat if area_of(flat) > 0 else flat[::-1]
    if crosses_itself(flat):
        raise Trouble(f"the pattern of ply {ply.name} crosses itself: the trim line runs over a "
                      "fold of the ply, where it has no one place on the blank")
    return Pattern(ply.name, ply.angle_deg, flat, blank_area(ply), abs(area_of(flat)),
                   strip_area(flat, ply.angle_deg), strip_area(ply.x0[:, :2], ply.angle_deg),
                   float(distance.max()))


def continued(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Barycentric coordinates (k x 3) in the planes of triangles (k x 3 x 3), beyond them too."""
    a, ab, ac = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    ap = points - a
    d00, d01, d11 = (ab * ab).sum(1), (ab * ac).sum(1), (ac * ac).sum(1)
    d20, d21 = (ap * ab).sum(1), (ap * ac).sum(1)
    area = np.maximum(d00 * d11 - d01 * d01, 1e-12)
    v, w = (d11 * d20 - d01 * d21) / area, (d00 * d21 - d01 * d20) / area
    return np.column_stack([1 - v - w, v, w])


def blank_area(ply: FormedPly) -> float:
    return float(triangle_normals(ply.x0, ply.triangles)[1].sum())


def strip_area(flat: np.ndarray, angle_deg: float) -> float:
    """Of the box along and across the warp, as it is cut from a roll."""
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
    """Nodes of the longest closed border, in order."""
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
    flat = [abs(area_of(ply.x0[loop][:, :2])) for loop in loops]
    return loops[int(np.argmax(flat))]
