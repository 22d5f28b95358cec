# SPDX-License-Identifier: GPL-3.0-or-later
"""What is in the folder of the workbench: cases, fabrics, studies, results, and files that can become parts
of cases."""

import os
import re
from pathlib import Path

from base.files import toml_of

from ..project.project import Project, Refused
from .paths import MOST_TEXT

DEPTH = 6
MOST = 5000  # entries
KINDS = {".step": "part", ".stp": "part", ".iges": "part", ".igs": "part", ".stl": "mesh", ".obj": "mesh",
         ".ply": "mesh", ".off": "mesh", ".dxf": "drawing", ".csv": "curve", ".txt": "curve", ".dat": "curve",
         ".tsv": "curve", ".toml": "toml"}
RESULT = ("results.h5", "summary.json", "progress.json")  # a folder with any of them is a run's
FABRIC = ("surface_density", "warp", "weft", "family", "sheet", "isotropic", "neo_hookean", "mooney_rivlin")


def kind_of_toml(text: str) -> tuple[str, str]:
    """case, fabric, study or toml, and its title or name. A case that is no TOML now is one as well."""
    try:
        data = toml_of(text)
    except (ValueError, RecursionError):
        return ("case" if re.search(r"^\s*\[\[\s*(ply|tool)\s*\]\]", text, re.MULTILINE) else "toml"), ""
    words = [data.get(key) for key in ("title", "name")]
    title = next((word for word in words if isinstance(word, str)), "")[:200]
    if "vary" in data or "method" in data or "case" in data:
        return "study", title
    if "ply" in data or "tool" in data:
        return "case", title
    return ("fabric" if any(key in data for key in FABRIC) else "toml"), title


class Folder:
    def __init__(self, project: Project):
        self.project = project
        self.read: dict[Path, tuple] = {}  # stamp, kind, title of TOML files
        self.folders: list[Path] = [project.root]

    def contents(self) -> dict:
        found = {"root": str(self.project.root), "cases": [], "fabrics": [], "studies": [], "results": [], "files": [],
                 "more": False}
        self.folders, entries = [], 0
        for folder, names, files in os.walk(self.project.root):
            here = Path(folder)
            self.folders.append(here)
            depth = len(here.relative_to(self.project.root).parts)
            if depth and any(name in files for name in RESULT):
                found["results"].append(self.project.relative(here))
                names.clear()
                continue
            names[:] = [] if depth >= DEPTH else sorted(name for name in names if not name.startswith("."))
            entries += len(names) + len(files)
            for name in sorted(files):
                self.add(here / name, found)
            if entries > MOST:
                found["more"] = True
                break
        return found

    def add(self, path: Path, found: dict) -> None:
        kind = KINDS.get(path.suffix.lower())
        name = self.project.relative(path)
        if not kind or path.name.startswith("."):
            return
        try:
            real = self.project.existing(name)
            size = real.stat().st_size
            if not real.is_file():
                return
        except (Refused, OSError):
            return  # a link that leads outside
        found["files"].append({"path": name, "size": size, "kind": kind})
        if kind == "toml":
            what, title = self.of_toml(real)
            if what == "case":
                found["cases"].append({"path": name, "title": title})
            elif what == "fabric":
                found["fabrics"].append({"path": name, "name": title})
            elif what == "study":
                found["studies"].append({"path": name, "title": title})

    def of_toml(self, path: Path) -> tuple[str, str]:
        try:
            status = path.stat()
            stamp = status.st_mtime_ns, status.st_size, status.st_ino
            if self.read.get(path, (None,))[0] != stamp:
                text = self.project.read(path, MOST_TEXT).decode("utf-8-sig")
                self.read[path] = stamp, *kind_of_toml(text)
            return self.read[path][1:]
        except (OSError, ValueError, Refused):
            return "toml", ""

    def stamp(self) -> tuple:
        """Changes when a file has been made or has gone in any of the folders seen last."""
        stamps = []
        for folder in self.folders:
            try:
                stamps.append(folder.stat().st_mtime_ns)
            except OSError:
                stamps.append(0)
        return tuple(stamps)
