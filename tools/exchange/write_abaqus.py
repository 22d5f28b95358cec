# SPDX-License-Identifier: GPL-3.0-or-later
"""Abaqus: distributions of orientation, thickness and angle an element, and composite sections.

Elements that have the same plies in the same order make a set with a *SHELL SECTION, COMPOSITE. Its
ORIENTATION is a distribution of local systems (a: the reference direction, b: across it in the
element's plane), so that the layers' angles do not depend on Abaqus' own choice of axes. Each layer
has a distribution for its thickness and one for its angle. The grammar is that of the keywords
*DISTRIBUTION TABLE, *DISTRIBUTION, *ORIENTATION and *SHELL SECTION in the Abaqus documentation.
"""

import numpy as np

from exchange.angles import wrapped
from exchange.layup import Layup, safe_names

POINTS = 3  # of integration a layer: Abaqus' own choice with Simpson's rule


def abaqus_files(layup: Layup) -> dict[str, str]:
    names = safe_names([ply.name for ply in layup.plies])
    lines = ["** " + line for line in layup.head(
        ["include this file at the level of the part; a layer's material is MATERIAL_ and its name",
         "a layer's angle is that of its warp; *SHELL SECTION lists layers along the normal"])]
    if layup.own:
        lines += mesh_lines(layup)
    lines += ["*DISTRIBUTION TABLE, NAME=PLYFORM_COORDINATES", "COORD3D, COORD3D",
              "*DISTRIBUTION TABLE, NAME=PLYFORM_LENGTH", "LENGTH",
              "*DISTRIBUTION TABLE, NAME=PLYFORM_ANGLE", "ANGLE"]
    some = np.unique(np.concatenate([rows for rows in layup.sequences().values()] or [[]]))
    lines += orientation(layup, some.astype(int))
    for ply, name in zip(layup.plies, names):
        rows = np.flatnonzero(ply.covered())
        angle = wrapped(layup.angles(ply)[0])  # Abaqus takes -90 to 90 degrees
        lines += distribution("THICKNESS_" + name, "LENGTH", ply.nominal_thickness,
                              layup.mesh.labels[rows], ply.thickness[rows])
        lines += distribution("ANGLE_" + name, "ANGLE", 0.0, layup.mesh.labels[rows], angle[rows])
    for number, (plies, rows) in enumerate(layup.sequences().items(), 1):
        lines.append(f"*ELSET, ELSET=PLYFORM_{number}")
        lines += listed(layup.mesh.labels[rows], 16)
        lines.append(f"*SHELL SECTION, ELSET=PLYFORM_{number}, COMPOSITE, "
                     "ORIENTATION=PLYFORM_REFERENCE")
        lines += [f"THICKNESS_{names[k]}, {POINTS}, MATERIAL_{names[k]}, ANGLE_{names[k]}, "
                  f"{names[k]}" for k in plies]
    return {("" if not layup.own else layup.plies[0].name + "_") + "layup.inp":
            "\n".join(lines) + "\n"}


def distribution(name: str, table: str, default: float, labels: np.ndarray,
                 values: np.ndarray) -> list[str]:
    """A value an element, and one for all others, on a line without a number."""
    return [f"*DISTRIBUTION, NAME={name}, LOCATION=ELEMENT, TABLE=PLYFORM_{table}",
            f", {default:.9g}",
            *(f"{label}, {value:.9g}" for label, value in zip(labels, values))]


def orientation(layup: Layup, rows: np.ndarray) -> list[str]:
    a = layup.base.directions
    b = np.cross(layup.normals, a)
    lines = ["*DISTRIBUTION, NAME=PLYFORM_AXES, LOCATION=ELEMENT, TABLE=PLYFORM_COORDINATES",
             ", 1., 0., 0., 0., 1., 0."]
    for k in rows:
        lines.append(f"{layup.mesh.labels[k]}, "
                     + ", ".join(f"{value:.9g}" for value in (*a[k], *b[k])))
    return lines + ["*ORIENTATION, NAME=PLYFORM_REFERENCE, SYSTEM=RECTANGULAR, "
                    "DEFINITION=COORDINATES", "PLYFORM_AXES", "3, 0."]


def mesh_lines(layup: Layup) -> list[str]:
    mesh = layup.mesh
    lines = ["*NODE"]
    lines += [f"{label}, {x:.9g}, {y:.9g}, {z:.9g}"
              for label, (x, y, z) in zip(mesh.node_labels, mesh.nodes)]
    lines.append("*ELEMENT, TYPE=S3")
    lines += [f"{label}, " + ", ".join(str(mesh.node_labels[k]) for k in corners[:3])
              for label, corners in zip(mesh.labels, mesh.corners)]
    return lines


def listed(labels: np.ndarray, count: int) -> list[str]:
    return [", ".join(map(str, labels[k:k + count])) for k in range(0, len(labels), count)]
