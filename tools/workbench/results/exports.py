# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands of plyform export, map and pattern for a run, as its page asks for them. What is asked is
looked at here, so that a command has nothing in it but words of these lists, numbers, and paths of the
folder."""

import math
from pathlib import Path

from base.ending import one_line

from ..cases.paths import paths_inside
from ..project.project import Project, Refused
from .listing import check_links

STATES = ("vtu", "stl", "csv", "vtkhdf", "gltf")
LAYUPS = ("csv", "vtu", "infusion", "abaqus", "calculix", "lsdyna", "optistruct", "openradioss", "acp", "h5")
REFERENCES = ("", "part", "side", "x", "y", "z")
PARTS = (".inp", ".cdb", ".bdf", ".nas", ".dat", ".fem", ".k", ".key", ".dyn", ".vtu")
OUTLINES = (".csv", ".dxf")
FILES = {"part": "part mesh", "trim": "trim line", "case": "case"}  # as the page calls them
MOST_FRAME, MOST_ITERATIONS, MOST_THREADS = 10**6, 20, 256


def command_of(project: Project, program: Path, wish: dict) -> list[str]:
    """Raises Refused."""
    make = {"export": states_of, "map": layup_of, "pattern": pattern_of}.get(wish.get("what"))
    if not make:
        raise Refused(f"{one_line(wish.get('what'), 50)!r} is none of export, map, pattern", 422)
    folder = text(wish, "folder")
    results = project.existing(folder)
    if not (results / "results.h5").is_file():
        raise Refused(f"{one_line(folder, 200)} has no results.h5: it is no folder of a run", 404)
    check_links(project, results)
    output = project.inside(f"{folder}/{wish['what']}")
    if not output.is_relative_to(results):
        raise Refused(f"{one_line(folder, 200)}/{wish['what']} is a link elsewhere: remove it")
    return [str(program), wish["what"], str(results), *make(project, wish), "-o", str(output)]


def states_of(project: Project, wish: dict) -> list[str]:
    words = ["--format", ",".join(of_list(wish, "formats", STATES))]
    if wish.get("frame") == "all":
        return [*words, "--frame", "all"]
    return [*words, *frame_of(wish)]


def layup_of(project: Project, wish: dict) -> list[str]:
    words = ["--format", ",".join(of_list(wish, "formats", LAYUPS)), *frame_of(wish)]
    if wish.get("part"):
        words += ["--onto", str(file_of(project, wish, "part", PARTS))]
        words += ["--scale", f"{number(wish, 'scale', 1e-6, 1e6, 1.0):.12g}"]
        for key in ("turn", "move"):
            if any(values := three(wish, key)):
                words += [f"--{key}", *(f"{value:.12g}" for value in values)]
    reference = wish.get("reference", "")
    if reference not in REFERENCES:
        raise Refused(f"reference: one of {', '.join(REFERENCES[1:])}", 422)
    if reference:
        words += ["--reference", reference]
    return [*words, *(["--two"] if wish.get("two") is True else []), *mirrors(wish)]


def pattern_of(project: Project, wish: dict) -> list[str]:
    words = ["--trim", str(file_of(project, wish, "trim", OUTLINES)), *frame_of(wish), *mirrors(wish)]
    if wish.get("space") is True:
        words.append("--space")
    if wish.get("case"):
        case = file_of(project, wish, "case", (".toml",))
        paths_inside(project, case)
        words += ["--case", str(case),
                  "--tolerance", f"{number(wish, 'tolerance', 0.01, 1000.0, 1.0):.12g}",
                  "--iterations", str(int(number(wish, "iterations", 1, MOST_ITERATIONS, 4)))]
        if wish.get("threads"):
            words += ["--threads", str(int(number(wish, "threads", 1, MOST_THREADS, 1)))]
    return words


def text(wish: dict, key: str) -> str:
    if not isinstance(wish.get(key), str):
        raise Refused(f"{key}: a text is wanted", 422)
    return wish[key]


def of_list(wish: dict, key: str, known: tuple[str, ...]) -> list[str]:
    asked = wish.get(key)
    if not isinstance(asked, list) or not asked or any(one not in known for one in asked):
        raise Refused(f"{key}: one or more of {', '.join(known)}", 422)
    return list(dict.fromkeys(asked))


def number(wish: dict, key: str, least: float, most: float, otherwise: float) -> float:
    value = wish.get(key, otherwise)
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not least <= value <= most:
        raise Refused(f"{key}: a number from {least:g} to {most:g}", 422)
    return value


def three(wish: dict, key: str) -> list[float]:
    values = wish.get(key, [0.0] * 3)
    if not isinstance(values, list) or len(values) != 3 or any(
            isinstance(one, bool) or not isinstance(one, (int, float)) or not math.isfinite(one)
            for one in values):
        raise Refused(f"{key}: three numbers", 422)
    return values


def frame_of(wish: dict) -> list[str]:
    if wish.get("frame") in (None, ""):
        return []
    return ["--frame", str(int(number(wish, "frame", 0, MOST_FRAME, 0)))]


def mirrors(wish: dict) -> list[str]:
    axes = wish.get("mirror", [])
    if not isinstance(axes, list) or any(axis not in ("x", "y") for axis in axes):
        raise Refused("mirror: x, y, or both", 422)
    return [word for axis in dict.fromkeys(axes) for word in ("--mirror", axis)]


def file_of(project: Project, wish: dict, key: str, endings: tuple[str, ...]) -> Path:
    if not wish.get(key):
        raise Refused(f"choose a {FILES[key]}: a file that ends with {', '.join(endings)}", 422)
    path = project.existing(text(wish, key))
    if not path.is_file() or path.suffix.lower() not in endings:
        raise Refused(f"{key}: a file that ends with {', '.join(endings)}", 422)
    return path
