# SPDX-License-Identifier: GPL-3.0-or-later
"""Part meshes of other programs, by the ending of their files, and whether they can be right."""

import re
from pathlib import Path

import numpy as np

from base.files import TABLE, check_file
from plotting.reading import Trouble

from exchange.deck_mesh import Deck
from exchange.formed import FormedPly
from exchange.read_bdf import read_bdf
from exchange.read_cdb import read_cdb
from exchange.read_inp import read_inp
from exchange.read_k import read_k
from exchange.shell_mesh import ShellMesh, crossed, element_normals

READERS = {".inp": read_inp, ".cdb": read_cdb, ".dat": read_bdf, ".bdf": read_bdf,
           ".nas": read_bdf, ".fem": read_bdf, ".k": read_k, ".key": read_k, ".dyn": read_k}
LEAST_AREA = 1e-9  # of the square of the longest side: what rounding makes of none
FAR_OFF = 30.0  # times larger or smaller than the plies: another unit of length


def read_part(path: Path) -> ShellMesh:
    """Shells of a part mesh. Raises Trouble."""
    ending = path.suffix.lower()
    if ending not in READERS and ending != ".vtu":
        raise Trouble(f"{path}: a part mesh ends in {', '.join([*READERS, '.vtu'])}")
    check_file(path, TABLE)
    mesh = read_vtu(path) if ending == ".vtu" else READERS[ending](path)
    expect_areas(mesh)
    return mesh


def expect_areas(mesh: ShellMesh) -> None:
    """Raises Trouble unless each element has an area and sides that do not cross."""
    x = mesh.nodes[mesh.corners]
    x[mesh.triangular(), 3] = x[mesh.triangular(), 0]
    longest = (np.diff(x, axis=1, append=x[:, :1]) ** 2).sum(axis=2).max(axis=1)
    for rows, words in (
            (crossed(mesh), "has sides that cross: its corners are not in order"),
            (np.flatnonzero(~(element_normals(mesh)[1] > LEAST_AREA * longest)),
             "has no area: its corners lie on a line")):
        if len(rows):
            others = f" (and {len(rows) - 1} more elements)" if len(rows) > 1 else ""
            raise Trouble(f"{mesh.path}: element {mesh.labels[rows[0]]} {words}; mend the "
                          f"mesh{others}")


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
    return mesh_of(read, path)


CELLS = {"triangle": 3, "triangle6": 3, "triangle7": 3, "quad": 4, "quad8": 4, "quad9": 4, "pixel": 4,
         "polygon3": 3, "polygon4": 4}
SURFACES = re.compile(r"polygon|VTK_\w*(TRIANGLE|QUAD|POLYGON)|triangle|quad", re.IGNORECASE)


def mesh_of(read, path: Path) -> ShellMesh:
    """Of what meshio has read."""
    found, at, left_out = [], 1, {}
    for block in read.cells:
        data, corners = np.asarray(block.data), CELLS.get(block.type)
        if corners:
            data = data[:, [0, 1, 3, 2]] if block.type == "pixel" else data
            ends = np.full((len(data), 8), -1, np.int64)
            ends[:, :corners] = data[:, :corners]
            middles = min(data.shape[1], 2 * corners) - corners
            ends[:, 4:4 + middles] = data[:, corners:corners + middles]
            found.append((np.arange(at, at + len(ends)), ends))
        elif SURFACES.match(block.type):
            raise Trouble(f"{path} has cells of the type {block.type}, which are not read: write it "
                          "with triangles and quadrilaterals")
        else:
            left_out[block.type] = left_out.get(block.type, 0) + len(data)
        at += len(data)
    if not found:
        raise Trouble(f"{path} has no triangles or quadrilaterals"
                      + (f" (it has {', '.join(left_out)})" if left_out else ""))
    labels, ends = (np.concatenate(some) for some in zip(*found))
    if ends[:, :3].min() < 0 or ends.max() >= len(read.points):
        raise Trouble(f"{path}: a cell has a point that is not in the file")
    points = np.column_stack([read.points, np.zeros((len(read.points), 3 - read.points.shape[1]))])
    deck = Deck(path)
    deck.add_nodes(path, np.zeros(len(points)), np.arange(1, len(points) + 1), points)
    deck.add_shells(path, np.zeros(len(labels)), labels, np.ones(len(labels)), ends + 1)
    deck.left_out.update(left_out)
    return deck.mesh()


def placed(mesh: ShellMesh, scale: float, turn: list[float], move: list[float]) -> ShellMesh:
    """Scales, turns by degrees about x, then y, then z, and moves by mm the nodes of a mesh."""
    x = turned_by(scale * mesh.nodes, turn)
    mesh.nodes = x + np.asarray(move)
    if mesh.axes is not None:
        mesh.axes = turned_by(mesh.axes, turn)
    return mesh


def turned_by(x: np.ndarray, turn: list[float]) -> np.ndarray:
    """By degrees about x, then y, then z."""
    for axis, angle in enumerate(np.radians(turn)):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        turned = x.copy()
        turned[:, i] = np.cos(angle) * x[:, i] - np.sin(angle) * x[:, j]
        turned[:, j] = np.sin(angle) * x[:, i] + np.cos(angle) * x[:, j]
        x = turned
    return x


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
