# SPDX-License-Identifier: GPL-3.0-or-later
"""Formed plies of a run: directions, thickness and shear a triangle, of any state in results.h5
(layout: docs/users/results.md)."""

from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from plotting.reading import Trouble, file_in, names

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
    path = file_in(folder, "results.h5")
    try:
        with h5py.File(path, "r") as file:
            return stack_of(file, folder, frame, only or [])
    except (OSError, KeyError, ValueError) as problem:
        raise Trouble(f"{path} cannot be read as results of plyform: {problem}") from problem


def frame_number(file: h5py.File, folder: Path, frame: int) -> int:
    count = len(file["time_s"])
    number = frame if frame >= 0 else count + frame
    if not 0 <= number < count:
        raise Trouble(f"{folder} has no frame {frame}: it has frames 0 to {count - 1}")
    return number


def stack_of(file: h5py.File, folder: Path, frame: int, only: list[str]) -> FormedStack:
    number = frame_number(file, folder, frame)
    there = names(file, "plies")
    for name in only:
        if name not in there:
            raise Trouble(f"there is no ply {name}: it is one of {', '.join(there)}")
    now = file[f"frames/{number:06}"]
    plies = [ply_of(name, file["plies"][name], file["frames/000000/plies"][name],
                    now["plies"][name])
             for name in there if not only or name in only]
    for ply in plies:
        for what, values in (("position", ply.x), ("warp direction", ply.warp),
                             ("weft direction", ply.weft), ("thickness", ply.thickness)):
            if not np.isfinite(values).all():
                raise Trouble(f"{folder}: a {what} of ply {ply.name} is not finite: the run is "
                              "broken")
    return FormedStack(folder, number, float(now.attrs["stroke_mm"]), plies)


def ply_of(name: str, fixed: h5py.Group, first: h5py.Group, now: h5py.Group) -> FormedPly:
    x0, triangles = fixed["x0"][:], fixed["triangles"][:].astype(np.int64)
    # a mesh file may walk round its triangles either way
    down = triangle_normals(x0, triangles)[0][:, 2] < 0
    triangles[down] = triangles[down][:, [0, 2, 1]]
    warp, weft, shear = now["warp"][:], now["weft"][:], now["shear_angle_deg"][:]
    angle = np.degrees(np.arccos(np.clip((warp * weft).sum(axis=1), -1, 1)))
    return FormedPly(name, float(fixed.attrs["angle_deg"]), x0, now["x"][:], triangles, warp, weft,
                     shear, now["thickness_mm"][:], float(first["thickness_mm"][:].mean()),
                     float(np.median(angle + shear)))
