# SPDX-License-Identifier: GPL-3.0-or-later
"""Asks `plyform check` about the case and about every value before anything is run."""

import json
import re
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from base.files import is_file
from base.progress import Progress
from plotting.reading import Trouble
from studies.case_values import split_setting
from studies.plan import Planner, Run, label_of
from studies.reader import is_number
from studies.run_job import read_json
from studies.study_file import CASE, Study

REFUSED = 2  # exit code of plyform: the case is wrong
ERROR = re.compile(r"^(?P<file>.*?):(?P<line>\d+):(?P<column>\d+): error: (?P<text>.*)$")
TIME = re.compile(r"^estimated time (\d+) s", re.M)
LEAST_S = 0.2  # of a run, where plyform estimates 0


def wanted(study: Study, planner: Planner, runs: list[Run]) -> list[tuple[str, Run]]:
    """Where a mistake would be told, and the run that shows it. Every value stands alone in one:
    of a grid that is as many checks as there are values, and a combination that does not fit fails
    when it is run."""
    asked = [("case", planner.run("case", "case"))]
    for one in runs:
        if one.line in ("reference", "preset", "run"):
            asked.append((one.item, one))
    for one in planner.vary:
        rows = one.values if one.range is None else [(one.range[0],), (one.range[1],)]
        for i, row in enumerate(rows):
            item = f"{one.item}.range" if one.range else \
                f"{one.item}.{'factors' if one.factors else 'values'}.{i}"
            choice = [(one, row)]
            if CASE in one.keys and not is_file(planner.case_of(choice)):
                study.mistakes.add(item, f"there is no file {planner.case_of(choice)}",
                                   "give case files seen from the study file")
                continue
            asked.append((item, planner.run(one.name, label_of(one, row), choice)))
    return asked


def ask(program: Path, run: Run) -> tuple[int, str, str]:
    done = subprocess.run([program, "check", *run.words()], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def tell(study: Study, item: str, run: Run, text: str, said: set[str]) -> None:
    """The first mistake that plyform found, at the place of the study that brings it in."""
    found = next(filter(None, map(ERROR.match, text.splitlines())), None)
    words = found["text"] if found else (text.strip().splitlines() or ["no reason given"])[-1]
    key = words.split(": ")[0].split(" = ")[0]
    if ": unknown key" in words and ".values" in item:  # of all its values once
        item = item.rpartition(".values")[0] + ".key"
    if (mistake := f"{item.rpartition('.')[0]} {words}") in said:
        return
    said.add(mistake)
    for number, setting in enumerate(study.settings):
        if split_setting(setting)[0] == key and item == "case":
            item = f"set.{number}"
    rule, _, remedy = words.partition("; ")
    study.mistakes.add(item, f"does not fit the case: {rule}", remedy or "see the case file")


def check_runs(study: Study, planner: Planner, runs: list[Run], folder: Path, jobs: int) -> float:
    """Estimated seconds of a run on one thread. What was sound once is not asked again."""
    memory = folder / "checked.json"
    known = {key: time for key, time in read_json(memory).items() if is_number(time)}
    asked = wanted(study, planner, runs)
    named = planner.hash
    keys = [named.of(run.case, run.settings, f"{planner.rest}{run.accuracy}") for _, run in asked]
    new = [i for i, key in enumerate(keys) if key not in known]
    answers = []
    with ThreadPoolExecutor(jobs) as pool, Progress("study") as progress:
        for answer in pool.map(lambda i: ask(planner.program, asked[i][1]), new):
            answers.append(answer)
            progress.show(len(answers) / len(new), f"{len(answers)}/{len(new)} runs checked")
    said: set[str] = set()
    for i, (code, out, err) in zip(new, answers):
        if code == REFUSED and i == 0 and not study.settings:
            study.mistakes.found += [(0, line) for line in err.splitlines()]
            break
        if code == REFUSED:
            tell(study, asked[i][0], asked[i][1], err, said)
            if i == 0:  # the case itself: all others would say it again
                break
        elif code < 0:
            raise Trouble(f"{planner.program} check was ended by signal {-code}")
        estimate = TIME.search(out)
        known[keys[i]] = max(float(estimate[1]), LEAST_S) if estimate else LEAST_S
    if not study.mistakes.found:
        folder.mkdir(parents=True, exist_ok=True)
        memory.write_text(json.dumps(known), encoding="utf-8")
    return known.get(keys[0], LEAST_S)
