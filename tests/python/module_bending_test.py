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


def number(found, name):
    return found.numbers[name].value


def check_same(folder, words, curve, **options):
    """What the program writes into a fabric file for this curve, and what the module does."""
    table = folder / "curve.csv"
    np.savetxt(table, np.stack(list(curve.values()), axis=1), delimiter=",", header=",".join(curve), comments="",
               fmt="%.17g")
    given = [word for key, value in options.items() for word in (f"--{key.replace('_', '-')}", str(value))]
    subprocess.run([program, "identify", *words, table, *given, "--fabric", GLASS, "-o", folder / "program.toml"],
                   check=True, capture_output=True)
    found = plyform.identify(words[0], curve, GLASS, folder / "module.toml", **options)
    lines = [[line for line in (folder / name).read_text(encoding="utf-8").splitlines() if "Identified" not in line]
             for name in ("program.toml", "module.toml")]
    assert lines[0] == lines[1], lines
    return found


def check_cantilever(folder):
    overhang, angle = np.array([96.0, 100.0, 104.0]), np.full(3, 41.5)  # c = L/2
    curve = {"overhang (mm)": overhang, "angle (deg)": angle}
    fit = check_same(folder, ["cantilever"], curve, direction="both")
    assert abs(number(fit, "bending length") / 50.0 - 1.0) < 2e-3 and number(fit, "rows") == 3
    stiffness = fit.numbers["bending_stiffness"]
    assert abs(stiffness.value / (WEIGHT * number(fit, "bending length")**3) - 1.0) < 1e-3 and stiffness.limits > 0.0
    assert np.isclose(value_in(folder / "module.toml", "weft.bending_stiffness"), stiffness.value, rtol=1e-6)
    again = plyform.identify("cantilever", [folder / "curve.csv", curve], GLASS, direction="warp")
    assert np.isclose(number(again, "bending_stiffness"), stiffness.value) and len(again.notes) == 2
    low = {"overhang (mm)": overhang, "deflection (mm)": 0.3 * overhang}
    assert number(plyform.identify("cantilever", low, GLASS, direction="warp", reading="deflection"),
                  "bending_stiffness") > 0.0
    raised(ValueError, plyform.identify, "cantilever", curve, GLASS, direction="warp", reading="sag")
    steep = {**curve, "angle (deg)": 10 * angle}
    error = raised(plyform.CaseError, plyform.identify, "cantilever", steep, GLASS, direction="warp")
    assert error.mistakes[0].remedy


def check_three_point(folder):
    known = {"span": 60.0, "width": 50.0, "compliance": 0, "direction": "warp"}
    deflection = np.linspace(0.3, 6.0, 20)
    force = 48.0 * 2.0 * 50.0 * deflection / 60.0**3

    def curve(x, y):
        return {"deflection (mm)": x, "force (N)": y}
    fit = check_same(folder, ["three-point"], curve(deflection, force), toe=0, zero=0, **known)
    assert np.isclose(number(fit, "bending_stiffness"), 2.0, rtol=1e-6) and number(fit, "residuals rms") < 1e-4
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        check_same(folder, ["three-point"], curve(deflection, force * (1.0 - 0.09 * deflection)), toe=0, zero=0,
                   **known)
    assert len(value_in(folder / "module.toml", "warp.bending_table")) == 7
    found = plyform.identify("three-point", curve(deflection + 0.5, force), GLASS, toe="fit", **known)
    assert np.isclose(number(found, "bending_stiffness"), 2.0, rtol=1e-3)
    raised(plyform.CaseError, plyform.identify, "three-point", curve(deflection, force), GLASS,
           **{**known, "span": 0.0})


def check_zone(folder):
    distance = np.linspace(0.0, 60.0, 13)
    shear = 8.0 - 8.0 * np.exp(-distance / 10.0)  # degrees
    curve = {"distance (mm)": distance, "shear (deg)": shear}
    fit = check_same(folder, ["in-plane-bending"], curve, direction="both")
    slope = 0.37044 + 3 * 0.84105 * np.radians(8.0)**2 + 5 * 1.03113 * np.radians(8.0)**4
    assert np.isclose(number(fit, "width of the zone"), 10.0, rtol=1e-5)
    assert np.isclose(number(fit, "in_plane_bending_stiffness"), 0.0625 * slope * 100.0, rtol=1e-4)
    assert np.allclose(fit.fit["measured_deg"], shear) and np.allclose(fit.fit["fitted_deg"], shear, atol=1e-3)
    bare = folder / "bare.toml"
    bare.write_text(GLASS.read_text(encoding="utf-8").split("[shear]")[0], encoding="utf-8")
    error = raised(plyform.CaseError, plyform.identify, "in-plane-bending", curve, bare, direction="warp")
    assert error.mistakes[0].item == "shear"


def check_compression(folder):
    strain = np.linspace(0.0005, 0.02, 40)
    known = {"zero": 0, "toe": 0, "direction": "warp"}

    def curve(force):
        return {"strain": strain, "force (N)": force}
    kinked = 25 * (500.0 * np.minimum(strain, 0.008) + 5.0 * np.maximum(strain - 0.008, 0.0))
    check_same(folder, ["compression"], curve(kinked), yarns=25, **known)
    assert np.isclose(value_in(folder / "module.toml", "warp.compression_stiffness"), 500.0, rtol=1e-3)
    assert np.isclose(value_in(folder / "module.toml", "warp.buckling_force"), 4.0, rtol=1e-2)
    plyform.identify("compression", curve(500.0 * strain), folder / "module.toml", folder / "both.toml",
                     **{**known, "direction": "weft"})
    assert value_in(folder / "both.toml", "warp.buckling_force") is not None
    assert value_in(folder / "both.toml", "weft.buckling_force") is None
    error = raised(plyform.CaseError, plyform.identify, "compression", curve(1e5 * strain), GLASS,
                   folder / "stiff.toml", **known)
    assert "in tension, 46000" in error.mistakes[0].rule and not (folder / "stiff.toml").exists()
    raised(ValueError, plyform.identify, "compression", curve(500.0 * strain), GLASS, direction="bias")


with tempfile.TemporaryDirectory() as name:
    for check in (check_cantilever, check_three_point, check_zone, check_compression):
        own = Path(name) / check.__name__
        own.mkdir()
        check(own)
print("bending and compression are as in the program")
