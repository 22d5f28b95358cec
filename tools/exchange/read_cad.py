# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids of STEP and IGES files: their surfaces as triangles, by Open CASCADE and the mesher of gmsh.

gmsh keeps one model for all of a process and ends it on files that Open CASCADE cannot bear: call
read_solid in a process of its own (mesh_tool.py does)."""

import math
import re
from dataclasses import dataclass
from pathlib import Path

import gmsh
import numpy as np

from exchange.cad_numbers import expect_lengths
from exchange.closest import Surface
from exchange.refine_facets import refined
from base.files import read_bytes
from plotting.reading import Trouble

ENDINGS = {".step": "STEP", ".stp": "STEP", ".iges": "IGES", ".igs": "IGES"}
SEW = 0.01  # mm: edges of faces nearer than that are one
GRID = 24   # points a side, of a face's parameters, at which the deviation is measured
MOST = 500000  # triangles
MOST_BYTES = 2 << 30  # of a file: Open CASCADE takes some ten times as much memory
ROUNDS = 4  # of refining, each with less allowed, until the deviation is reached


@dataclass
class Facets:
    """A solid's surface. Lengths in mm."""
    x: np.ndarray          # n x 3
    triangles: np.ndarray  # m x 3, anticlockwise from outside
    deviation: np.ndarray  # k, distances of points of the exact surface from the triangles
    volume: float          # mm3, of the exact solid
    unit: str              # of the file, in words
    sewn: bool             # the file has faces only, which were sewn to a solid


def read_solid(path: Path, deflection: float) -> Facets:
    """The one solid of a file, with triangles within `deflection` mm of its surface as far as ROUNDS
    rounds take it. Raises Trouble: no such file, not of the kind that its ending says, nothing in
    it, an open shell, several solids, a hollow, no volume, not to be meshed."""
    unit = check_kind(path)
    gmsh.initialize([], False)
    try:
        for option, value in {"General.Terminal": 0, "Mesh.Algorithm": 6, "Mesh.RandomFactor": 1e-9,
                              "Mesh.MeshSizeExtendFromBoundary": 0}.items():
            gmsh.option.setNumber(option, value)
        if ENDINGS[path.suffix.lower()] == "STEP":  # IGES is turned into mm in any case
            gmsh.option.setString("Geometry.OCCTargetUnit", "MM")
        solid, sewn = one_solid(path)
        volume = gmsh.model.occ.getMass(3, solid)
        box = np.array(gmsh.model.getBoundingBox(3, solid)).reshape(2, 3)
        size = float(np.linalg.norm(box[1] - box[0]))
        if not abs(volume) > 1e-9 * size ** 3:
            raise Trouble(f"{path}: its solid has no volume ({volume:.3g} mm3): save a solid body")
        samples = exact_points(solid)
        x, triangles, face = mesh(path, solid, deflection, size)
        for k in range(ROUNDS):
            x, triangles, face = refined(x, triangles, face, projected, 0.8 ** k * deflection)
            away = deviation_of(x, triangles, face, samples)
            if len(away) and away.max() <= deflection:
                break
        if not len(away):
            raise Trouble(f"{path}: no point of its faces can be had to measure the deviation: heal "
                          "the part in the CAD program, or export STL from there")
        x, triangles = oriented(path, x, triangles)
        return Facets(x, triangles, away, abs(volume), unit, sewn)
    finally:
        gmsh.finalize()


def check_kind(path: Path) -> str:
    """The file's unit in words. Raises Trouble unless it is what its ending says."""
    kind = ENDINGS.get(path.suffix.lower())
    if not kind:
        raise Trouble(f"{path}: a part is a .step, .stp, .iges or .igs file")
    text = read_bytes(path, MOST_BYTES).decode("latin-1")
    if kind == "STEP":
        if not text.lstrip().startswith("ISO-10303-21"):
            raise Trouble(f"{path} is no STEP file, it does not begin with ISO-10303-21: export the "
                          "part as STEP (AP203, AP214 or AP242)")
        if "END-ISO-10303-21" not in text[-200:]:
            raise Trouble(f"{path} is cut short, it does not end with END-ISO-10303-21: export the "
                          "part anew")
        expect_lengths(path, text)
        return step_unit(text)
    lines = text.splitlines()
    if not lines or len(lines[0]) < 73 or lines[0][72] != "S":
        raise Trouble(f"{path} is no IGES file, its first line has no S in column 73: export the "
                      "part as IGES, or better as STEP")
    if not any(len(line) >= 73 and line[72] == "T" for line in lines[-3:]):
        raise Trouble(f"{path} is cut short, its last line has no T in column 73: export the part "
                      "anew")
    expect_lengths(path, text)
    return iges_unit(lines)


def step_unit(text: str) -> str:
    flat = re.sub(r"\s+", "", text[:4000000])
    if named := re.search(r"CONVERSION_BASED_UNIT\('(INCH|FOOT)'", flat, re.IGNORECASE):
        return named[1].lower()
    found = re.search(r"SI_UNIT\((\.\w+\.|\$),\.METRE\.\)", flat)
    if not found:
        return "not stated"
    return {"$": "m", ".MILLI.": "mm", ".CENTI.": "cm"}.get(found[1], found[1].strip("."))


def iges_unit(lines: list[str]) -> str:
    """Parameter 15 of the global section; texts in it are counted, 3Habc."""
    text = "".join(line[:72] for line in lines if len(line) >= 73 and line[72] == "G")
    names = re.findall(r"\d+H(IN|INCH|MM|FT|M|CM|UM)\s*[,;]", text)
    return {"IN": "inch", "INCH": "inch"}.get(names[-1], names[-1].lower()) if names else "not stated"


def one_solid(path: Path) -> tuple[int, bool]:
    """Tag of the solid, and whether it had to be sewn."""
    try:
        gmsh.model.occ.importShapes(str(path))
    except Exception as problem:
        raise Trouble(f"{path} cannot be read by Open CASCADE ({short(problem)}): export the part "
                      "anew") from None
    gmsh.model.occ.synchronize()
    solids, faces, sewn = gmsh.model.getEntities(3), gmsh.model.getEntities(2), False
    if not solids and faces:
        gmsh.model.occ.healShapes(tolerance=SEW, sewFaces=True, makeSolids=True)
        gmsh.model.occ.synchronize()
        solids, sewn = gmsh.model.getEntities(3), True
    if not solids and faces:
        count = "1 face is" if len(faces) == 1 else f"{len(faces)} faces are"
        raise Trouble(f"{path}: its {count} an open shell, "
                      f"which edges within {SEW:g} mm do not close: close it to a solid in the CAD "
                      "program")
    if not solids:
        raise Trouble(f"{path} has no faces: export the solid, not its curves or an empty part")
    if len(solids) > 1:
        raise Trouble(f"{path} has {len(solids)} solids, and a tool is one: export each to a file "
                      "of its own, or unite them")
    return solids[0][1], sewn


def short(problem: Exception) -> str:
    return str(problem).strip().splitlines()[0] if str(problem).strip() else "no reason given"


def faces_of(solid: int) -> list[tuple[int, int]]:
    return gmsh.model.getBoundary([(3, solid)], oriented=False)


def exact_points(solid: int) -> dict[int, np.ndarray]:
    """Points of each face, on a grid of its parameters, where it is not cut away."""
    found = {}
    for dim, face in faces_of(solid):
        low, high = gmsh.model.getParametrizationBounds(dim, face)
        u, v = (a + (b - a) * (np.arange(GRID) + 0.5) / GRID for a, b in zip(low, high))
        grid = [(one, two) for one in u for two in v
                if gmsh.model.isInside(dim, face, [one, two])]
        if grid:
            found[face] = np.array(gmsh.model.getValue(dim, face, np.ravel(grid))).reshape(-1, 3)
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
    """The closest points of a face, or of the curves between two faces."""
    if len(faces) == 1:
        return np.array(gmsh.model.getClosestPoint(2, faces[0], points.ravel())[0]).reshape(-1, 3)
    curves = [{tag for _, tag in gmsh.model.getBoundary([(2, face)], oriented=False)}
              for face in faces]
    found = [np.array(gmsh.model.getClosestPoint(1, curve, points.ravel())[0]).reshape(-1, 3)
             for curve in sorted(set.intersection(*curves))]
    away = np.array([np.linalg.norm(some - points, axis=1) for some in found])
    return np.array(found)[away.argmin(axis=0), np.arange(len(points))]


def mesh(path: Path, solid: int, deflection: float,
         size: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points, triangles and their faces. A triangle of side h on a surface of curvature k misses it
    by h^2 k / 6 at its middle."""
    coarse = size / 10
    of_face, count = {}, 0.0
    for _, face in faces_of(solid):
        curvature = largest_curvature(face)
        of_face[face] = min(coarse, math.sqrt(6 * deflection / curvature)) if curvature else coarse
        count += gmsh.model.occ.getMass(2, face) / (0.43 * of_face[face] ** 2)
    if count > MOST:
        raise Trouble(f"{path} is {size:.6g} mm large and would take {count:.1e} triangles at a "
                      f"deflection of {deflection:g} mm, more than {MOST}: check the part's unit, "
                      "or give a larger --deflection")
    of_curve = {}
    for face, wanted in of_face.items():
        for _, curve in gmsh.model.getBoundary([(2, face)], oriented=False):
            of_curve[curve] = min(wanted, of_curve.get(curve, coarse))
    sizes = {1: of_curve, 2: of_face}
    gmsh.model.mesh.clear()
    gmsh.model.mesh.setSizeCallback(
        lambda dim, tag, x, y, z: sizes.get(dim, {}).get(tag, coarse))
    try:
        gmsh.model.mesh.generate(2)
    except Exception as problem:
        raise Trouble(f"{path} cannot be meshed ({short(problem)}): heal the part in the CAD "
                      "program, or export STL from there") from None
    tags, flat, _ = gmsh.model.mesh.getNodes()
    place = {int(tag): number for number, tag in enumerate(tags)}
    corners, tags_of_faces = [], []
    for _, face in faces_of(solid):
        kinds, _, nodes = gmsh.model.mesh.getElements(2, face)
        corners += [np.array([place[int(n)] for n in some]).reshape(-1, 3)
                    for kind, some in zip(kinds, nodes) if kind == 2]
        tags_of_faces += [face] * (sum(map(len, corners)) - len(tags_of_faces))
    if not corners:
        raise Trouble(f"{path} cannot be meshed: no triangles came of its faces: heal the part in "
                      "the CAD program, or export STL from there")
    return np.array(flat).reshape(-1, 3), np.concatenate(corners), np.array(tags_of_faces)


def oriented(path: Path, x: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Used points only, and triangles that go round alike, outwards. Raises Trouble if they are not
    closed."""
    used, corners = np.unique(triangles, return_inverse=True)
    x, triangles = x[used], corners.reshape(-1, 3).copy()
    sides: dict[tuple[int, int], list[int]] = {}
    for number, (a, b, c) in enumerate(triangles.tolist()):
        for one, two in ((a, b), (b, c), (c, a)):
            sides.setdefault((min(one, two), max(one, two)), []).append(number)
    open_sides = sum(len(at) != 2 for at in sides.values())
    if open_sides or not len(triangles):
        raise Trouble(f"{path}: its facets are not closed ({open_sides} edges without two "
                      "triangles): heal the part in the CAD program, or export STL from there")
    turned, seen, todo = np.zeros(len(triangles), bool), np.zeros(len(triangles), bool), [0]
    seen[0] = True
    while todo:
        number = todo.pop()
        for one, two in directed(triangles[number], turned[number]):
            for other in sides[(min(one, two), max(one, two))]:
                if not seen[other]:
                    seen[other] = True
                    turned[other] = (one, two) in directed(triangles[other], False)
                    todo.append(other)
    if not seen.all():
        raise Trouble(f"{path}: its solid has a hollow inside, which no tool needs: fill it in the "
                      "CAD program")
    triangles[turned] = triangles[turned][:, ::-1]
    if signed_volume(x, triangles) < 0:
        triangles = triangles[:, ::-1].copy()
    return x, triangles


def directed(corners, turned: bool) -> list[tuple[int, int]]:
    a, b, c = (int(n) for n in (corners[::-1] if turned else corners))
    return [(a, b), (b, c), (c, a)]


def signed_volume(x: np.ndarray, triangles: np.ndarray) -> float:
    a, b, c = (x[triangles[:, k]] for k in range(3))
    return float((a * np.cross(b, c)).sum() / 6)
