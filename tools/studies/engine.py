# SPDX-License-Identifier: GPL-3.0-or-later
"""Has Snakemake do the runs of a study that are missing, and says how far it is."""

import contextlib
import fcntl
import importlib.util
import json
import math
import os
import shlex
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from base.ending import NotReached, Trouble
from base.files import is_file, read_text
from base.progress import Progress
from plotting.whole_file import make_whole, write_whole
from studies.plan import Run
from studies.reader import is_number
from studies.run_job import ENDED, KILLED_FOLDER, die_with_parent, read_json

HERE = Path(__file__).resolve().parent
STATUS_VARIABLE = "PLYFORM_SLURM_STATUS"  # where profiles/slurm finds its program
STATUS_PROGRAM = HERE / "profiles" / "slurm" / "status.sh"
PLUGIN = "snakemake_executor_plugin_cluster_generic"
JOB_S = 10.0           # a job of this machine takes as many runs as fill this time
CLUSTER_JOB_S = 60.0   # a job of a cluster costs seconds of its own
LOOK_S = 0.5           # between looks at what has ended


@dataclass
class Options:
    program: Path
    folder: Path
    jobs: int               # at a time; 0: as the profile says
    threads: int            # of each
    profile: str = ""       # of Snakemake; empty: this machine
    runs_per_job: int = 0   # 0: by their time
    again: bool = False     # failed runs too
    first: str = ""         # name of the longest run, which begins first
    study: Path = Path()    # its file, told beside the results


def ended(folder: Path, run: Run) -> dict:
    """What the run left; empty if it has not ended."""
    end = read_json(folder / "runs" / run.name / ENDED)
    right = isinstance(end.get("status"), str) and isinstance(end.get("message", ""), str) and \
        all(is_number(end.get(key, 0.0)) for key in ("cpu_s", "wall_time_s"))
    return end if right else {}


def killed(folder: Path, run: Run) -> str:
    """How a run that has not ended was ended from outside, in words; empty if it was not."""
    note = folder / KILLED_FOLDER / run.name
    return read_text(note) if is_file(note) and not ended(folder, run) else ""


def snakemake_version() -> int:
    try:
        done = subprocess.run(["snakemake", "--version"], capture_output=True, text=True, check=True)
        return int(done.stdout.strip().partition(".")[0])
    except FileNotFoundError:
        raise Trouble("there is no snakemake; install the package snakemake") from None
    except (OSError, ValueError, subprocess.CalledProcessError) as problem:
        raise Trouble(f"snakemake --version says nothing that can be read: {problem}; install the "
                      "package snakemake anew") from problem


def profile_of(name: str) -> str:
    """A profile of one's own goes before the one beside this file; paths as seen from here."""
    own = Path(os.environ.get("XDG_CONFIG_HOME", "~/.config")).expanduser() / "snakemake" / name
    if own.is_dir():
        return name
    for place in (Path(name), HERE / "profiles" / name):
        if (place / "config.yaml").is_file():
            return str(place.resolve())
    return name


def check_profile(name: str, version: int) -> None:
    """Profiles of this folder are for Snakemake 7, and for 8 with the plugin that calls sbatch."""
    if version < 7:
        raise NotReached(f"Snakemake {version} is too old for --profile: install version 7 or later")
    if version < 8 or not profile_of(name).startswith(str(HERE)):
        return
    if importlib.util.find_spec(PLUGIN) is None and not has_plugin():
        raise NotReached(f"Snakemake {version} calls Slurm by a plugin: install "
                         "snakemake-executor-plugin-cluster-generic beside it, or give a --profile of "
                         "your own")


def has_plugin() -> bool:
    """Snakemake may be of another Python than this one: its help lists the executors it has."""
    done = subprocess.run(["snakemake", "--help"], capture_output=True, text=True, check=False)
    return "cluster-generic" in done.stdout


def check_plain(folder: Path) -> None:
    """Snakemake writes the folder into the scripts of a cluster's jobs, for a shell, and does not
    quote all of it."""
    text = str(folder)
    if not text.isprintable() or any(c in text for c in "'\"$`\\{}"):
        raise NotReached(f"{folder}: with --profile the folder of results must have a name without "
                         "quotes, $, ` , \\ and braces: give another with -o")


def clock(seconds: float) -> str:
    whole = int(seconds)
    return f"{whole // 3600}:{whole // 60 % 60:02}:{whole % 60:02}"


class LiveTable:
    """The table while runs end: written anew by `write` when there are more, for a twentieth of the
    time at most. What cannot be written now is told when the study ends."""

    def __init__(self, write: Callable[[], None]):
        self.write, self.left, self.next = write, -1, 0.0

    def tell(self, left: int) -> None:
        begin = time.monotonic()
        if left == self.left or begin < self.next:
            return
        self.left = left
        with contextlib.suppress(OSError, Trouble):
            self.write()
        now = time.monotonic()
        self.next = now + 20 * (now - begin)


class Engine:
    def __init__(self, options: Options, runs: list[Run], estimate_s: float,
                 write_table: Callable[[], None] = lambda: None):
        self.options, self.runs, self.estimate_s = options, runs, estimate_s
        self.table = LiveTable(write_table)

    def missing(self) -> list[Run]:
        return [run for run in self.runs if not ended(self.options.folder, run)]

    def time_of_run(self) -> float:
        """Measured, where some have ended."""
        times = [end.get("cpu_s", 0.0) for run in self.runs if (end := ended(self.options.folder, run))]
        return sum(times) / len(times) if times else self.estimate_s

    def batches(self, missing: list[Run]) -> dict[str, list[str]]:
        """Names of runs by job."""
        options, time_s = self.options, max(self.time_of_run(), 0.01)
        size = int(CLUSTER_JOB_S / time_s) if options.profile else \
            min(int(JOB_S / time_s), math.ceil(len(missing) / (4 * options.jobs)))
        size = options.runs_per_job or max(1, size)
        first = [run.name for run in missing if run.name == self.options.first]
        rest = [run.name for run in missing if run.name != self.options.first]
        jobs = {f"first_{i}": [name] for i, name in enumerate(first)}
        return jobs | {f"runs_{i}": rest[i * size:(i + 1) * size]
                       for i in range(math.ceil(len(rest) / size))}

    def write_jobs(self, missing: list[Run]) -> None:
        folder = self.options.folder
        shutil.rmtree(folder / "jobs", ignore_errors=True)
        jobs = {"study": str(self.options.study), "program": str(self.options.program),
                "threads": self.options.threads,
                "jobs": self.batches(missing),
                "runs": {run.name: {"words": run.words(), "line": run.line, "label": run.label}
                         for run in missing}}
        write_whole(folder / "jobs.json", json.dumps(jobs, indent=1))
        # Snakemake sees no path but this file's: whatever a folder is called, no shell reads it
        words = shlex.join([sys.executable or "python3", "-S", str(HERE / "run_job.py")])
        make_whole(folder / "job.sh",
                   lambda part: part.write_bytes(os.fsencode(f'exec {words} jobs.json "$1"\n')))
        make_whole(folder / "Snakefile", lambda part: shutil.copyfile(HERE / "Snakefile", part))
        shutil.rmtree(folder / KILLED_FOLDER, ignore_errors=True)

    def command(self) -> list[str]:
        jobs, threads = self.options.jobs, self.options.threads
        words = ["snakemake", "--snakefile", "Snakefile", "--keep-going", "--nolock",
                 "--rerun-incomplete", "--rerun-triggers", "mtime", "--scheduler", "greedy"]
        if self.options.profile:
            check_plain(self.options.folder)
            return [*words, "--profile", profile_of(self.options.profile),
                    *(["--jobs", str(jobs)] if jobs else [])]
        return [*words, "--cores", str(jobs * threads), "--drop-metadata", "--quiet", "all"]

    def run_all(self) -> None:
        """Until nothing is missing, or Snakemake has given up."""
        folder = self.options.folder
        (folder / "runs").mkdir(parents=True, exist_ok=True)
        with open(folder / ".lock", "w", encoding="utf-8") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError as problem:
                raise Trouble(f"another command runs into {folder}; wait for it, or give -o") \
                    from problem
            self.run_locked()

    def run_locked(self) -> None:
        folder = self.options.folder
        if self.options.again:
            for run in self.runs:
                if ended(folder, run).get("status") in ("failed", "refused"):
                    shutil.rmtree(folder / "runs" / run.name)
        missing = self.missing()
        begin = time.monotonic()
        if not missing:
            self.tell_end(0, begin)
            return
        version = snakemake_version()
        if self.options.profile:
            check_profile(self.options.profile, version)
        self.write_jobs(missing)
        self.table.tell(len(missing))
        with open(folder / "snakemake.log", "w", encoding="utf-8") as log:
            process = subprocess.Popen(self.command(), stdin=subprocess.DEVNULL, stdout=log,
                                       stderr=subprocess.STDOUT, preexec_fn=die_with_parent,
                                       start_new_session=True, cwd=folder,
                                       env=os.environ | {STATUS_VARIABLE: str(STATUS_PROGRAM)})
        left, progress = missing, Progress("study")
        try:
            while process.poll() is None:
                try:
                    process.wait(LOOK_S)
                except subprocess.TimeoutExpired:
                    pass
                left = [run for run in left if not (folder / "runs" / run.name / ENDED).is_file()]
                progress.show(1.0 - len(left) / len(missing),
                              f"{len(self.runs) - len(left)}/{len(self.runs)} runs")
                self.table.tell(len(left))
        except BaseException:
            self.leave(process)
            progress.end()
            print(f"study: {len(left)} runs are missing; the same command goes on",
                  file=sys.stderr)
            raise
        progress.end()
        self.tell_end(len(left), begin)
        if len(left) == len(missing):
            raise NotReached(f"no run has ended: {self.why_not(missing)}; see "
                             f"{folder / 'snakemake.log'}")

    def tell_end(self, left: int, begin: float) -> None:
        print(f"{len(self.runs) - left}/{len(self.runs)} runs, {clock(time.monotonic() - begin)}",
              file=sys.stderr, flush=True)

    def why_not(self, missing: list[Run]) -> str:
        folder = self.options.folder
        ended_runs = [f"runs/{run.name} was {words}" for run in missing if (words := killed(folder, run))]
        if ended_runs:
            more = f", and {len(ended_runs) - 3} more" if len(ended_runs) > 3 else ""
            return ", ".join(ended_runs[:3]) + more + "; the same command does them again"
        lines = (folder / "snakemake.log").read_text(encoding="utf-8", errors="replace").split("\n")
        return " / ".join([line.strip() for line in lines if line.strip()][-6:]) or \
            "Snakemake has said nothing"

    def leave(self, process: subprocess.Popen) -> None:
        """Ends the jobs of this machine with Snakemake; of a cluster, has it cancel them."""
        if self.options.profile:
            process.send_signal(signal.SIGINT)
        else:
            process.kill()
        process.wait()
