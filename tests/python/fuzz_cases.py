# SPDX-License-Identifier: GPL-3.0-or-later
"""Spoils rich cases by what they mean and has the program check them, or run them to the end.

    fuzz_cases.py PROGRAM CASES GOOD [mutants | parts | runs] [--tries N | --seconds S] [--seed K] [--only NAME]

mutants: one to three edits each: numbers at and beyond their ranges, other units, other kinds, parts that
are missing, twice, too many, of another case. parts: each table and each key in turn taken out, and given a
value of another kind. Nothing may end by a signal, with a traceback or with another exit code than 0, 2 and
3, take longer than a minute or more than 2 GB, or speak of numbers that are none.
runs: one number at an end of its range, run to the end; of a run that ends no fibre volume may lie above the
densest packing of circles, nor may it be done with a balance of energies that is off by more than 1 %.

The same seed spoils the same. What fails is kept in a folder that is printed.
"""

import argparse
import copy
import json
import os
import random
import re
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import rich_cases
from rich_cases import at, places, text_of

MOST_S, MOST_KB = 60, 2_000_000
RUN_S = 30  # a run that takes longer is given up: minute steps are no fault
DENSEST, BALANCE = 0.9069, 0.01
NO_NUMBER = re.compile(r"(?<![\w.\"'/])[-+]?(nan|inf|unknown|(minus )?endless)\b"
                       r"(?=[ ,;)%]*(N|mm|s|deg|%|times|to|or|,|\)|$))")
SOME = [0.3, 0.5, 0.8, 1.2, 1.5, 2.0, 3.0, 10.0, -1.0]
UNITS = [25.4, 1 / 25.4, 10.0, 0.1, 1e3, 1e-3, 1e6, 1e-6, 57.2958, 1 / 57.2958]
OTHERS = [0, 0.0, -1.0, 1, 1e-300, 1e300, -1e300, float("inf"), float("nan"), True, "", "x", "\u202enan", [],
          [0.0], [[]], {}, {"x": 1}, 10**18]


class Ended:
    """How a program ended, what it said and took."""

    def __init__(self, command: list, folder: Path, most_s: int = MOST_S):
        def limit() -> None:
            resource.setrlimit(resource.RLIMIT_CPU, (most_s, most_s + 5))

        begin = time.monotonic()
        with (folder / "out").open("wb+") as out:
            program = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT,
                                       preexec_fn=limit)
            _, status, used = os.wait4(program.pid, 0)
            program.returncode = os.waitstatus_to_exitcode(status)
            out.seek(0)
            self.text = out.read().decode(errors="replace")
        self.code, self.wall_s = program.returncode, time.monotonic() - begin
        self.cpu_s, self.kb = used.ru_utime + used.ru_stime, used.ru_maxrss

    def fault(self, case_text: str) -> str:
        """What must not be; empty if nothing."""
        if self.cpu_s > MOST_S - 1:
            return f"took {self.cpu_s:.0f} s of processor time"
        if self.code < 0:
            return f"signal {-self.code}"
        if self.code not in (0, 2, 3):
            return f"exit code {self.code}"
        if "Traceback" in self.text or "terminate called" in self.text:
            return "traceback"
        if self.kb > MOST_KB:
            return f"took {self.kb / 1e6:.1f} GB"
        if self.code == 2 and ": error: " not in self.text:
            return "refused without a place"
        if not re.search(r"\b(nan|inf|unknown|endless)\b", case_text):
            for line in self.text.splitlines():
                if found := NO_NUMBER.search(line):
                    return f"says {found[0]!r}: {line}"
        return ""


class Spoiler:
    """Edits of a case. `others`: cases from which parts are taken; `keys`: those of `plyform keys --json`."""

    def __init__(self, dice: random.Random, others: list[dict], keys: list[dict]):
        self.dice, self.others = dice, others
        self.keys = {key["key"]: key for key in keys}

    def key_of(self, path: tuple) -> dict | None:
        """The row of the table of keys."""
        words: list[str] = []
        for step in path:
            if isinstance(step, int):
                words[-1] += "[]"
            else:
                words.append("NAME" if words and words[-1] in ("fabrics", "blanks", "friction") and
                             len(words) == 1 else step)
        return self.keys.get(".".join(words)) or self.keys.get(re.sub(r"(\[\])+$", "", ".".join(words)))

    def ends(self, path: tuple, usual: bool = False) -> list[float]:
        key = self.key_of(path)
        columns = key["columns"] if key else []
        found = []
        for column in columns:
            for least, is_open in (("least", "open_least"), ("most", "open_most")):
                if (end := column[least]) is not None:
                    step = abs(end) * 1e-7 + 1e-12
                    found.append(end + (step if least == "least" else -step) if column[is_open] else end)
            found += [end for end in (column["usual_least"], column["usual_most"]) if usual and end is not None]
        return found

    def number(self, path: tuple, value):
        ends = self.ends(path, True)
        kind = self.dice.random()
        if kind < 0.3:
            return value * self.dice.choice(SOME)
        if ends and kind < 0.65:
            end = self.dice.choice(ends)
            return self.dice.choice([end, end * 1.0000001, end * 0.9999999, end + 1e-9])
        if kind < 0.9:
            return value * self.dice.choice(UNITS)
        return self.dice.choice(OTHERS)

    def edit(self, case: dict) -> str:
        """Changes one place of the case; in words."""
        there = places(case)
        numbers = [path for path in there if isinstance(at(case, path), (int, float))]
        path = self.dice.choice(numbers if numbers and self.dice.random() < 0.5 else there)
        holder, key, value = at(case, path[:-1]), path[-1], at(case, path)
        words = ".".join(map(str, path))
        what = self.dice.random()
        if isinstance(value, (int, float)) and not isinstance(value, bool) and what < 0.8:
            holder[key] = self.number(path, value)
            return f"{words} = {holder[key]}"
        if isinstance(value, str) and what < 0.6:
            row = self.key_of(path)
            words_there = [*(row["choices"] if row else []), *self.names(case), "", "x" * 200]
            holder[key] = self.dice.choice(words_there)
            return f"{words} = {holder[key]}"
        if isinstance(value, list) and value and what < 0.75:
            return f"{words} {self.edit_list(value)}"
        if what < 0.25:
            del holder[key]
            return f"without {words}"
        if what < 0.5:
            return self.graft(case)
        holder[key] = copy.deepcopy(self.dice.choice(OTHERS))
        return f"{words} = {holder[key]}"

    def edit_list(self, value: list) -> str:
        kind = self.dice.randrange(6)
        one = self.dice.randrange(len(value))
        if kind == 0:
            value.insert(one, copy.deepcopy(value[one]))
        elif kind == 1:
            del value[one]
        elif kind == 2:
            value.reverse()
        elif kind == 3:
            value *= self.dice.choice([2, 9, 40, 300 if len(value) < 20 else 3])
        elif kind == 4:
            value[one] = copy.deepcopy(self.dice.choice(OTHERS))
        else:
            self.dice.shuffle(value)
        return ("with one twice", "without one", "turned round", "many times", "with another", "shuffled")[kind]

    def graft(self, case: dict) -> str:
        """Takes a table or list of another case over, or lays it beside what is there."""
        other = self.dice.choice(self.others)
        key = self.dice.choice(sorted(other))
        part = copy.deepcopy(other[key])
        if isinstance(part, dict) and isinstance(case.get(key), dict):
            if key in ("fabrics", "blanks") and case[key] and part:  # the keys of one beside those of another
                mine, theirs = self.dice.choice(sorted(case[key])), self.dice.choice(sorted(part))
                if isinstance(case[key][mine], dict) and isinstance(part[theirs], dict):
                    case[key][mine] = case[key][mine] | part[theirs] if self.dice.random() < 0.5 else \
                        part[theirs] | case[key][mine]
            else:
                case[key] = case[key] | part
        elif isinstance(part, list) and isinstance(case.get(key), list):
            case[key] = case[key] + part if self.dice.random() < 0.5 else part + case[key]
        else:
            case[key] = part
        return f"with {key} of another"

    def names(self, case: dict) -> list[str]:
        found = []
        for key in ("fabrics", "blanks", "friction"):
            found += list(case[key]) if isinstance(case.get(key), dict) else []
        for key in ("ply", "tool", "boundary"):
            found += [str(one.get("name")) for one in case.get(key, []) if isinstance(one, dict)] \
                if isinstance(case.get(key), list) else []
        return found

    def at_an_end(self, case: dict) -> str:
        """Gives one number the value of an end of its range."""
        numbers = [path for path in places(case) if isinstance(at(case, path), (int, float)) and
                   not isinstance(at(case, path), bool) and self.ends(path)]
        path = self.dice.choice(numbers)
        at(case, path[:-1])[path[-1]] = end = self.dice.choice(self.ends(path))
        return f"{'.'.join(map(str, path))} = {end}"


def parts_of(case: dict):
    """The case without each of its parts in turn, and with a value of another kind there, each in words."""
    for path in places(case):
        words = ".".join(map(str, path))
        for other in (None, "x", 5.0, [], {}):
            if other is None and isinstance(path[-1], int) and not isinstance(at(case, path), dict):
                continue
            changed = copy.deepcopy(case)
            holder = at(changed, path[:-1])
            if other is None:
                del holder[path[-1]]
            else:
                holder[path[-1]] = copy.deepcopy(other)
            yield (f"without {words}" if other is None else f"{words} = {other!r}"), changed


class Tries:
    """What was tried, and what failed."""

    def __init__(self, program: Path, folder: Path, say: bool):
        self.program, self.folder, self.say = program, folder, say
        self.count, self.codes, self.failed, self.given_up, self.slowest = 0, {}, 0, 0, 0.0

    def keep(self, what: str, words: str, text: str, said: str) -> None:
        self.failed += 1
        kept = self.folder / f"fault_{self.failed:03}"
        kept.mkdir()
        (kept / "case.toml").write_text(text)
        (kept / "said.txt").write_text(f"{what}\n{words}\n\n{said}")
        print(f"FAULT {what}\n      {words}\n      {kept}", flush=True)

    def ended(self, name: str, words: str, ended: Ended, text: str) -> bool:
        self.count += 1
        self.codes[ended.code] = self.codes.get(ended.code, 0) + 1
        self.slowest = max(self.slowest, ended.cpu_s)
        if self.say:
            print(f"{name}: {words}: {ended.code}, {ended.cpu_s:.1f} s", flush=True)
        if fault := ended.fault(text):
            self.keep(fault, f"{name}: {words}", text, ended.text)
        return not fault

    def check(self, name: str, words: str, case: dict) -> None:
        file = self.folder / "case.toml"
        text = text_of(case)
        file.write_text(text, errors="replace")
        self.ended(name, words, Ended([self.program, "check", file], self.folder), text)

    def run(self, name: str, words: str, case: dict) -> bool:
        """Whether the run came to its end."""
        file, out = self.folder / "case.toml", self.folder / "results"
        text = text_of(case)
        file.write_text(text, errors="replace")
        (out / "summary.json").unlink(missing_ok=True)
        ended = Ended([self.program, "run", file, "-o", out], self.folder, RUN_S)
        if ended.cpu_s > 0.9 * RUN_S:  # a signal, after which the run ends in order
            self.given_up += 1
            return False
        if not self.ended(name, words, ended, text) or not (out / "summary.json").is_file():
            return False
        summary = json.loads((out / "summary.json").read_text())
        if summary["status"] not in ("done", "doubtful"):
            return False
        for ply in summary["plies"]:
            if (volume := ply.get("fibre_volume_max") or 0.0) > DENSEST:
                self.keep(f"{summary['status']}: fibre volume {volume:.3f} of ply {ply['name']}",
                          f"{name}: {words}", text, ended.text)
        error = summary["energy"]["balance_error"]
        if summary["status"] == "done" and not (error is not None and abs(error) <= BALANCE):
            self.keep(f"done with a balance of energies that is off by {error}", f"{name}: {words}", text, ended.text)
        return True


def quick(case: dict) -> dict:
    """The case with a run of a second or two."""
    solver = case.setdefault("solver", {})
    solver["outputs"] = 2
    solver["duration"] = min(solver.get("duration", 0.02), 0.02)
    solver["dwell"] = 0.0
    return case


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=Path)
    parser.add_argument("cases", type=Path)
    parser.add_argument("good", type=Path)
    parser.add_argument("kind", choices=["mutants", "parts", "runs"], nargs="?", default="mutants")
    parser.add_argument("--tries", type=int)
    parser.add_argument("--seconds", type=float, default=float("inf"))
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", help="one case")
    parser.add_argument("--say", action="store_true", help="each try")
    options = parser.parse_args()
    keys = json.loads(subprocess.run([options.program, "keys", "--json"], stdout=subprocess.PIPE, check=True).stdout)
    bases = rich_cases.rich_cases(options.cases, options.good)
    names = [options.only] if options.only else sorted(bases)
    tries = Tries(options.program, Path(tempfile.mkdtemp(prefix="fuzz_cases_")), options.say)
    until = time.monotonic() + options.seconds
    most = options.tries or (10**9 if options.kind == "parts" or options.seconds < float("inf") else 100)
    if options.kind == "parts":
        all_parts = [(name, words, case) for name in names for words, case in parts_of(bases[name])]
        dice = random.Random(options.seed)
        for name, words, case in dice.sample(all_parts, min(most, len(all_parts))):
            if time.monotonic() > until:
                break
            tries.check(name, words, case)
    ended, number = 0, 0
    while options.kind != "parts" and time.monotonic() < until and \
            (ended if options.kind == "runs" else number) < most:
        dice = random.Random(f"{options.seed} {number}")
        number += 1
        spoiler = Spoiler(dice, list(bases.values()), keys)
        name = dice.choice(names)
        case = copy.deepcopy(bases[name])
        if options.kind == "runs":
            ended += tries.run(name, spoiler.at_an_end(quick(case)), case)
        else:
            tries.check(name, "; ".join(spoiler.edit(case) for _ in range(dice.choice([1, 1, 1, 2, 2, 3])) if case), case)
    runs = f", {ended} ran to the end, {tries.given_up} given up after {RUN_S} s" if options.kind == "runs" else ""
    print(f"{tries.count} tries{runs}, exit codes "
          f"{dict(sorted(tries.codes.items()))}, the slowest {tries.slowest:.1f} s; {tries.failed} faults"
          f"{f' in {tries.folder}' if tries.failed else ''}")
    return 1 if tries.failed else 0


if __name__ == "__main__":
    sys.exit(main())
