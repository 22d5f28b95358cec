# SPDX-License-Identifier: GPL-3.0-or-later
"""Routes of files that come in: api/upload, api/import."""

from fastapi import APIRouter, Body, Request
from starlette.concurrency import run_in_threadpool
from starlette.requests import ClientDisconnect

from ..imports import uploads
from ..imports.imports import imported
from ..project.project import Refused
from ..studio import Studio


def routes(studio: Studio) -> APIRouter:
    router, files = APIRouter(), studio.cases
    uploads.clear(studio.project)

    @router.post("/upload")
    async def upload(request: Request, name: str, folder: str = "", replace: str = "") -> dict:
        taken = uploads.Upload(studio.project, folder, name, uploads.length_of(request.headers), replace)
        try:
            async for piece in request.stream():
                await run_in_threadpool(taken.write, piece)
            answer = await run_in_threadpool(taken.finish)
        except ClientDisconnect as problem:
            raise Refused("the page has gone before the file was whole", 400) from problem
        finally:
            taken.end()
        studio.events.send("folder")
        return answer

    @router.post("/import")
    def take(wish: dict = Body()) -> dict:
        return imported(studio, files, wish)

    return router
