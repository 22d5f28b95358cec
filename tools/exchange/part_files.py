# SPDX-License-Identifier: GPL-3.0-or-later
"""Part meshes of other programs, by the ending of their files, and whether they can be right."""

from pathlib import Path

import numpy as np

from plotting.reading import Trouble

from exchange.deck_lines import FARTHEST
from exchange.formed import FormedPly
from exchange.read_bdf import read_bdf
from exchange.read_cdb import read_cdb
from exchange.read_inp import read_inp
from exchange.read_k import read_k
from exchange.shell_mesh import ShellMesh, element_normals

READERS = {".inp": read_inp, ".cdb": read_cdb, ".dat": read_bdf, ".bdf": read_bdf,
           ".nas": read_bdf, ".fem": read_bdf, ".k": read_k, ".key": read_k, ".dyn": read_k}
FAR_OFF = 30.0  # times larger or smaller than the plies: another unit of length


def read_part(path: Path) -> ShellMesh:
    """Shells of a part mesh. Raises Trouble."""
    if not path.is_file():
        raise Trouble(f"{path} is missing")
    ending = path.suffix.lower()
    if ending not in READERS and ending != ".vtu":
        raise Trouble(f"{path}: a part mesh ends in {', '.join([*READERS, '.vtu'])}")
    mesh = read_vtu(path) if ending == ".vtu" else READERS[ending](path)
    flat = np.flatnonzero(element_normals(mesh)[1] <= 0)
    if len(flat):
        raise Trouble(f"{path}: element {mesh.labels[flat[0]]} has no area: its corners lie on a "
                      "line; mend the mesh")
    return mesh


def read_vtu(path: Path) -> ShellMesh:
    """By meshio. Elements are numbered from 1 in the order of the file."""
    try:
        from meshio import vtu
    except ImportError as problem:
        raise Trouble(f"{path} is read by meshio: install python3-meshio") from problem
    try:
        read = vtu.read(path)
    except Exception as problem:  # of all kinds, on damaged files
        said = " ".join(str(problem).split()) or type(problem).__name__
        raise Trouble(f"{path} cannot be read as VTU: {said}") from problem
    corners, labels, at = [], [], 1
    left_out = {}
    shells = {"triangle": 3, "triangle6": 3, "quad": 4, "quad8": 4, "quad9": 4}
    for block in read.cells:
        if block.type in shells:
            ends = np.full((len(block.data), 4), -1, np.int64)
            ends[:, :shells[block.type]] = block.data[:, :shells[block.type]]
            corners.append(ends)
            labels.append(np.arange(at, at + len(ends)))
        else:
            left_out[block.type] = len(block.data)
        at += len(block.data)
    if not corners:
        raise Trouble(f"{path} has no triangles or quadrilaterals"
                      + (f" (it has {', '.join(left_out)})" if left_out else ""))
    if not np.abs(read.points).max() < FARTHEST:
        raise Trouble(f"{path}: a coordinate is no length: it is beyond {FARTHEST:g} mm, or not "
                      "finite")
    labels = np.concatenate(labels)
    used = np.vstack(corners)[:, :3]
    if used.min() < 0 or np.vstack(corners).max() >= len(read.points):
        raise Trouble(f"{path}: a cell has a point that is not in the file")
    points = np.column_stack([read.points, np.zeros((len(read.points), 3 - read.points.shape[1]))])
    mesh = ShellMesh(points, np.vstack(corners), labels, np.arange(1, len(points) + 1),
                     np.ones(len(labels), np.int64), path)
    mesh.left_out.update(left_out)
    return mesh


def placed(mesh: ShellMesh, scale: float, turn: list[float], move: list[float]) -> ShellMesh:
    """Scales, turns by degrees about x, then y, then z, and moves by mm the nodes of a mesh."""
    x = scale * mesh.nodes
    for axis, angle in enumerate(np.radians(turn)):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        turned = x.copy()
        turned[:, i] = np.cos(angle) * x[:, i] - np.sin(angle) * x[:, j]
        turned[:, j] = np.sin(angle) * x[:, i] + np.cos(angle) * x[:, j]
        x = turned
    mesh.nodes = x + np.asarray(move)
    return mesh


def check_size(mesh: ShellMesh, plies: list[FormedPly]) -> None:
    """Raises Trouble for a mesh in metres, or in other units that are not mm."""
    stack = float(np.linalg.norm(np.ptp(np.vstack([ply.x for ply in plies]), axis=0)))
    part = mesh.size()
    if 1 / FAR_OFF < part / stack < FAR_OFF:
        return
    ratio = stack / part
    known = {1000.0: "metres", 10.0: "centimetres", 25.4: "inches", 0.001: "micrometres"}
    near = [factor for factor in known if 1 / 3 < ratio / factor < 3]
    guess = (f"it may be in {known[near[0]]}: give --scale {near[0]:g}" if near
             else "give --scale with the mm of its unit")
    raise Trouble(f"{mesh.path}: the part measures {part:.4g} along its diagonal, the plies "
                  f"{stack:.4g} mm: lengths are mm here; {guess}")
