# SPDX-License-Identifier: GPL-3.0-or-later
"""tools/area_means.py against closed forms on made-up fields.

    area_means_test.py TOOLS_FOLDER

Leaves with 77 when h5py is missing.
"""

import json
import sys
import tempfile
from pathlib import Path

try:
    import h5py
    import numpy as np
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)

import plot_folders
sys.path.insert(0, sys.argv[1])
import area_means as program  # noqa: E402
from program_call import call  # noqa: E402

SIZE = 200.0  # mm, side of the squares


def write(folder, cells, field, angle_deg=0.0):
    """A square ply with shear angles `field(x, y)` at the centroids of its triangles."""
    x0, triangles = plot_folders.grid(cells, SIZE)
    middle = x0[triangles].mean(axis=1)
    plot_folders.write(folder, {"p": (x0, x0, triangles, field(middle[:, 0], middle[:, 1]))})
    with h5py.File(folder / "results.h5", "r+") as file:
        file["plies/p"].attrs["angle_deg"] = angle_deg
    return folder


def told(*arguments):
    with tempfile.TemporaryDirectory() as name:
        file = Path(name) / "told.json"
        done = call(program, *arguments, "--json", file)
        assert done.code == 0 and not done.err, done
        assert done.out.splitlines()[1].split()[0] == "p", done
        (ply,) = json.loads(file.read_text(encoding="utf-8"))
        return ply


def near(value, expected, tolerance):
    assert abs(value - expected) <= tolerance, f"{value} is not {expected} to {tolerance}"


def bend(x, y):
    return 20.0 * np.sin(x / 50.0) * np.cos(y / 70.0)


def check_shift(folder):
    """The same field but for a constant, on the same mesh and on another."""
    coarse = write(folder / "coarse", 20, bend)
    near(told(coarse, coarse)["rms_deg"], 0.0, 0.0)
    for cells in (20, 33):
        ply = told(coarse, write(folder / f"shifted{cells}", cells, lambda x, y: bend(x, y) + 2.0))
        assert ply["same_mesh"] == (cells == 20)
        # discs of other triangles: their mean places differ by up to a millimetre or two
        near(ply["rms_deg"], 2.0, 1e-9 if cells == 20 else 0.1)
        assert ply["points"] == (800 if cells == 20 else 1600)  # a grid of 5 mm in 200 mm


def check_means(folder):
    """Discs take away what changes its sign from triangle to triangle, but not what is wide."""
    rng = np.random.default_rng(5)
    plain = write(folder / "plain", 60, bend)
    noisy = write(folder / "noisy", 60, lambda x, y: bend(x, y) + rng.choice([-8.0, 8.0], len(x)))
    ply = told(plain, noisy)
    # 56 triangles of 5.6 mm2 are in a disc of 314 mm2: noise falls by the root of that, or less on
    # the rim, where half of a disc is missing
    near(ply["rms_deg"], 8.0 / np.sqrt(56.0), 0.3)
    near(told(plain, noisy, "--radius", 5)["rms_deg"], 16.0 / np.sqrt(56.0), 0.6)
    near(ply["b"]["jump_deg"], 8.0 * np.sqrt(2.0), 0.5)
    assert ply["a"]["jump_deg"] < 0.1 * ply["b"]["jump_deg"]


def check_rough(folder):
    """Jumps of a linear field are those of the centroids; one triangle that stands out is found."""
    def spike(x, y):
        value = 0.3 * x
        value[np.hypot(x - 33.0, y - 18.0).argmin()] += 9.0
        return value
    smooth = told(write(folder / "smooth", 20, lambda x, y: 0.3 * x),
                  write(folder / "spike", 20, spike))
    # alternating diagonals: centroids a third of 10 mm apart across a diagonal, and across sides
    # along y 2/3 of it, along x none
    near(smooth["a"]["jump_deg"], 0.3 * 10.0 * np.sqrt((400 / 9 + 380 * 4 / 9) / 1160), 1e-9)
    near(smooth["b"]["outlier_deg"], 9.0, 2.5)
    near(np.hypot(*(np.array(smooth["b"]["outlier_at_mm"]) - [33.0, 18.0])), 0.0, 5.0)


def check_turn(folder):
    """A quarter turn exchanges warp and weft, and so the sign of the shear angle."""
    def cross(x, y):
        return 0.002 * x * y  # its own negative a quarter turn on: what a 0/90 ply has
    run = write(folder / "cross", 20, cross)
    near(told(run, "--turn", 90)["rms_deg"], 0.0, 1e-9)
    near(told(run, "--turn", 270)["rms_deg"], 0.0, 1e-9)
    near(told(run, "--turn", 180)["rms_deg"], 0.0, 1e-9)
    # x is even under none: x - (- y) after a quarter turn, over the square
    slope = write(folder / "slope", 40, lambda x, y: 0.1 * x)
    near(told(slope, "--turn", 90)["rms_deg"], 0.1 * SIZE / np.sqrt(6.0), 0.3)
    # a ply whose warp is the other's weft
    other = write(folder / "other", 20, lambda x, y: -cross(x, y), 90.0)
    near(told(run, other)["rms_deg"], 0.0, 1e-9)
    disturbed = write(folder / "disturbed", 20, cross, 1e-6)
    near(told(run, disturbed)["rms_deg"], 0.0, 1e-9)


def check_messages(folder):
    run = write(folder / "run", 4, bend)
    for words, code, arguments in (("is missing", 1, (run, folder / "nothing")),
                                   ("needed", 2, (run,)),
                                   ("radius", 2, (run, run, "--radius", 0)),
                                   ("no disc", 1, (run, write(folder / "odd", 3, bend),
                                                   "--radius", 0.1))):
        done = call(program, *arguments)
        assert done.code == code and words in done.err and "Traceback" not in done.err, done


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for check in (check_shift, check_means, check_rough, check_turn, check_messages):
            check(folder)


main()
