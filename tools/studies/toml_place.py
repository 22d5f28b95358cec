# SPDX-License-Identifier: GPL-3.0-or-later
"""Where things stand in a TOML file, and values as TOML writes them."""

import json
import re
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

TABLE = re.compile(r"^\s*(\[\[?)\s*([^\]]+?)\s*\]\]?\s*(#.*)?$")
KEY = re.compile(r"^\s*([A-Za-z0-9_-]+|\"[^\"]*\"|'[^']*')((?:\s*\.\s*[A-Za-z0-9_-]+)*)\s*=")


def lines_of(text: str) -> dict[str, int]:
    """Line of each table and key by dotted path, items of lists of tables by number from 0:
    vary.1.values. Keys inside inline tables have the line of the key that holds them."""
    at, prefix, counts = {}, "", {}
    for number, line in enumerate(text.splitlines(), 1):
        if match := TABLE.match(line):
            prefix = match[2].replace('"', "").replace("'", "")
            if match[1] == "[[":
                counts[prefix] = counts.get(prefix, -1) + 1
                at.setdefault(prefix, number)
                prefix = f"{prefix}.{counts[prefix]}"
            at.setdefault(prefix, number)
        elif match := KEY.match(line):
            key = match[1].strip("\"'") + match[2].replace(" ", "")
            at.setdefault(f"{prefix}.{key}" if prefix else key, number)
    return at


def toml_text(value) -> str:
    """A value as it stands behind KEY= in --set."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False) if "'" in value else f"'{value}'"
    return "[" + ", ".join(map(toml_text, value)) + "]"


def toml_value(text: str):
    """What stands behind KEY= in --set; a text that is no value of TOML is a word."""
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except (ValueError, RecursionError):  # of more digits or brackets than TOML is read with
        return text


@dataclass
class Mistakes:
    """Of a study file, each one line: place, item, rule and remedy."""
    file: Path
    lines: dict[str, int]
    found: list[tuple[int, str]] = field(default_factory=list)
    also: tuple[Path, dict[str, int]] | None = None  # a file that the study includes

    def place(self, item: str) -> tuple[Path, int]:
        """Of the item, or of the nearest that holds it."""
        while item:
            for file, lines in ((self.file, self.lines), self.also or (self.file, {})):
                if item in lines:
                    return file, lines[item]
            item = item.rpartition(".")[0]
        return self.file, 1

    def add(self, item: str, rule: str, remedy: str, value=None) -> None:
        equals = "" if value is None else f" = {toml_text(value)}"
        file, line = self.place(item)
        self.found.append((line, f"{file}:{line}: error: {item}{equals}: {rule}; {remedy}"))

    def texts(self) -> list[str]:
        return [text for _, text in sorted(self.found, key=lambda one: one[0])]
