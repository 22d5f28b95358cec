# SPDX-License-Identifier: GPL-3.0-or-later
"""tools/real_cloth.py with a program that makes results up (real_cloth_program.py).

    real_cloth_test.py TOOLS_FOLDER

Leaves with 77 when h5py or matplotlib is missing.
"""

import csv
import json
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

try:
    import h5py  # noqa: F401
    import matplotlib  # noqa: F401
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)

TOOLS, TESTS = Path(sys.argv[1]).resolve(), Path(__file__).resolve().parent
sys.path.insert(0, str(TOOLS))
import real_cloth as program  # noqa: E402
from program_call import call  # noqa: E402
from sweeps import runs  # noqa: E402
from sweeps.sets import SETS  # noqa: E402
from sweeps.stacks import case_text  # noqa: E402


class Scene:
    """A folder with the made-up program, its orders and its results."""

    def __init__(self, folder: Path):
        folder.mkdir()
        self.program, self.results = folder / "plyform", folder / "results"
        self.calls_file, self.orders_file = folder / "calls.txt", folder / "orders.json"
        shutil.copy(TESTS / "real_cloth_program.py", self.program)
        self.program.chmod(0o755)
        (folder / "tests_folder").write_text(str(TESTS), encoding="utf-8")
        self.order({})

    def order(self, orders: dict) -> None:
        self.orders_file.write_text(json.dumps(orders), encoding="utf-8")

    def words(self, *words) -> list[str]:
        return [*map(str, words), "--program", str(self.program), "-o", str(self.results)]

    def call(self, *words):
        return call(program, *self.words(*words))

    def calls(self) -> list[list[str]]:
        """Name and words of each call since the last time."""
        if not self.calls_file.exists():
            return []
        lines = self.calls_file.read_text(encoding="utf-8").splitlines()
        self.calls_file.unlink()
        return [json.loads(line) for line in lines]

    def made(self) -> list[str]:
        return [name for name, *_ in self.calls()]


def wait_for(condition) -> None:
    for _ in range(300):
        if condition():
            return
        time.sleep(0.1)
    raise AssertionError("waited in vain")


def check_goes_on(folder):
    """Killed on its way: what has ended stays, what was under way starts anew."""
    scene = Scene(folder / "goes_on")
    scene.order({"plateau_0.1": {"hang": 1}})
    process = subprocess.Popen([sys.executable, TOOLS / "real_cloth.py",
                                *scene.words("buckling", "--jobs", 1)],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    hanging = scene.results / "runs"
    wait_for(lambda: scene.calls_file.exists() and
             "plateau_0.1" in scene.calls_file.read_text(encoding="utf-8"))
    process.kill()
    process.wait()
    assert not (hanging / "plateau_0.1").exists() and (hanging / "plateau_0.05").is_dir()
    scene.calls()
    scene.order({})
    done = scene.call("buckling", "--jobs", 2)
    assert done.code == 0, done
    assert sorted(scene.made()) == ["default", "plateau_0.1", "plateau_0.2", "plateau_0.4",
                                    "plateau_0.8"]
    assert not list(hanging.glob("*.running.*"))
    assert "8 of 8 runs are there" in scene.call("buckling").err and not scene.made()
    scene.call("buckling", "--only", "plateau_0.2", "--again")
    assert scene.made() == ["plateau_0.2"]
    scene.call("buckling", "--only", "plateau_0.2", "--set", "solver.duration=0.2")
    assert scene.made() == ["plateau_0.2"]  # as it was made with other settings
    assert "not there" in scene.call("buckling", "--report").out and not scene.made()


def check_ends(folder):
    """A stopped run has ended; one without results has not, and others go on."""
    scene = Scene(folder / "ends")
    scene.order({"accuracy_draft": {"stopped": 1}, "accuracy_standard": {"fail": 1}})
    done = scene.call("accuracy", "--jobs", 1)
    assert done.code == 1 and "made-up trouble" in done.err and len(scene.made()) == 4, done
    assert "stopped at 40.0 mm: made up" in done.out, done.out
    assert "**fails**: every run reaches its full stroke" in done.out, done.out
    scene.order({})
    assert scene.call("accuracy").code == 0 and scene.made() == ["accuracy_standard"]
    other = subprocess.run([sys.executable, TOOLS / "real_cloth.py", "box", "-o",
                            folder / "none", "--program", folder / "nothing"],
                           capture_output=True, text=True)
    assert other.returncode == 1 and "is no program" in other.stderr, other


def check_words(folder):
    """What the program is told."""
    scene = Scene(folder / "words")
    scene.call("fabric", "--only", "46_0.5_8_0.1")
    scene.call("free")
    scene.call("accuracy", "--only", "draft")
    (fabric, free, draft) = scene.calls()
    assert "contact.friction=0.1" in fabric and fabric[fabric.index("--threads") + 1] == "1"
    (given,) = [word for word in fabric if word.startswith("fabrics.glass=")]
    text = Path(json.loads(given.split("=", 1)[1])).read_text(encoding="utf-8")
    for key in ("compression_stiffness = 46.0\n", "\nbending_stiffness = 0.5\n",
                "in_plane_bending_stiffness = 8.0\n", "\nstiffness = 4"):
        assert text.count(key) == 2, (key, text)
    case = Path(free[2]).read_text(encoding="utf-8")
    assert "blank_holder" not in case and case.count("[[tool]]") == 2 and "[contact]" in case
    assert 'contact.self="on"' in free and draft[draft.index("--accuracy") + 1] == "draft"
    plateau = {e.run.name: dict(e.run.yarns) for e in SETS["buckling"]().entries}
    assert plateau["plateau_0.2"] == {"buckling_force": 0.8} and plateau["default"] == {}
    fixed, drawn = case_text(5, 3, 10.0), case_text(5, 3, 10.0, friction="random")
    angles = [[line for line in text.splitlines() if line.startswith("angle")]
              for text in (fixed, drawn)]
    assert angles[0] == angles[1] and len(angles[0]) == 5 and drawn.count("[[contact.pair]]") == 4
    again, other = (case_text(5, seed, 10.0, friction="random") for seed in (3, 4))
    assert drawn == again != other


def check_tables(folder):
    scene = Scene(folder / "tables")
    scene.order({"plateau_0": {"shift": 1.5}})
    out = scene.call("buckling").out
    head, _, first, *rest = [line.split(" | ") for line in out.splitlines()
                             if line.startswith("|")]
    assert head[:2] == ["| run", "status"] and "rms by ply, °" in head and len(rest) == 7, head
    assert first[0] == "| plateau 0 N/mm" and first[-1] == "1.5 1.5 1.5 |", first
    assert first[4] == "44 45 46" and first[6:11] == [
        "321", "0, 0", "-0.20", "0.070 / 0.080", "0.110 / 0.125"], first
    assert out.count("**holds**") == 7 and "**fails**" not in out, out
    with open(scene.results / "buckling.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 8 and rows[0]["name"] == "plateau_0" and rows[-1]["name"] == "default"
    for key, value in (("status", "done"), ("steps", "100"), ("apart_deg_3", "1.5"),
                       ("max_shear_deg_1", "44.4"), ("ply_deepest_mm", "0.125"),
                       ("pressed_2", "0.1"), ("x", "0")):
        assert rows[0][key] == value, (key, rows[0][key])
    mesh = scene.call("mesh").out  # the same mesh three times: jumps do not fall
    assert "**fails**: the jump falls" in mesh and "jump by ply" in mesh, mesh


def check_verdicts(folder):
    """What is too large fails, and what is not a number, too; what is missing stays open."""
    scene = Scene(folder / "verdicts")
    for order, word in (({"balance_error": None}, "balance"), ({"balance_error": -0.02}, "balance"),
                        ({"crossing": 1}, "no pair of triangles"), ({"crossing": None}, "no pair"),
                        ({"deepest": 0.16}, "at most 0.15 mm between plies ever"),
                        ({"deepest": None}, "at most 0.15 mm between plies ever"),
                        ({"pressed": 0.03}, "with C 460"), ({"pressed": None}, "with C 460"),
                        ({"stopped": 1}, "every run reaches its full stroke")):
        scene.order({"460_2_8_0.1": order})
        out = scene.call("fabric", "--only", "460_2_8_0.1", "--again").out
        failing = [line for line in out.splitlines() if "**fails**" in line]
        assert len(failing) == 1 and word in failing[0], (order, out)
        assert "**open, 37 missing**" in out or word.startswith("every"), out
    scene.order({"default_nudged": {"shift": 0.6}})
    out = scene.call("repeat", "--only", "default_nudged").out
    assert "**open, 1 missing**: the default fabric twice" in out, out
    out = scene.call("repeat", "--only", "default").out
    assert "**fails**: the default fabric twice" in out and "0.6 in default fabric" in out, out


def check_text(folder):
    """Tables and pictures in a text, twice the same."""
    scene = Scene(folder / "text")
    scene.call("buckling")
    scene.call("fabric", "--only", "460_2_*")
    text = folder / "text" / "page.md"
    text.write_text("# Page\n\n<!-- table: buckling -->\n\nbetween\n\n"
                    "<!-- picture: fabric -->\nformer words\n<!-- end -->\n\n"
                    "<!-- picture: buckling -->\nlast\n", encoding="utf-8")
    assert call(program, "--tables", text, "-o", scene.results).code == 0
    filled = text.read_text(encoding="utf-8")
    for words in ("| plateau 0.8 N/mm |", "\nbetween\n", "(page_fabric.png)", "\nlast\n",
                  "(page_buckling.png)"):
        assert filled.count(words) == 1, (words, filled)
    assert "former" not in filled and (folder / "text" / "page_fabric.png").stat().st_size > 5000
    call(program, "--tables", text, "-o", scene.results)
    assert text.read_text(encoding="utf-8") == filled
    text.write_text("<!-- table: nothing -->\n", encoding="utf-8")
    assert call(program, "--tables", text, "-o", scene.results).code == 1


def check_lock(folder):
    scene = Scene(folder / "lock")
    runner = runs.Runner(scene.program, runs.Folder(scene.results), 1)
    scene.results.mkdir()
    with open(scene.results / ".lock", "w", encoding="utf-8") as lock:
        runs.fcntl.flock(lock, runs.fcntl.LOCK_EX)
        try:
            runner.run_all([], False)
        except runs.Trouble as trouble:
            assert "another command" in str(trouble)
        else:
            raise AssertionError("two commands ran into one folder")


def main():
    with tempfile.TemporaryDirectory() as name:
        for check in (check_words, check_goes_on, check_ends, check_tables, check_verdicts,
                      check_text, check_lock):
            check(Path(name))


main()
