#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Stacks of real cloth: runs sets of cases and says what changes and whether it holds.

    real_cloth.py SET... [--only PATTERN] [--jobs N] [--program PLYFORM] [-o FOLDER] [--again]
                  [--set KEY=VALUE]
    real_cloth.py SET... --report        tables of what is there, nothing is run
    real_cloth.py --tables TEXT          into a text, docs/verification/real_cloth.md; nothing is run

Each set goes on where it stopped: a run that has ended (done, doubtful, or stopped by plyform) is
not repeated unless --again; one that was killed starts anew. FOLDER/runs/NAME has the results of
each run, FOLDER/SET.csv the table with all numbers. --set changes a key of every run
(a coarse mesh to try a set out); another FOLDER is wise then.

Exit codes: 0 done, whatever the verdicts; 1 a run left no results, or something cannot be read;
2 wrong arguments.
"""

import argparse
import dataclasses
import fnmatch
import os
import signal
import sys
from pathlib import Path

try:
    from plotting.reading import Trouble
    from sweeps import fill, report
    from sweeps.runs import SOURCES, Folder, Runner
    from sweeps.sets import SETS
except ImportError as error:
    sys.exit(f"real_cloth.py: error: {error}; install python3-h5py and python3-matplotlib")


def fits(name: str, pattern: str | None) -> bool:
    return pattern is None or pattern in name or fnmatch.fnmatchcase(name, pattern)


def cores() -> int:
    return len(os.sched_getaffinity(0))


def run_sets(sets: list, options: argparse.Namespace, folder: Folder) -> list[str]:
    runs = [entry.run for one in sets for entry in one.entries
            if fits(entry.run.name, options.only)]
    if not runs:
        raise Trouble(f"no run has a name like {options.only}")
    runner = Runner(options.program, folder, options.jobs)
    return runner.run_all(runs, options.again)


def with_settings(one, extra: tuple[str, ...]):
    """A set whose runs have these settings as well."""
    def longer(entry):
        run = dataclasses.replace(entry.run, settings=entry.run.settings + extra)
        return dataclasses.replace(entry, run=run)
    return dataclasses.replace(one, entries=[longer(entry) for entry in one.entries])


def tell(sets: list, folder: Folder) -> None:
    for one in sets:
        rows, missing = report.rows_of(one, folder)
        report.write_csv(rows, folder.path / f"{one.name}.csv")
        print(f"## {one.name}: {one.title}\n\n{report.text_of(one, rows, missing)}\n", flush=True)


def tables(text: Path, folder: Folder, extra: tuple[str, ...]) -> None:
    told = {}
    for name in fill.names_in(text.read_text(encoding="utf-8"), SETS):
        one = with_settings(SETS[name](), extra)
        told[name] = (one, *report.rows_of(one, folder))
    fill.fill(text, told)


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="real_cloth.py", description=__doc__.split("\n", 1)[0])
    parser.add_argument("sets", nargs="*", metavar="SET", help=f"of {', '.join(SETS)}; or all")
    parser.add_argument("--only", metavar="PATTERN", help="runs whose name has or fits this")
    parser.add_argument("--program", type=Path, default=SOURCES / "build/release/tools/plyform")
    parser.add_argument("--jobs", type=int, default=cores(), metavar="N", help="runs at a time")
    parser.add_argument("--again", action="store_true", help="repeat what has ended, too")
    parser.add_argument("--set", dest="extra", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--report", action="store_true", help="run nothing")
    parser.add_argument("--tables", type=Path, metavar="TEXT",
                        help="fill tables and pictures into a text")
    parser.add_argument("-o", "--output", type=Path, metavar="FOLDER",
                        default=Path("results/real_cloth"))
    options = parser.parse_args()
    unknown = [name for name in options.sets if name not in (*SETS, "all")]
    if unknown or bool(options.sets) == bool(options.tables):
        parser.error(f"{unknown[0] if unknown else 'sets or --tables'}: give {', '.join(SETS)}, "
                     "or all; or --tables")
    if options.jobs < 1:
        parser.error("--jobs must be at least 1")
    return options


def main() -> None:
    options = arguments()
    names = list(SETS) if "all" in options.sets else list(dict.fromkeys(options.sets))
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    try:
        if options.tables:
            tables(options.tables, Folder(options.output), tuple(options.extra))
            return
        sets = [with_settings(SETS[name](), tuple(options.extra)) for name in names]
        folder, trouble = Folder(options.output), []
        if not options.report:
            trouble = run_sets(sets, options, folder)
        tell(sets, folder)
        if trouble:
            sys.exit("real_cloth.py: error: " + "\n".join(trouble))
    except (Trouble, OSError) as problem:
        sys.exit(f"real_cloth.py: error: {problem}")
    except KeyboardInterrupt:
        sys.exit(130)


if __name__ == "__main__":
    main()
