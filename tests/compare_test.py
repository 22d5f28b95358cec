# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the example of make_results and made-up folders with tools/compare.py; draw-ins against
closed forms.

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


def write(folder, sheets, angle_deg=0.0, fibre_angle_deg=90.0, **summary):
    """`sheets`: name -> (x0, x, triangles); the summary has what compare.py cannot do without."""
    plot_folders.write(folder, {name: (x0, x, triangles, np.zeros(len(triangles)))
                                for name, (x0, x, triangles) in sheets.items()})
    with h5py.File(folder / "results.h5", "r+") as file:
        for name, (_, _, triangles) in sheets.items():
            file["plies"][name].attrs["angle_deg"] = angle_deg
            for family, angle in (("warp", angle_deg), ("weft", angle_deg + fibre_angle_deg)):
                a = np.radians(angle)
                file[f"frames/000000/plies/{name}/{family}"] = np.tile(
                    [np.cos(a), np.sin(a), 0.0], (len(triangles), 1))
    told = {"status": "done", "plies": [{"name": name} for name in sheets], "tools": [],
            "energy": {}, "contact": {}, **summary}
    (folder / "summary.json").write_text(json.dumps(told), encoding="utf-8")
    return folder


def square_draw_ins(half, matrix, directions_deg):
    """Of a square round its middle, formed by a matrix: closed form."""
    u = np.stack([np.cos(np.radians(directions_deg)), np.sin(np.radians(directions_deg))], axis=1)
    border = half * u / abs(u).max(axis=1, keepdims=True)
    return np.linalg.norm(border, axis=1) - np.linalg.norm(border @ np.transpose(matrix), axis=1)


def check_ply(ply, directions, expected):
    for key, angles, mm in zip(("yarns", "bisectors"), directions, expected):
        told = ply[f"draw_in_{key}_mm"]
        close(told["directions_deg"], np.array(angles) % 360.0)
        close(told["each"], mm)
        close([told["mean"], told["spread"]], [np.mean(mm), max(mm) - min(mm)])


def check_square(folder):
    x0, triangles = plot_folders.grid(10, 200.0)
    x0 += [30.0, -70.0, 0.0]  # the origin is not the middle
    x = (x0 - [30.0, -70.0, 0.0]) * [0.9, 0.8, 1.0] + [30.0, -70.0, -25.0]
    tables, (run,) = numbers_of(write(folder / "square", {"p": (x0, x, triangles)}))
    diagonal = 100.0 * (np.hypot(1.0, 1.0) - np.hypot(0.9, 0.8))
    check_ply(run["plies"][0], ([0, 90, 180, 270], [45, 135, 225, 315]),
              ([10.0, 20.0, 10.0, 20.0], [diagonal] * 4))
    assert row(tables, "square", "p")[-2:] == ["15.0 (10.0)", f"{diagonal:.1f} (0.0)"]
    # a ply that only moves: one end comes nearer by as much as the other goes away
    _, (run,) = numbers_of(write(folder / "moved", {"p": (x0, x0 + [5.0, 0.0, 0.0], triangles)}))
    side = 100.0 - np.hypot(100.0, 5.0)
    close(run["plies"][0]["draw_in_yarns_mm"]["each"], [-5.0, side, 5.0, side])
    # yarns that are not at right angles, and at no angle to the mesh
    matrix = np.array([[0.8, 0.1], [-0.05, 0.9]])
    x0, triangles = plot_folders.grid(7, 200.0)
    x = np.column_stack([x0[:, :2] @ matrix.T, x0[:, 2]])
    _, (run,) = numbers_of(write(folder / "ncf", {"p": (x0, x, triangles)}, 20.0, 70.0))
    yarns, bisectors = [20.0, 90.0, 200.0, 270.0], [55.0, 145.0, 235.0, 325.0]
    check_ply(run["plies"][0], (yarns, bisectors),
              (square_draw_ins(100.0, matrix, yarns), square_draw_ins(100.0, matrix, bisectors)))


def check_between_nodes(folder):
    """An odd number of cells: the yarns meet the border in the middle of an edge."""
    x0, triangles = plot_folders.grid(5, 100.0)
    x = x0 + np.random.default_rng(3).normal(0.0, 4.0, x0.shape)
    _, (run,) = numbers_of(write(folder / "uneven", {"p": (x0, x, triangles)}))
    for corner, direction, told in zip((0, 1, 2, 3), ([1, 0], [0, 1], [-1, 0], [0, -1]),
                                       run["plies"][0]["draw_in_yarns_mm"]["each"]):
        along, across = x0[:, :2] @ direction, x0[:, :2] @ [-direction[1], direction[0]]
        ends = np.flatnonzero((along > 49.0) & (abs(across) < 11.0))
        assert len(ends) == 2, corner
        close(told, 50.0 - np.hypot(*x[ends, :2].mean(axis=0)))


def check_holes(folder):
    """A hole is walked over, a notch is not; a middle outside has no draw-in."""
    x0, triangles = plot_folders.disc(100.0, 10, 72)
    ring = triangles[(np.hypot(*x0[triangles].mean(axis=1)[:, :2].T) > 35.0)]
    used, ring = np.unique(ring, return_inverse=True)
    x0, ring = x0[used], ring.reshape(-1, 3)
    tables, (run,) = numbers_of(write(folder / "ring", {"p": (x0, 0.75 * x0, ring)}))
    close(run["plies"][0]["draw_in_yarns_mm"]["each"], 25.0)
    close(run["plies"][0]["draw_in_bisectors_mm"]["each"], 25.0)
    assert "no draw-in" not in tables
    x0, triangles = plot_folders.grid(10, 100.0)
    middle = x0[triangles].mean(axis=1)
    notched = triangles[(abs(middle[:, 0] - 20.0) > 10.0) | (middle[:, 1] < -20.0)]
    used, notched = np.unique(notched, return_inverse=True)  # walks end where they first leave
    _, (run,) = numbers_of(write(folder / "notch", {
        "p": (x0[used], 0.9 * x0[used], notched.reshape(-1, 3))}))
    close(run["plies"][0]["draw_in_yarns_mm"]["each"], [1.0, 5.0, 5.0, 5.0])
    corner = triangles[(middle[:, 0] < -20.0) | (middle[:, 1] < -20.0)]
    used, corner = np.unique(corner, return_inverse=True)
    tables, (run,) = numbers_of(write(folder / "corner", {
        "p": (x0[used], x0[used], corner.reshape(-1, 3))}))
    assert row(tables, "corner", "p")[-2:] == ["–", "–"]
    assert "draw_in_yarns_mm" not in run["plies"][0]
    assert "- corner, ply p: no draw-in, the middle of its bounding box is outside" in tables


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
        k = np.arange(2 * cells**2) + 100.0 * index
        fibre = 90.0 + np.degrees(np.angle(np.exp(0.01j * k).sum()))  # weft 0.02 k, warp 0.01 k
        told_directions = np.array(ply["draw_in_yarns_mm"]["directions_deg"])
        if index == 0:  # the other's wefts point elsewhere than its angle tells: not by rule
            close(told_directions, [0.0, fibre, 180.0, 180.0 + fibre], 1e-6)
        half, matrix = 5.0 * cells, np.array([[1.0, 0.1], [0.01, 1.0]])
        shift = (matrix - np.eye(2)) @ [half, half]  # the middle moves too
        for key in ("yarns", "bisectors"):
            angles = np.radians(ply[f"draw_in_{key}_mm"]["directions_deg"])
            u = np.stack([np.cos(angles), np.sin(angles)], axis=1)
            border = half * u / abs(u).max(axis=1, keepdims=True)
            close(ply[f"draw_in_{key}_mm"]["each"], np.linalg.norm(border, axis=1)
                  - np.linalg.norm(border @ matrix.T + shift, axis=1))
        cells_told = row(done.out, run.name, ply["name"])
        assert cells_told[:7] == [
            f"{given['angle_deg']:g}", *(f"{given[f'{of}_shear_deg']:.1f}"
                                         for of in ("max", "p99", "rms")),
            f"{given['max_tension_N_per_yarn']:.3g}", f"{100 * given['max_fibre_strain']:.2f}",
            f"{100 * given['min_fibre_strain']:.1f}"], cells_told
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
    tables, _ = numbers_of(stopped, done)
    assert f"- {stopped} is not done (stopped): step 7: ply a tears" in tables
    assert "is not done" not in tables.replace(str(stopped) + " is not done", "")
    assert row(tables, str(stopped), "12.5") == ["–"]
    assert row(tables, str(stopped), "stopped") == ["–", "–", "–", "–", "168", "–", "7", "–", "–"]
    assert row(tables, str(done), "a\\|b")[:7] == ["–"] * 7


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
        check_square(folder)
        check_between_nodes(folder)
        check_holes(folder)
        check_summaries(folder)
        check_messages(folder)
        check_against(folder)
    check_example(run)
    check_as_a_program(run)


main()
