# SPDX-License-Identifier: GPL-3.0-or-later
"""Formed plies of a run: directions, thickness and shear a triangle, of any state in results.h5
(layout: docs/users/results.md)."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from base.progress import told
from base.results_file import Broken, Results, read_results
from base.summary_file import read_summary
from plotting.reading import Trouble

from exchange.shell_mesh import ShellMesh, triangle_normals


WITH_YARNS = ("woven", "families")  # laws of fabrics; others are of sheets
OF_RUBBER = "stretch_1"             # a column that plies of rubber have, also while a run goes on


@dataclass
class FormedPly:
    """n nodes, m triangles, whose normals point up the stack."""
    name: str
    angle_deg: float         # from x to the ply's own direction before forming: the nominal angle
    x0: np.ndarray           # n x 3, mm, before forming
    x: np.ndarray            # n x 3, mm
    triangles: np.ndarray    # m x 3
    warp: np.ndarray         # m x 3, unit vectors, of the first family
    weft: np.ndarray         # m x 3, of the second; of one alone across it
    shear_deg: np.ndarray    # m, signed
    thickness: np.ndarray    # m, mm
    nominal_thickness: float  # mm, before forming
    yarn_angle_deg: float    # from warp to weft before forming
    families: tuple[str, ...] = ("warp", "weft")
    family_angles_deg: tuple[float, ...] = ()  # from x before forming; empty: of warp and weft
    further: tuple[np.ndarray, ...] = ()       # m x 3 each, of the families behind the second
    areal_weight: np.ndarray | None = None  # m, g/m2
    fibre_density: float | None = None      # kg/m3
    gap: np.ndarray | None = None           # m, mm, of the closed mould; NaN where there is none
    fibres: bool = True                     # False: a diaphragm or foil, whose directions are drawn on it

    @property
    def woven(self) -> bool:
        """Whether it was given as a weave, by warp and weft."""
        return self.families == ("warp", "weft")

    @property
    def yarns(self) -> list[np.ndarray]:
        return [self.warp, self.weft, *self.further][:len(self.families)]

    @property
    def angles_deg(self) -> tuple[float, ...]:
        return self.family_angles_deg or (self.angle_deg, self.angle_deg + self.yarn_angle_deg)

    def own_mesh(self) -> ShellMesh:
        corners = np.column_stack([self.triangles, np.full(len(self.triangles), -1)])
        return ShellMesh(self.x, corners, np.arange(1, len(corners) + 1),
                         np.arange(1, len(self.x) + 1), np.ones(len(corners), np.int64))


@dataclass
class FormedStack:
    folder: Path
    frame: int
    stroke_mm: float
    plies: list[FormedPly]  # from the bottom of the stack
    left_out: tuple[str, ...] = ()  # names of process aids

    def leave_out_aids(self) -> None:
        """The lay-up of the part is its fibres: sheets without them stay on the press. Raises Trouble if
        nothing is left."""
        self.left_out = tuple(ply.name for ply in self.plies if not ply.fibres)
        self.plies = [ply for ply in self.plies if ply.fibres]
        if not self.plies:
            raise Trouble(f"{self.folder} has no ply with fibres; --ply {self.left_out[0]} takes a sheet "
                          "without them")

    def left_out_words(self) -> str:
        """Empty if nothing is."""
        if not self.left_out:
            return ""
        names = ", ".join(self.left_out)
        return f"left out, without fibres: {names} (--ply takes in what it names)"


def read_formed(folder: Path, frame: int = -1, only: list[str] | None = None) -> FormedStack:
    """Frame -1 is the last. Raises Trouble if there is no such state or ply, or a number is not
    finite."""
    stack = read_results(folder, lambda results: stack_of(results, folder, frame, only or []))
    for name in sheets_of(folder):
        for ply in stack.plies:
            ply.fibres = ply.fibres and ply.name != name
    return stack


def sheets_of(folder: Path) -> list[str]:
    """Plies of fabrics without yarns, of a run that has ended: its summary has its case."""
    try:
        case = read_summary(folder, ()).get("case", {})
    except Trouble:  # of a run that goes on there is none
        return []
    plies = [key[len("ply."):-len(".fabric")] for key in case
             if key.startswith("ply.") and key.endswith(".fabric")]
    return [name for name in plies
            if case.get(f"fabrics.{case[f'ply.{name}.fabric']}.law", WITH_YARNS[0]) not in WITH_YARNS]


def stack_of(results: Results, folder: Path, frame: int, only: list[str]) -> FormedStack:
    number = results.frame_number(frame)
    there = results.names("plies")
    for name in only:
        if name not in there:
            raise Trouble(f"there is no ply {name}: it is one of {', '.join(there)}")
    plies = [ply_of(results, number, name)
             for name in told("reads", [name for name in there if not only or name in only])]
    if not plies:
        raise Trouble(f"{folder} has no ply")
    return FormedStack(folder, number, results.number(results.state(number), "stroke_mm"), plies)


def directions_of(results: Results, number: int, name: str, x: np.ndarray,
                  triangles: np.ndarray) -> list[np.ndarray]:
    """Unit vectors of the families; of one alone across its fibres, too."""
    families = results.families(name)
    if not families:
        raise Trouble(f"{results.folder}: ply {name} has no fibres, whose directions could be mapped")
    now, shape = results.in_state(number, "plies", name), (len(triangles), 3)
    found = [results.numbers(now, family, shape) for family in families]
    return found if len(found) > 1 else [*found, across(found[0], x, triangles)]


def across(yarns: np.ndarray, x: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    return np.cross(triangle_normals(x, triangles)[0], yarns)


def layers_of(ply: FormedPly) -> list[FormedPly]:
    """As the next program has it: a woven ply is one layer, of any other each family of yarns is one
    of an equal part of the thickness, the first below, which has no shear."""
    if ply.woven:
        return [ply]
    part = len(ply.families)
    return [replace(ply, name=ply.name if part == 1 else f"{ply.name}_{family}", angle_deg=angle,
                    warp=yarns, weft=across(yarns, ply.x, ply.triangles),
                    shear_deg=np.zeros(len(yarns)), thickness=ply.thickness / part,
                    areal_weight=None if ply.areal_weight is None else ply.areal_weight / part,
                    nominal_thickness=ply.nominal_thickness / part, yarn_angle_deg=90.0,
                    families=(family,), family_angles_deg=(angle,), further=())
            for family, yarns, angle in zip(ply.families, ply.yarns, ply.angles_deg)]


def ply_of(results: Results, number: int, name: str) -> FormedPly:
    fixed, now = results.group("plies", name), results.in_state(number, "plies", name)
    x0, triangles = results.body("plies", name)
    # a mesh file may walk round its triangles either way
    down = triangle_normals(x0, triangles)[0][:, 2] < 0
    triangles[down] = triangles[down][:, [0, 2, 1]]
    count = len(triangles)
    x = results.numbers(now, "x", (len(x0), 3))
    families = tuple(results.families(name))
    warp, weft, *further = directions_of(results, number, name, x, triangles)
    angles = results.attribute(fixed, "family_angles_deg", (len(families),))
    shear, thickness = (results.numbers(now, field, (count,))
                        for field in ("shear_angle_deg", "thickness_mm"))
    flat = results.numbers(results.in_state(0, "plies", name), "thickness_mm", (count,))
    between = float((angles[1] - angles[0]) % 180.0) if len(families) > 1 else 90.0
    if not (thickness > 0).all() or not (flat > 0).all():
        raise Broken(f"{now.name}/thickness_mm is not above 0 everywhere")
    fibres = OF_RUBBER not in (column.name for column in results.columns(name))
    return FormedPly(name, results.number(fixed, "angle_deg"), x0,
                     x, triangles, warp, weft, shear,
                     thickness, float(flat.mean()), between, families, tuple(map(float, angles)),
                     tuple(further), *through_thickness(results, number, name, thickness), fibres)


def through_thickness(results: Results, number: int, name: str, thickness: np.ndarray) -> tuple:
    """Areal weight, fibre density and gap of the mould, as FormedPly has them, of what the run knows."""
    known = {column.name: results.column(number, name, column, len(thickness))
             for column in results.columns(name)
             if column.name in ("areal_weight_g_m2", "fibre_volume", "stack_gap_mm")}
    weight, volume = known.get("areal_weight_g_m2"), known.get("fibre_volume")
    gap = known.get("stack_gap_mm")
    density = None
    if weight is not None and volume is not None:
        if not (weight > 0).all() or not (volume > 0).all():
            raise Broken(f"areal weight or fibre volume of ply {name} is not above 0 everywhere")
        density = float(np.median(weight / (volume * thickness)))
    return weight, density, None if gap is None else np.where(gap > 0, gap, np.nan)
