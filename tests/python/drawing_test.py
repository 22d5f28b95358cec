# SPDX-License-Identifier: GPL-3.0-or-later
"""DXF drawings that ezdxf writes, of several versions, as outlines of blanks: extents and holes as
plyform check tells them; what is refused; and damaged drawings, each with one message at most.

    drawing_test.py PROGRAM FABRIC TOOLS

Leaves with 77 when ezdxf, numpy or scipy is missing.
"""

import random
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM, FABRIC, TOOLS = (Path(argument).resolve() for argument in sys.argv[1:4])
sys.path.insert(0, str(TOOLS))

try:
    import ezdxf
    import numpy as np

    from exchange.draw_pattern import write_dxf
    from exchange.flat_pattern import Pattern
except ImportError as error:
    print("SKIPPED:", error)
    sys.exit(77)

QUARTER = 2 ** 0.5 - 1  # bulge of a quarter of a circle
DAMAGED = 60


def case_of(folder, drawing, more=""):
    case = folder / "case.toml"
    case.write_text(f"""
[fabrics]
glass = "{FABRIC}"
[blanks.drawn]
outline_file = "{drawing}"
{more}
element_size = 10.0
[[ply]]
name = "ply"
fabric = "glass"
blank = "drawn"
angle = 30.0
""")
    return case


def check(folder, drawing, more=""):
    return subprocess.run([PROGRAM, "check", case_of(folder, drawing, more)], capture_output=True,
                          text=True, errors="replace", check=False, timeout=120)


def expect(folder, drawing, *said, more=""):
    done = check(folder, drawing, more)
    assert done.returncode == 0, done
    for text in said:
        assert text in done.stdout, (text, done)


def refuse(folder, drawing, said, more=""):
    done = check(folder, drawing, more)
    assert done.returncode == 2 and said in done.stderr, (said, done)
    assert done.stderr.count("error:") == 1, done


def drawn(version, units=4):
    drawing = ezdxf.new(version)
    drawing.header["$INSUNITS"] = units
    drawing.layers.add("CUT")
    return drawing, drawing.modelspace()


def sheet(space, version):
    """220 x 100 mm, a corner rounded by 20 mm, a round hole and a slot of lines and an arc in any
    order and direction."""
    corners = [(0, 0, 0), (200, 0, QUARTER), (220, 20, 0), (220, 100, 0), (0, 100, 0)]
    add = space.add_polyline2d if version == "R12" else space.add_lwpolyline
    add(corners, format="xyb", close=True, dxfattribs={"layer": "CUT"})
    cut = {"layer": "CUT"}
    space.add_circle((50, 50), 20, dxfattribs=cut)
    space.add_line((140, 60), (100, 60), dxfattribs=cut)
    space.add_line((100, 40.005), (100, 60), dxfattribs=cut)
    space.add_arc((140, 50), 10, 270, 90, dxfattribs=cut)
    space.add_line((100, 40), (140, 40), dxfattribs=cut)
    space.add_text("left side")
    space.add_point((500, 500))


def check_versions(folder):
    for version in ("R12", "R2000", "R2004", "R2010", "R2018"):
        drawing, space = drawn(version)
        sheet(space, version)
        drawing.saveas(folder / f"{version}.dxf")
        unit = "no unit given, taken for mm" if version == "R12" else "in mm"
        expect(folder, f"{version}.dxf",
               f"outline from {version}.dxf: 220 x 100 mm, 2 holes, layer CUT, {unit}")
    drawing, space = drawn("R2010", units=1)
    space.add_circle((1, 1), 5)
    drawing.saveas(folder / "inch.dxf")
    expect(folder, "inch.dxf", "254 x 254 mm, 0 holes, layer 0, in inches")
    expect(folder, "inch.dxf", "50 x 50 mm, 0 holes, layer 0, 5 mm a unit", more="scale = 5.0")


def check_pattern(folder):
    """What plyform pattern writes: the outline, the warp and the ply's name on layers of their
    own."""
    turn = np.linspace(0, 2 * np.pi, 92, endpoint=False)
    outline = np.column_stack([100 * np.cos(turn), 60 * np.sin(turn)])
    write_dxf(Pattern("ply", 30.0, outline, 0, 0, 0, 0, 0), folder / "pattern.dxf")
    refuse(folder, "pattern.dxf", "the outline is open: LINE ends at")
    expect(folder, "pattern.dxf", "200 x 120 mm, 0 holes, layer CUT, in mm", more='layer = "CUT"')


def check_mirrored(folder):
    """Seen from below: bulges go the other way round in what is stored. Half a circle outwards
    makes the sheet 20 mm longer, inwards none."""
    for name, bulge, size in (("out", 1.0, "120 x 40"), ("in", -1.0, "100 x 40")):
        drawing, space = drawn("R2010")
        space.add_lwpolyline([(0, 0, 0), (100, 0, bulge), (100, 40, 0), (0, 40, 0)], format="xyb",
                             close=True, dxfattribs={"extrusion": (0, 0, -1)})
        space.add_arc((50, 20), 5, 0, 180, dxfattribs={"extrusion": (0, 0, -1)})
        space.add_line((-55, 20), (-45, 20))  # lines are in world coordinates
        drawing.saveas(folder / f"{name}.dxf")
        expect(folder, f"{name}.dxf", f"{size} mm, 1 hole,")


def check_refused(folder):
    def save(name, draw, **options):
        drawing, space = drawn("R2010")
        space.add_circle((0, 0), 50)
        draw(drawing, space)
        drawing.saveas(folder / name, **options)
        return name
    refuse(folder, save("s.dxf", lambda _, m: m.add_spline([(0, 0), (1, 1), (2, 0)])),
           "SPLINE on layer 0 is not supported")
    refuse(folder, save("e.dxf", lambda _, m: m.add_ellipse((0, 0), (3, 0), 0.5)),
           "ELLIPSE on layer 0 is not supported")
    refuse(folder, save("t.dxf", lambda _, m: m.add_circle((0, 0), 9,
                                                           dxfattribs={"extrusion": (0, 1, 1)})),
           "CIRCLE on layer 0 does not lie in the xy plane")

    def insert(drawing, space):
        drawing.blocks.new("B").add_circle((0, 0), 5)
        space.add_blockref("B", (0, 0), dxfattribs={"layer": "HOLES"})
    refuse(folder, save("b.dxf", insert), "INSERT on layer HOLES is not supported")
    expect(folder, "b.dxf", "100 x 100 mm, 0 holes, layer 0", more='layer = "0"')
    refuse(folder, save("bin.dxf", lambda *_: None, fmt="bin"), "is a binary DXF file")
    (folder / "part.dwg").write_bytes(b"AC1032" + bytes(100))
    refuse(folder, "part.dwg", "is a DWG file")


def check_damaged(folder):
    """Exit codes 0 and 2 only, and one line then, whatever dxflib does on it."""
    source = (folder / "R12.dxf").read_bytes().split(b"\n")
    values = [b"-1", b"1e308", b"nan", b"2000000000", b"", b"x" * 3000, b"LWPOLYLINE", b"ENDSEC",
              b"SECTION", b"HATCH", b"SPLINE", b"42", b"90", b"-2147483648"]
    rolls = random.Random(1)
    for _ in range(DAMAGED):
        lines = list(source)
        for _ in range(rolls.choice([1, 3, 10])):
            at = rolls.randrange(len(lines))
            if rolls.random() < 0.7:
                lines[at] = rolls.choice(values)
            else:
                del lines[at:at + rolls.randrange(1, 9)]
        (folder / "damaged.dxf").write_bytes(b"\n".join(lines))
        done = check(folder, "damaged.dxf")
        assert done.returncode in (0, 2) and done.stderr.count("error:") <= 1, done


with tempfile.TemporaryDirectory() as name:
    check_versions(Path(name))
    check_pattern(Path(name))
    check_mirrored(Path(name))
    check_refused(Path(name))
    check_damaged(Path(name))
