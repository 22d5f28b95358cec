# SPDX-License-Identifier: GPL-3.0-or-later
"""Of tools/study what runs nothing: study files and their mistakes, plans.

    study_file_test.py TOOLS_FOLDER CASES_FOLDER PLYFORM

Leaves with 77 when a package is missing.
"""

from pathlib import Path

from study_scene import CASE, FRICTION, Scene, call, check_all, program  # puts tools/ on the path

import numpy as np
from studies import plan, study_file


def planned(scene: Scene, study: str) -> list:
    scene.write(study)
    read = study_file.read_study(scene.folder / "study.toml")
    assert not read.mistakes.found, read.mistakes.texts()
    return plan.Planner(read, scene.program, "version", 1).runs(scene.results)


DRAWN = """case = "case.toml"
method = "METHOD"
runs = 8
[[vary]]
name = "angle"
each = "ply.*.angle"
range = [-90, 90]
[[vary]]
key = "solver.duration"
range = [0.01, 1.0]
scale = "log"
"""

LIST = """case = "case.toml"
method = "list"
presets = ["draft"]
[[vary]]
name = "angles"
keys = ["ply.0.angle", "ply.1.angle"]
values = [[0, 90], [0, 45]]
[[vary]]
key = "blanks.*.element_size"
factors = [0.5, 1.0]
[[run]]
name = "odd one"
set = ["contact.friction=0.0"]
"""


def check_plans(folder: Path) -> None:
    """What is run, without running it."""
    scene = Scene(folder / "plans")
    for method in ("sobol", "latin hypercube"):
        runs = planned(scene, DRAWN.replace("METHOD", method))
        drawn = np.array([list(run.values.values()) for run in runs])
        assert drawn.shape == (8, 3) and list(runs[0].values) == ["angle 1", "angle 2",
                                                                  "solver.duration"]
        for column, low, high in zip(drawn.T, (-90, -90, -2), (90, 90, 0)):
            column = np.log10(column) if low == -2 else column
            strata = np.floor((column - low) / (high - low) * 8 - 1e-6)
            assert sorted(strata) == list(range(8)), (method, strata)  # one in each eighth
        assert runs[0].settings[0].startswith("ply.0.angle=")
    few = planned(scene, DRAWN.replace("METHOD", "sobol"))
    more = planned(scene, DRAWN.replace("METHOD", "sobol").replace("runs = 8", "runs = 9"))
    assert [run.name for run in more[:8]] == [run.name for run in few]  # one run more
    runs = planned(scene, LIST)
    assert [run.settings for run in runs] == [
        (), ("ply.1.angle=90", "blanks.square.element_size=5.0"), (),
        ("contact.friction=0.0",)], runs
    assert runs[0].accuracy == "draft" and runs[0].values["angles"] == [0.0, 45.0]
    named = LIST.replace("ply.0.", "ply.ply1.").replace("ply.1.", "ply.ply2.")
    assert named != LIST and [run.settings for run in planned(scene, named)] == \
        [run.settings for run in runs]  # items by name are those by number
    (scene.folder / "case.toml").write_text(CASE + "# changed\n", encoding="utf-8")
    assert not {run.name for run in planned(scene, LIST)} & {run.name for run in runs}


WRONG = {  # what is put in the place of what, and the one message that comes
    ('case = "case.toml"', 'case = "none.toml"'): "study.toml:1: error: case = 'none.toml': there",
    ('case = "case.toml"\n', ""): "study.toml:1: error: case: is missing; give the case file",
    ("values", "valeus"): "study.toml:8: error: vary.0.valeus: unknown key; did you mean values?",
    ("[0.1, 0.2", "[0.2, 0.2"): "study.toml:8: error: vary.0.values.1 = 0.2: stands twice",
    ("values = [", "range = ["): "study.toml:8: error: vary.0.range: must be [LOW, HIGH]",
    ("values = [0.1, 0.2, 0.3, 0.4]", "range = [0.1, 0.4]"): "vary.0.count: is missing; say",
    ("values = [0.1, 0.2, 0.3, 0.4]", "values = []"): "vary.0.values: must have at least one",
    ("[figures]", "[figurs]"): "figurs: unknown key; did you mean figures?",
    ('"tools.', '"most tools.'): "study.toml:3: error: figures.punch_N: must be a path",
    ("[[vary]]", "[limits]\nforce = 3\n[[vary]]"): "limits.force: there is no force; there are",
    ("[[vary]]", "[[picture]]\nkind = 'cost'\n[[vary]]"): "picture.0.kind = 'cost': needs errors",
    ("[[vary]]", "[reference]\nfields = [['shear']]\n[[vary]]"):
    "reference.fields.0: must be",
    ("[[vary]]", "[reference]\n[[picture]]\nkind = 'cost'\nfigure = 'punch'\n[[vary]]"):
    "picture.0.figure = 'punch': is no figure of the study; name one of",
    ("[[vary]]", "[reference]\n[[picture]]\nkind = 'cost'\nx = 'steps'\n[[vary]]"):
    "picture.0.x = 'steps': must be one of wall_time_s, cpu_s",
    ("[figures]", "method = 'gird'\n[figures]"): "study.toml:2: error: method = 'gird': must be",
    ("[figures]", "set = ['3']\n[figures]"): "study.toml:2: error: set.0: must be a text KEY=VALUE",
    ('key = "contact', 'keys = "contact'): "vary.0.keys = 'contact.friction': must be a list",
    ("values = [0.1", "values = [9, 0.1"): "study.toml:8: error: vary.0.values.0: does not fit "
    "the case: contact.friction = 9: must not be that; give less",
    ('"contact.friction"', '"tools.*.force"'): "vary.0.key = 'tools.*.force': fits no key",
    ("values = ", "values = = "): "study.toml:8:10: error: Invalid value; write it as TOML does",
    ("values = [0.1, 0.2, 0.3, 0.4]", "range = [0.1, 0.4]\ncount = 1000000000"):
    "study.toml:9: error: vary.0.count = 1000000000: must be a whole number from 2 to 100000",
    ("values = [0.1", "values = [1" + 400 * "0"): "vary.0.values.0: must be a number",
    ("[[vary]]", "[table]\nforce = '{punch_N:s}'\n[[vary]]"): "{punch_N:s} has no form of a number",
    ("[[vary]]", "[table]\nforce = '{punch_N:.999999999f}'\n[[vary]]"): "has no form of a number",
    ('name = "friction"', 'name = "status"'): "status is a column of every",
    **{("[[vary]]", "[[picture]]\nkind = 'scatter'\nx = 'punch_N'\ny = 'shear_deg'\nfile = "
        f"'{name}'\n[[vary]]"): f"study.toml:9: error: picture.0.file = '{name}': must be a file's"
       for name in ("../x.png", "/x.png", "a.exe", ".x.png", "x/y.png", "table.csv", "..png")},
}


def check_mistakes(folder: Path) -> None:
    scene = Scene(folder / "mistakes")
    scene.order({"contact.friction=9": "refuse"})
    for (before, after), message in WRONG.items():
        assert before in FRICTION, before
        scene.write(FRICTION.replace(before, after, 1))
        told = scene.call()
        lines = told.err.strip().splitlines()
        assert told.code == 2 and message in lines[0], (before, after, told)
        assert len(lines) == 1, lines
    assert not scene.calls() and not scene.results.exists()
    told = call(program, scene.folder / "nothing.toml", "--program", scene.program)
    assert told.code == 1 and told.err.count("\n") <= 1 and "nothing.toml" in told.err, told


if __name__ == "__main__":
    check_all(check_plans, check_mistakes)
