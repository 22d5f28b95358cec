# SPDX-License-Identifier: GPL-3.0-or-later
"""What the folder's runs have come to: figures of each and the case that it says it had, read once
and again when its files have changed."""

import threading
from dataclasses import asdict
from pathlib import Path

from base.ending import Trouble, one_line
from base.summary_file import read_summary

from ..project.project import Project, Refused
from ..runs.listing import folders_of_results, mark_of
from .figures import figures_of, key_figures

FILES = ("results.h5", "summary.json", "history.csv")  # that a report is made of


def check_links(project: Project, folder: Path) -> None:
    """What a run writes are files of its own: a link may lead anywhere. Raises Refused."""
    inner = [folder / name for name in (*FILES, "states", "plies")]
    if (folder / "states").is_dir():
        inner += (folder / "states").iterdir()
    for path in inner:
        if path.is_symlink():
            raise Refused(f"{project.relative(path)} is a link: a run's results are files of its own")


class ResultList:
    def __init__(self, project: Project):
        self.project = project
        self.lock = threading.Lock()
        self.found: dict[str, tuple] = {}  # by folder: its mark, what it came to

    def every(self) -> list[dict]:
        """The newest first."""
        with self.lock:
            names = list(folders_of_results(self.project))
            self.found = {name: self.current(name) for name in names}
            return sorted((one for _, one in self.found.values() if one), key=lambda one: -one["date"])

    def one(self, name: str) -> dict:
        """Raises Refused."""
        folder = self.project.existing(name)
        return self.read(self.project.relative(folder), folder, mark_of(folder, FILES))

    def current(self, name: str) -> tuple:
        folder = self.project.root / name
        mark = mark_of(folder, FILES)
        known = self.found.get(name)
        return known if known and known[0] == mark else (mark, self.read(name, folder, mark))

    def read(self, name: str, folder: Path, mark: tuple) -> dict | None:
        """None of what has written no state yet."""
        if not any(mark[:2]):
            return None
        run = {"folder": name, "title": name, "status": "unfinished", "message": "", "figures": [],
               "key_figures": [], "case": {}, "has_states": bool(mark[0]),
               "date": max(one[0] for one in mark if one) / 1e9}
        if not mark[1]:
            return run
        try:
            check_links(self.project, folder)
            summary = read_summary(folder)
        except Trouble as problem:
            return {**run, "status": "damaged", "message": one_line(problem)}
        return {**run, "title": one_line(summary.get("title") or name), "status": summary["status"],
                "message": one_line(summary.get("message", "")), "case": summary.get("case", {}),
                "figures": [asdict(figure) for figure in figures_of(summary)],
                "key_figures": [asdict(figure) for figure in key_figures(summary)]}
