# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that appear under their names only when they are whole."""

import os
from collections.abc import Callable
from pathlib import Path

from base.names import place_in
from base.outputs import check_kind, check_output, note_written


def write_whole(path: Path, text: str, rewrite: bool = False) -> Path:
    """What is no character, as in a name that is no text, is written as ?. `rewrite`: the text was read
    from there. Raises Mistake, as make_whole."""
    return make_whole(path, lambda part: part.write_bytes(text.encode("utf-8", "replace")), rewrite)


def make_whole(path: Path, write: Callable[[Path], None], rewrite: bool = False) -> Path:
    """For files that a library writes, which goes by their ending. Raises Mistake for a file that is read
    or of somebody else."""
    check_output(path, rewrite)
    part = path.with_name("part_" + path.name)
    check_output(part)
    try:
        write(part)
        if not rewrite:
            check_kind(path, part)
        os.replace(part, path)
    except BaseException:
        part.unlink(missing_ok=True)
        raise
    note_written(path)
    return path


def write_in(folder: Path, name: str, text: str) -> Path:
    """A file whose name was made of names from other files. Raises Trouble."""
    return write_whole(place_in(folder, name), text)


def make_in(folder: Path, name: str, write: Callable[[Path], None]) -> Path:
    """The same for make_whole. Raises Trouble."""
    return make_whole(place_in(folder, name), write)
