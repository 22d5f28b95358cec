# SPDX-License-Identifier: GPL-3.0-or-later
"""tools/check_bands.py with a program that makes results up.

    check_bands_test.py TOOLS_FOLDER

Leaves with 77 when a package is missing.
"""

import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import h5py  # noqa: F401
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)

TOOL = Path(sys.argv[1]) / "check_bands.py"

# Shear is 2 degrees rms apart; the force is 100 + 10 h^1.6 of elements of h times 4 mm.
PROGRAM = '''#!/usr/bin/env python3
import json, sys
from pathlib import Path
words = sys.argv[1:]
with (Path(__file__).parent / "calls.txt").open("a") as calls:
    print(*words, file=calls)
if words[0] == "version":
    print("plyform made-up")
elif words[0] == "keys":
    print("solver.fibre_softening\\\\n  number; default 1.0")
elif words[0] == "difference":
    print("field,ply,rms\\\\nshear_angle_deg,lower,2.0")
else:
    settings = dict(word.split("=", 1) for word in words if "=" in word)
    if settings.get("contact.friction") == "0.9" and "--verify" not in words:
        sys.exit("plyform: made-up trouble")
    force = 100.0 + 10.0 * (float(settings.get("blanks.a.element_size", "4")) / 4.0) ** 1.6
    told = {"status": "done", "message": "", "steps": 7,
            "tools": [{"name": "punch", "force_N": force}, {"name": "holder", "force_N": 60.0}],
            "plies": [{"name": "lower", "draw_in_mm": {"mean": 3.0}}]}
    if "--verify" in words:
        told["verification"] = {"figures": [
            {"name": "shear of lower", "unit": "deg", "value": 30.0, "band": 4.0},
            {"name": "force of punch", "unit": "N", "value": force, "band": 9.0},
            {"name": "force of holder", "unit": "N", "value": 60.0, "band": None,
             "no_band": "given: it is what pushes the tool"},
            {"name": "draw-in of lower", "unit": "mm", "value": 3.0, "band": None}]}
    folder = Path(words[words.index("-o") + 1])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "summary.json").write_text(json.dumps(told))
'''

CASE = """
[blanks.a]
element_size = 4.0
[solver]
duration = 0.1
"""

SCENES = """
[[scene]]
name = "as it is"
case = "case.toml"
"""


def call(folder: Path, *words) -> subprocess.CompletedProcess:
    return subprocess.run([sys.executable, TOOL, folder / "scenes.toml", "-o", folder / "out",
                           "--program", folder / "program", *map(str, words)],
                          capture_output=True, text=True, check=False)


def runs(folder: Path) -> list[str]:
    lines = (folder / "calls.txt").read_text(encoding="utf-8").splitlines()
    return [line for line in lines if line.startswith("run")]


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "program").write_text(PROGRAM.replace("\\\\n", "\\n"), encoding="utf-8")
        (folder / "program").chmod(0o755)
        (folder / "case.toml").write_text(CASE, encoding="utf-8")
        (folder / "scenes.toml").write_text(SCENES, encoding="utf-8")
        text = folder / "text.md"
        text.write_text("before\n<!-- table: scenes -->\nold\n<!-- end -->\nafter\n",
                        encoding="utf-8")
        done = call(folder, "--doc", text)
        assert done.returncode == 0, done
        first, second = runs(folder)
        assert "--verify" in first and "--verify" not in second, (first, second)
        for halved in ("blanks.a.element_size=2", "solver.duration=0.2",
                       "solver.fibre_softening=1"):  # not below 1
            assert halved in second.split() and halved not in first, (halved, second)
        rows = {row["figure"]: row
                for row in csv.DictReader((folder / "out/bands.csv").open(encoding="utf-8"))}
        assert abs(float(rows["shear of lower"]["error"]) - 2.0 / (1 - 2**-1.6)) < 1e-9, rows
        assert rows["shear of lower"]["inside"] == "1", rows
        # of the known order: the extrapolation finds the whole error, 10 N
        assert abs(float(rows["force of punch"]["error"]) - 10.0) < 1e-9, rows
        assert rows["force of punch"]["inside"] == "0", rows
        assert rows["draw-in of lower"]["band"] == "", rows  # not measured
        assert "force of holder" not in rows  # given: counts for none
        assert "Of all 2 figures with a band 50 % are inside; 0 have a band beyond" in done.stdout, done
        filled = text.read_text(encoding="utf-8")
        assert filled.startswith("before\n") and filled.endswith("after\n"), filled
        assert "old" not in filled and "Outside: as it is, force of punch" in filled, filled
        assert "50 % are inside" in filled and "(1 without)" in filled, filled

        assert call(folder).returncode == 0 and len(runs(folder)) == 2  # nothing anew
        (folder / "scenes.toml").write_text(
            SCENES + SCENES.replace("as it is", "rough") + 'set = ["contact.friction=0.9"]\n',
            encoding="utf-8")
        done = call(folder)
        assert done.returncode == 1 and "rough-halved" in done.stderr, done
        assert "made-up trouble" in done.stderr and "as it is" in done.stdout, done
        assert len(runs(folder)) == 4, runs(folder)  # the new scene's alone

        # a mesh from a file: each triangle in four
        (folder / "flat.off").write_text("OFF\n4 2 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n"
                                         "3 0 1 2\n3 0 2 3\n", encoding="utf-8")
        (folder / "meshed.toml").write_text('[blanks.a]\nmesh = "file"\nfile = "flat.off"\n'
                                            "[solver]\nduration = 0.1\n", encoding="utf-8")
        (folder / "scenes.toml").write_text(SCENES.replace("case.toml", "meshed.toml"),
                                            encoding="utf-8")
        assert call(folder).returncode == 0
        fine = (folder / "out/flat-halved.off").read_text(encoding="utf-8").split()
        assert fine[:3] == ["OFF", "9", "8"] and len(fine) == 4 + 3 * 9 + 4 * 8, fine
        assert "flat-halved.off" in runs(folder)[-1] and "flat-halved" not in runs(folder)[-2]

        for wrong, said in ((SCENES + SCENES, "there is another"), ("", "has no [[scene]]"),
                            (SCENES.replace("case.toml", "none.toml"), "none.toml is missing"),
                            (SCENES + "force = 3\n", "it takes name, case and set")):
            (folder / "scenes.toml").write_text(wrong, encoding="utf-8")
            done = call(folder)
            assert done.returncode == 2 and said in done.stderr, done
            assert "Traceback" not in done.stderr, done
        done = call(folder, "--program", folder / "none")
        assert done.returncode == 2 and "none is no program; build it" in done.stderr, done


main()
