# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts tables and pictures of sets into a text, between comments of HTML:

    <!-- table: NAME -->  ...  <!-- end -->        <!-- picture: NAME -->  ...  <!-- end -->

What stood between is replaced; a mark without an end gets one.
"""

import re
from pathlib import Path

from plotting.draw_real_cloth import DRAWN
from plotting.reading import Trouble
from sweeps import report

MARK = re.compile(r"<!-- (table|picture): ([a-z_]+) -->\n(?:(?:(?!<!--).)*?<!-- end -->\n)?", re.S)
ALT = {"fabric": "How far the shear of each ply moves with friction, compression and bending",
       "buckling": "How far the shear of each ply moves with a plateau along pressed yarns"}


def names_in(text: str, known) -> list[str]:
    """Sets that the text asks for."""
    names = list(dict.fromkeys(name for _, name in MARK.findall(text)))
    unknown = [name for name in names if name not in known]
    if unknown or not names:
        raise Trouble(f"there is no set {unknown[0]}" if unknown else
                      "the text has no <!-- table: NAME -->")
    return names


def picture(name: str, rows: list[dict], text: Path) -> str:
    """Draws beside the text."""
    if name not in DRAWN:
        raise Trouble(f"there is no picture of {name}")
    if not rows:
        return ""
    file = text.with_name(f"{text.stem}_{name}.png")
    DRAWN[name](rows).savefig(file, dpi=80)
    return f"![{ALT[name]}]({file.name})\n\n"


def fill(text: Path, told: dict) -> None:
    """`told`: of each set its rows and what is missing, and the set itself."""
    def filled(match: re.Match) -> str:
        kind, name = match.groups()
        which, rows, missing = told[name]
        inner = picture(name, rows, text) if kind == "picture" else \
            report.text_of(which, rows, missing) + "\n\n"
        return f"<!-- {kind}: {name} -->\n\n{inner}<!-- end -->\n"
    before = text.read_text(encoding="utf-8")
    text.write_text(MARK.sub(filled, before), encoding="utf-8")
