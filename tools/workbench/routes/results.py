# SPDX-License-Identifier: GPL-3.0-or-later
"""Routes of results: api/results. Figures of runs, how their cases differ, reports, exports, files."""

import shlex

from fastapi import APIRouter, Body, Response

from base.ending import one_line

from ..processes.records import LIVE
from ..project.project import Refused
from ..results import exports as result_exports, files as result_files
from ..results.figures import differences
from ..results.listing import ResultList
from ..results.report_pages import ReportPages, why_failed
from ..studio import Studio

MOST_COMPARED = 200


def routes(studio: Studio) -> APIRouter:
    router, results, reports = APIRouter(), ResultList(studio.project), ReportPages(studio)

    @router.get("/results")
    def every() -> list[dict]:
        return results.every()

    @router.post("/results/differences")
    def compared(body: dict = Body()) -> dict:
        return differences_of(results, body.get("folders"))

    @router.post("/results/report")
    def report(body: dict = Body()) -> dict:
        return reports.asked(body.get("folders"))

    @router.get("/results/report/{key}")
    def page(key: str) -> Response:
        return reports.page(key)

    @router.get("/results/files")
    def files(folder: str) -> list[dict]:
        return result_files.listed(studio.project, folder)

    @router.get("/results/file")
    def file(folder: str, name: str) -> Response:
        return result_files.saved(studio.project, folder, name)

    @router.get("/results/drawing")
    def drawing(folder: str, name: str) -> Response:
        return result_files.drawing(studio.project, folder, name)

    @router.get("/results/offers")
    def offers() -> dict:
        return {"states": result_exports.STATES, "layups": result_exports.LAYUPS,
                "references": result_exports.REFERENCES,
                "parts": result_files.with_endings(studio.project, result_exports.PARTS),
                "outlines": result_files.with_endings(studio.project, result_exports.OUTLINES),
                "cases": result_files.with_endings(studio.project, (".toml",))}

    @router.post("/results/export")
    def export(body: dict = Body()) -> dict:
        return exported(studio, body)

    @router.get("/results/ended")
    def ended(process: str) -> dict:
        return outcome_of(studio, process)

    return router


def differences_of(results: ResultList, folders: object) -> dict:
    """{rows: as result_figures.differences has them, unknown: folders that do not say what their case
    was}. Raises Refused."""
    if not isinstance(folders, list) or not 1 < len(folders) <= MOST_COMPARED \
            or not all(isinstance(name, str) for name in folders):
        raise Refused(f"two runs are compared, or up to {MOST_COMPARED}", 422)
    runs = [results.one(name) or {"case": {}} for name in folders]
    return {"rows": differences([run["case"] for run in runs if run["case"]]),
            "folders": [name for name, run in zip(folders, runs) if run["case"]],
            "unknown": [one_line(name, 200) for name, run in zip(folders, runs) if not run["case"]]}


def exported(studio: Studio, wish: dict) -> dict:
    """Begins it; only one of a kind at a time into a folder. Raises Refused."""
    command = result_exports.command_of(studio.project, studio.program, wish)
    about = {"folder": wish["folder"], "what": wish["what"]}
    for record in studio.processes.records("export"):
        if record["about"] == about and record["state"] in LIVE:
            raise Refused(f"{wish['what']} of this run goes on: let it end first", 409)
    words = f"{wish['what']} of {one_line(wish['folder'], 200)}"
    return studio.processes.begin("export", words, command, studio.project.root, about)


def outcome_of(studio: Studio, process: str) -> dict:
    """How a report or an export ended: {state, error, log, command}."""
    record, log = studio.processes.record(process), studio.processes.log(process)
    failed = record["state"] in ("failed", "lost")
    return {"state": record["state"], "log": log, "command": shlex.join(record["command"]),
            "error": record.get("error") or (why_failed(log) if failed else "")}
