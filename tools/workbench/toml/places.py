# SPDX-License-Identifier: GPL-3.0-or-later
"""Where in the text of a TOML file its tables, keys and values stand, so that one of them can be changed
and every other byte stays: comments, order, the manner of writing. Of texts that tomllib has read.

A path is a tuple of keys and, within lists, numbers: ("tool", 1, "stroke").
"""

import re
import tomllib
from dataclasses import dataclass, field

BARE = re.compile(r"[A-Za-z0-9_-]+")
TEXTS = [re.compile(pattern, re.DOTALL) for pattern in (
    r'"""(?:[^"\\]|\\.|"{1,2}(?!"))*"{3,5}', r"'''(?:[^']|'{1,2}(?!'))*'{3,5}",
    r'"(?:[^"\\]|\\.)*"', r"'[^']*'")]
WORD = re.compile(r"\d{4}-\d\d-\d\d \d\d:[^\s,\]}#]*|[^\s,\]}#]+")  # a number, a date, true
SPACE, BLANK = re.compile(r"[ \t]*"), re.compile(r"(?:[ \t\r\n]+|#[^\n]*)*")
COMMENT = re.compile(r"[ \t]*#[^\n]*\n?")


@dataclass
class Word:
    """One key of a dotted one."""
    start: int
    end: int
    depth: int  # length of the path up to it


@dataclass
class Value:
    path: tuple
    start: int
    end: int
    kind: str  # value, list, table (in braces)
    words: list[Word] = field(default_factory=list)  # of its key; none of an item
    line_end: int = -1  # behind its line, of a key in a table with a header


@dataclass
class Block:
    """A table with a header, or what stands before the first one."""
    path: tuple
    start: int    # of the header
    body: int     # behind its line
    words: list[Word]
    item: bool = False
    lead: int = 0  # start of the comment directly above
    end: int = 0   # behind the last key, its comments and empty lines; what follows is of no table


class Places:
    def __init__(self, text: str):
        self.text, self.at = text, 0
        self.values: dict[tuple, Value] = {}
        self.counts: dict[tuple, int] = {}
        self.blocks = [Block((), 0, 0, [])]
        while self.skip(BLANK) < len(text):
            if text[self.at] == "[":
                self.header()
            else:
                value = self.keyed(self.blocks[-1].path)
                value.line_end = self.to_next_line()
        for number, block in enumerate(self.blocks):
            self.borders(block, self.blocks[number + 1] if number + 1 < len(self.blocks) else None)

    def skip(self, pattern: re.Pattern) -> int:
        self.at = pattern.match(self.text, self.at).end()
        return self.at

    def to_next_line(self) -> int:
        end = self.text.find("\n", self.at)
        self.at = len(self.text) if end < 0 else end + 1
        return self.at

    def key(self, depth: int) -> tuple[list[str], list[Word]]:
        """A dotted one; depth: length of the path that it stands in."""
        keys, words = [], []
        while True:
            start = self.skip(SPACE)
            patterns = [BARE] if self.text[start] not in "\"'" else TEXTS[2:]
            end = next(match.end() for pattern in patterns if (match := pattern.match(self.text, start)))
            raw = self.text[start:end]
            keys.append(raw if raw[0] not in "\"'" else tomllib.loads(f"k = {raw}")["k"])
            depth += 1
            words.append(Word(start, end, depth))
            self.at = end
            if self.text[self.skip(SPACE)] != ".":
                return keys, words
            self.at += 1

    def header(self) -> None:
        start, item = self.at, self.text.startswith("[[", self.at)
        self.at += 2 if item else 1
        keys, words = self.key(0)
        path: tuple = ()
        for number, (key, word) in enumerate(zip(keys, words)):
            path += (key,)
            word.depth = len(path)
            if item and number == len(keys) - 1:
                self.counts[path] = self.counts.get(path, 0) + 1
            if path in self.counts:
                path += (self.counts[path] - 1,)
        self.blocks.append(Block(path, start, self.to_next_line(), words, item))

    def keyed(self, base: tuple) -> Value:
        keys, words = self.key(len(base))
        self.at += 1  # =
        self.skip(SPACE)
        value = self.value((*base, *keys))
        value.words = words
        return value

    def value(self, path: tuple) -> Value:
        start, first = self.at, self.text[self.at]
        value = self.values[path] = Value(path, start, start, {"[": "list", "{": "table"}.get(first, "value"))
        if value.kind == "value":
            patterns = TEXTS if first in "\"'" else [WORD]
            self.at = next(match.end() for pattern in patterns if (match := pattern.match(self.text, start)))
        else:
            self.at += 1
            self.inside(value)
        value.end = self.at
        return value

    def inside(self, value: Value) -> None:
        number = 0
        while self.text[self.skip(BLANK)] not in "]}":
            if value.kind == "list":
                self.value((*value.path, number))
            else:
                self.keyed(value.path)
            number += 1
            if self.text[self.skip(BLANK)] == ",":
                self.at += 1
        self.at += 1

    def borders(self, block: Block, following: Block | None) -> None:
        block.lead = self.lead(block.start)
        limit = self.lead(following.start) if following else len(self.text)
        lines = [value.line_end for value in self.entries(block)]
        end = max(lines, default=block.body)
        while end < limit and (comment := COMMENT.match(self.text, end)):
            end = comment.end()
        while end < limit and self.text[end:limit].startswith(("\n", "\r\n")):
            end = self.text.index("\n", end) + 1
        block.end = min(end, max(limit, block.body))

    def lead(self, start: int) -> int:
        """Of the comment lines directly above; those at the very begin are the file's."""
        at = start
        while at and (line := self.text.rfind("\n", 0, at - 1) + 1) < at and COMMENT.match(self.text, line):
            at = line
        return at if at else start

    def entries(self, block: Block) -> list[Value]:
        """Keys that stand in a block, not in braces."""
        number = self.blocks.index(block)
        end = self.blocks[number + 1].start if number + 1 < len(self.blocks) else len(self.text)
        return [value for value in self.lines() if block.body <= value.start < end]

    def lines(self) -> list[Value]:
        return [value for value in self.values.values() if value.line_end >= 0]

    def below(self, path: tuple) -> list[Block]:
        """A table's block and those of what is in it."""
        return [block for block in self.blocks if block.words and block.path[:len(path)] == path]

    def region(self, path: tuple) -> tuple[int, int] | None:
        """From the comment above a table to the end of what is in it; None without a header."""
        blocks = self.below(path)
        return (blocks[0].lead, blocks[-1].end) if blocks else None
