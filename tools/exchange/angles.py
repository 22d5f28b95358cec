# SPDX-License-Identifier: GPL-3.0-or-later
"""Reference directions of shell elements, and angles of yarns to them.

An angle is measured from the element's reference direction, about its normal by the right-hand rule
along its corners, in degrees in (-180, 180]. Programs differ in what the reference is:

side   from corner 1 to corner 2 (LS-DYNA with AOPT = 0; Nastran and OptiStruct with THETA blank)
x y z  the global axis, projected onto the element (Nastran and OptiStruct with MCID, OpenRadioss
       with its reference vector, Abaqus unless told otherwise)
part   the material axes that the part mesh's own file gives
"""

from dataclasses import dataclass

import numpy as np

from plotting.reading import Trouble

from exchange.shell_mesh import ShellMesh, centroids, neighbours, unit

AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
WORDS = ("side", "part", *AXES)
LEAST_ANGLE_DEG = 0.1  # between reference and normal; below it the next axis is projected
STEEP_DEG = 5.0        # between reference and normal; below it the projection turns fast
TOLD_TURN_DEG = 10.0   # between the references of neighbours: more is told
TOLD_ELEMENTS = 5      # by their numbers


def parse_reference(word: str | None) -> str | tuple[float, ...] | None:
    """side, part, x, y, z, or three numbers with commas; None if not told. Raises Trouble."""
    if word is None or word in WORDS:
        return word
    try:
        vector = tuple(float(part) for part in word.split(","))
    except ValueError:
        vector = ()
    if len(vector) != 3 or not np.isfinite(vector).all() or not np.any(vector):
        raise Trouble(f"--reference {word}: a reference direction is side, part, x, y, z or three "
                      "numbers such as 1,1,0")
    return vector


def words_of(reference: str | tuple[float, ...], mesh: ShellMesh) -> str:
    """What is asked for, for the heads of files."""
    if reference == "side":
        return "side from corner 1 to corner 2"
    if reference == "part":
        return f"material axes of the part mesh: {mesh.axes_words}; projected onto the element"
    axis = ("global " + reference if isinstance(reference, str)
            else "vector " + " ".join(f"{value:g}" for value in reference))
    return axis + " projected onto the element"


@dataclass
class Reference:
    """Reference directions of m elements, and where they are not what was asked for."""
    directions: np.ndarray  # m x 3, unit vectors in the planes of the elements
    replaced: np.ndarray    # rows of elements whose normal is along the reference
    other: str              # what these have in its place
    steep: np.ndarray       # rows of elements, others, whose normal is nearly along it


def reference_of(mesh: ShellMesh, reference: str | tuple[float, ...],
                 normals: np.ndarray) -> Reference:
    """Where an axis is within 0.1 degrees of the normal, the next one (z after x, x after all others)
    is projected, and the side from corner 1 to corner 2 where it is a material axis."""
    side = mesh.nodes[mesh.corners[:, 1]] - mesh.nodes[mesh.corners[:, 0]]
    if reference == "side":
        none = np.zeros(0, int)
        return Reference(in_plane(side, normals), none, "", none)
    if reference == "part":
        raw, other, name = unit(mesh.axes), side, "the side from corner 1 to corner 2"
    else:
        raw = np.broadcast_to(unit(np.asarray(AXES.get(reference, reference), float)), side.shape)
        next_one = "z" if reference == "x" else "x"
        other, name = np.asarray(AXES[next_one]), "global " + next_one
    across = np.degrees(np.arcsin(np.clip(np.linalg.norm(np.cross(raw, normals), axis=1), 0, 1)))
    replaced = across < LEAST_ANGLE_DEG
    return Reference(in_plane(np.where(replaced[:, None], other, raw), normals),
                     np.flatnonzero(replaced), name, np.flatnonzero(~replaced & (across < STEEP_DEG)))


def warnings_of(mesh: ShellMesh, found: Reference, normals: np.ndarray) -> list[str]:
    """What is to be told of places where the reference is along the normal, or nearly so."""
    lines = []
    if len(found.replaced):
        lines.append(f"the reference is within {LEAST_ANGLE_DEG:g} degrees of the normal of "
                     f"{named(mesh, found.replaced)}: {found.other} is projected there in its place")
    if len(found.steep):
        turn = largest_turn(mesh, found, normals, np.concatenate([found.replaced, found.steep]))
        lines.append(f"the normal of {named(mesh, found.steep)} is within {STEEP_DEG:g} degrees of the "
                     "reference, whose projection turns fast there"
                     + (f", by up to {turn:.0f} degrees from an element to the next"
                        if turn > TOLD_TURN_DEG else "")
                     + ": give another --reference if that matters")
    return lines


def named(mesh: ShellMesh, rows: np.ndarray) -> str:
    """Number, labels and place of elements."""
    some = ", ".join(str(label) for label in mesh.labels[rows[:TOLD_ELEMENTS]])
    middles = centroids(mesh)[rows]
    low, high = (" ".join(f"{value:.1f}" for value in of(axis=0)) for of in (middles.min, middles.max))
    return (f"{len(rows)} element{'s' if len(rows) > 1 else ''} ({some}"
            f"{', ...' if len(rows) > TOLD_ELEMENTS else ''}; "
            + (f"from ({low}) to ({high}))" if len(rows) > 1 else f"at ({low}))"))


def largest_turn(mesh: ShellMesh, found: Reference, normals: np.ndarray, where: np.ndarray) -> float:
    """Degrees between the references of neighbours of which one is among the rows `where`, after the
    turn from the one's normal to the other's."""
    one, two, differ = neighbours(mesh)
    near = np.zeros(len(normals), bool)
    near[where] = True
    here = near[one] | near[two]
    one, two = one[here], two[here]
    if not len(one):
        return 0.0
    facing = np.where(differ[here], -1.0, 1.0)[:, None]
    start, end = normals[one], normals[two] * facing
    ahead = found.directions[one]
    axis, cosine = np.cross(start, end), (start * end).sum(axis=1, keepdims=True)
    ahead = (cosine * ahead + np.cross(axis, ahead)
             + axis * (axis * ahead).sum(axis=1, keepdims=True) / np.maximum(1 + cosine, 1e-6))
    turn = np.abs(angles_to(ahead, found.directions[two], end))
    smooth = cosine[:, 0] > 0.5  # over an edge of the part a reference turns in any case
    return float(turn[smooth].max(initial=0.0))


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
