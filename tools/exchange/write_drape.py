# SPDX-License-Identifier: GPL-3.0-or-later
"""OptiStruct DRAPE and OpenRadioss /DRAPE: thinning and angle of each ply an element.

T is the thickness over that of the flat ply; THETA is what draping adds to the ply's own angle, which
is that of the case: PLY needs this angle as THETA and the flat thickness as T. Both programs measure
from the projected reference, which they must be told: MCID of the elements or their properties, the
reference vector of the stack.
"""

import numpy as np

from exchange.layup import Layup


def note(layup: Layup) -> list[str]:
    return ["T or Thinning: thickness over that of the flat ply; THETA: added to the ply's angle"] + (
        ["elements whose normal points down the stack have its plies in the wrong order: turn "
         "their normals round, and map again"] if layup.reversed_count() else [])


def optistruct_files(layup: Layup) -> dict[str, str]:
    """Fields of eight characters: DRAPE, its number; below, ELEM, element, T, THETA."""
    layup.expect_room("an OptiStruct file")
    lines = ["$ " + line for line in layup.head(note(layup))]
    if layup.own:
        lines.append("BEGIN BULK")
        for label, (x, y, z) in zip(layup.mesh.node_labels, layup.mesh.nodes):
            lines += [f"GRID*   {label:16d}{'':16}{x:16.8f}{y:16.8f}*", f"*       {z:16.8f}"]
        lines += [f"CTRIA3  {label:8d}{1:8d}" + "".join(f"{layup.mesh.node_labels[k]:8d}"
                                                        for k in corners[:3])
                  for label, corners in zip(layup.mesh.labels, layup.mesh.corners)]
    for number, ply in enumerate(layup.plies, 1):
        factor, theta = layup.thinning(ply), layup.corrections(ply)[0]
        lines += [f"$ ply {ply.name}: PLY with T = {ply.nominal_thickness:g}, "
                  f"THETA = {ply.nominal_angle_deg:g}, DRAPEID = {number}",
                  f"DRAPE   {number:8d}"]
        lines += [f"+       ELEM    {layup.mesh.labels[k]:8d}{field8(factor[k])}{field8(theta[k])}"
                  for k in np.flatnonzero(ply.covered())]
    lines += ["ENDDATA"] if layup.own else []
    return {prefix(layup) + "drape.fem": "\n".join(lines) + "\n"}


def field8(value: float) -> str:
    """A number with a point in eight characters, with as many digits as there is room for."""
    for digits in range(6, -1, -1):
        text = f"{value:.{digits}f}" + ("." if digits == 0 else "")
        if len(text) <= 8:
            return f"{text:>8}"
    text = f"{value:.2e}".replace("e", "")  # 1.23+12
    return f"{text:>8}"


def openradioss_files(layup: Layup) -> dict[str, str]:
    """Columns of ten: entity, element, then thinning and angle of twenty."""
    own_axes = ["one reference vector of a stack cannot give these axes: give elements of the same "
                "axes stacks of their own, or map with --reference x"]
    lines = ["# " + line for line in layup.head(
        note(layup) + (own_axes if layup.reference == "part" else []))]
    for number, ply in enumerate(layup.plies, 1):
        factor, theta = layup.thinning(ply), layup.corrections(ply)[0]
        lines += [f"# ply {ply.name}: thickness {ply.nominal_thickness:g}, angle "
                  f"{ply.nominal_angle_deg:g}", f"/DRAPE/{number}", ply.name[:100],
                  "#Entity   Entity_ID            Thinning         Theta_drape"]
        lines += [f"{'SH3N' if layup.mesh.corners[k, 3] < 0 else 'SHELL':<10}"
                  f"{layup.mesh.labels[k]:10d}{factor[k]:20.9f}{theta[k]:20.7f}"
                  for k in np.flatnonzero(ply.covered())]
    return {prefix(layup) + "drape_0000.inc": "\n".join(lines) + "\n"}


def prefix(layup: Layup) -> str:
    return layup.plies[0].name + "_" if layup.own else ""
