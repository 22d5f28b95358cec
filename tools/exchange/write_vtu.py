# SPDX-License-Identifier: GPL-3.0-or-later
"""The mapped lay-up to look at, by meshio: VTU with a field a ply and value on the elements. Where a
ply does not cover an element its values are NaN."""

from pathlib import Path

import numpy as np

from plotting.reading import Trouble

from exchange.layup import Layup
from exchange.write_infusion import stack_values


def write_layup_vtu(layup: Layup, path: Path) -> None:
    try:
        from meshio import Mesh, vtu
    except ImportError as problem:
        raise Trouble("--format vtu is written by meshio: install python3-meshio") from problem
    mesh = layup.mesh
    blocks = [(kind, rows, count) for kind, rows, count in
              (("triangle", np.flatnonzero(mesh.triangular()), 3),
               ("quad", np.flatnonzero(~mesh.triangular()), 4)) if len(rows)]
    fields = {"element": mesh.labels}
    for ply in layup.plies:
        warp, weft = layup.angles(ply)
        for name, values in (("covered_share", ply.share), ("warp", ply.warp), ("weft", ply.weft),
                             ("warp_angle_deg", warp), ("weft_angle_deg", weft),
                             ("thickness_mm", ply.thickness), ("shear_angle_deg", ply.shear_deg),
                             ("distance_mm", ply.distance), ("fibre_volume", ply.fibre_volume()),
                             ("areal_weight_g_m2", ply.areal_weight)):
            if values is None:
                continue
            fields[f"{ply.name} {name}" if len(layup.plies) > 1 else name] = values
    stack = stack_values(layup)
    for name, values in (("layers", stack.layers), ("stack thickness_mm", stack.thickness),
                         ("stack fibre_volume", stack.fibres / np.where(stack.layers, stack.thickness, np.nan)),
                         ("stack areal_weight_g_m2", stack.areal_weight), ("gap_mm", stack.gap)):
        if np.isfinite(values).any():
            fields[name] = values
    vtu.write(path, Mesh(mesh.nodes, [(kind, mesh.corners[rows, :count])
                                      for kind, rows, count in blocks],
                         cell_data={name: [values[rows] for _, rows, _ in blocks]
                                    for name, values in fields.items()}))
