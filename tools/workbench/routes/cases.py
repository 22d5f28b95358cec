# SPDX-License-Identifier: GPL-3.0-or-later
"""Routes of the folder and its cases: api/folder, cases, examples, case, keys, check,
scene, instant."""

import threading
from collections.abc import Callable

from fastapi import APIRouter, Body
from fastapi.responses import JSONResponse, Response

from ..cases import new_case
from ..cases.files import CaseFiles, NoToml
from ..cases.folder import Folder
from ..project.project import Changed
from ..scene.reading import CaseReading
from ..studio import Studio


def routes(studio: Studio) -> APIRouter:
    router = APIRouter()
    files, folder = studio.cases, Folder(studio.project)
    reading = CaseReading(files, studio.program)
    reading.watch(studio.processes.ending, folder)
    router.add_event_handler("shutdown", reading.stop)

    @router.get("/folder")
    def contents() -> dict:
        threading.Thread(target=reading.warm, daemon=True).start()
        return folder.contents()

    @router.get("/keys")
    def keys() -> list[dict]:
        return studio.keys

    @router.get("/examples")
    def examples() -> list[dict]:
        return new_case.examples()

    @router.post("/cases")
    def new(name: str = Body(), source: str = Body("", alias="from")) -> dict:
        return {"path": new_case.new_case(files, name, source)}

    add_case(router, files)
    add_reading(router, reading)
    return router


def add_case(router: APIRouter, files: CaseFiles) -> None:
    @router.get("/case")
    def case(path: str) -> dict:
        return files.answer(path)

    @router.put("/case")
    def put(path: str, text: str = Body(), version: str = Body(), base: str | None = Body(None),
            over: bool = Body(False)):
        return told(files, path, lambda: files.put(path, text, version, base, over))

    @router.patch("/case")
    def patch(path: str, edits: list[dict] = Body(), version: str = Body(), base: str | None = Body(None),
              over: bool = Body(False)):
        return told(files, path, lambda: files.edit(path, edits, version, base, over))

    @router.post("/case/undo")
    def undo(path: str, version: str = Body(), wanted: str | None = Body(None)):
        return told(files, path, lambda: files.step(path, -1, version, wanted))

    @router.post("/case/redo")
    def redo(path: str, version: str = Body(), wanted: str | None = Body(None)):
        return told(files, path, lambda: files.step(path, 1, version, wanted))


def told(files: CaseFiles, path: str, change: Callable[[], dict]):
    """What the change answers, or why it was not made: with its place, or with the file as it is now."""
    try:
        return change()
    except NoToml as problem:
        return JSONResponse({"error": str(problem), "line": problem.line, "column": problem.column}, 422)
    except Changed as problem:
        return JSONResponse({"error": str(problem), "clashes": problem.clashes, "now": files.answer(path)}, 409)


def add_reading(router: APIRouter, reading: CaseReading) -> None:
    @router.get("/check")
    def check(path: str, version: str) -> dict:
        return reading.check(path, version)

    @router.get("/scene")
    def scene(path: str, version: str, draft: bool = False) -> Response:
        content = reading.draft(path, version) if draft else reading.scene(path, version)
        return Response(content, media_type="application/octet-stream")

    @router.get("/instant")
    def instant(path: str, version: str, key: str = "", value: float | None = None) -> Response:
        return Response(reading.instant(path, version, key, value), media_type="application/octet-stream")
