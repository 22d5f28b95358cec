# SPDX-License-Identifier: GPL-3.0-or-later
"""From a study to the list of its runs."""

import dataclasses
import itertools
import re
from dataclasses import dataclass, field
from pathlib import Path

from studies.case_values import CaseValues, FileHash, split_setting
from studies.fields import fields_of
from studies.reader import is_number
from studies.shown import COLUMN
from studies.study_file import CASE, DRAWN, Study, Vary, case_file
from studies.toml_place import toml_text, toml_value

# Picked by an accuracy: what a run with one takes for them is in its results.
COST_KEYS = ("solver.duration", "solver.fibre_softening", "element_size")


@dataclass
class Run:
    """One call of `plyform run`. Runs with the same id are one."""
    line: str                      # vary's name, case, reference, preset, run, or the method
    label: str                     # within the line
    case: Path
    settings: tuple[str, ...]      # KEY=VALUE
    accuracy: str = ""
    values: dict = field(default_factory=dict)  # by vary's name
    item: str = ""                 # of the study file, where its mistakes are told
    name: str = ""                 # of its folder
    against: str = ""              # label of the run that it is compared with
    quarter_turns: int = 0         # of that one about z, before

    def words(self) -> list[str]:
        """Of the command, behind run or check."""
        words = [str(self.case)]
        for setting in self.settings:
            words += ["--set", setting]
        return words + (["--accuracy", self.accuracy] if self.accuracy else [])


class Planner:
    def __init__(self, study: Study, program: Path, version: str, threads: int):
        self.study, self.program = study, program
        self.rest, self.hash = f"{version}\nthreads {threads}\n", FileHash()
        self.base = self.case_values(study.case, tuple(study.settings))
        self.reference_name = ""  # of its folder, once the runs are known
        self.vary = [narrow for one in study.vary for narrow in self.each(one)]
        for one in study.vary:  # a key that fits nothing is told once
            for key in one.keys:
                if key != CASE and not self.base.keys(key):
                    study.mistakes.add(f"{one.item}.{'each' if one.each else 'key'}",
                                       "fits no key of the case", "write it as in the case file",
                                       key)
        self.know_fields()
        for name, _ in COLUMN.findall(study.run_name):
            if name not in (known := [one.name for one in self.vary]):
                study.mistakes.add("run_name", f"there is no [[vary]] {name}",
                                   f"there are {', '.join(known)}")

    def know_fields(self) -> None:
        """What the program says of the fields that runs are compared by."""
        asked = self.study.reference.fields if self.study.reference else []
        self.study.fields = fields_of(self.program, asked)
        for i, word in enumerate(asked):
            if word not in self.study.fields:
                self.study.mistakes.add(f"reference.fields.{i}",
                                        f"must be one of {', '.join(self.study.fields)}",
                                        "name fields to compare", word)
        if asked:
            self.study.reference.fields = [word for word in asked if word in self.study.fields]

    def case_values(self, case: Path, settings: tuple[str, ...]) -> CaseValues:
        return CaseValues(case, settings, self.program)

    def each(self, one: Vary) -> list[Vary]:
        """A vary for every key that fits, where each has draws of its own."""
        if not one.each:
            return [one]
        return [dataclasses.replace(one, name=key if one.name == one.keys[0] else
                                    f"{one.name} {i + 1}", keys=[key], each=False)
                for i, key in enumerate(self.base.keys(one.keys[0]))]

    def own(self, one: Vary, values: CaseValues):
        """What the case has: 1 of factors, else its value; a list for several keys."""
        if one.factors:
            return 1.0
        return chosen([values.own(key) for pattern in one.keys
                       for key in values.keys(pattern)[:1]])

    def settings_of(self, one: Vary, row: tuple, base: CaseValues) -> list[str]:
        settings = []
        for pattern, value in zip(one.keys, row):
            if pattern == CASE:
                continue
            keys = base.keys(pattern)
            for i, key in enumerate(keys):
                own = base.own(key)
                if "*" in pattern and isinstance(value, list) and not isinstance(own, list) and \
                        len(value) == len(keys):
                    settings.append(f"{key}={toml_text(value[i])}")  # each its own
                elif not one.factors:
                    settings.append(f"{key}={toml_text(value)}")
                elif is_number(own):
                    settings.append(f"{key}={own * value!r}")
        return settings

    def case_of(self, choice: list[tuple[Vary, tuple]]) -> Path:
        for one, row in choice:
            if CASE in one.keys:
                return case_file(self.study.file.parent, str(row[one.keys.index(CASE)]))
        return self.study.case

    def run(self, line: str, label: str, choice: list[tuple[Vary, tuple]] = (),
            settings: tuple[str, ...] = (), accuracy: str = "", item: str = "") -> Run:
        """A run with these values of what is varied, after the study's own settings."""
        given = tuple(self.study.settings) + tuple(settings)
        case = self.case_of(choice)
        base = self.base if case == self.study.case and not settings else \
            self.case_values(case, given)
        words = [word for one, row in choice for word in self.settings_of(one, row, base)]
        run = Run(line, label, case, self.shortest(case, [*given, *words]),
                  accuracy or self.study.accuracy, item=item)
        given = {one.name: one.name_of(row) or chosen(list(row)) for one, row in choice}
        for one in self.vary:
            picked = run.accuracy and not one.factors and \
                any(key.endswith(COST_KEYS) for key in one.keys)
            run.values[one.name] = given[one.name] if one.name in given else \
                str(case) if one.keys == [CASE] else \
                "" if picked or (run.accuracy and one.factors) else self.own(one, base)
        return run

    def shortest(self, case: Path, settings: list[str]) -> tuple[str, ...]:
        """Without what a later setting replaces or the case has anyway: runs that are the same
        then look the same. A path of a fabric or a mesh stays as it stands."""
        plain = self.case_values(case, ())
        last = {plain.numbered(split_setting(one)[0]): one for one in settings}
        kept = []
        for key, setting in last.items():
            own, value = plain.own(key), toml_value(split_setting(setting)[1])
            if own is None or isinstance(own, bool) != isinstance(value, bool) or own != value:
                kept.append(setting)
        return tuple(kept)

    def reference(self) -> Run | None:
        wanted = self.study.reference
        if wanted is None:
            return None
        choice = self.chosen_of(wanted.values)
        given = (*self.study.settings, *wanted.settings)
        values = self.case_values(self.study.case, given)
        more = []
        for pattern, factor in wanted.factors.items():
            keys = [key for key in values.keys(pattern) if is_number(values.own(key))]
            if not keys:
                self.study.mistakes.add("reference.factors", f"{pattern} is no number of the case",
                                        "name keys that have a value, as in --set")
            more += [f"{key}={values.own(key) * factor!r}" for key in keys if factor != 1.0]
        return self.run("reference", "reference", choice, settings=(*wanted.settings, *more),
                        accuracy=wanted.accuracy, item="reference")

    def chosen_of(self, values: dict) -> list[tuple[Vary, tuple]]:
        """By name of a vary, its value or the name of one."""
        choice = []
        for one in self.vary:
            if one.name not in values:
                continue
            value = values[one.name]
            row = one.values[one.names.index(value)] if value in one.names else one.row(value)
            choice.append((one, row))
        return choice

    def extra(self) -> list[Run]:
        runs = []
        for one in self.study.extra:
            runs.append(self.run("run", one.name, self.chosen_of(one.values), tuple(one.settings),
                                 one.accuracy, one.item))
            runs[-1].against, runs[-1].quarter_turns = one.against, one.quarter_turns
        return runs

    def label_of_choice(self, number: int, choice: list[tuple[Vary, tuple]]) -> str:
        labels = {one.name: label_of(one, row) for one, row in choice}
        if self.study.run_name:
            return COLUMN.sub(lambda match: labels[match[1]], self.study.run_name)
        return str(number) if self.study.method in DRAWN else \
            ", ".join(f"{name}={text}" for name, text in labels.items())

    def choices(self) -> list[list[tuple[Vary, tuple]]]:
        """Values of what is varied, by run, for all methods but one at a time."""
        method, vary = self.study.method, self.vary
        if method == "grid":
            return [list(zip(vary, rows)) for rows in itertools.product(*(v.values for v in vary))]
        if method == "list":
            return [list(zip(vary, rows)) for rows in zip(*(v.values for v in vary))]
        import warnings  # scipy takes half a second to load: only where it is used
        from scipy.stats import qmc
        kind = qmc.Sobol if method == "sobol" else qmc.LatinHypercube
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # numbers of runs that are no power of two
            points = kind(len(vary), seed=self.study.seed).random(self.study.runs)
        return [[(one, (one.drawn(share),)) for one, share in zip(vary, point)]
                for point in points]

    def runs(self, folder: Path) -> list[Run]:
        """The reference, which takes longest, first; each run once, under the name that it has in
        `folder` already."""
        study, runs = self.study, []
        reference = self.reference()
        if reference:
            runs.append(reference)
        single = study.method == "one at a time"
        if single:
            runs.append(self.run("case", "case", item="case"))
        runs += [self.run("preset", name, accuracy=name, item="presets") for name in study.presets]
        for one in self.vary if single else ():
            runs += [self.run(one.name, label_of(one, row), [(one, row)], item=f"{one.item}.{i}")
                     for i, row in enumerate(one.values)]
        if not single and self.vary:
            for i, choice in enumerate(() if study.mistakes.found else self.choices()):
                runs.append(self.run(study.method, self.label_of_choice(i + 1, choice), choice,
                                     item="vary"))
        runs += self.extra()
        asked = [(f"{run.item}.against", run.against) for run in runs]
        for one in study.limits.values():
            asked += [(f"limits.{one.name}.ratio_to", one.ratio_to),
                      (f"limits.{one.name}.distance_to", one.distance_to)]
        labels = [run.label for run in runs]
        for item, label in asked:
            if label and label not in labels:
                study.mistakes.add(item, "is no run of this study",
                                   f"there are {', '.join(labels)}", label)
        return self.named(runs, folder)

    def named(self, runs: list[Run], folder: Path) -> list[Run]:
        """A reference that is another run as well stands in that one's line."""
        there = {path.name.rpartition("-")[2]: path.name for path in (folder / "runs").glob("*-*")
                 if not path.name.endswith(".running")}
        kept, first = {}, ""
        for run in runs:
            start = run.label if run.line in (run.label, "grid", "list", "run") else \
                f"{run.line} {run.label}"
            ident = self.hash.of(run.case, run.settings, f"{self.rest}accuracy {run.accuracy}\n")
            run.name = there.get(ident, f"{file_name(start)[:60]}-{ident}")
            if ident not in kept or kept[ident].line == "reference":
                kept[ident] = run
            first = first or ident
        self.reference_name = kept[first].name if self.study.reference else ""
        return list(kept.values())


def chosen(row: list):
    """A value of what is varied, as tables show it: one, where all keys have the same."""
    return row if not row or any(one != row[0] for one in row) else \
        "" if row[0] is None else row[0]


def label_of(one: Vary, row: tuple) -> str:
    values = row if any(value != row[0] for value in row) else row[:1]
    text = one.name_of(row) or ",".join(value if isinstance(value, str) else toml_text(value)
                                        for value in values)
    return f"×{text}" if one.factors else text


def file_name(text: str) -> str:
    return re.sub(r"[^A-Za-z0-9.+=,-]+", "_", text.replace("×", "x")).strip("_.") or "run"
