# SPDX-License-Identifier: GPL-3.0-or-later
"""Earlier and later texts of a file, for undo and redo: in .plyform/history, so that a workbench that is
started again still has them. What another program has written is a step as well."""

import hashlib
from pathlib import Path

from base.ending import Trouble
from base.files import read_json

from ..processes.launch import keep
from ..project.project import Project

MOST_STEPS = 100
MOST_BYTES = 8 << 20
MOST_FILE = 64 << 20  # bytes, as JSON writes them out


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
            record = read_json(self.place(path), MOST_FILE)
            texts, at = record["texts"], record["at"]
            if not all(isinstance(one, str) for one in texts) or type(at) is not int or not 0 <= at < len(texts):
                raise ValueError("damaged")
        except (Trouble, ValueError, KeyError, TypeError):
            return {"texts": [text], "at": 0}
        record = {"texts": texts, "at": at}
        return record if texts[at] == text else self.stepped(record, text)

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
