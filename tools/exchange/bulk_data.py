# SPDX-License-Identifier: GPL-3.0-or-later
"""Entries of Nastran's bulk data, by name: small and large fields, fields with commas, continued lines,
INCLUDE."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from exchange.deck_lines import Line, included, texts_of



@dataclass
class Entries:
    """All entries of one name in one file: the number and text of the first line of each, and the lines
    that continue it."""
    path: Path
    lines: list[int] = field(default_factory=list)
    texts: list[str] = field(default_factory=list)
    more: dict[int, list[str]] = field(default_factory=dict)  # by the row of the entry

    def line(self, row: int) -> Line:
        return Line(self.path, self.lines[row], self.texts[row])

    def fields(self, row: int) -> list[str]:
        """Of an entry; at least nine."""
        words = fields_of(self.texts[row])
        for text in self.more.get(row, ()):
            words += fields_of(text)[1:]
        return words + [""] * (9 - len(words))

    def each(self) -> Iterator[tuple[Line, list[str]]]:
        return ((self.line(row), self.fields(row)) for row in range(len(self.lines)))


def entries_of(path: Path, depth: int = 0, beside: Path | None = None) -> list[dict[str, Entries]]:
    """A dictionary by name for each file; those of executive and case control, before BEGIN BULK, are
    left out."""
    texts, found, files = texts_of(path), {}, []
    begin = next((k for k, text in enumerate(texts)
                  if text.lstrip()[:5].upper() == "BEGIN" and re.match(r"\s*BEGIN\s+BULK", text.upper())),
                 -1)
    here = None
    for k in range(begin + 1, len(texts)):
        text = texts[k]
        if "$" in text:
            text = text.split("$", 1)[0]
        if not text or text.isspace():
            continue
        name = text[:8].split(",", 1)[0].split("\t", 1)[0].strip().upper()
        if (not name or name[0] in "+*") and here is not None:
            here.more.setdefault(len(here.lines) - 1, []).append(text)
            continue
        name = name.rstrip("*")
        if name[:7] == "ENDDATA":
            break
        if name[:7] == "INCLUDE":
            line = Line(path, k + 1, text)
            for more in texts[k + 1:k + 4]:  # a name in quotes may go on
                text += more.strip() if text.count("'") == 1 else ""
            file = included(line, text.strip()[7:], depth, beside or path.parent)
            files += entries_of(file, depth + 1, beside or path.parent)
            here = None
            continue
        here = found.get(name)
        if here is None:
            here = found[name] = Entries(path)
        here.lines.append(k + 1)
        here.texts.append(text)
    return [found, *files]


def fields_of(text: str) -> list[str]:
    """Name and eight fields (four of large ones); the tenth, which names continuations, is left
    out."""
    if "," in text:
        words = [word.strip() for word in text.split(",")]
        large = words[0].endswith("*")
        return (words + [""] * 9)[:5 if large else 9]
    text = text.expandtabs(8)
    name = text[:8].strip()
    width, count = (16, 4) if name.endswith("*") or name.startswith("*") else (8, 8)
    return [name, *(text[8 + k * width:8 + (k + 1) * width].strip() for k in range(count))]

