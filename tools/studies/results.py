# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of a study, a row a run, and what is made of it."""

import csv
import fnmatch
import io
import json
import math
import subprocess
from pathlib import Path

from base.ending import Trouble
from base.summary_file import read_summary
from plotting.whole_file import write_whole
from studies.discs import COLUMNS, area_means
from studies.engine import ended, killed
from studies.errors import SOUND, main_error, mark_front
from studies.fields import Field
from studies.figures import figures_of
from studies.plan import Planner, Run
from studies.ranking import is_number, rank, ranking_lines
from studies.reach import reach
from studies.run_job import read_json
from studies.shown import COLUMN
from studies.study_file import Study
from studies.text_table import fill
from studies.verdicts import breaks, title, verdicts

ON_KEYS = ("map", "window", "plies")  # pictures whose axes are keys


def known_columns(study: Study, planner: Planner) -> tuple[list[str], list[str]]:
    """Names of what is varied, and of the figures that the table will have."""
    errors = [name for field in (study.reference.fields if study.reference else [])
              for name in study.fields[field].error_columns().values()]
    means = COLUMNS if study.area_means else ()
    return [one.name for one in planner.vary], ["wall_time_s", "cpu_s", *study.figures, *means,
                                                *errors]


def check_columns(study: Study, planner: Planner) -> None:
    """Whether limits, tables and pictures name what the table will have."""
    keys, figures = known_columns(study, planner)
    several = (*study.figures, *(COLUMNS if study.area_means else ()))
    asked = [(f"limits.{name}" if name == one.figure else f"limits.{name}.figure", one.figure,
              figures) for name, one in study.limits.items()]
    asked += [(f"limits.{name}.where", column, ["run", "line", *keys, *figures])
              for name, one in study.limits.items() for where in one.where for column in where]
    asked += [(f"table.{head}", column, ["status", "against", *keys, *figures])
              for head, text in study.table.items() for column, _ in COLUMN.findall(text)]
    for i, one in enumerate(study.pictures):
        for key in ("x", "y", "figure"):
            allowed = figures if key == "figure" else keys if one.kind in ON_KEYS else \
                keys + figures
            if getattr(one, key):
                asked.append((f"picture.{i}.{key}", getattr(one, key), allowed))
        asked += [(f"picture.{i}.figures", name, figures) for name in one.figures]
        asked += [(f"picture.{i}.{key}", getattr(one, key), keys) for key in ("rows", "panels")
                  if getattr(one, key)]
    for item, name, allowed in asked:
        if not fnmatch.filter(allowed, name) and \
                not any(name.startswith(f"{one}_") for one in several):
            study.mistakes.add(item, f"there is no {name}", f"there are {', '.join(allowed)}")


def difference(program: Path, run: Path, reference: Path, fields: list[Field]) -> dict:
    """Columns of errors of these fields, by plyform itself."""
    words = [word for field in fields for word in ("--field", field.name)]
    done = subprocess.run([program, "difference", run, reference, *words], capture_output=True,
                          text=True, check=False)
    if done.returncode != 0:
        raise Trouble(done.stderr.strip().removeprefix("plyform: error: "))
    return {column: field.factor * float(numbers[kind])
            for field, numbers in zip(fields, csv.DictReader(done.stdout.splitlines()))
            for kind, column in field.error_columns().items()}


def differences(study: Study, planner: Planner, runs: list[Run], folder: Path) -> dict:
    """Columns of errors by run's name; kept beside the run's results, by the reference's id."""
    fields = study.reference.fields if study.reference else []
    reference = next((run for run in runs if run.name == planner.reference_name), None)
    if not fields or ended(folder, reference).get("status") not in SOUND:
        return {}
    errors = {}
    for run in runs:
        if run.line == "reference" or ended(folder, run).get("status") not in SOUND:
            continue
        place = folder / "runs" / run.name
        memory = place / f"difference-{reference.name.rpartition('-')[2]}.json"
        row = {name: value for name, value in read_json(memory).items() if is_number(value)}
        missing = [field for field in map(study.fields.get, fields)
                   if field.error_columns()["rms"] not in row]
        if missing:
            row |= difference(planner.program, place, folder / "runs" / reference.name, missing)
            memory.write_text(json.dumps(row), encoding="utf-8")
        errors[run.name] = row
    return errors


def rows_of(study: Study, planner: Planner, runs: list[Run], folder: Path,
            quick: bool = False) -> list[dict]:
    """`quick`: without what compares runs, which takes its time."""
    errors = {} if quick else differences(study, planner, runs, folder)
    means = {} if quick else area_means(study.area_means, planner, runs, folder)
    rows = []
    for run in runs:
        end = ended(folder, run)
        row = {"line": run.line, "setting": run.label,
               **{one.name: run.values[one.name] for one in planner.vary},
               "status": end.get("status", "missing"), "wall_time_s": end.get("wall_time_s", ""),
               "cpu_s": end.get("cpu_s", "")}
        place = folder / "runs" / run.name
        message = end.get("message", "") or killed(folder, run)
        try:
            summary = read_summary(place, ()) if (place / "summary.json").exists() else {}
            row |= figures_of(study.figures, summary, place)
        except Trouble as problem:
            message = message or str(problem)
        row |= errors.get(run.name, {})
        row |= {"message": message} | means.get(run.name, {})
        rows.append(row | {"folder": f"runs/{run.name}"})
        if study.stops:
            rows[-1]["stop"] = next((letter for part, letter in study.stops.items()
                                     if row["status"] == "stopped" and part in row["message"]), "")
    for row in rows if study.limits else ():
        row["breaks"] = breaks(study, row, rows)
        row["within_limits"] = int(not row["breaks"])
    if main_error(study) and not quick:
        mark_front(rows, main_error(study))
    return rows


def columns_of(rows: list[dict]) -> list[str]:
    """Those that any row has, message and folder last."""
    names = list(dict.fromkeys(name for row in rows for name in row))
    return [name for name in names if name not in ("message", "folder")] + ["message", "folder"]


def cell(value) -> str:
    if isinstance(value, bool) or not isinstance(value, float):
        return json.dumps(value) if isinstance(value, list) else str(value)
    return f"{value:.9g}" if math.isfinite(value) else ""


def write_csv(rows: list[dict], columns: list[str], file: Path) -> None:
    out = io.StringIO()
    writer = csv.DictWriter(out, columns, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows({name: cell(value) for name, value in row.items()} for row in rows)
    write_whole(file, out.getvalue())


def write_table(study: Study, planner: Planner, runs: list[Run], folder: Path,
                quick: bool = False) -> list[dict]:
    """table.csv; its rows."""
    rows = rows_of(study, planner, runs, folder, quick)
    write_csv(rows, columns_of(rows), folder / "table.csv")
    return rows


def screen(rows: list[dict], study: Study) -> str:
    """The table's most telling columns."""
    third = main_error(study) or "largest_shear_deg"
    lines = [f"{'':44} {'wall, s':>9} {third:>24}"]
    for row in rows:
        value = row.get(third)
        last = f"{value:24.3g}" if isinstance(value, (int, float)) else f"{'':24}"
        time = f"{row['wall_time_s']:9.3g}" if row["wall_time_s"] != "" else " " * 9
        note = "" if row["status"] == "done" else f"  {row['status']}"
        lines.append(f"{title(row):44} {time} {last}{note}"
                     f"{'  best for its time' if row.get('on_front') else ''}")
    return "\n".join(lines)


def tell(study: Study, planner: Planner, runs: list[Run], folder: Path,
         text: Path | None = None) -> int:
    """Writes table, ranking and pictures, and fills them into a text; the exit code."""
    rows = write_table(study, planner, runs, folder)
    ranks = rank(study, [one.name for one in planner.vary], rows)
    write_csv(ranks, ["figure", "key", "effect", "standardised", "explained", "runs"],
              folder / "ranking.csv")
    if ways := reach(study, planner, rows):
        write_csv(ways, list(ways[0]), folder / "reach.csv")
    if study.pictures:
        from studies.pictures import draw_all  # matplotlib takes a second to load
        draw_all(study, planner, rows, folder)
    print(screen(rows, study))
    print("\n".join(ranking_lines(ranks, main_error(study) or "largest_shear_deg")))
    for word, sentence in verdicts(study, rows):
        print(f"{word}: {sentence}")
    if text:
        fill(text, study, planner, rows, folder)
    print(f"table, ranking and pictures are in {folder}")
    lost = [row for row in rows if row["status"] in ("failed", "refused", "missing")]
    for row in rows:
        if row["folder"] == f"runs/{planner.reference_name}" and row["status"] not in SOUND:
            raise Trouble(f"the reference is {row['status']}: {row['message']}; without it there "
                          "are no errors")
    if lost:
        first = lost[0]
        raise Trouble(f"{len(lost)} of {len(rows)} runs {'is' if len(lost) == 1 else 'are'} "
                      f"without results; the first, {first['folder']}, {first['status']} "
                      f"{first['message']}".rstrip())
    return 0
