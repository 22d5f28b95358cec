# SPDX-License-Identifier: GPL-3.0-or-later
"""The sheet that tools are made from: an open shell of a STEP or IGES file, or the skin of a solid, with
the exact normals of its faces. Lengths in mm.

gmsh keeps one model for all of a process: call read_sheet in a process of its own (mesh_tool.py)."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import gmsh
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from exchange.cad_facets import (Say, deviation_of, exact_points, faces_of, inner_parameters, mesh,
                                 part_of, projected)
from exchange.face_geometry import at_corners
from exchange.offset_crossings import expect_no_crossing
from exchange.offset_facets import TANGENT, Parallel, Sheet, parallel, sides_of
from exchange.orient_facets import oriented
from exchange.read_cad import ROUNDS, cad_model, check_kind, imported, volume_and_size
from exchange.refine_facets import refined
from exchange.shell_mesh import triangle_normals
from plotting.reading import Trouble

SIDEWAYS = 0.01     # of the cosine to the direction of pressing: walls along it
FLAT = 1e-6         # of the cosine between normals: a plane
FLAT_SHARE = 0.02   # of the area that has to face the direction, to know which side is which


@dataclass
class Room:
    """How far the other tool is to be."""
    at: Callable[[np.ndarray], np.ndarray]  # of points (n x 3), mm
    least: float  # mm
    most: float   # mm
    words: str    # where it is from

    def __call__(self, x: np.ndarray) -> np.ndarray:
        return self.at(x)


@dataclass
class Asked:
    """What tools are asked for. `direction`: that of pressing, a unit vector, from punch to die."""
    deflection: float
    direction: np.ndarray
    on: str                    # "die" or "punch": whose surface the sheet is
    solid: str                 # "part", "tool" or "": what a solid is
    room: Room

    @property
    def other(self) -> str:
        return "punch" if self.on == "die" else "die"

    @property
    def remedy(self) -> str:
        return f"give less room (--offset), or --on {self.other}"


@dataclass
class Pair:
    """A sheet and what is parallel to it."""
    sheet: Sheet
    room: np.ndarray           # n, of the points of the sheet
    away: Parallel
    deviation: np.ndarray      # of the sheet from the exact surface, mm
    deviation_away: np.ndarray  # of the other from the exact parallel surface, mm
    words: str                 # what was taken
    unit: str                  # of the file


def read_sheet(path: Path, asked: Asked, say: Say) -> Pair:
    """Raises Trouble: as read_solid does; it is not known which side is which; it would cross itself."""
    say(None, "reads the part")
    unit_words = check_kind(path)
    with cad_model(path):
        solids, faces, sewn = imported(path)
        if solids and not asked.solid:
            volume, _ = volume_and_size(path, solids[0])
            raise Trouble(f"{path} is a solid of {volume:.6g} mm3: say what it is by --solid part (a "
                          "formed part with its thickness: the skin that touches the tool of --on is "
                          "taken) or --solid tool (the body of that tool), or save one skin of it as "
                          "an open shell")
        faces = faces_of(solids[0]) if solids else faces
        box = np.array(gmsh.model.getBoundingBox(-1, -1)).reshape(2, 3)
        return paired(path, asked, Source(path, faces, bool(solids), sewn, unit_words,
                                          float(np.linalg.norm(box[1] - box[0]))), say)


@dataclass
class Source:
    path: Path
    faces: list[int]
    solid: bool
    sewn: bool
    unit: str
    size: float


def paired(path: Path, asked: Asked, source: Source, say: Say) -> Pair:
    """With triangles within the deflection of both surfaces, as far as ROUNDS rounds take it."""
    say(0.02, "takes points of its faces")
    parameters = {tag: inner_parameters(tag) for tag in source.faces}
    samples = exact_points(source.faces)
    x, triangles, face = mesh(path, source.faces, asked.deflection, source.size, part_of(say, 0.1, 0.5))
    limits = {tag: asked.deflection for tag in source.faces}
    for k in range(ROUNDS):
        say(0.5 + 0.1 * k, f"takes the normals of {len(triangles)} triangles")
        sheet, words, sign = sheet_of(asked, source, x, triangles, face)
        expect_no_crossing(path, sheet, asked.room(sheet.x), asked.remedy)
        limits.update({tag: 0.8 ** k * limit for tag, limit in limits_of(asked, sheet).items()})
        say(0.53 + 0.1 * k, f"refines {len(triangles)} triangles")
        x, triangles, face = refined(x, triangles, face, projected, limits)
        sheet, words, sign = sheet_of(asked, source, x, triangles, face)
        room = asked.room(sheet.x)
        expect_no_crossing(path, sheet, room, asked.remedy)
        say(0.57 + 0.1 * k, f"measures {len(sheet.triangles)} triangles")
        away = parallel(sheet, room, asked.deflection)
        of_sheet = {tag: points for tag, points in samples.items() if tag in sign}
        here = deviation_of(sheet.x, sheet.triangles, sheet.face, of_sheet)
        there = deviation_of(away.x, away.triangles, away.face,
                             exact_away(asked, of_sheet, parameters, sign))
        if len(here) and max(here.max(), there.max()) <= asked.deflection:
            break
    if not len(here):
        raise Trouble(f"{path}: no point of its faces can be had to measure the deviation: heal the part "
                      "in the CAD program")
    return Pair(sheet, room, away, here, there, words, source.unit)


def limits_of(asked: Asked, sheet: Sheet) -> dict[int, float]:
    """mm that the triangles of each face may miss it by: a triangle where the room is on the outer side
    of a curvature k grows by 1 + k times the room, and what it misses its surface by."""
    most = sheet.curvature[..., 1].max(axis=1)
    tags, number = np.unique(sheet.face, return_inverse=True)
    grows = np.ones(len(tags))
    np.maximum.at(grows, number, 1 + most * asked.room.most)
    return {tag: asked.deflection / grow for tag, grow in zip(tags.tolist(), grows.tolist())}


def exact_away(asked: Asked, samples: dict[int, np.ndarray], parameters: dict[int, np.ndarray],
               sign: dict[int, float]) -> dict[int, np.ndarray]:
    """Exact points of the parallel surface."""
    found = {}
    for tag, points in samples.items():
        normals = np.array(gmsh.model.getNormal(tag, parameters[tag].ravel())).reshape(-1, 3)
        known = np.linalg.norm(normals, axis=1) > 0.5
        found[tag] = (points + asked.room(points)[:, None] * sign[tag] * normals)[known]
    return found


def sheet_of(asked: Asked, source: Source, x: np.ndarray, triangles: np.ndarray,
             face: np.ndarray) -> tuple[Sheet, str, dict[int, float]]:
    """The sheet, words for it, and by face the sign of gmsh's normals on the side of the room."""
    x, triangles = oriented(source.path, x, triangles, source.solid)
    normals, curvature, sign = at_corners(x, triangles, face)
    sheet = Sheet(x, triangles, normals, face, curvature)
    facing, area = triangle_normals(x, triangles)
    if source.solid:
        sheet, words, turned = shaped_skin(asked, source, sheet)
    else:
        turned = shell_turned(asked, source.path, facing, area)
        words = f"{'faces sewn to an' if source.sewn else 'an'} open shell of {len(source.faces)} " \
                f"face{'s' * (len(source.faces) > 1)}"
    if turned:
        sheet = sheet.turned()
        sign = {tag: -value for tag, value in sign.items()}
    kept = set(np.unique(sheet.face).tolist())
    return sheet, words, {tag: value for tag, value in sign.items() if tag in kept}


def shell_turned(asked: Asked, path: Path, facing: np.ndarray, area: np.ndarray) -> bool:
    """Whether the triangles of an open shell have to be turned to face the cloth: those of the die
    against the direction of pressing."""
    towards = float((facing @ asked.direction * area).sum())
    if abs(towards) < FLAT_SHARE * area.sum():
        raise Trouble(f"{path}: as much of the surface faces the punch as the die, with the direction "
                      f"of pressing {asked.direction.round(3).tolist()}: give another --direction")
    return (towards > 0) == (asked.on == "die")


def shaped_skin(asked: Asked, source: Source, sheet: Sheet) -> tuple[Sheet, str, bool]:
    """As skin_of. A skin that is one plane forms nothing: then the solid is not what it is said to be, but the
    body of a tool, or the part, with its shape on the other side. Raises Trouble if that is a plane too."""
    skin, words, inside = skin_of(asked, source, sheet)
    if not is_plane(skin):
        return skin, words, inside
    otherwise = replace(asked, solid="tool" if asked.solid == "part" else "part")
    skin, other, inside = skin_of(otherwise, source, sheet)
    if is_plane(skin):
        raise Trouble(f"{source.path}: both sides of the solid are flat, seen along the direction of pressing "
                      f"{asked.direction.round(3).tolist()}: nothing would be formed; give another --direction")
    what = f"the body of the {asked.on}" if asked.solid == "part" else "the formed part"
    return skin, f"{other}; it is taken for {what}, as its skin on the other side is flat", inside


def is_plane(skin: Sheet) -> bool:
    normals = skin.normals.reshape(-1, 3)
    return bool((normals @ normals[0]).min() > 1 - FLAT)


def skin_of(asked: Asked, source: Source, sheet: Sheet) -> tuple[Sheet, str, bool]:
    """Of a solid, whose triangles face outwards: the faces that hang together without edges, none of
    which turns away from the other tool, and that face it most; words; and whether the room is inside."""
    # the skin of a punch faces the die, that of a part what it touches
    towards = asked.direction if (asked.on == "punch") == (asked.solid == "tool") else -asked.direction
    facing, area = triangle_normals(sheet.x, sheet.triangles)
    tags, number = np.unique(sheet.face, return_inverse=True)
    least, total = np.full(len(tags), np.inf), np.zeros(len(tags))
    np.minimum.at(least, number, (sheet.normals @ towards).min(axis=1))
    np.add.at(total, number, area * (facing @ towards))
    sides = sides_of(sheet.triangles)
    normals = sheet.normals.reshape(-1, 3)
    smooth = (normals[sides.a_first] * normals[sides.a_second]).sum(axis=1) >= TANGENT
    one, two = number[sides.a_first // 3], number[sides.a_second // 3]
    joined = smooth & (least[one] >= -SIDEWAYS) & (least[two] >= -SIDEWAYS)
    link = coo_matrix((np.ones(joined.sum(), np.int8), (one[joined], two[joined])),
                      shape=(len(tags), len(tags)))
    _, group = connected_components(link, directed=False)
    gain = np.bincount(group, np.where(least >= -SIDEWAYS, total, 0.0))
    if not gain.max() > 0:
        raise Trouble(f"{source.path}: no face of the solid looks along the direction of pressing "
                      "alone: split faces where they turn away from it, or save the skin as an open "
                      "shell")
    kept = (group == gain.argmax()) & (least >= -SIDEWAYS)
    rows = kept[number]
    words = f"one solid, of whose {len(tags)} faces {kept.sum()} are taken, the skin towards the " \
            f"{asked.on if asked.solid == 'part' else asked.other}, {area[rows].sum():.6g} of " \
            f"{area.sum():.6g} mm2"
    return sheet.part(rows), words, asked.solid == "part"
