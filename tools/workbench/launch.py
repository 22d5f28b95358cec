# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs one command for the workbench and keeps its record, so that it goes on, and is found again,
when the workbench has ended: launch.py RECORD.json. Imports nothing but the standard library."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path


def born(pid: int) -> int:
    """Clock ticks from boot to the start of a process, by which a number that is used again is known;
    0 if there is no such process, or it has ended."""
    try:
        words = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except (OSError, ValueError):
        return 0
    return 0 if words[0] in "ZX" else int(words[19])


def keep(path: Path, record: dict) -> None:
    part = path.with_name("part_" + path.name)
    part.write_text(json.dumps(record), encoding="utf-8")
    os.replace(part, path)


def main() -> None:
    path = Path(sys.argv[1])
    record = json.loads(path.read_text(encoding="utf-8"))
    for name in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(name, signal.SIG_IGN)  # the command gets them, and ends as it does

    def default_signals() -> None:
        for name in (signal.SIGINT, signal.SIGTERM):
            signal.signal(name, signal.SIG_DFL)

    with open(path.with_suffix(".log"), "ab") as log:
        try:
            child = subprocess.Popen(record["command"], cwd=record["cwd"], stdin=subprocess.DEVNULL,
                                     stdout=log, stderr=log, preexec_fn=default_signals)
        except OSError as problem:
            keep(path, {**record, "state": "failed", "words": f"{record['command'][0]}: {problem.strerror}",
                        "ended": time.time()})
            return
        record.update(state="running", pid=child.pid, born=born(child.pid), begun=time.time())
        keep(path, record)
        code = child.wait()
    latest = json.loads(path.read_text(encoding="utf-8"))  # a stop may have been asked for meanwhile
    ended = "stopped" if latest.get("stop_asked") else "done" if code == 0 else "failed"
    keep(path, {**latest, "state": ended, "code": code, "ended": time.time()})


if __name__ == "__main__":
    main()
