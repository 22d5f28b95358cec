# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that a case names: every one has to lie in the folder of the workbench, links followed, before the
program is let loose on the case."""

import os
import stat
from collections.abc import Iterator
from pathlib import Path

from base.ending import one_line
from base.files import toml_of

from ..project.project import Project, Refused

MOST_TEXT = 4 << 20  # bytes of a case or fabric file
NO_FOLDERS = ("scene", "element_size")  # values of mesh_from


def paths_inside(project: Project, case: Path) -> list[Path]:
    """The case, its fabric files and all that they name, there or not, without links. Raises Refused if
    any is outside; what is no TOML names nothing."""
    found, waiting = [], [(case, False)]
    while waiting:
        file, fabric = waiting.pop()
        found.append(checked(project, file, project.relative(case)))
        for key, text in texts_of(project, file):
            named = names_a_file(key, text, fabric)
            path = file.parent / text if "\0" not in text else None
            if path is None or len(text) > 4000 or not named and not is_file(path):
                if named:
                    raise Refused(f"{project.relative(file)}: {'.'.join(key)}: no name of a file")
                continue
            inside = checked(project, path, f"{project.relative(file)}: {one_line('.'.join(key), 100)}")
            if inside in found:
                continue
            if key[0] == "fabrics" and len(key) == 2 and not fabric:
                waiting.append((inside, True))
            else:
                found.append(inside)
    return list(dict.fromkeys(found))


def names_a_file(key: tuple[str, ...], text: str, fabric: bool) -> bool:
    """Of case files; fabric files name none. Any text that happens to be a file's name is looked at as
    well: the program takes its bytes into the identity of the case."""
    if fabric:
        return False
    if key[0] == "blanks":
        return len(key) == 3 and (key[2] in ("file", "outline_file") or
                                  key[2] == "mesh_from" and text not in NO_FOLDERS)
    return key[0] == "fabrics" and len(key) == 2 or key[0] == "tool" and key[-1] == "file"


def checked(project: Project, path: Path, words: str) -> Path:
    """As it is and as plyform takes it, which resolves .. before links."""
    for way in (str(path), os.path.normpath(path)):
        try:
            real = Path(os.path.realpath(way))
        except OSError as problem:  # a link that goes while it is followed
            raise Refused(f"{words} is missing", 404) from problem
        if not real.is_relative_to(project.root) or real.is_relative_to(project.own):
            raise Refused(f"{words} leads out of the folder of this workbench: copy the file into it")
    try:
        mode = real.stat().st_mode
        if not stat.S_ISREG(mode) and not stat.S_ISDIR(mode):
            raise Refused(f"{words} is no file")
    except OSError:
        pass  # missing: the check of the case says so
    return real


def is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


def texts_of(project: Project, file: Path) -> Iterator[tuple[tuple[str, ...], str]]:
    try:
        data = toml_of(project.read(file, MOST_TEXT).decode("utf-8-sig"))
    except (OSError, ValueError, RecursionError, Refused):
        return
    waiting = [((), data)]
    while waiting:
        key, value = waiting.pop()
        if isinstance(value, str) and value:
            yield key, value
        elif isinstance(value, dict):
            waiting += [((*key, name), part) for name, part in value.items()]
        elif isinstance(value, list):
            waiting += [((*key, str(number)), part) for number, part in enumerate(value)]
