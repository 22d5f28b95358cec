# SPDX-License-Identifier: GPL-3.0-or-later
"""What a mapping says of itself: mapping.csv, and lines for the screen."""

import numpy as np

from exchange.layup import Layup, ThereAndBack, there_and_back
from exchange.mapping import MappedPly, SmoothPly
from exchange.shell_mesh import ShellMesh, element_normals

COLUMNS = ["ply", "elements", "covered", "partly_covered", "covered_area_mm2",
           "mean_distance_mm", "largest_distance_mm", "normals_down",
           "there_and_back_angle_rms_deg", "there_and_back_angle_largest_deg",
           "there_and_back_thickness_rms_mm", "smoothing_angle_rms_deg"]


def row_of(ply: MappedPly, smooth: SmoothPly, mesh: ShellMesh, limit: float) -> list:
    covered = ply.covered()
    areas = element_normals(mesh)[1]
    back = there_and_back(smooth, ply, mesh, limit) or ThereAndBack(*[np.nan] * 4)
    distance = ply.distance[covered] if covered.any() else np.array([np.nan])
    return [ply.name, len(covered), int(covered.sum()),
            int(((ply.share > 0) & (ply.share < 0.999)).sum()),
            float((areas * ply.share)[covered].sum()), float(distance.mean()),
            float(distance.max()), int((ply.side < 0).sum()), back.angle_rms, back.angle_largest,
            back.thickness_rms, back.smoothing_rms]


def table_of(rows: list[list], layup: Layup) -> str:
    lines = ["# " + line for line in layup.head(
        ["there and back: from the ply onto the mesh and back onto the ply's triangles, against the "
         "smoothed field; warp or weft, whichever is worse",
         "smoothing: what the smoothed field differs from the run's triangles"])]
    lines.append(",".join(COLUMNS))
    lines += [",".join([cell(row[0]), *("" if np.isnan(value) else f"{value:.6g}" for value in row[1:])])
              for row in rows]
    return "\n".join(lines) + "\n"


def cell(name: str) -> str:
    """In quotes with a comma (names hold no quotes)."""
    return f'"{name}"' if "," in name else name


def words_of(rows: list[list], mesh: ShellMesh, bare: int) -> list[str]:
    lines = []
    if mesh.left_out:
        lines.append("left out, as they are no shells: "
                     + ", ".join(f"{count} {kind}" for kind, count in mesh.left_out.items()))
    for row in rows:
        values = dict(zip(COLUMNS, row))
        lines.append(f"{values['ply']}: {values['covered']} of {values['elements']} elements "
                     f"covered, {values['partly_covered']} in part; mapped over "
                     f"{values['mean_distance_mm']:.2f} mm, {values['largest_distance_mm']:.2f} mm "
                     f"at most; there and back {values['there_and_back_angle_rms_deg']:.2f} degrees "
                     "rms")
    lines.append(f"{bare} of {len(mesh.corners)} elements have no ply")
    return lines


def bare_count(layup: Layup) -> int:
    return int((~np.any([ply.covered() for ply in layup.plies], axis=0)).sum())
