# SPDX-License-Identifier: GPL-3.0-or-later
"""Reference directions of shell elements, and angles of yarns to them.

An angle is measured from the element's reference direction, about its normal by the right-hand rule
along its corners, in degrees in (-180, 180]. Programs differ in what the reference is:

side   from corner 1 to corner 2 (LS-DYNA with AOPT = 0; Nastran and OptiStruct with THETA blank)
x y z  the global axis, projected onto the element (Nastran and OptiStruct with MCID, OpenRadioss
       with its reference vector, Abaqus unless told otherwise)
"""

import numpy as np

from plotting.reading import Trouble

from exchange.shell_mesh import ShellMesh, element_normals, unit

AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
LEAST_ANGLE_DEG = 0.1  # between reference and normal; below it the next axis is projected


def parse_reference(word: str) -> str | tuple[float, ...]:
    """side, x, y, z, or three numbers with commas. Raises Trouble."""
    if word == "side" or word in AXES:
        return word
    try:
        vector = tuple(float(part) for part in word.split(","))
    except ValueError:
        vector = ()
    if len(vector) != 3 or not np.isfinite(vector).all() or not np.any(vector):
        raise Trouble(f"--reference {word}: a reference direction is side, x, y, z or three "
                      "numbers such as 1,1,0")
    return vector


def words_of(reference: str | tuple[float, ...]) -> str:
    """For the heads of files."""
    if reference == "side":
        return "side from corner 1 to corner 2"
    axis = ("global " + reference if isinstance(reference, str)
            else "vector " + " ".join(f"{value:g}" for value in reference))
    return axis + " projected onto the element"


def reference_directions(mesh: ShellMesh, reference: str | tuple[float, ...]) -> np.ndarray:
    """m x 3 unit vectors in the planes of the elements. Where an axis is within 0.1 degrees of the
    normal, the next one (z after x, x after all others) is projected."""
    normals = element_normals(mesh)[0]
    if reference == "side":
        raw = mesh.nodes[mesh.corners[:, 1]] - mesh.nodes[mesh.corners[:, 0]]
        return in_plane(raw, normals)
    axis = unit(np.asarray(AXES.get(reference, reference), float))
    other = np.asarray(AXES["z"] if reference == "x" else AXES["x"])
    along = np.abs(normals @ axis) > np.cos(np.radians(LEAST_ANGLE_DEG))
    return in_plane(np.where(along[:, None], other, axis), normals)


def in_plane(vectors: np.ndarray, normals: np.ndarray) -> np.ndarray:
    return unit(vectors - (vectors * normals).sum(axis=-1, keepdims=True) * normals)


def angles_to(reference: np.ndarray, directions: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """m, degrees in (-180, 180]."""
    angle = np.degrees(np.arctan2((np.cross(reference, directions) * normals).sum(axis=-1),
                                  (reference * directions).sum(axis=-1)))
    return np.where(angle <= -180.0, 180.0, angle)


def wrapped(angle: np.ndarray) -> np.ndarray:
    """The same yarn, which has no sense of direction, in (-90, 90] degrees."""
    return 90.0 - np.mod(90.0 - angle, 180.0)
