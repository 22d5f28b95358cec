# SPDX-License-Identifier: GPL-3.0-or-later
"""New cases: from nothing, a copy of one in the folder, or one that plyform comes with, which brings its
files along."""

import os
import shutil
from pathlib import Path

from base.ending import TOOLS, one_line

from ..project.project import Refused, plain_name
from ..toml import edits as toml_edits
from .files import CaseFiles, parsed
from .folder import kind_of_toml
from .paths import names_a_file, paths_inside

SHIPPED = TOOLS.parent / "cases"
FABRIC = SHIPPED / "fabrics/glass_plain_weave.toml"
SMALLEST = """title = "{name}"

[fabrics]
glass = "glass_plain_weave.toml"

[blanks.sheet]
size = [200.0, 200.0]        # mm
mesh = "alternating"
element_size = 8.0           # the largest
mesh_from = "scene"          # smaller where the tools need it

[[ply]]                      # from the bottom up
name = "ply1"
fabric = "glass"
blank = "sheet"
angle = 0.0                  # degrees, from x to the warp

[[tool]]
name = "punch"
shape = "sphere"
radius = 40.0
position = [0.0, 0.0, 40.6]  # touches the ply, which is 0.6 mm thick
motion = "driven"
direction = [0.0, 0.0, -1.0]
stroke = 30.0

[[tool]]
name = "die"                 # hole of radius 45, fillet 8, flat top at z = 0
shape = "profile"
points = [[45.0, -80.0], [45.0, 0.0, 8.0], [200.0, 0.0]]

[[tool]]
name = "holder"
shape = "annulus"
inner_radius = 55.0
outer_radius = 180.0
thickness = 10.0
edge_radius = 4.0
position = [0.0, 0.0, 0.6]
motion = "force"
direction = [0.0, 0.0, -1.0]
force = 100.0

[contact]
friction = 0.2

[solver]
duration = 0.05              # s
fibre_softening = 100.0
outputs = 20
"""


def examples() -> list[dict]:
    """The shipped cases, of which all files are there."""
    return [{"name": name, "title": title} for name, (_, title) in sorted(shipped().items())]


def shipped() -> dict[str, tuple[Path, str]]:
    found = {}
    for file in sorted(SHIPPED.glob("*/*.toml")):
        kind, title = kind_of_toml(file.read_text(encoding="utf-8"))
        if kind == "case" and all(path.is_file() for _, path in named_files(file.read_text(encoding="utf-8"), file)):
            name = file.parent.name if file.stem == "case" else f"{file.parent.name}/{file.stem}"
            found[name] = file, title
    return found


def named_files(text: str, file: Path) -> list[tuple[tuple, Path]]:
    """Keys and files that a case names."""
    found, waiting = [], [((), parsed(text))]
    while waiting:
        key, value = waiting.pop()
        if isinstance(value, str) and names_a_file(tuple(map(str, key)), value, False):
            found.append((key, file.parent / value))
        elif isinstance(value, dict):
            waiting += [((*key, name), part) for name, part in value.items()]
        elif isinstance(value, list):
            waiting += [((*key, number), part) for number, part in enumerate(value)]
    return found


def new_case(files: CaseFiles, name: str, source: str) -> str:
    """The path of a new case NAME/case.toml. Raises Refused."""
    project = files.project
    folder = project.inside(plain_name(name))
    if folder.exists() or project.inside(name) != project.root / name:
        raise Refused(f"there is a {name} already: take another name", 409)
    if source.startswith("example:"):
        text, copies = from_example(source.removeprefix("example:"))
    elif source:
        text, copies = from_here(files, source, folder), {}
    else:
        text, copies = SMALLEST.format(name=name.replace("_", " ")), {FABRIC.name: FABRIC}
    path = folder / "case.toml"
    folder.mkdir()
    try:
        for name_there, file in copies.items():
            project.write(folder / name_there, file.read_bytes(), None)
        project.write(path, text.encode(), None)
    except OSError:  # a full disk: its name stays free
        shutil.rmtree(folder, ignore_errors=True)
        raise
    files.tell(path, files.read(path)[1])
    files.events.send("folder")
    return project.relative(path)


def from_example(name: str) -> tuple[str, dict[str, Path]]:
    if name not in shipped():
        raise Refused(f"there is no example {one_line(name, 100)}", 404)
    file, _ = shipped()[name]
    text, copies, edits = file.read_text(encoding="utf-8"), {}, []
    for key, path in named_files(text, file):
        there = path.name
        if copies.get(there, path).resolve() != path.resolve():
            there = f"{path.parent.name}_{path.name}"
        copies[there] = path
        edits.append({"op": "set", "key": [str(part) for part in key], "value": there})
    return toml_edits.edited(text, edits, {})[0], copies


def from_here(files: CaseFiles, source: str, folder: Path) -> str:
    """The copy goes on with the files of the first."""
    file = files.path(source)
    paths_inside(files.project, file)
    text, _ = files.read(file)
    edits = [{"op": "set", "key": [str(part) for part in key],
              "value": Path(os.path.relpath(os.path.realpath(path), folder)).as_posix()}
             for key, path in named_files(text, file)]
    return toml_edits.edited(text, edits, {})[0]
