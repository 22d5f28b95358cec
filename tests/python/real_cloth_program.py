#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Stands for plyform in real_cloth_test.py: writes made-up results at once.

Beside it lies orders.json: for names of runs "hang", "fail", "stopped", or keys of summary.json's
contact and energy with what to write there. Each call adds a line to calls.txt."""

import json
import sys
import time
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, (HERE / "tests_folder").read_text(encoding="utf-8"))
import plot_folders  # noqa: E402

PLIES = ["ply1", "ply2", "ply3"]


def summary(order: dict) -> dict:
    status = "stopped" if order.get("stopped") else "done"
    return {
        "status": status, "message": "made up" if status == "stopped" else "",
        "stroke_mm": 40 if status == "stopped" else 75, "steps": 100, "elements": 96,
        "wall_time_s": 1.5,
        "plies": [{"name": name, "angle_deg": 45 * (i % 2), "max_shear_deg": 44.4 + i,
                   "rms_shear_deg": 20.2 + i, "max_pressed_strain": order.get("pressed", 0.012),
                   "area_share_pressed_over_2_percent": 0.1,
                   "area_share_pressed_over_5_percent": 0.0} for i, name in enumerate(PLIES)],
        "tools": [{"name": "punch", "force_N": 321.0}],
        "energy": {"balance_error": order.get("balance_error", -0.002)},
        "contact": {"max_tool_penetration_mm": 0.07, "max_ply_penetration_mm": 0.11,
                    "intersections_between_plies": order.get("crossing", 0),
                    "intersections_within_plies": 0},
        "pairs": [{"a": "punch", "b": "ply3", "deepest_mm": 0.08},
                  {"a": "ply2", "b": "ply3", "deepest_mm": 0.09},
                  {"a": "ply1", "b": "ply2", "deepest_mm": order.get("deepest", 0.125)}]}


def main() -> int:
    words = sys.argv[1:]
    assert words[0] == "run" and "--threads" in words, words
    folder = Path(words[words.index("-o") + 1])
    name = folder.name.split(".running.")[0]
    with open(HERE / "calls.txt", "a", encoding="utf-8") as calls:
        calls.write(json.dumps([name, *words]) + "\n")
    order = json.loads((HERE / "orders.json").read_text(encoding="utf-8")).get(name, {})
    while "hang" in order and folder.is_dir():
        time.sleep(0.05)
    if not folder.is_dir():
        return 1
    if "fail" in order:
        print("made-up trouble")
        return 2
    x0, triangles = plot_folders.grid(8, 100.0)
    shear = 20.0 * np.sin(x0[triangles].mean(axis=1)[:, 0] / 30.0) + order.get("shift", 0.0)
    made = folder / "made"
    plot_folders.write(made, {ply: (x0, x0, triangles, shear) for ply in PLIES})
    (made / "results.h5").rename(folder / "results.h5")
    (folder / "summary.json").write_text(json.dumps(summary(order)), encoding="utf-8")
    return 3 if "stopped" in order else 0


if __name__ == "__main__":
    sys.exit(main())
