# SPDX-License-Identifier: GPL-3.0-or-later
"""Routes of studies: api/studies, api/study. State is the study file and what tools/study leaves."""

import os
import sys
import threading
from collections.abc import Callable
from pathlib import Path

from fastapi import APIRouter, Body
from fastapi.responses import FileResponse, JSONResponse

from base.ending import one_line
from base.files import is_file, parsed_toml, read_text

from ..cases.paths import paths_inside
from ..processes.records import LIVE
from ..project.one_answer import answered
from ..project.project import Changed, Project, Refused, plain_name
from ..studies import files as study_files, plan as study_plan
from ..studio import Studio


def routes(studio: Studio) -> APIRouter:
    router = APIRouter()
    reading(router, studio)
    writing(router, studio)
    running(router, studio)
    return router


def study_file(project: Project, path: str) -> Path:
    """Raises Refused."""
    file = project.existing(path)
    if file.suffix != ".toml" or not is_file(file):
        raise Refused(f"{one_line(path, 200)} is no study: their files end in .toml", 422)
    return file


def results_folder(project: Project, folder: str) -> Path:
    """Raises Refused."""
    path = project.existing(folder)
    if not study_files.is_results(path):
        raise Refused(f"{one_line(folder, 200)} has no results of a study", 404)
    return path


def texts_in(value) -> list[str]:
    if isinstance(value, str):
        return [value]
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return [text for one in inner for text in texts_in(one)]


def check_paths(project: Project, file: Path, tables: dict) -> None:
    """Whatever names a file lies in the folder: the case, what is included, files among the values,
    and what the case names. Raises Refused."""
    case = Path(os.path.realpath(file.parent / str(tables.get("case", ""))))
    case = case / "case.toml" if case.is_dir() else case
    if not case.is_relative_to(project.root):
        raise Refused(f"case = {one_line(tables.get('case'), 200)} leads out of the folder: bring the case in")
    named = [(file.parent, text) for text in texts_in(tables)] + [(case.parent, text) for text in texts_in(tables)]
    if is_file(case):
        paths_inside(project, case)
        named += [(case.parent, text) for text in texts_in(parsed_toml(case, read_text(case)))]
    for folder, text in named:
        for word in {text, text.partition("=")[2].strip(" '\"")} if len(text) < 1000 else ():
            if not word or "\0" in word:
                continue
            path = Path(os.path.realpath(folder / word))
            if not path.is_relative_to(project.root) and is_file(path):
                raise Refused(f"{one_line(word, 200)} leads out of the folder: bring that file in")


def about(studio: Studio, output: Path) -> dict:
    """How far the study of these results is: state, counts of runs by status, its process."""
    project, records = studio.project, studio.processes.records("study")
    name = project.relative(output)
    own = [record for record in records if record["about"].get("output") == name]
    last = own[-1] if own else None
    live = last if last and last["state"] in LIVE else None
    counts = study_files.counts(output)
    state = live["state"] if live else "running" if study_files.goes_on(output) else \
        "not begun" if not counts else "has missing runs" if counts.get("missing") else "ended"
    return {"output": name, "state": state, "counts": counts, "record": last,
            "elsewhere": state == "running" and live is None}


def reading(router: APIRouter, studio: Studio) -> None:
    project = studio.project

    @router.get("/studies")
    def every() -> list[dict]:
        files, results = study_files.look_through(project)
        found, seen = [], set()
        for file in files:
            tables = study_files.tables_of(file)
            if tables is None:
                continue
            output = study_files.output_of(project, file, results)
            seen.add(output)
            found.append({"path": project.relative(file), "name": study_files.name_of(file),
                          "title": one_line(tables.get("title", study_files.name_of(file)), 200),
                          "case": one_line(tables["case"], 200), **about(studio, output)})
        return found + [{"path": "", "name": folder.name, "title": folder.name, "case": "",
                         **about(studio, folder)} for folder in results if folder not in seen]

    @router.get("/study")
    def one(path: str) -> dict:
        file = study_file(project, path)
        text = read_text(file, study_files.LONGEST_STUDY)
        output = study_files.output_of(project, file, study_files.look_through(project)[1])
        told = {"path": path, "text": text, "version": study_plan.version_of(text), "plan": None, "error": "",
                "case": ""}
        try:
            told["plan"] = study_plan.plan_of(text)
            case = Path(os.path.realpath(file.parent / str(told["plan"].get("case", ""))))
            case = case / "case.toml" if case.is_dir() else case
            if is_file(case) and case.is_relative_to(project.root):
                told["case"] = project.relative(case)
        except Refused as problem:
            told["error"] = str(problem)
        return {**told, **about(studio, output)}

    @router.get("/study/cases")
    def cases() -> list[str]:
        return [project.relative(file) for file in study_files.look_through(project)[0]
                if study_files.is_case(file)]

    @router.get("/study/keys")
    def keys(case: str) -> dict:
        file = project.existing(case)
        paths_inside(project, file)
        return answered(study_files.WORKER, "keys", file, project.root, studio.program, cwd=project.root)

    @router.get("/study/check")
    def check(path: str, jobs: int = 1) -> dict:
        file = study_file(project, path)
        check_paths(project, file, parsed_toml(file, read_text(file)))
        output = study_files.output_of(project, file, study_files.look_through(project)[1])
        return answered(study_files.WORKER, "check", file, output, studio.program, max(1, jobs), cwd=project.root)

    @router.get("/study/table")
    def table(folder: str, version: str = "") -> dict:
        path = project.inside(folder)
        if not study_files.is_results(path):
            return {"version": "", **about(studio, path), "columns": [], "rows": [], "ranking": [],
                    "reach": {}, "pictures": []}
        now = study_files.version_of(path)
        told = {"version": now, **about(studio, path)}
        return told if now == version else {**told, **study_files.table(path)}

    @router.get("/study/picture")
    def picture(folder: str, name: str) -> FileResponse:
        path = results_folder(project, folder)
        file = project.existing(f"{project.relative(path)}/{plain_name(name)}")
        if file.suffix != ".png":
            raise Refused(f"{one_line(name, 100)} is no picture", 404)
        return FileResponse(file, media_type="image/png")


def writing(router: APIRouter, studio: Studio) -> None:
    project, writer = studio.project, threading.Lock()

    def keep(path: str, version: str, base: str | None, over: bool, made: Callable[[str, str | None], str]) -> dict:
        """`made(now, base)`: the new text, of the one that there is and, if that is not of this version, of
        the one that the change was made upon. `over` what is of this version and has been shown."""
        file = study_file(project, path)
        with writer:
            now = read_text(file, study_files.LONGEST_STUDY)
            content = project.read(file, study_files.LONGEST_STUDY)
            if content.decode("utf-8-sig", "replace") != now:
                raise Changed("the file has just been written by another page or program")
            changed = version != study_plan.version_of(now)
            if changed and (base is None or over):
                raise Changed("the file has been changed meanwhile by another page or program")
            text = made(now, base if changed or over else None)
            if len(text.encode()) > study_files.LONGEST_STUDY:
                raise Refused("a study file has 1 MiB at most", 422)
            project.write(file, text.encode(), content)
        studio.events.send("study", path=path)
        return {"path": path, "version": study_plan.version_of(text), "text": text,
                "merged": changed}

    def told(path: str, change: Callable[[], dict]):
        try:
            return change()
        except Changed as problem:
            now = read_text(study_file(project, path), study_files.LONGEST_STUDY)
            return JSONResponse({"error": str(problem), "clashes": problem.clashes, "now": {
                "text": now, "version": study_plan.version_of(now)}}, 409)

    @router.post("/studies")
    def new(name: str = Body(...), case: str = Body(...)) -> dict:
        own_case = project.existing(case)
        file = project.inside(f"studies/{plain_name(name)}.toml")
        if file.exists():
            raise Refused(f"studies/{name}.toml is there already: give another name", 409)
        if name == "study":
            raise Refused("study.toml takes the name of its folder: give another name", 422)
        file.parent.mkdir(exist_ok=True)
        seen = os.path.relpath(own_case, file.parent)
        project.write(file, study_plan.new_text(file.name, name.replace("_", " "), seen).encode(), None)
        studio.events.send("study", path=project.relative(file))
        return {"path": project.relative(file)}

    @router.put("/study")
    def change(path: str = Body(...), version: str = Body(...), plan: dict = Body(...),
               base: str | None = Body(None), over: bool = Body(False)):
        return told(path, lambda: keep(path, version, base, over, lambda now, before: study_plan.with_plan_upon(
            before, now, plan, over)))

    @router.put("/study/text")
    def text(path: str = Body(...), version: str = Body(...), text: str = Body(...),
             base: str | None = Body(None), over: bool = Body(False)):
        study_plan.document(text)
        return told(path, lambda: keep(path, version, base, over, lambda now, before: study_plan.text_upon(
            before, now, text, over)))


def running(router: APIRouter, studio: Studio) -> None:
    project = studio.project

    @router.post("/study/start")
    def start(path: str = Body(...), threads: int = Body(1), jobs: int = Body(1),
              again: bool = Body(False)) -> dict:
        file = study_file(project, path)
        check_paths(project, file, parsed_toml(file, read_text(file)))
        if not 1 <= threads <= 1024 or not 1 <= jobs <= 1024:
            raise Refused("threads and runs at a time: 1 to 1024", 422)
        output = study_files.output_of(project, file, study_files.look_through(project)[1])
        if about(studio, output)["state"] in LIVE:
            raise Refused(f"{project.relative(output)}: a study goes on there: stop it first", 409)
        command = [sys.executable, studio.tools / "study", project.relative(file), "-o", project.relative(output),
                   "--program", studio.program, "--threads", threads, "--jobs", jobs,
                   *(["--again"] if again else [])]
        return studio.processes.begin("study", f"study {study_files.name_of(file)}", command, project.root,
                                      {"study": path, "output": project.relative(output)}, queue=True)

    @router.post("/study/picture_now")
    def pictures_now(path: str = Body(..., embed=True)) -> dict:
        """Table, ranking and pictures of what has ended so far."""
        file = study_file(project, path)
        check_paths(project, file, parsed_toml(file, read_text(file)))
        output = study_files.output_of(project, file, study_files.look_through(project)[1])
        command = [sys.executable, studio.tools / "study", project.relative(file), "-o", project.relative(output),
                   "--program", studio.program, "--table"]
        return studio.processes.begin("study table", f"table of {study_files.name_of(file)}", command,
                                      project.root, {"study": path, "output": project.relative(output)})
