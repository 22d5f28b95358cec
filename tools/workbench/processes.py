# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands that the workbench has running: runs, meshes of tools, studies. Each has a record and a log
in .plyform/processes, kept by launch.py, which are all that is known of it: a workbench that starts
finds what an earlier one has begun.

A record: id, kind, words, command, cwd, about (what who began it wants to find again), state: queued,
running, done, failed, stopped, or lost (it has died without an end); pid, born, queued, begun, ended
(s since 1970), code.
"""

import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

from base.ending import one_line

from .events import Events
from .launch import born, keep
from .project import Project, Refused

LAUNCH = Path(__file__).resolve().parent / "launch.py"
PERIOD = 0.25      # s, between two looks at the records
TAIL = 16 << 10    # bytes of a log that a page is told
STARTING = 10.0    # s that a process may take to write its record
LIVE = ("queued", "starting", "running")


class Processes:
    def __init__(self, project: Project, events: Events, at_once: int = 1):
        self.folder = project.own / "processes"
        self.folder.mkdir(exist_ok=True)
        self.events = events
        self.at_once = at_once  # of those that wait in the queue
        self.lock = threading.RLock()
        self.told: dict[str, tuple] = {}
        self.ending = threading.Event()

    def begin(self, kind: str, words: str, command: list[str], cwd: Path, about: dict | None = None,
              queue: bool = False) -> dict:
        """Starts a command, or lets it wait until those of the queue before it have ended."""
        with self.lock:
            number = 1 + max([int(name.stem) for name in self.folder.glob("[0-9]*.json")], default=0)
            record = {"id": f"{number:06d}", "kind": kind, "words": words, "command": list(map(str, command)),
                      "cwd": str(cwd), "about": about or {}, "state": "queued", "queued": time.time(),
                      "in_queue": queue}
            keep(self.path(record["id"]), record)
            if not queue:
                record = self.launch(record)
        self.look()
        return record

    def launch(self, record: dict) -> dict:
        record = {**record, "state": "starting", "begun": time.time()}
        keep(self.path(record["id"]), record)
        subprocess.Popen([sys.executable, "-I", str(LAUNCH), str(self.path(record["id"]))],
                         start_new_session=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                         stderr=subprocess.DEVNULL)
        return record

    def path(self, number: str) -> Path:
        if not number.isdigit() or len(number) > 9:
            raise Refused(f"{one_line(number, 20)!r} is no number of a process", 404)
        return self.folder / f"{number}.json"

    def record(self, number: str) -> dict:
        """Raises Refused."""
        try:
            record = json.loads(self.path(number).read_text(encoding="utf-8"))
        except (OSError, ValueError) as problem:
            raise Refused(f"there is no process {number}", 404) from problem
        if record["state"] == "running" and born(record["pid"]) != record["born"]:
            record = self.after_end(record)
        if record["state"] == "starting" and time.time() - record["begun"] > STARTING:
            record = {**record, "state": "lost"}
        return record

    def after_end(self, record: dict) -> dict:
        """Of one whose command is gone: what launch.py writes soon, or lost if that is gone too."""
        time.sleep(0.05)
        again = json.loads(self.path(record["id"]).read_text(encoding="utf-8"))
        return {**again, "state": "lost"} if again["state"] == "running" else again

    def records(self, kind: str = "") -> list[dict]:
        found = [self.record(path.stem) for path in sorted(self.folder.glob("[0-9]*.json"))]
        return [record for record in found if kind in ("", record["kind"])]

    def log(self, number: str, most: int = TAIL) -> str:
        """The end of what it has printed."""
        try:
            with open(self.path(number).with_suffix(".log"), "rb") as file:
                size = os.fstat(file.fileno()).st_size
                file.seek(max(0, size - most))
                return file.read(most).decode("utf-8", "replace")
        except OSError:
            return ""

    def stop(self, number: str, how: int = signal.SIGINT) -> dict:
        """Ctrl-C, or takes it from the queue. Raises Refused."""
        with self.lock:
            record = self.record(number)
            if record["state"] == "queued":
                keep(self.path(number), {**record, "state": "stopped", "ended": time.time()})
            elif record["state"] == "running":
                keep(self.path(number), {**record, "stop_asked": True})
                if born(record["pid"]) == record["born"]:
                    os.kill(record["pid"], how)
        self.look()
        return self.record(number)

    def forget(self, number: str) -> None:
        """Removes the record of one that has ended. Raises Refused."""
        if self.record(number)["state"] in LIVE:
            raise Refused("it goes on: stop it first", 409)
        for ending in (".json", ".log"):
            self.path(number).with_suffix(ending).unlink(missing_ok=True)
        self.look()

    def look(self) -> None:
        """Starts what waits, and tells pages what has changed: {kind: "process", record}."""
        with self.lock:
            records = self.records()
            live = sum(record["state"] in ("starting", "running") and record["in_queue"] for record in records)
            for record in records:
                if record["state"] == "queued" and record["in_queue"] and live < self.at_once:
                    self.launch(record)
                    live += 1
            for record in self.records():
                size = len(self.log(record["id"], 400))
                mark = (record["state"], size, self.log(record["id"], 400)[-80:])
                if self.told.get(record["id"]) != mark:
                    self.told[record["id"]] = mark
                    self.events.send("process", record=record, last=last_line(self.log(record["id"], 400)))

    def watch(self) -> threading.Thread:
        def go_on() -> None:
            while not self.ending.wait(PERIOD):
                try:
                    self.look()
                except (OSError, ValueError):
                    continue  # a record that is being written, or a full disk: again soon
        thread = threading.Thread(target=go_on, daemon=True)
        thread.start()
        return thread


def last_line(log: str) -> str:
    lines = [line for line in log.replace("\r", "\n").splitlines() if line.strip()]
    return one_line(lines[-1], 300) if lines else ""
