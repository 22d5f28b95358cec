# SPDX-License-Identifier: GPL-3.0-or-later
"""One workbench a folder: a second one says where the first is."""

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager

from .project import Project


@contextmanager
def only_one(project: Project) -> Iterator[str]:
    """Holds the folder, and yields "" or, if another holds it, the address of that one."""
    opened = os.open(project.own / "lock", os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC, 0o600)
    with os.fdopen(opened, "r+") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            yield file.read(500).strip() or "another plyform studio"
            return
        yield ""


def keep_address(project: Project, address: str) -> None:
    """For who asks next; only this user can read it."""
    with open(project.own / "lock", "r+", encoding="utf-8") as file:
        file.truncate()
        file.write(address + "\n")
