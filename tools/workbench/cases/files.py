# SPDX-License-Identifier: GPL-3.0-or-later
"""Case and fabric files as the page reads and writes them: the file is all there is, and every change of it
is told to all pages."""

import hashlib
import math
import re
import threading
from pathlib import Path

from base.files import toml_of

from ..server.events import Events
from ..server.project import Project, Refused
from ..toml import edits as toml_edits
from .history import History
from .paths import MOST_TEXT

MOST_EDITS = 1000


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


class CaseFiles:
    def __init__(self, project: Project, events: Events):
        self.project = project
        self.events = events
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

    def current(self, name: str, version) -> tuple[Path, str]:
        """Raises Refused with 409 if the file is not of this version."""
        path = self.path(name)
        text, now = self.read(path)
        if version != now:
            raise Refused("the file has changed meanwhile: here it is anew", 409)
        return path, text

    def save(self, path: Path, before: str, after: str) -> None:
        content = after.encode()
        if len(content) > MOST_TEXT:
            raise Refused(f"a case can have {MOST_TEXT >> 20} MiB", 413)
        self.history.changed(path, before, after)  # first: on a full disk both stay as they are
        self.project.write(path, content)
        self.tell(path, version_of(content))

    def tell(self, path: Path, version: str) -> None:
        name = self.project.relative(path)
        self.versions[name] = version
        self.events.send("case", path=name, version=version)

    def put(self, name: str, text, version) -> dict:
        if not isinstance(text, str) or not text.isascii() and any("\ud800" <= c <= "\udfff" for c in text):
            raise Refused("a text is wanted, of characters", 422)
        with self.lock:
            path, before = self.current(name, version)
            parsed(text)
            if text != before:
                self.save(path, before, text)
            return self.answer(name)

    def edit(self, name: str, edits, version) -> dict:
        if not isinstance(edits, list) or not all(isinstance(edit, dict) for edit in edits) or len(edits) > MOST_EDITS:
            raise Refused(f"edits are a list of {MOST_EDITS} at most", 422)
        with self.lock:
            path, before = self.current(name, version)
            parsed(before)
            after, made = toml_edits.edited(before, edits)
            if after != before:
                self.save(path, before, after)
            return {**self.answer(name), "made": made}

    def step(self, name: str, step: int) -> dict:
        with self.lock:
            path = self.path(name)
            text, _ = self.read(path)
            other = self.history.other(path, text, step)
            if other is None:
                raise Refused("there is nothing to take back" if step < 0 else "there is nothing to do again", 409)
            self.history.went(path, text, step)
            self.project.write(path, other.encode())
            self.tell(path, version_of(other.encode()))
            return self.answer(name)
