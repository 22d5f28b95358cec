# SPDX-License-Identifier: GPL-3.0-or-later
"""tools/study: with a program that makes results up (study_program.py), and with plyform.

    study_test.py TOOLS_FOLDER CASES_FOLDER PLYFORM

Leaves with 77 when a package is missing.
"""

import csv
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

from study_scene import CASES, FRICTION, PLYFORM, TOOLS, Scene, call, check_all, program

from studies.cost_picture import errors_of_figure


def wait_for(condition) -> None:
    for _ in range(400):
        if condition():
            return
        time.sleep(0.05)
    raise AssertionError("waited in vain")


def alive(words: str) -> bool:
    """Whether a process has these words in its command."""
    for file in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            if words in file.read_bytes().replace(b"\0", b" ").decode(errors="replace"):
                return True
        except OSError:
            pass
    return False


def check_goes_on(folder: Path) -> None:
    """Killed in the middle of a job of several runs: what has ended stays, the rest starts anew;
    nothing of it lives on. A failed and a stopped run are rows; a value more costs a run more."""
    scene = Scene(folder / "goes_on")
    scene.order({"contact.friction=0.3": "hang"})
    process = subprocess.Popen([sys.executable, TOOLS / "study",
                                *scene.words("--jobs", 1, "--runs-per-job", 4)],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    seen = scene.folder / "calls.txt"
    wait_for(lambda: seen.exists() and "friction=0.3" in seen.read_text(encoding="utf-8"))
    wait_for(lambda: [row["status"] for row in scene.rows()].count("done") == 2)  # while it goes on
    assert [row["status"] for row in scene.rows()].count("missing") == 2, scene.rows()
    told = json.loads((scene.results / "jobs.json").read_text(encoding="utf-8"))["study"]
    assert Path(told) == scene.folder / "study.toml", told
    process.kill()
    process.wait()
    wait_for(lambda: not alive(str(scene.program)))
    assert scene.calls() == ["", "contact.friction=0.1", "contact.friction=0.3"]
    scene.order({"contact.friction=0.3": "fail", "contact.friction=0.4": "stop"})
    told = scene.call()
    assert told.code == 1 and "1 of 4 runs is without results" in told.err, told
    assert "made-up trouble" in told.err and "4/4 runs" in told.err, told
    assert scene.calls() == ["contact.friction=0.3", "contact.friction=0.4"]
    rows = {row["friction"]: row for row in scene.rows()}
    assert [rows[value]["status"] for value in ("0.1", "0.2", "0.3", "0.4")] == [
        "done", "done", "failed", "stopped"], rows
    assert rows["0.2"]["line"] == "case" and float(rows["0.1"]["punch_N"]) == 108.0
    assert rows["0.1"]["shear_deg_upper"] == "39" and rows["0.3"]["punch_N"] == ""
    assert rows["0.4"]["message"] == "made up" and rows["0.4"]["cpu_s"] != ""
    scene.order({})
    scene.write(FRICTION.replace("0.4]", "0.4, 0.5]").replace('"friction"', '"sliding"'))
    assert scene.call().code == 1 and scene.calls() == ["contact.friction=0.5"]
    assert scene.call("--again").code == 0 and scene.calls() == ["contact.friction=0.3"]
    assert scene.call("--table").code == 0 and not scene.calls()
    assert not list(scene.results.glob("runs/*.running"))


GRID = """case = "case.toml"
method = "grid"
[figures]
punch_N = "tools.punch.force_N"
[limits]
punch_N = 116
[reference]
fields = []
[[vary]]
key = "contact.friction"
range = [0.1, 0.3]
count = 3
[[vary]]
name = "force"
key = "tool.2.force"
values = [100, 400]
[[picture]]
kind = "window"
x = "contact.friction"
y = "force"
[[picture]]
kind = "map"
x = "contact.friction"
y = "force"
figure = "punch_N"
[[picture]]
kind = "scatter"
x = "punch_N"
y = "largest_shear_deg"
"""


def check_grid(folder: Path) -> None:
    """Every combination, limits, pictures and which key moves what; pictures of nothing too."""
    scene = Scene(folder / "grid", GRID)
    scene.results.mkdir()
    assert "missing" in scene.call("--table").err and (scene.results / "window.png").is_file()
    told = scene.call()
    assert told.code == 0, told
    rows = [row for row in scene.rows() if row["line"] == "grid"]
    assert len(scene.calls()) == 7 and len(rows) == 6, rows
    outside = {(row["contact.friction"], row["force"]) for row in rows
               if row["within_limits"] == "0" and row["breaks"] == "punch_N"}
    assert outside == {("0.3", "400")}, outside
    for kind in ("window", "map", "scatter"):
        assert (scene.results / f"{kind}.png").stat().st_size > 5000
    ranks = {row["key"]: row for row in scene.rows("ranking.csv") if row["figure"] == "punch_N"}
    assert abs(float(ranks["contact.friction"]["effect"]) - 10.0) < 1e-6, ranks
    assert abs(float(ranks["force"]["effect"]) - 3.0) < 1e-6, ranks
    assert abs(float(ranks["force"]["explained"]) - 1.0) < 1e-6, ranks


TINY = """title = "Tiny"
case = "cases/bias_extension"
set = ["blanks.strip.element_size=25", "solver.duration=0.02", "solver.fibre_softening=300",
       "solver.outputs=1"]
presets = ["draft"]
[reference]
factors = { "solver.duration" = 2.0, "blanks.*.element_size" = 0.5 }
[[vary]]
name = "fibre softening"
key = "solver.fibre_softening"
values = [100, 300]
[[vary]]
name = "element size"
key = "blanks.*.element_size"
factors = [2.0]
[[picture]]
kind = "cost"
[[picture]]
kind = "cost"
file = "angle.png"
figure = "largest_shear_deg"
x = "cpu_s"
"""


def check_errors_of_figures(_: Path) -> None:
    rows = [{"line": "reference", "N": 8.0}, {"line": "case", "N": 7.0}, {"line": "run", "N": ""}]
    assert errors_of_figure("N", rows) == {1: 12.5}, errors_of_figure("N", rows)
    assert errors_of_figure("N", rows[1:]) == {} and errors_of_figure("other", rows) == {}


def check_plyform(folder: Path) -> None:
    """The real program: errors against the reference, and what is refused."""
    shutil.copytree(CASES, folder / "cases")
    study, results = folder / "tiny.toml", folder / "tiny"
    study.write_text(TINY, encoding="utf-8")
    # seen from here, while runs are called from the study's folder of results
    words = [os.path.relpath(study), "--program", PLYFORM, "-o", os.path.relpath(results)]
    told = call(program, *words)
    assert told.code == 0, told
    with open(results / "table.csv", newline="", encoding="utf-8") as file:
        rows = {row["line"]: row for row in csv.DictReader(file)}
    triangles = {line: int(row["elements"]) for line, row in rows.items()}
    assert len(rows) == 5 and triangles["reference"] == 4 * triangles["case"], triangles
    for line, row in rows.items():
        if line != "reference":
            assert 0 < float(row["rms_shear_error_deg"]) <= float(row["p99_shear_error_deg"]) <= \
                float(row["max_shear_error_deg"]), row
    assert rows["preset"]["fibre softening"] == "" and rows["case"]["fibre softening"] == "300"
    assert rows["element size"]["element size"] == "2" and (results / "cost.png").is_file()
    assert (results / "angle.png").is_file()
    times = {path: path.stat().st_mtime_ns for path in results.glob("runs/*/ended.json")}
    again = call(program, *words)
    assert again.code == 0 and again.out == told.out and "5/5 runs" in again.err, again
    assert times == {path: path.stat().st_mtime_ns for path in results.glob("runs/*/ended.json")}
    other = subprocess.run([PLYFORM, "chart", *words, "--table"], capture_output=True, text=True)
    assert other.returncode == 0 and other.stdout == told.out, other
    study.write_text(TINY.replace("[100,", "[0.1,"), encoding="utf-8")
    told = call(program, *words)
    assert told.code == 2 and "tiny.toml:11: error: vary.0.values.0: does not fit the case: " \
        "solver.fibre_softening = 0.1: " in told.err and told.err.count("\n") == 1, told
    with open(folder / "cases/fabrics/glass_plain_weave.toml", "a", encoding="utf-8") as fabric:
        fabric.write("# another\n")
    study.write_text(TINY, encoding="utf-8")
    told = call(program, *words, "--table")
    assert told.code == 1 and "missing" in told.err, told


if __name__ == "__main__":
    check_all(check_goes_on, check_grid, check_errors_of_figures, check_plyform)
