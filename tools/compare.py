#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of result folders of plyform side by side, in Markdown (keys: docs/users/results.md).

    compare.py DIR... [--against DIR] [--json FILE]

With --against, first how far the shear angles and the largest tension of each ply are from those
of another folder, whatever the meshes: at 60 x 60 points of the unformed ply, between nodal means.

One row a ply and folder with shear angles, tension, strains, what says whether cloth can be so, and
draw-in: of the four walks along the yarns, and of the four along the lines that halve the angles
between them, the mean, and in brackets the largest less the smallest (docs/users/results.md). Then one
row a folder with forces, and one with what a run is judged by.

Exit codes: 0 done, 1 something is missing or cannot be read, 2 wrong arguments.
"""

import argparse
import json
import sys
from pathlib import Path

try:
    import numpy as np
    from plotting.numbers import values_at
    from base.ending import EXIT_OTHER, ended, one_line
    from base.summary_figures import described
    from plotting.reading import SHEAR, Ply, Trouble, read_state, read_summary
    from plotting.reading import ended as has_ended
    from plotting.whole_file import write_whole
except ImportError as error:
    sys.exit(f"compare.py: error: {error}; install python3-h5py")

NONE = "–"


def shear_difference(ply: Ply, other: Ply) -> dict:
    """Rms and largest difference of the shear angle, degrees."""
    low, high = other.x0.min(axis=0)[:2], other.x0.max(axis=0)[:2]
    steps = (np.arange(60) + 0.5) / 60  # off the border, where meshes may differ by rounding
    points = low + np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2) * (high - low)
    apart = (values_at(points, ply.x0, ply.triangles, ply.value) -
             values_at(points, other.x0, other.triangles, other.value))
    apart = apart[np.isfinite(apart)]
    if len(apart) == 0:
        raise Trouble(f"ply {ply.name} covers no point of that of the other folder")
    return {"rms_shear_difference_deg": float(np.sqrt(np.mean(apart ** 2))),
            "max_shear_difference_deg": float(abs(apart).max())}


def read_reference(folder: Path) -> dict[str, tuple[Ply, float | None]]:
    """What --against compares with: each ply with its largest tension."""
    tensions = {ply["name"]: ply.get("max_tension_N_per_yarn")
                for ply in read_summary(folder)["plies"]}
    return {ply.name: (ply, tensions.get(ply.name))
            for ply in read_state(folder, SHEAR).plies}


def read_run(folder: Path, reference: dict[str, tuple[Ply, float | None]]) -> dict:
    """The summary and the folder and, of each ply that the reference has, how far it is from
    that."""
    run = {"folder": one_line(folder), **read_summary(folder)}
    plies = {ply.name: ply for ply in read_state(folder, SHEAR).plies}
    if list(plies) != [ply.get("name") for ply in run["plies"]]:
        raise Trouble(f"{folder}: summary.json and results.h5 have different plies: "
                      "are they of one run?")
    for ply in run["plies"]:
        if ply["name"] in reference:
            other, theirs = reference[ply["name"]]
            mine = ply.get("max_tension_N_per_yarn")
            ply.update(shear_difference(plies[ply["name"]], other),
                       tension_ratio=mine / theirs if mine and theirs else None)
    return run


def labels(folders: list[Path]) -> list[str]:
    """Last part of each path, or the paths where two have the same."""
    names = [folder.resolve().name for folder in folders]
    shown = names if len(set(names)) == len(names) else [str(folder) for folder in folders]
    return [one_line(name) for name in shown]


def number(value, form: str) -> str:
    if value is None:
        return NONE
    if not isinstance(value, (int, float)):
        raise Trouble(f"summary.json: {value!r} stands where a number should")
    return format(value, form)


def with_spread(walks: dict | None) -> str:
    if walks is None:
        return NONE
    mean = number(walks.get("mean"), ".1f")
    return f"{'0.0' if mean == '-0.0' else mean} ({number(walks.get('spread'), '.1f')})"


def table(head: list[str], rows: list[list[str]], texts: int) -> str:
    """In Markdown; the first `texts` columns are text, the others numbers."""
    lines = [head, ["---"] * texts + ["---:"] * (len(head) - texts), *rows]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |"
                     for line in lines)


def ply_table(runs: list[dict], names: list[str]) -> str:
    """Of the figures that runs are compared by, those that any of them has."""
    figures = {name: one for run in runs for name, one in described(run, "plies").items() if one.compared}
    head = ["folder", "ply", "angle, °",
            *(f"{one.label}, {one.shown_unit}" if one.unit else one.label for one in figures.values()),
            "draw-in along the yarns, mm", "along the bisectors, mm"]
    rows = [[name, ply["name"], number(ply.get("angle_deg"), "g"),
             *(number(one.of(ply), f".{one.digits}f") for one in figures.values()),
             *(with_spread(ply.get(f"draw_in_{key}_mm")) for key in ("yarns", "bisectors"))]
            for run, name in zip(runs, names) for ply in run["plies"]]
    return table(head, rows, 2)


def difference_table(runs: list[dict], names: list[str]) -> str:
    head = ["folder", "ply", "triangles", "shear angle: rms difference, °", "largest, °",
            "largest tension over the other's", "steps"]
    rows = [[name, ply["name"], number(run.get("elements"), ".0f"),
             *(number(ply[f"{key}_shear_difference_deg"], ".2f") for key in ("rms", "max")),
             number(ply["tension_ratio"], ".2f"), number(run.get("steps"), ".0f")]
            for run, name in zip(runs, names) for ply in run["plies"]
            if "rms_shear_difference_deg" in ply]
    return table(head, rows, 2) if rows else ""


def force_table(runs: list[dict], names: list[str]) -> str:
    of_run = [{body["name"]: body.get("force_N") for body in run["tools"] +
               run.get("boundaries", [])} for run in runs]
    bodies = list(dict.fromkeys(body for forces in of_run for body in forces))
    rows = [[name, number(run.get("stroke_mm"), ".4g"),
             *(number(forces.get(body), ".1f") for body in bodies)]
            for run, name, forces in zip(runs, names, of_run)]
    return table(["folder", "stroke, mm", *(f"{body}, N" for body in bodies)], rows, 1)


def run_table(runs: list[dict], names: list[str]) -> str:
    head = ["folder", "status", "energy balance error", "kinetic / shear energy",
            "penetration into tools, mm", "between plies, mm", "crossings between plies",
            "within plies", "steps", "threads", "wall time, s"]
    rows = []
    for run, name in zip(runs, names):
        energy, contact = run["energy"], run["contact"]
        kinetic, shear = energy.get("kinetic"), energy.get("shear")
        ratio = kinetic / shear if kinetic is not None and shear else None
        rows.append([
            name, run["status"], number(energy.get("balance_error"), ".1e"), number(ratio, ".1e"),
            *(number(contact.get(f"max_{of}_penetration_mm"), ".3f") for of in ("tool", "ply")),
            *(number(contact.get(f"intersections_{of}_plies"), ".0f") for of in
              ("between", "within")),
            number(run.get("steps"), ".0f"), number(run.get("threads"), ".0f"),
            number(run.get("wall_time_s"), ".1f")])
    return table(head, rows, 2)


def remarks(runs: list[dict], names: list[str]) -> str:
    """What the tables cannot say: why runs ended early, what not to trust and why draw-ins are
    missing."""
    lines = [f"- {name} is {'doubtful' if has_ended(run) else 'not done (' + run['status'] + ')'}: "
             f"{run.get('message') or 'no reason given'}"
             for run, name in zip(runs, names) if run["status"] != "done"]
    lines += [f"- {name}, ply {ply['name']}: no draw-in, {ply['no_draw_in']}"
              for run, name in zip(runs, names) for ply in run["plies"] if "no_draw_in" in ply]
    return "\n".join(lines)


def run() -> None:
    parser = argparse.ArgumentParser(prog="compare.py", description=__doc__.split("\n", 1)[0])
    parser.add_argument("folders", nargs="+", type=Path, metavar="DIR", help="result folder")
    parser.add_argument("--against", type=Path, metavar="DIR",
                        help="result folder that the others are compared with")
    parser.add_argument("--json", type=Path, metavar="FILE", help="all numbers, with all walks of the draw-in")
    options = parser.parse_args()
    reference = read_reference(options.against) if options.against else {}
    runs = [read_run(folder, reference) for folder in options.folders]
    names = labels(options.folders)
    if options.json:
        write_whole(options.json, json.dumps(runs, indent=2, ensure_ascii=False) + "\n")
    parts = [part(runs, names) for part in
             (difference_table, ply_table, force_table, run_table, remarks)]
    print("\n\n".join(part for part in parts if part))


def main() -> None:
    ended("compare.py", run, wrong=EXIT_OTHER)


if __name__ == "__main__":
    main()
