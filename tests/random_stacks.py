#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Forms stacks of plies at angles drawn at random as cases/hemisphere_five_ply does, with the die's
clearance to suit, and checks that no run stops and no triangles of different plies cross.

    tests/random_stacks.py PROGRAM [--plies 1 5 10 20] [--seed 1] [--element-size 6.8] [-o FOLDER]

Exits with 1 if a run does not end soundly."""

import argparse
import json
import random
import subprocess
import sys
from pathlib import Path

THICKNESS = 0.6  # mm, of the glass weave
PUNCH = 75.0     # mm, radius
CLEARANCE = 2.0  # mm, between the stack and the wall of the die's hole, 80 mm wide at least

CASE = """title = "{count} plies at random angles, seed {seed}"
[fabrics]
glass = "{fabric}"
[blanks.square]
size = [340.0, 340.0]
mesh = "alternating"
element_size = {size}
[stack]
bottom = 0.0
{plies}
[[tool]]
name = "punch"
shape = "sphere"
radius = {punch}
position = [0.0, 0.0, {centre}]
motion = "driven"
direction = [0.0, 0.0, -1.0]
stroke = {punch}
[[tool]]
name = "die"
shape = "profile"
points = [[{hole}, -120.0], [{hole}, 0.0, 10.0], [400.0, 0.0]]
[[tool]]
name = "blank_holder"
shape = "annulus"
inner_radius = {inner}
outer_radius = 300.0
thickness = 10.0
position = [0.0, 0.0, {top}]
motion = "force"
direction = [0.0, 0.0, -1.0]
force = 300.0
[contact]
friction = 0.2
[solver]
step_factor = 0.9
duration = 0.1
fibre_softening = 100.0
"""

PLY = """[[ply]]
name = "ply{number}"
fabric = "glass"
blank = "square"
angle = {angle}
"""


def case_text(count: int, seed: int, size: float, fabric: Path) -> str:
    draw = random.Random(1000 * seed + count)
    plies = "".join(PLY.format(number=i + 1, angle=round(draw.uniform(-90.0, 90.0), 1))
                    for i in range(count))
    top = THICKNESS * count
    hole = max(80.0, PUNCH + top + CLEARANCE)
    return CASE.format(count=count, seed=seed, fabric=fabric, size=size, plies=plies, punch=PUNCH,
                       centre=PUNCH + top, hole=hole, inner=hole + 12.0, top=top)


def form(program: str, folder: Path, count: int, seed: int, size: float) -> bool:
    """Runs one stack; prints a line; whether it is sound."""
    folder.mkdir(parents=True, exist_ok=True)
    fabric = Path(__file__).resolve().parents[1] / "cases/fabrics/glass_plain_weave.toml"
    case = folder / f"stack_{count}.toml"
    case.write_text(case_text(count, seed, size, fabric), encoding="utf-8")
    results = folder / f"stack_{count}"
    code = subprocess.run([program, "run", str(case), "-o", str(results)],
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if code.returncode != 0:
        print(f"{count} plies: {code.stderr.strip().splitlines()[-2:]}", flush=True)
        return False
    told = json.loads((results / "summary.json").read_text(encoding="utf-8"))
    contact, shear = told["contact"], max(ply["max_shear_deg"] for ply in told["plies"])
    crossing = contact["intersections_between_plies"] + contact["intersections_within_plies"]
    print(f"{count} plies: {told['status']}, {told['elements']} triangles, {told['steps']} steps, "
          f"{told['wall_time_s']:.0f} s, crossing {crossing}, "
          f"depth {contact['max_tool_penetration_mm']:.3f} / "
          f"{contact['max_ply_penetration_mm']:.3f} mm, largest shear {shear:.1f} deg, "
          f"balance {told['energy']['balance_error']:.1e}", flush=True)
    return told["status"] in ("done", "doubtful") and contact["intersections_between_plies"] == 0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("program", help="plyform")
    parser.add_argument("--plies", type=int, nargs="+", default=[1, 5, 10, 20])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--element-size", type=float, default=6.8, help="mm")
    parser.add_argument("-o", "--output", type=Path, default=Path("results/random_stacks"))
    options = parser.parse_args()
    sound = [form(options.program, options.output, count, options.seed, options.element_size)
             for count in options.plies]
    sys.exit(0 if all(sound) else 1)


if __name__ == "__main__":
    main()
