# SPDX-License-Identifier: GPL-3.0-or-later
"""tools/check_predictions.py with a program that makes results up.

    check_predictions_test.py TOOLS_FOLDER

Leaves with 77 when a package is missing.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import h5py  # noqa: F401
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)

TOOL = Path(sys.argv[1]) / "check_predictions.py"

# One degree is predicted with the scene's own elements; scenes of a ply are two degrees off.
PROGRAM = '''#!/usr/bin/env python3
import json, sys
from pathlib import Path
words = sys.argv[1:]
if words[0] == "version":
    print("plyform made-up")
elif words[0] == "difference":
    print("field,rms\\\\nshear_angle_deg," + ("2.0" if "one_ply" in words[1] else "0.5"))
elif "contact.friction=0.9" in words:
    sys.exit("plyform: made-up trouble")
else:
    told = {"status": "done", "message": "", "steps": 7, "tools": [], "plies": [],
            "elements": 800 if "blanks.a.element_size=1" in words else 50,
            "accuracy": {"promised_shear_error_deg": 1.0}}
    folder = Path(words[words.index("-o") + 1])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "summary.json").write_text(json.dumps(told))
'''

SCENES = """
reference = ["blanks.a.element_size=1"]
[[scene]]
name = "two plies"
case = "case.toml"
[[scene]]
name = "one ply"
case = "case.toml"
"""


def call(folder: Path, *words) -> subprocess.CompletedProcess:
    return subprocess.run([sys.executable, TOOL, folder / "scenes.toml", "-o", folder / "out",
                           "--program", folder / "program", *map(str, words)],
                          capture_output=True, text=True, check=False)


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "program").write_text(PROGRAM.replace("\\\\n", "\\n"), encoding="utf-8")
        (folder / "program").chmod(0o755)
        (folder / "case.toml").write_text("[blanks.a]\nelement_size = 4.0\n", encoding="utf-8")
        (folder / "scenes.toml").write_text(SCENES, encoding="utf-8")
        text = folder / "text.md"
        text.write_text("<!-- table: scenes -->\nold\n<!-- end -->\n", encoding="utf-8")
        done = call(folder, "--doc", text)
        assert done.returncode == 0, done
        filled = text.read_text(encoding="utf-8")
        for row in ("| two plies | 50 | 7 | done | 1.00° | 0.50° |",
                    "| one ply | 50 | 7 | done | 1.00° | 2.00° |",
                    "Of 2 scenes 1 are within what was predicted."):
            assert row in filled and row in done.stdout, (row, filled)
        (folder / "scenes.toml").write_text(SCENES + 'set = ["contact.friction=0.9"]\n',
                                            encoding="utf-8")
        done = call(folder)
        assert done.returncode == 1 and "one_ply-graded" in done.stderr, done
        assert "two plies" in done.stdout, done
        (folder / "scenes.toml").write_text(SCENES.replace("reference", "other"), encoding="utf-8")
        done = call(folder)
        assert done.returncode == 2 and "reference must be a list" in done.stderr, done
        done = call(folder, "--program", folder / "none")
        assert done.returncode == 2 and "none is no program; build it" in done.stderr, done


main()
