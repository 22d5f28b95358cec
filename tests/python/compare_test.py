# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the example of make_results and made-up folders with tools/compare.py; its draw-ins
against closed forms.

    compare_test.py TOOLS_FOLDER DIR

Leaves with 77 when h5py is missing.
"""

import json
import subprocess
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
import compare as program  # noqa: E402
from program_call import call  # noqa: E402

ROUND_OFF = 1e-9  # of lengths of some 100 mm in 64 bits, with room


def compare(*arguments):
    return call(program, *arguments)


def numbers_of(*folders):
    """The tables and what --json writes."""
    file = folders[0] / "compared.json"
    done = compare(*folders, "--json", file)
    assert done.code == 0 and not done.err, done
    return done.out, json.loads(file.read_text(encoding="utf-8"))


def complains(words, *arguments):
    done = compare(*arguments)
    assert done.code == 1 and words in done.err and not done.out, done
    assert len(done.err.splitlines()) == 1 and "Traceback" not in done.err, done


def row(tables, *starts):
    """Cells of the row that starts so, after those; there has to be exactly one."""
    rows = [[cell.strip() for cell in line.strip("|").split(" | ")]
            for line in tables.splitlines() if line.startswith("|")]
    found = [cells[len(starts):] for cells in rows if cells[:len(starts)] == list(starts)]
    assert len(found) == 1, f"{len(found)} rows start with {starts}:\n{tables}"
    return found[0]


def close(a, b, tolerance=ROUND_OFF):
    difference = np.max(abs(np.asarray(a, dtype=float) - b))
    assert difference <= tolerance, f"{a} is not {b}: {difference} > {tolerance}"  # fails on NaN


def write(folder, sheets, **summary):
    """`sheets`: name -> (x0, x, triangles); the summary has what compare.py cannot do without."""
    plot_folders.write(folder, {name: (x0, x, triangles, np.zeros(len(triangles)))
                                for name, (x0, x, triangles) in sheets.items()})
    told = {"status": "done", "plies": [{"name": name} for name in sheets], "tools": [],
            "energy": {}, "contact": {}, **summary}
    (folder / "summary.json").write_text(json.dumps(told), encoding="utf-8")
    return folder


def check_plies(folder):
    """Every figure that is described stands in its column; what a ply has not is a dash."""
    x0, triangles = plot_folders.grid(4, 100.0)
    figures = {"max_shear_deg": ("largest shear", "deg", 1), "max_stretch": ("largest stretch", "", 3),
               "min_fibre_strain": ("smallest fibre strain", "1", 2),
               "draw_in_mm.mean": ("draw-in", "mm", 1)}
    described = {"plies": {name: {"label": label, "unit": unit, "digits": digits, "compared": True}
                           for name, (label, unit, digits) in figures.items()}}
    described["plies"]["p99_shear_deg"] = {"label": "not compared", "unit": "deg", "digits": 1}
    told = {"name": "p", "angle_deg": 45.0, "max_shear_deg": 41.23, "p99_shear_deg": 30.0,
            "max_stretch": 1.2345, "min_fibre_strain": -0.081234,
            "draw_in_mm": {"mean": 7.26, "largest": 9.0},
            "draw_in_yarns_mm": {"mean": 15.0, "spread": 10.0},
            "draw_in_bisectors_mm": {"mean": -0.01, "spread": 0.0}}
    run = write(folder / "all", {"p": (x0, x0, triangles)}, plies=[told], figures=described)
    tables, (given,) = numbers_of(run)
    assert given["plies"] == [told]
    assert row(tables, "folder", "ply") == [
        "angle, °", "largest shear, °", "largest stretch", "smallest fibre strain, %", "draw-in, mm",
        "draw-in along the yarns, mm", "along the bisectors, mm"]
    assert row(tables, "all", "p") == ["45", "41.2", "1.234", "-8.12", "7.3", "15.0 (10.0)", "0.0 (0.0)"]
    none = {"name": "p", "no_draw_in": "the middle of its bounding box is outside"}
    tables, _ = numbers_of(write(folder / "none", {"p": (x0, x0, triangles)}, plies=[none],
                                 figures=described))
    assert row(tables, "none", "p") == ["–"] * 7
    assert "- none, ply p: no draw-in, the middle of its bounding box is outside" in tables


def check_example(run):
    """The sheets of make_results: x += y / 10, y += x / 100, so that the closed form holds."""
    summary = json.loads((run / "summary.json").read_text(encoding="utf-8"))
    with tempfile.TemporaryDirectory() as name:
        file = Path(name) / "told.json"
        done = compare(run, run / "single", "--json", file)
        told = json.loads(file.read_text(encoding="utf-8"))
    assert done.code == 0 and not done.err, done
    assert [len(one["plies"]) for one in told] == [2, 1]
    for index, cells in enumerate((3, 4)):
        ply, given = told[0]["plies"][index], summary["plies"][index]
        close(ply["draw_in_yarns_mm"]["directions_deg"],
              (given["angle_deg"] + 90.0 * np.arange(4)) % 360.0)
        half, matrix = 5.0 * cells, np.array([[1.0, 0.1], [0.01, 1.0]])
        shift = (matrix - np.eye(2)) @ [half, half]  # the middle moves too
        for key in ("yarns", "bisectors"):
            angles = np.radians(ply[f"draw_in_{key}_mm"]["directions_deg"])
            u = np.stack([np.cos(angles), np.sin(angles)], axis=1)
            border = half * u / abs(u).max(axis=1, keepdims=True)
            close(ply[f"draw_in_{key}_mm"]["each"], np.linalg.norm(border, axis=1)
                  - np.linalg.norm(border @ matrix.T + shift, axis=1), 1e-7)  # nine digits
        cells_told = row(done.out, run.name, ply["name"])
        assert cells_told[:7] == [
            f"{given['angle_deg']:g}", *(f"{given[f'{of}_shear_deg']:.1f}"
                                         for of in ("max", "p99", "rms")),
            f"{100 * given['max_fibre_strain']:.2f}", f"{100 * given['min_fibre_strain']:.2f}",
            f"{given['max_tension_N_per_yarn']:.2f}"], cells_told
    assert row(done.out, run.name, "50") == ["400.0", "-30.0", "70.0", "-9.0"]
    assert row(done.out, "single", "50")[:2] == ["–", "–"]  # it has no tools
    energy = summary["energy"]
    assert row(done.out, run.name, "done")[:2] == [
        f"{energy['balance_error']:.1e}", f"{energy['kinetic'] / energy['shear']:.1e}"]


def check_summaries(folder):
    """What did not work is told, and what is not known is a dash."""
    x0, triangles = plot_folders.grid(4, 100.0)
    plies = {"a|b": (x0, x0, triangles)}
    stopped = write(folder / "x" / "run", plies, status="stopped", message="step 7: ply a tears",
                    tools=[{"name": "punch", "force_N": None}], stroke_mm=12.5, steps=7,
                    energy={"kinetic": 1.0, "shear": 0.0, "balance_error": None},
                    contact={"intersections_between_plies": 168})
    done = write(folder / "y" / "run", plies)
    doubtful = write(folder / "z" / "run", plies, status="doubtful", message="do not trust ply a")
    tables, _ = numbers_of(stopped, done, doubtful)
    assert f"- {doubtful} is doubtful: do not trust ply a" in tables
    assert f"- {stopped} is not done (stopped): step 7: ply a tears" in tables
    assert "is not done" not in tables.replace(str(stopped) + " is not done", "")
    assert row(tables, str(stopped), "12.5") == ["–"]
    assert row(tables, str(stopped), "stopped") == ["–", "–", "–", "–", "168", "–", "7", "–", "–"]
    assert row(tables, str(done), "a\\|b") == ["–"] * 3


def check_messages(folder):
    x0, triangles = plot_folders.grid(4, 100.0)
    run = write(folder / "good", {"p": (x0, x0, triangles)})
    complains("is missing: is", folder / "nothing")
    complains("is missing: is", run, folder / "nothing")
    complains("No such file", run, "--json", folder / "nothing" / "file.json")
    odd = write(folder / "odd", {"p": (x0, x0, triangles)}, plies=[{"name": "q"}])
    complains("different plies", odd)
    wordy = {"status": "done", "plies": [{"name": "p"}], "tools": [], "energy": {}, "contact": {},
             "steps": "many"}
    for text, words in (("{", "cannot be read"), ("[1]", "cannot be read"),
                        ('{"status": "done"}', "plies"), (json.dumps(wordy), "'many'")):
        (odd / "summary.json").write_text(text, encoding="utf-8")
        complains(words, odd)
    (run / "results.h5").write_text("no HDF5")
    complains("cannot be read", run)
    assert compare().code == 2


def check_against(folder):
    """Shear angles that are linear in place differ by a constant and a slope, on any two meshes."""
    folders = []
    for name, cells, slope, shift in (("coarse", 8, 0.1, 0.0), ("fine", 23, 0.1, 2.0),
                                      ("steeper", 31, 0.2, 0.0)):
        x0, triangles = plot_folders.grid(cells, 200.0)
        folders.append(write(folder / name, {"p": (x0, x0, triangles)}, plies=[
            {"name": "p", "max_tension_N_per_yarn": 1.0 + shift}]))
        with h5py.File(folders[-1] / "results.h5", "r+") as file:
            middle = x0[triangles].mean(axis=1)
            file["frames/000000/plies/p/shear_angle_deg"][:] = slope * middle[:, 0] + shift
    coarse, fine, steeper = folders
    done = compare(fine, "--against", coarse)
    assert done.code == 0, done
    triangles, rms, largest, ratio, _ = row(done.out.split("\n\n")[0], "fine", "p")
    # nodal means are linear but along the rim, where they are those of half a cell further in
    assert abs(float(rms) - 2.0) < 0.1 and abs(float(largest) - 2.0) < 1.0, done.out
    assert ratio == "3.00", done.out
    done = compare(steeper, "--against", coarse)
    _, rms, largest, ratio, _ = row(done.out.split("\n\n")[0], "steeper", "p")
    close(float(rms), 0.1 * 200.0 / np.sqrt(12.0), 0.2)  # 0.1 x, x even in +-100
    assert compare(coarse, "--against", coarse).out.count("0.00") >= 2
    complains("is missing", coarse, "--against", folder / "nothing")


def check_as_a_program(run):
    done = subprocess.run([sys.executable, Path(sys.argv[1]) / "compare.py", run], text=True,
                          capture_output=True, check=False)
    assert done.returncode == 0 and not done.stderr, done
    assert row(done.stdout, run.name, "50")[0] == "400.0"


def main():
    run = Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        check_plies(folder)
        check_summaries(folder)
        check_messages(folder)
        check_against(folder)
    check_example(run)
    check_as_a_program(run)


main()
