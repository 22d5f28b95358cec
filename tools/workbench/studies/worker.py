# SPDX-License-Identifier: GPL-3.0-or-later
"""What takes its time or may fail hard, in a process of its own: worker.py check STUDY OUTPUT
PROGRAM, or keys CASE ROOT PROGRAM. Answers JSON."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[2])

from base.ending import Trouble, words_of  # noqa: E402
from base.files import is_file, read_toml  # noqa: E402
from base.program import add_module_path  # noqa: E402
from studies import check_runs, engine, plan, results, study_file  # noqa: E402
from studies.case_values import CaseValues  # noqa: E402

MISTAKE = re.compile(r"^(?P<file>.*?):(?P<line>\d+):(?:\d+:)? (?:error: )?(?P<words>.*)$")
MOST_NAMES = 200   # of runs that are named
MOST_VALUES = 2000  # keys of a case
TABLES_OF_NAMES = ("fabrics", "blanks", "friction")
WORDS = ("name", "title")  # that change nothing
WITHOUT_VALUE = ("contact", "solver")  # tables of which keys are offered that the case leaves out


def mistake(text: str) -> dict:
    found = MISTAKE.match(text)
    return {"line": int(found["line"]), "words": found["words"], "file": found["file"]} if found else \
        {"line": 0, "words": text, "file": ""}


def check(file: Path, output: Path, program: Path, jobs: int) -> dict:
    """Runs, those that are missing, the time they take, and every mistake."""
    study = study_file.read_study(file)
    told = {"runs": 0, "missing": 0, "estimate_s": None, "names": [], "columns": []}
    if not study.mistakes.found:
        version = program_version(program)
        planner = plan.Planner(study, program, version, 1)
        runs = planner.runs(output)
        results.check_columns(study, planner)
        keys, figures = results.known_columns(study, planner)
        told |= {"runs": len(runs), "columns": [*keys, *figures],
                 "names": [f"{run.line}: {run.label}" for run in runs[:MOST_NAMES]]}
        if not study.mistakes.found:
            estimate = check_runs.check_runs(study, planner, runs, output, jobs)
            work = engine.Engine(engine.Options(program, output, jobs, 1), runs, estimate)
            missing = len(work.missing())
            told |= {"missing": missing, "of_one_s": work.time_of_run(),
                     "estimate_s": missing * work.time_of_run() / jobs}
    return {**told, "jobs": jobs, "mistakes": [mistake(text) for text in study.mistakes.texts()]}


def program_version(program: Path) -> str:
    return subprocess.run([program, "version"], capture_output=True, text=True, check=True).stdout.strip()


def general(path: list, tables: dict) -> str:
    """As the table of keys names it: tool[].stroke, fabrics.NAME.warp.stiffness."""
    words = []
    for at, step in enumerate(path):
        if isinstance(step, int):
            words[-1] += "[]"
        else:
            words.append("NAME" if at == 1 and path[0] in TABLES_OF_NAMES else step)
    return ".".join(words)


def named(tables: dict, path: list) -> str:
    """Items by their name where one alone has it, else by number."""
    at, words = tables, []
    for step in path:
        if isinstance(step, int):
            names = [item.get("name") if isinstance(item, dict) else None for item in at]
            own = names[step]
            plain = isinstance(own, str) and re.fullmatch(r"[A-Za-z_][\w-]*", own)
            words.append(own if plain and names.count(own) == 1 else str(step))
        else:
            words.append(step)
        at = at[step]
    return ".".join(words)


def leaves(at, path: list, known: dict, tables: dict):
    """Keys with a value: numbers, texts, and lists that are one value."""
    entry = known.get(general(path, tables)) if path else None
    if isinstance(at, dict):
        for name, value in at.items():
            if re.fullmatch(r"[\w-]+", name):
                yield from leaves(value, [*path, name], known, tables)
    elif isinstance(at, list) and at and all(isinstance(one, dict) for one in at):
        for number, value in enumerate(at):
            yield from leaves(value, [*path, number], known, tables)
    elif entry and path[-1] not in WORDS and isinstance(at, (bool, int, float, str, list)):
        yield path, at, entry


def described(key, value, entry, given: bool) -> dict:
    return {"key": key, "value": value, "given": given, "unit": "" if entry.unit == "-" else entry.unit,
            "type": getattr(entry, "type", ""), "range": entry.range, "meaning": entry.meaning}


def without_value(tables: dict, known: dict):
    for word, entry in known.items():
        table, _, name = word.partition(".")
        if table in WITHOUT_VALUE and name and "." not in name and "[" not in name and \
                name not in tables.get(table, {}):
            try:
                value = json.loads(entry.default)
            except ValueError:
                continue
            yield described(word, value, entry, False)


def keys(case: Path, root: Path, program: Path) -> dict:
    """Keys of a case with their values, and the figures that its runs will have."""
    add_module_path(program)
    import plyform
    known = {entry.key: entry for entry in plyform.keys()}
    values = CaseValues(case, (), program)
    fabrics = values.tables.get("fabrics", {})
    for name, fabric in fabrics.items() if isinstance(fabrics, dict) else ():
        inside = isinstance(fabric, str) and Path(os.path.realpath(case.parent / fabric)).is_relative_to(root)
        if inside and is_file(case.parent / fabric):
            fabrics[name] = read_toml(case.parent / fabric)
    found = [described(named(values.tables, path), value, entry, True) for path, value, entry in
             leaves(values.tables, [], known, values.tables)]
    found += without_value(values.tables, known)
    return {"keys": found[:MOST_VALUES], "figures": figures(values.tables)}


def names_in(tables: dict, kind: str) -> list[str]:
    items = tables.get(kind, [])
    return [str(one.get("name")) for one in items if isinstance(one, dict) and one.get("name")] \
        if isinstance(items, list) else []


def figures(tables: dict) -> list[dict]:
    """Those that most studies look at; any other path of summary.json goes as well."""
    found = [{"name": f"{name}_N", "path": f"tools.{name}.force_N", "words": f"force on {name} at the end, N"}
             for name in names_in(tables, "tool")]
    every = (
        ("shear_deg", "max plies.*.p99_shear_deg", "shear angle that 99 % of a ply's area stay below, °"),
        ("max_shear_deg", "max plies.*.max_shear_deg", "largest shear angle of any ply, °"),
        ("pressed", "max plies.*.max_pressed_strain", "largest strain of yarns that are pressed"),
        ("pressed_percent", "100 * max plies.*.area_share_pressed_over_2_percent",
         "area with yarns pressed by more than 2 %, %"),
        ("wrinkle_mm", "max plies.*.wrinkle_height_mm", "height of the largest wrinkle, mm"),
        ("draw_in_mm", "mean plies.*.draw_in_mm.mean", "mean draw-in of the edges, mm"),
        ("tension_N_per_yarn", "max plies.*.max_tension_N_per_yarn", "largest tension, N per yarn"))
    return found + [dict(zip(("name", "path", "words"), one)) for one in every]


def main() -> None:
    what, *rest = sys.argv[1:]
    try:
        if what == "check":
            told = check(Path(rest[0]), Path(rest[1]), Path(rest[2]), int(rest[3]))
        else:
            told = keys(Path(rest[0]), Path(rest[1]), Path(rest[2]))
    except (Trouble, OSError) as problem:
        told = {"error": words_of(problem)}
    print(json.dumps(told))


if __name__ == "__main__":
    main()
