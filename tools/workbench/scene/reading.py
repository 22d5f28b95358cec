# SPDX-License-Identifier: GPL-3.0-or-later
"""What the program itself says of a case: its scene, its mistakes, how long a run takes. Asked of processes
beside the workbench, kept as long as no file of the case changes."""

import os
import re
import shutil
import threading
from pathlib import Path

from base.ending import Trouble

from ..cases.files import CaseFiles, version_of
from ..cases.paths import MOST_TEXT, paths_inside
from ..project.project import Refused
from ..project.watch import watch
from .draft_tools import is_large
from .readers import Worker, Workers

MOST_KEPT = 20
NO_FILE = 0, 0, 0  # the stamp of one that is missing
DRAFTS = "drafts"  # files of the workbench's own
MOST_FOLLOWED = 50
OF_A_PLY = re.compile(r"ply\.\d{1,4}\.(angle|rotation|z)")
PERIOD = 0.5  # s between two looks at the files of cases that pages look at


class CaseReading:
    def __init__(self, files: CaseFiles, program: Path):
        self.files = files
        self.project = files.project
        self.program = program
        self.workers = Workers(module_of(program))
        self.kept: dict[tuple, object] = {}
        self.lock = threading.Lock()
        self.followed: dict[str, tuple] = {}  # stamps by name
        shutil.rmtree(self.project.own / DRAFTS, ignore_errors=True)

    def warm(self) -> None:
        """The first picture comes at once."""
        self.workers.warm()

    def stop(self) -> None:
        self.workers.stop()

    def asked(self, name: str, version: str) -> tuple[str, tuple, Path]:
        """Name, stamp of all its files and path of a case. Raises Refused, also if it names files outside."""
        path = self.files.path(name)
        if version_of(self.project.read(path, MOST_TEXT)) != version:
            raise Refused("the file has changed meanwhile: here it is anew", 409)
        name = self.project.relative(path)
        stamp = self.stamp(path)
        if stamp[0] == (str(path), *NO_FILE):
            raise Refused(f"{name} is missing", 404)
        self.follow(name, stamp)
        return name, stamp, path

    def stamp(self, path: Path) -> tuple:
        return tuple(self.of_file(file) for file in paths_inside(self.project, path))

    @staticmethod
    def of_file(file: Path) -> tuple:
        try:
            status = os.stat(file)
            return str(file), status.st_mtime_ns, status.st_size, status.st_ino
        except OSError:
            return str(file), *NO_FILE

    def scene(self, name: str, version: str) -> bytes:
        name, stamp, path = self.asked(name, version)
        return self.once(("scene", name), stamp, lambda: self.bytes_of(self.workers.scene, "scene", path, stamp))

    def draft(self, name: str, version: str) -> bytes:
        """The scene, or one with `draft` in its header: tools of many facets are drawn with few, and nothing is
        said of their gaps and first contacts."""
        stamped, stamp, path = self.asked(name, version)
        known = self.known(("scene", stamped), stamp)
        if known is None and has_large(stamp):
            known = self.once(("draft", stamped), stamp, lambda: self.bytes_of(
                self.workers.draft, "draft", path, stamp, room=str(self.project.own / DRAFTS)))
        return known or self.scene(name, version)

    def check(self, name: str, version: str) -> dict:
        name, stamp, path = self.asked(name, version)
        worker = self.workers.scene if has_large(stamp) else self.workers.check  # which has read them already
        found = self.once(("check", name), stamp, lambda: self.dict_of(worker, "check", path, stamp))
        answer = {"version": version, **found, "outlook": None}
        if not found["mistakes"]:
            known = self.known(("outlook", name), stamp)
            if known is None:
                threading.Thread(target=self.look_ahead, args=(name, version, stamp, path), daemon=True).start()
            else:
                answer["outlook"] = known["outlook"]
        return answer

    def instant(self, name: str, version: str, key: str, value: float | None) -> bytes:
        """How the plies will be formed, each alone; or one of them, with another value of a key of it."""
        if key and not OF_A_PLY.fullmatch(key):
            raise Refused("only angles, rotations and heights of plies are tried", 422)
        name, stamp, path = self.asked(name, version)
        change = {"settings": {key: value}, "ply": int(key.split(".")[1])} if key else {"settings": {}, "ply": None}
        return self.once(("instant", name), (*stamp, key, value), lambda: self.bytes_of(
            self.workers.instant, "instant", path, stamp, threads=len(os.sched_getaffinity(0)), **change))

    def look_ahead(self, name: str, version: str, stamp: tuple, path: Path) -> None:
        """Tells {kind: "outlook", path, version, outlook} when it is known."""
        try:
            found = self.once(("outlook", name), stamp,
                              lambda: self.dict_of(self.workers.outlook, "outlook", path, stamp, threads=1))
            self.files.events.send("outlook", path=name, version=version, outlook=found["outlook"],
                                   why=found.get("why", ""))
        except Refused as problem:
            if problem.code != 409:  # a newer one comes
                self.files.events.send("outlook", path=name, version=version, outlook=None, why=str(problem))

    def bytes_of(self, worker: Worker, act: str, path: Path, stamp: tuple, **more) -> bytes:
        said, content = worker.ask(act, file=str(path), stamp=stamp, **more)
        self.sound(said, path, stamp)
        return content

    def dict_of(self, worker: Worker, act: str, path: Path, stamp: tuple, **more) -> dict:
        said, _ = worker.ask(act, file=str(path), stamp=stamp, **more)
        self.sound(said, path, stamp)
        for mistake in said.get("mistakes", []):
            mistake["file"] = self.shown(mistake["file"])
            mistake["text"] = mistake["text"].replace(str(self.project.root) + "/", "")
        return said

    def sound(self, said: dict, path: Path, stamp: tuple) -> None:
        if self.stamp(path) != stamp:  # then it may have failed for that
            raise Refused("a file of the case has changed meanwhile", 409)
        self.without_fault(said)
        if "newer" in said:
            raise Refused("the case has changed meanwhile", 409)
        if "refused" in said:
            raise Refused(said["refused"], 422)

    @staticmethod
    def without_fault(said: dict) -> None:
        if "error" in said:
            raise Refused(f"this is a fault of plyform, not of your files: {said['error']}; please report it", 500)

    def shown(self, file: str) -> str:
        path = Path(os.path.realpath(file))
        return self.project.relative(path) if path.is_relative_to(self.project.root) else path.name

    def known(self, what: tuple, stamp: tuple):
        with self.lock:
            stamped = self.kept.get(what)
            return stamped[1] if stamped and stamped[0] == stamp else None

    def once(self, what: tuple, stamp: tuple, make):
        known = self.known(what, stamp)
        if known is not None:
            return known
        made = make()
        with self.lock:
            self.kept.pop(what, None)
            self.kept[what] = stamp, made
            while len(self.kept) > MOST_KEPT:
                self.kept.pop(next(iter(self.kept)))
        return made

    def follow(self, name: str, stamp: tuple) -> None:
        with self.lock:
            seen = self.followed.pop(name, stamp)  # what has changed since is still to be told
            self.followed[name] = seen
            while len(self.followed) > MOST_FOLLOWED:
                self.followed.pop(next(iter(self.followed)))

    def watch(self, ending: threading.Event, folder) -> None:
        """Tells pages of changes that other programs make: to a case or its files, and of files that come
        and go."""
        before = folder.stamp()

        def tell() -> None:
            nonlocal before
            for name in list(self.followed):
                self.look(name)
            if before != (before := folder.stamp()):
                self.files.events.send("folder")
        watch(tell, PERIOD, ending)

    def look(self, name: str) -> None:
        with self.files.lock:  # not between an edit and what is told of it
            self.look_now(name)

    def look_now(self, name: str) -> None:
        try:
            path = self.files.path(name)
            stamp, version = self.stamp(path), version_of(self.project.read(path, MOST_TEXT))
        except (Refused, OSError):
            stamp, version = (), ""
        old = self.followed.get(name)
        if old is None or stamp == old:
            return
        with self.lock:
            self.followed[name] = stamp
        others = self.changed_beside(old, stamp)
        if others or version != self.files.versions.get(name):
            self.files.versions[name] = version
            self.files.events.send("case", path=name, version=version, others=others)

    def changed_beside(self, old: tuple, stamp: tuple) -> dict[str, str]:
        """Versions of the files of a case, itself left out, that are not as they were; "" of what is no text."""
        found = {}
        for file, *_ in (one for one in stamp[1:] if one not in old):
            path = Path(file)
            try:
                text = path.suffix.lower() == ".toml"
                found[self.project.relative(path)] = version_of(self.project.read(path, MOST_TEXT)) if text else ""
            except (Refused, OSError):
                found[self.project.relative(path)] = ""
        return found


def has_large(stamp: tuple) -> bool:
    return any(is_large(file, size) for file, _, size, _ in stamp)


def module_of(program: Path) -> Path:
    """The folder that Python's module of the same build lies in. Raises Trouble."""
    for place in (program.parents[1] / "python", program.parents[1] / "lib/python3/dist-packages"):
        if (place / "plyform/__init__.py").is_file():
            return place
    raise Trouble(f"there is no Python module beside {program}, which the workbench stands on: build it, as "
                  "tools/form.sh does")
