# SPDX-License-Identifier: GPL-3.0-or-later
"""From a study file to plain data, with every mistake of its own form found at once; what the case
says of keys and values is asked of plyform later (check_runs.py). docs/users/studies.md describes
the file."""

import difflib
import math
import re
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

from plotting.reading import FIELDS, Trouble
from studies.toml_place import Mistakes, lines_of

METHODS = ("one at a time", "grid", "list", "latin hypercube", "sobol")
DRAWN = METHODS[3:]  # from ranges, with a number of runs
PRESETS = ("draft", "standard", "reference")
TAKE = ("max", "min", "mean", "sum")
PICTURES = {"cost": (), "map": ("x", "y", "figure"), "scatter": ("x", "y"), "window": ("x", "y")}
CASE = "case"  # the key that stands for the case file itself
KNOWN = {
    "": ("title", "case", "set", "accuracy", "presets", "method", "runs", "seed", "vary", "run",
         "reference", "figures", "limits", "picture"),
    "vary": ("name", "key", "keys", "each", "values", "factors", "range", "count", "scale"),
    "run": ("name", "set", "accuracy"),
    "reference": ("set", "factors", "accuracy", "fields"),
    "limits": ("at_most", "at_least"),
    "picture": ("kind", "file", "title", "x", "y", "figure")}
FIGURES = {"steps": "steps", "elements": "elements",
           "largest_shear_deg": "max plies.*.max_shear_deg",
           "promised_error_deg": "accuracy.promised_shear_error_deg"}


@dataclass
class Vary:
    """A key, or some together, and what they take."""
    name: str
    item: str                               # of the study file: vary.1
    keys: list[str]                         # as in --set; may hold *
    each: bool = False                      # a draw of its own for every key that fits
    values: list[tuple] = field(default_factory=list)  # one for each key
    factors: bool = False                   # values are factors of the case's own
    range: tuple[float, float] | None = None
    log: bool = False

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


@dataclass
class Reference:
    settings: list[str]
    factors: dict[str, float]
    accuracy: str
    fields: list[str]


@dataclass
class Limit:
    at_most: float = math.inf
    at_least: float = -math.inf


@dataclass
class Picture:
    kind: str
    file: str
    title: str
    x: str = ""
    y: str = ""
    figure: str = ""


@dataclass
class Study:
    file: Path
    title: str
    case: Path
    settings: list[str]
    accuracy: str
    presets: list[str]
    method: str
    runs: int
    seed: int
    vary: list[Vary]
    extra: list[ExtraRun]
    reference: Reference | None
    figures: dict[str, str]
    limits: dict[str, Limit]
    pictures: list[Picture]
    mistakes: Mistakes


def is_number(value) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def is_word(value) -> bool:
    return isinstance(value, str) and value != "" and "\n" not in value


class Reader:
    """One table of the file; whatever is wrong goes to the mistakes, a usable value comes out."""

    def __init__(self, table: dict, item: str, kind: str, mistakes: Mistakes):
        self.table, self.item, self.mistakes = table, item, mistakes
        self.meant: set[str] = set()  # keys that are there, but misspelt
        known = KNOWN[kind]
        for key in table:
            if key not in known:
                near = difflib.get_close_matches(key, known, 1)
                self.meant.update(near)
                self.fail(key, "unknown key",
                          f"did you mean {near[0]}?" if near else f"there are {', '.join(known)}")

    def path(self, key: str) -> str:
        return f"{self.item}.{key}" if self.item else key

    def fail(self, key: str, rule: str, remedy: str, value=None) -> None:
        if rule == "is missing" and key in self.meant:
            return
        self.mistakes.add(self.path(key), rule, remedy, value)

    def get(self, key: str, right, rule: str, remedy: str, default=None, required=False):
        """The value if right(value); else the default."""
        if key not in self.table:
            if required:
                self.fail(key, "is missing", remedy)
            return default
        value = self.table[key]
        if right(value):
            return value
        self.fail(key, rule, remedy, value if is_number(value) or isinstance(value, str) else None)
        return default

    def word(self, key: str, remedy: str, default="", required=False) -> str:
        return self.get(key, is_word, "must be a text that is not empty", remedy, default, required)

    def choice(self, key: str, words: tuple, default: str = "", required=False) -> str:
        return self.get(key, lambda value: value in words, f"must be one of {', '.join(words)}",
                        "take one of these", default, required)

    def whole(self, key: str, least: int, default: int, remedy: str, required=False) -> int:
        return self.get(key, lambda value: type(value) is int and value >= least,
                        f"must be a whole number from {least} on", remedy, default, required)

    def items(self, key: str, right, rule: str, remedy: str, required=False) -> list:
        """A list, of which wrong items and those that stand twice are told and left out."""
        values = self.get(key, lambda value: isinstance(value, list), "must be a list", remedy, [],
                          required)
        kept = []
        for i, value in enumerate(values):
            if not right(value):
                self.fail(f"{key}.{i}", rule, remedy, value if is_number(value) else None)
            elif value in kept and key != "set":
                self.fail(f"{key}.{i}", "stands twice", "take one of the two out",
                          None if isinstance(value, dict) else value)
            else:
                kept.append(value)
        return kept

    def settings(self) -> list[str]:
        return self.items("set", lambda one: is_word(one) and re.match(r"[^=\s]+=.", one),
                          "must be a text KEY=VALUE", 'write for example "contact.friction=0.3"')

    def tables(self, key: str) -> list[dict]:
        return self.get(key, lambda value: isinstance(value, list) and
                        all(isinstance(one, dict) for one in value),
                        "must be a list of tables", f"write each under [[{key}]]", [])


def is_value(value) -> bool:
    return is_number(value) or is_word(value) or isinstance(value, bool) or \
        isinstance(value, list) and all(map(is_value, value))


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
    count = reader.whole("count", 2, 2, "say in how many values the range is divided", True)
    one.values = [(one.drawn(i / (count - 1)),) for i in range(count)]


def read_values(reader: Reader, one: Vary) -> None:
    key = "factors" if one.factors else "values"
    if one.factors:
        values = reader.items(key, lambda value: is_number(value) and value > 0,
                              "must be a number above 0", "give factors of the case's own value",
                              True)
    elif len(one.keys) > 1:
        values = reader.items(key, lambda value: isinstance(value, list) and
                              len(value) == len(one.keys) and all(map(is_value, value)),
                              f"must be a list of {len(one.keys)} values, one for each of keys",
                              "write values = [[..., ...], [..., ...]]", True)
    else:
        values = reader.items(key, is_value, "must be a number, a text, true, false or a list",
                              "give values as they stand in a case file", True)
    if not reader.table.get(key) and key in reader.table:
        reader.fail(key, "must have at least one value", "give the values to run")
    one.values = [tuple(value) if len(one.keys) > 1 else (value,) for value in values]


def read_vary(table: dict, number: int, study: Study) -> Vary:
    reader = Reader(table, f"vary.{number}", "vary", study.mistakes)
    given = [key for key in ("key", "keys", "each") if key in table]
    if len(given) != 1:
        reader.fail("key", "is missing" if not given else f"stands beside {given[-1]}",
                    "give one of key, keys (several together) and each (several, each its own)")
    keys = reader.items("keys", is_word, "must be a key of the case", "as in --set") or ["?"] \
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
        read_values(reader, one)
    for key in {"count", "scale"} & table.keys() if ways != ["range"] else ():
        reader.fail(key, "goes with range only", "take it out")
    return one


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
    fields = reader.items("fields", lambda one: one in FIELDS,
                          f"must be one of {', '.join(FIELDS)}", "name fields to compare")
    right = {key: value for key, value in factors.items() if is_number(value)}
    return Reference(reader.settings(), right, reader.choice("accuracy", PRESETS),
                     fields if "fields" in table else ["shear"])


def read_figures(table, study: Study) -> dict[str, str]:
    if not isinstance(table, dict):
        study.mistakes.add("figures", "must be a table",
                           'write [figures] and lines NAME = "PATH in summary.json"')
        return {}
    for name, path in table.items():
        if not (is_word(path) and (" " not in path or path.split(" ", 1)[0] in TAKE)):
            study.mistakes.add(f"figures.{name}", "must be a path in summary.json, before it one "
                               f"of {', '.join(TAKE)} where a * stands for several",
                               'write for example "max plies.*.max_shear_deg"')
    return {name: path for name, path in table.items() if isinstance(path, str)}


def read_limits(table, study: Study) -> dict[str, Limit]:
    limits = {}
    if not isinstance(table, dict):
        study.mistakes.add("limits", "must be a table", "write [limits] and lines FIGURE = LIMIT")
        return limits
    for name, value in table.items():
        if is_number(value):
            limits[name] = Limit(at_most=value)
        elif isinstance(value, dict) and value and all(map(is_number, value.values())):
            Reader(value, f"limits.{name}", "limits", study.mistakes)
            limits[name] = Limit(value.get("at_most", math.inf), value.get("at_least", -math.inf))
        else:
            study.mistakes.add(f"limits.{name}", "must be a number, the most that is allowed, or "
                               "{ at_least = LOW, at_most = HIGH }", "give the limit")
    return limits


def read_picture(table: dict, number: int, study: Study) -> Picture:
    reader = Reader(table, f"picture.{number}", "picture", study.mistakes)
    kind = reader.choice("kind", tuple(PICTURES), "cost", True)
    one = Picture(kind, reader.word("file", "give a file name", f"{kind}.png"),
                  reader.word("title", "give a title", study.title))
    for key in PICTURES[kind]:
        setattr(one, key, reader.word(key, "name a vary or a figure", "", True))
    for key in {"x", "y", "figure"} & table.keys() - set(PICTURES[kind]):
        reader.fail(key, f"a picture of kind {kind} has none", "take it out")
    if kind == "cost" and study.reference is None:
        reader.fail("kind", "needs errors against a reference", "add a table [reference]", kind)
    if kind == "window" and not study.limits:
        reader.fail("kind", "needs limits", "add a table [limits]", kind)
    return one


def case_path(reader: Reader, folder: Path) -> Path:
    text = reader.word("case", "give the case file or its folder, seen from the study file", "",
                       True)
    path = (folder / text).resolve()  # runs are called from another folder
    path = path / "case.toml" if path.is_dir() else path
    if text and not path.is_file():
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
    lengths = {len(one.values) for one in study.vary}
    if study.method == "list" and len(lengths) > 1:
        study.mistakes.add("method", "in a list all [[vary]] must have as many values",
                           f"they have {', '.join(map(str, sorted(lengths)))}", study.method)
    if not (study.vary or study.extra or study.presets):
        study.mistakes.add("vary", "is missing: nothing is varied",
                           "add [[vary]] with key and values")


def read_study(file: Path) -> Study:
    """Never fails for what stands in the file: Study.mistakes has it."""
    try:
        text = file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as problem:
        raise Trouble(f"{file} cannot be read: {problem}; give a study file") from problem
    mistakes = Mistakes(file, lines_of(text))
    try:
        root = tomllib.loads(text)
    except tomllib.TOMLDecodeError as problem:
        where = re.search(r"line (\d+)", str(problem))
        mistakes.told.append((0, f"{file}:{where[1] if where else 1}: error: {problem}; "
                              "write it as TOML does"))
        root = {}
        return Study(file, "", file, [], "", [], METHODS[0], 0, 0, [], [], None, {}, {}, [],
                     mistakes)
    reader = Reader(root, "", "", mistakes)
    method = reader.choice("method", METHODS, METHODS[0])
    runs = reader.whole("runs", 1, 1, "say how many runs are drawn", method in DRAWN)
    if "runs" in root and method not in DRAWN:
        reader.fail("runs", f"does not go with method {method}", "take it out")
    study = Study(file, reader.word("title", "give a title", file.stem),
                  case_path(reader, file.parent), reader.settings(),
                  reader.choice("accuracy", PRESETS),
                  reader.items("presets", lambda one: one in PRESETS,
                               f"must be one of {', '.join(PRESETS)}", "name accuracies"),
                  method, runs, reader.whole("seed", 0, 1, "give the seed of the draws"), [], [],
                  None, {}, {}, [], mistakes)
    study.vary = [read_vary(one, i, study) for i, one in enumerate(reader.tables("vary"))]
    for i, table in enumerate(reader.tables("run")):
        one = Reader(table, f"run.{i}", "run", mistakes)
        study.extra.append(ExtraRun(one.word("name", "give the run a name", f"run {i}", True),
                                    one.item, one.settings(), one.choice("accuracy", PRESETS)))
    study.reference = read_reference(root.get("reference"), study)
    study.figures = {**FIGURES, **read_figures(root.get("figures", {}), study)}
    study.limits = read_limits(root.get("limits", {}), study)
    study.pictures = [read_picture(one, i, study) for i, one in enumerate(reader.tables("picture"))]
    check_names(study)
    return study
