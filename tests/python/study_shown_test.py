# SPDX-License-Identifier: GPL-3.0-or-later
"""Of tools/study what it makes of results: figures, area means, limits and their verdicts,
tables in a text, pictures of plies. The results are made up and put where runs would have left them.

    study_shown_test.py TOOLS_FOLDER CASES_FOLDER PLYFORM

Leaves with 77 when a package is missing.
"""

import json
import random
import shutil
from pathlib import Path

from study_scene import CASES, PLYFORM, Scene, check_all  # puts tools/ on the path

import numpy as np
import plot_folders
from studies import plan, results, study_file
from studies.figures import figures_of

PLIES = ["ply1", "ply2", "ply3"]
FABRIC = """name = "cloth"
[warp]
stiffness = 4600.0
compression_stiffness = 46.0
[weft]
stiffness = 4800.0
compression_stiffness = 46.0
"""
COMMON = """[area_means]
[figures]
shear_deg = "plies.*.max_shear_deg"
balance_percent = "100 * energy.balance_error"
crossing = "sum contact.intersections_*_plies"
deepest_mm = "max pairs_of_plies.*.deepest_mm"
tool_mm = "max pairs_with_tools.*.deepest_mm"
[limits]
balance_percent = { at_least = -1, at_most = 1, text = "balance within 1 %" }
crossing = 0
deepest_mm = 0.2
[table]
status = "{status}"
"shear by ply" = "{shear_deg:.0f}"
balance = "{balance_percent:.2f}"
"area means" = "{area_means_deg:.1f}"
"deep: plies / tools" = "{deepest_mm:.3f} / {tool_mm:.3f}"
"""
STUDY = """include = "common.toml"
title = "Limp and stiff"
case = "case.toml"
method = "grid"
run_name = "C {C}, friction {friction}"
[reference]
values = { C = 460, friction = 0.2 }
fields = []
[[vary]]
name = "friction"
key = "contact.friction"
values = [0.2, 0.4]
[[vary]]
name = "C"
keys = ["fabrics.glass.warp.compression_stiffness", "fabrics.glass.weft.compression_stiffness"]
values = [460, 46]
names = ["460", "46"]
[[run]]
name = "turned"
values = { C = 46, friction = 0.4 }
set = ["ply.0.angle=1e-6"]
against = "C 46, friction 0.4"
quarter_turns = 1
[limits.near]
figure = "area_means_deg"
at_most = 2.0
where = [{ C = "46", friction = { at_most = 0.3 } }, { run = "turned" }]
[limits.like]
figure = "shear_deg"
distance_to = "C 460, friction 0.2"
at_most = 3
where = { friction = 0.2 }
[limits.half]
figure = "shear_deg_ply1"
ratio_to = "C 460, friction 0.2"
at_least = 1.0
"""
PICTURE = """[[picture]]
kind = "plies"
x = "friction"
figures = ["area_means_deg", "shear_deg"]
"""


def summary(order: dict) -> dict:
    return {
        "status": "done", "message": "", "stroke_mm": 75, "steps": 100, "elements": 96,
        "wall_time_s": 1.5,
        "plies": [{"name": name, "angle_deg": 0.0, "max_shear_deg": 44.4 + i + order.get("more", 0)}
                  for i, name in enumerate(PLIES)],
        "energy": {"balance_error": order.get("balance", -0.002)},
        "contact": {"intersections_between_plies": order.get("crossing", 0),
                    "intersections_within_plies": 0},
        "pairs": [{"a": "punch", "b": "ply3", "deepest_mm": 0.08},
                  {"a": "ply2", "b": "ply3", "deepest_mm": 0.09},
                  {"a": "ply1", "b": "ply2", "deepest_mm": order.get("deepest", 0.125)}]}


def put(folder: Path, order: dict) -> None:
    """What a run leaves behind."""
    x0, triangles = plot_folders.grid(8, 100.0)
    along = x0[triangles].mean(axis=1)
    shear = 20.0 * np.sin(along[:, 0] / 30.0) * np.sin(along[:, 1] / 30.0) + order.get("shift", 0.0)
    shutil.rmtree(folder, ignore_errors=True)
    plot_folders.write(folder, {ply: (x0, x0, triangles, shear) for ply in PLIES})
    (folder / "summary.json").write_text(json.dumps(summary(order)), encoding="utf-8")
    status = order.get("status", "done")
    (folder / "ended.json").write_text(json.dumps({"status": status, "cpu_s": 1.0}),
                                       encoding="utf-8")


class Shown(Scene):
    """A study with results by the labels of its runs, without the time that running takes."""

    def __init__(self, folder: Path):
        super().__init__(folder, STUDY)
        (folder / "common.toml").write_text(COMMON, encoding="utf-8")
        (folder / "fabric.toml").write_text(FABRIC, encoding="utf-8")
        case = (folder / "case.toml").read_text(encoding="utf-8")
        (folder / "case.toml").write_text('fabrics.glass = "fabric.toml"\n' + case,
                                          encoding="utf-8")

    def plan(self) -> tuple:
        study = study_file.read_study(self.folder / "study.toml")
        planner = plan.Planner(study, self.program, "plyform made-up", 1)
        runs = planner.runs(self.results)
        results.check_columns(study, planner)
        assert not study.mistakes.found, study.mistakes.texts()
        return planner, {run.label: run for run in runs}

    def made(self, orders: dict) -> None:
        for label, run in self.plan()[1].items():
            if orders.get(label) is None:
                put(self.results / "runs" / run.name, orders.get(label) or {})
            elif orders[label] != "missing":
                put(self.results / "runs" / run.name, orders[label])
            else:
                shutil.rmtree(self.results / "runs" / run.name, ignore_errors=True)

    def table(self, orders: dict, *words) -> tuple:
        self.made(orders)
        told = self.call("--table", *words)
        return told, {row["setting"]: row for row in self.rows()}


def check_fabric(folder: Path) -> None:
    """Keys inside a fabric file: what it has is not set again; `values` name a run of the grid."""
    planner, runs = Shown(folder / "fabric").plan()
    warp, weft = (f"fabrics.glass.{yarns}.compression_stiffness" for yarns in ("warp", "weft"))
    assert {label: run.settings for label, run in runs.items()} == {
        "C 460, friction 0.2": (f"{warp}=460", f"{weft}=460"),
        "C 46, friction 0.2": (),
        "C 460, friction 0.4": ("contact.friction=0.4", f"{warp}=460", f"{weft}=460"),
        "C 46, friction 0.4": ("contact.friction=0.4",),
        "turned": ("ply.0.angle=1e-6", "contact.friction=0.4")}, runs
    assert planner.reference_name == runs["C 460, friction 0.2"].name
    assert runs["C 46, friction 0.2"].values == {"friction": 0.2, "C": "46"}
    assert planner.base.keys("fabrics.*.w*.stiffness") == [
        "fabrics.glass.warp.stiffness", "fabrics.glass.weft.stiffness"]


def check_verdicts(folder: Path) -> None:
    scene = Shown(folder / "verdicts")
    told, rows = scene.table({"C 46, friction 0.2": {"shift": 1.5, "more": -2},
                              "C 460, friction 0.4": {"shift": 4.0}})
    assert told.code == 0, told
    assert told.out.count("holds: ") == 5 and told.out.count("fails: ") == 1, told.out
    assert "fails: half at least 1: 1 of 5, 0.955 in C 46, friction 0.2" in told.out, told.out
    assert "holds: balance within 1 % (-0.2 to -0.2, 5 judged)" in told.out
    assert "holds: near at most 2 (1.5 at most, 2 judged)" in told.out, told.out
    assert "holds: like at most 3 (2 at most, 2 judged)" in told.out, told.out
    row = rows["C 46, friction 0.2"]
    assert row["against"] == "C 460, friction 0.2", row
    assert abs(float(row["area_means_deg_ply2"]) - 1.5) < 1e-8, row
    assert float(row["deepest_mm"]) == 0.125 and float(row["tool_mm"]) == 0.08
    assert row["breaks"] == "half" and rows["turned"]["breaks"] == "", rows
    assert float(rows["turned"]["area_means_deg_ply1"]) < 1e-9  # the field is even under the turn
    for order, words in (({"balance": None}, "balance within 1 %: 1 of 5, nan in turned"),
                         ({"balance": 0.02}, "balance within 1 %: 1 of 5, 2 in turned"),
                         ({"crossing": 1}, "crossing at most 0: 1 of 5, 1 in turned"),
                         ({"crossing": None}, "crossing at most 0: 1 of 5, nan in turned"),
                         ({"deepest": 0.3}, "deepest_mm at most 0.2: 1 of 5, 0.3 in turned"),
                         ({"shift": 2.5}, "near at most 2: 1 of 2, 2.5 in turned")):
        told, _ = scene.table({"turned": order})
        assert told.out.count("fails: ") == 1 and f"fails: {words}" in told.out, (order, told.out)
    told, rows = scene.table({"turned": {"status": "stopped"}})
    assert "fails: crossing at most 0: 1 of 5, 0 in turned" in told.out, told.out
    assert "area_means_deg_ply1" not in rows["turned"] or not rows["turned"]["area_means_deg_ply1"]
    told, _ = scene.table({"C 46, friction 0.4": "missing"})
    assert told.code == 1 and "open, 1 missing: near at most 2" in told.out, told.out
    (scene.results / "runs" / scene.plan()[1]["turned"].name / "results.h5").unlink()
    for memory in scene.results.glob("runs/*/area-means-*"):
        memory.unlink()
    told = scene.call("--table")
    assert "results.h5 is missing" in scene.rows()[-1]["message"], scene.rows()[-1]


def check_text(folder: Path) -> None:
    """Tables and pictures between marks, twice the same."""
    scene = Shown(folder / "text")
    scene.write(STUDY + PICTURE)
    text = scene.folder / "page.md"
    text.write_text("# Page\n\n<!-- table: study -->\n\nbetween\n\n<!-- picture: study -->\nwas\n"
                    "<!-- end -->\n\n<!-- table: other -->\n\nkept\n\n<!-- end -->\n",
                    encoding="utf-8")
    told, _ = scene.table({"C 46, friction 0.2": {"shift": 1.5}}, "--doc", text)
    assert told.code == 0, told
    filled = text.read_text(encoding="utf-8")
    for words in ("| run | status | shear by ply | balance | area means | deep: plies / tools |",
                  "| C 46, friction 0.2 | done | 44 45 46 | -0.20 | 1.5 1.5 1.5 | 0.125 / 0.080 |",
                  "| C 460, friction 0.2 | done | 44 45 46 | -0.20 | – | 0.125 / 0.080 |",
                  "\n- **holds**: balance within 1 % (-0.2 to -0.2, 5 judged)\n", "\nbetween\n",
                  "![Limp and stiff](page_study.png)", "<!-- table: other -->\n\nkept\n"):
        assert filled.count(words) == 1, (words, filled)
    assert "\nwas\n" not in filled and (scene.folder / "page_study.png").stat().st_size > 5000
    scene.call("--table", "--doc", text)
    assert text.read_text(encoding="utf-8") == filled
    text.write_text("<!-- table: other -->\n", encoding="utf-8")
    told = scene.call("--table", "--doc", text)
    assert told.code == 1 and "write a line <!-- table: study -->" in told.err, told


def check_history(folder: Path) -> None:
    """Largest jump and bounds, over all outputs and from half of the stroke on."""
    stroke = np.linspace(0.0, 10.0, 101)
    force = -np.linspace(100.0, 180.0, 101)
    force[[20, 80]] += 11.0, 7.0
    (folder / "history").mkdir()
    (folder / "history/history.csv").write_text(
        "time_s,stroke_mm,die_force_N\n" + "".join(
            f"{s},{s},{f}\n" for s, f in zip(stroke, force)), encoding="utf-8")
    wanted = {"all": "jump history.die_force_N", "late": "0.1 * jump late.die_force_N",
              "most": "max late.die_force_N", "none": "max late.nothing"}
    found = figures_of(wanted, {"status": "done"}, folder / "history")
    expected = {"all": 11.0, "late": 0.7, "most": force[50]}
    assert found.keys() == expected.keys(), found
    assert all(abs(found[name] - value) < 1e-9 for name, value in expected.items()), found


WRONG = {
    ('at_most = 2.0', 'at_mots = 2.0'): "study.toml:26: error: limits.near.at_mots: unknown key;",
    ('figure = "area_means_deg"', 'figure = "area"'): "limits.near.figure: there is no area; there",
    ('run = "turned"', 'rum = "turned"'): "limits.near.where: there is no rum; there are run, line",
    ('"common.toml"', '"none.toml"'): "study.toml:1: error: include = 'none.toml': cannot be read",
    ('C = 460, f', 'D = 460, f'): "reference.values: there is no [[vary]] D; there are friction, C",
    ('"C {C}, f', '"C {D}, f'): "study.toml:5: error: run_name: there is no [[vary]] D; there are",
    ('"460", "46"]', '"460"]'): "study.toml:17: error: vary.1.names: must have as many items as",
    ('against = "C 46, ', 'against = "C 4, '): "run.0.against = 'C 4, friction 0.4': is no run of",
    ('quarter_turns = 1', 'quarter_turns = 4'): "run.0.quarter_turns = 4: must be 0, 1, 2 or 3",
    ('ratio_to = "C 460, friction 0.2"', 'ratio_to = "C"'): "limits.half.ratio_to = 'C': is no run",
    ('x = "friction"\n', ''): "picture.0.x: is missing; name a vary or a figure"}


def check_mistakes(folder: Path) -> None:
    scene = Shown(folder / "mistakes")
    for (before, after), message in WRONG.items():
        assert before in STUDY + PICTURE, before
        scene.write((STUDY + PICTURE).replace(before, after, 1))
        told = scene.call()
        assert told.code == 2 and message in told.err, (after, told)
    scene.write(STUDY)
    common = scene.folder / "common.toml"
    for before, after, message in (
            ("{status}", "{state}", "common.toml:13: error: table.status: there is no state;"),
            ("crossing = 0", "crosing = 0", "common.toml:10: error: limits.crosing: there is no"),
            ('"sum contact', '"sum of contact', "common.toml:5: error: figures.crossing: must be")):
        common.write_text(COMMON.replace(before, after), encoding="utf-8")
        told = scene.call()
        assert told.code == 2 and message in told.err, (after, told)


def check_shipped(_folder: Path) -> None:
    """Every shipped study reads without mistakes and names what its table has; the random stacks
    are those of their seeds."""
    files = [file for file in (CASES / "studies").rglob("*.toml") if file.name != "common.toml"]
    assert len(files) > 20, files
    for file in files:
        study = study_file.read_study(file)
        planner = plan.Planner(study, PLYFORM, "version", 1)
        runs = planner.runs(Path("none"))
        results.check_columns(study, planner)
        assert not study.mistakes.found and runs, study.mistakes.texts()
    study = study_file.read_study(CASES / "studies/real_cloth/stack_5.toml")
    runs = plan.Planner(study, PLYFORM, "version", 1).runs(Path("none"))
    draw = random.Random(3005)
    angles = [round(draw.uniform(-90.0, 90.0), 1) for _ in range(5)]
    frictions = [round(draw.uniform(0.05, 0.4), 3) for _ in range(5)]
    wanted = [f"ply.{i}.angle={angle}" for i, angle in enumerate(angles)]
    wanted += [f"contact.friction={frictions[0]}"]
    wanted += [f"contact.pair.{i}.friction={value}" for i, value in enumerate(frictions[1:])]
    assert runs[2].label == "5 plies, seed 3" and set(wanted) <= set(runs[2].settings), runs[2]


if __name__ == "__main__":
    check_all(check_fabric, check_verdicts, check_text, check_history, check_mistakes,
              check_shipped)
