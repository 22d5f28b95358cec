# SPDX-License-Identifier: GPL-3.0-or-later
"""Formed plies of a run: directions, thickness and shear a triangle, of any state in results.h5
(layout: docs/users/results.md)."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from base.results_file import Broken, Results, read_results
from plotting.reading import Trouble

from exchange.shell_mesh import ShellMesh, triangle_normals


@dataclass
class FormedPly:
    """n nodes, m triangles, whose normals point up the stack."""
    name: str
    angle_deg: float         # from x to the warp before forming: the nominal angle
    x0: np.ndarray           # n x 3, mm, before forming
    x: np.ndarray            # n x 3, mm
    triangles: np.ndarray    # m x 3
    warp: np.ndarray         # m x 3, unit vectors
    weft: np.ndarray         # m x 3
    shear_deg: np.ndarray    # m, signed
    thickness: np.ndarray    # m, mm
    nominal_thickness: float  # mm, before forming
    yarn_angle_deg: float    # from warp to weft before forming

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


def read_formed(folder: Path, frame: int = -1, only: list[str] | None = None) -> FormedStack:
    """Frame -1 is the last. Raises Trouble if there is no such state or ply, or a number is not
    finite."""
    return read_results(folder, lambda results: stack_of(results, folder, frame, only or []))


def stack_of(results: Results, folder: Path, frame: int, only: list[str]) -> FormedStack:
    number = results.frame_number(frame)
    there = results.names("plies")
    for name in only:
        if name not in there:
            raise Trouble(f"there is no ply {name}: it is one of {', '.join(there)}")
    plies = [ply_of(results, number, name) for name in there if not only or name in only]
    if not plies:
        raise Trouble(f"{folder} has no ply")
    return FormedStack(folder, number, results.number(results.state(number), "stroke_mm"), plies)


def directions_of(results: Results, number: int, name: str, x: np.ndarray,
                  triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Unit vectors of the first two families; across the fibres where there is one alone."""
    families = results.families(name)
    if not families:
        raise Trouble(f"{results.folder}: ply {name} has no fibres, whose directions could be mapped")
    now, shape = results.in_state(number, "plies", name), (len(triangles), 3)
    one = results.numbers(now, families[0], shape)
    if len(families) > 1:
        return one, results.numbers(now, families[1], shape)
    return one, np.cross(triangle_normals(x, triangles)[0], one)


def ply_of(results: Results, number: int, name: str) -> FormedPly:
    fixed, now = results.group("plies", name), results.in_state(number, "plies", name)
    x0, triangles = results.body("plies", name)
    # a mesh file may walk round its triangles either way
    down = triangle_normals(x0, triangles)[0][:, 2] < 0
    triangles[down] = triangles[down][:, [0, 2, 1]]
    count = len(triangles)
    x = results.numbers(now, "x", (len(x0), 3))
    warp, weft = directions_of(results, number, name, x, triangles)
    shear, thickness = (results.numbers(now, field, (count,))
                        for field in ("shear_angle_deg", "thickness_mm"))
    flat = results.numbers(results.in_state(0, "plies", name), "thickness_mm", (count,))
    angle = np.degrees(np.arccos(np.clip((warp * weft).sum(axis=1), -1, 1)))
    if not (thickness > 0).all() or not (flat > 0).all():
        raise Broken(f"{now.name}/thickness_mm is not above 0 everywhere")
    return FormedPly(name, results.number(fixed, "angle_deg"), x0,
                     x, triangles, warp, weft, shear,
                     thickness, float(flat.mean()), float(np.median(angle + shear)))
