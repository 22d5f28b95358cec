# SPDX-License-Identifier: GPL-3.0-or-later
"""Ansys ACP: look-up tables, a CSV file a ply, and a script for PyACP that makes them.

A 3D look-up table has points and, at each, columns: directions and scalars. A row stands at the
middle of a covered element: its warp as a direction; the two draping angles, which ACP adds to the
ply's angle and to the direction across it; the thickness and its ratio to the flat ply's.
"""

import numpy as np

from base.ending import one_line
from exchange.layup import Layup
from exchange.shell_mesh import centroids

COLUMNS = ["x_mm", "y_mm", "z_mm", "warp_x", "warp_y", "warp_z", "draping_angle_1_deg",
           "draping_angle_2_deg", "thickness_mm", "thickness_correction"]

SCRIPT = '''\
# {head}
# Makes 3D look-up tables of the CSV files beside this script, in a model that PyACP has loaded:
#     exec(open("acp_tables.py").read()); tables = make_tables(model, folder)
import csv
import pathlib

from ansys.acp.core import DimensionType, LookUpTableColumnValueType


def make_tables(model, folder=".", length_unit_in_mm=1.0):
    """length_unit_in_mm: 1000 for a model in metres."""
    tables = {{}}
    for path in sorted(pathlib.Path(folder).glob("acp_*.csv")):
        with open(path, newline="", encoding="utf-8") as file:
            rows = [[float(value) for value in row] for row in list(csv.reader(
                line for line in file if not line.startswith("#")))[1:]]
        table = model.create_lookup_table_3d(name=path.stem)
        table.columns["Location"].data = [[v / length_unit_in_mm for v in row[:3]] for row in rows]
        table.create_column(name="warp", data=[row[3:6] for row in rows],
                            dimension_type=DimensionType.DIMENSIONLESS,
                            value_type=LookUpTableColumnValueType.DIRECTION)
        for name, k, kind, factor in (
                ("angle_1", 6, DimensionType.DIMENSIONLESS, 1.0),
                ("angle_2", 7, DimensionType.DIMENSIONLESS, 1.0),
                ("thickness", 8, DimensionType.LENGTH, 1.0 / length_unit_in_mm),
                ("thickness_correction", 9, DimensionType.DIMENSIONLESS, 1.0)):
            table.create_column(name=name, data=[row[k] * factor for row in rows],
                                dimension_type=kind,
                                value_type=LookUpTableColumnValueType.SCALAR)
        tables[path.stem] = table
    return tables
'''


def acp_files(layup: Layup) -> dict[str, str]:
    files = {}
    middles = centroids(layup.mesh)
    for ply in layup.plies:
        rows = np.flatnonzero(ply.covered())
        one, two = layup.corrections(ply)
        table = np.column_stack([middles, ply.warp, one, two, ply.thickness,
                                 layup.thinning(ply)])[rows]
        lines = ["# " + line for line in layup.head(
            [f"ply {ply.name}: ply angle {ply.nominal_angle_deg:g}, fabric thickness "
             f"{ply.nominal_thickness:g} mm; a rosette along the reference",
             "draping angles: added to the ply's angle, and to the direction across it"])]
        lines += [",".join(COLUMNS), *(",".join(f"{v:.9g}" for v in row) for row in table)]
        files[f"acp_{ply.name}.csv"] = "\n".join(lines) + "\n"
    files["acp_tables.py"] = SCRIPT.format(head=one_line(layup.source))
    return files
