# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of files under a locale with decimal commas, as programs around the module may set it:
module_locale_test.py FOLDER_OF_MODULE PROGRAM SOURCE_FOLDER

The locale is made here by localedef (Debian: locales), as few machines have one. Answers 77 without.
"""

import json
import locale
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

FABRIC = """[fabrics.f]
surface_density = 600.5
thickness = 0.625
warp = {density = 0.25, stiffness = 46000.5}
weft = {density = 0.25, stiffness = 46000.5}
shear = {polynomial = [0.375, -0.84, 1.03]}
"""
PLY = """[[ply]]
name = "p"
fabric = "f"
blank = "b"
angle = 12.5
"""


def spline(flags: int, knots: list, points: list) -> str:
    """A SPLINE of degree 3."""
    pairs = [(0, "SPLINE"), (8, "0"), (70, flags), (71, 3), (72, len(knots)), (73, len(points)),
             (74, 0), *((40, k) for k in knots)]
    for x, y in points:
        pairs += [(10, x), (20, y), (30, 0.0)]
    return "".join(f"{code}\n{value}\n" for code, value in pairs)


def drawing(entities: str) -> str:
    return ("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
            + entities + "0\nENDSEC\n0\nEOF\n")


CIRCLE = "0\nCIRCLE\n8\n0\n10\n12.5\n20\n-7.25\n40\n37.5\n"


def make_locale(folder: Path) -> bool:
    """de_DE.UTF-8 in a folder that LOCPATH names."""
    if not shutil.which("localedef"):
        return False
    done = subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", str(folder / "de_DE.UTF-8")],
                          capture_output=True, check=False)
    return done.returncode == 0 and (folder / "de_DE.UTF-8").is_dir()


def main() -> int:
    modules = sys.argv[1]
    if os.environ.get("PLYFORM_LOCALE_TEST") is None:  # LOCPATH is read when a process starts
        with tempfile.TemporaryDirectory() as name:
            if not make_locale(Path(name)):
                print("no localedef, or no source of de_DE")
                return 77
            return subprocess.run([sys.executable, *sys.argv], check=False, env={
                **os.environ, "LOCPATH": name, "PLYFORM_LOCALE_TEST": name}).returncode
    sys.path.insert(0, modules)
    import plyform

    locale.setlocale(locale.LC_ALL, "de_DE.UTF-8")
    assert locale.localeconv()["decimal_point"] == ",", "the locale has no decimal comma"
    folder = Path(os.environ["PLYFORM_LOCALE_TEST"]) / "case"
    folder.mkdir()
    (folder / "circle.dxf").write_text(drawing(CIRCLE))
    case_file = folder / "case.toml"
    case_file.write_text(FABRIC + '[blanks.b]\noutline_file = "circle.dxf"\nmesh = "free"\n'
                         'element_size = 12.5\n' + PLY)
    case = plyform.Case(case_file)
    found = case.check()
    assert found.sound, [str(m) for m in found.mistakes]
    assert case.get("blanks.b.element_size") == 12.5 and case.get("fabrics.f.thickness") == 0.625
    lines = "\n".join(case.outlook(threads=1).lines)
    assert "75 x 75 mm" in lines, lines  # 74 by the digits before the point
    # places: the mesh lies about the circle's centre
    box = plyform.Simulation(case, threads=1).plies[0].x0
    centre = 0.5 * (box.min(axis=0) + box.max(axis=0))
    assert abs(centre[0] - 12.5) < 0.3 and abs(centre[1] + 7.25) < 0.3, centre
    # a number that no double holds is told by its digits, not by the C library
    stl = ("solid a\nfacet normal 0 0 1\nouter loop\nvertex 1.5e-400 0 0\nvertex 10.5 0 0\n"
           "vertex 0 10.5 0\nendloop\nendfacet\nendsolid a\n")
    (folder / "flat.stl").write_text(stl)
    case_file.write_text(FABRIC + '[blanks.b]\nfile = "flat.stl"\nmesh = "file"\n' + PLY)
    assert abs(plyform.Simulation(plyform.Case(case_file), threads=1).plies[0].x0.min()) < 1.0
    # what is written has decimal points too
    case_file.write_text(FABRIC + "[blanks.b]\nsize = [40.5, 40.5]\nelement_size = 13.5\n" + PLY +
                         "[solver]\nduration = 0.0015\n")
    result = plyform.run(plyform.Case(case_file), output=folder / "out", threads=1)
    assert result is not None
    summary = json.loads((folder / "out" / "summary.json").read_text())
    assert summary["plies"][0]["angle_deg"] == 12.5, summary["plies"]
    rows = (folder / "out" / "history.csv").read_text().splitlines()
    assert len({row.count(",") for row in rows}) == 1, "a comma within a number"
    assert "." in rows[-1]
    assert ",12,5" not in (folder / "out" / "results.xdmf").read_text()
    # closed splines, whatever the locale
    from math import cos, pi, sin
    points = [(150.5 * cos(pi * i / 4), 150.5 * sin(pi * i / 4)) for i in range(8)]
    (folder / "periodic.dxf").write_text(drawing(spline(11, [float(i) for i in range(12)], points)))
    (folder / "clamped.dxf").write_text(
        drawing(spline(11, [0, 0, 0, 0, 1, 2, 3, 4, 5, 5, 5, 5], points)))
    for name, words in (("periodic", ""), ("clamped", "marked as closed")):
        case_file.write_text(FABRIC + f'[blanks.b]\noutline_file = "{name}.dxf"\nmesh = "free"\n'
                             'element_size = 40.5\n' + PLY)
        said = "".join(str(m) for m in plyform.Case(case_file).check().mistakes)
        assert (words in said) if words else not said, said
    # messages about files whose names and texts are no UTF-8 are Python texts all the same
    odd = folder / os.fsdecode(b"n\xe4me.toml")
    odd.write_bytes(b"x = 3\n")
    said = "".join(str(m) + m.file for m in plyform.Case(odd).check().mistakes)
    assert "\\xe4" in said, said
    # a list of 50 000 numbers in one line
    case = plyform.Case(folder / "case.toml")
    case.set("fabrics.f.shear.polynomial", [0.375] * 50000)
    case.set("gravity", [0.5] * 50000)
    assert any("gravity" in str(m) for m in case.check().mistakes)
    print("decimal points everywhere")
    return 0


if __name__ == "__main__":
    sys.exit(main())
