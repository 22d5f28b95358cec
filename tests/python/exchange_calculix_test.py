# SPDX-License-Identifier: GPL-3.0-or-later
"""Lay-ups written for CalculiX, solved by ccx: strips pulled along x against laminate theory.

    exchange_calculix_test.py TOOLS

A ply off the axis is stretched and sheared as its compliances say, which no other angle gives; a pair at
0 and 90 degrees bends to the side that the order of its layers says; plates of elements of unequal
thickness, turned round and curved are solved too. Leaves with 77 when numpy, scipy, h5py, meshio or ccx
is missing.
"""

import shutil
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

try:
    import meshio
    import numpy as np

    from exchange_meshes import abaqus_text, disc, dome_ply, grid, shell_mesh
    from exchange.formed import FormedPly
    from exchange.layup import Layup, map_all
    from exchange.part_files import read_part
    from exchange.write_calculix import calculix_files
except ImportError as error:
    print("SKIPPED:", error)
    sys.exit(77)
CCX = shutil.which("ccx")
if not CCX:
    print("SKIPPED: ccx is missing: install calculix-ccx")
    sys.exit(77)

LENGTH, WIDTH, THICK = 40.0, 20.0, 0.5  # mm
E1, E2, G12, NU = 100e3, 8e3, 4e3, 0.3  # MPa
LOAD = 10.0                             # N/mm of the end's width
MATERIAL = ("*MATERIAL, NAME=MATERIAL_{}\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n"
            f"{E1}, {E2}, {E2}, {NU}, {NU}, 0.4, {G12}, {G12},\n3000., 20.\n")


def flat_ply(name, angle_deg, height, uneven=0.0):
    """Larger than the strip, triangles with yarns at an angle; thickness scattered by a part of it."""
    flat, quads = grid(12)
    x = np.column_stack([flat * (0.75 * LENGTH, 0.75 * LENGTH) + (0.5 * LENGTH, 0.5 * WIDTH),
                         np.full(len(flat), height)])
    triangles = np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    c, s = np.cos(np.radians(angle_deg)), np.sin(np.radians(angle_deg))
    ones = np.ones((len(triangles), 1))
    thick = THICK * (1 + uneven * np.random.default_rng(2).uniform(-1, 1, len(triangles)))
    return FormedPly(name, angle_deg, x, x, triangles, ones * (c, s, 0.0), ones * (-s, c, 0.0),
                     np.zeros(len(triangles)), thick, THICK, 90.0)


def strip(count, triangles):
    flat, quads = grid(count)
    nodes = np.column_stack([(flat[:, 0] + 1) * LENGTH / 2, (flat[:, 1] + 1) * WIDTH / 2,
                             np.zeros(len(flat))])
    return shell_mesh(nodes, quads, triangles)


def solved(folder, layup):
    """Places and displacements of the mesh's nodes: x held at x = 0, pulled at the other end."""
    (text,) = calculix_files(layup).values()
    path = folder / "layup_calculix.inp"
    path.write_text(text, encoding="utf-8")
    mesh = read_part(path)  # a reader of ours, and one that is not:
    alike = folder / "meshio.inp"  # which knows the six nodes by Abaqus' name for them
    alike.write_text(text.replace("TYPE=S6", "TYPE=STRI65"), encoding="utf-8")
    other = meshio.read(alike)
    assert np.allclose(other.points, mesh.nodes)
    assert {block.type for block in other.cells} <= {"triangle6", "quad8"}
    assert mesh.middles is not None
    x, labels = mesh.nodes, mesh.node_labels
    held, corner = labels[x[:, 0] < 1e-6], labels[np.linalg.norm(x, axis=1) < 1e-6]
    beside = labels[(x[:, 0] < 1e-6) & (x[:, 1] > WIDTH - 1e-6)]
    lines = [*(MATERIAL.format(ply.name) for ply in layup.plies), "*BOUNDARY",
             *(f"{n}, 1, 1" for n in held), f"{corner[0]}, 2, 3", f"{beside[0]}, 3, 3",
             f"{labels[np.argmin(np.linalg.norm(x - (LENGTH, 0, 0), axis=1))]}, 3, 3",
             "*STEP", "*STATIC", "*CLOAD",
             *(f"{n}, 1, {force:.9g}" for n, force in end_forces(mesh)),
             "*NSET, NSET=PRINTED", *map(str, labels), "*NODE PRINT, NSET=PRINTED", "U", "*END STEP"]
    (folder / "model.inp").write_text("*INCLUDE, INPUT=layup_calculix.inp\n" + "\n".join(lines) + "\n",
                                      encoding="utf-8")
    done = subprocess.run([CCX, "-i", "model"], cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0 and "*ERROR" not in done.stdout, done.stdout[-2000:]
    rows = [line.split() for line in (folder / "model.dat").read_text(encoding="utf-8").splitlines()]
    moved = {int(row[0]): [float(v) for v in row[1:]] for row in rows
             if len(row) == 4 and row[0].isdigit()}
    return x, np.array([moved[n] for n in labels])


def end_forces(mesh):
    """Of an even load on the edge x = LENGTH: a sixth, two thirds, a sixth on the nodes of a side."""
    forces = {}
    for row in range(len(mesh.labels)):
        count = 3 if mesh.corners[row, 3] < 0 else 4
        for k in range(count):
            side = [mesh.corners[row, k], mesh.middles[row, k], mesh.corners[row, (k + 1) % count]]
            if (mesh.nodes[side, 0] > LENGTH - 1e-6).all():
                long = np.ptp(mesh.nodes[side, 1])
                for n, share in zip(side, (1 / 6, 2 / 3, 1 / 6)):
                    label = int(mesh.node_labels[n])
                    forces[label] = forces.get(label, 0.0) + share * LOAD * long
    return forces.items()


def stiffness(angle_deg):
    """Plane stress, in x and y, of a ply at an angle: [xx, yy, xy]."""
    q = np.array([[E1, NU * E2, 0], [NU * E2, E2, 0], [0, 0, 0]]) / (1 - NU**2 * E2 / E1)
    q[2, 2] = G12
    c, s = np.cos(np.radians(angle_deg)), np.sin(np.radians(angle_deg))
    turn = np.array([[c * c, s * s, c * s], [s * s, c * c, -c * s], [-2 * c * s, 2 * c * s, c * c - s * s]])
    return turn.T @ q @ turn


def laminate(angles):
    """Strains and curvatures of the middle plane under LOAD along x: those of laminate theory."""
    z = THICK * (np.arange(len(angles) + 1) - 0.5 * len(angles))
    abd = np.zeros((6, 6))
    for angle, low, high in zip(angles, z, z[1:]):
        q = stiffness(angle)
        for rows, columns, power in ((0, 0, 1), (0, 3, 2), (3, 0, 2), (3, 3, 3)):
            abd[rows:rows + 3, columns:columns + 3] += q * (high**power - low**power) / power
    return np.linalg.solve(abd, [LOAD, 0, 0, 0, 0, 0])


def mapped(folder, angles, triangles, down=False, uneven=0.0, count=6):
    """Plies from the bottom, mapped onto a strip that was written and read; with `down` its normals
    point down the stack."""
    mesh = strip(count, triangles)
    if down:
        mesh.corners = (mesh.corners[:, [0, 2, 1, 3]] if triangles else mesh.corners[:, [0, 3, 2, 1]])
    (folder / "part.inp").write_text(abaqus_text(mesh, "S3", "S4"), encoding="utf-8")
    plies = [flat_ply(f"p{k}", angle, 0.1 * k, uneven) for k, angle in enumerate(angles)]
    part = read_part(folder / "part.inp")
    layers, _ = map_all(plies, part, 5.0, 0.5, False)
    assert all(layer.covered().all() for layer in layers)
    return Layup(part, layers, "x", "a strip", False)


def check_off_axis(folder):
    """Stretch and shear of one ply off the axis: exact, as the stress is even. The reference of the
    angles does not matter: axes are written."""
    for angle in (0.0, 30.0, -55.0, 90.0):
        wanted = laminate([angle])
        for triangles, down in ((False, False), (True, False), (False, True)):
            layup = replace(mapped(folder, [angle], triangles, down), reference="side")
            x, u = solved(folder, layup)
            strain = np.linalg.lstsq(np.column_stack([x[:, :2], np.ones(len(x))]), u[:, :2],
                                     rcond=None)[0]
            found = (strain[0, 0], strain[1, 1], strain[1, 0] + strain[0, 1])
            print(f"{angle:g} deg, {'S6' if triangles else 'S8R'}{', normals down' if down else ''}: "
                  f"strains {found}, laminate theory {wanted[:3]}")
            assert np.allclose(found, wanted[:3], atol=1e-3 * wanted[0]), (found, wanted)


def check_order(folder):
    """A ply at 0 degrees below one at 90 bends up or down as laminate theory says, also with normals that
    point down the stack, where the file has the layers in reverse."""
    for angles in ([0.0, 90.0], [90.0, 0.0]):
        wanted = laminate(angles)
        for triangles, down in ((False, False), (True, False), (False, True)):
            x, u = solved(folder, mapped(folder, angles, triangles, down))
            terms = np.column_stack([np.ones(len(x)), x[:, :2], x[:, :2] ** 2, x[:, 0] * x[:, 1]])
            fit = np.linalg.lstsq(terms, u[:, 2], rcond=None)[0]
            # z-displacement is -0.5 times curvature times x squared
            bend, stretch = -2 * fit[3], np.polyfit(x[:, 0], u[:, 0], 1)[0]
            print(f"{angles}, {'S6' if triangles else 'S8R'}{', normals down' if down else ''}: curvature "
                  f"{bend:.6g}, laminate theory {wanted[3]:.6g} 1/mm; stretch {stretch:.6g}, "
                  f"{wanted[0]:.6g}")
            assert abs(bend / wanted[3] - 1) < 0.05 and abs(stretch / wanted[0] - 1) < 0.03


def check_uneven(folder):
    """Elements that differ in thickness, of many layers: ccx has room for its nodes, and the plate is as
    stiff as the mean one."""
    angles = [0.0, 90.0, 45.0, -45.0, 45.0, 90.0, 0.0]
    even = np.mean(solved(folder, mapped(folder, angles, False))[1][:, 0])
    for triangles in (False, True):
        layup = mapped(folder, angles, triangles, uneven=0.02)
        assert np.ptp(layup.plies[0].thickness) > 0.001
        found = np.mean(solved(folder, layup)[1][:, 0])
        print(f"uneven, {'S6' if triangles else 'S8R'}: mean stretch over the even one "
              f"{found / even:.5f}")
        assert abs(found / even - 1) < 0.02


def check_curved(folder):
    """A dome of quadrilaterals and triangles, covered in part: ccx reads and solves it."""
    mesh = disc(14.0, False)
    cut = np.arange(len(mesh.corners)) % 3 == 0
    three = np.vstack([mesh.corners[cut][:, [0, 1, 2]], mesh.corners[cut][:, [0, 2, 3]]])
    mesh = shell_mesh(mesh.nodes, np.vstack([np.column_stack([three, np.full(len(three), -1)]),
                                             mesh.corners[~cut]]))
    (folder / "part.inp").write_text(abaqus_text(mesh), encoding="utf-8")
    part = read_part(folder / "part.inp")
    ply = dome_ply(30.0, count=22)
    two = replace(ply, name="line\nbreak, é", thickness=0.5 * ply.thickness)
    layers, _ = map_all([ply, two], part, 5.0, 0.5, False)
    layup = Layup(part, layers, "x", "a dome", False)
    bare = part.labels[~layers[0].covered()]
    (name, text), = calculix_files(layup).items()
    if len(bare):
        assert "*ELSET, ELSET=PLYFORM_BARE\n" + "\n".join(map(str, bare)) in text
    (folder / name).write_text(text, encoding="utf-8")
    low = part.nodes[:, 2] < part.nodes[:, 2].min() + 5.0
    lines = [MATERIAL.format("dome"), MATERIAL.format("line_break___"),
             "*MATERIAL, NAME=SOFT\n*ELASTIC\n1000., 0.3",
             *(["*SHELL SECTION, ELSET=PLYFORM_BARE, MATERIAL=SOFT\n0.6"] if len(bare) else []),
             "*BOUNDARY", *(f"{n}, 1, 6" for n in part.node_labels[low]), "*STEP", "*STATIC", "*CLOAD",
             f"{part.node_labels[part.nodes[:, 2].argmax()]}, 3, -1.", "*END STEP"]
    (folder / "model.inp").write_text(f"*INCLUDE, INPUT={name}\n" + "\n".join(lines) + "\n",
                                      encoding="utf-8")
    done = subprocess.run([CCX, "-i", "model"], cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0 and "*ERROR" not in done.stdout, done.stdout[-2000:]
    print(f"dome: {len(part.labels)} elements solved, {len(bare)} of them bare")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as where:
        check_off_axis(Path(where))
        check_order(Path(where))
        check_uneven(Path(where))
        check_curved(Path(where))
