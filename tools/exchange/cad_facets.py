# SPDX-License-Identifier: GPL-3.0-or-later
"""Facets of the faces of gmsh's model, which came of Open CASCADE, and how far they are from it.
Lengths in mm."""

import math
from collections.abc import Callable
from pathlib import Path

import gmsh
import numpy as np

from exchange.closest import Surface
from exchange.refine_facets import RIM
from plotting.reading import Trouble

GRID = 24   # points a side, of a face's parameters, at which the deviation is measured
MOST = 500000  # triangles

# fraction of the work that is done, and what is being done
Say = Callable[[float | None, str], None]


def part_of(say: Say, begin: float, end: float) -> Say:
    """For a part of the work, which tells its own fractions."""
    return lambda fraction, words: say(None if fraction is None else begin + (end - begin) * fraction,
                                       words)


def short(problem: Exception) -> str:
    return str(problem).strip().splitlines()[0] if str(problem).strip() else "no reason given"


def faces_of(solid: int) -> list[int]:
    return [face for _, face in gmsh.model.getBoundary([(3, solid)], oriented=False)]


def inner_parameters(face: int) -> np.ndarray:
    """k x 2: a grid of a face's parameters, where it is not cut away."""
    low, high = gmsh.model.getParametrizationBounds(2, face)
    u, v = (a + (b - a) * (np.arange(GRID) + 0.5) / GRID for a, b in zip(low, high))
    return np.array([(one, two) for one in u for two in v
                     if gmsh.model.isInside(2, face, [one, two])]).reshape(-1, 2)


def exact_points(faces: list[int]) -> dict[int, np.ndarray]:
    """Points of each face, on a grid of its parameters, where it is not cut away."""
    found = {}
    for face in faces:
        grid = inner_parameters(face)
        if len(grid):
            found[face] = np.array(gmsh.model.getValue(2, face, grid.ravel())).reshape(-1, 3)
    return found


def deviation_of(x: np.ndarray, triangles: np.ndarray, face: np.ndarray,
                 samples: dict[int, np.ndarray]) -> np.ndarray:
    """Distances of the points of each face from the triangles of that face, mm."""
    away = [np.zeros(0)]
    for tag, points in samples.items():
        here = triangles[face == tag]
        surface = Surface(x, here, np.zeros((len(here), 3)))
        away.append(surface.closest(points, np.inf)[2])
    return np.concatenate(away)


def largest_curvature(face: int) -> float:
    """1/mm, over a coarse grid of the face's parameters."""
    low, high = gmsh.model.getParametrizationBounds(2, face)
    u, v = (a + (b - a) * (np.arange(6) + 0.5) / 6 for a, b in zip(low, high))
    grid = np.array([(one, two) for one in u for two in v])
    values = np.abs(gmsh.model.getCurvature(2, face, grid.ravel()))
    values = values[np.isfinite(values)]
    return float(values.max()) if len(values) else 0.0


def projected(faces: tuple[int, ...], points: np.ndarray) -> np.ndarray:
    """The closest points of a face, or of the curves between two faces, or round one."""
    if len(faces) == 1:
        return np.array(gmsh.model.getClosestPoint(2, faces[0], points.ravel())[0]).reshape(-1, 3)
    curves = [{tag for _, tag in gmsh.model.getBoundary([(2, face)], oriented=False)}
              for face in faces if face != RIM]
    found = [np.array(gmsh.model.getClosestPoint(1, curve, points.ravel())[0]).reshape(-1, 3)
             for curve in sorted(set.intersection(*curves))]
    away = np.array([np.linalg.norm(some - points, axis=1) for some in found])
    return np.array(found)[away.argmin(axis=0), np.arange(len(points))]


def mesh(path: Path, faces: list[int], deflection: float, size: float,
         say: Say) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points, triangles and their faces. A triangle of side h on a surface of curvature k misses it
    by h^2 k / 6 at its middle. The fractions told are of this work alone."""
    coarse = size / 10
    of_face, counts = {}, {}
    for face in faces:
        curvature = largest_curvature(face)
        of_face[face] = min(coarse, math.sqrt(6 * deflection / curvature)) if curvature else coarse
        counts[face] = gmsh.model.occ.getMass(2, face) / (0.43 * of_face[face] ** 2)
    count = sum(counts.values())
    if count > MOST:
        raise Trouble(f"{path} is {size:.6g} mm large and would take {count:.1e} triangles at a "
                      f"deflection of {deflection:g} mm, more than {MOST}: check the part's unit, "
                      "or give a larger --deflection")
    of_curve = {}
    for face, wanted in of_face.items():
        for _, curve in gmsh.model.getBoundary([(2, face)], oriented=False):
            of_curve[curve] = min(wanted, of_curve.get(curve, coarse))
    sizes = {1: of_curve, 2: of_face}
    begun: dict[int, float] = {}

    def wanted_size(dim: int, tag: int, *_) -> float:
        if dim == 2 and tag in counts and tag not in begun:
            say(sum(begun.values()) / max(count, 1.0), f"meshes face {len(begun) + 1} of {len(faces)}")
            begun[tag] = counts[tag]
        return sizes.get(dim, {}).get(tag, coarse)
    gmsh.model.mesh.clear()
    gmsh.model.mesh.setSizeCallback(wanted_size)
    try:
        gmsh.model.mesh.generate(2)
    except Exception as problem:
        raise Trouble(f"{path} cannot be meshed ({short(problem)}): heal the part in the CAD "
                      "program, or export STL from there") from None
    tags, flat, _ = gmsh.model.mesh.getNodes()
    place = {int(tag): number for number, tag in enumerate(tags)}
    corners, tags_of_faces = [], []
    for face in faces:
        kinds, _, nodes = gmsh.model.mesh.getElements(2, face)
        corners += [np.array([place[int(n)] for n in some]).reshape(-1, 3)
                    for kind, some in zip(kinds, nodes) if kind == 2]
        tags_of_faces += [face] * (sum(map(len, corners)) - len(tags_of_faces))
    if not corners:
        raise Trouble(f"{path} cannot be meshed: no triangles came of its faces: heal the part in "
                      "the CAD program, or export STL from there")
    return np.array(flat).reshape(-1, 3), np.concatenate(corners), np.array(tags_of_faces)
