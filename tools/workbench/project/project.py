# SPDX-License-Identifier: GPL-3.0-or-later
"""The folder that a workbench works in. Whatever the page asks for lies in it, links followed."""

import errno
import os
import re
import stat
from dataclasses import dataclass
from pathlib import Path

from base.ending import Trouble, one_line

from .swap import swapped

NO_LINKS = (errno.EPERM, errno.EOPNOTSUPP, errno.ENOSYS, errno.EMLINK)  # FAT, some shares
OWN = ".plyform"  # folder of the workbench: its lock, records of runs and jobs, logs
NAME = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.\-]{0,79}")  # of a case, a run, a file that is dropped in


class Refused(Trouble):
    """What a page may not do; `code` is that of HTTP."""

    def __init__(self, words: str, code: int = 403):
        super().__init__(words)
        self.code = code


class Changed(Refused):
    """What a page has changed is not any more as the page was shown it. `clashes`: {what, now, wanted} of
    each thing that both have changed; `race`: it was written just now, and tried again it may do."""

    def __init__(self, words: str, clashes: list[dict] | None = None, race: bool = False):
        super().__init__(words, 409)
        self.clashes = clashes or []
        self.race = race


@dataclass(frozen=True)
class Project:
    root: Path  # absolute, without links

    @staticmethod
    def opened(folder: Path) -> "Project":
        """Raises Trouble."""
        try:
            folder.mkdir(parents=True, exist_ok=True)
            root = folder.resolve(strict=True)
            (root / OWN).mkdir(exist_ok=True)
        except OSError as problem:
            raise Trouble(f"{folder} cannot be used: {problem.strerror}; give a folder that can be "
                          "written to") from problem
        check_links(root / OWN)
        return Project(root)

    @property
    def own(self) -> Path:
        return self.root / OWN

    def inside(self, name: str) -> Path:
        """The path of a name as a page gives it: relative to the folder, and in it when all links
        are followed. It need not exist. Raises Refused."""
        if not name:
            raise Refused("no file is chosen", 422)
        if "\0" in name or "\\" in name or name.startswith("/"):
            raise Refused(f"{one_line(name, 200)!r} is no name of a file in this folder")
        if ".." in name.split("/"):
            raise Refused(f"{one_line(name, 200)} leads out of the folder")
        try:
            path = Path(os.path.realpath(self.root / name))
        except (OSError, ValueError) as problem:
            raise Refused(f"{one_line(name, 200)} is no name of a file") from problem
        if not path.is_relative_to(self.root):
            raise Refused(f"{one_line(name, 200)} is a link out of the folder")
        if path.is_relative_to(self.own):
            raise Refused(f"{one_line(name, 200)} is the workbench's own")
        return path

    def existing(self, name: str) -> Path:
        """A regular file, or a folder. Raises Refused."""
        path = self.inside(name)
        try:
            mode = path.stat().st_mode
        except OSError as problem:
            raise Refused(f"{one_line(name, 200)} is missing", 404) from problem
        if not stat.S_ISREG(mode) and not stat.S_ISDIR(mode):
            raise Refused(f"{one_line(name, 200)} is no file")
        return path

    def relative(self, path: Path) -> str:
        """As the page names it: with / whatever the system, bytes that are no text written out."""
        return one_line(path.relative_to(self.root).as_posix())

    def read(self, path: Path, most: int) -> bytes:
        """Of a path without links, as `existing` gives it; one that has become a link or moved outside
        since is refused. Raises Refused, OSError."""
        try:
            opened = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC)
        except FileNotFoundError as problem:
            raise Refused(f"{self.relative(path)} is missing", 404) from problem
        except OSError as problem:
            if problem.errno != errno.ELOOP:
                raise
            raise Refused(f"{self.relative(path)} has become a link") from problem
        with open(opened, "rb") as file:
            status = os.fstat(opened)
            if not self.holds(opened) or not stat.S_ISREG(status.st_mode):
                raise Refused(f"{one_line(path)} leads out of the folder")
            if status.st_size > most:
                raise Refused(f"{self.relative(path)} has {status.st_size >> 20} MiB, more than the "
                              f"{most >> 20} that are read of such a file", 413)
            return file.read(most)

    def holds(self, opened: int) -> bool:
        """Whether an open file or folder lies in this one, wherever a link may lead now."""
        return Path(os.readlink(f"/proc/self/fd/{opened}")).is_relative_to(self.root)

    def write(self, path: Path, content: bytes, expected: bytes | None) -> None:
        """Whole or not at all, and never through a link: over what is `expected` there, else only where
        nothing is. Raises Changed, Refused, OSError."""
        folder = os.open(path.parent, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC)
        try:
            if not self.holds(folder) or path.is_symlink():
                raise Refused(f"{one_line(path)} leads out of the folder")
            mode = stat.S_IMODE(path.stat().st_mode) if path.exists() else None
            if not self.write_in(folder, path.name, content, mode, expected):
                raise Changed(f"{self.relative(path)} has just been written by another page or program", race=True)
        except FileNotFoundError as problem:
            raise Changed(f"{self.relative(path)} has just been removed") from problem
        finally:
            os.close(folder)

    @staticmethod
    def write_in(folder: int, name: str, content: bytes, mode: int | None, expected: bytes | None) -> bool:
        part = f".part_{os.urandom(6).hex()}"
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC
        try:
            with open(os.open(part, flags, 0o666, dir_fd=folder), "wb") as file:
                file.write(content)
                if mode is not None:
                    os.fchmod(file.fileno(), mode)
            return swapped(folder, part, name, expected) if expected is not None else named(folder, part, name)
        finally:
            try:
                os.unlink(part, dir_fd=folder)
            except OSError:
                pass  # it has its name


def named(folder: int, part: str, name: str) -> bool:
    """Gives a part its name, if nothing has it. Raises OSError."""
    try:
        try:
            os.link(part, name, src_dir_fd=folder, dst_dir_fd=folder)
        except OSError as problem:
            if problem.errno not in NO_LINKS:
                raise
            flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC
            os.close(os.open(name, flags, dir_fd=folder))
            os.replace(part, name, src_dir_fd=folder, dst_dir_fd=folder)
    except FileExistsError:
        return False
    return True


def check_links(own: Path) -> None:
    """Whatever is written there is written there: a folder that somebody else has sent could let logs go
    into any file. Raises Trouble."""
    found = [own] if own.is_symlink() else []
    for folder, names, files in os.walk(own):
        found += [path for name in (*names, *files) if (path := Path(folder) / name).is_symlink()]
    if found:
        raise Trouble(f"{one_line(found[0])} is a link, which plyform studio makes none of: remove it")


def plain_name(name: str) -> str:
    """A name that is safe in a path, a command and a page. Raises Refused."""
    if not name:
        raise Refused("give a name", 422)
    if not NAME.fullmatch(name):
        raise Refused(f"{one_line(name, 100)!r}: take letters, digits, _, - and . for a name, 80 at most", 422)
    return name
