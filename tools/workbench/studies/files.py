# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies in the folder: their files, and what tools/study has left of them, whoever began it."""

import csv
import json
import os
from functools import lru_cache
from pathlib import Path

from base.ending import Trouble
from base.files import is_file, parsed_toml, read_text

from ..project.project import Project, Refused

WORKER = Path(__file__).resolve().parent / "worker.py"
MOST_PLACES, DEEPEST = 5000, 6
LONGEST = 16 << 20   # bytes of a table that a page is shown
LONGEST_STUDY = 1 << 20
MOST_READ = 1000     # TOML files that are kept as read
PICTURES = {".png": "image/png", ".svg": "image/svg+xml"}
MARKS = ("vary", "run", "presets", "method")  # what, beside a case, makes a file a study


def look_through(project: Project, endings: tuple[str, ...] = (".toml",)) -> tuple[list[Path], list[Path]]:
    """Files with these endings, and folders of results of studies, neither hidden nor inside results. Links are left
    out: they may lead anywhere."""
    files, results, places = [], [], 0
    for here, folders, names in os.walk(project.root):
        at = Path(here)
        places += 1 + len(names)
        if places > MOST_PLACES:
            break
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        if len(at.relative_to(project.root).parts) >= DEEPEST:
            folders.clear()
        if is_results(at):
            results.append(at)
            folders.clear()
        elif is_file(at / "summary.json"):
            folders.clear()
        else:
            files += [at / name for name in sorted(names) if name.lower().endswith(endings)
                      and not (at / name).is_symlink()]
    return files, results


def is_results(folder: Path) -> bool:
    return (folder / "runs").is_dir() and (is_file(folder / "jobs.json") or is_file(folder / "table.csv"))


def tables_in(path: Path) -> dict:
    """Of a TOML file; none of what is no such file, or too large for a study."""
    try:
        status = os.stat(path)
        return read_once(path, status.st_mtime_ns, status.st_size, status.st_ino)
    except (Trouble, OSError):
        return {}


@lru_cache(maxsize=MOST_READ)
def read_once(path: Path, *stamp) -> dict:
    """While its stamp is the same. Raises Trouble."""
    return parsed_toml(path, read_text(path, LONGEST_STUDY))


def is_case(path: Path) -> bool:
    tables = tables_in(path)
    return isinstance(tables.get("ply"), list) or isinstance(tables.get("tool"), list)


def tables_of(path: Path) -> dict | None:
    """None for what is no study."""
    tables = tables_in(path)
    return tables if isinstance(tables.get("case"), str) and any(key in tables for key in MARKS) else None


def name_of(path: Path) -> str:
    """As tools/study names its results."""
    return path.parent.name if path.name == "study.toml" else path.stem


def begun_from(project: Project, folder: Path) -> Path | None:
    """The study file that results are of; None for those of former versions, or of elsewhere."""
    try:
        told = json.loads(read_text(folder / "jobs.json", LONGEST)).get("study", "")
        path = Path(os.path.realpath(told)) if isinstance(told, str) and told else None
    except (Trouble, OSError, ValueError, AttributeError):
        return None
    return path if path and path.is_relative_to(project.root) else None


def output_of(project: Project, study: Path, results: list[Path]) -> Path:
    """Where its results are, or will be: results/NAME, or NAME_2 if that is another study's."""
    own = [folder for folder in results if begun_from(project, folder) == study]
    if own:
        return max(own, key=lambda folder: folder.stat().st_mtime)
    for number in range(1, 1000):
        folder = project.root / "results" / (name_of(study) + (f"_{number}" if number > 1 else ""))
        if begun_from(project, folder) in (None, study) and not is_file(folder / "summary.json"):
            return folder
    raise Refused(f"{name_of(study)} has a thousand results: remove some", 422)


def goes_on(folder: Path) -> bool:
    """Whether tools/study holds its lock, by what the system says: a lock tried would be in the way
    of a study that begins now."""
    try:
        status = os.stat(folder / ".lock")
        locks = Path("/proc/locks").read_text()
    except OSError:
        return False
    device = f"{os.major(status.st_dev):02x}:{os.minor(status.st_dev):02x}:{status.st_ino}"
    return any("FLOCK" in line and device in line.split() for line in locks.splitlines())


def cell(text: str) -> float | str | None:
    if not text:
        return None
    try:
        value = float(text)
    except ValueError:
        return text
    return value if abs(value) < 1e300 else text


def csv_rows(file: Path) -> tuple[list[str], list[dict]]:
    """Columns and rows; none of a file that is not there. Raises Trouble."""
    if not is_file(file):
        return [], []
    reader = csv.DictReader(read_text(file, LONGEST).splitlines())
    try:
        rows = [{name: cell(value) for name, value in row.items() if name and isinstance(value, str)}
                for row in reader]
    except csv.Error as problem:
        raise Trouble(f"{file}:{reader.line_num}: {problem}") from problem
    return list(reader.fieldnames or []), rows


def counts(folder: Path) -> dict:
    """Rows of the table by status."""
    try:
        rows = csv_rows(folder / "table.csv")[1]
    except Trouble:
        rows = []
    found: dict[str, int] = {}
    for row in rows:
        found[str(row.get("status"))] = found.get(str(row.get("status")), 0) + 1
    return found


def version_of(folder: Path) -> str:
    """Another one when the tables or pictures are."""
    marks = []
    for file in sorted(folder.iterdir()) if folder.is_dir() else []:
        if file.suffix in (".csv", *PICTURES) and is_file(file):
            status = file.stat()
            marks.append(f"{file.name} {status.st_mtime_ns} {status.st_size}")
    return str(hash(tuple(marks)))


def table(folder: Path) -> dict:
    """What tools/study has written, as data. Raises Trouble."""
    columns, rows = csv_rows(folder / "table.csv")
    return {"columns": columns, "rows": rows, "ranking": csv_rows(folder / "ranking.csv")[1],
            "reach": dict(zip(("columns", "rows"), csv_rows(folder / "reach.csv"))),
            "pictures": sorted(file.name for file in folder.iterdir() if file.suffix in PICTURES)
            if folder.is_dir() else []}
