# SPDX-License-Identifier: GPL-3.0-or-later
"""One workbench a folder: a second one says where the first is."""

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager

from base.ending import Trouble

from ..project.project import Project


@contextmanager
def only_one(project: Project) -> Iterator[str]:
    """Holds the folder, and yields "" or, if another holds it, the address of that one. Raises Trouble."""
    path = project.own / "lock"
    try:
        opened = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC, 0o600)
    except PermissionError as problem:
        raise Trouble(f"{path} belongs to another user, who has this folder open or had: remove it") from problem
    with os.fdopen(opened, "r+") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            yield file.read(500).strip() or "another plyform studio"
            return
        if os.fstat(opened).st_uid != os.getuid():
            raise Trouble(f"{path} belongs to another user, who could read the address: remove it")
        os.fchmod(opened, 0o600)  # it may have come with the folder
        file.truncate(0)          # the address of one that has been killed
        yield ""


def keep_address(project: Project, address: str) -> None:
    """For who asks next; only this user can read it."""
    with open(project.own / "lock", "r+", encoding="utf-8") as file:
        file.truncate()
        file.write(address + "\n")
