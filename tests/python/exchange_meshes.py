# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes for the tests of map, pattern and export, with their exact fields, and the files that other
programs would write of them."""

import sys
from pathlib import Path

import numpy as np

TOOLS = Path(sys.argv[1]).resolve()
sys.path.insert(0, str(TOOLS))

from exchange.formed import FormedPly  # noqa: E402
from exchange.shell_mesh import ShellMesh, unit  # noqa: E402

RADIUS = 75.0  # mm


def grid(count):
    """Square of count x count cells, -1 to 1: nodes (n x 2) and quadrilaterals (m x 4)."""
    line = np.linspace(-1.0, 1.0, count + 1)
    u, v = np.meshgrid(line, line, indexing="ij")
    first = np.arange(count * (count + 1)).reshape(count, count + 1)[:, :count].ravel()
    return (np.column_stack([u.ravel(), v.ravel()]),
            np.column_stack([first, first + count + 1, first + count + 2, first + 1]))


def shell_mesh(nodes, quads, triangles=False):
    corners = np.asarray(quads)
    if triangles:
        three = np.vstack([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
        corners = np.column_stack([three, np.full(len(three), -1)])
    return ShellMesh(np.asarray(nodes, float), corners, np.arange(101, 101 + len(corners)),
                     np.arange(11, 11 + len(nodes)), np.full(len(corners), 7))


def on_dome(flat, radius=RADIUS):
    """Points of a disc in mm, wrapped round a sphere whose top is at the origin: distances from the
    middle stay, circles shrink. The derivatives along x and y too (each n x 3)."""
    distance = np.maximum(np.linalg.norm(flat, axis=1), 1e-9)[:, None]
    radial = np.column_stack([flat / distance, np.zeros(len(flat))])
    around = np.cross((0.0, 0.0, 1.0), radial)
    angle = distance / radius
    down = np.array((0.0, 0.0, -1.0))
    x = radius * (np.sin(angle) * radial + (1 - np.cos(angle)) * down)
    along = np.cos(angle) * radial + np.sin(angle) * down
    shrunk = np.sin(angle) / angle
    by = [along * radial[:, [k]] + shrunk * around * around[:, [k]] for k in (0, 1)]
    return x, *by


def disc(size, triangles, radius=RADIUS, reach=70.0):
    """Mesh of some `size` mm on the dome, to `reach` degrees from its top along x and y, and a fifth
    further between them."""
    count = int(round(2 * radius * np.radians(reach) / size))
    (u, v), quads = grid(count)[0].T, grid(count)[1]
    x, y = u * np.sqrt(1 - 0.3 * v * v), v * np.sqrt(1 - 0.3 * u * u)
    flat = radius * np.radians(reach) * np.column_stack([x, y])
    return shell_mesh(on_dome(flat, radius)[0], quads, triangles)


def flat_of(points, radius=RADIUS):
    """Where points near the dome lie on the disc (k x 2, mm)."""
    middle = np.array((0.0, 0.0, -radius))
    out = unit(points - middle)
    angle = np.arccos(np.clip(out[:, 2], -1, 1))[:, None]
    return radius * angle * unit(out[:, :2])


def yarns_at(flat, angle_deg):
    """Exact unit directions of warp and weft on the dome, of yarns that were straight before."""
    _, by_x, by_y = on_dome(flat)
    c, s = np.cos(np.radians(angle_deg)), np.sin(np.radians(angle_deg))
    return unit(c * by_x + s * by_y), unit(c * by_y - s * by_x)


def dome_ply(angle_deg, size=6.8, count=40):
    """A ply of triangles with the exact directions at their middles."""
    flat, quads = grid(count)
    flat = 0.5 * size * count * flat
    even = (np.add(*np.divmod(np.arange(len(quads)), count)) % 2 == 0)[:, None]
    triangles = np.vstack([np.where(even, quads[:, [0, 1, 2]], quads[:, [0, 1, 3]]),
                           np.where(even, quads[:, [0, 2, 3]], quads[:, [1, 2, 3]])])
    x = on_dome(flat)[0]
    warp, weft = yarns_at(flat[triangles].mean(axis=1), angle_deg)
    between = np.degrees(np.arccos((warp * weft).sum(axis=1)))
    x0 = np.column_stack([flat, np.zeros(len(flat))])
    thickness = 0.6 / np.sin(np.radians(between))
    return FormedPly("dome", angle_deg, x0, x, triangles, warp, weft, 90.0 - between, thickness,
                     0.6, 90.0)


def ends_of(mesh, row):
    return [int(mesh.node_labels[k]) for k in mesh.corners[row] if k >= 0]


def abaqus_text(mesh, three="S3", four="S4R"):
    lines = ["*HEADING", "** a part", "*NODE"]
    lines += [f"{n}, {x:.9g}, {y:.9g}, {z:.9g}"
              for n, (x, y, z) in zip(mesh.node_labels, mesh.nodes)]
    for kind, some in ((three, mesh.triangular()), (four, ~mesh.triangular())):
        if some.any():
            lines.append(f"*Element, type={kind}, elset=SKIN")
            lines += [f"{mesh.labels[k]}, " + ", ".join(map(str, ends_of(mesh, k)))
                      for k in np.flatnonzero(some)]
    return "\n".join(lines) + "\n"


def nastran_text(mesh):
    """Grid points in large fields, elements in small ones."""
    lines = ["SOL 101", "CEND", "BEGIN BULK"]
    for n, (x, y, z) in zip(mesh.node_labels, mesh.nodes):
        lines += [f"GRID*   {n:16d}{'':16}{x:16.9E}{y:16.9E}*", f"*       {z:16.9E}"]
    for k, label in enumerate(mesh.labels):
        ends = ends_of(mesh, k)
        lines.append(("CTRIA3  " if len(ends) == 3 else "CQUAD4  ") + f"{label:8d}{mesh.parts[k]:8d}"
                     + "".join(f"{end:8d}" for end in ends))
    return "\n".join([*lines, "ENDDATA"]) + "\n"


def lsdyna_text(mesh):
    lines = ["*KEYWORD", "*NODE"]
    lines += [f"{n:8d}{x:16.8f}{y:16.8f}{z:16.8f}"
              for n, (x, y, z) in zip(mesh.node_labels, mesh.nodes)]
    lines.append("*ELEMENT_SHELL")
    for k, label in enumerate(mesh.labels):
        ends = ends_of(mesh, k)
        ends += ends[-1:] * (4 - len(ends))
        lines.append("".join(f"{value:8d}" for value in (label, mesh.parts[k], *ends)))
    return "\n".join([*lines, "*END"]) + "\n"


def ansys_text(mesh):
    lines = ["/PREP7", "ET,1,181", f"NBLOCK,6,SOLID,{len(mesh.nodes)},{len(mesh.nodes)}",
             "(3i9,6e21.13e3)"]
    lines += [f"{n:9d}{0:9d}{0:9d}{x:21.13E}{y:21.13E}{z:21.13E}"
              for n, (x, y, z) in zip(mesh.node_labels, mesh.nodes)]
    lines += ["N,R5.3,LOC,       -1,", f"EBLOCK,19,SOLID,{len(mesh.labels)},{len(mesh.labels)}",
              "(19i9)"]
    for k, label in enumerate(mesh.labels):
        ends = ends_of(mesh, k)
        ends += ends[-1:] * (4 - len(ends))
        lines.append("".join(f"{value:9d}" for value in
                             (1, 1, 1, mesh.parts[k], 0, 0, 0, 0, 4, 0, label, *ends)))
    return "\n".join([*lines, "       -1", "FINISH"]) + "\n"


TEXTS = {".inp": abaqus_text, ".bdf": nastran_text, ".k": lsdyna_text, ".cdb": ansys_text}
