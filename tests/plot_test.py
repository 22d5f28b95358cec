# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the example of make_results with tools/plot.py and looks at the pictures.

    plot_test.py PLOT_PY DIR

Leaves with 77 when h5py or matplotlib is missing.
"""

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


def plot(*arguments):
    return subprocess.run([sys.executable, sys.argv[1], *map(str, arguments)], text=True,
                          capture_output=True, check=False)


def picture(file, *arguments):
    """RGB of the PNG that plot.py draws, 0 to 1."""
    done = plot(*arguments, "-o", file)
    assert done.returncode == 0, done.stderr
    return matplotlib.image.imread(file)[:, :, :3]


def coloured(image):
    """Share of pixels that are neither white, grey nor black."""
    return np.mean(image.max(axis=2) - image.min(axis=2) > 0.15)


def check_plies(run, file):
    image = picture(file, "plies", run, "--tools")
    # two flat sheets, nearly square, fill their axes
    assert coloured(image) > 0.2, f"only {coloured(image):.3f} of the picture has colour"
    start = picture(file, "plies", run, "--frame", 0)  # no shear: one colour but for the scale
    assert np.unique(image.reshape(-1, 3), axis=0).shape[0] > 100
    assert abs(image - start).mean() > 0.02
    both = picture(file, "plies", run, run / "single")  # one row each, one ply and no tools below
    assert both.shape[1] > 1.3 * image.shape[1] and coloured(both) > 0.2


def check_history(run, file):
    one = picture(file, "history", run)
    assert 0.002 < coloured(one) < 0.2, f"{coloured(one):.4f} of the picture has colour"
    assert picture(file, "history", run, run).shape[1] > 1.4 * one.shape[1]
    assert picture(file, "history", run, run, "--overlay").shape == one.shape


def check_messages(run, folder):
    for command in ("plies", "history"):
        done = plot(command, folder / "nothing", "-o", folder / "none.png")
        assert done.returncode == 1 and "is missing" in done.stderr, done
        assert "Traceback" not in done.stderr and not (folder / "none.png").exists()
    (folder / "results.h5").write_text("no HDF5")
    done = plot("plies", folder, "-o", folder / "none.png")
    assert done.returncode == 1 and "cannot be read" in done.stderr, done
    done = plot("plies", run, "--frame", 3, "-o", folder / "none.png")
    assert done.returncode == 1 and "frames 0 to 2" in done.stderr, done
    done = plot("plies", run, "-o", folder / "picture.xyz")
    assert done.returncode == 2 and ".png" in done.stderr, done


def main():
    run = Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        check_plies(run, folder / "plies.png")
        check_history(run, folder / "history.png")
        check_messages(run, folder)
        assert plot("history", run, "-o", folder / "h.svg").returncode == 0
        assert "<svg" in (folder / "h.svg").read_text(encoding="utf-8")


main()
