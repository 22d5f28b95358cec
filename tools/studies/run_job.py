# SPDX-License-Identifier: GPL-3.0-or-later
"""One job of a study: runs plyform for each of its runs that has not ended yet.

    run_job.py JOBS.json JOB         in the study's folder

A run writes into runs/NAME.running and gets its name once it is whole, with ended.json beside the
results: how it ended, its times, its settings. What was killed on its way starts anew. A lock holds
off a second job with the same run, such as one still under way on a cluster.
"""

import ctypes
import fcntl
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

SOUND = ("done", "doubtful", "instant")  # base.summary_file has it; this program imports nothing of others
ENDED = "ended.json"
KILLED_FOLDER = "killed"  # of notes on runs that were ended from outside
LOG_END = 4096            # bytes of a log that are looked at
DIES_WITH_PARENT = 1  # PR_SET_PDEATHSIG
KILLED = {signal.SIGINT, signal.SIGTERM, signal.SIGKILL, signal.SIGHUP}  # from outside
C = ctypes.CDLL(None)


def die_with_parent() -> None:
    C.prctl(DIES_WITH_PARENT, signal.SIGKILL)


def read_json(file: Path) -> dict:
    """Empty for what is no file of this program."""
    try:
        data = json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}
    except (OSError, ValueError, RecursionError):
        return {}
    return data if isinstance(data, dict) else {}


def end_of_log(work: Path) -> str:
    with open(work / "log.txt", "rb") as log:
        log.seek(max(0, log.seek(0, os.SEEK_END) - LOG_END))
        lines = log.read().decode("utf-8", "replace").splitlines()
    return " / ".join(line.strip() for line in lines[-2:])


def how(code: int) -> str:
    """A run's end, in words."""
    if code >= 0:
        return f"exit code {code}"
    names = {signal.SIGKILL: " from outside, or by the system where memory is short",
             signal.SIGXCPU: ": its processor time is used up",
             signal.SIGXFSZ: ": a file is larger than it may be"}
    try:
        return f"ended by {signal.Signals(-code).name}{names.get(-code, '')}"
    except ValueError:
        return f"ended by signal {-code}"


def status_of(code: int, summary: dict) -> str:
    """Empty if it was ended from outside: that run is still to be done."""
    status = summary.get("status")
    if -code in KILLED or status == "interrupted":
        return ""
    if code == 0 and status in SOUND or code == 3 and status == "stopped":
        return status
    return "refused" if code == 2 else "failed"


def call(command: list[str], work: Path) -> tuple[int, float, float]:
    """Exit code (less than 0: a signal), seconds of all threads, and on the clock."""
    begin = time.monotonic()
    with open(work / "log.txt", "w", encoding="utf-8") as log:
        process = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT,
                                   preexec_fn=die_with_parent)
    _, code, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(code)
    return (process.returncode, usage.ru_utime + usage.ru_stime, time.monotonic() - begin)


def do_run(name: str, run: dict, study: dict) -> bool:
    """False if it was ended from outside."""
    final, work = Path("runs") / name, Path("runs") / f"{name}.running"
    with open(Path("locks") / name, "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if (final / ENDED).is_file():
            return True
        for rest in (work, final):
            shutil.rmtree(rest, ignore_errors=True)
        work.mkdir(parents=True)
        code, cpu, wall = call([study["program"], "run", *run["words"], "-o", str(work),
                                "--threads", str(study["threads"])], work)
        summary = read_json(work / "summary.json")
        status = status_of(code, summary)
        killed = Path(KILLED_FOLDER) / name
        if not status:
            killed.write_text(how(code) if code < 0 else "interrupted", encoding="utf-8")
            print(f"{name}: {killed.read_text(encoding='utf-8')}", flush=True)
            return False
        killed.unlink(missing_ok=True)
        message = summary.get("message") or "" if status in (*SOUND, "stopped") else \
            f"{how(code)}: {end_of_log(work)}"
        end = {"status": status, "exit_code": code, "cpu_s": cpu,
                "wall_time_s": summary.get("wall_time_s", wall), "message": message, **run}
        (work / ENDED).write_text(json.dumps(end, indent=1), encoding="utf-8")
        work.rename(final)
    return True


def main() -> int:
    die_with_parent()
    study = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    for folder in ("runs", "locks", KILLED_FOLDER):
        Path(folder).mkdir(exist_ok=True)
    whole = [do_run(name, study["runs"][name], study) for name in study["jobs"][sys.argv[2]]]
    return 0 if all(whole) else 1


if __name__ == "__main__":
    sys.exit(main())
