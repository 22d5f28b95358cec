# SPDX-License-Identifier: GPL-3.0-or-later
"""The module `plyform` from the build tree: cases, runs, arrays without copies, stops, errors.

    module_test.py PACKAGE_FOLDER PROGRAM SOURCE_FOLDER
"""

import ast
import inspect
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import traceback
import warnings
from pathlib import Path

sys.path.insert(0, sys.argv[1])
program, source = Path(sys.argv[2]).resolve(), Path(sys.argv[3]).resolve()

import numpy as np  # noqa: E402
import h5py  # noqa: E402
import plyform  # noqa: E402
from raised_exception import raised  # noqa: E402

HEMISPHERE = source / "cases/hemisphere_0"
FABRIC = source / "cases/fabrics/glass_plain_weave.toml"
COARSE = {"blanks.square.mesh_from": "element_size", "blanks.square.element_size": 17.0,
          "solver.outputs": 4, "contact.friction": 0.3}


def coarse(**more):
    return plyform.Case(HEMISPHERE, {**COARSE, **more})


def address(array):
    return array.__array_interface__["data"][0]


def check_values(_):
    """A key's value is the file's, a default, one that was set, or picked."""
    case = plyform.Case(HEMISPHERE / "case.toml")
    assert case.get("contact.friction") == 0.2 and case.get("solver.outputs") == 20
    assert case.get("contact.self") == "auto" and case.get("stack.bottom") == 0.0  # defaults
    assert case.get("fabrics.glass.warp.stiffness") == 46000.0  # of the file that is named there
    assert case.get("tool.0.position.2") == 75.6 and case.get("ply")[0]["blank"] == "square"
    assert case.get("fabrics.glass.warp.compression_stiffness") is None
    for key, value in {"contact.friction": np.float64(0.25), "title": 'a "b" \\ ü\n',
                       "ply.0.angle": 30, "tool.0.position": np.array([0.0, 0.0, 80.0]),
                       "tool.1.points": ((80.0, -99.0), (80.0, 0.0, 12.0), (400.0, 0.0))}.items():
        case.set(key, value)
        told = case.get(key)
        assert told == (value if np.isscalar(value) else [
            list(item) if isinstance(item, tuple) else item for item in value]), (key, told)
    case.set("contact.pair", [{"between": ("punch", "plies"), "friction": 0.1}])
    assert case.get("contact.pair.0") == {"between": ["punch", "plies"], "friction": 0.1}
    case.set("ply.0.angle", 45.0)
    assert case.get("ply.0.angle") == 45.0 and case.check().sound, case.check()
    draft = plyform.Case(HEMISPHERE, {"solver.duration": 0.05}, accuracy="draft")
    assert draft.get("solver.duration") == 0.05 and "solver.duration" in draft.check().notes[0]
    assert draft.get("accuracy.shear_deg") == 3.0
    assert draft.get("solver.fibre_softening") != case.get("solver.fibre_softening")
    assert 0.0 < plyform.predicted_error(draft).total_deg <= 3.0
    assert "did you mean friction?" in str(raised(KeyError, case.get, "contact.frction"))
    assert "numbered from 0 to 2" in str(raised(KeyError, case.get, "tool.3.name"))
    raised(TypeError, case.set, "title", None)
    for key in (None, 1.5, b"title", ("ply", 0)):
        assert "is no key" in str(raised(TypeError, case.set, key, 1.0)), key
        raised(TypeError, case.get, key)
    raised(TypeError, plyform.Case, HEMISPHERE, {None: 1.0})
    raised(TypeError, case.set, "fabrics.glass", {None: 1.0})
    itself, table = [1.0], {}
    itself.append(itself)
    table["of"] = [table]
    for value in (itself, table):
        assert "itself" in str(raised(TypeError, case.set, "tool.1.points", value))
    simulation = plyform.Simulation(coarse())
    simulation.plies["ply"].positions[7, 1] = float("nan")
    said = str(raised(ValueError, simulation.run))
    assert "ply ply: positions of node 7 are" in said, said
    raised(ValueError, plyform.Case, HEMISPHERE, accuracy="rough")
    first = plyform.run(plyform.Case(HEMISPHERE, accuracy="instant"))
    assert first.status == "instant" and len(first.plies) == 1, first.status
    five = plyform.Case(HEMISPHERE.parent / "hemisphere_five_ply", accuracy="instant")
    all_of_them, one = plyform.run(five), plyform.form_ply(five, 3)
    assert [ply.name for ply in one.plies] == [all_of_them.plies[3].name] and one.status == "instant"
    assert np.array_equal(one.plies[0].x, all_of_them.plies[3].x), "alone or among all, it is formed alike"
    assert one.summary["plies"] == [all_of_them.summary["plies"][3]]
    squares = {"blanks.square.mesh_from": "element_size", "blanks.square.element_size": 6.8}
    outlook = plyform.Case(HEMISPHERE, {"ply.0.angle": 45.0, **squares}).outlook(threads=1)
    told = subprocess.run([program, "check", HEMISPHERE, "--set", "ply.0.angle=45",
                           *(word for key, value in squares.items()
                             for word in ("--set", f"{key}={value}"))], check=True,
                          capture_output=True, text=True).stdout.splitlines()
    assert outlook.lines[:-1] == told[:-2] and "time" in outlook.lines[-1]
    assert any(line.startswith("    note: tool die") for line in outlook.lines), outlook.lines
    assert 0.0 < outlook.step_s < outlook.stable_step_s and outlook.stop == ""
    assert 0.1 < outlook.steps * outlook.step_s < 0.3 and outlook.estimated_s > 0.0
    keys = {key.key: key for key in plyform.keys()}
    assert keys["tool[].radius"].unit == "mm" and keys["contact.friction"].range


def check_mistakes(folder):
    """Every mistake has place and remedy; check raises nothing, runs raise CaseError."""
    text = (HEMISPHERE / "case.toml").read_text(encoding="utf-8").replace("../fabrics", str(
        FABRIC.parent)).replace('angle = 0.0', 'angel = 0.0')
    file = folder / "case.toml"
    file.write_text(text, encoding="utf-8")
    case = plyform.Case(folder, {"contact.friction": -0.1})
    first, second = [m for m in case.check().mistakes if "missing" not in m.rule]
    line = text.splitlines().index("angel = 0.0") + 1
    assert (first.file, first.line, first.column) == (str(file), line, 1)
    assert (first.item, first.remedy) == ("ply.0.angel", "did you mean angle?"), str(first)
    assert (second.file, second.item, second.value) == ("--set", "contact.friction", "-0.1")
    assert second.rule == "must be at least 0 and at most 10" and second.remedy
    error = raised(plyform.CaseError, plyform.run, case)
    assert error.exit_code == 2 and str(first) in str(error)
    assert len(error.mistakes) == len(case.check().mistakes)
    assert isinstance(error, plyform.Error) and plyform.Error.exit_code == 1
    assert plyform.Case(folder / "none.toml").check().mistakes[0].remedy
    assert raised(plyform.CaseError, plyform.predicted_error, case).mistakes
    assert raised(plyform.CaseError, case.outlook).mistakes


def check_run(folder):
    """Callbacks, arrays, files of one run, and the program's: all say the same, to the last bit."""
    settings = [word for key, value in COARSE.items() for word in ("--set", f"{key}={value}")]
    subprocess.run([program, "run", HEMISPHERE, "-o", folder / "program", "--threads", "1",
                    *settings], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    results = []
    for threads in (1, 2):
        places, frames = [], []
        out = folder / f"threads{threads}"
        result = plyform.run(coarse(), threads=threads, output=out,
                             progress=lambda p: places.append((p.fraction, p.stroke_mm, p.step)),
                             frame=frames.append)
        results.append(result)
        assert result.status in ("done", "doubtful") and result.exit_code == 0
        assert len(frames) == 5 and len(places) > 10 and places == sorted(places)
        assert places[-1][:2] == (1.0, 75.0) and result.summary["threads"] == threads
        ply = result.plies["ply"]
        assert result.plies.names == ["ply"] and result.plies[-1].name == "ply"
        assert ply.x.shape == ply.x0.shape == (441, 3) and ply.triangles.shape == (800, 3)
        assert np.array_equal(frames[-1].plies[0].x, ply.x)
        assert frames[0].step == 0 and np.array_equal(frames[0].plies[0].x, ply.x0)
        table = np.genfromtxt(out / "plies/ply.csv", delimiter=",", names=True)
        assert np.allclose(ply.x[ply.triangles].mean(axis=1)[:, 2], table["z"], rtol=1e-8)
        assert ply.families == ("warp", "weft")
        assert {*ply.cell_fields, *ply.node_fields} <= set(dir(ply)) and not hasattr(ply, "stitch")
        for name in ply.cell_fields:
            field = getattr(ply, name)
            told = (table[name] if field.ndim == 1 else
                    np.stack([table[f"{name}_{axis}"] for axis in "xyz"], axis=1))
            assert len(field) == 800 and np.allclose(field, told, rtol=1e-8, atol=1e-12), name
        with h5py.File(folder / "program/results.h5") as file:
            last = file["frames/000004/plies/ply"]
            for name in ("x", *ply.cell_fields, "contact_pressure"):
                assert np.array_equal(last[name][:], getattr(ply, name)), (name, threads)
        for file in ("plies/ply.csv", "history.csv"):
            assert (folder / "program" / file).read_bytes() == (out / file).read_bytes(), file
    assert set(result.tools.names) == {"punch", "die", "blank_holder"}
    told = {tool["name"]: tool["force_N"] for tool in result.summary["tools"]}
    assert np.isclose(result.tools["punch"].force_N, told["punch"], rtol=1e-8)
    assert np.isclose(result.energies["shear"], result.frame.energies["shear"], rtol=1e-8)
    assert ply.reaction_N is None and not len(result.boundaries)
    raised(KeyError, lambda: result.plies["plie"])
    read_back(folder, result)
    return results[0]


def read_back(folder, result):
    """Folders of runs: states, summary, history, export."""
    last, second = plyform.read(folder / "threads2"), plyform.read(str(folder / "program"), 1)
    assert last.summary == result.summary and np.array_equal(last.plies[0].x, result.plies[0].x)
    assert np.isnan(last.frame.energies["shear"]) and last.energies == result.energies
    assert 0.0 < second.frame.stroke_mm < 75.0
    history = plyform.history(folder / "threads2")
    assert np.isclose(history["punch_force_N"][-1], result.tools["punch"].force_N, rtol=1e-8)
    assert {file.name for file in plyform.export(folder / "program")} >= {"ply.vtu", "punch.stl"}
    assert "no frame 5" in str(raised(plyform.Error, plyform.read, folder / "program", 5))
    assert "result folder" in str(raised(plyform.Error, plyform.read, folder / "nothing"))


def check_memory(_):
    """Positions and velocities are the arrays computed on; results keep theirs alive."""
    simulation = plyform.Simulation(coarse(), threads=2)
    ply = simulation.plies["ply"]
    x, v = ply.positions, ply.velocities
    before, seen = x.copy(), []
    assert np.array_equal(before, ply.x0) and v.shape == x.shape == (441, 3)
    assert x.dtype == v.dtype == np.float64 and not x.flags.owndata and x.flags.c_contiguous

    def look(progress):
        now = simulation.plies[0]
        seen.append((address(now.positions), address(now.velocities), x[:, 2].min(), abs(v).max(),
                     progress.step == simulation.step))

    last = {}
    result = simulation.run(progress=look,
                            frame=lambda f: last.update(same=np.array_equal(f.plies[0].x, x)))
    assert {row[:2] for row in seen} == {(address(x), address(v))} and len(seen) > 10
    assert all(row[4] for row in seen) and last["same"]
    assert seen[-1][2] < seen[len(seen) // 2][2] < -10.0 and max(row[3] for row in seen) > 100.0
    assert np.array_equal(result.plies[0].x, x) and result is simulation.result
    assert simulation.stroke_mm == 75.0 and np.isclose(simulation.time_s, 0.1, rtol=1e-3)
    assert "has run" in str(raised(plyform.Error, simulation.run))
    one, two = result.plies[0].x, result.frame.plies[0].x
    assert address(one) == address(two) and not one.flags.writeable
    shear = result.plies[0].shear_angle_deg
    largest = abs(shear).max()
    del simulation, result, ply, one, two, look, last
    assert np.isfinite(x).all() and abs(shear).max() == largest  # still there


def check_start():
    """What is written to positions before the run is where it starts."""
    simulation = plyform.Simulation(coarse(), threads=1)
    simulation.plies[0].positions[:, 0] += 1e-3
    starts = []
    simulation.run(frame=lambda f: starts.append(f.plies[0].x) or False)
    assert np.allclose(starts[0][:, 0] - simulation.plies[0].x0[:, 0], 1e-3)


FLIGHT = """
gravity = [0.0, 0.0, -9810.0]
[fabrics]
glass = "{fabric}"
[blanks.square]
size = [40.0, 40.0]
element_size = 10.0
[[ply]]
name = "ply"
fabric = "glass"
blank = "square"
angle = 0.0
[solver]
duration = 0.01
fibre_softening = 100.0
outputs = 2
max_balance_error = 10.0  # velocities that are written bring energy from nowhere
"""


def check_flight(folder):
    """Velocities are those at the time of the positions: a free ply falls as it must, and one that
    is thrown on its way counts from there on."""
    (folder / "case.toml").write_text(FLIGHT.format(fabric=FABRIC), encoding="utf-8")
    simulation = plyform.Simulation(plyform.Case(folder / "case.toml"), threads=1)
    ply, g, seen = simulation.plies[0], 9810.0, []
    ply.velocities[:] = [100.0, 0.0, 50.0]  # mm/s
    start = ply.positions.copy()

    def look(_):
        t = simulation.time_s
        if not seen or seen[-1][3] != t:
            seen.append((abs(ply.velocities - [100.0, 0.0, 50.0 - g * t]).max(),
                         ply.positions[:, 2].mean(), simulation.step, t))
        if simulation.step == 200:
            ply.velocities[:] = [0.0, -300.0, 800.0]
            seen.append((0.0, ply.positions[:, 2].mean(), -1, t))
            look.thrown = t, ply.positions.copy()
            return False if look.stop else None
        return None

    look.stop = True
    simulation.run(progress=look)
    assert len(seen) >= 3 and max(row[0] for row in seen) < 1e-6 * 98.1, seen
    simulation = plyform.Simulation(plyform.Case(folder / "case.toml"), threads=1)
    ply, look.stop = simulation.plies[0], False
    ply.velocities[:] = [100.0, 0.0, 50.0]
    seen.clear()
    simulation.run(progress=look)
    thrown, at = look.thrown
    left = simulation.time_s - thrown
    assert left > 1e-3, left
    wanted = at + np.array([0.0, -300.0 * left, 800.0 * left - 0.5 * g * left ** 2])
    assert abs(ply.positions - wanted).max() < 1e-7, abs(ply.positions - wanted).max()
    assert abs(ply.velocities - [0.0, -300.0, 800.0 - g * left]).max() < 1e-4
    assert np.array_equal(start, ply.x0)


def whole(folder, status):
    """The folder of a run that ended early: readable, and says so."""
    result = plyform.read(folder)
    assert result.status == status, result.summary["status"]
    with h5py.File(folder / "results.h5") as file:
        frames = len(file["time_s"])
        assert frames >= 2 and f"frames/{frames - 1:06}/plies/ply/x" in file
        assert np.isclose(file["stroke_mm"][-1], result.summary["stroke_mm"])
    assert (folder / "plies/ply.csv").is_file() and (folder / "results.xdmf").is_file()
    return result


def check_stops(folder):
    """False, an exception, Ctrl-C and the run itself."""
    result = plyform.run(coarse(), output=folder / "false", progress=lambda p: p.stroke_mm < 30.0)
    assert result.status == "interrupted" and result.exit_code == 1
    assert 30.0 <= result.frame.stroke_mm < 40.0 and result.summary["stroke_mm"] < 40.0
    assert np.array_equal(whole(folder / "false", "interrupted").plies[0].x, result.plies[0].x)

    def wrong(frame):
        if frame.stroke_mm > 20.0:
            raise ZeroDivisionError("mine")

    simulation = plyform.Simulation(coarse())
    error = raised(ZeroDivisionError, simulation.run, folder / "raised", frame=wrong)
    assert str(error) == "mine" and error.__traceback__ is not None
    assert "wrong" in {frame.name for frame in traceback.extract_tb(error.__traceback__)}
    assert whole(folder / "raised", "interrupted").summary == simulation.result.summary

    signal.signal(signal.SIGINT, signal.default_int_handler)
    ticks = []
    timer = threading.Timer(0.1, lambda: (ticks.append(1), os.kill(os.getpid(), signal.SIGINT)))
    # It only comes while the run computes if that leaves Python to other threads.
    raised(KeyboardInterrupt, plyform.run, coarse(**{"blanks.square.element_size": 6.8}),
           output=folder / "ctrl_c", frame=lambda f: timer.start() if f.step == 0 else None)
    assert ticks and whole(folder / "ctrl_c", "interrupted").frame.stroke_mm < 75.0

    error = raised(plyform.Stopped, plyform.run, coarse(**{"solver.max_balance_error": 1e-9}),
                   output=folder / "stopped")
    assert error.exit_code == 3 and "max_balance_error" in str(error)
    assert error.result.status == "stopped" and error.result.exit_code == 3
    whole(folder / "stopped", "stopped")
    (folder / "file").write_text("")
    error = raised(plyform.Error, plyform.run, coarse(), output=folder / "file/below")
    assert error.exit_code == 1 and "file" in str(error)


def check_difference(folder, result):
    none = plyform.difference(result, folder / "program")
    assert none.rms == none.mean == none.p95 == none.p99 == none.largest == 0.0
    finer = plyform.run(coarse(**{"blanks.square.element_size": 12.0}))
    found = plyform.difference(result, finer.frame)
    assert 0.1 < found.mean < found.rms < found.p95 < found.p99 < found.largest < 30.0
    assert len(found.at_nodes) == 1 and found.at_nodes[0].shape == (len(finer.plies[0].x),)
    assert np.isclose(abs(found.at_nodes[0]).max(), found.largest)
    assert plyform.difference(result, finer, "thickness_mm").largest < 0.5
    assert "thickness_mm" in str(raised(ValueError, plyform.difference, result, finer, "shear"))


def check_fits(folder):
    """A curve of theory gives its own law back."""
    theory = plyform.theory_shear(FABRIC, bias=(200, 100), to_deg=45.0, points=60)
    assert len(theory["force_N"]) == 61 and np.isclose(theory["shear_deg"][-1], 45.0)
    opening = plyform.theory_shear(FABRIC, bias=(200, 100), to_deg=45.0, points=60, negative=True)
    assert np.array_equal(opening["force_N"], theory["force_N"])  # an odd law
    assert np.array_equal(opening["shear_deg"], -theory["shear_deg"])
    curve = {"extension (mm)": theory["displacement_mm"], "load (N)": theory["force_N"]}
    sizes = {"fabric": FABRIC, "length": 200, "width": 100}
    fit = plyform.identify("bias", curve, output=folder / "fabric.toml", **sizes)
    assert np.allclose(coefficients(fit), [0.37044, 0.84105, 1.03113], rtol=1e-6)
    assert fit.numbers["residuals rms"].value < 1e-4 and "polynomial" in fit.said
    assert len(fit.fit["measured_N"]) > 50 and np.allclose(fit.fit["measured_N"], fit.fit["fitted_N"], rtol=1e-6)
    assert (folder / "fabric.toml").read_text(encoding="utf-8") == fit.text
    stuck = plyform.identify("bias", curve, points=4, compliance=0, toe=0, **sizes)
    stuck.write(folder / "stuck.toml")
    assert "table = [" in (folder / "stuck.toml").read_text(encoding="utf-8")
    table = folder / "curve.csv"
    np.savetxt(table, np.stack(list(curve.values()), axis=1), delimiter=",", header="d,F", comments="")
    again = plyform.identify("bias", table, x_column="d", y_column=2, **sizes)
    assert np.allclose(coefficients(again), coefficients(fit), rtol=1e-6)
    case = coarse(**{"fabrics.glass": folder / "fabric.toml"})
    assert np.allclose(case.get("fabrics.glass.shear.polynomial"), coefficients(fit), rtol=1e-6)
    strain = np.linspace(0.0, 0.01, 20)
    curved = plyform.identify("weft", {"strain": strain, "force (N)": 5e6 * strain**2}, folder / "fabric.toml",
                              folder / "fabric2.toml")
    case.set("fabrics.glass", folder / "fabric2.toml")
    assert 1 < len(case.get("fabrics.glass.weft.table")) <= 21 and "table" in curved.law
    assert case.get("fabrics.glass.weft.stiffness") is None
    error = raised(plyform.CaseError, plyform.identify, "bias", curve, FABRIC, length=150, width=100)
    assert error.mistakes[0].item == "length" and error.mistakes[0].remedy
    for wrong in ({"width": None}, {"law": "line"}, {"side": 5}, {"points": 2.5}, {"from": "x"}):
        raised(ValueError, plyform.identify, "bias", curve, **{**sizes, **wrong})
    raised(ValueError, plyform.identify, "bend", curve, **sizes)
    raised(ValueError, plyform.identify, "bias", {"d (mm)": [1, 2], "F (N)": [1]}, **sizes)
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        noise = 1.0 + 0.05 * (-1.0) ** np.arange(61)
        plyform.identify("bias", {**curve, "load (N)": curve["load (N)"] * noise}, compliance=0, toe=0, **sizes)
    assert len(told) == 1 and "noise" in str(told[0].message)
    check_corrections(theory, curve, {**sizes, "compliance": 0})


def coefficients(found):
    return [found.numbers[f"k{k}"].value for k in (1, 3, 5)]


def check_corrections(theory, curve, known):
    """What a machine adds is refused, taken off, told; several specimens; measured angles; options that
    the command line has: as it finds them."""
    extension, load = curve.values()
    columns = list(curve)

    def with_load(values):
        return dict(zip(columns, (extension, values)))
    off = with_load(load + 0.03 * load.max())
    error = raised(plyform.CaseError, plyform.identify, "bias", off, **known)
    assert "load zero" in error.mistakes[0].rule
    found = plyform.identify("bias", off, zero="fit", **known)
    assert np.allclose(coefficients(found), [0.37044, 0.84105, 1.03113], rtol=1e-3)
    both = plyform.identify("bias", [with_load(0.9 * load), with_load(1.1 * load)], **known)
    assert len(set(both.fit["specimen"])) == 2 and min(both.numbers[f"k{k}"].limits for k in (1, 3, 5)) > 0.0
    slipped = {columns[0]: extension * 1.05, columns[1]: load, "shear angle (deg)": theory["shear_deg"]}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        angles = plyform.identify("bias", slipped, **{**known, "compliance": None})
    assert np.allclose(coefficients(angles), [0.37044, 0.84105, 1.03113], rtol=1e-6)
    raised(plyform.CaseError, plyform.identify, "bias", off, zero="none", **known)
    signs = plyform.identify("bias", curve, negative=[with_load(1.5 * load)], **known)
    assert "negative_polynomial" in signs.text or "table" in signs.text, signs.text
    names = [one["name"] for one in plyform.identify_tests()]
    assert len(names) == len(set(names)) == 14 and "compaction" in names


def check_page(folder):
    """The Python of docs/users/python.md, block after block, where a user would type it."""
    text = (source / "docs/users/python.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```", text, re.S)
    assert len(blocks) == 4 and len(re.findall(r"^\S", blocks[0], re.M)) <= 10, blocks[0]
    (folder / "cases").symlink_to(source / "cases")
    names, here = {"print": lambda *words: None}, Path.cwd()
    os.chdir(folder)
    try:
        for block in blocks:
            exec(compile(block, "docs/users/python.md", "exec"), names)
    finally:
        os.chdir(here)
    assert names["result"].status and (folder / "results/rough/summary.json").is_file()


def check_types():
    """The stub and the compiled part have the same names; everything has a docstring."""
    compiled = plyform._plyform
    stub = ast.parse((Path(plyform.__file__).parent / "_plyform.pyi").read_text(encoding="utf-8"))
    told = set()
    for item in stub.body:
        if not isinstance(item, (ast.ClassDef, ast.FunctionDef)):
            continue
        told.add(item.name)
        there = getattr(compiled, item.name)
        assert there.__doc__.strip() and (isinstance(item, ast.ClassDef)
                                          or "\n\n" in there.__doc__), item.name
        if isinstance(item, ast.ClassDef):
            parts = {part.name for part in item.body if isinstance(part, ast.FunctionDef)}
            for name in parts:
                assert inspect.getdoc(getattr(there, name)), f"{item.name}.{name}"
            missing = {name for name in vars(there) if not name.startswith("_")} - parts
            assert not missing, f"not in the stub: {missing}"
    assert told == {name for name in vars(compiled) if not name.startswith("_")} - {"version"}
    for name in plyform.__all__:
        thing = getattr(plyform, name)
        assert thing.__doc__, name
        if inspect.isfunction(thing):
            assert "return" in thing.__annotations__, name
        elif inspect.isclass(thing) and thing.__module__ != compiled.__name__:
            for part, value in vars(thing).items():
                if not part.startswith("_") and (callable(value) or isinstance(value, property)):
                    assert value.__doc__, f"{name}.{part}"
    assert (Path(plyform.__file__).parent / "py.typed").is_file()
    told = subprocess.run([program, "version"], check=True, capture_output=True, text=True).stdout
    assert told.split() == ["plyform", plyform.version] and plyform.__version__ == plyform.version


with tempfile.TemporaryDirectory() as name:
    root = Path(name)
    folders = {}
    for part in ("values", "mistakes", "run", "memory", "flight", "stops", "fits", "page"):
        folders[part] = root / part
        folders[part].mkdir()
    check_types()
    check_values(folders["values"])
    check_mistakes(folders["mistakes"])
    first = check_run(folders["run"])
    check_difference(folders["run"], first)
    check_memory(folders["memory"])
    check_start()
    check_flight(folders["flight"])
    check_stops(folders["stops"])
    check_fits(folders["fits"])
    check_page(folders["page"])
print("all of the module's tests passed")
