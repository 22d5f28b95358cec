# SPDX-License-Identifier: GPL-3.0-or-later
"""The files of commands in .plyform/processes: N.json, N.run, N.end, N.stop, N.lock, N.log, and who
writes which (launch.py). All that is known of a command stands in them, so that a workbench that
starts finds what an earlier one has begun."""

import fcntl
import json
import os
from pathlib import Path

from base.ending import one_line

from ..project.project import Refused
from .launch import asked, keep
from .seal import Seal

ENDINGS = (".run", ".end", ".stop", ".lock", ".log", ".json")  # the one that makes it known goes last
LIVE = ("queued", "starting", "running")
NEEDED = {"id": str, "kind": str, "words": str, "command": list, "cwd": str, "about": dict,
          "queued": float, "in_queue": bool, "launched": bool, "order": float}
OF_RUN = {"pid": int, "begun": (int, float)}  # what launch.py writes into N.run
OF_END = {"code": int, "ended": (int, float), "error": str}  # and into N.end


def read(path: Path) -> dict:
    """Empty if there is none, or none that can be read."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) else {}


def of_kinds(record: dict, kinds: dict) -> dict:
    """Keys that are known, with values of their kind."""
    return {key: record[key] for key, kind in kinds.items() if isinstance(record.get(key), kind)}


def changed(path: Path) -> float:
    try:
        return path.stat().st_mtime
    except OSError:
        return 0.0


def locked(path: Path) -> bool:
    """Whether who was started with this lock lives."""
    try:
        opened = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_CLOEXEC)
    except OSError:
        return False
    try:
        fcntl.flock(opened, fcntl.LOCK_SH | fcntl.LOCK_NB)
        return False
    except OSError:
        return True
    finally:
        os.close(opened)


class Records:
    def __init__(self, folder: Path):
        self.folder = folder
        folder.mkdir(exist_ok=True)
        self.ended: dict[str, dict] = {}  # those do not change any more
        self.last = 0                     # number given
        self.seal = Seal(folder.parents[1])

    def path(self, number: str) -> Path:
        """Raises Refused."""
        if not (number.isascii() and number.isdigit()) or len(number) > 9:
            raise Refused(f"{one_line(number, 20)!r} is no number of a process", 404)
        return self.folder / f"{number}.json"

    def numbers(self) -> list[str]:
        return sorted((name[:-5] for name in os.listdir(self.folder)
                       if name.endswith(".json") and name.isascii() and name[:-5].isdigit()), key=int)

    def new(self, record: dict) -> dict:
        self.last = 1 + max([self.last, *map(int, self.numbers())])
        record = {"id": f"{self.last:06d}", "order": float(self.last), "launched": False, **record}
        self.write(record)
        return record

    def write(self, record: dict) -> None:
        """What the workbench knows: before the command begins."""
        kept = {key: record[key] for key in (*NEEDED, "begun") if key in record}
        keep(self.path(record["id"]), {**kept, "seal": self.seal.of(record)})

    def remove(self, number: str) -> None:
        for ending in ENDINGS:
            self.path(number).with_suffix(ending).unlink(missing_ok=True)
        self.ended.pop(number, None)

    def one(self, number: str) -> dict:
        """With its state. Raises Refused."""
        path = self.path(number)
        if number in self.ended and path.exists():
            return dict(self.ended[number])
        record = read(path)
        if len(of_kinds(record, NEEDED)) < len(NEEDED) or record["id"] != path.stem:
            raise Refused(f"there is no process {number}", 404)
        record = {**of_kinds(record, {**NEEDED, "begun": (int, float)}), "own": self.seal.fits(record)}
        record = self.with_state(path, record)
        if record["state"] not in LIVE and record["state"] != "lost":
            self.ended[number] = record
        return dict(record)

    def with_state(self, path: Path, record: dict) -> dict:
        """The lock is looked at first: who lets it go has written its end before. What waits, but was not
        put there by this user in this folder, is lost."""
        stop = asked(path.with_suffix(".stop"))
        lives = record["launched"] and locked(path.with_suffix(".lock"))
        end, now = of_kinds(read(path.with_suffix(".end")), OF_END), of_kinds(read(path.with_suffix(".run")), OF_RUN)
        record = {**record, **now, "stops": len(stop), **end}
        if "code" in end:
            state = "done" if end["code"] == 0 else "stopped" if stop else "failed"
        elif not record["launched"] and record["own"]:
            state = "stopped" if stop else "queued"
            record = {"ended": changed(path.with_suffix(".stop")), **record} if stop else record
        elif lives:
            state = "running" if now else "starting"
        else:
            state = "lost"
        return {**record, "state": state}

    def every(self, kind: str = "") -> list[dict]:
        found = []
        for number in self.numbers():
            try:
                record = self.one(number)
            except Refused:
                continue  # damaged, or removed just now
            if kind in ("", record["kind"]):
                found.append(record)
        return found

    def log(self, number: str, most: int) -> str:
        """The end of what a command has printed."""
        try:
            with open(self.path(number).with_suffix(".log"), "rb") as file:
                file.seek(max(0, os.fstat(file.fileno()).st_size - most))
                return file.read(most).decode("utf-8", "replace")
        except OSError:
            return ""

    def log_mark(self, number: str) -> tuple[int, int]:
        """Another one when it has printed more."""
        try:
            found = self.path(number).with_suffix(".log").stat()
        except OSError:
            return (0, 0)
        return (found.st_size, found.st_mtime_ns)
