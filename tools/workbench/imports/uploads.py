# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that are dropped into the page: written as they come into a part of their own, which gets its name
when it is whole, and never that of another file unless that is asked for."""

import errno
import os
import shutil
from pathlib import Path

from ..cases.folder import KINDS
from ..server.guard import Refusal
from ..server.project import Project, Refused, plain_name

NO_LINKS = (errno.EPERM, errno.EOPNOTSUPP, errno.ENOSYS, errno.EMLINK)  # FAT, some shares
SPARE = 64 << 20  # bytes that stay free on the disk


class Upload:
    def __init__(self, project: Project, folder: str, name: str, size: int, replace: bool):
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
        if self.path.exists() and not self.replace:
            raise Refused(f"there is a {name} already: give it another name, or replace it", 409)

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
            if self.replace:
                os.replace(self.part, self.path.name, dst_dir_fd=folder)
            else:
                self.named(folder)
        finally:
            os.close(folder)
        return {"path": self.project.relative(self.path), "kind": KINDS[self.path.suffix.lower()],
                "size": self.path.stat().st_size}

    def named(self, folder: int) -> None:
        try:
            try:
                os.link(self.part, self.path.name, dst_dir_fd=folder)
            except OSError as problem:
                if problem.errno not in NO_LINKS:
                    raise
                flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC
                os.close(os.open(self.path.name, flags, dir_fd=folder))
                os.replace(self.part, self.path.name, dst_dir_fd=folder)
        except FileExistsError as problem:  # come between
            raise Refused(f"there is a {self.path.name} already: give it another name, or replace it", 409) from problem

    def end(self) -> None:
        """Whatever has happened."""
        self.file.close()
        self.part.unlink(missing_ok=True)


def clear(project: Project) -> None:
    """Parts of a workbench that was killed."""
    shutil.rmtree(project.own / "uploads", ignore_errors=True)


def length_of(headers) -> int:
    told = headers.get("content-length", "0")
    if not told.isdigit():
        raise Refusal(400, "Content-Length is no number")
    return int(told)
