# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run leaves in its folder (docs/users/results.md), and removing that, and nothing else: the
folder may hold the case, or notes."""

import re
import stat
from pathlib import Path

from base.ending import one_line

from .listing import SIGNS
from .live_states import ASK, PICTURE

FILES = (*SIGNS, "history.csv", "results.xdmf", "mesh_sizes.txt", "checkpoint", "report.html", ASK, PICTURE)
# of folders: what names in them are ours
FOLDERS = {"states": re.compile(r".*\.h5"), "plies": re.compile(r".*\.csv"),
           "export": re.compile(r".*\.(vtu|stl|csv|inp|k|bdf|h5|xdmf|dxf|svg)")}


def removed(folder: Path) -> list[str]:
    """Removes the files of a run, and the folder if it is empty then; what stays, by name. Links are
    removed, never followed. Raises OSError."""
    for name in FILES:
        remove(folder / name)
        remove(folder / (name + ".tmp"))  # of one that was killed
    for name, ours in FOLDERS.items():
        inner = folder / name
        if inner.is_symlink() or not inner.is_dir():
            continue
        for path in inner.iterdir():
            if ours.fullmatch(path.name.removesuffix(".tmp")):
                remove(path)
        rid(inner)
    rid(folder)
    return sorted(one_line(path.name) for path in folder.iterdir()) if folder.is_dir() else []


def remove(path: Path) -> None:
    try:
        mode = path.lstat().st_mode
    except FileNotFoundError:
        return
    if stat.S_ISREG(mode) or stat.S_ISLNK(mode):
        path.unlink()


def rid(folder: Path) -> None:
    """Of a folder that is empty."""
    if folder.is_dir() and not any(folder.iterdir()):
        folder.rmdir()
