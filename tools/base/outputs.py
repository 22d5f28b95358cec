# SPDX-License-Identifier: GPL-3.0-or-later
"""What a program may write over: its own outputs of before, never what it reads or what others have
written. Every file that is read is noted (tools/base/files.py), every output asks here
(tools/plotting/whole_file.py): no program has a list of its own. base/outputs.hpp is the C++ of it."""

import os
from pathlib import Path

from base.ending import Mistake

RUN = ("results.h5", "summary.json")  # by which a folder that is read is known as that of a run
OF_RUN = (*RUN, "history.csv", "results.xdmf", "mesh_sizes.txt", "checkpoint")
TOKEN = 8  # bytes by which kinds of files are told apart: <!doctype html>, %PDF-1.4, ply,angle_deg

read: dict[tuple[int, int], Path] = {}  # device and inode of files, which others may have once a file is gone
runs: set[tuple[int, int]] = set()     # of folders
written: set[tuple[int, int]] = set()  # of files that this program has made


def identity(status: os.stat_result) -> tuple[int, int]:
    return status.st_dev, status.st_ino


def found(path: Path) -> os.stat_result | None:
    try:
        return path.stat()
    except (OSError, ValueError):
        return None


def note_read(path: Path, status: os.stat_result) -> None:
    if identity(status) in written:
        return
    read[identity(status)] = path.absolute()
    if path.name in RUN and (folder := found(path.parent)):
        runs.add(identity(folder))


def note_written(path: Path) -> None:
    if status := found(path):
        written.add(identity(status))


def is_read(status: os.stat_result) -> bool:
    """Whether it is of a file that was read, and is there still."""
    there = found(read[identity(status)]) if identity(status) in read else None
    return there is not None and identity(there) == identity(status)


def lost(path: Path, why: str) -> Mistake:
    return Mistake(f"{path}: would overwrite it, and it {why}; give another place with -o")


def check_output(path: Path, rewrite: bool = False) -> None:
    """Before a file is written. `rewrite`: what is read is written again, as a text whose tables are made
    anew. Raises Mistake."""
    status = found(path)
    if status is None:
        return
    if is_read(status) and not rewrite:
        raise lost(path, "is read")
    in_plies = path.parent.name == "plies" and path.suffix == ".csv"
    folder = found(path.parent.parent if in_plies else path.parent)
    if (in_plies or path.name in OF_RUN) and folder and identity(folder) in runs:
        raise lost(path, "is part of the run that is read")


def check_kind(path: Path, new: Path) -> None:
    """Before `new` takes its place: a file that begins as no file of the program does is of somebody else.
    Raises Mistake."""
    before, now = token(path), token(new)
    if before and not before.startswith(now) and not now.startswith(before):
        raise lost(path, f"begins with {before.decode(errors='backslashreplace')!r}, not with "
                         f"{now.decode(errors='backslashreplace')!r}: it is no output of this program")


def token(path: Path) -> bytes:
    """The first word of a file; empty of one that is none, or is not there."""
    if not path.is_file():
        return b""
    with open(path, "rb") as file:
        words = file.read(4 * TOKEN).replace(b",", b" ").split()
    return words[0][:TOKEN].lower() if words else b""
