# SPDX-License-Identifier: GPL-3.0-or-later
"""Formed plies on a shell mesh, as files for other programs take them."""

import re
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from base.ending import one_line
from base.progress import told
from plotting.reading import Trouble

from exchange.angles import Reference, angles_to, reference_of, warnings_of, words_of, wrapped
from exchange.formed import FormedPly
from exchange.mapping import (MappedPly, SmoothPly, map_ply, on_own_mesh, sides_of)
from exchange.shell_mesh import ShellMesh, element_normals, split, triangle_normals


BACK_CUTS = 3  # along a side of a ply's triangles


@dataclass
class Layup:
    """Plies from the bottom of the stack."""
    mesh: ShellMesh
    plies: list[MappedPly]
    reference: str | tuple[float, ...]
    source: str  # of the state, in words
    own: bool    # the mesh is the ply's own, and goes into the files too
    notes: tuple[str, ...] = ()  # of the part mesh: what of it was not used
    remarks: list[str] = field(default_factory=list)  # what formats have to tell of their files

    @cached_property
    def normals(self) -> np.ndarray:
        return element_normals(self.mesh)[0]

    @cached_property
    def base(self) -> Reference:
        return reference_of(self.mesh, self.reference, self.normals)

    @cached_property
    def warnings(self) -> list[str]:
        """Where the reference is not what its words say."""
        return warnings_of(self.mesh, self.base, self.normals)

    def angles(self, ply: MappedPly, reference=None) -> tuple[np.ndarray, np.ndarray]:
        """Of warp and weft (m each, degrees) to the elements' reference, that of the lay-up unless
        another is given."""
        base = (reference_of(self.mesh, reference, self.normals) if reference else
                self.base).directions
        return angles_to(base, ply.warp, self.normals), angles_to(base, ply.weft, self.normals)

    def corrections(self, ply: MappedPly) -> tuple[np.ndarray, np.ndarray]:
        """What draping adds to the angle of the warp, and to that of the direction across it, over
        those of the flat ply: its nominal angle, and 90 degrees more. In (-90, 90]."""
        warp, weft = self.angles(ply)
        return (wrapped(warp - ply.nominal_angle_deg),
                wrapped(weft - ply.nominal_angle_deg - 90.0))

    def thinning(self, ply: MappedPly) -> np.ndarray:
        return ply.thickness / ply.nominal_thickness

    def sequences(self) -> dict[tuple[int, ...], np.ndarray]:
        """Plies on an element along its normal, and the rows of the elements that have them. Where
        the normal points down the stack, the last ply comes first."""
        count = len(self.mesh.corners)
        covered = np.array([ply.covered() for ply in self.plies]).reshape(-1, count)
        down = np.any([ply.side < 0 for ply in self.plies], axis=0)
        keys = np.vstack([covered, down[None]]).T
        kinds, back = np.unique(keys, axis=0, return_inverse=True)
        found = {}
        for k, kind in enumerate(kinds):
            plies = tuple(int(ply) for ply in np.flatnonzero(kind[:-1]))
            if plies:
                key = plies[::-1] if kind[-1] else plies
                found.setdefault(key, []).append(np.flatnonzero(back.ravel() == k))
        return {key: np.sort(np.concatenate(rows)) for key, rows in found.items()}

    def reversed_count(self) -> int:
        """Elements whose normal points down the stack."""
        return int(np.any([ply.side < 0 for ply in self.plies], axis=0).sum())

    def expect_room(self, what: str) -> None:
        """Raises Trouble unless all numbers of nodes and elements have eight digits at most."""
        most = max(int(self.mesh.labels.max()), int(self.mesh.node_labels.max()))
        if most > 99999999:
            raise Trouble(f"{what} has room for 99999999 as the largest number of a node or element: "
                          f"the part mesh has {most}; number it anew")

    def head(self, more: list[str] = (), reference: str = "") -> list[str]:
        """What each file says first, in lines that cannot end, whatever a folder is called. `reference`: of a format with one of its own."""
        words = reference or words_of(self.reference, self.mesh)
        if not reference and len(self.base.replaced):
            words += f"; on {len(self.base.replaced)} elements {self.base.other}, see below"
        lines = ["formed plies of plyform, " + self.source,
                 "lengths in mm, angles in degrees",
                 f"angles: from the element's reference ({words}), about its normal (right-hand rule "
                 "along its corners)",
                 *(self.warnings if not reference else []),
                 *self.notes,
                 "plies are listed along the element's normal, "
                 f"{self.reversed_count()} elements have normals that point down the stack",
                 *more]
        return [one_line(line) for line in lines]


def own_layup(ply: FormedPly, reference, source: str) -> Layup:
    return Layup(ply.own_mesh(), [on_own_mesh(ply)], reference, source, True)


def as_two(layup: Layup) -> Layup:
    """Each woven ply as two unidirectional ones of half its thickness, along warp and along weft;
    that of the warp below. Layers of one family stay as they are."""
    normals = element_normals(layup.mesh)[0]
    plies = []
    for ply in layup.plies:
        if not ply.woven:
            plies.append(ply)
            continue
        up = normals * ply.side[:, None]
        for name, yarn, angle in ((ply.name + "_warp", ply.warp, 0.0),
                                  (ply.name + "_weft", ply.weft, ply.yarn_angle_deg)):
            plies.append(replace(ply, name=name, warp=yarn, weft=np.cross(up, yarn),
                                 thickness=0.5 * ply.thickness,
                                 nominal_thickness=0.5 * ply.nominal_thickness,
                                 areal_weight=None if ply.areal_weight is None else 0.5 * ply.areal_weight,
                                 nominal_angle_deg=ply.nominal_angle_deg + angle, woven=False))
    return replace(layup, plies=plies)


@dataclass
class ThereAndBack:
    """Error of mapping onto a mesh and back onto the ply, by area, degrees and mm."""
    angle_rms: float
    angle_largest: float
    thickness_rms: float
    smoothing_rms: float  # between the run's triangles and the smoothed field


def there_and_back(smooth: SmoothPly, mapped: MappedPly, mesh: ShellMesh,
                   limit: float) -> ThereAndBack | None:
    """None where no element is covered."""
    triangles, owner = split(mesh)
    keep = mapped.covered()[owner]
    if not keep.any():
        return None
    triangles, owner = triangles[keep], owner[keep]
    down = mapped.side[owner] < 0
    triangles[down] = triangles[down][:, [0, 2, 1]]
    used, rows = np.unique(triangles, return_inverse=True)
    ply = smooth.ply
    other = replace(ply, x=mesh.nodes[used], triangles=rows.reshape(triangles.shape),
                    warp=mapped.warp[owner], weft=mapped.weft[owner],
                    thickness=mapped.thickness[owner], areal_weight=None, gap=None)
    own = ply.own_mesh()
    up = np.ones(len(ply.triangles), int)
    # a fine part mesh would have the back way take longer than the way there
    back = map_ply(SmoothPly(other), own, up, limit, most_cuts=BACK_CUTS)
    direct = map_ply(smooth, own, up, limit, most_cuts=BACK_CUTS)
    there = back.covered() & direct.covered()
    if not there.any():
        return None
    area = triangle_normals(ply.x, ply.triangles)[1]

    def rms(values, rows):
        return float(np.sqrt((values**2 * area)[rows].sum() / area[rows].sum()))
    error = np.concatenate([angle_between(back.warp, direct.warp)[None],
                            angle_between(back.weft, direct.weft)[None]]).max(axis=0)
    raw = angle_between(direct.warp, ply.warp)
    return ThereAndBack(rms(error, there), float(error[there].max()),
                        rms(back.thickness - direct.thickness, there),
                        rms(raw, direct.covered()))


def angle_between(one: np.ndarray, two: np.ndarray) -> np.ndarray:
    """Degrees; exact for small ones."""
    return np.degrees(np.arctan2(np.linalg.norm(np.cross(one, two), axis=1), (one * two).sum(axis=1)))


def map_all(plies: list[FormedPly], mesh: ShellMesh, limit: float, least_share: float,
            trust_normals: bool) -> tuple[list[MappedPly], list[SmoothPly]]:
    smooth = [SmoothPly(ply) for ply in plies]
    side = sides_of(mesh, smooth, limit, trust_normals)
    return [map_ply(one, mesh, side, limit, least_share)
            for one, _ in zip(smooth, told("maps", plies))], smooth


def safe_names(names: list[str]) -> list[str]:
    """Names that begin with a letter or _, of letters, digits and _ only, at most 60, each once."""
    made = []
    for name in names:
        safe = re.sub(r"[^A-Za-z0-9_]", "_", name)
        safe = ("_" + safe if not re.match(r"[A-Za-z_]", safe) else safe)[:60]
        number, tried = 2, safe
        while tried.upper() in (one.upper() for one in made):
            tried, number = f"{safe}_{number}", number + 1
        made.append(tried)
    return made
