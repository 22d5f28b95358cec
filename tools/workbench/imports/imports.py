# SPDX-License-Identifier: GPL-3.0-or-later
"""Files in the folder that become parts of a case: what to add to it, and where a mesh has first to be made
of a part, the command that does it."""

import functools
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np

from base.ending import one_line

from ..cases.files import CaseFiles, parsed
from ..cases.folder import KINDS, kind_of_toml
from ..cases.paths import paths_inside
from ..project.project import Refused
from ..results.listing import check_links
from ..studio import Studio

OF_DRAWINGS = {"1": "inch", "2": "foot", "4": "mm", "5": "cm", "6": "m", "14": "dm"}  # $INSUNITS, as the program knows it
MOST_HEADER = 1 << 20  # bytes of a drawing in which its unit stands
MOST_DRAWING = 64 << 20
MOST_MESH = 512 << 20
ROW = np.dtype([("normal", "<f4", 3), ("x", "<f4", (3, 3)), ("end", "<u2")])  # of binary STL


def imported(studio: Studio, files: CaseFiles, wish: dict) -> dict:
    """{key, name, value}: what an edit `add` takes; or {process, outputs} of a command that makes meshes.
    Raises Refused."""
    path = studio.project.existing(str(wish.get("path", "")))
    if not path.is_file():
        raise Refused("a file is wanted", 422)
    kind, what = KINDS.get(path.suffix.lower()), wish.get("as")
    case = files.path(str(wish["case"])) if wish.get("case") else None
    named = os.path.relpath(path, case.parent) if case else studio.project.relative(path)
    name = "".join(c if c.isascii() and (c.isalnum() or c in "_-") else "_" for c in path.stem)[:60] or "part"
    if (kind, what) == ("part", "tool"):
        return of_part(studio, files, path, wish)
    if (kind, what) == ("mesh", "tool"):
        scale = unit_of(studio, wish)
        return {"key": "tool", "name": name, "value": {"shape": "mesh", "file": named, **scaled(scale)},
                **box_of(studio, path, scale)}
    if (kind, what) == ("drawing", "blank"):
        said = unit_of_drawing(studio, path)
        own = said or "mm"  # as the program takes it without a scale
        scale = {"scale": unit_of(studio, wish)} if wish.get("unit", own) != own else {}
        value = {"outline_file": named, **scale, "mesh": "fibres",
                 "element_size": number_of(wish, "element_size", 10.0, 0.01, 1e4)}
        return {"key": "blanks", "name": name, "value": value, "unit": said}
    if (kind, what) == ("toml", "fabric"):
        text, _ = files.read(path)
        parsed(text)
        if kind_of_toml(text)[0] != "fabric":
            raise Refused(f"{path.name} is no fabric: it has neither warp and weft nor families nor a sheet", 422)
        return {"key": "fabrics", "name": name, "value": named}
    if (kind, what) == ("curve", "curve"):
        return {"panel": "identify", "path": studio.project.relative(path)}
    raise Refused(f"{path.name} cannot become {one_line(what, 30)!r}: parts and meshes become a tool, drawings a "
                  "blank, fabric files a fabric, curves a curve", 422)


def scaled(scale: float) -> dict:
    return {} if scale == 1.0 else {"scale": scale}


def unit_of_drawing(studio: Studio, path: Path) -> str:
    """As its header says; "" if that says nothing, or one that is not known, which the check of the case tells."""
    head = studio.project.read(path, MOST_DRAWING)[:MOST_HEADER].decode("latin-1")
    found = re.search(r"\$INSUNITS\s*\n\s*70\s*\n\s*(\d+)\s*\n", head)
    return OF_DRAWINGS.get(found[1], "") if found else ""


@functools.lru_cache(maxsize=1)
def lengths(program: Path) -> dict[str, float]:
    """Name -> mm of the units of length that the program knows."""
    told = subprocess.run([str(program), "keys", "--units", "--json"], capture_output=True, timeout=30, check=True)
    return {unit["name"]: unit["factor"] for unit in json.loads(told.stdout) if unit["quantity"] == "length"}


def unit_of(studio: Studio, wish: dict) -> float:
    name, known = wish.get("unit", "mm"), lengths(studio.program)
    if not isinstance(name, str) or name not in known:
        raise Refused(f"unit: one of {', '.join(known)}", 422)
    return known[name]


def number_of(wish: dict, key: str, otherwise, least: float, most: float, unit: str = "mm"):
    value = wish.get(key, otherwise)
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not least <= value <= most:
        raise Refused(f"{key}: a number from {least:g} to {most:g}, {unit}", 422)
    return value


def of_part(studio: Studio, files: CaseFiles, path: Path, wish: dict) -> dict:
    """By mesh_tool.py: one tool, or die and punch with an offset or with room for the plies of a case."""
    room = room_of(studio, files, wish)
    deflection = number_of(wish, "deflection", 0.05, 1e-4, 10.0)
    stem = path.with_suffix("")
    outputs = [stem.with_name(f"{stem.name}{end}.stl") for end in (("_die", "_punch") if room else ("",))]
    for output in outputs:
        if studio.processes.makes(studio.project.relative(output)):
            raise Refused(f"{output.name} is just being made: let that end first", 409)
        if output.is_symlink() or output.exists() and not wish.get("replace"):
            raise Refused(f"there is a {output.name} already: remove it, or replace it", 409)
    command = [sys.executable, str(studio.tools / "mesh_tool.py"), str(path), "--deflection", f"{deflection:g}",
               "-o", str(stem.with_name(stem.name + ".stl")), *room]
    names = [studio.project.relative(output) for output in outputs]
    about = {"part": studio.project.relative(path), "outputs": names, "case": wish.get("case", "")}
    words = f"die and punch of {path.name}" if room else f"mesh of {path.name}"
    return {"process": studio.processes.begin("mesh", words, command, path.parent, about), "outputs": names}


def room_of(studio: Studio, files: CaseFiles, wish: dict) -> list[str]:
    """Arguments of die and punch; none of a single tool."""
    offset = number_of(wish, "offset", None, 1e-3, 1000.0)
    if wish.get("stack") and wish.get("case"):
        case = files.path(str(wish["case"]))
        paths_inside(studio.project, case)
        shear = number_of(wish, "shear", 0.0, 0.0, 80.0, "degrees")
        room = ["--stack", str(case), *(["--shear", f"{shear:g}"] if shear else [])]
    elif wish.get("run"):
        room = ["--run", str(run_of(studio, str(wish["run"])))]
    elif offset is not None:
        room = ["--offset", f"{offset:g}"]
    else:
        return []
    for key, words in (("on", ("die", "punch")), ("solid", ("part", "tool"))):
        if wish.get(key):
            if wish[key] not in words:
                raise Refused(f"{key}: one of {', '.join(words)}", 422)
            room += [f"--{key}", wish[key]]
    direction = wish.get("direction")
    if direction is not None:
        if not isinstance(direction, list) or len(direction) != 3:
            raise Refused("direction: three numbers", 422)
        room += ["--direction", *(f"{number_of({'direction': one}, 'direction', 0, -1e6, 1e6):g}" for one in direction)]
    return room


def run_of(studio: Studio, name: str) -> Path:
    """The folder of a run, whose formed plies the room is for. Raises Refused."""
    folder = studio.project.existing(name)
    if not (folder / "results.h5").is_file():
        raise Refused(f"{one_line(name, 200)} has no results.h5: it is no folder of a run", 404)
    check_links(studio.project, folder)
    return folder


def box_of(studio: Studio, path: Path, scale: float) -> dict:
    """Facets and box (mm) of an STL file, by which a wrong unit is seen; of other meshes the scene shows it."""
    if path.suffix.lower() != ".stl":
        return {}
    content = studio.project.read(path, MOST_MESH)
    count = int.from_bytes(content[80:84], "little") if len(content) >= 84 else 0
    if len(content) == 84 + count * ROW.itemsize and count:
        x = np.frombuffer(content, ROW, count, 84)["x"].reshape(-1, 3).astype(float)
    else:
        x = of_words(content, path.name)
    if not np.isfinite(x).all() or not len(x):
        raise Refused(f"{path.name} is no STL file: it has points that are no numbers", 422)
    return {"facets": len(x) // 3, "box_mm": [(x.min(axis=0) * scale).tolist(), (x.max(axis=0) * scale).tolist()]}


def of_words(content: bytes, name: str) -> np.ndarray:
    rows = [line.split()[1:4] for line in content.splitlines() if line.lstrip()[:6].lower() == b"vertex"]
    try:
        return np.array(rows, dtype=float).reshape(-1, 3)
    except ValueError as problem:
        raise Refused(f"{name} is no STL file: a vertex has three numbers", 422) from problem
