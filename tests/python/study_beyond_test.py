# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies of cases/studies/stability: what is stable, chatters or stops, beyond the ranges of keys.

    study_beyond_test.py TOOLS_FOLDER CASES_FOLDER PLYFORM UNBOUNDED_RUN

Leaves with 77 when a package is missing.
"""

import csv
import json
import sys
from pathlib import Path

from study_scene import CASES, PLYFORM, call, check_all, program  # puts tools/ on the path

import numpy as np
from studies import plan, reach, results, study_file

UNBOUNDED = Path(sys.argv[4]).resolve()
STUDY = (CASES / "studies/stability/step.toml").read_text(encoding="utf-8")


def quick(folder: Path) -> Path:
    """The study of one ply with two steps only."""
    folder.mkdir()
    text = STUDY.replace('include = "', f'include = "{CASES}/studies/stability/') \
        .replace('"../../stability', f'"{CASES}/stability')
    for before, after in (("one_ply.toml\", ", "one_ply.toml\"] #"), ('["1 ply", ', '["1 ply"] #'),
                          ("[0.25, 0.5, 1.0, 1.2, 1.5]", "[0.5, 1.8]"),
                          ("[0.0125, 0.025, 0.05, 0.1, 0.2, 0.4]", "[0.1, 0.2]")):
        assert text.count(before) == 1, before
        text = text.replace(before, after)
    (folder / "step.toml").write_text(text, encoding="utf-8")
    return folder / "step.toml"


def check_runs(folder: Path) -> None:
    study = quick(folder / "runs")
    text = study.with_name("page.md")
    text.write_text("<!-- reach: step -->\n\n<!-- picture: step -->\n", encoding="utf-8")
    told = call(program, study, "--program", UNBOUNDED, "-o", folder / "out", "--doc", text)
    assert told.code == 0, told
    with open(folder / "out/table.csv", newline="", encoding="utf-8") as file:
        rows = {(float(row["solver.step_factor"]), float(row["contact.stiffness"])): row
                for row in csv.DictReader(file)}
    quiet, wild = rows[0.5, 0.1], rows[1.8, 0.1]
    assert quiet["within_limits"] == "1" and float(quiet["stroke_mm"]) == 45.0, quiet
    assert float(quiet["jump_N"]) < 15 and float(quiet["holder_least_N"]) > 140, quiet
    assert wild["status"] == "stopped" and wild["stop"] in ("B", "C", "N"), wild
    assert "stopped at step" in wild["message"] and wild["breaks"] == "stopped", wild
    filled = text.read_text(encoding="utf-8")
    assert f"| `solver.step_factor` 0.5 | up | 0.5 (×1), stopped {wild['stop']} at 1.8 |" in filled
    assert "| `contact.stiffness` 0.1 | up | 0.2 (×2), none seen |" in filled, filled
    assert (folder / "runs/page_step.png").stat().st_size > 5000


def check_refused(folder: Path) -> None:
    """plyform itself does not take a step that is too long."""
    told = call(program, quick(folder / "refused"), "--program", PLYFORM, "-o", folder / "none")
    assert told.code == 2 and "vary.1.values.1: does not fit the case: solver.step_factor" in \
        told.err, told


def put(folder: Path, die: np.ndarray, holder: np.ndarray, status: str = "done",
        message: str = "") -> None:
    folder.mkdir(parents=True)
    stroke = np.linspace(0, 10, len(die))
    rows = "".join(f"{s},{s},{d},{h}\n" for s, d, h in zip(stroke, die, holder))
    (folder / "history.csv").write_text(
        "time_s,stroke_mm,die_force_N,blank_holder_force_N\n" + rows, encoding="utf-8")
    (folder / "summary.json").write_text(json.dumps({"status": status}), encoding="utf-8")
    (folder / "ended.json").write_text(json.dumps({"status": status, "cpu_s": 1.0,
                                                   "message": message}), encoding="utf-8")


def judged(file: Path, folder: Path, die, holder, *end) -> tuple[str, str]:
    """What breaks, and the letter, of a run that left these forces."""
    study = study_file.read_study(file)
    planner = plan.Planner(study, UNBOUNDED, "version", 1)
    runs = planner.runs(folder)
    put(folder / "runs" / runs[0].name, die, holder, *end)
    row = results.rows_of(study, planner, runs, folder)[0]
    return row["breaks"], row["stop"]


def check_judgement(folder: Path) -> None:
    file = quick(folder / "judged")
    quiet, steady = -np.linspace(100.0, 180.0, 101), np.full(101, 150.0)
    for number, (at, by, off, broken) in enumerate((
            (80, 14.0, 0.0, ""), (80, 16.0, 0.0, "jump_N"), (20, 16.0, 0.0, ""),
            (80, 0.0, -14.0, ""), (80, 0.0, -16.0, "holder_N"), (80, 0.0, np.nan, "holder_N"))):
        die, holder = quiet.copy(), steady.copy()
        die[at] += by
        holder[90] += off
        found = judged(file, folder / f"{number}", die, holder)
        assert found == (broken, ""), (at, by, off, found)
    found = judged(file, folder / "stopped", quiet, steady, "stopped", "node 3 has gone through b")
    assert found == ("stopped", "P"), found


def check_reach(_folder: Path) -> None:
    row = {"key": "k", "own": 2.0, "last_within": 1.0, "next": 0.5, "breaks": "wide"}
    assert reach.cell(row) == "1 (×0.5), wide at 0.5"
    assert reach.cell(row | {"last_within": ""}) == "wide at 0.5"
    assert reach.cell(row | {"breaks": ""}) == "1 (×0.5), none seen"


if __name__ == "__main__":
    check_all(check_judgement, check_reach, check_refused, check_runs)
