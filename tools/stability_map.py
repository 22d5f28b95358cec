#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where contact is stable: runs a small scene over grids of settings and draws one picture.

    stability_map.py --program PLYFORM [--beyond UNBOUNDED_RUN] [-o PICTURE] [--table CSV]
    stability_map.py --redraw CSV [-o PICTURE]

The scene, cases/stability with one, two and five plies, is run with --threads 1, --jobs runs at a
time. A run is one of

  stopped   plyform stopped it (exit code 3) or it took longer than --patience: the letter says why
  chatters  it came to its end, but in the second half of the stroke the die's force jumped by more
            than 10 % of the blank-holder's force, or the blank-holder's reaction was off its force
            by more than 10 %, at any output
  stable    neither
  refused   the case's own checks do not allow the value, and no --beyond was given

A jump is how far the force is from the mean of the outputs before and after. Why so: plies and
tools that are pressed together quietly change their forces by little from one output to the next
(a hundred over the stroke). The blank-holder is brought into balance at every step and shows its
force even on a rattling stack, unless it comes off; the die on the other side carries what it
passes on, and rattles. 10 % of the force that holds the blank is what would be seen in the draw-in.
Kinetic energy is no sign here: the scene is fast and soft in shear, so that moving the ply in takes
as much energy as shearing it.

--beyond names tests/unbounded_run, plyform without the ranges of its keys: it takes the settings
that plyform refuses (steps longer than the stable one). --quick is a tiny grid, for tests.

Exit codes: 0 done, 1 something is missing or cannot be run, 2 wrong arguments.
"""

import argparse
import csv
import json
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

try:
    import numpy as np
    from plotting.draw_stability import draw_map
    from plotting.reading import Trouble, ended, read_history
except ImportError as error:
    sys.exit(f"stability_map.py: error: {error}; install python3-matplotlib")

STEP, STIFFNESS, DAMPING = "solver.step_factor", "contact.stiffness", "contact.damping"
FRICTION, SKIN = "contact.friction", "contact.skin"
DEFAULTS = {STEP: 0.5, STIFFNESS: 0.1, DAMPING: 0.2, FRICTION: 0.2, SKIN: 0.5}
CASES = {"one_ply.toml": "1 ply", "case.toml": "2 plies", "five_plies.toml": "5 plies"}
LARGEST_JUMP = 0.1  # of the blank-holder's force
REASONS = {"gone through": "P", "went through": "P", "below the surface": "P", "balance": "B",
           "not finite": "N", "overlap": "X", "collapsed": "C", "squeezed": "S"}


@dataclass
class Panel:
    """Runs of every case over x times y, or over x alone; `fixed` settings beside the defaults."""
    x: str
    xs: list[float]
    y: str | None = None
    ys: list[float] = field(default_factory=list)
    fixed: dict[str, float] = field(default_factory=dict)

    def settings(self) -> list[dict[str, float]]:
        return [{**DEFAULTS, **self.fixed, self.x: x, **({self.y: y} if self.y else {})}
                for y in (self.ys if self.y else [None]) for x in self.xs]


STIFFNESSES = [0.0125, 0.025, 0.05, 0.1, 0.2, 0.4]
DAMPINGS = [0.05, 0.1, 0.2, 0.4, 0.8]
PANELS = [
    Panel(STEP, [0.25, 0.5, 1.0, 1.2, 1.5], STIFFNESS, STIFFNESSES),
    Panel(DAMPING, DAMPINGS, FRICTION, [0.05, 0.1, 0.2, 0.4, 0.8]),
    Panel(SKIN, [0.25, 0.5, 1.0])]
QUICK = [Panel(STEP, [0.5, 1.8], STIFFNESS, [0.1]), Panel(SKIN, [0.5])]


@dataclass
class Runner:
    program: Path
    beyond: Path | None
    cases: Path
    scratch: Path
    patience: float
    extra: list[str]

    def run(self, case: str, settings: dict[str, float]) -> dict:
        """One row of the table."""
        given = [f"{key}={value:g}" for key, value in settings.items()] + self.extra
        folder = Path(tempfile.mkdtemp(dir=self.scratch))
        command = [self.program, "run", self.cases / case, "--threads", "1", "-o", folder,
                   *(part for setting in given for part in ("--set", setting))]
        row = {"case": case, **settings}
        try:
            done = self.call(command)
            if done.returncode == 2 and self.beyond:
                done = self.call([self.beyond, self.cases / case, folder, *given])
        except subprocess.TimeoutExpired:
            return {**row, "state": "stopped", "why": "T"}
        if done.returncode == 2:
            return {**row, "state": "refused", "why": "?"}
        if done.returncode not in (0, 3):
            raise Trouble(f"{' '.join(map(str, command))}: {done.stderr.strip()}")
        return {**row, **judge(folder)}

    def call(self, command: list) -> subprocess.CompletedProcess:
        return subprocess.run(list(map(str, command)), capture_output=True, text=True,
                              timeout=self.patience)


def judge(folder: Path) -> dict:
    """State of a run from its results, with the numbers that say so."""
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    contact, stroke = summary["contact"], summary["stroke_mm"]
    row = {"steps": summary["steps"], "stroke_mm": stroke,
           "tool_depth_mm": contact["max_tool_penetration_mm"],
           "ply_depth_mm": contact["max_ply_penetration_mm"],
           "balance_error": summary["energy"]["balance_error"], "message": summary["message"]}
    if not ended(summary):
        why = next((letter for text, letter in REASONS.items() if text in summary["message"]), "?")
        return {**row, "state": "stopped", "why": why}
    history = read_history(folder)
    late = np.flatnonzero(history["stroke_mm"] >= 0.5 * stroke)
    holder, die = history["blank_holder_force_N"], history["die_force_N"]
    force = float(np.median(holder))
    middle = late[(late > 0) & (late < len(die) - 1)]
    jumps = abs(die[middle] - 0.5 * (die[middle - 1] + die[middle + 1])) / force
    jump = float(jumps.max(initial=0.0))
    off = float(abs(holder[late] / force - 1.0).max())
    state = "chatters" if not np.max([jump, off]) <= LARGEST_JUMP else "stable"
    return {**row, "state": state, "why": "", "jump": jump, "holder_off": off}


def same(row: dict, case: str, settings: dict[str, float]) -> bool:
    return row["case"] == case and all(np.isclose(float(row[key]), value, rtol=1e-6, atol=1e-12)
                                       for key, value in settings.items())


def all_rows(runner: Runner, panels: list[Panel], cases: list[str], jobs: int) -> list[dict]:
    wanted = []
    for panel in panels:
        for case in cases:
            wanted += [(case, s) for s in panel.settings() if (case, s) not in wanted]
    rows = []
    with ThreadPoolExecutor(jobs) as pool:
        for row in pool.map(lambda job: runner.run(*job), wanted):
            rows.append(row)
            print(f"{len(rows)}/{len(wanted)}  {row['case']}  " +
                  "  ".join(f"{key.split('.')[1]} {row[key]:g}" for key in DEFAULTS) +
                  f"  {row['state']} {row['why']}", file=sys.stderr, flush=True)
    return rows


def write_table(rows: list[dict], path: Path) -> None:
    columns = ["case", *DEFAULTS, "state", "why", "jump", "holder_off", "steps", "stroke_mm",
               "tool_depth_mm", "ply_depth_mm", "balance_error", "message"]
    with open(path, "w", newline="", encoding="utf-8") as out:
        writer = csv.DictWriter(out, columns, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows({key: f"{value:.4g}" if isinstance(value, float) else value
                          for key, value in row.items()} for row in rows)


def read_rows(path: Path) -> list[dict]:
    with open(path, newline="", encoding="utf-8") as table:
        return list(csv.DictReader(table))


def state_of(rows: list[dict], case: str, settings: dict[str, float]) -> tuple[str, str] | None:
    """State and letter, None if there was no such run."""
    return next(((row["state"], row["why"]) for row in rows if same(row, case, settings)), None)


def limit(rows: list[dict], case: str, panel: Panel, up: bool) -> str:
    """How far x can go from its default, all else as fixed, before a run is not stable."""
    start = DEFAULTS[panel.x]
    values = sorted((x for x in panel.xs if (x >= start if up else x <= start)), reverse=not up)
    good = None
    for x in values:
        settings = {**DEFAULTS, **panel.fixed, panel.x: x}
        row = next((row for row in rows if same(row, case, settings)), None)
        if row is None or row["state"] == "refused":
            break
        if row["state"] != "stable":
            bad = f"{row['state']}{' ' + row['why'] if row['why'] else ''} at {x:g}"
            if good is None:
                return bad
            return f"{good:g} (×{good / start:.2g}), {bad}"
        good = x
    return "–" if good is None else f"{good:g} (×{good / start:.2g}), none seen"


def limits_table(rows: list[dict], panels: list[Panel], cases: list[str]) -> str:
    """In Markdown: last stable value in each direction and first one that is not."""
    lines = ["| setting | others | direction | " + " | ".join(CASES[c] for c in cases) + " |",
             "|---" * (3 + len(cases)) + "|"]
    for panel in panels:
        axes = [panel] + ([Panel(panel.y, panel.ys, fixed=panel.fixed)] if panel.y else [])
        for axis in axes:
            others = ", ".join(f"{k} {v:g}" for k, v in axis.fixed.items()) or "defaults"
            for up in (False, True):
                told = [limit(rows, case, axis, up) for case in cases]
                lines.append(f"| `{axis.x}` {DEFAULTS[axis.x]:g} | {others} | "
                             f"{'up' if up else 'down'} | " + " | ".join(told) + " |")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(prog="stability_map.py", description=__doc__.split("\n", 1)[0])
    parser.add_argument("--program", type=Path, help="plyform")
    parser.add_argument("--beyond", type=Path, help="unbounded_run, for values that plyform refuses")
    parser.add_argument("--redraw", type=Path, metavar="CSV", help="take the runs of a former map")
    parser.add_argument("--cases", type=Path, metavar="DIR",
                        default=Path(__file__).resolve().parent.parent / "cases/stability")
    parser.add_argument("--only", nargs="+", choices=CASES, default=list(CASES), metavar="FILE")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--jobs", type=int, default=2, metavar="N")
    parser.add_argument("--patience", type=float, default=300.0, metavar="S", help="s for a run")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--table", type=Path, metavar="CSV", help="a row a run")
    parser.add_argument("-o", "--output", type=Path, default=None, metavar="PICTURE")
    options = parser.parse_args()
    if not (options.program or options.redraw):
        parser.error("give --program, or --redraw")
    panels = QUICK if options.quick else PANELS
    try:
        if options.redraw:
            rows = read_rows(options.redraw)
        else:
            with tempfile.TemporaryDirectory() as scratch:
                runner = Runner(options.program, options.beyond, options.cases, Path(scratch),
                                options.patience, options.set)
                rows = all_rows(runner, panels, options.only, options.jobs)
        if options.table:
            write_table(rows, options.table)
        if options.output:
            titles = {case: CASES[case] for case in options.only}
            figure = draw_map(panels, titles, lambda *run: state_of(rows, *run), DEFAULTS,
                              LARGEST_JUMP)
            figure.savefig(options.output, dpi=75)
        print(limits_table(rows, panels, options.only))
    except (Trouble, OSError) as problem:
        sys.exit(f"stability_map.py: error: {problem}")


if __name__ == "__main__":
    main()
