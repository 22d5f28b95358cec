# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes what a case's draw_tools.py draws as STEP files, by gmsh's Open CASCADE (python3-gmsh)."""

import os
import sys

import gmsh


def write_step(path, build):
    """`build` draws with gmsh.model.occ; without what Open CASCADE prints."""
    sys.stdout.flush()
    out, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        gmsh.initialize([], False)
        gmsh.option.setNumber("General.Terminal", 0)
        build(gmsh.model.occ)
        gmsh.model.occ.synchronize()
        gmsh.write(str(path))
        gmsh.finalize()
    finally:
        os.dup2(out, 1)
        os.close(out)
        os.close(nowhere)
