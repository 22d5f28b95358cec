# SPDX-License-Identifier: GPL-3.0-or-later
"""A file comes to the place of another if that is still what it was, whoever else writes meanwhile."""

import ctypes
import errno
import os

EXCHANGE = 2  # RENAME_EXCHANGE, linux/fs.h
CANNOT = (errno.ENOSYS, errno.EINVAL, errno.EOPNOTSUPP)  # FAT, some shares
LIBC = ctypes.CDLL(None, use_errno=True)


def swapped(folder: int, part: str, name: str, expected: bytes) -> bool:
    """Whether `name` held `expected` and is now what `part` was, in this open folder. If not, `name` is
    what the other has written. Raises OSError."""
    if not exchanged(folder, part, name):
        if content(folder, name) != expected:  # a moment is left in which another can write
            return False
        os.replace(part, name, src_dir_fd=folder, dst_dir_fd=folder)
        return True
    own = identity(folder, name)
    if content(folder, part) == expected:
        os.unlink(part, dir_fd=folder)
        return True
    exchanged(folder, part, name)
    if identity(folder, part) != own:  # written once more in between: the last one holds
        exchanged(folder, part, name)
    return False


def exchanged(folder: int, one: str, other: str) -> bool:
    """Both change places at once; False where the system or the disk cannot do that. Raises OSError."""
    if not hasattr(LIBC, "renameat2"):
        return False
    if LIBC.renameat2(folder, os.fsencode(one), folder, os.fsencode(other), EXCHANGE) == 0:
        return True
    code = ctypes.get_errno()
    if code in CANNOT:
        return False
    raise OSError(code, os.strerror(code), other)


def content(folder: int, name: str) -> bytes | None:
    """None of a link, a folder, or what may not be read. Raises FileNotFoundError."""
    flags = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC
    try:
        with open(os.open(name, flags, dir_fd=folder), "rb") as file:
            return file.read()
    except FileNotFoundError:
        raise
    except OSError:
        return None


def identity(folder: int, name: str) -> tuple[int, int]:
    status = os.stat(name, dir_fd=folder, follow_symlinks=False)
    return status.st_dev, status.st_ino
