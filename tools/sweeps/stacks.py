# SPDX-License-Identifier: GPL-3.0-or-later
"""Stacks of plies at angles drawn at random, formed as cases/hemisphere_five_ply forms its five,
with the die's clearance to suit."""

import random

from sweeps.runs import FABRIC, Run

THICKNESS = 0.6  # mm, of the glass weave
PUNCH = 75.0     # mm, radius
CLEARANCE = 2.0  # mm, between the stack and the wall of the die's hole, 80 mm wide at least
FRICTIONS = (0.05, 0.4)

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
thickness = 20.0
edge_radius = 10.0
position = [0.0, 0.0, {top}]
motion = "force"
direction = [0.0, 0.0, -1.0]
force = 300.0
[contact]
friction = {friction}
{pairs}[solver]
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

PAIR = """[[contact.pair]]
between = ["ply{lower}", "ply{upper}"]
friction = {friction}
"""


def case_text(count: int, seed: int, size: float, fabric=FABRIC.name,
              friction: float | str = 0.2) -> str:
    """`friction`: of all pairs; or "random", one for the tools and one between each two
    neighbours. Angles do not depend on it."""
    draw = random.Random(1000 * seed + count)
    plies = "".join(PLY.format(number=i + 1, angle=round(draw.uniform(-90.0, 90.0), 1))
                    for i in range(count))
    pairs = ""
    if friction == "random":
        friction = round(draw.uniform(*FRICTIONS), 3)
        pairs = "".join(PAIR.format(lower=i, upper=i + 1,
                                    friction=round(draw.uniform(*FRICTIONS), 3))
                        for i in range(1, count))
    top = THICKNESS * count
    hole = max(80.0, PUNCH + top + CLEARANCE)
    return CASE.format(count=count, seed=seed, fabric=fabric, size=size, plies=plies, punch=PUNCH,
                       centre=PUNCH + top, hole=hole, inner=hole + 12.0, top=top,
                       friction=friction, pairs=pairs)


def stack_run(count: int, seed: int, size: float, friction: float | str,
              yarns: tuple[tuple[str, float], ...] = (), self_contact: bool = False) -> Run:
    label = f"{count} {'ply' if count == 1 else 'plies'}, seed {seed}"
    return Run(f"stack_{count}_{seed}", label + (", contact.self on" if self_contact else ""),
               text=case_text(count, seed, size, friction=friction), yarns=yarns, stroke_mm=PUNCH,
               settings=('contact.self="on"',) if self_contact else ())
