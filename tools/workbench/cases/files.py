# SPDX-License-Identifier: GPL-3.0-or-later
"""Case and fabric files as the page reads and writes them: the file is all there is, and every change of it
is told to all pages. A change comes with what it was made upon: of a file that is another one now it changes
what nobody else has changed (merge, toml/rebase), or nothing, and the page asks."""

import hashlib
import math
import re
import threading
from collections.abc import Callable
from pathlib import Path

from base.files import toml_of

from ..project.events import Events
from ..project.project import Changed, Project, Refused
from ..toml import edits as toml_edits, rebase as toml_rebase
from ..toml.model import Refers
from .history import History
from .merge import merged
from .paths import MOST_TEXT

MOST_EDITS = 1000
MOST_TRIES = 5  # of a write, each of which another one comes before


class NoToml(Refused):
    """With a place: what is written is no TOML."""

    def __init__(self, problem: Exception):
        words = str(problem)
        place = re.search(r" \(at line (\d+), column (\d+)\)", words)
        super().__init__(words, 422)
        self.line, self.column = (int(place[1]), int(place[2])) if place else (1, 1)


def version_of(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()[:16]


def parsed(text: str) -> dict:
    """Raises NoToml."""
    try:
        return toml_of(text)
    except (ValueError, RecursionError) as problem:
        raise NoToml(problem if isinstance(problem, ValueError) else
                     ValueError("tables within tables without end")) from problem


def as_json(value):
    """Dates, inf and nan as texts, as JSON has none."""
    if isinstance(value, dict):
        return {key: as_json(part) for key, part in value.items()}
    if isinstance(value, list):
        return [as_json(part) for part in value]
    if isinstance(value, float) and not math.isfinite(value):
        return repr(value)
    return value if isinstance(value, (str, bool, int, float)) else str(value)


def lines(text: str) -> str:
    return text.replace("\r\n", "\n")


def with_ends(text: str, like: str) -> str:
    """With the ends of lines that another text has: an editor of a page knows one kind of them."""
    return lines(text).replace("\n", "\r\n") if "\r\n" in like else text


def checked_text(text, words: str = "a text") -> str:
    if not isinstance(text, str) or not text.isascii() and any("\ud800" <= c <= "\udfff" for c in text):
        raise Refused(f"{words} is wanted, of characters", 422)
    return text


class CaseFiles:
    """`refers` tells which keys name parts of a case, when it is asked."""

    def __init__(self, project: Project, events: Events, refers: Callable[[], Refers]):
        self.project = project
        self.events = events
        self.refers = refers
        self.history = History(project)
        self.lock = threading.RLock()
        self.versions: dict[str, str] = {}  # as told to pages last

    def path(self, name: str) -> Path:
        """Of a TOML file in the folder. Raises Refused."""
        path = self.project.existing(name)
        if path.suffix.lower() != ".toml" or not path.is_file():
            raise Refused("a case or a fabric is a file that ends with .toml", 422)
        return path

    def read(self, path: Path) -> tuple[str, str]:
        """Text and version. Raises Refused."""
        content = self.project.read(path, MOST_TEXT)
        try:
            return content.decode("utf-8-sig"), version_of(content)
        except UnicodeDecodeError as problem:
            raise Refused(f"{self.project.relative(path)} is no text in UTF-8: save it as UTF-8", 422) from problem

    def answer(self, name: str) -> dict:
        with self.lock:
            path = self.path(name)
            text, version = self.read(path)
            record = self.history.load(path, text)
        try:
            tree, error = as_json(parsed(text)), None
        except NoToml as problem:
            tree, error = None, {"line": problem.line, "column": problem.column, "words": str(problem)}
        return {"path": self.project.relative(path), "text": text, "version": version, "tree": tree, "error": error,
                "can_undo": record["at"] > 0, "can_redo": record["at"] + 1 < len(record["texts"])}

    def save(self, path: Path, before: str, after: str) -> None:
        """Over `before`, and nothing else. Raises Changed, Refused, OSError."""
        content = after.encode()
        if len(content) > MOST_TEXT:
            raise Refused(f"a case can have {MOST_TEXT >> 20} MiB", 413)
        there = self.there(path, before)
        self.history.changed(path, before, after)  # first: on a full disk both stay as they are
        self.project.write(path, content, there)
        self.tell(path, version_of(content))

    def there(self, path: Path, text: str) -> bytes:
        """What the file has, which is this text. Raises Changed."""
        content = self.project.read(path, MOST_TEXT)
        if content.decode("utf-8-sig", "replace") != text:
            raise Changed(f"{self.project.relative(path)} has just been written by another page or program",
                          race=True)
        return content

    def tell(self, path: Path, version: str) -> None:
        name = self.project.relative(path)
        self.versions[name] = version
        self.events.send("case", path=name, version=version)

    def patiently(self, act: Callable[[], dict]) -> dict:
        """What has been written between a look and a write is looked at again."""
        for _ in range(MOST_TRIES):
            try:
                return act()
            except Changed as problem:
                if not problem.race:
                    raise
        return act()

    def put(self, name: str, text, version, base=None, over=False) -> dict:
        """The whole text, made from the one of `version`, or from `base`, and the file is another now: `over`
        what is there in the same lines, which has been shown as `version`."""
        return self.patiently(lambda: self.put_once(name, checked_text(text), version, base, over))

    def put_once(self, name: str, text: str, version, base, over: bool) -> dict:
        with self.lock:
            path = self.path(name)
            before, now = self.read(path)
            parsed(text)
            text = with_ends(text, before)
            merging = over or version != now
            if merging:
                known = self.known(base, over and version != now)
                text = with_ends(merged(known, lines(text), lines(before), over), before)
                self.check_merged(text)
            return self.changed(name, path, before, text, merging)

    def edit(self, name: str, edits, version, base=None, over=False) -> dict:
        """Changes of keys, made upon the text of `version`, or upon `base`; `over` as in `put`."""
        if not isinstance(edits, list) or not all(isinstance(edit, dict) for edit in edits) or len(edits) > MOST_EDITS:
            raise Refused(f"edits are a list of {MOST_EDITS} at most", 422)
        return self.patiently(lambda: self.edit_once(name, edits, version, base, over))

    def edit_once(self, name: str, edits: list[dict], version, base, over: bool) -> dict:
        with self.lock:
            path = self.path(name)
            before, now = self.read(path)
            parsed(before)
            merging = over or version != now
            if merging:
                known = self.known(base, over and version != now)
                parsed(known)
                after, made = toml_rebase.edited_upon(known, before, edits, self.refers(), over)
            else:
                after, made = toml_edits.edited(before, edits, self.refers())
            return {**self.changed(name, path, before, after, merging), "made": made}

    @staticmethod
    def known(base, once_more: bool) -> str:
        """The text that a change was made upon. Raises Changed if the page has not sent it, or was asked about
        a text that is another one by now."""
        if base is None or once_more:
            raise Changed("the file has been changed meanwhile by another page or program")
        return lines(checked_text(base, "the text before"))

    @staticmethod
    def check_merged(text: str) -> None:
        try:
            parsed(text)
        except NoToml as problem:
            raise Changed(f"with what another page or program has changed meanwhile, it is no TOML: {problem}") \
                from problem

    def changed(self, name: str, path: Path, before: str, after: str, merging: bool) -> dict:
        if after != before:
            self.save(path, before, after)
        return {**self.answer(name), **({"before": before} if merging else {})}

    def step(self, name: str, step: int, version, wanted=None) -> dict:
        """To the text before or after this one; `wanted`: its version, if it has to be that."""
        with self.lock:
            path = self.path(name)
            text, now = self.read(path)
            if version != now:
                raise Changed("the file has been changed meanwhile by another page or program")
            other = self.history.other(path, text, step)
            if other is None:
                raise Refused("there is nothing to take back" if step < 0 else "there is nothing to do again", 409)
            if wanted is not None and version_of(other.encode()) != wanted:
                raise Changed("the file has been changed meanwhile by another page or program")
            there = self.there(path, text)
            self.history.went(path, text, step)
            self.project.write(path, other.encode(), there)
            self.tell(path, version_of(other.encode()))
            return self.answer(name)
