# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of the folder of a run, listed and handed over: to be saved, never shown as a page, as they may
be anybody's."""

import os
import stat
from pathlib import Path
from urllib.parse import quote

from fastapi.responses import FileResponse, Response

from base.ending import one_line
from base.files import read_bytes

from ..project.project import Project, Refused
from ..runs.listing import SIGNS

MOST_FILES, DEPTH, MOST_DEPTH = 500, 3, 6
MOST_DRAWING = 16 << 20  # bytes
ASIDE = ("states",)      # of a run that goes on: parts of results.h5
PASSING = ("picture.ask", "picture.bin")  # between a run that goes on and this
HEADERS = {"Content-Security-Policy": "sandbox; default-src 'none'", "X-Content-Type-Options": "nosniff"}


def listed(project: Project, name: str) -> list[dict]:
    """Regular files: {path (in the project), name (in the folder), size, date}. Links are left out."""
    folder = project.existing(name)
    found: list[dict] = []
    walk = [(folder, 0)]
    while walk and len(found) < MOST_FILES:
        place, depth = walk.pop(0)
        try:
            entries = sorted(os.scandir(place), key=lambda entry: entry.name)
        except OSError:
            continue
        for entry in entries:
            if entry.name.startswith(".") or not entry.name.isprintable() or "\\" in entry.name:
                continue
            if entry.is_dir(follow_symlinks=False) and depth < DEPTH and entry.name not in ASIDE:
                walk.append((Path(entry.path), depth + 1))
            elif entry.is_file(follow_symlinks=False) and entry.name not in PASSING:
                status = entry.stat(follow_symlinks=False)
                found.append({"path": project.relative(Path(entry.path)), "size": status.st_size,
                              "name": os.path.relpath(entry.path, folder), "date": status.st_mtime})
    return found[:MOST_FILES]


def with_endings(project: Project, endings: tuple[str, ...]) -> list[str]:
    """Files of the whole folder that could be read, but those in folders of results and links."""
    found: list[str] = []
    for place, folders, files in os.walk(project.root):
        depth = len(Path(place).relative_to(project.root).parts)
        folders[:] = sorted(name for name in folders if not name.startswith(".") and depth < MOST_DEPTH)
        if depth and any(name in SIGNS for name in files):
            folders[:] = []
            continue
        found += [project.relative(Path(place) / name) for name in sorted(files)
                  if name.lower().endswith(endings) and not name.startswith(".")
                  and not os.path.islink(os.path.join(place, name))]
        if len(found) > MOST_FILES:
            break
    return found[:MOST_FILES]


def file_of(project: Project, folder: str, name: str) -> Path:
    """Of a file in the folder of a run, links followed. Raises Refused."""
    path, room = project.existing(f"{folder}/{name}"), project.existing(folder)
    if not stat.S_ISREG(path.stat().st_mode) or not path.is_relative_to(room):
        raise Refused(f"{one_line(name, 200)} is no file of {one_line(folder, 200)}")
    return path


def saved(project: Project, folder: str, name: str) -> FileResponse:
    """For the browser to save under its own name. Raises Refused."""
    path = file_of(project, folder, name)
    return FileResponse(path, media_type="application/octet-stream", headers={
        **HEADERS, "Content-Disposition": f"attachment; filename*=UTF-8''{quote(path.name, safe='')}"})


def drawing(project: Project, folder: str, name: str) -> Response:
    """The text of a DXF drawing, which the page draws itself. Raises Refused, Trouble."""
    path = file_of(project, folder, name)
    if path.suffix.lower() != ".dxf":
        raise Refused(f"{one_line(name, 200)} is no .dxf file", 422)
    return Response(read_bytes(path, MOST_DRAWING), media_type="application/octet-stream", headers=HEADERS)
