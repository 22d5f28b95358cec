# SPDX-License-Identifier: GPL-3.0-or-later
"""Text files of a run's folder: read only if they are regular, and no further than they are long."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from ._errors import Error

_MIB = 1 << 20
_MOST = 1024 * _MIB  # a history.csv of a million states has some 100 MB


def read_text(path: Path) -> str:
    """UTF-8. Raises FileNotFoundError, and Error for what is no such file: a pipe, a device, a folder,
    one of more than 1 GiB."""
    try:
        opened = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC)
        with open(opened, "rb") as file:
            status = os.fstat(opened)
            if not stat.S_ISREG(status.st_mode) or status.st_size > _MOST:
                raise Error(f"{path}: is no regular file of at most {_MOST // _MIB} MiB")
            return file.read(status.st_size).decode("utf-8")
    except FileNotFoundError:
        raise
    except (OSError, UnicodeDecodeError) as problem:
        raise Error(f"{path}: {problem}") from problem
