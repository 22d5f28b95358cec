# SPDX-License-Identifier: GPL-3.0-or-later
"""How far runs are from each other, as means of the shear angle over discs of material, and how
rough each is: tools/area_means.py, ply by ply."""

import json
from pathlib import Path

from area_means import compare
from base.summary_file import SOUND
from plotting.reading import Trouble
from studies.engine import ended
from studies.plan import Planner, Run
from studies.reader import is_number
from studies.run_job import read_json

APART, ROUGH = "area_means_deg", ("jump_deg", "outlier_deg")
COLUMNS = (APART, *ROUGH)


def other_of(run: Run, runs: list[Run], reference: str) -> Run | None:
    """What the run is compared with; nothing is compared with itself but after a turn."""
    other = next((one for one in runs if one.label == run.against), None) if run.against else \
        next((one for one in runs if one.name == reference), None)
    return None if other is run and not run.quarter_turns else other


def columns_of(folder: Path, run: Run, other: Run | None, radius: float) -> dict:
    """Kept beside the run's results, by what it was compared with."""
    place, ident = folder / "runs" / run.name, (other or run).name.rpartition("-")[2]
    memory = place / f"area-means-{ident}-{run.quarter_turns}-{radius:g}.json"
    if (row := read_json(memory)) and all(map(is_number, row.values())):
        return row
    try:
        plies = compare(place, folder / "runs" / (other or run).name, radius, run.quarter_turns)
    except Trouble as problem:
        return {"message": str(problem)}
    row = {f"{APART}_{ply['name']}": ply["rms_deg"] for ply in plies} if other else {}
    for key in ROUGH:
        row |= {f"{key}_{ply['name']}": ply["a"][key] for ply in plies}
    memory.write_text(json.dumps(row), encoding="utf-8")
    return row


def area_means(radius: float | None, planner: Planner, runs: list[Run], folder: Path) -> dict:
    """Columns by run's name; of what has not ended, or was stopped, none."""
    if radius is None:
        return {}
    columns, sound = {}, {run.name for run in runs if ended(folder, run).get("status") in SOUND}
    for run in runs:
        other = other_of(run, runs, planner.reference_name)
        columns[run.name] = {"against": other.label} if other else {}
        if run.name in sound:
            there = other if other and other.name in sound else None
            columns[run.name] |= columns_of(folder, run, there, radius)
    return columns
