# SPDX-License-Identifier: GPL-3.0-or-later
"""Reports of runs for the page: made by tools/report, each one file in .plyform/reports that is called
after what it was made of, so that one whose runs have not changed is there already.

They are shown in a frame that can run their scripts and do nothing else: sandboxed without an origin,
by the page and by this header, with the policy of the report itself."""

import hashlib
import os
import re
import sys
from pathlib import Path

from fastapi.responses import FileResponse

from base.ending import TOOLS, one_line
from reporting.page import LETTERS

from ..processes.records import LIVE
from ..project.project import Refused
from ..runs.listing import mark_of
from ..studio import Studio
from .listing import FILES, check_links

KEY = re.compile(r"[0-9a-f]{32}")
MOST_KEPT = 12  # of up to some 30 MB each; the longest unused go
HEADERS = {"Content-Security-Policy":
           "sandbox allow-scripts allow-modals; default-src 'none'; script-src 'unsafe-inline' data:; "
           "style-src 'unsafe-inline'; img-src data: blob:; connect-src 'none'; base-uri 'none'; "
           "form-action 'none'; frame-ancestors 'self'"}


class ReportPages:
    def __init__(self, studio: Studio):
        self.studio = studio
        self.folder = studio.project.own / "reports"
        self.folder.mkdir(exist_ok=True)

    def asked(self, names: list[str]) -> dict:
        """{key, ready, process}: begins to make it if it is not there. Raises Refused."""
        folders = self.folders_of(names)
        key = self.key_of(folders)
        page = self.folder / f"{key}.html"
        if page.is_file():
            os.utime(page)  # used now
            return {"key": key, "ready": True, "process": None}
        for record in self.studio.processes.records("report"):
            if record["about"].get("key") == key and record["state"] in LIVE:
                return {"key": key, "ready": False, "process": record}
        self.forget_old()
        command = [sys.executable, str(TOOLS / "report"), *map(str, folders), "-o", str(page)]
        record = self.studio.processes.begin("report", "report of " + ", ".join(names), command,
                                             self.studio.project.root, {"key": key, "folders": names})
        return {"key": key, "ready": False, "process": record}

    def folders_of(self, names: list[str]) -> list[Path]:
        if not isinstance(names, list) or not all(isinstance(name, str) for name in names) \
                or not 1 <= len(names) <= len(LETTERS):
            raise Refused(f"a report is of one run, or of up to {len(LETTERS)}", 422)
        folders = [self.studio.project.existing(name) for name in names]
        for name, folder in zip(names, folders):
            check_links(self.studio.project, folder)
            if not mark_of(folder, FILES)[0]:
                raise Refused(f"{one_line(name, 200)} has no state yet: its results.h5 is missing", 409)
        return folders

    def key_of(self, folders: list[Path]) -> str:
        """Another one when a run has written more, or this program is another one."""
        made_by = [path.stat().st_mtime_ns for path in sorted((TOOLS / "reporting").rglob("*"))
                   if path.suffix in (".py", ".js", ".html", ".css")]
        parts = [made_by, *((os.fsencode(folder), mark_of(folder, FILES)) for folder in folders)]
        return hashlib.sha256(repr(parts).encode()).hexdigest()[:32]

    def forget_old(self) -> None:
        pages = sorted(self.folder.glob("*.html"), key=lambda page: page.stat().st_mtime)
        for page in pages[:max(0, len(pages) - MOST_KEPT + 1)]:
            page.unlink(missing_ok=True)

    def page(self, key: str) -> FileResponse:
        """Raises Refused."""
        path = self.folder / f"{key}.html"
        if not KEY.fullmatch(key) or path.is_symlink() or not path.is_file():
            raise Refused("there is no such report: ask for it again", 404)
        return FileResponse(path, media_type="text/html; charset=utf-8", headers=HEADERS)


def why_failed(log: str) -> str:
    """The last line of a program that says what is wrong."""
    lines = [line for line in log.splitlines() if "error: " in line]
    return one_line(lines[-1]) if lines else "it ended without a word"


