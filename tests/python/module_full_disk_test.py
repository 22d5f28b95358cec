# SPDX-License-Identifier: GPL-3.0-or-later
"""A disk that fails while the module `plyform` writes a run: plyform.Error with the reason, and a
Python that ends in order. HDF5 has to tidy up there, in a program that is not ours.

    module_full_disk_test.py PACKAGE_FOLDER FAIL_CALL SOURCE_FOLDER
    module_full_disk_test.py run PACKAGE_FOLDER SOURCE_FOLDER FOLDER      # what it runs
"""

import subprocess
import sys
import tempfile
from pathlib import Path


def run(package, source, folder):
    sys.path.insert(0, package)
    import h5py  # noqa: F401  it uses the same HDF5
    import plyform
    case = plyform.Case(Path(source) / "cases/picture_frame",
                        {"blanks.square.element_size": 50, "solver.duration": 0.0015,
                         "boundary.0.stroke": 5, "solver.outputs": 2})
    try:
        plyform.run(case, threads=1, output=folder)
    except plyform.Error as error:
        print(error)
        sys.exit(4)


def called(fail_call, package, source, folder, call):
    """Exit code and output of a run whose `call` fails, and the calls that it made."""
    words = [sys.executable, "-W", "ignore", __file__, "run", package, source, folder / "run"]
    done = subprocess.run([fail_call, folder / "run", folder / "log", call, "EIO", *words],
                          capture_output=True, text=True)
    return done, (folder / "log").read_text().splitlines()


if sys.argv[1] == "run":
    run(*sys.argv[2:])
    sys.exit(0)
package, fail_call, source = sys.argv[1:]
with tempfile.TemporaryDirectory() as name:
    (Path(name) / "whole").mkdir()
    done, calls = called(fail_call, package, source, Path(name) / "whole", "none")
    if done.returncode == 77:
        print(done.stderr)
        sys.exit(77)
    assert done.returncode == 0, done.stderr
    # of the first state and of the last file, each kind of call once
    kinds = {}
    for line in calls:
        _, call, path = line.split()
        if path.startswith("states/000000") or path.startswith("results.h5"):
            kinds[call, path] = line
    assert len(kinds) > 10, kinds
    for at, ((call, path), line) in enumerate(kinds.items()):
        folder = Path(name) / str(at)
        folder.mkdir()
        done, _ = called(fail_call, package, source, folder, line)
        what = f"{call} {path}: exit code {done.returncode}, {done.stdout} {done.stderr}"
        if done.returncode != 0:  # a file that is not there need not be removed
            assert done.returncode == 4 and "Input/output error" in done.stdout, what
            assert not done.stderr and not list(folder.rglob("*.tmp")), what
print(f"{len(kinds)} calls failed, Python ended in order")
