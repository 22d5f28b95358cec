# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands that the workbench has running: runs, meshes of tools, studies. What is known of them is
in files (records.py), kept together with launch.py.

A record: id, kind, words, command, cwd, about (what who began it wants to find again), in_queue, order
(of those that wait, the least is next), state: queued, starting, running, done, failed, stopped, or
lost (it has died without an end, or was not put here by this user); own (by this user, in this
folder: seal.py); stops (how often it was asked to end); queued, begun, ended
(s since 1970), pid, code, error (why it could not start).
"""

import fcntl
import os
import subprocess
import sys
import threading
import time
from pathlib import Path

from base.ending import one_line

from ..project.events import Events
from ..project.project import Project, Refused
from ..project.watch import watch
from .launch import MAY_ASK
from .records import LIVE, Records

LAUNCH = Path(__file__).resolve().parent / "launch.py"
PERIOD = 0.25      # s, between two looks at the records
TAIL = 16 << 10    # bytes of a log that a page is told
MOST_WAITING = 1000
MOST_ENDED = 200   # records of a kind that are kept; those of runs go with their results


class Processes:
    def __init__(self, project: Project, events: Events, at_once: int = 1):
        self.kept = Records(project.own / "processes")
        self.events = events
        self.at_once = at_once  # of those that wait in the queue
        self.lock = threading.RLock()
        self.told: dict[str, tuple] = {}
        self.ending = threading.Event()
        self.launchers: list[subprocess.Popen] = []

    def begin(self, kind: str, words: str, command: list[str], cwd: Path, about: dict | None = None,
              queue: bool = False) -> dict:
        """Starts a command, or lets it wait until those of the queue before it have ended. Raises
        Refused, OSError."""
        with self.lock:
            if queue and len(self.waiting()) >= MOST_WAITING:
                raise Refused(f"{MOST_WAITING} wait already: let some of them end", 409)
            if kind != "run":
                self.forget_old(kind)
            record = self.kept.new({"kind": kind, "words": words, "command": [str(word) for word in command],
                                    "cwd": str(cwd), "about": about or {}, "queued": time.time(),
                                    "in_queue": queue})
            if not queue:
                self.launch(record)
        self.look()
        return self.record(record["id"])

    def launch(self, record: dict) -> None:
        """The lock is taken here and handed on, so that there is no moment when nobody has it."""
        path = self.kept.path(record["id"])
        opened = os.open(path.with_suffix(".lock"),
                         os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC, 0o600)
        try:
            fcntl.flock(opened, fcntl.LOCK_EX | fcntl.LOCK_NB)
            self.kept.write({**record, "launched": True, "begun": time.time()})
            self.launchers = [one for one in self.launchers if one.poll() is None]  # no zombies
            self.launchers.append(subprocess.Popen(
                [sys.executable, "-I", str(LAUNCH), str(path), str(opened)], start_new_session=True,
                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                pass_fds=(opened,)))
        finally:
            os.close(opened)

    def record(self, number: str) -> dict:
        """Raises Refused."""
        return self.kept.one(number)

    def records(self, kind: str = "") -> list[dict]:
        return self.kept.every(kind)

    def makes(self, path: str) -> bool:
        """Whether one that has not ended is to write this file of the folder."""
        return any(path in (record["about"].get("output"), *record["about"].get("outputs", ()))
                   for record in self.records() if record["state"] in LIVE)

    def log(self, number: str, most: int = TAIL) -> str:
        """The end of what it has printed."""
        return self.kept.log(number, most)

    def waiting(self) -> list[dict]:
        """In the order in which they will begin."""
        return queue_of(self.records())

    def move(self, number: str, to: int) -> None:
        """To a place of the queue, from 0. Raises Refused."""
        with self.lock:
            queue = self.waiting()
            moved = next((record for record in queue if record["id"] == number), None)
            if moved is None:
                raise Refused("it does not wait any more", 409)
            queue.remove(moved)
            queue.insert(max(0, to), moved)
            orders = sorted(record["order"] for record in queue)
            for record, order in zip(queue, orders):
                if record["order"] != order:
                    self.kept.write({**record, "order": order})
        self.look()

    def stop(self, number: str) -> dict:
        """Takes it from the queue, or ends it as Ctrl-C does; asked again, harder: SIGTERM, then
        SIGKILL. Raises Refused."""
        with self.lock:
            record = self.record(number)
            if record["state"] in LIVE:
                word = MAY_ASK[min(record["stops"], len(MAY_ASK) - 1)]
                with open(self.kept.path(number).with_suffix(".stop"), "a", encoding="ascii") as file:
                    file.write(word + "\n")
        self.look()
        return self.record(number)

    def forget_old(self, kind: str) -> None:
        ended = [record["id"] for record in self.records(kind) if record["state"] not in LIVE]
        for number in ended[:max(0, len(ended) - MOST_ENDED + 1)]:
            self.forget(number)

    def forget(self, number: str) -> None:
        """Removes the record of one that has ended. Raises Refused."""
        with self.lock:
            if self.record(number)["state"] in LIVE:
                raise Refused("it goes on: stop it first", 409)
            self.kept.remove(number)
            self.told.pop(number, None)
        self.events.send("process", record={"id": number, "state": "forgotten"}, last="")

    def look(self) -> None:
        """Starts what waits, and tells pages what has changed: {kind: "process", record, last}."""
        with self.lock:
            records = self.records()
            live = sum(record["state"] in ("starting", "running") and record["in_queue"] for record in records)
            if begin := queue_of(records)[:max(0, self.at_once - live)]:
                for record in begin:
                    self.launch(record)
                records = self.records()
            for record in records:
                mark = (record["state"], record["order"], record["stops"],
                        *(self.kept.log_mark(record["id"]) if record["state"] in LIVE else ()))
                if self.told.get(record["id"]) != mark:
                    self.told[record["id"]] = mark
                    self.events.send("process", record=record, last=last_line(self.log(record["id"], 400)))

    def watch(self) -> threading.Thread:
        return watch(self.look, PERIOD, self.ending)


def queue_of(records: list[dict]) -> list[dict]:
    return sorted((record for record in records if record["state"] == "queued" and record["in_queue"]),
                  key=lambda record: record["order"])


def last_line(log: str) -> str:
    lines = [line for line in log.replace("\r", "\n").splitlines() if line.strip()]
    return one_line(lines[-1], 300) if lines else ""
