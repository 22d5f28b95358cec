# SPDX-License-Identifier: GPL-3.0-or-later
"""Spoils valid files by their structure and has the Python readers read them: they give a result, or
the one error that says what is wrong, and come back.

    fuzz_readers.py TOOLS [--tries N | --seconds S] [--seed K] [--only KIND]

The same seed spoils the same. A failure prints kind and seed: --seed K --tries 1 --only KIND does it
again. Leaves with 77 when a package is missing.
"""

import argparse
import contextlib
import io
import json
import os
import random
import shutil
import signal
import sys
import tempfile
import time
import traceback
import warnings
from pathlib import Path

try:
    import h5py
    import jinja2  # noqa: F401
    import meshio  # noqa: F401
    import scipy  # noqa: F401
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)

sys.dont_write_bytecode = True
import exchange_meshes  # puts TOOLS onto the path
import made_run
import numpy as np
import spoil

import area_means
import compare
from base.ending import NotReached, Trouble
from base.summary_file import read_summary
from exchange.formed import read_formed
from exchange.layup import Layup, map_all, own_layup
from exchange.outline import read_outline
from exchange.part_files import check_size, placed, read_part
from exchange.states import read_states
from exchange.write_abaqus import abaqus_files
from exchange.write_acp import acp_files
from exchange.write_csv import csv_files
from exchange.write_drape import openradioss_files, optistruct_files
from exchange.write_gltf import glb_of
from exchange.write_lsdyna import lsdyna_files
from plotting.reading import SHEAR, read_history, read_state
from reporting.page import page_of
from reporting.reading_run import read_run
from studies.figures import figures_of
from studies.study_file import read_study

MOST_S = 60  # of a try, on a busy machine; those that are too slow take minutes
STUDY = """title = "A study"
case = "case.toml"
method = "grid"
set = ["solver.outputs=1"]
run_name = "friction {friction}"
[figures]
punch_N = "tools.punch.force_N"
shear = "2.0 * max plies.*.max_shear_deg"
[limits]
punch_N = { at_most = 116, where = { friction = { at_most = 0.3 } } }
[stops]
"part of it" = "P"
[table]
"force, N" = "{punch_N:.1f}"
[reference]
factors = { "solver.duration" = 2.0 }
fields = ["shear"]
[area_means]
radius = 10.0
[[vary]]
name = "friction"
key = "contact.friction"
values = [0.1, 0.2]
[[vary]]
name = "force"
key = "tool.2.force"
range = [1.0, 100.0]
count = 3
scale = "log"
[[run]]
name = "other"
values = { friction = 0.2 }
against = "case"
[[picture]]
kind = "window"
x = "friction"
y = "force"
[[picture]]
kind = "cost"
file = "cost.svg"
"""


def read_h5(run):
    stack = read_formed(run)
    for ply in stack.plies:
        layup = own_layup(ply, "x", "a state")
        for files in (csv_files, abaqus_files, acp_files, lsdyna_files, optistruct_files,
                      openradioss_files):
            files(layup)
    for state in read_states(run, "all"):
        glb_of(state)
    read_state(run, SHEAR, -1, True)
    area_means.table(area_means.compare(run, run, 10.0, 1))
    page_of([read_run(run)])


def read_tables(run):
    page_of([read_run(run)])
    told, names = [compare.read_run(run, compare.read_reference(run))], ["run"]
    for table in (compare.difference_table, compare.ply_table, compare.force_table,
                  compare.run_table, compare.remarks):
        table(told, names)
    history = read_history(run)
    figures_of({"a": "max history.punch_force_N", "b": "jump late.fibre_mJ", "c": "plies.*.name",
                "d": "sum pairs_with_tools.*.deepest_mm", "e": "tools.punch.force_N"},
               read_summary(run, ()), run)
    assert history


def read_a_study(folder):
    study = read_study(folder / "study.toml")
    assert all(isinstance(text, str) and "\n" not in text for text in study.mistakes.texts())


def read_a_part(path, ply):
    mesh = placed(read_part(path), 1.0, [0, 0, 0], [0, 0, 0])
    check_size(mesh, [ply])
    plies, _ = map_all([ply], mesh, 5.0, 0.5, False)
    layup = Layup(mesh, plies, "x", "a state", False)
    for files in (csv_files, abaqus_files, acp_files, lsdyna_files, optistruct_files):
        files(layup)


class Bench:
    """Valid files, and how each kind is spoilt and read."""

    def __init__(self, folder: Path):
        self.folder, self.sound = folder, made_run.write(folder / "sound")
        self.ply = exchange_meshes.dome_ply(0.0, 20.0, 6)
        mesh = exchange_meshes.disc(40.0, False)
        self.parts = {ending: text(mesh) for ending, text in exchange_meshes.TEXTS.items()}
        meshio.vtu.write(folder / "part.vtu", meshio.Mesh(mesh.nodes, [("quad", mesh.corners)]),
                         binary=False)
        self.parts[".vtu"] = (folder / "part.vtu").read_text(encoding="utf-8")
        for ending, text in self.parts.items():  # what is not spoilt is read
            (folder / f"part{ending}").write_text(text, encoding="utf-8")
            read_a_part(folder / f"part{ending}", self.ply)
        (folder / "case.toml").write_text("[contact]\nfriction = 0.2\n", encoding="utf-8")

    def kinds(self) -> list[str]:
        return ["h5", "h5 bytes", "summary", "history", "study", "outline", *self.parts]

    def run(self):
        run = self.folder / "run"
        shutil.rmtree(run, ignore_errors=True)
        shutil.copytree(self.sound, run)
        return run

    def attempt(self, kind: str, chance: random.Random) -> None:
        if kind in ("h5", "h5 bytes"):
            run = self.run()
            if kind == "h5":
                with h5py.File(run / "results.h5", "r+") as file:
                    spoil.hdf5(file, chance)
            else:
                spoil.some_bytes(run / "results.h5", chance)
            read_h5(run)
        elif kind in ("summary", "history"):
            run, name = self.run(), {"summary": "summary.json", "history": "history.csv"}[kind]
            text = spoil.json_text(made_run.summary(), chance) if kind == "summary" else \
                spoil.words(made_run.HISTORY, chance, ",")
            (run / name).write_bytes(text)
            read_tables(run)
        elif kind == "study":
            (self.folder / "study.toml").write_bytes(spoil.toml(STUDY, chance))
            read_a_study(self.folder)
        elif kind == "outline":
            points = "".join(f"{x},{y}\n" for x, y in ((0, 0), (9, 0), (9, 9), (5, 12), (0, 9)))
            (self.folder / "trim.csv").write_bytes(spoil.words("x,y\n" + points, chance, ","))
            read_outline(self.folder / "trim.csv", False)
        else:
            path = self.folder / f"part{kind}"
            path.write_bytes(spoil.words(self.parts[kind], chance, "" if kind in (".k", ".bdf", ".cdb")
                                         else ","))
            read_a_part(path, self.ply)


class TooLong(BaseException):
    """No reader may take it for a fault of a file."""


def too_long(*_):
    raise TooLong(f"longer than {MOST_S} s")


def outcome(bench: Bench, kind: str, seed: int) -> str:
    """result or refused; anything else is a fault, and is told."""
    signal.signal(signal.SIGALRM, too_long)
    signal.alarm(MOST_S)
    try:
        with contextlib.redirect_stderr(io.StringIO()), contextlib.redirect_stdout(io.StringIO()):
            bench.attempt(kind, random.Random(f"{kind} {seed}"))
        return "result"
    except (Trouble, NotReached) as problem:
        return "refused" if "\n" not in str(problem) else f"two lines: {problem}"
    except (Exception, TooLong):
        return traceback.format_exc()
    finally:
        signal.alarm(0)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tools")
    parser.add_argument("--tries", type=int, default=0)
    parser.add_argument("--seconds", type=float, default=0.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    np.seterr(all="ignore")
    counts, faults, begin = {}, 0, time.monotonic()
    with tempfile.TemporaryDirectory() as name:
        bench = Bench(Path(name))
        kinds = [options.only] if options.only else bench.kinds()
        number = 0
        while number < options.tries or time.monotonic() - begin < options.seconds:
            kind, seed = kinds[number % len(kinds)], options.seed + number // len(kinds)
            number += 1
            told = outcome(bench, kind, seed)
            word = told if told in ("result", "refused") else "fault"
            counts[kind, word] = counts.get((kind, word), 0) + 1
            if word == "fault":
                faults += 1
                print(f"{kind} --seed {seed} --tries 1 --only '{kind}'\n{told}", flush=True)
    used = os.times()
    print(json.dumps({f"{kind}: {word}": count for (kind, word), count in sorted(counts.items())}))
    print(f"{number} tries, {faults} faults, {sum(used[:4]):.0f} s of processor time, "
          f"{time.monotonic() - begin:.0f} s on the clock")
    sys.exit(1 if faults else 0)


main()
