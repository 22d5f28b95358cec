# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases with much in them as tables, small enough to be checked in a moment, and how one is written."""

import json
import math
import tomllib
from pathlib import Path

SHIPPED = ["hemisphere_ncf", "organosheet_hemisphere", "ud_tape_stack", "springs_and_grippers", "pull_out",
           "inflated_membrane", "diaphragm_c_channel", "matched_double_dome", "picture_frame", "pocket"]
MANY = 9  # elements along a blank


def word(value) -> str:
    """A value as TOML."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(key)} = {word(one)}" for key, one in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(word, value)) + "]"
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else str(value)
    return json.dumps(value) if isinstance(value, str) else str(value)


def text_of(case: dict) -> str:
    """A case file: each table and each item of a list of tables under its header."""
    lines = []

    def put(table: dict, path: list) -> None:
        tables = {key: value for key, value in table.items() if isinstance(value, dict)}
        lists = {key: value for key, value in table.items()
                 if isinstance(value, list) and value and all(isinstance(one, dict) for one in value)}
        plain = [key for key in table if key not in tables and key not in lists]
        lines.extend(f"{json.dumps(key)} = {word(table[key])}" for key in plain)
        for key, value in tables.items():
            lines.append("[" + ".".join(map(json.dumps, [*path, key])) + "]")
            put(value, [*path, key])
        for key, value in lists.items():
            for one in value:
                lines.append("[[" + ".".join(map(json.dumps, [*path, key])) + "]]")
                put(one, [*path, key])

    put(case, [])
    return "\n".join(lines) + "\n"


def with_fabrics(case: dict, folder: Path) -> dict:
    """The case with its fabric files in it, and the paths of its meshes whole."""
    for name, fabric in case.get("fabrics", {}).items():
        if isinstance(fabric, str):
            case["fabrics"][name] = tomllib.loads((folder / fabric).read_text())
    for part in [*case.get("tool", []), *case.get("blanks", {}).values()]:
        if "file" in part:
            part["file"] = str((folder / part["file"]).resolve())
    return case


def small(case: dict) -> dict:
    """The case with few elements, the same throughout, and without tools of mesh files that the shipped
    case has drawn for it first."""
    for blank in case.get("blanks", {}).values():
        if blank.pop("mesh_from", None) or "element_size" in blank:
            points = blank.get("outline", [])
            size = max(blank["size"]) if "size" in blank else 2.0 * blank["radius"] if "radius" in blank else \
                max((abs(point[0]) for point in points if isinstance(point, list)), default=100.0)
            blank["element_size"] = max(float(size) / MANY, blank.get("element_size", 0.0))
    for tool in case.get("tool", []):
        if "file" in tool and not Path(tool["file"]).is_file():
            tool.pop("file")
            tool |= {"shape": "box", "size": [60.0, 60.0, 10.0], "edge_radius": 3.0}
    return case


def rich_cases(cases: Path, good: Path) -> dict[str, dict]:
    """By name: those of SHIPPED that can be read small, and the cases of tests/data/good."""
    found = {name: small(with_fabrics(tomllib.loads((cases / name / "case.toml").read_text()), cases / name))
             for name in SHIPPED}
    for file in sorted(good.glob("*.toml")):
        case = tomllib.loads(file.read_text())
        if "ply" in case:
            found[file.stem] = with_fabrics(case, good)
    return found


def places(value, path: tuple = ()) -> list[tuple]:
    """The paths of all that a case holds: of tables, lists and values."""
    found = [path] if path else []
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, one in items:
        found += places(one, (*path, key))
    return found


def at(case, path: tuple):
    for key in path:
        case = case[key]
    return case
