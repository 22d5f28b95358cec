# SPDX-License-Identifier: GPL-3.0-or-later
"""Exact normals and curvatures of the faces of gmsh's model at the corners of their triangles. Lengths in
mm."""

import gmsh
import numpy as np

from exchange.shell_mesh import triangle_normals, unit

STEP = 1e-5   # of the parameters, off a point where a face has no normal
APART = 1e-4  # of the parameters, for differences
ON_IT = 1e-6  # mm, of a point from the place of its parameters
NEWTON = 8    # steps
THIN = 1e-6   # sine of the angle between differences along the parameters: less is a pole
POLE = 1e-3   # of the longest difference along a parameter: shorter ones are of noise, as lines of it end in a pole
BESIDE = 0.02  # of the parameters, off a pole, where its curvature is taken


def at_corners(x: np.ndarray, triangles: np.ndarray,
               face: np.ndarray) -> tuple[np.ndarray, np.ndarray, dict[int, float]]:
    """Of triangles and the faces they are of: normals (m x 3 x 3), of each triangle's own face at its
    corners on the side that the triangles face; least and largest principal curvature (m x 3 x 2, 1/mm),
    above 0 where the face bends away from that side; and by face the sign of gmsh's normals."""
    normals, curvature = np.zeros((len(triangles), 3, 3)), np.zeros((len(triangles), 3, 2))
    sign = {}
    facing, area = triangle_normals(x, triangles)
    for tag in np.unique(face).tolist():
        here = np.flatnonzero(face == tag)
        points, at = np.unique(triangles[here], return_inverse=True)
        at = at.reshape(-1, 3)
        about = np.zeros((len(points), 3))
        np.add.at(about, at.ravel(), np.repeat(area[here, None] * facing[here], 3, axis=0))
        parameters = parameters_of(tag, x[points])
        exact, sign[tag] = exact_normals(tag, parameters, unit(about))
        normals[here] = exact[at]
        curvature[here] = (sign[tag] * curvatures(tag, parameters))[at]
    for tag, value in sign.items():
        if value < 0:
            curvature[face == tag] = curvature[face == tag][..., ::-1]
    return normals, curvature, sign


def normals_at(face: int, parameters: np.ndarray) -> np.ndarray:
    return np.array(gmsh.model.getNormal(face, parameters.ravel())).reshape(-1, 3)


def points_at(face: int, parameters: np.ndarray) -> np.ndarray:
    return np.array(gmsh.model.getValue(2, face, parameters.ravel())).reshape(-1, 3)


def inwards(face: int, parameters: np.ndarray) -> np.ndarray:
    """k x 2: from points to the middle of the range of parameters, by its width."""
    low, high = (np.array(ends) for ends in gmsh.model.getParametrizationBounds(2, face))
    return np.where(parameters < (low + high) / 2, 1.0, -1.0) * (high - low)


def parameters_of(face: int, points: np.ndarray) -> np.ndarray:
    """k x 2, of points on the face. Near seams getParametrization ends beside them, and getClosestPoint
    has none of points on edges: the better one is brought to the point."""
    first, second = (np.array(flat).reshape(-1, 2) for flat in
                     (gmsh.model.getParametrization(2, face, points.ravel()),
                      gmsh.model.getClosestPoint(2, face, points.ravel())[1]))
    away, other = (np.linalg.norm(points_at(face, some) - points, axis=1) for some in (first, second))
    found = np.where((other < away)[:, None], second, first)
    off = np.minimum(away, other) > ON_IT
    if off.any():
        found[off] = by_newton(face, points[off], found[off])
    return found


def by_newton(face: int, points: np.ndarray, found: np.ndarray) -> np.ndarray:
    """Parameters, from those of a place beside."""
    for _ in range(NEWTON):
        here, step = points_at(face, found), APART * inwards(face, found)
        along = np.stack([(points_at(face, found + step * axis) - here) / step[:, [number]]
                          for number, axis in enumerate(np.eye(2))], axis=2)
        found = found + (np.linalg.pinv(along) @ (points - here)[..., None])[..., 0]
    return found


def exact_normals(face: int, parameters: np.ndarray, about: np.ndarray) -> tuple[np.ndarray, float]:
    """On the side of `about`, the normals of the triangles round the points, and the sign of gmsh's. At a
    pole gmsh has either sign, or none: a point beside it is asked there. At the tip of a cone it is that
    of the triangles."""
    normals = normals_at(face, parameters)
    sign = 1.0 if np.median((normals * about).sum(axis=1)) > 0 else -1.0
    lost = ~(sign * (normals * about).sum(axis=1) > 0)
    if lost.any():
        normals[lost] = normals_at(face, (parameters + STEP * inwards(face, parameters))[lost])
    lost = ~(np.linalg.norm(normals, axis=1) > 0.5)  # slivers may face anywhere: they decide nothing
    return np.where(lost[:, None], about, sign * normals), sign


def curvatures(face: int, parameters: np.ndarray) -> np.ndarray:
    """k x 2, 1/mm: least and largest principal curvature, above 0 where gmsh's normals spread; at poles that
    beside them. gmsh's own have no sign to rely on."""
    found, length = by_differences(face, parameters)
    pole = (length < POLE * length.max(axis=0)).any(axis=1)
    if pole.any():
        found[pole] = by_differences(face, (parameters + BESIDE * inwards(face, parameters))[pole])[0]
    return found


def by_differences(face: int, parameters: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """k x 2 curvatures, 0 where the face has no tangent plane; and how far the points lie apart, mm, by which
    they are taken along both parameters."""
    step = APART * inwards(face, parameters)
    here, normal = points_at(face, parameters), normals_at(face, parameters)
    along, turn = [], []
    for number in range(2):
        there = parameters.copy()
        there[:, number] += step[:, number]
        along.append(points_at(face, there) - here)
        turn.append(normals_at(face, there) - normal)
    # turn = shape operator applied to along, in a basis of the tangent plane
    one = unit(along[0])
    two = np.cross(normal, one)
    sides, turns = (np.stack([np.stack([(vector * axis).sum(axis=1) for axis in (one, two)], axis=1)
                              for vector in vectors], axis=2) for vectors in (along, turn))
    size = np.linalg.norm(sides, axis=1).prod(axis=1)
    area = np.linalg.det(sides)
    known = np.abs(area) > THIN * size
    known &= size > 0
    found = np.zeros((len(parameters), 2))
    shape = turns[known] @ np.linalg.inv(sides[known])
    found[known] = np.linalg.eigvalsh((shape + shape.transpose(0, 2, 1)) / 2)
    return found, np.stack([np.linalg.norm(one, axis=1) for one in along], axis=1)
