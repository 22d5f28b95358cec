# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of plyform that are done once: a set that was stopped goes on where it was.

A run writes into a folder of its own, NAME.running.XXXX, which gets its name NAME once the run has
ended. What was killed on its way is removed and starts anew; what has ended stays, done, doubtful
or stopped by plyform, as long as it was made with the same settings (settings.json beside the
results; folders without it are taken as they are).
"""

import fcntl
import json
import os
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path
from threading import Lock

from plotting.reading import Trouble

SOURCES = Path(__file__).resolve().parents[2]
FABRIC = SOURCES / "cases/fabrics/glass_plain_weave.toml"
ENDED = ("done", "doubtful", "stopped")
SETTINGS = "settings.json"


@dataclass(frozen=True)
class Run:
    name: str                                # of its folder
    label: str                               # in tables
    case: str = "hemisphere_five_ply"        # folder of cases/
    text: str = ""                           # a case of its own, in its place
    without: str = ""                        # name of a tool that is taken out of the case
    yarns: tuple[tuple[str, float], ...] = ()  # keys for warp and weft that the fabric has not
    settings: tuple[str, ...] = ()           # KEY=VALUE
    accuracy: str = ""
    stroke_mm: float = 75.0                  # that it must reach


def fabric_text(yarns: tuple[tuple[str, float], ...]) -> str:
    """The glass weave with these keys in [warp] and in [weft]."""
    keys = "".join(f"{key} = {float(value)!r}\n" for key, value in yarns)
    text = FABRIC.read_text(encoding="utf-8")
    for family in ("[warp]\n", "[weft]\n"):
        if text.count(family) != 1:
            raise Trouble(f"{FABRIC} has no line {family.strip()}")
        text = text.replace(family, family + keys)
    return text


def without_tool(text: str, name: str) -> str:
    """A case without the [[tool]] of that name."""
    blocks, kept = [[]], []
    for line in text.splitlines(keepends=True):
        if line.startswith("["):
            blocks.append([])
        blocks[-1].append(line)
    for block in blocks:
        if not (block and block[0].startswith("[[tool]]") and f'name = "{name}"\n' in block):
            kept += block
    if len(kept) == sum(map(len, blocks)):
        raise Trouble(f"the case has no tool {name}")
    return "".join(kept)


def case_of(run: Run) -> tuple[Path, str]:
    """The case file, and its text where it is not to be taken as it is."""
    path = SOURCES / "cases" / run.case / "case.toml"
    if run.without:
        return path, without_tool(path.read_text(encoding="utf-8"), run.without)
    return path, run.text


def wanted(run: Run) -> dict:
    """What decides a run's results, to tell whether a folder holds this run."""
    told = {key: value for key, value in asdict(run).items()
            if key not in ("name", "label", "stroke_mm")}
    return json.loads(json.dumps(told))


@dataclass
class Folder:
    """A folder of runs."""
    path: Path

    def of(self, run: Run) -> Path:
        return self.path / "runs" / run.name

    def settings(self, run: Run) -> dict:
        file = self.of(run) / SETTINGS
        return json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}

    def status(self, run: Run) -> str:
        """Of a run that has ended, else empty; "other settings" if it was another run."""
        file = self.of(run) / "summary.json"
        if not file.is_file():
            return ""
        try:
            status = json.loads(file.read_text(encoding="utf-8"))["status"]
        except (ValueError, KeyError):
            return ""
        if status not in ENDED:
            return ""
        made = self.settings(run).get("wanted")
        return status if made in (None, wanted(run)) else "other settings"

    def inputs(self, run: Run) -> list[str]:
        """Writes the run's fabric and case, if they are its own; words of the command."""
        folder = self.path / "inputs"
        folder.mkdir(parents=True, exist_ok=True)
        case, text = case_of(run)
        if text:
            case = folder / f"{run.name}.toml"
            case.write_text(text, encoding="utf-8")
        fabric = FABRIC
        if run.yarns:
            fabric = folder / f"{run.name}_fabric.toml"
            fabric.write_text(fabric_text(run.yarns), encoding="utf-8")
        words = [str(case)]
        if text or run.yarns:
            words += ["--set", f"fabrics.glass={json.dumps(str(fabric.resolve()))}"]
        for setting in run.settings:
            words += ["--set", setting]
        return words + (["--accuracy", run.accuracy] if run.accuracy else [])


class Runner:
    """Runs what is not there yet, some at a time, one thread each."""

    def __init__(self, program: Path, folder: Folder, jobs: int):
        self.program, self.folder, self.jobs = program, folder, jobs
        self.alive: set[subprocess.Popen] = set()
        self.lock, self.leaving, self.count = Lock(), False, 0

    def run_all(self, runs: list[Run], again: bool) -> list[str]:
        """Each name once. A sentence for each run that left no results."""
        (self.folder.path / "runs").mkdir(parents=True, exist_ok=True)
        with open(self.folder.path / ".lock", "w", encoding="utf-8") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError as problem:
                raise Trouble(f"another command runs into {self.folder.path}") from problem
            return self.run_locked(list({run.name: run for run in runs}.values()), again)

    def run_locked(self, runs: list[Run], again: bool) -> list[str]:
        for rest in (self.folder.path / "runs").glob("*.running.*"):
            shutil.rmtree(rest, ignore_errors=True)  # killed on its way
        todo = [run for run in runs
                if again or self.folder.status(run) not in ENDED]
        say(f"{len(runs) - len(todo)} of {len(runs)} runs are there")
        if todo and shutil.which(self.program) is None:
            raise Trouble(f"{self.program} is no program: give --program")
        try:
            with ThreadPoolExecutor(self.jobs) as pool:
                futures = [pool.submit(self.run, run, len(todo)) for run in todo]
                try:
                    return [trouble for future in futures if (trouble := future.result())]
                except BaseException:
                    self.leave()
                    raise
        finally:
            self.leave()

    def leave(self) -> None:
        """No run starts any more, those under way are ended."""
        with self.lock:
            self.leaving = True
            for process in self.alive:
                process.terminate()

    def start(self, run: Run, place: Path) -> subprocess.Popen | None:
        command = [str(self.program), "run", *self.folder.inputs(run), "--threads", "1",
                   "-o", str(place)]
        (place / SETTINGS).write_text(json.dumps({"wanted": wanted(run)}), encoding="utf-8")
        with self.lock:
            if self.leaving:
                return None
            with open(place / "log.txt", "w", encoding="utf-8") as log:
                process = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT)
            self.alive.add(process)
        return process

    def run(self, run: Run, of: int) -> str:
        if self.leaving:
            return ""
        place = Path(tempfile.mkdtemp(prefix=f"{run.name}.running.",
                                      dir=self.folder.path / "runs"))
        process = self.start(run, place)
        if process is None:
            return ""
        _, code, usage = os.wait4(process.pid, 0)
        with self.lock:
            process.returncode = os.waitstatus_to_exitcode(code)
            self.alive.discard(process)
        cpu = usage.ru_utime + usage.ru_stime
        (place / SETTINGS).write_text(json.dumps({"wanted": wanted(run), "cpu_s": cpu}),
                                      encoding="utf-8")
        if process.returncode in (0, 3) and (place / "summary.json").is_file():
            return self.keep(run, place, cpu, of)
        lines = (place / "log.txt").read_text(encoding="utf-8", errors="replace").splitlines()
        return f"{run.name} left no results (exit code {process.returncode}): " + \
            " / ".join(lines[-2:])

    def keep(self, run: Run, place: Path, cpu: float, of: int) -> str:
        place.chmod(0o755)  # as other folders, and unlike temporary ones
        final = self.folder.of(run)
        if final.exists():
            old = Path(tempfile.mkdtemp(prefix=f"{run.name}.running.", dir=final.parent))
            final.rename(old / "old")
            shutil.rmtree(old, ignore_errors=True)
        place.rename(final)
        with self.lock:
            self.count += 1
            say(f"{self.count}/{of}  {run.name}  {self.folder.status(run) or 'not ended'}  "
                f"{cpu:.0f} s of CPU")
        return ""


def say(line: str) -> None:
    print(line, file=sys.stderr, flush=True)
