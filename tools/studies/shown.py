# SPDX-License-Identifier: GPL-3.0-or-later
"""What a study file wants to see of its runs: figures, limits, the table of a text, pictures."""

import math
import re
from dataclasses import dataclass, field

from base.names import fault_of
from studies.figures import FIGURE, TAKE
from studies.reader import Reader, is_number, is_word

PICTURES = {"cost": (), "map": ("x", "y", "figure"), "scatter": ("x", "y"), "window": ("x", "y"),
            "plies": ("x",)}
TIMES = ("wall_time_s", "cpu_s")  # of a picture of costs
FIGURES = {"steps": "steps", "elements": "elements",
           "largest_shear_deg": "max plies.*.max_shear_deg",
           "promised_error_deg": "accuracy.promised_shear_error_deg"}
FORM = re.compile(r"(\+?\d?(\.\d{1,2})?[feg])?")  # of a number in a template
ENDINGS = (".png", ".svg", ".pdf")
COLUMN = re.compile(r"\{([^{}:]+)(?::([^{}]*))?\}")  # of a template: {punch_N:.0f}


@dataclass
class Limit:
    name: str
    figure: str                # of the table
    at_most: float = math.inf
    at_least: float = -math.inf
    ratio_to: str = ""         # run over whose figure it is taken
    distance_to: str = ""      # run from whose figure it is the distance
    where: list[dict] = field(default_factory=list)  # any of them; none: every run
    text: str = ""             # of its verdict

    def kept_by(self, value: float) -> bool:
        """Not by what is no number: that is not known to be kept."""
        return self.at_least <= value <= self.at_most


@dataclass
class Picture:
    kind: str
    file: str
    title: str
    x: str = ""
    y: str = ""
    figure: str = ""
    figures: list[str] = field(default_factory=list)  # of plies
    rows: str = ""                                    # key of plies
    panels: str = ""                                  # key of window: a plot a value
    around: float = 0.0                               # factor of window: box about the case


def is_figure(path) -> bool:
    if not (is_word(path) and (found := FIGURE.match(path))):
        return False
    try:
        return math.isfinite(float(found[1] or 1.0))
    except ValueError:
        return False


def read_figures(table, mistakes) -> dict[str, str]:
    if not isinstance(table, dict):
        mistakes.add("figures", "must be a table",
                     'write [figures] and lines NAME = "PATH in summary.json"')
        return {}
    for name, path in table.items():
        if not is_figure(path):
            mistakes.add(f"figures.{name}", "must be a path in summary.json, before it one of "
                         f"{', '.join(TAKE)} where a * stands for several, and before all a factor",
                         'write for example "100 * max plies.*.max_pressed_strain"')
    return {name: path for name, path in table.items()
            if is_figure(path)}


def is_condition(value) -> bool:
    """Of a column: a value, a text with * for any, or bounds."""
    if isinstance(value, dict):
        return bool(value) and value.keys() <= {"at_most", "at_least"} and \
            all(map(is_number, value.values()))
    return is_number(value) or is_word(value)


def read_limit(name: str, table: dict, mistakes) -> Limit:
    reader = Reader(table, f"limits.{name}", "limits", mistakes)

    def bound(key: str, default: float) -> float:
        return reader.get(key, is_number, "must be a number", "give the limit", default)
    limit = Limit(name, reader.word("figure", "name a figure", name), bound("at_most", math.inf),
                  bound("at_least", -math.inf), reader.word("ratio_to", "name a run"),
                  reader.word("distance_to", "name a run"))
    if not {"at_most", "at_least"} & table.keys():
        reader.fail("at_most", "is missing", "give at_most, at_least or both")
    if limit.ratio_to and limit.distance_to:
        reader.fail("distance_to", "stands beside ratio_to", "give one of the two")
    wanted = table.get("where", [])
    limit.where = wanted if isinstance(wanted, list) else [wanted]
    if not all(isinstance(one, dict) and one and all(map(is_condition, one.values()))
               for one in limit.where):
        reader.fail("where", "must say what columns have, or be a list of such",
                    'write for example where = { friction = { at_most = 0.2 }, run = "*self*" }')
        limit.where = []
    bounds = ([f"at least {limit.at_least:g}"] if math.isfinite(limit.at_least) else []) + \
        ([f"at most {limit.at_most:g}"] if math.isfinite(limit.at_most) else [])
    limit.text = reader.word("text", "say what must hold", f"{name} {' and '.join(bounds)}")
    return limit


def read_limits(table, mistakes) -> dict[str, Limit]:
    limits = {}
    if not isinstance(table, dict):
        mistakes.add("limits", "must be a table", "write [limits] and lines FIGURE = LIMIT")
        return limits
    for name, value in table.items():
        if is_number(value):
            value = {"at_most": value}
        if isinstance(value, dict):
            limits[name] = read_limit(name, value, mistakes)
        else:
            mistakes.add(f"limits.{name}", "must be a number, the most that is allowed, or "
                         "{ at_least = LOW, at_most = HIGH }", "give the limit")
    return limits


def read_texts(name: str, table, mistakes) -> dict[str, str]:
    """[table], a template of each column by its head, and [stops]."""
    if not isinstance(table, dict) or not all(map(is_word, table.values())):
        mistakes.add(name, "must be a table of texts", "write for example " + (
            'HEAD = "{COLUMN:FORM}"' if name == "table" else '"part of a message" = "P"'))
        return {}
    for head, text in table.items() if name == "table" else ():
        for column, form in COLUMN.findall(text):
            if not FORM.fullmatch(form):
                mistakes.add(f"table.{head}", f"{{{column}:{form}}} has no form of a number",
                             "write for example {punch_N:.1f}; forms end in f, e or g", text)
    return table


def read_area_means(table, mistakes) -> float | None:
    """Radius of the discs, mm."""
    if table is None:
        return None
    if not isinstance(table, dict):
        mistakes.add("area_means", "must be a table", "write [area_means]")
        return None
    return Reader(table, "area_means", "area_means", mistakes).get(
        "radius", lambda value: is_number(value) and value > 0, "must be a number above 0",
        "give the radius of the discs in mm", 10.0)


def is_picture_name(name) -> bool:
    return not fault_of(name) and name.endswith(ENDINGS)


def read_picture(table: dict, number: int, study) -> Picture:
    reader = Reader(table, f"picture.{number}", "picture", study.mistakes)
    kind = reader.choice("kind", tuple(PICTURES), "cost", True)
    one = Picture(kind, reader.get("file", is_picture_name, "must be a file's name without a folder, "
                                   f"which ends in {', '.join(ENDINGS)}", "give a file name",
                                   f"{kind}.png"),
                  reader.word("title", "give a title", study.title))
    if one.file in [other.file for other in study.pictures]:
        reader.fail("file", "is that of another picture too", "give it a name of its own", one.file)
    for key in PICTURES[kind]:
        setattr(one, key, reader.word(key, "name a vary or a figure", "", True))
    if kind == "cost":
        one.figure = reader.word("figure", "name a figure")
        if one.figure and one.figure not in study.figures:
            reader.fail("figure", "is no figure of the study", "name one of [figures]", one.figure)
        one.x = reader.choice("x", TIMES, TIMES[0])
    allowed = {"figure", "x"} if kind == "cost" else set(PICTURES[kind])
    for key in {"x", "y", "figure"} & table.keys() - allowed:
        reader.fail(key, f"a picture of kind {kind} has none", "take it out")
    if kind == "plies":
        one.figures = reader.some("figures", is_word, "must be a text", "name figures of plies")
        if "figures" not in table:
            reader.fail("figures", "is missing", "name figures of plies")
        one.rows = reader.word("rows", "name a vary")
    for key in {"figures", "rows"} & table.keys() if kind != "plies" else ():
        reader.fail(key, f"a picture of kind {kind} has none", "take it out")
    if kind == "window":
        one.panels = reader.word("panels", "name a vary")
        one.around = reader.get("around", lambda value: is_number(value) and value > 1,
                                "must be a number above 1", "give the factor of the box", 0.0)
    for key in {"panels", "around"} & table.keys() if kind != "window" else ():
        reader.fail(key, f"a picture of kind {kind} has none", "take it out")
    if kind == "cost" and study.reference is None:
        reader.fail("kind", "needs errors against a reference", "add a table [reference]", kind)
    if kind == "window" and not study.limits:
        reader.fail("kind", "needs limits", "add a table [limits]", kind)
    return one
