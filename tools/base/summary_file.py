# SPDX-License-Identifier: GPL-3.0-or-later
"""summary.json (keys: docs/users/results.md): its values are of the kinds that plyform writes, so that
who reads it need not look again. Keys that are not here may be anything."""

from pathlib import Path

from base.ending import Trouble, one_line
from base.files import read_json
from base.names import SEPARATORS, checked

MOST_TEXT = 100000  # characters: a message has some hundred

NUMBER, TEXT = "a number or null", "a text"
FOUR = [NUMBER] * 4
POINT = [NUMBER] * 3
WALKS = {"mean": NUMBER, "spread": NUMBER, "directions_deg": FOUR, "each": FOUR}
BODY = {"name": TEXT, "force_N": NUMBER, "force_raw_N": NUMBER, "displacement_mm": NUMBER,
        "force_known_to_s": NUMBER, "speed_mm_s": NUMBER}
FIGURE = {"name": TEXT, "unit": TEXT, "value": NUMBER, "band": NUMBER, "no_band": TEXT}
STITCH = {"name": TEXT, "largest_broken_patch_at_mm": POINT,
          **dict.fromkeys(("broken_length_share", "broken_area_mm2", "largest_broken_patch_mm2"),
                          NUMBER)}
PLY = {"name": TEXT, "stitches": (STITCH,), "bridging_family": TEXT, "no_draw_in": TEXT,
       "draw_in_mm": {...: NUMBER}, "draw_in_yarns_mm": WALKS, "draw_in_bisectors_mm": WALKS,
       "openings": ({"family": TEXT, "at_mm": POINT, ...: NUMBER},), ...: NUMBER}
DESCRIBED = {...: {"label": TEXT, "unit": TEXT, "note": TEXT, "verified": TEXT, "digits": NUMBER}}
# {...: kind}: any other key, those of places (_at_mm) points; (kind,): a list of any length
SUMMARY = {
    **dict.fromkeys(("title", "version", "status", "message"), TEXT),
    **dict.fromkeys(("time_s", "stroke_mm", "wall_time_s", "steps", "threads", "elements", "nodes",
                     "searches", "largest_added_mass", "element_added_mass"), NUMBER),
    "plies": (PLY,), "tools": (BODY,), "boundaries": (BODY,), "energy": {...: NUMBER},
    "accuracy": {key: NUMBER for key in ("promised_shear_error_deg", "inertia_deg", "mesh_deg",
                                         "softening_deg", "element_size_factor")},
    "contact": {key: NUMBER for key in ("max_tool_penetration_mm", "max_ply_penetration_mm",
                                        "intersections_between_plies",
                                        "intersections_within_plies")},
    "pairs": ({"a": TEXT, "b": TEXT},), "assumed": (TEXT,), "could_be_left_out": (TEXT,),
    "missing": (TEXT,), "doubts": (TEXT,), "advice": (TEXT,), "case": {...: TEXT},
    "verification": {"figures": (FIGURE,)}, "figures": {"plies": DESCRIBED, "run": DESCRIBED}}
SOUND = ("done", "doubtful", "instant")  # of runs that went to their end
STATUSES = (*SOUND, "stopped", "interrupted")
NEEDED = ("status", "plies", "tools", "energy", "contact")


def word_of(kind) -> str:
    return kind if isinstance(kind, str) else "a table" if isinstance(kind, dict) else \
        f"a list of {len(kind)} numbers" if isinstance(kind, list) else "a list"


def broken(path: Path, what: str) -> Trouble:
    return Trouble(f"{path} cannot be read as a summary of plyform: {what}; run the case again")


def wrong(path: Path, where: str, kind, value) -> Trouble:
    return broken(path, f"{where or 'it'} is {one_line(repr(value), 80)}, not {word_of(kind)}, as "
                        "plyform writes it")


def check(path: Path, where: str, kind, value) -> None:
    """Raises Trouble."""
    right = {NUMBER: value is None or type(value) in (int, float),
             TEXT: isinstance(value, str) and len(value) < MOST_TEXT}[kind] \
        if isinstance(kind, str) else \
        isinstance(value, dict) if isinstance(kind, dict) else isinstance(value, list) and \
        (isinstance(kind, tuple) or len(value) == len(kind))
    if not right:
        raise wrong(path, where, kind, value)
    if isinstance(kind, dict):
        for key, inner in value.items():
            other = POINT if key.endswith("_at_mm") else kind.get(...)
            if (want := kind.get(key, other)) is not None:
                check(path, f"{where}.{key}" if where else key, want, inner)
    elif not isinstance(kind, str):
        for i, inner in enumerate(value):
            check(path, f"{where}.{i}", kind[0], inner)


def check_bodies(path: Path, summary: dict) -> None:
    for kind, what in (("plies", "ply"), ("tools", "tool"), ("boundaries", "boundary")):
        bodies = summary.get(kind, [])
        for i, body in enumerate(bodies):
            if "name" not in body:
                raise broken(path, f"{kind}.{i}.name is missing")
            checked(body["name"], what, path, SEPARATORS)
        if len({body["name"] for body in bodies}) < len(bodies):
            raise broken(path, f"{kind} has a name twice")


def doubts_and_advice(summary: dict) -> tuple[list, list]:
    """What not to trust, and what would make the result better, a sentence each; of a run of before they
    had lists of their own they are told apart by its message."""
    if "doubts" in summary:
        return summary["doubts"], summary.get("advice", [])
    missing, message = summary.get("missing", []), summary.get("message", "")
    doubts = [text for text in missing if text in message]
    return doubts, [text for text in missing if text not in doubts]


def without_unknown_forces(summary: dict) -> dict:
    """Null in the place of forces of tools that press the plies between them: those are contact's
    stiffness, not the cloth's."""
    for tool in summary.get("tools", []):
        if "force_N" in tool and not tool.get("force_known", True):
            tool["force_N"] = tool["force_raw_N"] = None
    return summary


def known_to_s(summary: dict) -> dict[str, float]:
    """Of tools that came to press the plies between them, by name: until when their force is
    known, s."""
    return {tool["name"]: float(tool.get("force_known_to_s") or 0.0)
            for tool in summary.get("tools", []) if not tool.get("force_known", True)}


def read_summary(folder: Path, needed: tuple[str, ...] = NEEDED) -> dict:
    """Of a folder of results. Raises Trouble."""
    path = folder / "summary.json"
    if not path.exists():
        raise Trouble(f"{path} is missing: is {folder} the folder of a run?")
    try:
        summary = read_json(path)
    except Trouble as problem:
        raise broken(path, str(problem).removeprefix(str(path)).lstrip(":")) from problem
    check(path, "", SUMMARY, summary)
    for key in needed:
        if key not in summary:
            raise broken(path, f"{key} is missing")
    if summary.get("status", STATUSES[0]) not in STATUSES:
        raise wrong(path, "status", "one of " + ", ".join(STATUSES), summary["status"])
    check_bodies(path, summary)
    return without_unknown_forces(summary)
