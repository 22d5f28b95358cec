# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts a study's table, verdicts and pictures into a text in Markdown, between comments of HTML:

    <!-- table: NAME -->  ...  <!-- end -->

or picture or reach in the place of table. NAME is the study file's. What stood between is
replaced; a mark without an end gets one.
"""

import re
import shutil
from math import isfinite
from pathlib import Path

from compare import table
from base.files import read_text
from base.summary_file import SOUND
from plotting.reading import Trouble
from plotting.whole_file import make_in, write_whole
from studies import reach
from studies.plan import Planner
from studies.shown import COLUMN
from studies.study_file import Study
from studies.verdicts import columns_of, title, verdicts

MARK = re.compile(r"<!-- (table|picture|reach): (\S+) -->\n"
                  r"(?:(?:(?!<!--).)*?<!-- end -->\n)?", re.S)
NONE = "–"
MANY = 5  # values of a figure; of more a cell shows the range
PLAIN = {"status": "{status}", "CPU, s": "{cpu_s:.0f}"}  # of a study without [table]


def shown(value, form: str) -> str:
    if not isinstance(value, (int, float)):
        return str(value) if value not in ("", None) else NONE
    if not isfinite(value):
        return NONE
    text = format(value, form)
    return text.removeprefix("-") if form and float(text) == 0.0 else text


def filled(template: str, row: dict) -> str:
    def values(match: re.Match) -> str:
        name, form = match[1], match[2] or ""
        found = [row[column] for column in columns_of(row, name)]
        if len(found) > MANY and all(isinstance(value, (int, float)) for value in found):
            return f"{shown(min(found), form)} to {shown(max(found), form)}"
        return " ".join(shown(value, form) for value in found) or NONE
    return COLUMN.sub(values, template)


def markdown(study: Study, rows: list[dict]) -> str:
    """Table, verdicts, and what else is to be said of the runs."""
    ended = [row for row in rows if row["status"] != "missing" and row["line"] != "reference"]
    if not ended:
        return "None of these runs is there."
    templates = study.table or PLAIN | {name: f"{{{name}:.3g}}" for name in study.figures}
    cells = [[title(row), *(filled(template, row) for template in templates.values())]
             for row in ended]
    others = list(dict.fromkeys(row["against"] for row in ended if row.get("against")))
    against = [title(row) for row in rows if others == [row["setting"]]]
    parts = [f"Area means against: {against[0]}." if against else "",
             table(["run", *templates], cells, 2),
             "\n".join(f"- **{word}**: {text}" for word, text in verdicts(study, rows))]
    lines = [f"- {title(row)} was {row['status']}: {row['message']}" for row in ended
             if row["status"] not in SOUND]
    if missing := [title(row) for row in rows if row["status"] == "missing"]:
        lines.append(f"- {len(missing)} not there: {', '.join(missing)}")
    return "\n\n".join(part for part in (*parts, "\n".join(lines)) if part)


def pictures(study: Study, folder: Path, text: Path) -> str:
    """Copies them beside the text."""
    lines = []
    for one in study.pictures:
        name = study.file.stem if len(study.pictures) == 1 else \
            f"{study.file.stem}_{Path(one.file).stem}"
        name = name if name.startswith(text.stem) else f"{text.stem}_{name}"
        file = make_in(text.parent, name + Path(one.file).suffix,
                       lambda part, one=one: shutil.copyfile(folder / one.file, part))
        lines.append(f"![{one.title}]({file.name})")
    return "\n\n".join(lines)


def fill(text: Path, study: Study, planner: Planner, rows: list[dict], folder: Path) -> None:
    before, name = read_text(text), study.file.stem
    if name not in (found for _, found in MARK.findall(before)):
        raise Trouble(f"{text} has no place for this study; write a line <!-- table: {name} -->, "
                      f"<!-- picture: {name} --> or <!-- reach: {name} -->")

    def replaced(match: re.Match) -> str:
        if match[2] != name:
            return match[0]
        inner = pictures(study, folder, text) if match[1] == "picture" else \
            markdown(study, rows) if match[1] == "table" else \
            reach.markdown(reach.reach(study, planner, rows))
        return f"<!-- {match[1]}: {name} -->\n\n{inner}\n\n<!-- end -->\n"
    write_whole(text, MARK.sub(replaced, before), rewrite=True)
