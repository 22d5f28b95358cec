# SPDX-License-Identifier: GPL-3.0-or-later
"""What the texts name, for the tests of them: words between backticks, and the commands of their blocks."""

import re
import shlex
from dataclasses import dataclass
from pathlib import Path

FENCE = re.compile(r"^```(\w*)\s*$")
PROGRAMS = re.compile(r"(plyform|(\./)?(tools|tests|build|cases|\.ci)/\S+|export|cmake|cp|mkdir|sed|podman|python3|[A-Z]+=\S+)(\s|$)")


@dataclass
class Block:
    """Code of a text: indented by four, or between fences."""
    file: Path
    line: int  # of its first, from 1
    kind: str  # of a fence; "" of an indented one
    lines: list[str]


def blocks_of(file: Path) -> list[Block]:
    found, inside, blank = [], None, True
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        fence = FENCE.match(line)
        if fence and (inside is None or not inside.kind):
            inside = Block(file, number + 1, fence[1] or "text", [])
            found.append(inside)
        elif fence:
            inside = None
        elif inside is not None and inside.kind:
            inside.lines.append(line)
        elif line.startswith("    ") and (blank or inside is not None):
            if inside is None:
                inside = Block(file, number, "", [])
                found.append(inside)
            inside.lines.append(line[4:])
        elif line.strip():
            inside = None
        blank = not line.strip()
    return found


@dataclass
class Command:
    file: Path
    line: int
    text: str  # without the comment behind it, lines that go on joined

    @property
    def words(self) -> list[str]:
        return shlex.split(self.text)

    @property
    def place(self) -> str:
        return f"{self.file}:{self.line}"


def commands_of(file: Path) -> list[Command]:
    """Of indented blocks and those of a shell, in their order. What a command prints, below `$ command`,
    is left out."""
    found = []
    for block in blocks_of(file):
        if block.kind not in ("", "sh"):
            continue
        session = any(line.startswith("$ ") for line in block.lines)
        lines = iter(enumerate(block.lines, block.line))
        for number, line in lines:
            if session and not line.startswith("$ "):
                continue
            line = line.removeprefix("$ ")
            while line.endswith("\\"):
                line = line[:-1] + next(lines)[1].strip()
            line = re.split(r"\s+#\s|\s{2,}(?=[a-z])", line)[0].strip() if not line.startswith("#") else ""
            if PROGRAMS.match(line) and "…" not in line:
                found.append(Command(file, number, line))
    return found


def pages(source: Path) -> list[Path]:
    """README and the pages for users, in the README's order."""
    return [source / "README.md", *sorted((source / "docs/users").glob("*.md"))]


def texts(source: Path) -> list[Path]:
    return [source / "README.md", source / "CHANGELOG.md", *sorted((source / "docs").rglob("*.md")),
            *sorted((source / "cases").rglob("README.md"))]


def quoted(file: Path) -> list[tuple[int, str]]:
    """What stands between backticks on a line, outside of blocks, with its line."""
    inside, found = False, []
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        if FENCE.match(line):
            inside = not inside
        elif not inside and not line.startswith("    "):
            found += [(number, words) for words in re.findall(r"(?<!`)`([^`]+)`(?!`)", line)]
    return found
