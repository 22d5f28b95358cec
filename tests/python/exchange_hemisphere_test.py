# SPDX-License-Identifier: GPL-3.0-or-later
"""A formed hemisphere ply, yarns at 30 and 60 degrees, mapped by plyform map onto quadrilaterals and
triangles of 2, 5 and 12 mm: against its smoothed field.

    exchange_hemisphere_test.py TOOLS PROGRAM CASES

Prints the rows of the table in docs/users/exchange.md. Leaves with 77 when numpy, scipy or h5py is
missing.
"""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import numpy as np

    from exchange_meshes import TEXTS, disc
    from exchange.formed import read_formed
    from exchange.layup import angle_between
    from exchange.mapping import SmoothPly, turn
    from exchange.shell_mesh import centroids, element_normals
except ImportError as error:
    print("SKIPPED:", error)
    sys.exit(77)

PROGRAM, CASES = (Path(argument).resolve() for argument in sys.argv[2:4])
MOST_DEG = {2.0: 0.2, 5.0: 0.5, 12.0: 1.5}  # rms, by the size of the elements
MIDDLE = 75.3  # mm: radius of the punch and half of the ply
ENDINGS = {2.0: ".inp", 5.0: ".bdf", 12.0: ".k"}


def call(*words):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def bowl(size, triangles):
    """The ply's mid-surface on the punch at the end of the stroke, normals up."""
    mesh = disc(size, triangles, MIDDLE, 58.0)
    mesh.nodes = mesh.nodes * (1, 1, -1) + (0.0, 0.0, 0.6 - MIDDLE)
    return mesh


def check(results, smooth, angle, size, triangles, folder):
    mesh = bowl(size, triangles)
    part = folder / ("part" + ENDINGS[size])
    part.write_text(TEXTS[ENDINGS[size]](mesh), encoding="utf-8")
    call("map", results, "--onto", part, "-o", folder / "map")
    rows = rows_of(folder / "map" / "ply.csv")
    yarns = {yarn: np.array([[float(row[f"{yarn}_{axis}"]) for axis in "xyz"] for row in rows])
             for yarn in ("warp", "weft")}
    assert [int(row["element"]) for row in rows] == list(mesh.labels)
    middles = centroids(mesh)
    triangle, weights, _ = smooth.surface.closest(middles, 10.0)
    normal, warp, weft, thickness = smooth.at(triangle, weights)
    facing = element_normals(mesh)[0]
    facing *= np.sign((facing * normal).sum(axis=1))[:, None]
    off = np.concatenate([angle_between(turn(warp, normal, facing), yarns["warp"]),
                          angle_between(turn(weft, normal, facing), yarns["weft"])])
    rms = float(np.sqrt((off**2).mean()))
    thin = np.array([float(row["thickness_mm"]) for row in rows]) - thickness
    (told,) = rows_of(folder / "map" / "mapping.csv")
    back = float(told["there_and_back_angle_rms_deg"])
    print(f"| {angle:g}° | {'triangles' if triangles else 'quadrilaterals'} of {size:g} mm | "
          f"{rms:.3f}° | {off.max():.2f}° | {np.sqrt((thin**2).mean()):.4f} mm | {back:.2f}° | "
          f"{float(told['smoothing_angle_rms_deg']):.2f}° |")
    assert rms < MOST_DEG[size] and np.sqrt((thin**2).mean()) < 0.005
    assert int(told["covered"]) == len(rows)
    return back


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for angle in (30.0, 60.0):
            results = folder / f"run{angle:g}"
            call("run", CASES / "hemisphere_0", "--set", f"ply.0.angle={angle:g}", "--set",
                 "blanks.square.mesh_from=element_size", "--set", "blanks.square.element_size=6.8", "--set",
                 "solver.outputs=1", "--threads", "1", "-o", results)
            (ply,) = read_formed(results).plies
            smooth = SmoothPly(ply)
            for triangles in (False, True):
                back = [check(results, smooth, angle, size, triangles, folder) for size in MOST_DEG]
                assert back == sorted(back) and back[-1] < 2.0, back


if __name__ == "__main__":
    main()
