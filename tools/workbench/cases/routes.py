# SPDX-License-Identifier: GPL-3.0-or-later
"""Routes of the folder and its cases: api/folder, cases, examples, case, keys, check, scene."""

import threading

from fastapi import APIRouter, Body
from fastapi.responses import JSONResponse, Response

from ..scene.reading import CaseReading
from ..server.studio import Studio
from . import new_case
from .files import CaseFiles, NoToml
from .folder import Folder


def routes(studio: Studio) -> APIRouter:
    router = APIRouter()
    files, folder = CaseFiles(studio.project, studio.events), Folder(studio.project)
    reading = CaseReading(files, studio.program)
    reading.watch(studio.processes.ending, folder)
    router.add_event_handler("shutdown", reading.stop)

    @router.get("/folder")
    def contents() -> dict:
        threading.Thread(target=reading.warm, daemon=True).start()
        return folder.contents()

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
    def put(path: str, text: str = Body(), version: str = Body()):
        try:
            return files.put(path, text, version)
        except NoToml as problem:
            return JSONResponse({"error": str(problem), "line": problem.line, "column": problem.column}, 422)

    @router.patch("/case")
    def patch(path: str, edits: list[dict] = Body(), version: str = Body()):
        try:
            return files.edit(path, edits, version)
        except NoToml as problem:
            return JSONResponse({"error": str(problem), "line": problem.line, "column": problem.column}, 422)

    @router.post("/case/undo")
    def undo(path: str) -> dict:
        return files.step(path, -1)

    @router.post("/case/redo")
    def redo(path: str) -> dict:
        return files.step(path, 1)


def add_reading(router: APIRouter, reading: CaseReading) -> None:
    @router.get("/keys")
    def keys() -> list[dict]:
        return reading.keys()

    @router.get("/check")
    def check(path: str, version: str) -> dict:
        return reading.check(path, version)

    @router.get("/scene")
    def scene(path: str, version: str, draft: bool = False) -> Response:
        content = reading.draft(path, version) if draft else reading.scene(path, version)
        return Response(content, media_type="application/octet-stream")
