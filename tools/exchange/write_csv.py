# SPDX-License-Identifier: GPL-3.0-or-later
"""Plain CSV: a file a ply, a row an element; lines that begin with # say what the columns are."""

import numpy as np

from exchange.layup import Layup

COLUMNS = ["element", "covered_share", "warp_x", "warp_y", "warp_z", "weft_x", "weft_y", "weft_z",
           "warp_angle_deg", "weft_angle_deg", "thickness_mm", "shear_angle_deg", "distance_mm"]


def csv_files(layup: Layup) -> dict[str, str]:
    """Name of each file, without its folder, and its text."""
    files = {}
    for ply in layup.plies:
        warp, weft = layup.angles(ply)
        more = {name: values for name, values in
                (("areal_weight_g_m2", ply.areal_weight), ("fibre_volume", ply.fibre_volume()))
                if values is not None}
        table = np.column_stack([ply.share, ply.warp, ply.weft, warp, weft, ply.thickness,
                                 ply.shear_deg, ply.distance, *more.values()])
        lines = ["# " + line for line in layup.head(
            [f"ply {ply.name}, {ply.nominal_angle_deg:g} degrees and {ply.nominal_thickness:g} mm "
             "before forming",
             "an element that the ply does not cover has its covered_share only"])]
        lines.append(",".join([*COLUMNS, *more]))
        lines += rows_of(layup.mesh.labels, table)
        files[ply.name + ".csv"] = "\n".join(lines) + "\n"
    return files


def rows_of(labels: np.ndarray, table: np.ndarray) -> list[str]:
    """A line a row; what is not finite is left empty."""
    form = "%d" + ",%.9g" * table.shape[1]
    rows = list(map(form.__mod__, map(tuple, np.column_stack([labels, table]).tolist())))
    for k in np.flatnonzero(~np.isfinite(table).all(axis=1)):
        rows[k] = f"{labels[k]}," + ",".join(f"{value:.9g}" if np.isfinite(value) else ""
                                             for value in table[k])
    return rows
