# SPDX-License-Identifier: GPL-3.0-or-later
"""Blocks of an LS-DYNA keyword file: a keyword and the cards below it; fields of standard width, of ten
digits (I10=Y, or % behind the keyword), long ones (LONG=Y or LONG=S, or +), or with commas; *INCLUDE."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from exchange.deck_lines import Line, included, texts_of


@dataclass
class Cards:
    head: Line
    keyword: str         # without its star
    form: str            # standard, i10 or long
    lines: list[int] = field(default_factory=list)
    texts: list[str] = field(default_factory=list)

    def line(self, row: int) -> Line:
        return Line(self.head.path, self.lines[row], self.texts[row])

    def words(self, row: int, widths: list[int]) -> list[str]:
        text = self.texts[row]
        if "," in text:
            words = [word.strip() for word in text.split(",")]
            return words + [""] * (len(widths) - len(words))
        words, at = [], 0
        for width in widths:
            words.append(text[at:at + width].strip())
            at += width
        return words

    def widths(self, standard: list[int]) -> list[int]:
        """Of a card's fields, given those of the standard form: eight, ten and sixteen."""
        if self.form == "long":
            return [20] * len(standard)
        return [10 if width == 8 and self.form == "i10" else width for width in standard]


def blocks_of(path: Path, depth: int = 0, beside: Path | None = None,
              form: str = "standard") -> Iterator[Cards]:
    texts, here = texts_of(path), None
    beside = beside or path.parent
    for k, text in enumerate(texts):
        if text[:1] == "*":
            if here is not None:
                yield from finished(here, depth, beside, form)
            words = text.split("$", 1)[0][1:].upper().split()
            keyword = words[0] if words else ""
            if keyword == "END":
                return
            if keyword == "KEYWORD":
                form = form_of(" ".join(words[1:]), form)
            here = Cards(Line(path, k + 1, text), keyword, form)
            mark = keyword[-1:] if keyword[-1:] in "+%-" else (words[1] if len(words) == 2 else "")
            here.form = {"+": "long", "%": "i10", "-": "standard"}.get(mark, form)
            here.keyword = keyword.rstrip("+%-")
        elif here is not None:
            if "$" in text:
                text = text.split("$", 1)[0]
            if text and not text.isspace():
                here.lines.append(k + 1)
                here.texts.append(text.rstrip())
    if here is not None:
        yield from finished(here, depth, beside, form)


def form_of(words: str, form: str) -> str:
    words = words.replace(" ", "")
    if "LONG=Y" in words or "LONG=S" in words or "LONG=K" in words:
        return "standard" if "LONG=K" in words else "long"
    return "i10" if "I10=Y" in words else form


def finished(block: Cards, depth: int, beside: Path, form: str) -> Iterator[Cards]:
    """The block, or those of the files that it names."""
    if block.keyword == "INCLUDE":
        name = ""
        for row, text in enumerate(block.texts):
            name += text.strip()
            if name.endswith(" +"):  # goes on
                name = name[:-2].rstrip()
                continue
            yield from blocks_of(included(block.line(row), name, depth, beside), depth + 1, beside,
                                 form)
            name = ""
    elif block.keyword.startswith("INCLUDE_TRANSFORM"):
        raise block.head.wrong("*INCLUDE_TRANSFORM moves the mesh: write the moved mesh into the file")
    else:
        yield block
