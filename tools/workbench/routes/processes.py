# SPDX-License-Identifier: GPL-3.0-or-later
"""Routes of commands that run: api/processes."""

from fastapi import APIRouter

from ..studio import Studio


def routes(studio: Studio) -> APIRouter:
    router, processes = APIRouter(), studio.processes

    @router.get("/processes")
    def every(kind: str = "") -> list[dict]:
        return processes.records(kind)

    @router.get("/processes/{number}")
    def one(number: str) -> dict:
        return {**processes.record(number), "log": processes.log(number)}

    @router.post("/processes/{number}/stop")
    def stop(number: str) -> dict:
        return processes.stop(number)

    @router.post("/processes/{number}/move")
    def move(number: str, to: int) -> dict:
        processes.move(number, to)
        return {}

    @router.post("/processes/{number}/forget")
    def forget(number: str) -> dict:
        processes.forget(number)
        return {}

    return router
