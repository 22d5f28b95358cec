#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the predicted error of shear angles holds: each scene of a list is run as it is and again
with the settings of a reference, and the difference of the two stands beside the prediction.

    check_predictions.py SCENES.toml [-o DIR] [--jobs N] [--program PLYFORM] [--doc TEXT]

SCENES.toml has `reference`, a list of KEY=VALUE, and tables [[scene]] as check_bands.py reads them.
The difference is the root mean square over all plies (plyform difference). DIR [results/NAME of
SCENES.toml] gets a folder a run. What has ended is not repeated. --doc fills the table into a text
in Markdown, between <!-- table: NAME --> and <!-- end -->.

Exit codes: 0 done; 1 a run is missing, was stopped, or cannot be read; 2 wrong arguments or scenes.
"""

import argparse
import csv
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

try:
    from base.ending import Mistake, ended
    from base.files import read_toml
    from base.program import find_program
    from base.summary_file import SOUND
    from check_bands import (Run, do_run, fill, folder_of, parsed, parser_of, read_scenes, summary_of,
                             version_of)
    from compare import table
    from plotting.reading import Trouble
except ImportError as error:
    sys.exit(f"check_predictions.py: error: {error}; install python3-h5py")


def reference_of(file: Path) -> tuple[str, ...]:
    settings = read_toml(file).get("reference")
    if not isinstance(settings, list) or not all(isinstance(text, str) for text in settings):
        raise Mistake(f"{file}: reference must be a list of texts KEY=VALUE")
    return tuple(settings)


def difference(program: Path, run: Run, reference: Run) -> float:
    """Of shear angles, degrees rms."""
    done = subprocess.run([program, "difference", run.folder, reference.folder],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Trouble(done.stderr.strip())
    return next(float(row["rms"]) for row in csv.DictReader(done.stdout.splitlines())
                if row["field"] == "shear_angle_deg")


def row_of(program: Path, run: Run, reference: Run) -> list:
    """Name, triangles, steps, status, predicted and measured error."""
    coarse, fine = summary_of(run), summary_of(reference)
    for one, summary in ((run, coarse), (reference, fine)):
        if summary.get("status") not in SOUND:
            raise Trouble(f"{one.folder}: {summary.get('message') or 'is missing'}")
    return [run.scene.name, coarse["elements"], coarse["steps"], coarse["status"],
            coarse["accuracy"]["promised_shear_error_deg"], difference(program, run, reference)]


def markdown(rows: list[list]) -> str:
    inside = sum(row[-1] <= row[-2] for row in rows)
    shown = [[*(str(cell) for cell in row[:4]), f"{row[4]:.2f}°", f"{row[5]:.2f}°"] for row in rows]
    head = ["scene", "triangles", "steps", "status", "predicted", "measured"]
    return (table(head, shown, 1) +
            f"\n\nOf {len(rows)} scenes {inside} are within what was predicted.")


def check(options: argparse.Namespace) -> int:
    program, scenes = find_program(options.program), read_scenes(options.scenes)
    reference = reference_of(options.scenes)
    folder = (options.output or Path("results") / options.scenes.stem).resolve()
    version = version_of(program)

    def run(scene, kind: str, more: tuple[str, ...]) -> Run:
        settings = ("solver.outputs=1", *scene.settings, *more)
        return Run(scene, folder / folder_of(scene, kind, settings, version), settings, False)

    pairs = [(run(scene, "graded", ()), run(scene, "reference", reference)) for scene in scenes]
    with ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(lambda one: do_run(one, program), [one for pair in pairs for one in pair]))
    rows, missing = [], []
    for pair in pairs:
        try:
            rows.append(row_of(program, *pair))
        except Trouble as problem:
            missing.append(str(problem))
    for line in missing:
        print(f"check_predictions.py: {line}", file=sys.stderr)
    if not rows:
        return 1
    print(markdown(rows))
    if options.doc:
        fill(options.doc, options.scenes.stem, markdown(rows))
    return 1 if missing else 0


def main() -> None:
    ended("check_predictions.py", lambda: check(parsed(parser_of("check_predictions.py", __doc__))))


if __name__ == "__main__":
    main()
