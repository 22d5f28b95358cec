# SPDX-License-Identifier: GPL-3.0-or-later
"""Every command that the README and the pages for users name, in their order, as it stands there, with few
elements and short runs: each does what it says, or ends for the user's own files that are not there and for
nothing else.

    text_commands_test.py SOURCE PROGRAM
"""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

from texts import commands_of, pages

SOURCE, PROGRAM = (Path(argument).resolve() for argument in sys.argv[1:3])
SECONDS = 300
# What is not run here, and why; each has to stand in a text.
ELSEWHERE = {
    "tools/form.sh": "a system without packages, and minutes", "tools/test.sh": "this is one of its tests",
    "export PATH=": "the environment of this test", "tools/package.sh": "root, and a package made",
    "podman": "an image", "cp -r /usr/share/plyform/cases .": "an installation: tests/installed.sh",
    "cases/double_dome/draw_tools.py": "gmsh for a minute: MeshTool.formed",
    "tools/mesh_tool.py cases/double_dome/punch.step": "gmsh for minutes: MeshTool.offset",
    "tools/study cases/studies/": "hours",
    "tools/study STUDY.toml -o DIR --profile slurm": "a cluster",
    "mkdir -p ~/.config/snakemake": "a cluster", "cp -r tools/studies/profiles/slurm": "a cluster",
    "sed -i 's/sbatch ": "a cluster", "M=": "the shell's, for the next command",
}
# Names in the place of the user's own, and what stands for them here; others are missing.
MADE = {"CASE": "mine", "DIR2]": "", "[DIR2]": "", "DIR": "results/made", "REFERENCE": "results/made", "STUDY": "study.toml",
        "STUDY.toml": "study.toml", "OUTLINE": "trim.csv", "[--case": "", "CASE]": "", "TEXT.md": "text.md"}
MISSING = ("A.csv", "CURVE.csv", "STOP.csv", "RATIO_1.csv", "PART.step", "FABRIC.toml", "BASE.toml", "TEST")
CHEAP = ["--set=blanks.square.mesh_from=element_size", "--set=blanks.square.element_size=34",
         "--set=solver.duration=0.002", "--set=tool.punch.stroke=0.5", "--set=solver.outputs=2"]
STUDY = """case = "mine"
method = "list"
[[vary]]
key = "contact.friction"
values = [0.2]
"""


def elsewhere(text):
    return next((start for start in ELSEWHERE if text.startswith(start)), "")


def environment(folder):
    """A home of its own, plyform on the PATH, no display."""
    path = f"{PROGRAM.parent}:/usr/bin:/bin"
    return {"PATH": path, "HOME": str(folder / "home"), "LANG": "C.UTF-8", "XDG_STATE_HOME": str(folder / "home"),
            "PYTHONDONTWRITEBYTECODE": "1", "PYTHONPATH": str(PROGRAM.parents[1] / "python"),
            **{name: os.environ[name] for name in ("TMPDIR",) if name in os.environ}}


def prepare(folder):
    """As a clone after the first two commands, with a case, a run and files of the user's own."""
    for name in ("cases", "docs"):
        shutil.copytree(SOURCE / name, folder / name, symlinks=True)
    (folder / "tools").symlink_to(SOURCE / "tools")
    (folder / "home").mkdir()
    shutil.copytree(folder / "cases/hemisphere_0", folder / "mine")
    text = (folder / "mine/case.toml").read_text(encoding="utf-8").replace("../fabrics", "../cases/fabrics")
    for key, value in (("mesh_from", '"element_size"'), ("element_size", "34.0"), ("duration", "0.002"),
                       ("stroke", "0.5")):
        lines = [f"{key} = {value}" if line.split("=")[0].strip() == key else line for line in text.splitlines()]
        text = "\n".join(lines) + "\n"
    (folder / "mine/case.toml").write_text(text, encoding="utf-8")
    (folder / "study.toml").write_text(STUDY, encoding="utf-8")
    (folder / "text.md").write_text("<!-- table: study -->\n\n<!-- end -->\n", encoding="utf-8")
    (folder / "trim.csv").write_text("x,y\n-140,-140\n140,-140\n140,140\n-140,140\n", encoding="utf-8")
    (folder / "part.inp").write_text("*NODE\n1,-30,-30,0.3\n2,30,-30,0.3\n3,30,30,0.3\n4,-30,30,0.3\n"
                                     "*ELEMENT,TYPE=S4\n1,1,2,3,4\n", encoding="utf-8")
    for words in (["plyform", "run", "mine", "-o", "results/made", "--threads", "1"], ["tools/study", "study.toml"]):
        made = call(words, folder)
        assert made.returncode == 0, made
    for name in ("hemisphere_0", "hemisphere_five_ply", "A", "B"):
        shutil.copytree(folder / "results/made", folder / f"results/{name}")


def call(words, folder):
    return subprocess.run(words, cwd=folder, env=environment(folder), capture_output=True, text=True,
                          timeout=SECONDS, check=False, stdin=subprocess.DEVNULL)


def served(words, folder):
    """The workbench: it prints its address, and ends by Ctrl-C."""
    more = [] if "--no-browser" in words else ["--no-browser"]
    process = subprocess.Popen([*words, *more], cwd=folder, env=environment(folder), stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
    try:
        process.stdout.readline()
        address = process.stdout.readline()
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=60)
    finally:
        process.kill()
    assert address.startswith("http://127.0.0.1:"), (words, address, said)


def meant(command):
    """Its words with what stands for the user's own, and cheap settings."""
    words = [word for one in command.words if (word := MADE.get(one, one))]
    words = [word.replace("~", "home") if word.startswith("~") else word for word in words]
    words = [word for word in words if word != "..."]
    if words[:2] == ["plyform", "run"]:
        words += ["--threads", "1"] if "--threads" not in words else []
        words += CHEAP if words[2].startswith("cases/") else []
        at = words.index("--accuracy") if "--accuracy" in words else len(words)
        words = words[:at] + words[at + 2:]  # would take finer elements; it is parsed by check
    return words


def try_one(command, folder):
    """What became of it: done, or missing, for a file of the user's."""
    words = meant(command)
    if words[:2] == ["plyform", "studio"]:
        served(words, folder)
        return "done"
    done = call(words, folder)
    said = done.stdout + done.stderr
    lacking = [name for name in MISSING if any(word.startswith(name) for word in words)]
    if "..." in command.words:  # shortened in the text: other options come where the dots are
        lacking.append("is required")
    if lacking:
        assert done.returncode == 2, (command.place, words, done)
        assert any(name in said for name in (*lacking, "subcommand")) and "not expected" not in said, \
            (command.place, words, said)
        return f"needs {lacking[0]}"
    assert done.returncode == 0, (command.place, words, done)
    return "done"


def main():
    used = set()
    with tempfile.TemporaryDirectory() as where:
        folder = Path(where)
        prepare(folder)
        for page in pages(SOURCE):
            for command in commands_of(page):
                if start := elsewhere(command.text):
                    used.add(start)
                    continue
                print(f"{command.place}: {command.text}: {try_one(command, folder)}", flush=True)
    assert used == set(ELSEWHERE), f"stand in no text: {sorted(set(ELSEWHERE) - used)}"


if __name__ == "__main__":
    main()
