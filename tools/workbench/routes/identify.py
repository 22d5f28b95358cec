# SPDX-License-Identifier: GPL-3.0-or-later
"""Routes of identification: api/identify. plyform identify does it, as a command that is shown; what
it has found stands in its files, OUTPUT.toml and OUTPUT_fit.csv; its report, of a refusal too, in one of the
workbench's own."""

import json
import math
import os
from pathlib import Path

from fastapi import APIRouter, Body

from base.ending import Trouble, one_line
from base.files import is_file, read_bytes

from ..identify import curve_files
from ..project.project import Project, Refused, plain_name
from ..studies import files as study_files
from ..studio import Studio

MOST_CURVES = 50
MOST_TEXT = 80  # characters of an option
MOST_REPORT = 16 << 20
REPORTS = "identified"  # folder of the workbench's own
OF_FABRICS = ("warp", "weft", "family", "shear", "neo_hookean", "mooney_rivlin", "thickness")


def routes(studio: Studio) -> APIRouter:
    router, project = APIRouter(), studio.project
    forget_reports(studio)

    @router.get("/identify/tests")
    def tests() -> list[dict]:
        return [shown(test) for test in studio.identify_tests]

    @router.get("/identify/files")
    def files() -> dict:
        curves = study_files.look_through(project, curve_files.ENDINGS)[0]
        fabrics = study_files.look_through(project)[0]
        return {"curves": [project.relative(file) for file in curves],
                "fabrics": [project.relative(file) for file in fabrics if is_fabric(file)]}

    @router.get("/identify/curve")
    def curve(path: str) -> dict:
        return {"path": path, **curve_files.columns(curve_file(project, path))}

    @router.post("/identify")
    def identify(order: dict = Body(...)) -> dict:
        command, about = ordered(studio, order)
        return studio.processes.begin("identify", f"identify {about['test']}", command, project.root, about)

    @router.get("/identify/result")
    def result(number: str) -> dict:
        record = studio.processes.record(number)
        if record["kind"] != "identify":
            raise Refused(f"process {number} is no identification", 404)
        return {"record": record, "log": studio.processes.log(number), **found(studio, record)}

    return router


def shown(test: dict) -> dict:
    """As a page has it: options above and below "more", and the kind of specimens beside the first."""
    options, others = test["options"], [one for one in test["options"] if one["kind"] == "files"]
    return {"word": test["name"], "title": test["title"], "gives": test["gives"], "curve": test["curve"],
            "fabric": test["changes_fabric"], "others": others[0] if others else None,
            "sizes": [one for one in options if one["place"] == "size"],
            "corrections": [one for one in options if one["place"] == "more" and one not in others]}


def test_of(studio: Studio, word) -> dict | None:
    return next((shown(one) for one in studio.identify_tests if one["name"] == word), None)


def forget_reports(studio: Studio) -> None:
    """Those of which there is no record any more."""
    folder = studio.project.own / REPORTS
    folder.mkdir(exist_ok=True)
    known = {record["about"].get("report") for record in studio.processes.records("identify")}
    for file in folder.iterdir():
        if file.name not in known:
            file.unlink()


def is_fabric(file: Path) -> bool:
    tables = study_files.tables_in(file)
    return any(key in tables for key in OF_FABRICS) and "ply" not in tables and "case" not in tables


def curve_file(project: Project, path: str) -> Path:
    file = project.existing(path)
    if not is_file(file):
        raise Refused(f"{one_line(path, 200)} is no file", 422)
    return file


def typed(option: dict, value) -> str | None:
    """An option's value as the command has it; None for one that is not given. Raises Refused."""
    kind, words = option["kind"], f"{option['name']} = {one_line(value, 60)}"
    if kind == "flag":
        return "" if value is True else None
    if value in (None, ""):
        if option["required"]:
            raise Refused(f"{option['name']} is missing: {option['words'] or 'give its value'}", 422)
        return None
    value = str(value).strip()
    if kind == "choice" and value not in option["choices"]:
        raise Refused(f"{words}: one of {', '.join(option['choices'])}", 422)
    if kind == "only fit" and value != "fit":
        raise Refused(f"{words}: the word fit, or nothing", 422)
    if kind == "number" or kind == "fit" and value != "fit":
        try:
            if not math.isfinite(float(value)):
                raise ValueError
        except ValueError as problem:
            raise Refused(f"{words} is no number", 422) from problem
    if len(value) > MOST_TEXT or not value.isprintable():
        raise Refused(f"{words}: {MOST_TEXT} characters at most", 422)
    return value


def curves_of(project: Project, given, what: str) -> list[str]:
    """FILE or FILE:COLUMN, seen from the folder. Raises Refused."""
    if not isinstance(given, list) or len(given) > MOST_CURVES or \
            not all(isinstance(one, dict) and isinstance(one.get("path"), str) for one in given):
        raise Refused(f"{what}: a list of {MOST_CURVES} files at most", 422)
    words = []
    for one in given:
        path, column = project.relative(curve_file(project, one["path"])), str(one.get("column") or "")
        if len(column) > MOST_TEXT or not column.isprintable() and column:
            raise Refused(f"{one_line(column, 60)!r} is no column", 422)
        words.append(f"./{path}" + (f":{column}" if column else ""))
    return words


def output_file(studio: Studio, order: dict, beside: Path) -> Path:
    """Of what is found, over nothing else's. Raises Refused."""
    project = studio.project
    if not order.get("output"):
        raise Refused("give a name for the new file", 422)
    name = plain_name(str(order["output"]))
    path = beside.parent / (name if name.endswith(".toml") else f"{name}.toml")
    path = project.inside(project.relative(path))
    taken = [one for one in (path, path.with_name(f"{path.stem}_fit.csv")) if one.exists() or one.is_symlink()]
    if any(not is_file(one) or one.is_symlink() for one in taken) or path == beside:
        raise Refused(f"{project.relative(path)} cannot be written over: give another name", 409)
    if studio.processes.makes(project.relative(path)):
        raise Refused(f"{project.relative(path)} is just being made: let that end first", 409)
    if taken and order.get("replace") is not True:
        raise Refused(f"{project.relative(taken[0])} is there already: give another name, or let it be replaced", 409)
    return path


def ordered(studio: Studio, order: dict) -> tuple[list, dict]:
    """The command, and what its record keeps. Raises Refused."""
    project = studio.project
    test = test_of(studio, order.get("test"))
    if test is None:
        raise Refused(f"there is no test {one_line(order.get('test'), 60)}", 422)
    values = order.get("values") if isinstance(order.get("values"), dict) else {}
    options = [*test["sizes"], *test["corrections"]]
    unknown = [name for name in values if name not in [one["name"] for one in options]]
    if unknown:
        raise Refused(f"{test['word']} has no option {one_line(unknown[0], 60)}", 422)
    curves = curves_of(project, order.get("curves"), "curves")
    if not curves:
        raise Refused("there is no curve: choose a file", 422)
    if test["fabric"] and not order.get("fabric"):
        raise Refused("choose the fabric to start from", 422)
    beside = curve_file(project, str(order["fabric"]) if test["fabric"] else order["curves"][0]["path"])
    output = output_file(studio, order, beside)
    report = project.own / REPORTS / f"{os.urandom(8).hex()}.json"
    words = ["identify", test["word"], *curves]
    for option in options:
        value = typed(option, values.get(option["name"]))
        if value is not None:
            words.append(f"--{option['name']}" + (f"={value}" if value else ""))
    if test["fabric"]:
        words += ["--fabric", f"./{project.relative(beside)}"]
    words += ["-o", f"./{project.relative(output)}", "--report", f"./{report.relative_to(project.root)}"]
    others = curves_of(project, order.get("others") or [], "others")
    if others and not test["others"]:
        raise Refused(f"{test['word']} has one kind of specimens", 422)
    if others:
        words += [f"--{test['others']['name']}", *others]
    return [studio.program, *words], {"test": test["word"], "output": project.relative(output),
                                      "report": report.name, "order": order}


def plain(value):
    """Numbers that JSON of a page cannot have are null."""
    return value if not isinstance(value, float) or math.isfinite(value) else None


def found(studio: Studio, record: dict) -> dict:
    """The report, and the rows measured and fitted; null where there is none (yet)."""
    project = studio.project
    told = {"report": None, "fit": None, "text": None}
    try:
        file = project.own / REPORTS / Path(record["about"]["report"]).name
        if is_file(file):
            told["report"] = json.loads(read_bytes(file, MOST_REPORT))
        rows = project.inside(record["about"]["output"].removesuffix(".toml") + "_fit.csv")
        if told["report"] and told["report"].get("status") == "done" and is_file(rows):
            told["fit"] = columns_of(*study_files.csv_rows(rows))
            test = test_of(studio, record["about"]["test"])
            if test and not test["fabric"]:
                told["text"] = read_bytes(project.inside(record["about"]["output"]), MOST_REPORT).decode("utf-8")
    except (Trouble, OSError, ValueError, KeyError) as problem:
        told["trouble"] = one_line(problem)
    return told


def columns_of(names: list[str], rows: list[dict]) -> dict:
    """With `side`, warp or weft, where a line `# weft` parts the rows."""
    table: dict[str, list] = {name: [] for name in names}
    side, sides = "warp", []
    for row in rows:
        first = row.get(names[0])
        if isinstance(first, str):
            side = first.strip("# ")
            continue
        sides.append(side)
        for name in names:
            table[name].append(plain(row.get(name)))
    return {**table, "side": sides} if len(set(sides)) > 1 else table
