# SPDX-License-Identifier: GPL-3.0-or-later
"""Bending and compression in the module `plyform`: laws that are known, and what the program says of
the same curves.

    module_bending_test.py PACKAGE_FOLDER PROGRAM SOURCE_FOLDER
"""

import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

sys.path.insert(0, sys.argv[1])
program, source = Path(sys.argv[2]).resolve(), Path(sys.argv[3]).resolve()

import numpy as np  # noqa: E402
import plyform  # noqa: E402
from raised_exception import raised  # noqa: E402

GLASS = source / "cases/fabrics/glass_plain_weave.toml"
WEIGHT = 600e-6 * 9.81e-3  # N/mm2, of 600 g/m2


def value_in(fabric, key):
    """A key of a fabric, as a case that names it has it."""
    case = plyform.Case(source / "cases/hemisphere_0", {"fabrics.glass": fabric})
    return case.get(f"fabrics.glass.{key}")


def check_same(folder, words, curve, header, fit, key, yarns="warp"):
    """What the program writes into a fabric file for this curve, and what `fit` writes."""
    table = folder / "curve.csv"
    np.savetxt(table, np.stack(curve, axis=1), delimiter=",", header=header, comments="",
               fmt="%.17g")
    subprocess.run([program, "identify", *words, table, "--direction", yarns, "--fabric", GLASS,
                    "-o", folder / "program.toml"], check=True, capture_output=True)
    fit.write(yarns, GLASS, folder / "module.toml")
    for family in ("warp", "weft") if yarns == "both" else (yarns,):
        found = value_in(folder / "module.toml", f"{family}.{key}")
        assert found is not None
        assert np.allclose(found, value_in(folder / "program.toml", f"{family}.{key}"), rtol=2e-6)
    return table


def check_cantilever(folder):
    overhang, angle = np.array([96.0, 100.0, 104.0]), np.full(3, 41.5)  # c = L/2
    fit = plyform.identify_cantilever((overhang, angle), GLASS)
    assert abs(fit.bending_length_mm / 50.0 - 1.0) < 2e-3 and fit.rows == 3
    assert abs(fit.stiffness / (WEIGHT * fit.bending_length_mm**3) - 1.0) < 1e-3
    assert fit.limits > 0.0 and len(fit.table_moment_N) == 0
    table = check_same(folder, ["cantilever"], (overhang, angle), "overhang (mm),angle (deg)", fit,
                       "bending_stiffness", "both")
    again = plyform.identify_cantilever([table, table], GLASS)
    assert np.isclose(again.stiffness, fit.stiffness) and len(again.of_specimens) == 2
    low = plyform.identify_cantilever((overhang, 0.3 * overhang), GLASS, reading="deflection")
    assert low.stiffness > 0.0
    raised(ValueError, plyform.identify_cantilever, table, GLASS, reading="sag")
    error = raised(plyform.CaseError, plyform.identify_cantilever, (overhang, 10 * angle), GLASS)
    assert error.mistakes[0].remedy


def check_three_point(folder):
    sizes = {"span": 60.0, "width": 50.0}
    deflection = np.linspace(0.3, 6.0, 20)
    force = 48.0 * 2.0 * 50.0 * deflection / 60.0**3
    known = dict(compliance=0, toe=0, zero=0)
    fit = plyform.identify_three_point((deflection, force), GLASS, **sizes, **known)
    assert np.isclose(fit.stiffness, 2.0, rtol=1e-6) and fit.rms < 1e-6
    check_same(folder, ["three-point", "--span", "60", "--width", "50", "--compliance", "0",
                        "--toe", "0", "--zero", "0"], (deflection, force),
               "deflection (mm),force (N)", fit, "bending_stiffness")
    softening = force * (1.0 - 0.09 * deflection)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        table = plyform.identify_three_point((deflection, softening), GLASS, **sizes, **known)
    assert len(table.table_curvature) == 7 and table.table_curvature[0] == 0.0
    check_same(folder, ["three-point", "--span", "60", "--width", "50", "--compliance", "0",
                        "--toe", "0", "--zero", "0"], (deflection, softening),
               "deflection (mm),force (N)", table, "bending_table")
    off = deflection + 0.5, force
    found = plyform.identify_three_point(off, GLASS, **sizes, compliance=0, toe="fit")
    assert np.isclose(found.stiffness, 2.0, rtol=1e-3)
    raised(ValueError, plyform.identify_three_point, off, GLASS, span=0.0, width=50.0)


def check_zone(folder):
    distance = np.linspace(0.0, 60.0, 13)
    shear = 8.0 - 8.0 * np.exp(-distance / 10.0)  # degrees
    fit = plyform.identify_in_plane_bending((distance, shear), GLASS)
    slope = 0.37044 + 3 * 0.84105 * np.radians(8.0)**2 + 5 * 1.03113 * np.radians(8.0)**4
    assert np.isclose(fit.length_mm, 10.0, rtol=1e-5) and np.isclose(fit.plateau_deg, 8.0)
    assert np.isclose(fit.stiffness, 0.0625 * slope * 100.0, rtol=1e-4)
    assert np.allclose(fit.measured_deg, shear) and np.allclose(fit.fitted_deg, shear, atol=1e-3)
    check_same(folder, ["in-plane-bending"], (distance, shear), "distance (mm),shear (deg)", fit,
               "in_plane_bending_stiffness", "both")
    bare = folder / "bare.toml"
    bare.write_text(GLASS.read_text(encoding="utf-8").split("[shear]")[0], encoding="utf-8")
    error = raised(plyform.CaseError, plyform.identify_in_plane_bending, (distance, shear), bare)
    assert error.mistakes[0].item == "shear"


def check_compression(folder):
    strain = np.linspace(0.0005, 0.02, 40)
    force = 25 * (500.0 * np.minimum(strain, 0.008) + 5.0 * np.maximum(strain - 0.008, 0.0))
    fit = plyform.identify_compression((strain, force), yarns=25, zero=0, toe=0)
    assert np.isclose(fit.stiffness, 500.0, rtol=1e-3)
    assert np.isclose(fit.buckling_force, 4.0, rtol=1e-2)
    check_same(folder, ["compression", "--yarns", "25", "--zero", "0", "--toe", "0"],
               (strain, force), "strain,force (N)", fit, "compression_stiffness")
    assert np.isclose(value_in(folder / "module.toml", "warp.buckling_force"),
                      value_in(folder / "program.toml", "warp.buckling_force"), rtol=2e-6)
    line = plyform.identify_compression((strain, 500.0 * strain))
    assert line.buckling_force is None
    line.write("weft", folder / "module.toml", folder / "both.toml")
    assert value_in(folder / "both.toml", "warp.buckling_force") is not None
    assert value_in(folder / "both.toml", "weft.buckling_force") is None
    stiff = plyform.identify_compression((strain, 1e5 * strain))
    error = raised(plyform.CaseError, stiff.write, "warp", GLASS, folder / "stiff.toml")
    assert "in tension, 46000" in error.mistakes[0].rule and not (folder / "stiff.toml").exists()
    raised(ValueError, line.write, "bias", GLASS, folder / "stiff.toml")


with tempfile.TemporaryDirectory() as name:
    for check in (check_cantilever, check_three_point, check_zone, check_compression):
        own = Path(name) / check.__name__
        own.mkdir()
        check(own)
print("bending and compression are as in the program")
