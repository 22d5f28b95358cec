# SPDX-License-Identifier: GPL-3.0-or-later
"""A made-up run with everything that plyform writes and its programs read: results.h5 of two plies, a
tool and a grip in two states, summary.json, history.csv. Small, for tests that spoil it."""

import json
from pathlib import Path

import h5py
import numpy as np

from described import put_columns, put_numbers, put_ply, texts

WOVEN = ("warp", "weft")


def columns_of(families):
    """Names of a ply's columns, in order."""
    return ["contact_pressure", *families, "shear_angle_deg", *(f"{one}_strain" for one in families),
            *(f"{one}_tension_N" for one in families), "thickness_mm"]


def square(cells=4, size=100.0):
    """x0 and triangles of a flat square."""
    ticks = np.linspace(-size / 2, size / 2, cells + 1)
    x, y = np.meshgrid(ticks, ticks)
    corner = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    triangles = np.vstack([np.column_stack([corner, corner + 1, corner + cells + 2]),
                           np.column_stack([corner, corner + cells + 2, corner + cells + 1])])
    return np.column_stack([x.ravel(), y.ravel(), 0.0 * x.ravel()]), triangles.astype(np.int32)


def write_h5(path: Path, plies=("lower", "upper"), tools=("punch",), grips=("grip",),
             families=None) -> None:
    """`families`: of plies that are not woven, by name."""
    own = {name: (families or {}).get(name, WOVEN) for name in plies}
    x0, triangles = square()
    along = x0[triangles].mean(axis=1)
    with h5py.File(path, "w") as file:
        file.attrs["format"], file.attrs["format_version"] = "plyform results", 3
        for bodies, names in (("plies", plies), ("tools", tools), ("boundaries", grips)):
            file.attrs[bodies] = texts(names)
        file["time_s"], file["stroke_mm"], file["step"] = [0.0, 0.1], [0.0, 5.0], [0, 10]
        for name in plies:
            file[f"plies/{name}/x0"], file[f"plies/{name}/triangles"] = x0, triangles
            put_ply(file[f"plies/{name}"], columns_of(own[name]), own[name])
            put_numbers(file.create_group(f"history/plies/{name}"),
                        {"rms_shear_deg": ([0.0, 5.0], "deg"), "draw_in_mm": ([0.0, 1.0], "mm")}, "ply")
        for name in tools:
            file[f"tools/{name}/x0"], file[f"tools/{name}/triangles"] = x0 + (0, 0, 9), triangles
        for bodies, place, names in (("tools", "tool", tools), ("boundaries", "boundary", grips)):
            for name in names:
                put_numbers(file.create_group(f"history/{bodies}/{name}"),
                            {"force_N": ([0.0, 9.0], "N"), "displacement_mm": ([0.0, 5.0], "mm")}, place)
        put_numbers(file.create_group("history/energies"), {
            "kinetic_mJ": ([0.0, 0.1], "mJ"), "fibre_mJ": ([0.0, 2.0], "mJ")}, "run")
        for k in (0, 1):
            put_state(file.create_group(f"frames/{k:06}"), k, x0, along, own, tools, grips)


def put_state(now, k, x0, along, plies, tools, grips) -> None:
    count = len(along)
    for key, value in (("time_s", 0.1 * k), ("stroke_mm", 5.0 * k), ("step", 10 * k)):
        now.attrs[key] = value
    shear = 10.0 * k * np.sin(along[:, 0] / 30.0)
    for level, (name, families) in enumerate(plies.items()):
        ply = now.create_group(f"plies/{name}")
        ply["x"] = x0 + np.column_stack([0 * x0[:, 0], 0 * x0[:, 0],
                                         0.6 * level - 0.001 * k * (x0**2).sum(axis=1)])
        columns = {"shear_angle_deg": shear, "thickness_mm": np.full(count, 0.6)}
        for i, family in enumerate(families):
            angle = np.pi * i / max(len(families), 2)
            columns[family] = np.tile([np.cos(angle), np.sin(angle), 0.0], (count, 1))
            columns[f"{family}_strain"] = columns[f"{family}_tension_N"] = 0.001 * (i + 1) * shear
        put_columns(ply, columns, np.zeros(len(x0)))
    for name in tools:
        tool = now.create_group(f"tools/{name}")
        tool.attrs["displacement_mm"], tool.attrs["force_vector_N"] = [0, 0, -5.0 * k], [0, 0, 9.0]
        tool.attrs["force_N"], tool.attrs["stroke_mm"] = 9.0 * k, 5.0 * k
    for name in grips:
        grip = now.create_group(f"boundaries/{name}")
        grip.attrs["force_vector_N"], grip.attrs["force_N"] = [1.0, 0, 0], 1.0
        grip.attrs["stroke_mm"] = 0.0


def walks():
    return {"mean": 1.0, "spread": 0.5, "directions_deg": [0, 90, 180, 270], "each": [1, 1, 1, 1]}


def ply(name):
    return {"name": name, "angle_deg": 0, "max_shear_deg": 10.0, "p99_shear_deg": 9.0,
            "rms_shear_deg": 5.0, "max_fibre_strain": 0.01, "min_fibre_strain": -0.01,
            "max_tension_N_per_yarn": 0.1, "max_pressed_strain": 0.01,
            "area_share_pressed_over_2_percent": 0.1, "area_share_pressed_over_5_percent": 0.0,
            "excess_length_mm": 0.1, "excess_length_at_mm": [0, 0, 0], "wrinkle_height_mm": 1.5,
            "wrinkle_length_mm": 20.0, "wrinkle_at_mm": [1, 2, 3], "locking_angle_deg": 50,
            "area_share_beyond_locking_angle": 0.1, "draw_in_mm": {"mean": 1.0, "largest": 2.0},
            "draw_in_yarns_mm": walks(), "draw_in_bisectors_mm": walks()}


def summary(plies=("lower", "upper"), tools=("punch",), grips=("grip",)) -> dict:
    return {"title": "made up", "version": "1", "status": "doubtful", "message": "do not trust it",
            "time_s": 0.1, "stroke_mm": 5.0, "wall_time_s": 1.0, "steps": 10,
            "time_step_s": {"min": 1e-5, "max": 1e-4}, "threads": 1, "elements": 64, "nodes": 50,
            "plies": [ply(name) for name in plies],
            "tools": [{"name": name, "force_N": 9.0, "displacement_mm": 5.0} for name in tools],
            "boundaries": [{"name": name, "force_N": 1.0, "displacement_mm": 0.0} for name in grips],
            "energy": {"fibre": 1.0, "shear": 2.0, "kinetic": 0.01, "balance_error": 0.001},
            "accuracy": {"promised_shear_error_deg": 1.0, "inertia_deg": 0.5, "softening_deg": 0.5,
                         "mesh_deg": 0.5, "element_size_factor": 1.0},
            "contact": {"max_tool_penetration_mm": 0.01, "max_ply_penetration_mm": 0.01,
                        "intersections_between_plies": 0, "intersections_within_plies": 0},
            "pairs": [{"a": plies[0], "b": tools[0], "deepest_mm": 0.1}],
            "assumed": ["something"], "could_be_left_out": [], "missing": ["do not trust it", "a finer mesh"],
            "doubts": ["do not trust it"], "advice": ["a finer mesh"], "figures": figures()}


def figures() -> dict:
    """What plyform says of some of them: path, label, unit, digits."""
    of_plies = (("max_shear_deg", "largest shear", "deg", 1),
                ("p99_shear_deg", "shear that 99 % have less than", "deg", 1),
                ("rms_shear_deg", "shear, rms", "deg", 1),
                ("area_share_beyond_locking_angle", "area beyond locking", "1", 1),
                ("max_pressed_strain", "largest compression", "1", 2),
                ("wrinkle_height_mm", "highest wrinkle", "mm", 2),
                ("draw_in_mm.mean", "draw-in", "mm", 1))
    of_run = (("stroke_mm", "stroke", "mm", 2), ("wall_time_s", "time", "s", 1))
    verified = {"rms_shear_deg": "shear", "draw_in_mm.mean": "draw-in"}
    return {kind: {name: {"label": label, "unit": unit, "digits": digits, "compared": True,
                          **({"verified": verified[name]} if name in verified else {})}
                   for name, label, unit, digits in rows}
            for kind, rows in (("plies", of_plies), ("run", of_run))}


HISTORY = """time_s,stroke_mm,punch_force_N,grip_force_N,fibre_mJ,shear_mJ,kinetic_mJ
0,0,0,0,0,0,0
0.1,5,9,1,1,2,0.01
"""


def write(folder: Path, families=None, **names) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    write_h5(folder / "results.h5", families=families, **names)
    (folder / "summary.json").write_text(json.dumps(summary(**names)), encoding="utf-8")
    (folder / "history.csv").write_text(HISTORY, encoding="utf-8")
    return folder
