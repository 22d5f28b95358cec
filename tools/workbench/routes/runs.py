# SPDX-License-Identifier: GPL-3.0-or-later
"""Routes of runs: api/runs. They are started, found, watched, ended, gone on with, removed."""

import os
import re
import shlex
import threading
import time
from collections.abc import Callable
from pathlib import Path

from fastapi import APIRouter, Body, Response

from base.ending import Trouble, one_line
from base.summary_file import doubts_and_advice, read_summary

from ..cases.paths import paths_inside
from ..processes.records import LIVE
from ..project.project import Refused, plain_name
from ..project.watch import watch
from ..runs import live_states, files as run_files
from ..runs.listing import RunList, mark_of_list
from ..studio import Studio

PERIOD = 0.5  # s, of telling how far runs are
BYTES = "application/octet-stream"
ACCURACIES = ("", "instant", "draft", "standard", "reference")
MOST_THREADS = 256
PATIENCE = (0.1, 0.3, 0.6)  # s, between tries to read what a run may just be writing


def routes(studio: Studio) -> APIRouter:
    router, runs, beginning = APIRouter(), RunList(studio.project, studio.processes), threading.Lock()
    watch(teller(studio, runs), PERIOD, studio.processes.ending)

    @router.get("/runs")
    def every() -> list[dict]:
        return runs.every()

    @router.get("/runs/offers")
    def offers() -> dict:
        return {"threads": len(os.sched_getaffinity(0)), "accuracies": ACCURACIES}

    @router.post("/runs")
    def start(body: dict = Body()) -> dict:
        with beginning:  # two pages at once: each name is given once
            return begun(studio, runs, wish_of(body))

    @router.get("/runs/messages")
    def messages(folder: str) -> dict:
        return messages_of(studio, known(runs, folder))

    @router.post("/runs/stop")
    def stop(folder: str) -> dict:
        run = known(runs, folder)
        if not run["record"] or run["record"]["state"] not in LIVE:
            raise Refused("it was not begun here: end it where it was begun, by Ctrl-C", 409)
        return studio.processes.stop(run["record"]["id"])

    @router.post("/runs/resume")
    def resume(folder: str) -> dict:
        with beginning:
            return gone_on(studio, runs, known(runs, folder))

    @router.post("/runs/remove")
    def remove(folder: str) -> dict:
        with beginning:
            return {"stay": removed(studio, runs, known(runs, folder))}

    @router.get("/runs/bodies")
    def bodies(folder: str) -> Response:
        return Response(patiently(lambda: live_states.bodies(folder_of(studio, folder))), media_type=BYTES)

    @router.get("/runs/state")
    def state(folder: str, number: int = -1) -> Response:
        content = patiently(lambda: live_states.state(folder_of(studio, folder), number))
        return Response(content, media_type=BYTES)

    @router.get("/runs/picture")
    def picture(folder: str, after: int = -1) -> Response:
        goes_on = known(runs, folder)["state"] == "running"  # else it has ended between two questions
        begun = goes_on and studio.project.inside(folder).is_dir()  # a run makes its folder itself
        content = live_states.picture(folder_of(studio, folder), after) if begun else b""
        return Response(content, media_type=BYTES)

    return router


def patiently(read: Callable[[], bytes]) -> bytes:
    """What `read` gives, tried again where a run may have been between two states of its file."""
    for wait in PATIENCE:
        try:
            return read()
        except Refused:
            raise
        except Trouble:
            time.sleep(wait)
    return read()


def teller(studio: Studio, runs: RunList) -> Callable[[], None]:
    """Tells {kind: "runs"} when the list is another one, {kind: "progress", folder, ...} of what goes on."""
    mark = ""

    def tell() -> None:
        nonlocal mark
        if not studio.events.pages:
            return
        now = runs.every()
        if mark != (mark := mark_of_list(now)):
            studio.events.send("runs")
        for run in now:
            if run["state"] == "running":
                studio.events.send("progress", folder=run["folder"], progress=run["progress"],
                                   states=run["states"])
    return tell


def known(runs: RunList, folder: str) -> dict:
    """Raises Refused."""
    runs.project.inside(folder)
    run = runs.of(folder)
    if run is None:
        runs.look_again()
        run = runs.of(folder)
    if run is None:
        raise Refused(f"{one_line(folder, 200)} is no folder of a run", 404)
    return run


def folder_of(studio: Studio, name: str) -> Path:
    folder = studio.project.existing(name)
    if not folder.is_dir():
        raise Refused(f"{one_line(name, 200)} is no folder of a run", 404)
    return folder


def wish_of(body: dict) -> dict:
    """What a page asks for. Raises Refused."""
    otherwise = {"case": "", "name": "", "accuracy": "", "threads": len(os.sched_getaffinity(0)), "budget": 0,
                 "verify": False}
    wish = {key: value if body.get(key) is None else body[key] for key, value in otherwise.items()}
    if not isinstance(wish["case"], str) or not wish["case"]:
        raise Refused("choose a case", 422)
    if not isinstance(wish["name"], str) or wish["accuracy"] not in ACCURACIES:
        raise Refused("accuracy: none, instant, draft, standard or reference", 422)
    if type(wish["threads"]) is not int or not 1 <= wish["threads"] <= MOST_THREADS:
        raise Refused(f"threads: 1 to {MOST_THREADS}", 422)
    if type(wish["verify"]) is not bool:
        raise Refused("verify: true or false", 422)
    if type(wish["budget"]) not in (int, float) or not 0 <= wish["budget"] < 1e9:
        raise Refused("budget: seconds, more than 0, or nothing", 422)
    return wish


def begun(studio: Studio, runs: RunList, wish: dict) -> dict:
    case = studio.project.existing(wish["case"])
    name = studio.project.relative(case)
    if not case.is_file() or case.suffix != ".toml":
        raise Refused(f"{one_line(wish['case'], 200)} is no case: a file .toml", 422)
    paths_inside(studio.project, case)
    output = free_folder(studio, runs, name, plain_name(wish["name"]) if wish["name"] else "")
    command = [str(studio.program), "run", as_argument(name), "-o", output, "--threads", str(wish["threads"])]
    command += ["--accuracy", wish["accuracy"]] if wish["accuracy"] else []
    command += ["--budget", f"{wish['budget']:g}"] if wish["budget"] else []
    command += ["--verify"] if wish["verify"] else []
    return studio.processes.begin("run", output.rpartition("/")[2], command, studio.project.root,
                                  {"case": name, "output": output}, queue=True)


def as_argument(name: str) -> str:
    return f"./{name}" if name.startswith("-") else name


def free_folder(studio: Studio, runs: RunList, case: str, wanted: str) -> str:
    """results/NAME: the one wanted, or the first that is free after the case. Raises Refused."""
    taken = {run["folder"] for run in runs.every()}

    def free(name: str) -> bool:
        place = studio.project.inside(f"results/{name}")
        empty = not place.exists() or place.is_dir() and not any(place.iterdir())
        return empty and f"results/{name}" not in taken

    if wanted:
        if not free(wanted):
            raise Refused(f"results/{wanted} is there already: give another name, or delete that run", 409)
        return f"results/{wanted}"
    path = Path(case)
    stem = path.parent.name if path.stem == "case" and path.parent.name else path.stem
    stem = re.sub(r"[^A-Za-z0-9_.-]", "_", stem).lstrip("-.")[:60] or "run"
    names = (stem, *(f"{stem}_{k}" for k in range(2, 100_000)))
    return next(f"results/{name}" for name in names if free(name))


def gone_on(studio: Studio, runs: RunList, run: dict) -> dict:
    if not run["can_resume"]:
        raise Refused("it cannot go on: it has come to its end, goes on already, has no checkpoint, or its "
                      "case is not known; run the case again", 409)
    case = studio.project.existing(run["case"])
    paths_inside(studio.project, case)
    command = list(run["record"]["command"]) if run["record"] and run["record"]["own"] else \
        [str(studio.program), "run", as_argument(run["case"]), "-o", run["folder"]]
    command[0] = str(studio.program)
    command += [] if "--resume" in command else ["--resume"]
    return studio.processes.begin("run", run["name"], command, studio.project.root,
                                  {"case": run["case"], "output": run["folder"]}, queue=True)


def removed(studio: Studio, runs: RunList, run: dict) -> list[str]:
    """The results, and all records of them; names that stay in the folder."""
    if run["state"] in LIVE:
        raise Refused("it goes on: stop it first", 409)
    folder = studio.project.inside(run["folder"])
    if folder == studio.project.root:
        raise Refused("that is the folder of the workbench")
    stay = run_files.removed(folder) if folder.is_dir() else []
    for record in studio.processes.records("run"):
        if record["about"].get("output") == run["folder"]:
            studio.processes.forget(record["id"])
    runs.look_again()
    studio.events.send("runs")
    return stay


def messages_of(studio: Studio, run: dict) -> dict:
    """What a run says: the summary's sentences, the end of what it has printed, and its command."""
    record, said = run["record"], {}
    if run["status"]:
        try:
            said = read_summary(studio.project.inside(run["folder"]), ("status",))
        except Trouble as problem:
            said = {"message": one_line(problem)}
    command = ["plyform", *record["command"][1:]] if record else \
        ["plyform", "run", as_argument(run["case"]) or "CASE", "-o", run["folder"]]
    doubts, advice = doubts_and_advice(said)
    return {"message": run["message"], "doubts": doubts, "advice": advice, "assumed": said.get("assumed", []),
            "could_be_left_out": said.get("could_be_left_out", []), "plies": said.get("plies", []),
            "tools": said.get("tools", []), "energy": said.get("energy", {}),
            "log": studio.processes.log(record["id"]) if record else "",
            "command": shlex.join(command), "cwd": str(studio.project.root)}
