#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the part of the matched moulds, a double dome with a flange, as an open shell in a STEP file, by
gmsh's Open CASCADE (python3-gmsh).

    draw_tools.py [FOLDER]

writes part.step there, or beside this file; tools/mesh_tool.py makes both moulds of it (README.md). All
lengths in mm; the flange is z = 0, the domes rise from it. Exit codes: 0 done, 1 not."""

import sys
from pathlib import Path

import gmsh

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from step_file import write_step  # noqa: E402

HALF = 75.0            # half the distance of the domes' centres, along x
RADIUS = 60.0          # of both domes, and of the ridge between them
SUNK = 15.0            # their centres below the flange: walls lean by 14 degrees there
FILLET = 15.0          # between domes and flange
FLANGE = (400.0, 260.0)


def draw(occ) -> None:
    parts = [(3, occ.addSphere(x, 0, -SUNK, RADIUS)) for x in (-HALF, HALF)]
    parts.append((3, occ.addCylinder(-HALF, 0, -SUNK, 2 * HALF, 0, 0, RADIUS)))
    parts.append((3, occ.addBox(-FLANGE[0] / 2, -FLANGE[1] / 2, -90.0, *FLANGE, 90.0)))
    solid = occ.fuse(parts[:1], parts[1:])[0]
    occ.synchronize()
    around = HALF + RADIUS + 1.0
    seam = gmsh.model.getEntitiesInBoundingBox(-around, -RADIUS - 1, -0.1, around, RADIUS + 1, 0.1, 1)
    solid = occ.fillet([solid[0][1]], [tag for _, tag in seam], [FILLET])
    occ.synchronize()
    above = [face for face in gmsh.model.getEntities(2) if gmsh.model.getBoundingBox(*face)[2] > -0.1]
    occ.remove(solid)
    occ.remove([face for face in gmsh.model.getEntities(2) if face not in above], recursive=True)
    occ.synchronize()


def main() -> None:
    path = (Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent) / "part.step"
    write_step(path, draw)
    print(path)


if __name__ == "__main__":
    main()
