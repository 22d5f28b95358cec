# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the example of make_results and made-up folders with tools/plot.py, and looks at the
pictures. The numbers in them: plot_numbers_test.py.

    plot_test.py PART PLOT_PY DIR      PART: plies, histories, lines

Leaves with 77 when h5py or matplotlib is missing.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import h5py  # noqa: F401, plot.py needs it
    import matplotlib.image
    import numpy as np
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)

import plot_folders
sys.path.insert(0, str(Path(sys.argv[2]).parent))
import plot as program  # noqa: E402
from program_call import call  # noqa: E402

BLUE, ORANGE, GREEN = (0, 114, 178), (213, 94, 0), (0, 158, 115)  # first, second, third line


def plot(*arguments):
    done = call(program, *arguments)
    matplotlib.pyplot.close("all")
    return done


def picture(file, *arguments):
    """RGB of the PNG that plot.py draws, 0 to 1."""
    done = plot(*arguments, "-o", file)
    assert done.code == 0 and not done.err, done
    return matplotlib.image.imread(file)[:, :, :3]


def complains(words, code, *arguments):
    done = plot(*arguments)
    assert done.code == code and words in done.err and "Traceback" not in done.err, done
    assert code == 2 or len(done.err.splitlines()) == 1, done


def coloured(image):
    """Share of pixels that are neither white, grey nor black."""
    return np.mean(image.max(axis=2) - image.min(axis=2) > 0.15)


def pixels(image, colour):
    return np.argwhere((abs(image - np.array(colour) / 255.0) < 0.02).all(axis=2))


def check_plies(run, file):
    image = picture(file, "plies", run, "--tools")
    # two flat sheets, nearly square, fill their axes
    assert coloured(image) > 0.2, f"only {coloured(image):.3f} of the picture has colour"
    start = picture(file, "plies", run, "--frame", 0)  # no shear: one colour but for the scale
    violet = (68, 1, 84)
    assert np.unique(image.reshape(-1, 3), axis=0).shape[0] > 100
    assert len(pixels(start, violet)) > 0.15 * start[:, :, 0].size > 5 * len(pixels(image, violet))
    both = picture(file, "plies", run, run / "single")  # a row each, one ply and no tools below
    assert both.shape[0] > 1.8 * image.shape[0] and coloured(both) > 0.15


def check_views_of_plies(run, file):
    above = picture(file, "plies", run, "--only", "above", "--ply", "lower")
    stack = picture(file, "plies", run, "--only", "3d", "--ply", "lower")
    assert coloured(above) > coloured(stack) > 0.01
    tilted = picture(file, "plies", run, "--only", "3d", "--ply", "lower", "--view", 80, 10)
    assert coloured(tilted) > 1.3 * coloured(stack)
    seen = [above]
    for field in ("warp-strain", "weft-strain", "warp-tension", "weft-tension", "thickness"):
        seen.append(picture(file, "plies", run / "single", "--only", "above", "--field", field))
    assert min(map(coloured, seen)) > 0.05
    assert len({image.tobytes() for image in seen}) == 6


def check_turn(folder):
    x0, triangles = plot_folders.grid(10, 100.0)
    x0 = x0 * [1.0, 0.5, 1.0]  # a strip along x
    shear = x0[triangles].mean(axis=1)[:, 0]
    plot_folders.write(folder / "strip", {"p": (x0, x0, triangles, shear)})
    lying, standing = (picture(folder / "t.png", "plies", folder / "strip", "--only", "above",
                               "--turn", degrees) for degrees in (0, 90))
    assert standing.shape[0] > 1.4 * lying.shape[0]


def check_history(run, file):
    one = picture(file, "history", run)
    assert 0.002 < coloured(one) < 0.2, f"{coloured(one):.4f} of the picture has colour"
    assert picture(file, "history", run, run).shape[1] > 1.4 * one.shape[1]
    overlaid = picture(file, "history", run, run, "--overlay")
    assert abs(overlaid.shape[1] - one.shape[1]) < 0.1 * one.shape[1]  # but for the legend
    energy = picture(file, "energy", run)
    assert not np.array_equal(energy, one)
    assert not np.array_equal(energy, picture(file, "energy", run, "--against", "time"))


def check_load(folder):
    u = np.linspace(0.0, 10.0, 21)
    for name, factor in (("a", 1.0), ("b", 2.0)):
        history = {"time_s": u, "stroke_mm": u, "grip_1_force_N": factor * u**2,
                   "grip_1_displacement_mm": u}
        plot_folders.write(folder / name, {}, history)
    plot_folders.write_table(folder / "theory.csv", {
        "displacement_mm": [0, 2, 4, 6, 8, 10], "force_N": [0, 4, 16, 36, 64, 100],
        "shear_deg": [0, 20, 35, 47, 56, 60]})
    alone = picture(folder / "l.png", "load", folder / "a", folder / "b")
    at_end = alone[:, int(0.7 * alone.shape[1]):]  # the legend is at the other
    high_a, high_b = (pixels(at_end, c)[:, 0].min() for c in (BLUE, ORANGE))
    assert high_b < high_a  # rows count from the top: b has twice the force of a
    for more in ([], ["--against", "shear"]):
        image = picture(folder / "l.png", "load", folder / "a", folder / "b", "--curve",
                        folder / "theory.csv", "--limit", 120, *more)
        assert image.shape[0] > alone.shape[0]
        below = {c: pixels(image[int(0.67 * len(image)):], c)[:, 0].mean() for c in (BLUE, ORANGE)}
        assert below[ORANGE] < below[BLUE] - 20  # b at 100 %, a at 0
    complains("has no body punch: it has grip_1", 1, "load", folder / "a", "--of", "punch",
              "-o", folder / "n.png")
    complains("no column of an energy", 1, "energy", folder / "a", "-o", folder / "n.png")
    complains("takes a --curve", 1, "load", folder / "a", "--against", "shear",
              "-o", folder / "n.png")


def check_section(folder):
    x0, triangles = plot_folders.grid(20, 200.0)
    middle = x0[triangles].mean(axis=1)
    dome = x0 + np.maximum(60.0 - 0.02 * (x0**2).sum(axis=1, keepdims=True), 0.0) * [0, 0, 1]
    plot_folders.write(folder / "dome", {
        "lower": (x0, dome, triangles, 0.2 * middle[:, 0]),
        "upper": (x0, dome + [0.0, 0.0, 20.0], triangles, -0.2 * middle[:, 0])})
    plot_folders.write_table(folder / "curve.csv", {
        "distance_mm": [-100, 100], "angle_deg": [-50, 50], "shear_deg": [-20, 20]})
    image = picture(folder / "s.png", "section", folder / "dome", "--through", 0, 0,
                    "--direction", 0, "--curve", folder / "curve.csv")
    half = len(image) // 2
    for colour, sign in ((BLUE, -1), (ORANGE, 1)):  # shear rises and falls; row 0 is the top
        rise = pixels(image[:half, :int(0.8 * image.shape[1])], colour)
        assert sign * np.corrcoef(rise.T)[0, 1] > 0.9
    plot_wide = int(0.8 * image.shape[1])
    assert (pixels(image[half:, :plot_wide], BLUE)[:, 0].min()
            > pixels(image[half:, :plot_wide], ORANGE)[:, 0].min())  # upper lies above
    ahead = ["--through", 0, 0, "--direction", 30, "--against", "angle", "--magnitude"]
    picture(folder / "s.png", "section", folder / "dome", folder / "dome", *ahead, "--centre",
            0, 0, -100, "--curve", folder / "curve.csv", "--ply", "upper", "--field", "shear")
    complains("go together", 1, "section", folder / "dome", *ahead, "-o", folder / "n.png")
    complains("ply lower: the section does not cross", 1, "section", folder / "dome", "--through",
              0, 150, "--direction", 0, "-o", folder / "n.png")
    complains("there is no ply top: it is one of lower, upper", 1, "section", folder / "dome",
              "--ply", "top", "--through", 0, 0, "--direction", 0, "-o", folder / "n.png")


def check_folds(folder):
    x0, triangles = plot_folders.disc(150.0, 15, 120)
    shear = np.zeros(len(triangles))
    for name, count in (("seven", 7), ("ten", 10)):
        plot_folders.write(folder / name, {
            "cloth": (x0, plot_folders.draped(x0, 90.0, count, 15.0), triangles, shear)})
    for more in ([], ["--ring", 130]):
        done = plot("folds", folder / "seven", folder / "ten", *more, "--json", folder / "f.json",
                    "-o", folder / "f.png")
        assert done.code == 0 and f"{folder / 'seven'} cloth: 7 folds deeper than" in done.out, done
        assert f"{folder / 'ten'} cloth: 10 folds" in done.out and len(done.out.splitlines()) == 2
        told = json.loads((folder / "f.json").read_text(encoding="utf-8"))
        assert [one["folds"] for one in told] == [7, 10]
        assert [len(one["maxima"]) for one in told] == [7, 10]
        expected = 15.0 * (40.0 / 60.0 if more else 1.0)
        for one in told:  # chords of 3° on waves of 36° or more: cos(10 * 1.5°) = 0.966
            assert 0.95 * expected < one["amplitude_mm"] < 1.01 * expected, one
        image = matplotlib.image.imread(folder / "f.png")[:, :, :3]
        assert len(pixels(image, ORANGE)) > 17 * 20  # the marks
    done = plot("folds", folder / "seven", "--depth", 40, "-o", folder / "f.png")
    assert "0 folds deeper than 40 mm (--depth)" in done.out, done
    complains("leaves the unformed ply cloth", 1, "folds", folder / "ten", "--ring", 151,
              "-o", folder / "n.png")


def check_fit(folder):
    x = np.linspace(0.0, 10.0, 12)
    table = {"displacement_mm": x, "shear_deg": 4.0 * x, "measured_N": x**2, "fitted_N": 1.1 * x**2}
    plot_folders.write_table(folder / "fit.csv", table)
    image = picture(folder / "fit.png", "fit", folder / "fit.csv")
    above_zero = pixels(image[int(0.645 * len(image)):], ORANGE)[:, 0]
    assert len(above_zero) > 50 and np.ptp(above_zero) < 20  # 10 % too much everywhere
    plot_folders.write_table(folder / "fit.csv", {
        "strain": 0.001 * x, "measured_N": x, "fitted_N": x})
    picture(folder / "fit.png", "fit", folder / "fit.csv")
    complains("has no column shear_deg: it has strain", 1, "fit", folder / "fit.csv", "--against",
              "shear", "-o", folder / "n.png")


def check_setup(folder):
    cases = Path(sys.argv[2]).resolve().parents[1] / "cases"
    image = picture(folder / "setup.png", "setup", cases / "hemisphere_0" / "case.toml")
    ply = np.ptp(pixels(image, ORANGE)[:, 1]) / image.shape[1]
    assert abs(ply - 340.0 / 380.0) < 0.03, ply  # its size over the width that is drawn
    complains("no tool of shape sphere", 1, "setup", cases / "square_box" / "case.toml",
              "-o", folder / "n.png")
    complains("nothing.toml", 1, "setup", folder / "nothing.toml", "-o", folder / "n.png")


def check_messages(run, folder):
    for command in (["plies"], ["history"], ["energy"], ["load"], ["folds"],
                    ["section", "--through", 0, 0, "--direction", 0]):
        complains("is missing", 1, *command, folder / "nothing", "-o", folder / "none.png")
    complains("is missing", 1, "fit", folder / "nothing", "-o", folder / "none.png")
    (folder / "results.h5").write_text("no HDF5")
    complains("cannot be read", 1, "plies", folder, "-o", folder / "none.png")
    complains("frames 0 to 2", 1, "plies", run, "--frame", 3, "-o", folder / "none.png")
    complains("--turn is given 2 times for 1", 1, "plies", run, "--turn", 1, "--turn", 2,
              "-o", folder / "none.png")
    complains(".png", 2, "plies", run, "-o", folder / "picture.xyz")
    complains("not above 0", 2, "folds", run, "--ring", -3, "-o", folder / "none.png")
    assert not (folder / "none.png").exists()


def check_as_a_program(run, folder):
    done = subprocess.run([sys.executable, sys.argv[2], "history", run, "-o", folder / "h.svg"],
                          text=True, capture_output=True, check=False)
    assert done.returncode == 0 and not done.stderr, done
    assert "<svg" in (folder / "h.svg").read_text(encoding="utf-8")


def main():
    run = Path(sys.argv[3])
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        if sys.argv[1] == "plies":
            check_plies(run, folder / "plies.png")
            check_views_of_plies(run, folder / "plies.png")
            check_turn(folder)
        elif sys.argv[1] == "histories":
            check_history(run, folder / "history.png")
            check_load(folder)
            check_as_a_program(run, folder)
        else:
            check_section(folder)
            check_folds(folder)
            check_fit(folder)
            check_setup(folder)
            check_messages(run, folder)


main()
