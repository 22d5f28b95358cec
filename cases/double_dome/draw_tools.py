#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the tools of the double dome as STEP files, by gmsh's Open CASCADE (python3-gmsh).

    draw_tools.py [FOLDER]

writes punch.step, die.step and blank_holder.step there, or beside this file; tools/mesh_tool.py makes
meshes of them. All lengths in mm; the die's top is z = 0, and so are the punch's lowest line and the
blank-holder's face. Exit codes: 0 done, 1 not."""

import sys
from pathlib import Path

import gmsh

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from step_file import write_step  # noqa: E402

HALF = 75.0            # half the distance of the domes' centres, along x
RADIUS = 60.0          # of both domes, and of the ridge between them
OPENING = 64.0         # of the die, from the same centres: the stack has 4 mm
DIE_FILLET = 6.0
HOLDER_OPENING = 72.0  # outside of the die's fillet
HOLDER_FILLET = 8.0
PLATE = (560.0, 360.0)  # beyond the blank
OCC = gmsh.model.occ


def stadium(radius: float, bottom: float, height: float) -> list:
    """A prism along z whose section is two half circles and what lies between them."""
    parts = [(3, OCC.addCylinder(x, 0, bottom, 0, 0, height, radius)) for x in (-HALF, HALF)]
    parts.append((3, OCC.addBox(-HALF, -radius, bottom, 2 * HALF, 2 * radius, height)))
    return OCC.fuse(parts[:1], parts[1:])[0]


def punch() -> None:
    parts = [(3, OCC.addSphere(x, 0, RADIUS, RADIUS)) for x in (-HALF, HALF)]
    parts.append((3, OCC.addCylinder(-HALF, 0, RADIUS, 2 * HALF, 0, 0, RADIUS)))
    parts += stadium(RADIUS, RADIUS, 20.0)
    whole = OCC.fuse(parts[:1], parts[1:])[0]
    OCC.intersect(whole, [(3, OCC.addBox(-200, -200, -1, 400, 400, RADIUS + 21.0))])


def plate(opening: float, bottom: float, height: float, edge: float, fillet: float) -> None:
    """A plate with an opening whose edge at the height `edge` is rounded."""
    whole = [(3, OCC.addBox(-PLATE[0] / 2, -PLATE[1] / 2, bottom, *PLATE, height))]
    solid = OCC.cut(whole, stadium(opening, bottom - 1.0, height + 2.0))[0]
    OCC.synchronize()
    around = HALF + opening + 1.0  # a box about that edge alone
    edges = gmsh.model.getEntitiesInBoundingBox(-around, -around, edge - 1.0, around, around,
                                                edge + 1.0, 1)
    OCC.fillet([solid[0][1]], [tag for _, tag in edges], [fillet])


TOOLS = {
    "punch": punch,
    "die": lambda: plate(OPENING, -75.0, 75.0, 0.0, DIE_FILLET),
    "blank_holder": lambda: plate(HOLDER_OPENING, 0.0, 20.0, 0.0, HOLDER_FILLET),
}


def main() -> None:
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent
    for name, draw in TOOLS.items():
        path = folder / f"{name}.step"
        write_step(path, lambda _, draw=draw: draw())
        print(path)


if __name__ == "__main__":
    main()
