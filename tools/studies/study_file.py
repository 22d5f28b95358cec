# SPDX-License-Identifier: GPL-3.0-or-later
"""From a study file to plain data, with every mistake of its own form found at once; what the case
says of keys and values is asked of plyform later (check_runs.py). docs/users/studies.md describes
the file."""

import math
import os
from dataclasses import dataclass, field
from pathlib import Path

from base.ending import Trouble, one_line
from base.files import is_file, parsed_toml, read_text
from studies import shown
from studies.fields import Field
from studies.reader import Reader, is_number, is_value, is_word
from studies.toml_place import Mistakes, lines_of

METHODS = ("one at a time", "grid", "list", "latin hypercube", "sobol")
DRAWN = METHODS[3:]  # from ranges, with a number of runs
PRESETS = ("instant", "draft", "standard", "reference")
INCLUDED = ("area_means", "figures", "limits", "stops", "table")  # of a file included
MOST_RUNS = 100000  # of a second each they take a day
# columns of every table
COLUMNS = ("line", "setting", "status", "against", "wall_time_s", "cpu_s", "message", "folder", "stop",
           "breaks", "within_limits", "on_front")
CASE = "case"  # the key that stands for the case file itself


@dataclass
class Vary:
    """A key, or some together, and what they take."""
    name: str
    item: str                               # of the study file: vary.1
    keys: list[str]                         # as in --set; may hold *
    each: bool = False                      # a draw of its own for every key that fits
    values: list[tuple] = field(default_factory=list)  # one for each key
    names: list[str] = field(default_factory=list)     # of the values, where they have any
    factors: bool = False                   # values are factors of the case's own
    range: tuple[float, float] | None = None
    log: bool = False

    def row(self, value) -> tuple:
        """A value for each key; one that is no list is for all."""
        several = len(self.keys) > 1
        return tuple(value) if several and isinstance(value, list) else (value,) * len(self.keys)

    def name_of(self, row: tuple) -> str:
        return self.names[self.values.index(row)] if self.names and row in self.values else ""

    def drawn(self, share: float) -> float:
        """The value at a share of the range; six digits are enough to tell runs apart."""
        low, high = self.range
        value = low * (high / low)**share if self.log else low + share * (high - low)
        return float(f"{value:.6g}")


@dataclass
class ExtraRun:
    name: str
    item: str
    settings: list[str]
    accuracy: str = ""
    values: dict = field(default_factory=dict)  # by the name of a vary
    against: str = ""                           # label of the run that it is compared with
    quarter_turns: int = 0                      # of that one about z, before


@dataclass
class Reference:
    values: dict
    settings: list[str]
    factors: dict[str, float]
    accuracy: str
    fields: list[str]


@dataclass
class Study:
    file: Path
    mistakes: Mistakes
    title: str = ""
    case: Path = Path()
    settings: list[str] = field(default_factory=list)
    accuracy: str = ""
    presets: list[str] = field(default_factory=list)
    method: str = METHODS[0]
    runs: int = 0
    seed: int = 0
    run_name: str = ""  # template of the labels of drawn, listed and grid runs
    vary: list[Vary] = field(default_factory=list)
    extra: list[ExtraRun] = field(default_factory=list)
    reference: Reference | None = None
    fields: dict[str, Field] = field(default_factory=dict)  # by word, once the program is known
    area_means: float | None = None  # mm, radius of the discs
    figures: dict[str, str] = field(default_factory=dict)
    limits: dict[str, shown.Limit] = field(default_factory=dict)
    stops: dict[str, str] = field(default_factory=dict)  # part of a message, and its letter
    table: dict[str, str] = field(default_factory=dict)
    pictures: list[shown.Picture] = field(default_factory=list)


def read_range(reader: Reader, one: Vary, method: str) -> None:
    pair = reader.get("range", lambda value: isinstance(value, list) and len(value) == 2 and
                      all(map(is_number, value)) and value[0] < value[1],
                      "must be [LOW, HIGH] with LOW below HIGH", "give two numbers")
    if pair is None:
        return
    one.range = (float(pair[0]), float(pair[1]))
    if one.log and pair[0] <= 0:
        reader.fail("range", "must be above 0 on a logarithmic scale",
                    "raise LOW, or take scale out", pair)
        one.log = False
    if method in DRAWN:
        return
    count = reader.whole("count", 2, 2, "say in how many values the range is divided", True,
                         MOST_RUNS)
    one.values = [(one.drawn(i / (count - 1)),) for i in range(count)]


def read_values(reader: Reader, one: Vary, twice: bool) -> None:
    """In a list values may stand twice."""
    key, several = "factors" if one.factors else "values", len(one.keys)
    if one.factors:
        values = reader.items(key, lambda value: is_number(value) and value > 0,
                              "must be a number above 0", "give factors of the case's own value",
                              True, twice)
    elif several > 1:
        values = reader.items(key, lambda value: is_value(value) and not
                              (isinstance(value, list) and len(value) != several),
                              f"must be a list of {several} values, one for each of keys, or one "
                              "value for all", "write values = [[..., ...], [..., ...]]", True,
                              twice)
    else:
        values = reader.items(key, is_value, "must be a number, a text, true, false or a list",
                              "give values as they stand in a case file", True, twice)
    if not reader.table.get(key) and key in reader.table:
        reader.fail(key, "must have at least one value", "give the values to run")
    one.values = [one.row(value) for value in values]
    one.names = reader.items("names", is_word, "must be a text", "give a name for each value")
    if one.names and len(one.names) != len(reader.table.get(key, [])):
        reader.fail("names", "must have as many items as values", "give a name for each value")
        one.names = []


def read_vary(table: dict, number: int, study: Study) -> Vary:
    reader = Reader(table, f"vary.{number}", "vary", study.mistakes)
    given = [key for key in ("key", "keys", "each") if key in table]
    if len(given) != 1:
        reader.fail("key", "is missing" if not given else f"stands beside {given[-1]}",
                    "give one of key, keys (several together) and each (several, each its own)")
    keys = reader.some("keys", is_word, "must be a key of the case", "as in --set") or ["?"] \
        if given == ["keys"] else [reader.word((given or ["key"])[0], "as in --set", "?")]
    one = Vary(reader.word("name", "give a name for the column", " ".join(keys)), reader.item, keys,
               given == ["each"])
    one.factors = "factors" in table
    one.log = reader.choice("scale", ("linear", "log"), "linear") == "log"
    ways = [key for key in ("values", "factors", "range") if key in table]
    if study.method in DRAWN and ways != ["range"]:
        reader.fail(ways[0] if ways else "range", f"does not go with method {study.method}"
                    if ways else "is missing", "give range = [LOW, HIGH]")
    elif len(ways) != 1:
        reader.fail(ways[0] if ways else "values", "is missing" if not ways else
                    f"stands beside {ways[1]}", "give one of values, factors and range with count")
    elif ways == ["range"]:
        read_range(reader, one, study.method)
    else:
        read_values(reader, one, study.method == "list")
    for key in {"count", "scale"} & table.keys() if ways != ["range"] else ():
        reader.fail(key, "goes with range only", "take it out")
    if "names" in table and ways == ["range"]:
        reader.fail("names", "goes with values only", "take it out")
    return one


def read_chosen(reader: Reader, study: Study) -> dict:
    """Values of what is varied, by its name."""
    wanted = reader.get("values", lambda value: isinstance(value, dict), "must be a table",
                        "write values = { NAME of a vary = VALUE }", {})
    known = {one.name: one for one in study.vary if not one.each}
    for name, value in wanted.items():
        if name not in known:
            reader.fail("values", f"there is no [[vary]] {name}", f"there are {', '.join(known)}")
        elif not is_value(value):
            reader.fail("values", f"{name} must be a value", "write it as in [[vary]]")
    return {name: value for name, value in wanted.items() if name in known and is_value(value)}


def read_extra(table: dict, number: int, study: Study) -> ExtraRun:
    reader = Reader(table, f"run.{number}", "run", study.mistakes)
    return ExtraRun(reader.word("name", "give the run a name", f"run {number}", True), reader.item,
                    reader.settings(), reader.choice("accuracy", PRESETS),
                    read_chosen(reader, study),
                    reader.word("against", "name the run that it is compared with"),
                    reader.get("quarter_turns", lambda value: value in (0, 1, 2, 3),
                               "must be 0, 1, 2 or 3", "say by how many the other run is turned",
                               0))


def read_reference(table, study: Study) -> Reference | None:
    if table is None:
        return None
    if not isinstance(table, dict):
        study.mistakes.add("reference", "must be a table", "write [reference]")
        return None
    reader = Reader(table, "reference", "reference", study.mistakes)
    factors = reader.get("factors", lambda value: isinstance(value, dict), "must be a table",
                         'write factors = { "solver.duration" = 2.0 }', {})
    for key, value in factors.items():
        if not (is_number(value) and value > 0):
            reader.fail("factors", f"{key} must be a number above 0",
                        "give a factor of the case's own value")
    fields = reader.items("fields", is_word,
                          "must be a word", 'name fields to compare, as fields = ["shear"]')
    right = {key: value for key, value in factors.items() if is_number(value)}
    return Reference(read_chosen(reader, study), reader.settings(), right,
                     reader.choice("accuracy", PRESETS),
                     fields if "fields" in table else ["shear"])


def case_file(folder: Path, text: str) -> Path:
    """Of a case file or its folder; runs are called from another folder."""
    path = Path(os.path.realpath(folder / text))
    return path / "case.toml" if os.path.isdir(path) else path


def case_path(reader: Reader, folder: Path) -> Path:
    text = reader.word("case", "give the case file or its folder, seen from the study file", "",
                       True)
    path = case_file(folder, text)
    if text and not is_file(path):
        reader.fail("case", f"there is no file {path}",
                    "give the case file or its folder, seen from the study file", text)
    return path


def check_names(study: Study) -> None:
    seen = {"case", "reference", *study.presets}
    for one in [*study.vary, *study.extra]:
        if one.name in seen:
            study.mistakes.add(f"{one.item}.name", "is the name of another line too",
                               "give each a name of its own, other than case, reference and those "
                               "of presets", one.name)
        seen.add(one.name)
    for item, names in (("vary", [one.name for one in study.vary]), ("figures", study.figures)):
        for name in names:
            if name in COLUMNS:
                study.mistakes.add(item, f"{name} is a column of every table", "give another name")
    runs = study.runs if study.method in DRAWN else math.prod(
        len(one.values) for one in study.vary) if study.method == "grid" else 0
    if runs > MOST_RUNS:
        study.mistakes.add("method", f"the grid has {runs} runs, more than {MOST_RUNS}",
                           "vary less, or draw from ranges", study.method)
    lengths = {len(one.values) for one in study.vary}
    if study.method == "list" and len(lengths) > 1:
        study.mistakes.add("method", "in a list all [[vary]] must have as many values",
                           f"they have {', '.join(map(str, sorted(lengths)))}", study.method)
    if not (study.vary or study.extra or study.presets):
        study.mistakes.add("vary", "is missing: nothing is varied",
                           "add [[vary]] with key and values")


def check_against(study: Study) -> None:
    for one in study.extra:
        reader = Reader({}, one.item, "run", study.mistakes)
        if one.against and study.area_means is None:
            reader.fail("against", "needs area means", "add a table [area_means]", one.against)
        if one.quarter_turns and not (one.against or study.reference):
            reader.fail("quarter_turns", "needs a run to turn", "add against")


def included(root: dict, mistakes: Mistakes) -> dict:
    """With the tables of another file, in which what the study itself has is replaced."""
    name = root.get("include")
    if name is None:
        return root
    file = mistakes.file.parent / str(name)
    try:
        text = read_text(file)
        tables = parsed_toml(file, text)
    except Trouble as problem:
        mistakes.add("include", f"cannot be read: {problem}", "give a file of TOML, seen from the "
                     "study file", one_line(name, 200))
        return root
    mistakes.also = (file, lines_of(text))
    for key in tables:
        if key not in INCLUDED:
            mistakes.add(key, "does not go into a file that is included",
                         f"there go {', '.join(INCLUDED)}")
    return root | {key: tables[key] | root.get(key, {}) for key in INCLUDED
                   if isinstance(tables.get(key), dict) and isinstance(root.get(key, {}), dict)}


def read_shown(reader: Reader, root: dict, study: Study) -> None:
    mistakes = study.mistakes
    study.area_means = shown.read_area_means(root.get("area_means"), mistakes)
    study.figures = {**shown.FIGURES, **shown.read_figures(root.get("figures", {}), mistakes)}
    study.limits = shown.read_limits(root.get("limits", {}), mistakes)
    study.stops = shown.read_texts("stops", root.get("stops", {}), mistakes)
    study.table = shown.read_texts("table", root.get("table", {}), mistakes)
    for i, one in enumerate(reader.tables("picture")):
        study.pictures.append(shown.read_picture(one, i, study))


def read_study(file: Path) -> Study:
    """Never fails for what stands in the file: Study.mistakes has it."""
    text = read_text(file)
    mistakes = Mistakes(file, lines_of(text))
    study = Study(file, mistakes)
    try:
        root = parsed_toml(file, text)
    except Trouble as problem:
        mistakes.found.append((0, str(problem)))
        return study
    root = included(root, mistakes)
    reader = Reader(root, "", "", mistakes)
    study.method = reader.choice("method", METHODS, METHODS[0])
    study.runs = reader.whole("runs", 1, 1, "say how many runs are drawn", study.method in DRAWN,
                              MOST_RUNS)
    if "runs" in root and study.method not in DRAWN:
        reader.fail("runs", f"does not go with method {study.method}", "take it out")
    study.title = reader.word("title", "give a title", file.stem)
    study.case, study.settings = case_path(reader, file.parent), reader.settings()
    study.accuracy = reader.choice("accuracy", PRESETS)
    study.presets = reader.items("presets", lambda one: one in PRESETS,
                                 f"must be one of {', '.join(PRESETS)}", "name accuracies")
    study.seed = reader.whole("seed", 0, 1, "give the seed of the draws")
    study.vary = [read_vary(one, i, study) for i, one in enumerate(reader.tables("vary"))]
    study.run_name = reader.word("run_name", "give a template such as \"friction {friction}\"")
    study.extra = [read_extra(one, i, study) for i, one in enumerate(reader.tables("run"))]
    study.reference = read_reference(root.get("reference"), study)
    read_shown(reader, root, study)
    check_names(study)
    check_against(study)
    return study
