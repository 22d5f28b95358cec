# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs one command for the workbench, so that it goes on, and is found again, when the workbench has
ended: launch.py RECORD.json LOCK. Imports nothing but the standard library.

Each file has one writer, so that none can undo what another has written: the workbench writes
N.json (what is to run) before this begins and N.stop (signals asked for, one a line, appended), and
this N.run (what runs) and N.end (how it ended), each whole. LOCK is the number of an open file that
the workbench has locked: this and the command hold the lock as long as either lives.
"""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

PERIOD = 0.1  # s, between two looks for a stop
PATIENCE = 3600.0  # s, with a disk that takes nothing
MAY_ASK = ("SIGINT", "SIGTERM", "SIGKILL")
IGNORED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)  # the command gets them, and ends as it does


def keep(path: Path, record: dict) -> None:
    """Whole or not at all."""
    part = path.with_name(f"part_{path.name}")
    try:
        part.write_text(json.dumps(record), encoding="utf-8")
        os.replace(part, path)
    except OSError:
        part.unlink(missing_ok=True)
        raise


def asked(path: Path) -> list[str]:
    """Signals asked for so far; a line that is being written is none yet."""
    try:
        return [name for name in path.read_text(encoding="ascii").split("\n")[:-1] if name in MAY_ASK]
    except (OSError, ValueError):
        return []


def as_from_a_terminal() -> None:
    """In the command, before it begins: a group of its own, for signals as of Ctrl-C."""
    os.setpgid(0, 0)
    for name in IGNORED:
        signal.signal(name, signal.SIG_DFL)


def begun(record: dict, log, lock: int) -> subprocess.Popen:
    return subprocess.Popen(record["command"], cwd=record["cwd"], stdin=subprocess.DEVNULL, stdout=log,
                            stderr=log, pass_fds=(lock,), preexec_fn=as_from_a_terminal)


def wait(child: subprocess.Popen, stop: Path) -> int:
    """The exit code; passes on what is asked for, which cannot hit another process: while this has
    not waited for the command, its number stays its own."""
    passed = 0
    while True:
        for name in asked(stop)[passed:]:
            passed += 1
            try:
                os.killpg(child.pid, getattr(signal, name))
            except ProcessLookupError:
                pass  # it has ended just now
        try:
            return child.wait(PERIOD)
        except subprocess.TimeoutExpired:
            continue


def patiently(path: Path, record: dict, most_s: float) -> None:
    """What is not kept is lost: a full disk is waited for, a folder that has gone is not."""
    begin = time.monotonic()
    while True:
        try:
            keep(path, record)
            return
        except FileNotFoundError:
            return
        except OSError:
            if time.monotonic() - begin > most_s:
                return
            time.sleep(min(1.0, most_s))


def end(path: Path, code: int, **more) -> None:
    patiently(path.with_suffix(".end"), {"code": code, "ended": time.time(), **more}, PATIENCE)


def main() -> None:
    path, lock = Path(sys.argv[1]), int(sys.argv[2])
    for name in IGNORED:
        signal.signal(name, signal.SIG_IGN)
    record = json.loads(path.read_text(encoding="utf-8"))
    if asked(path.with_suffix(".stop")):
        end(path, -signal.SIGINT)
        return
    with open(path.with_suffix(".log"), "ab") as log:
        try:
            child = begun(record, log, lock)
        except (OSError, ValueError, subprocess.SubprocessError) as problem:
            why = getattr(problem, "strerror", None) or str(problem)
            end(path, 1, error=f"{record['command'][0]} cannot be started: {why}")
            return
        patiently(path.with_suffix(".run"), {"pid": child.pid, "begun": time.time()}, 0.0)
        code = wait(child, path.with_suffix(".stop"))
    end(path, code)


if __name__ == "__main__":
    main()
