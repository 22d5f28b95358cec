# SPDX-License-Identifier: GPL-3.0-or-later
"""Thickness, fibre volume, areal weight and angles by layer on a part's mesh, of matched_double_dome with
coarse elements, mapped onto its die: what a layer weighs is what the cloth weighs that lies there.

    exchange_infusion_test.py TOOLS PROGRAM CASES

Leaves with 77 when gmsh, numpy, scipy, h5py or meshio is missing.
"""

import csv
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import gmsh  # noqa: F401, draw_tools.py needs it
    import h5py
    import meshio
    import numpy as np
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)

TOOLS, PROGRAM, CASES = (Path(argument).resolve() for argument in sys.argv[1:4])
NAMES = ("lower", "middle", "upper")
WEIGHT, DENSITY = 600.0, 2550.0  # g/m2 of the flat cloth, kg/m3 of its fibres
COARSE = ["blanks.quarter.element_size=10", "solver.duration=0.05", "solver.outputs=2"]


def call(*words, place=None):
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, check=False, cwd=place)
    assert done.returncode == 0, done
    return done.stdout


def formed(folder):
    """The case, run; and the upper side of its die as a part mesh."""
    shutil.copytree(CASES / "fabrics", folder / "fabrics")
    shutil.copytree(CASES / "matched_double_dome", folder / "case")
    shutil.copy(CASES / "step_file.py", folder)
    call(sys.executable, folder / "case/draw_tools.py")
    call(TOOLS / "mesh_tool.py", folder / "case/part.step", "--offset", "1.8", "--on", "punch", place=folder / "case")
    for name in ("die", "punch"):
        (folder / f"case/part_{name}.stl").rename(folder / f"case/{name}.stl")
    call(PROGRAM, "run", folder / "case", "-o", folder / "run", *(word for one in COARSE for word in ("--set", one)))
    mesh = meshio.read(folder / "case/die.stl")
    corners = split(mesh.points[mesh.cells_dict["triangle"]])
    up = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2] > 1e-6
    there = (corners.mean(axis=1)[:, :2] > 0).all(axis=1)
    points, nodes = np.unique(corners[up & there].reshape(-1, 3).round(6), axis=0, return_inverse=True)
    meshio.write_points_cells(folder / "part.vtu", points, [("triangle", nodes.reshape(-1, 3))])
    return folder / "run"


def split(corners):
    """Triangles (m x 3 x 3) with sides of 8 mm at most, larger ones in four."""
    while True:
        long = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2).max(axis=1) > 8.0
        if not long.any():
            return corners
        a, b, c = corners[long].transpose(1, 0, 2)
        ab, bc, ca = 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)
        corners = np.vstack([corners[~long], *(np.stack(one, axis=1) for one in (
            (a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)))])


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {name: np.array([row[name] if name == "ply" else float(row[name] or "nan") for row in rows])
            for name in rows[0]}


def check_layers(folder):
    """What stands twice agrees, to the digits that are written."""
    layers, stack = table(folder / "infusion_layers.csv"), table(folder / "infusion.csv")
    weight = layers["fibre_volume"] * DENSITY * layers["thickness_mm"]
    assert np.abs(weight / layers["areal_weight_g_m2"] - 1).max() < 1e-6
    row = {label: k for k, label in enumerate(stack["element"])}
    of = np.array([row[label] for label in layers["element"]])
    count = len(row)
    for name in ("thickness_mm", "areal_weight_g_m2"):
        assert np.allclose(np.bincount(of, layers[name], count), np.nan_to_num(stack[name]), rtol=1e-7), name
    assert (np.bincount(of, minlength=count) == stack["layers"]).all()
    covered = stack["layers"] > 0
    fibres = np.bincount(of, layers["fibre_volume"] * layers["thickness_mm"], count)
    assert np.allclose(fibres[covered], (stack["fibre_volume"] * stack["thickness_mm"])[covered], rtol=1e-7)
    gap, thick = stack["gap_mm"][covered], stack["thickness_mm"][covered]
    assert ((1.70 < gap) & (gap < 1.80)).all(), (gap.min(), gap.max())  # closed they leave 1.71 along the stroke
    assert np.allclose(stack["gap_left_mm"][covered], gap - thick, atol=1e-6)
    assert np.allclose(stack["fibre_volume_in_gap"][covered] * gap, fibres[covered], rtol=1e-6)
    order = {}
    for label, name in zip(layers["element"], layers["ply"]):
        order.setdefault(label, []).append(name)
    assert all(tuple(one) == NAMES for one in order.values() if len(one) == 3), "from the die upwards"
    return layers, stack


def check_weights(layers, stack, run):
    """What lies on the elements weighs what the ply weighs, but for the distance from the part to the ply,
    by which faces that are curved or lean differ; by area it is what the ply itself has."""
    area = dict(zip(stack["element"], stack["area_mm2"]))
    with h5py.File(run / "results.h5") as file:
        last = file["frames"][sorted(file["frames"])[-1]]
        for name in NAMES:
            own = layers["ply"] == name
            areas = np.array([area[label] for label in layers["element"][own]]) * layers["covered_share"][own]
            mapped = (areas * layers["areal_weight_g_m2"][own]).sum() * 1e-6
            x, triangles = last[f"plies/{name}/x"][:], file[f"plies/{name}/triangles"][:]
            x0 = file[f"plies/{name}/x0"][:]
            flat, now = (0.5 * np.linalg.norm(np.cross(a[:, 1] - a[:, 0], a[:, 2] - a[:, 0]), axis=1)
                         for a in (x0[triangles], x[triangles]))
            whole = WEIGHT * flat.sum() * 1e-6
            mean = (areas * layers["areal_weight_g_m2"][own]).sum() / areas.sum()
            print(f"{name}: {mapped:.3f} g on the part, {whole:.3f} g of cloth; mean {mean:.1f} g/m2 on the part, "
                  f"{WEIGHT * flat.sum() / now.sum():.1f} of the ply; {areas.sum() / now.sum():.4f} of its area")
            assert abs(mapped / whole - 1) < 0.01
            assert abs(mean / (WEIGHT * flat.sum() / now.sum()) - 1) < 0.002


def check_vtu(folder):
    mesh, stack = meshio.read(folder / "layup.vtu"), table(folder / "infusion.csv")
    fields = {name: values[0] for name, values in mesh.cell_data.items()}
    for name, own in (("stack thickness_mm", "thickness_mm"), ("stack fibre_volume", "fibre_volume"),
                      ("stack areal_weight_g_m2", "areal_weight_g_m2"), ("layers", "layers")):
        assert np.allclose(fields[name], stack[own], rtol=1e-6, equal_nan=True), name
    assert {f"{ply} {name}" for ply in NAMES for name in ("fibre_volume", "areal_weight_g_m2")} <= set(fields)


def check_halves(folder, run):
    """Woven plies as two: twice the layers of half the weight, with the fibre volume that they had."""
    call(TOOLS / "map", run, "--onto", folder / "part.vtu", "--format", "infusion", "--two", "-o", folder / "two")
    one, two = (table(folder / name / "infusion_layers.csv") for name in ("map", "two"))
    assert len(two["layer"]) == 2 * len(one["layer"])
    for name, factor in (("areal_weight_g_m2", 0.5), ("thickness_mm", 0.5), ("fibre_volume", 1.0)):
        assert np.allclose(two[name][::2], factor * one[name], rtol=1e-7), name


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run = formed(folder)
        print(call(TOOLS / "map", run, "--onto", folder / "part.vtu", "--format", "infusion,vtu", "-o", folder / "map"))
        layers, stack = check_layers(folder / "map")
        check_weights(layers, stack, run)
        check_vtu(folder / "map")
        check_halves(folder, run)


main()
