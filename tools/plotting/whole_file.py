# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that appear under their names only when they are whole."""

import os
from collections.abc import Callable
from pathlib import Path


def write_whole(path: Path, text: str) -> Path:
    part = path.with_name(path.name + ".part")
    part.write_text(text, encoding="utf-8")
    os.replace(part, path)
    return path


def make_whole(path: Path, write: Callable[[Path], None]) -> Path:
    """The same for files that a library writes, which goes by their ending."""
    part = path.with_name("part_" + path.name)
    write(part)
    os.replace(part, path)
    return path
