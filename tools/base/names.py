# SPDX-License-Identifier: GPL-3.0-or-later
"""Names from files that become paths: the one place where they do."""

from pathlib import Path

from base.ending import Trouble, one_line

FORBIDDEN = '/\\:*?"<>|'  # as core/results/result_writer.cpp has them
SEPARATORS = "/\\"      # of folders: in no name that is read
LONGEST = 200  # bytes: file systems take 255, and endings and numbers come behind


def fault_of(name: object, forbidden: str = FORBIDDEN) -> str:
    """Why a name cannot be that of a file; empty if it can."""
    if not isinstance(name, str) or not name:
        return "is empty or no text"
    if name.startswith("."):
        return "starts with a dot"
    if not all(c.isprintable() for c in name):
        return "holds a control character, a line break or what is no character"
    if any(c in forbidden for c in name):
        return "holds one of " + " ".join(forbidden)
    return f"is longer than {LONGEST} bytes" if len(name.encode()) > LONGEST else ""


def checked(name: object, what: str, file: Path | str, forbidden: str = FORBIDDEN) -> str:
    """The name, if a file can be called after it. Raises Trouble."""
    if fault := fault_of(name, forbidden):
        raise Trouble(f"{file}: the name {one_line(repr(name), 80)} of a {what} {fault}: files are "
                      "called after it, so that it cannot be a name; rename it in the case, and run "
                      "it again")
    return name


def place_in(folder: Path, name: str) -> Path:
    """FOLDER/NAME, which lies in the folder itself. Raises Trouble."""
    return folder / checked(name, "file", folder)
