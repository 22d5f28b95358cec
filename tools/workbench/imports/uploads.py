# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that are dropped into the page: written as they come into a part of their own, which gets its name
when it is whole, and never that of another file unless the page names the one that it is to replace: by the
stamp that it was told when that was in the way."""

import os
import shutil
from pathlib import Path

from ..cases.folder import KINDS
from ..project.project import Changed, Project, Refused, named, plain_name
from ..project.swap import exchanged

SPARE = 64 << 20  # bytes that stay free on the disk


class Upload:
    def __init__(self, project: Project, folder: str, name: str, size: int, replace: str):
        self.project, self.replace = project, replace
        if Path(plain_name(name)).suffix.lower() not in KINDS:
            raise Refused(f"{name}: a file that ends with {', '.join(sorted(KINDS))} can be taken in; save a "
                          "spreadsheet as CSV", 422)
        self.parts = project.own / "uploads"
        self.parts.mkdir(exist_ok=True)
        self.folder = project.inside(folder) if folder else project.root
        self.path = self.folder / name
        self.check_place()
        if size > shutil.disk_usage(project.root).free - SPARE:
            raise Refused(f"{name} has {size >> 20} MiB, more than is free on this disk", 507)
        self.part = self.parts / os.urandom(8).hex()
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC
        self.file = os.fdopen(os.open(self.part, flags, 0o666), "wb")

    def check_place(self) -> None:
        name = self.path.name
        if self.path.is_symlink() or self.path.is_dir():
            raise Refused(f"{name} is a link or a folder there", 409)
        if self.path.exists() and stamp_of(self.path) != self.replace:
            raise self.taken()

    def taken(self) -> Changed:
        words = "has been written meanwhile" if self.replace else "is there already"
        return Changed(f"{self.path.name} {words}: give yours another name, or replace it",
                       [{"what": self.path.name, "now": stamp_of(self.path), "wanted": ""}])

    def write(self, piece: bytes) -> None:
        self.file.write(piece)

    def finish(self) -> dict:
        self.file.close()
        self.folder.mkdir(parents=True, exist_ok=True)
        folder = os.open(self.folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC)
        try:
            if not self.project.holds(folder):
                raise Refused("this folder is a link out of that of the workbench")
            self.check_place()
            if self.path.exists():
                self.replaced(folder)
            elif not named(folder, str(self.part), self.path.name):  # come between
                raise self.taken()
        finally:
            os.close(folder)
        return {"path": self.project.relative(self.path), "kind": KINDS[self.path.suffix.lower()],
                "size": self.path.stat().st_size}

    def replaced(self, folder: int) -> None:
        if not exchanged(folder, str(self.part), self.path.name):
            os.replace(self.part, self.path.name, dst_dir_fd=folder)
        elif stamp_of(self.part) != self.replace:  # written in between: that goes back
            exchanged(folder, str(self.part), self.path.name)
            raise self.taken()

    def end(self) -> None:
        """Whatever has happened."""
        self.file.close()
        self.part.unlink(missing_ok=True)


def stamp_of(path: Path) -> str:
    """Another one when the file is; "" if there is none."""
    try:
        status = os.stat(path)
    except OSError:
        return ""
    return f"{status.st_mtime_ns}-{status.st_size}-{status.st_ino}"


def clear(project: Project) -> None:
    """Parts of a workbench that was killed."""
    shutil.rmtree(project.own / "uploads", ignore_errors=True)


def length_of(headers) -> int:
    told = headers.get("content-length", "0")
    if not told.isdigit():
        raise Refused("Content-Length is no number", 400)
    return int(told)
