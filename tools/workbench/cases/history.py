# SPDX-License-Identifier: GPL-3.0-or-later
"""Earlier and later texts of a file, for undo and redo: in .plyform/history, so that a workbench that is
started again still has them. What another program has written is a step as well."""

import hashlib
import json
from pathlib import Path

from ..processes.launch import keep
from ..server.project import Project

MOST_STEPS = 100
MOST_BYTES = 8 << 20


class History:
    def __init__(self, project: Project):
        self.project = project
        self.folder = project.own / "history"
        self.folder.mkdir(exist_ok=True)

    def place(self, path: Path) -> Path:
        name = hashlib.sha256(str(path.relative_to(self.project.root)).encode("utf-8", "surrogateescape"))
        return self.folder / f"{name.hexdigest()[:32]}.json"

    def load(self, path: Path, text: str) -> dict:
        """{texts, at}, with the text that the file has now at `at`."""
        try:
            record = json.loads(self.place(path).read_text(encoding="utf-8"))
            texts, at = record["texts"], record["at"]
            now = texts[at]
        except (OSError, ValueError, KeyError, IndexError, TypeError):
            return {"texts": [text], "at": 0}
        return record if now == text else self.stepped(record, text)

    def stepped(self, record: dict, text: str) -> dict:
        texts = [*record["texts"][:record["at"] + 1], text][-MOST_STEPS:]
        while len(texts) > 2 and sum(map(len, texts)) > MOST_BYTES:
            texts.pop(0)
        return {"texts": texts, "at": len(texts) - 1}

    def changed(self, path: Path, before: str, after: str) -> None:
        keep(self.place(path), self.stepped(self.load(path, before), after))

    def other(self, path: Path, text: str, step: int) -> str | None:
        """The text before (-1) or after (1) this one; None if there is none."""
        record = self.load(path, text)
        at = record["at"] + step
        return record["texts"][at] if 0 <= at < len(record["texts"]) else None

    def went(self, path: Path, text: str, step: int) -> None:
        record = self.load(path, text)
        keep(self.place(path), {**record, "at": record["at"] + step})
