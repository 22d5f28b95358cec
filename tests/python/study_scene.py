# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of tools/study share: its module, a scene with a made-up program.

Leaves with 77 when a package is missing. Arguments of the tests: TOOLS_FOLDER CASES_FOLDER PLYFORM
"""

import csv
import importlib.machinery
import importlib.util
import json
import shutil
import sys
import tempfile
import time
from pathlib import Path

try:
    import h5py  # noqa: F401
    import matplotlib  # noqa: F401
    import scipy  # noqa: F401
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)
if shutil.which("snakemake") is None:
    print("SKIPPED: no snakemake")
    sys.exit(77)

sys.dont_write_bytecode = True
TOOLS, CASES, PLYFORM = (Path(word).resolve() for word in sys.argv[1:4])
TESTS = Path(__file__).resolve().parent
sys.path.insert(0, str(TOOLS))
from program_call import call  # noqa: E402

LOADER = importlib.machinery.SourceFileLoader("study", str(TOOLS / "study"))
program = importlib.util.module_from_spec(importlib.util.spec_from_loader("study", LOADER))
LOADER.exec_module(program)

CASE = """[contact]
friction = 0.2
[blanks.square]
element_size = 10.0
[[tool]]
name = "punch"
[[tool]]
name = "die"
[[tool]]
name = "blank_holder"
force = 300.0
[[ply]]
name = "ply1"
angle = 0.0
[[ply]]
name = "ply2"
angle = 45.0
[solver]
duration = 0.1
"""

FRICTION = """case = "case.toml"
[figures]
punch_N = "tools.punch.force_N"
shear_deg = "plies.*.max_shear_deg"
[[vary]]
name = "friction"
key = "contact.friction"
values = [0.1, 0.2, 0.3, 0.4]
"""


class Scene:
    """A folder with a case, the made-up program, its orders, a study and its results."""

    def __init__(self, folder: Path, study: str = FRICTION):
        folder.mkdir()
        self.folder, self.program, self.results = folder, folder / "plyform", folder / "results"
        shutil.copy(TESTS / "study_program.py", self.program)
        self.program.chmod(0o755)
        (folder / "case.toml").write_text(CASE, encoding="utf-8")
        self.write(study)
        self.order({})

    def write(self, study: str) -> None:
        (self.folder / "study.toml").write_text(study, encoding="utf-8")

    def order(self, orders: dict) -> None:
        (self.folder / "orders.json").write_text(json.dumps(orders), encoding="utf-8")

    def words(self, *words) -> list[str]:
        return [str(self.folder / "study.toml"), "--program", str(self.program), "-o",
                str(self.results), *map(str, words)]

    def call(self, *words):
        return call(program, *self.words(*words))

    def calls(self) -> list[str]:
        """Settings of each run since the last time, in order of their text."""
        file = self.folder / "calls.txt"
        if not file.exists():
            return []
        lines = file.read_text(encoding="utf-8").splitlines()
        file.unlink()
        return sorted(lines)

    def rows(self, table: str = "table.csv") -> list[dict]:
        with open(self.results / table, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))


def check_all(*checks) -> None:
    with tempfile.TemporaryDirectory() as name:
        for check in checks:
            begin = time.monotonic()
            check(Path(name))
            print(f"{check.__name__}: {time.monotonic() - begin:.1f} s", flush=True)
