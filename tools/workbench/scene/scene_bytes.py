# SPDX-License-Identifier: GPL-3.0-or-later
"""The scene of a case as the page takes it, see arrays.py."""

import math

import numpy as np

from ..project.arrays import Arrays
from .coarser import coarser
from .draft_tools import StandIn


def added(arrays: Arrays, values) -> dict | None:
    return None if values is None else arrays.add(np.asarray(values))


def finite(value):
    """NaN and inf, which JSON has not, as null; NumPy's numbers as Python's."""
    if isinstance(value, np.ndarray):
        return finite(value.tolist())
    if isinstance(value, np.generic):
        return finite(value.item())
    if isinstance(value, dict):
        return {str(key): finite(part) for key, part in value.items()}
    if isinstance(value, (list, tuple)):
        return [finite(part) for part in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def scene_bytes(scene, version: str, stand_ins: dict[int, StandIn] | None = None) -> bytes:
    """Of a plyform.Scene. stand_ins: of tools, by number, that a draft draws with few facets."""
    stand_ins = stand_ins or {}
    arrays = Arrays()
    duration, times = scene.duration_s, np.asarray(scene.times_s)
    shares = times / duration if duration > 0 else np.zeros(len(times))
    names = [ply.name for ply in scene.plies]
    tools = [tool_part(tool, number, shares, names, arrays, stand_ins.get(number))
             for number, tool in enumerate(scene.tools)]
    header = {
        "version": version, "draft": bool(stand_ins), "title": scene.title, "duration_s": duration, "gravity": scene.gravity,
        "stack_thickness_mm": scene.stack_thickness_mm,
        "plies": [ply_part(ply, number, arrays) for number, ply in enumerate(scene.plies)],
        "tools": tools,
        "boundaries": [boundary_part(one, number, shares, arrays) for number, one in enumerate(scene.boundaries)],
        "gaps": [{"a": names[one["lower"]], "b": names[one["upper"]], "mm": one["gap_mm"]}
                 for one in scene.spacings],
        "loads": [{**one, "key": f"load.{one['entry']}"} for one in scene.loads],
        "missing": [f"{kind} {part.name or number + 1}: {part.trouble}"
                    for kind, parts in (("ply", scene.plies), ("tool", scene.tools), ("boundary", scene.boundaries))
                    for number, part in enumerate(parts) if part.trouble],
    }
    return arrays.packed(finite(header))


def formed_bytes(result, first: int = 0) -> bytes:
    """Of a plyform.Result, as live_states.state gives one, with meshes: {told_deg, plies: [{name, key, x0, x,
    triangles, field, p99_deg}]}; field: the shear angle of each triangle, degrees.
    first: the number of its first ply in the case."""
    arrays = Arrays()
    summary = result.summary
    return arrays.packed(finite({
        "told_deg": summary["accuracy"]["promised_shear_error_deg"],
        "plies": [{"name": ply.name, "key": f"ply.{first + number}", "x0": arrays.add(np.asarray(ply.x0)),
                   "x": arrays.add(np.asarray(ply.x)), "triangles": arrays.add(np.asarray(ply.triangles)),
                   "field": arrays.add(np.asarray(ply.shear_angle_deg)),
                   "p99_deg": summary["plies"][number]["p99_shear_deg"]}
                  for number, ply in enumerate(result.plies)]}))


def ply_part(ply, number: int, arrays: Arrays) -> dict:
    return {"name": ply.name, "key": f"ply.{number}", "fabric": ply.fabric, "blank": ply.blank,
            "angle_deg": ply.angle_deg, "thickness_mm": ply.thickness_mm, "coarser": ply.coarser,
            "x": added(arrays, ply.x), "triangles": added(arrays, ply.triangles),
            "edges": [added(arrays, edge) for edge in ply.edges],
            "families": dict(ply.families), "trouble": ply.trouble}


def tool_part(tool, number: int, shares, plies: list[str], arrays: Arrays, stand_in: StandIn | None = None) -> dict:
    x, triangles = tool.x0, tool.triangles
    facets = 0 if triangles is None else len(triangles)
    if facets and stand_in:
        x, triangles, facets = stand_in.placed(np.asarray(x)), stand_in.triangles, stand_in.facets
    elif facets:
        x, triangles = coarser(np.asarray(x), np.asarray(triangles))
    moves = tool.shifts_mm is not None
    return {"name": tool.name, "key": f"tool.{number}", "shape": tool.shape, "motion": tool.motion,
            "direction": tool.direction, "x": added(arrays, x), "triangles": added(arrays, triangles),
            "facets": facets, "drawn_facets": 0 if triangles is None else len(triangles),
            "shares": shares if moves else None, "shifts": added(arrays, tool.shifts_mm),
            "forces_N": tool.forces_N, "gap": None if stand_in else gap_part(tool.gap, plies),
            "first_contact": None if stand_in else contact_part(tool.first_contact, shares, tool, plies),
            "trouble": tool.trouble}


def gap_part(gap, plies: list[str]) -> dict | None:
    return gap and {"mm": gap.gap_mm, "place": gap.where, "ply": plies[gap.ply]}


def contact_part(contact, shares, tool, plies: list[str]) -> dict | None:
    if not contact:
        return None
    share = None
    if tool.strokes_mm is not None and len(shares) == len(tool.strokes_mm):
        reached = np.flatnonzero(np.asarray(tool.strokes_mm) >= contact.stroke_mm - 1e-9)
        share = float(shares[reached[0]]) if len(reached) else None
        if share and reached[0] > 0:
            a, b = tool.strokes_mm[reached[0] - 1], tool.strokes_mm[reached[0]]
            part = (contact.stroke_mm - a) / (b - a) if b > a else 1.0
            share = float(shares[reached[0] - 1] + part * (shares[reached[0]] - shares[reached[0] - 1]))
    return {"stroke_mm": contact.stroke_mm, "time_s": contact.time_s, "share": share, "place": contact.where,
            "ply": plies[contact.ply]}


def boundary_part(one, number: int, shares, arrays: Arrays) -> dict:
    fields = dict(one.fields)
    shifts = None
    if one.strokes_mm is not None and fields.get("direction") is not None:
        shifts = np.outer(one.strokes_mm, fields["direction"])
    direction = fields.get("direction", flat(fields.get("normal")))
    places = fields.get("anchor", flat(fields.get("point")))
    if one.hinges_mm is not None:
        places = one.hinges_mm[0]
    return {"name": one.name, "key": f"boundary.{number}", "kind": one.kind, "ply": one.ply,
            "nodes": [added(arrays, nodes) for nodes in one.nodes], "places": added(arrays, places),
            "hinges": added(arrays, one.hinges_mm), "direction": direction, "fields": fields,
            "shares": shares if shifts is not None or one.hinges_mm is not None else None,
            "shifts": added(arrays, shifts), "forces_N": one.forces_N, "trouble": one.trouble}


def flat(point):
    """In space, of a point or vector in the plane of the plies."""
    return None if point is None else [*point, 0.0]
