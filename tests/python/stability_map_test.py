# SPDX-License-Identifier: GPL-3.0-or-later
"""tools/stability_map.py on a tiny grid with the real program.

    stability_map_test.py TOOLS CASES PROGRAM UNBOUNDED_RUN
"""

import csv
import sys
import tempfile
from pathlib import Path

try:
    import matplotlib  # noqa: F401
    import numpy as np
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

sys.dont_write_bytecode = True
tools, cases, program, beyond = map(Path, sys.argv[1:5])
sys.path[:0] = [str(tools), str(Path(__file__).parent)]
import program_call  # noqa: E402
import stability_map  # noqa: E402

ONE_PLY = ["--quick", "--cases", cases, "--only", "one_ply.toml"]


def states(table):
    with open(table, newline="", encoding="utf-8") as rows:
        return {float(row["solver.step_factor"]): row for row in csv.DictReader(rows)}


def check_runs(folder):
    table, picture = folder / "map.csv", folder / "map.png"
    told = program_call.call(stability_map, *ONE_PLY, "--program", program, "--beyond", beyond,
                             "--table", table, "-o", picture)
    assert told.code == 0, told.err
    found = states(table)
    assert found[0.5]["state"] == "stable", found[0.5]
    assert float(found[0.5]["jump"]) < 0.1 and float(found[0.5]["stroke_mm"]) == 45.0
    assert found[1.8]["state"] == "stopped" and found[1.8]["why"] in "BCN", found[1.8]
    assert "stopped at step" in found[1.8]["message"]
    limits = [line for line in told.out.splitlines() if "`solver.step_factor`" in line]
    assert len(limits) == 2 and limits[1].split(" | ")[3].startswith("0.5 (×1), stopped")
    assert picture.stat().st_size > 10000
    again = program_call.call(stability_map, *ONE_PLY, "--redraw", table, "-o", folder / "2.png")
    assert again.code == 0 and again.out == told.out, again.err
    assert (folder / "2.png").read_bytes() == picture.read_bytes()


def check_refused(folder):
    """Without --beyond a step that is too long is the case's mistake, not a failure of contact."""
    told = program_call.call(stability_map, *ONE_PLY, "--program", program, "--set",
                             "solver.duration=0.002", "--table", folder / "r.csv")
    assert told.code == 0, told.err
    assert states(folder / "r.csv")[1.8]["state"] == "refused"


def write_run(folder, die, holder, status="done", message=""):
    folder.mkdir()
    stroke = np.linspace(0.0, 10.0, len(die))
    rows = "".join(f"{s},{s},{d},{h}\n" for s, d, h in zip(stroke, die, holder))
    (folder / "history.csv").write_text("time_s,stroke_mm,die_force_N,blank_holder_force_N\n" + rows)
    (folder / "summary.json").write_text(
        '{"status": "%s", "message": "%s", "steps": 1, "stroke_mm": 10.0, "energy": '
        '{"balance_error": 0.0}, "contact": {"max_tool_penetration_mm": 0.0, '
        '"max_ply_penetration_mm": 0.0}}' % (status, message))
    return folder


def check_judgement(folder):
    quiet, steady = -np.linspace(100.0, 180.0, 101), np.full(101, 100.0)
    judged = stability_map.judge(write_run(folder / "quiet", quiet, steady))
    assert judged["state"] == "stable" and judged["jump"] < 1e-12
    for name, at, by, state in (("small", 80, 9.0, "stable"), ("large", 80, 11.0, "chatters"),
                                ("early", 20, 11.0, "stable")):
        die = quiet.copy()
        die[at] += by
        judged = stability_map.judge(write_run(folder / name, die, steady))
        assert judged["state"] == state, (name, judged)
    for by, state in ((-9.0, "stable"), (-11.0, "chatters"), (float("nan"), "chatters")):
        holder = steady.copy()
        holder[90] += by
        judged = stability_map.judge(write_run(folder / f"off{by}", quiet, holder))
        assert judged["state"] == state, (by, judged)
    judged = stability_map.judge(write_run(folder / "stopped", quiet, steady, "stopped",
                                           "ply a, node 3 has gone through ply b"))
    assert judged["state"] == "stopped" and judged["why"] == "P"


def check_mistakes(folder):
    assert program_call.call(stability_map).code == 2
    told = program_call.call(stability_map, *ONE_PLY, "--program", folder / "nosuch")
    assert told.code == 1 and "nosuch" in told.err, told


with tempfile.TemporaryDirectory() as name:
    for check in (check_judgement, check_mistakes, check_refused, check_runs):
        check(Path(name))
