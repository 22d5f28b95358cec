# SPDX-License-Identifier: GPL-3.0-or-later
"""The application: its routes, the files of the page, and how what is wrong is answered."""

import asyncio
import base64
import hashlib
from pathlib import Path

from fastapi import FastAPI, Request, WebSocket, WebSocketDisconnect
from fastapi.responses import FileResponse, HTMLResponse, JSONResponse
from starlette.exceptions import HTTPException

from base.ending import Mistake, Trouble, one_line, place_of, words_of
from base.files import is_file
from reporting.page import THREE, WEB as REPORT_WEB, json_in_script

from ..project.project import Changed
from ..studio import Studio
from .guard import HEADERS, Refusal

WEB = Path(__file__).resolve().parents[1] / "web"
CODEMIRROR = Path("/usr/share/javascript/codemirror")
SHELVES = {"web": WEB, "report": REPORT_WEB, "codemirror": CODEMIRROR}
KINDS = {".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml", ".png": "image/png"}


def application(studio: Studio, routers: list) -> FastAPI:
    app = FastAPI(title="plyform studio", openapi_url=None, docs_url=None, redoc_url=None)
    for router in routers:
        app.include_router(router, prefix="/api")
    page, policy = page_and_policy()

    @app.on_event("startup")
    async def begin() -> None:
        studio.events.loop = asyncio.get_running_loop()

    @app.on_event("shutdown")
    async def end() -> None:
        studio.processes.ending.set()

    @app.get("/")
    async def index() -> HTMLResponse:
        return HTMLResponse(page, headers={"Content-Security-Policy": policy})

    @app.get("/{shelf}/{name:path}")
    async def file(shelf: str, name: str):
        return static(shelf, name)

    @app.websocket("/events")
    async def events(socket: WebSocket) -> None:
        await tell_events(studio, socket)

    for kind in (Trouble, Refusal, OSError, MemoryError, Exception):
        app.add_exception_handler(kind, wrong)
    app.add_exception_handler(HTTPException, not_taken)
    return app


def static(shelf: str, name: str):
    if (shelf, name) == ("lib", "three.min.js"):
        return FileResponse(THREE, media_type=KINDS[".js"])
    path = SHELVES.get(shelf, WEB) / name
    kind = KINDS.get(path.suffix)
    if shelf not in SHELVES or not kind or {"", ".."} & set(name.split("/")) or not is_file(path):
        return JSONResponse({"error": f"there is no {one_line(shelf, 50)}/{one_line(name, 100)}"}, 404)
    return FileResponse(path, media_type=kind)


def page_and_policy() -> tuple[str, str]:
    """Modules go by the names plyform/FILE (those of reports) and workbench/FOLDER/FILE."""
    names = {f"{room}/{name}": f"./{shelf}/{name}"
             for room, shelf in (("plyform", "report"), ("workbench", "web"))
             for name in sorted(file.relative_to(SHELVES[shelf]).as_posix() for file in SHELVES[shelf].rglob("*.js"))}
    imports = str(json_in_script({"imports": names}))
    digest = base64.b64encode(hashlib.sha256(imports.encode()).digest()).decode()
    text = (WEB / "workbench.html").read_text(encoding="utf-8").replace("{{ imports }}", imports)
    policy = HEADERS["Content-Security-Policy"].replace("script-src 'self'", f"script-src 'self' 'sha256-{digest}'")
    return text, policy


async def tell_events(studio: Studio, socket: WebSocket) -> None:
    """Until the page is closed."""
    await socket.accept()

    async def send() -> None:
        async for event in studio.events.of_page():
            await socket.send_json(event)

    task = asyncio.create_task(send())
    try:
        while True:
            await socket.receive_text()  # pages send nothing; this ends when they are closed
    except (WebSocketDisconnect, RuntimeError, KeyError):
        pass
    finally:
        task.cancel()


async def not_taken(request: Request, problem: HTTPException) -> JSONResponse:
    """What the guard has refused while a body was read, or what there is no route of."""
    if isinstance(problem.__cause__, Refusal):
        return await wrong(request, problem.__cause__)
    return JSONResponse({"error": one_line(problem.detail)}, problem.status_code, headers=problem.headers)


async def wrong(request: Request, problem: Exception) -> JSONResponse:
    code = getattr(problem, "code", 422 if isinstance(problem, (Trouble, Mistake)) else 500)
    words = words_of(problem)
    if not isinstance(problem, (Trouble, Refusal, OSError, MemoryError)):
        code, words = 500, (f"this is a fault of plyform, not of your files: {type(problem).__name__}: {problem}, at "
                            f"{place_of(problem)}; please report it")
    clashes = {"clashes": problem.clashes} if isinstance(problem, Changed) else {}
    return JSONResponse({"error": one_line(words), **clashes}, code)
