# SPDX-License-Identifier: GPL-3.0-or-later
"""STEP files for the tests, drawn by gmsh."""

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
