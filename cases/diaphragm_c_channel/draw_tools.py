#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the tool of the C-channel as a STEP file, by gmsh's Open CASCADE (python3-gmsh).

    draw_tools.py [FOLDER]

writes channel.step there, or beside this file; tools/mesh_tool.py makes a mesh of it. A block on a
plate, both one piece: edges and feet of the block are rounded. All lengths in mm; the block's top,
on which the web is formed, is z = 0. Exit codes: 0 done, 1 not."""

import sys
from pathlib import Path

import gmsh

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from step_file import write_step  # noqa: E402

WEB = 60.0      # width of the block
DEPTH = 40.0    # of the flanges: the plate lies that far below the web
RADIUS = 8.0    # of the block's edges, and of the hollows at its feet
PLATE = (400.0, 20.0)  # width, thickness
LENGTH = 300.0  # along y: beyond the frame of the membranes


def draw(occ) -> None:
    block = (3, occ.addBox(-WEB / 2, -LENGTH / 2, -DEPTH, WEB, LENGTH, DEPTH))
    plate = (3, occ.addBox(-PLATE[0] / 2, -LENGTH / 2, -DEPTH - PLATE[1], PLATE[0], LENGTH, PLATE[1]))
    (_, whole), = occ.fuse([block], [plate])[0]
    occ.synchronize()
    edges = []
    for x in (-WEB / 2, WEB / 2):
        for z in (-DEPTH, 0.0):
            low, high = (x - 1e-3, -LENGTH / 2 - 1, z - 1e-3), (x + 1e-3, LENGTH / 2 + 1, z + 1e-3)
            edges += [tag for _, tag in gmsh.model.getEntitiesInBoundingBox(*low, *high, 1)]
    occ.fillet([whole], edges, [RADIUS])
    occ.synchronize()


def main() -> None:
    path = (Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent) / "channel.step"
    write_step(path, draw)
    print(path)


if __name__ == "__main__":
    main()
