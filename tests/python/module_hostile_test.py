# SPDX-License-Identifier: GPL-3.0-or-later
"""What must not bring down a Python that uses `plyform`: objects without contents, forks in callbacks,
folders with pipes in the place of files.

    module_hostile_test.py PACKAGE_FOLDER SOURCE_FOLDER
"""

import copy
import os
import pickle
import shutil
import signal
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, sys.argv[1])
SOURCE = Path(sys.argv[2])
import plyform  # noqa: E402
from plyform import _plyform  # noqa: E402

TIME_S = 300  # of all, on a machine that is busy; what hangs takes for ever


def small():
    return plyform.Case(SOURCE / "cases/picture_frame",
                        {"blanks.square.element_size": 50, "solver.duration": 0.0015,
                         "solver.outputs": 3})


def raises(kind, act, words=""):
    try:
        act()
    except kind as problem:
        assert words in str(problem), problem
        return
    raise AssertionError(f"{act} raises no {kind.__name__}")


def check_unfinished_objects():
    classes = [value for value in vars(_plyform).values() if isinstance(value, type)]
    assert len(classes) > 12, classes
    for one in classes:
        raises(TypeError, lambda one=one: one.__new__(one))
        raises(TypeError, lambda one=one: object.__new__(one))
        raises(TypeError, lambda one=one: one.__base__.__new__(one))
    frame = plyform.run(small(), 1).frame
    raises(TypeError, lambda: copy.copy(frame))
    raises(TypeError, lambda: pickle.dumps(frame))
    assert frame.stroke_mm >= 0.0


def check_forks():
    """A copy that comes back from a callback ends; the run goes on in the first process."""
    def end_of(act):
        ends = []

        def forks(_):
            if not ends:
                child = os.fork()
                if child == 0:
                    return act()
                ends.append(os.waitpid(child, 0)[1])
            return None
        result = plyform.run(small(), 2, frame=forks)
        assert result.status in ("done", "doubtful"), result
        return os.waitstatus_to_exitcode(ends[0])
    assert end_of(lambda: None) == 1  # says so to stderr
    assert end_of(lambda: sys.exit(7)) == 7
    assert end_of(lambda: sys.exit()) == 0
    assert end_of(lambda: {}["key"]) == 1


def check_outlook():
    outlook = small().outlook(1)
    assert "\n".join(outlook.lines) == str(outlook) and " object at " not in repr(outlook), outlook
    assert "steps" in repr(outlook), repr(outlook)


def check_folders(folder):
    plyform.run(small(), 1, folder / "run")
    for name, read in (("summary.json", plyform.read), ("history.csv", plyform.history)):
        for k, spoil in enumerate((os.mkfifo, os.mkdir, lambda path: path.symlink_to("/dev/zero"),
                                   lambda path: path.write_bytes(b"\xff"),
                                   lambda path: path.write_text("[" * 100000 + "\n1,2\n", encoding="utf-8"),
                                   lambda path: os.truncate(os.open(path, os.O_CREAT | os.O_RDWR),
                                                            10 << 30))):
            run = folder / f"{name}_{k}"
            shutil.copytree(folder / "run", run)
            (run / name).unlink()
            spoil(run / name)
            raises(plyform.Error, lambda read=read, run=run: read(run), name)


def main():
    signal.alarm(TIME_S)
    check_unfinished_objects()
    check_forks()
    check_outlook()
    with tempfile.TemporaryDirectory() as name:
        check_folders(Path(name))


main()
