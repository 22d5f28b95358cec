# SPDX-License-Identifier: GPL-3.0-or-later
"""Files and names that mean harm, or are only odd: every Python program answers with one line and exit
code 1 or 2, writes nothing outside of its folder, and comes back.

    hostile_files_test.py TOOLS names|links|files|texts
"""

import importlib.machinery
import importlib.util

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import h5py
    import jinja2  # noqa: F401
    import scipy  # noqa: F401
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)

sys.dont_write_bytecode = True
import made_run
import numpy as np
import program_call

TOOLS = Path(sys.argv[1]).resolve()
TIME_S = 120  # of a program, on a machine that is busy; those that wait for ever wait longer
sys.path.insert(0, str(TOOLS))
programs = {}


class TooLong(BaseException):
    """No program may take it for a fault of a file."""


def too_long(*_):
    raise TooLong(f"it takes longer than {TIME_S} s")


def call(name, *words):
    """In this process, which has read its libraries once."""
    if name not in programs:
        loader = importlib.machinery.SourceFileLoader(name.replace(".", "_"), str(TOOLS / name))
        programs[name] = importlib.util.module_from_spec(
            importlib.util.spec_from_loader(loader.name, loader))
        sys.modules[loader.name] = programs[name]
        loader.exec_module(programs[name])
    signal.signal(signal.SIGALRM, too_long)
    signal.alarm(TIME_S)
    done = program_call.call(programs[name], *words)
    signal.alarm(0)
    return done


def start(name, *words, stdout):
    done = subprocess.run([sys.executable, TOOLS / name, *words], stdout=stdout, timeout=TIME_S,
                          stderr=subprocess.PIPE, check=False)
    return program_call.SimpleNamespace(code=done.returncode,
                                        err=done.stderr.decode("utf-8", "replace"))


def refused(done, *told):
    """One line that says it, and the exit code for it."""
    lines = [line for line in done.err.splitlines() if "Warning" not in line]
    assert done.code in (1, 2) and len(lines) == 1 and "Traceback" not in done.err, done
    assert "fault of plyform" not in done.err and all(word in done.err for word in told), (told, done)


def run_of(folder, name, **names):
    return made_run.write(folder / name, **names)


def readers(run):
    """Of every kind of reading: of all states, of one, of all fields, of the tables."""
    return [("report", run), ("map", run), ("export", run), ("compare.py", run),
            ("area_means.py", run, "--turn", "90"),
            ("plot.py", "history", run, "-o", run / "h.png"),
            ("plot.py", "plies", run, "-o", run / "p.png")]


def check_sound(folder):
    """What is right is read, by all."""
    run = run_of(folder, "sound")
    for words in readers(run):
        done = call(*words)
        assert done.code == 0, (words, done)
    assert (run / "map" / "lower.csv").is_file() and (run / "export" / "state.glb").is_file()
    assert call("export", run, "-o", folder / "elsewhere").code == 0
    assert (folder / "elsewhere" / "upper.vtkhdf").is_file()


def check_names(folder):
    """35, 36: names that lead out of a folder or end a line."""
    for k, name in enumerate(("../../../x", "/abs/x", "a\n*INCLUDE, INPUT=x", "..", ".x", "a\\b",
                              "a\u2028b", "x" * 300)):
        run = run_of(folder, f"name_{k}")
        with h5py.File(run / "results.h5", "r+") as file:
            file.attrs["plies"] = made_run.texts((name, "upper"))
        before = sorted(folder.rglob("*"))
        for words in readers(run)[:3]:
            refused(call(*words), "results.h5")
        assert sorted(folder.rglob("*")) == before
        summary = made_run.summary(plies=(name, "upper"))
        shutil.copy(folder / "sound" / "results.h5", run / "results.h5")
        (run / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
        for program in ("report", "compare.py"):
            refused(call(program, run), "summary.json")
    run = run_of(folder, "folder\nimport os; os.abort()\n*INCLUDE, INPUT=x")
    assert call("map", run, "--format", "csv,abaqus,acp,lsdyna,optistruct,openradioss",
                "-o", folder / "decks").code == 0
    for deck in (folder / "decks").iterdir():
        lines = deck.read_text(encoding="utf-8").splitlines()
        assert not any(line.startswith(("import os", "*INCLUDE")) for line in lines), deck
    compile((folder / "decks/acp_tables.py").read_text(encoding="utf-8"), "acp_tables.py", "exec")


def spoil_links(run, k):
    """37: bytes of other files, or none ever."""
    os.mkfifo(run / "pipe")
    (run / "secret").write_bytes(np.arange(96.0).tobytes())
    made_run.write_h5(run / "other.h5")
    with h5py.File(run / "results.h5", "r+") as file:
        ply = file["frames/000001/plies/lower"]
        del ply["shear_angle_deg"]
        if k == 0:
            ply.create_dataset("shear_angle_deg", (32,), "f8", external=[("secret", 0, 256)])
        elif k == 1:
            ply["shear_angle_deg"] = h5py.ExternalLink("other.h5", "/time_s")
        elif k == 2:
            ply["shear_angle_deg"] = h5py.ExternalLink("pipe", "/time_s")
        elif k == 3:
            ply["shear_angle_deg"] = h5py.SoftLink("/frames/000000/plies/lower/shear_angle_deg")
        elif k == 4:
            layout = h5py.VirtualLayout((32,), "f8")
            layout[:2] = h5py.VirtualSource("other.h5", "/time_s", (2,))
            ply.create_virtual_dataset("shear_angle_deg", layout)
        elif k == 5:
            ply["shear_angle_deg"] = file["frames/000000/plies/lower/shear_angle_deg"]
        elif k == 6:
            file["frames/000001/plies/lower/loop"] = file["frames"]
        elif k == 7:
            ply.create_dataset("shear_angle_deg", (10**12,), "f8", chunks=(1024,))
        elif k == 8:
            del file["frames/000001"]
            file["frames/000001"] = h5py.ExternalLink("states/000001.h5", "/frames/000001")
    if k == 8:
        (run / "states").mkdir()
        (run / "states/000001.h5").symlink_to(run / "other.h5")


def check_links(folder):
    for k in range(9):
        run = run_of(folder, f"links_{k}")
        spoil_links(run, k)
        for words in readers(run)[:5]:
            refused(call(*words), "results.h5 cannot be read as results of plyform")
        assert not (run / "export").exists() and not (run / "map").exists()
    run = run_of(folder, "goes_on")  # a run in progress has its states beside it
    (run / "states").mkdir()
    made_run.write_h5(run / "states/000001.h5")
    with h5py.File(run / "results.h5", "r+") as file:
        del file["frames/000001"]
        file["frames/000001"] = h5py.ExternalLink("states/000001.h5", "/frames/000001")
    assert call("report", run).code == 0


def put_odd(path, kind):
    path.unlink(missing_ok=True)
    if kind == "pipe":
        os.mkfifo(path)
    elif kind == "sparse":
        with open(path, "wb") as file:
            file.truncate(10 << 30)
    elif kind == "kernel":
        path.symlink_to("/proc/kmsg")
    elif kind == "folder":
        path.mkdir()
    elif kind == "device":
        path.symlink_to("/dev/zero")
    elif kind == "latin":
        path.write_bytes(b'title = "\xe9"\n')
    elif kind == "zeros":
        path.write_bytes(bytes(1000))


ODD = ("pipe", "sparse", "kernel", "folder", "device", "latin", "zeros")


def check_odd_files(folder):
    """40: what is no file, has no end, or is no text."""
    for kind in ODD:
        for name in ("results.h5", "summary.json", "history.csv"):
            run = run_of(folder, f"odd_{kind}_{name}")
            put_odd(run / name, kind)
            words = ("plot.py", "history", run, "-o", run / "h.png") if name == "history.csv" else \
                ("report", run)
            refused(call(*words), name)
        for ending in (".inp", ".bdf", ".k", ".cdb", ".vtu"):
            put_odd(folder / f"{kind}{ending}", kind)
            if ending == ".inp" or kind in ("pipe", "kernel"):
                refused(call("map", folder / "sound", "--onto", folder / f"{kind}{ending}"))
        put_odd(folder / f"{kind}.toml", kind)
        done = call("study", folder / f"{kind}.toml", "--program", "/bin/true", "-o",
                    folder / "out")
        if kind == "kernel":  # a file of no bytes, without the two tables that it needs
            assert done.code == 2 and "kernel.toml:1: error: case: is missing" in done.err, done
        else:
            refused(done, f"{kind}.toml")
        put_odd(folder / f"{kind}_case.toml", kind)
        (folder / "study.toml").write_text(f'case = "{kind}_case.toml"\n[[vary]]\nkey = "a.b"\n'
                                           "values = [1]\n", encoding="utf-8")
        done = call("study", folder / "study.toml", "--program", "/bin/true", "-o",
                    folder / "out")
        assert done.code in (1, 2) and "Traceback" not in done.err, done
        refused(call("check_bands.py", folder / f"{kind}.toml", "--program", "/bin/true", "-o",
                    folder / "out"), kind)
    refused(call("study", folder / "latin.toml", "--program", "/bin/true", "-o",
                    folder / "out"), "latin.toml:1:10: ")


def check_texts(folder):
    """39, 41: titles of scripts, damaged JSON, folders that are no text, full disks."""
    run = run_of(folder, "texts")
    summary = made_run.summary()
    summary["title"] = "a <!-- b </script> <script> c & d \u2028"
    (run / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
    assert call("report", run).code == 0
    page = (run / "report.html").read_text(encoding="utf-8")
    scene = page.split('id="scene">', 1)[1].split("</script>", 1)[0]
    assert not set("<>&\u2028") & set(scene) and json.loads(scene)["runs"][0]["title"] == \
        summary["title"]
    for text in ("", "[]", "{", '{"status": 1}', "[" * 100000, '{"status": NaN}', "\ufeff{}", "9" * 5000,
                 '{"title": "\\ud800"}', json.dumps({**summary, "plies": {}}),
                 json.dumps({**summary, "energy": {"shear": "much"}}),
                 json.dumps({**summary, "steps": True})):
        (run / "summary.json").write_text(text, encoding="utf-8")
        refused(call("report", run), "summary.json")
        refused(call("compare.py", run), "summary.json")
    odd = Path(os.fsdecode(os.fsencode(folder) + b"/odd\xff\x1bname"))
    shutil.copytree(folder / "sound", odd)
    for words in readers(odd)[:5]:
        done = start(*words, stdout=subprocess.DEVNULL)
        assert done.code == 0, (words, done)
    with open("/dev/full", "wb") as full:
        for words in readers(folder / "sound")[:5]:
            refused(start(*words, stdout=full), "No space left")
    refused(call("report", folder / "sound", "-o", "/dev/full/report.html"))


def check_faults_are_told(folder):
    """What is wrong with plyform itself says so, and shows its traceback only when asked."""
    program = folder / "program.py"
    program.write_text(f"import sys\nsys.path.insert(0, {str(TOOLS)!r})\n"
                       "from base.ending import ended\nended('program', lambda: {}['key'])\n",
                       encoding="utf-8")
    for env, there in (({}, False), ({"PLYFORM_TRACEBACK": "1"}, True)):
        done = subprocess.run([sys.executable, program], capture_output=True, text=True, check=False,
                              env={**os.environ, **env})
        assert done.returncode == 1 and "this is a fault of plyform" in done.stderr, done
        assert ("Traceback" in done.stderr) == there and (there or done.stderr.count("\n") == 1), done


def main():
    checks = (check_sound, check_names, check_links, check_odd_files, check_texts,
              check_faults_are_told)
    parts = {"names": (0, 1), "links": (0, 2), "files": (0, 3), "texts": (0, 4, 5)}[sys.argv[2]]
    with tempfile.TemporaryDirectory() as name:
        for part in parts:
            checks[part](Path(name))


main()
