# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of the folder: those that the workbench has begun, and all folders with results, whoever has
begun them. A run: name, folder, case, state (STATES), status (of summary.json), title, message, progress
(of progress.json), states (written so far), can_resume, record (of the process, without its log), begun,
ended (s since 1970)."""

import json
import os
import re
import threading
import time
from pathlib import Path

from base.ending import Trouble, one_line
from base.files import read_json
from base.summary_file import read_summary

from ..processes.processes import Processes
from ..processes.records import LIVE
from ..project.project import OWN, Project

STATES = ("queued", "starting", "running", "done", "doubtful", "instant", "stopped", "interrupted", "failed", "killed",
          "taken out", "damaged")
SIGNS = ("summary.json", "progress.json", "results.h5")
OF_SUMMARY = ("status", "message", "title", "stroke_mm", "wall_time_s", "steps", "version")
STATE_FILE = re.compile(r"[0-9]{6,}\.h5")
DEPTH, MOST_FOLDERS = 6, 20_000
LOOK_AGAIN = 2.0       # s, for new folders
TICK = os.sysconf("SC_CLK_TCK")
MOST_PROGRESS = 64 << 10  # bytes


def born(pid: int) -> float:
    """When a process that lives has begun, s since 1970; 0 if there is none."""
    try:
        words = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8", errors="replace")
        words = words.rpartition(")")[2].split()
        up = float(Path("/proc/uptime").read_text(encoding="ascii").split()[0])
    except (OSError, ValueError):
        return 0.0
    return 0.0 if words[0] in "ZX" else time.time() - up + int(words[19]) / TICK


def has_open(pid: int, folder: Path) -> bool:
    """A run has its folder open, by which it keeps others out. Of another user nobody can say."""
    try:
        opened = os.listdir(f"/proc/{pid}/fd")
    except PermissionError:
        return True
    except OSError:
        return False
    for number in opened:
        try:
            if os.readlink(f"/proc/{pid}/fd/{number}") == os.path.realpath(folder):
                return True
        except OSError:
            continue  # closed just now
    return False


def progress_of(folder: Path) -> dict | None:
    """What a run says that goes on. One that has been killed leaves its file: whoever has its number
    now has begun later than that was written."""
    path = folder / "progress.json"
    try:
        written = path.stat().st_mtime
        found = read_json(path, MOST_PROGRESS)
    except (OSError, Trouble):
        return None
    if not isinstance(found, dict) or not isinstance(found.get("pid"), int):
        return None
    goes_on = 0.0 < born(found["pid"]) <= written + 1.0 and has_open(found["pid"], folder)
    return {**found, "goes_on": goes_on}


def mark_of(folder: Path, names: tuple[str, ...] = (*SIGNS, "checkpoint")) -> tuple:
    """Another one when a file has changed that a run is known by; None for each that is not there."""
    found = []
    for name in names:
        try:
            stat = os.stat(folder / name)
            found.append((stat.st_mtime_ns, stat.st_size, stat.st_ino))
        except OSError:
            found.append(None)
    return tuple(found)


class RunList:
    def __init__(self, project: Project, processes: Processes):
        self.project, self.processes = project, processes
        self.lock = threading.Lock()
        self.found: dict[str, tuple] = {}  # by folder: its mark, what it holds
        self.folders: list[str] = []
        self.looked = -LOOK_AGAIN

    def every(self) -> list[dict]:
        """The newest first."""
        with self.lock:
            records: dict[str, dict] = {}
            for record in self.processes.records("run"):
                records[str(record["about"].get("output", ""))] = record  # the latest of a folder
            records.pop("", None)
            names = dict.fromkeys([*records, *self.known_folders()])
            runs = [self.one(name, records.get(name)) for name in names]
        return sorted((run for run in runs if run), key=lambda run: -run["begun"])

    def of(self, name: str) -> dict | None:
        with self.lock:
            record = next((one for one in reversed(self.processes.records("run"))
                           if one["about"].get("output") == name), None)
            return self.one(name, record) if record or name in self.known_folders() else None

    def known_folders(self) -> list[str]:
        if time.monotonic() - self.looked > LOOK_AGAIN:
            self.folders = list(folders_of_results(self.project))
            self.looked = time.monotonic()
        return self.folders

    def look_again(self) -> None:
        self.looked = -LOOK_AGAIN

    def one(self, name: str, record: dict | None) -> dict | None:
        folder = self.project.root / name
        mark = mark_of(folder)
        if not any(mark[:len(SIGNS)]) and (not record or record["state"] == "done"):
            return None  # removed
        if name not in self.found or self.found[name][0] != mark:
            self.found[name] = (mark, held_by(folder))
        held = self.found[name][1]
        progress = progress_of(folder) if mark[1] else None
        return described(self.project, name, held, progress, record)


def folders_of_results(project: Project):
    """Not in folders of results, in hidden ones, or through links."""
    walk, count = [(project.root, 0)], 0
    while walk and count < MOST_FOLDERS:
        folder, depth = walk.pop()
        count += 1
        try:
            entries = list(os.scandir(folder))
        except OSError:
            continue
        if depth and any(entry.name in SIGNS for entry in entries):
            yield project.relative(folder)
            continue
        if depth < DEPTH:
            walk += [(Path(entry.path), depth + 1) for entry in entries
                     if not entry.name.startswith(".") and entry.is_dir(follow_symlinks=False)]


def states_in(history: Path) -> int:
    """A row each, below their names."""
    try:
        with open(history, "rb") as file:
            return max(0, sum(part.count(b"\n") for part in iter(lambda: file.read(1 << 20), b"")) - 1)
    except OSError:
        return 0


def states_so_far(folder: Path) -> int:
    """Of a run that goes on: each state is a file (progress.json counts them at every 100th step)."""
    try:
        return sum(STATE_FILE.fullmatch(name) is not None for name in os.listdir(folder / "states"))
    except OSError:
        return 0


def held_by(folder: Path) -> dict:
    """What the files of an ended run say; slow ones are read once."""
    held = {"summary": None, "summed_up": 0.0, "damaged": "", "written": 0.0,
            "states": states_in(folder / "history.csv"), "checkpoint": (folder / "checkpoint").is_file()}
    for sign in SIGNS:
        try:
            held["written"] = max(held["written"], (folder / sign).stat().st_mtime)
        except OSError:
            pass
    if (folder / "summary.json").exists():
        try:
            held["summed_up"] = (folder / "summary.json").stat().st_mtime
            summary = read_summary(folder, ("status",))
            held["summary"] = {key: summary.get(key) for key in OF_SUMMARY}
        except (Trouble, OSError) as problem:
            held["damaged"] = one_line(problem)
    return held


def described(project: Project, name: str, held: dict, progress: dict | None,
              record: dict | None) -> dict:
    """The summary of a run before this one stays until the first state of this one."""
    goes_on = bool(progress and progress.pop("goes_on"))
    since = record.get("begun", record["queued"]) if record else 0.0
    summary = held["summary"] if held["summed_up"] >= since - 0.05 else None
    state = state_of(held, goes_on, summary, record)
    live = state in LIVE
    case = (record or {}).get("about", {}).get("case") or case_in(project, (progress or {}).get("case"))
    return {"name": name.rpartition("/")[2], "folder": name, "case": case, "state": state,
            "status": (summary or {}).get("status") or "", "title": (summary or {}).get("title") or "",
            "message": message_of(state, held, summary, record),
            "progress": progress if live else None,
            "states": states_so_far(project.root / name) if state == "running" else held["states"],
            "stroke_mm": (summary or {}).get("stroke_mm"), "wall_time_s": (summary or {}).get("wall_time_s"),
            "can_resume": held["checkpoint"] and bool(case) and state in ("interrupted", "killed", "failed"),
            "record": record, "begun": since or held["written"],
            "ended": 0.0 if live else (record or {}).get("ended") or held["written"]}


def state_of(held: dict, goes_on: bool, summary: dict | None, record: dict | None) -> str:
    if record and record["state"] in LIVE:
        return record["state"]
    if goes_on:
        return "running"
    if summary:
        return summary["status"]
    if held["damaged"]:
        return "damaged"
    if record and record["state"] == "failed":
        return "failed" if record.get("code", 1) >= 0 else "killed"
    if record and record["state"] == "stopped":
        return "interrupted" if held["states"] and record.get("pid") else "taken out"
    return "killed"


def message_of(state: str, held: dict, summary: dict | None, record: dict | None) -> str:
    if summary:
        return one_line(summary["message"] or "")
    return {"damaged": held["damaged"], "failed": (record or {}).get("error", ""),
            "taken out": "ended before it had begun", "killed":
            "it ended without a word: killed, or the machine went down" +
            ("; Resume goes on from its last checkpoint" if held["checkpoint"] else "")}.get(state, "")


def case_in(project: Project, path: object) -> str:
    """As the page names it; empty if it lies elsewhere."""
    if not isinstance(path, str) or "\0" in path or not path.startswith(str(project.root) + os.sep):
        return ""
    name = os.path.relpath(path, project.root)
    return "" if name.split(os.sep)[0] == OWN else one_line(name)


def mark_of_list(runs: list[dict]) -> str:
    """Another one when the list has to be shown anew; how far runs are is told in between."""
    return json.dumps([[run[key] for key in ("folder", "state", "message", "can_resume", "begun")] +
                       [(run["record"] or {}).get(key) for key in ("id", "order", "stops")] for run in runs])
