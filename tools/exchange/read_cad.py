# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids of STEP and IGES files: their surfaces as triangles, by Open CASCADE and the mesher of gmsh.

gmsh keeps one model for all of a process and ends it on files that Open CASCADE cannot bear: call
read_solid in a process of its own (mesh_tool.py does)."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import gmsh
import numpy as np

from exchange.cad_facets import (Say, deviation_of, exact_points, faces_of, mesh, part_of, projected,
                                 short)
from exchange.cad_numbers import expect_lengths
from exchange.orient_facets import oriented
from exchange.refine_facets import refined
from base.files import read_bytes
from plotting.reading import Trouble

ENDINGS = {".step": "STEP", ".stp": "STEP", ".iges": "IGES", ".igs": "IGES"}
SEW = 0.01  # mm: edges of faces nearer than that are one
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


@contextmanager
def cad_model(path: Path) -> Iterator[None]:
    """gmsh, quiet, as a file of this kind is read: lengths in mm."""
    gmsh.initialize([], False)
    try:
        for option, value in {"General.Terminal": 0, "Mesh.Algorithm": 6, "Mesh.RandomFactor": 1e-9,
                              "Mesh.MeshSizeExtendFromBoundary": 0}.items():
            gmsh.option.setNumber(option, value)
        if ENDINGS[path.suffix.lower()] == "STEP":  # IGES is turned into mm in any case
            gmsh.option.setString("Geometry.OCCTargetUnit", "MM")
        yield
    finally:
        gmsh.finalize()


def read_solid(path: Path, deflection: float, say: Say) -> Facets:
    """The one solid of a file, with triangles within `deflection` mm of its surface as far as ROUNDS
    rounds take it. Raises Trouble: no such file, not of the kind that its ending says, nothing in
    it, an open shell, several solids, a hollow, no volume, not to be meshed."""
    say(None, "reads the part")
    unit = check_kind(path)
    with cad_model(path):
        solid, sewn = one_solid(path)
        volume, size = volume_and_size(path, solid)
        say(0.02, "takes points of its faces")
        faces = faces_of(solid)
        samples = exact_points(faces)
        x, triangles, face = mesh(path, faces, deflection, size, part_of(say, 0.1, 0.5))
        for k in range(ROUNDS):
            say(0.5 + 0.1 * k, f"refines {len(triangles)} triangles")
            x, triangles, face = refined(x, triangles, face, projected, 0.8 ** k * deflection)
            say(0.55 + 0.1 * k, f"measures {len(triangles)} triangles")
            away = deviation_of(x, triangles, face, samples)
            if len(away) and away.max() <= deflection:
                break
        if not len(away):
            raise Trouble(f"{path}: no point of its faces can be had to measure the deviation: heal "
                          "the part in the CAD program, or export STL from there")
        say(0.9, "turns the triangles outwards")
        x, triangles = oriented(path, x, triangles)
        return Facets(x, triangles, away, abs(volume), unit, sewn)


def volume_and_size(path: Path, solid: int) -> tuple[float, float]:
    """mm3, and the diagonal of the box round it in mm. Raises Trouble if it has no volume."""
    volume = gmsh.model.occ.getMass(3, solid)
    box = np.array(gmsh.model.getBoundingBox(3, solid)).reshape(2, 3)
    size = float(np.linalg.norm(box[1] - box[0]))
    if not abs(volume) > 1e-9 * size ** 3:
        raise Trouble(f"{path}: its solid has no volume ({volume:.3g} mm3): save a solid body")
    return volume, size


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
    """Tag of the solid, and whether it had to be sewn. Raises Trouble unless there is just one."""
    solids, faces, sewn = imported(path)
    if not solids:
        count = "1 face is" if len(faces) == 1 else f"{len(faces)} faces are"
        raise Trouble(f"{path}: its {count} an open shell, "
                      f"which edges within {SEW:g} mm do not close: close it to a solid in the CAD "
                      "program")
    return solids[0], sewn


def imported(path: Path) -> tuple[list[int], list[int], bool]:
    """Solids, of which there is one at most, faces, and whether these had to be sewn."""
    try:
        gmsh.model.occ.importShapes(str(path))
    except Exception as problem:
        raise Trouble(f"{path} cannot be read by Open CASCADE ({short(problem)}): export the part "
                      "anew") from None
    gmsh.model.occ.synchronize()
    sewn = not gmsh.model.getEntities(3) and bool(gmsh.model.getEntities(2))
    if sewn:
        gmsh.model.occ.healShapes(tolerance=SEW, sewFaces=True, makeSolids=True)
        gmsh.model.occ.synchronize()
    solids, faces = ([tag for _, tag in gmsh.model.getEntities(dim)] for dim in (3, 2))
    if not faces:
        raise Trouble(f"{path} has no faces: export the solid, not its curves or an empty part")
    if len(solids) > 1:
        raise Trouble(f"{path} has {len(solids)} solids, and a tool is one: export each to a file "
                      "of its own, or unite them")
    return solids, faces, sewn
