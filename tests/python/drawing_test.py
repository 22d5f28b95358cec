# SPDX-License-Identifier: GPL-3.0-or-later
"""DXF drawings that ezdxf writes, of several versions, as outlines of blanks: extents and holes as
plyform check tells them; what is refused; and damaged drawings, each with one message at most.

    drawing_test.py PROGRAM FABRIC TOOLS

Leaves with 77 when ezdxf, numpy or scipy is missing.
"""

import random
import re
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM, FABRIC, TOOLS = (Path(argument).resolve() for argument in sys.argv[1:4])
sys.path.insert(0, str(TOOLS))

try:
    import ezdxf
    import ezdxf.bbox
    import numpy as np
    from ezdxf.math import rational_bspline_from_arc

    from exchange.draw_pattern import write_dxf
    from exchange.flat_pattern import Pattern
except ImportError as error:
    print("SKIPPED:", error)
    sys.exit(77)

QUARTER = 2 ** 0.5 - 1  # bulge of a quarter of a circle
DAMAGED = 60


def case_of(folder, drawing, more="", size=10.0):
    case = folder / "case.toml"
    case.write_text(f"""
[fabrics]
glass = "{FABRIC}"
[blanks.drawn]
outline_file = "{drawing}"
{more}
element_size = {size}
[[ply]]
name = "ply"
fabric = "glass"
blank = "drawn"
angle = 30.0
""")
    return case


def check(folder, drawing, more="", size=10.0):
    return subprocess.run([PROGRAM, "check", case_of(folder, drawing, more, size)],
                          capture_output=True, text=True, errors="replace", check=False,
                          timeout=120)


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
    write_dxf(Pattern("ply", "warp", 30.0, outline, 0, 0, 0, 0, 0), folder / "pattern.dxf")
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


def extents_said(folder, name):
    """mm, and the number of holes, as plyform check tells them."""
    done = check(folder, name, size=2.0)
    assert done.returncode == 0, done
    found = re.search(r"outline from .*: ([0-9.]+) x ([0-9.]+) mm, (\d+) hole", done.stdout)
    return float(found[1]), float(found[2]), int(found[3])


def check_curves(folder):
    """Ellipses and splines; extents by ezdxf's own division of them, to the sagittas of pieces of
    2 mm (0.01 to 0.03 mm) and the digits that are printed."""
    def flat(*curves):
        points = np.array([(p[0], p[1]) for curve in curves for p in curve.flattening(1e-3)])
        return np.ptp(points, axis=0)

    def same(name, drawing, curves, holes, within=0.1):
        drawing.saveas(folder / name)
        wide, high, found = extents_said(folder, name)
        assert found == holes, (name, found)
        assert np.allclose((wide, high), flat(*curves), atol=within), (name, wide, high, flat(*curves))

    for version in ("R2000", "R2018"):
        drawing, space = drawn(version)  # whole, tilted, with an ellipse in it
        whole = space.add_ellipse((30, 40), (100, 30), 0.6)
        space.add_ellipse((30, 40), (0, 20), 0.5)
        same("ellipse.dxf", drawing, [whole], 1)
        drawing, space = drawn(version)  # half of one, from below, on a line
        half = space.add_ellipse((0, 0), (80, 0), 0.5, 0, np.pi,
                                 dxfattribs={"extrusion": (0, 0, -1)})
        space.add_line((-80, 0), (80, 0))
        same("half.dxf", drawing, [half], 0)
        drawing, space = drawn(version)  # open and cubic, closed by a line
        wave = space.add_open_spline([(0, 0), (40, 90), (110, -30), (180, 120), (220, 0)])
        space.add_line((220, 0), (0, 0))
        same("wave.dxf", drawing, [wave], 0)
        drawing, space = drawn(version)  # closed, not clamped
        loop = space.add_spline()
        loop.set_closed([(0, 0, 0), (150, -20, 0), (200, 90, 0), (60, 140, 0), (-30, 80, 0)])
        same("loop.dxf", drawing, [loop], 0)
        drawing, space = drawn(version)  # with weights: a circle of 60 mm
        circle = rational_bspline_from_arc(radius=60, start_angle=0, end_angle=360)
        space.add_spline().apply_construction_tool(circle)
        same("weights.dxf", drawing, [circle], 0)
        drawing, space = drawn(version, units=1)  # in inches, pieces of 2 mm all the same
        inches = space.add_ellipse((0, 0), (5, 0), 0.5)
        drawing.saveas(folder / "inches.dxf")
        wide, high, _ = extents_said(folder, "inches.dxf")
        assert np.allclose((wide, high), 25.4 * flat(inches), atol=0.1), (wide, high)


def check_blocks(folder):
    """A sheet in blocks in blocks: turned, mirrored, scaled, seen from below. Extents as ezdxf has
    them; holes are where it puts them, for else they would be outlines of their own."""
    for version in ("R12", "R2000", "R2018"):
        for turn, x, y, below in ((0, 1, 1, 1), (30, 2, 2, 1), (200, -1.5, 1.5, 1), (70, 1, 1, -1)):
            drawing, space = drawn(version)
            rim = drawing.blocks.new("Rim", base_point=(10, 20))
            corners = [(0, 0, 0), (90, 0, QUARTER), (110, 20, 0), (110, 60, -0.3), (0, 60, 0)]
            add = rim.add_polyline2d if version == "R12" else rim.add_lwpolyline
            add(corners, format="xyb", close=True)
            rim.add_circle((20, 30), 8)
            rim.add_arc((60, 30), 10, 0, 180)
            rim.add_line((50, 30), (70, 30))
            whole = drawing.blocks.new("WHOLE")
            whole.add_blockref("rim", (5, -7), dxfattribs={"rotation": 15, "layer": "CUT"})
            placed = space.add_blockref("Whole", (300, 100), dxfattribs={
                "rotation": turn, "xscale": x, "yscale": y, "zscale": abs(x),
                "extrusion": (0, 0, below)})
            drawing.saveas(folder / "blocks.dxf")
            size = ezdxf.bbox.extents([placed], flatten=0.001).size
            wide, high, holes = extents_said(folder, "blocks.dxf")
            assert holes == 2, (version, turn, holes)
            assert np.allclose((wide, high), (size.x, size.y), atol=0.15), (turn, wide, high, size)
            expect(folder, "blocks.dxf", "2 holes, layer CUT,")


def check_refused(folder):
    def save(name, draw, **options):
        drawing, space = drawn("R2010")
        space.add_circle((0, 0), 50)
        draw(drawing, space)
        drawing.saveas(folder / name, **options)
        return name
    refuse(folder, save("s.dxf", lambda _, m: m.add_spline([(0, 0), (1, 1), (2, 0)])),
           "SPLINE on layer 0 has no control points")
    refuse(folder, save("r.dxf", lambda _, m: m.add_open_spline([(0, 0), (1, 1, 2), (2, 0), (3, 1)])),
           "SPLINE on layer 0 does not lie in the xy plane")
    refuse(folder, save("o.dxf", lambda _, m: m.add_ellipse((0, 0), (3, 0), 0.5, 0, 2)),
           "the outline is open: ELLIPSE ends at")
    refuse(folder, save("t.dxf", lambda _, m: m.add_circle((0, 0), 9,
                                                           dxfattribs={"extrusion": (0, 1, 1)})),
           "CIRCLE on layer 0 does not lie in the xy plane")

    def insert(at=(0, 0), **options):
        def draw(drawing, space):
            drawing.blocks.new("B").add_circle((0, 0), 5)
            space.add_blockref("B", at, dxfattribs={"layer": "HOLES", **options})
        return draw
    expect(folder, save("b.dxf", insert()), "100 x 100 mm, 1 hole, layer 0, HOLES, in mm")
    expect(folder, "b.dxf", "100 x 100 mm, 0 holes, layer 0", more='layer = "0"')
    refuse(folder, save("b2.dxf", insert(xscale=2)),
           "CIRCLE on layer HOLES has arcs and is in a block that is scaled by different factors")
    refuse(folder, save("b3.dxf", insert(column_count=3, column_spacing=12)),
           "INSERT on layer HOLES repeats a block in rows or columns")
    refuse(folder, save("b4.dxf", lambda _, m: m.add_blockref("C", (0, 0))),
           "INSERT on layer 0 names the block C, which is not there")

    def around(drawing, space):
        drawing.blocks.new("B").add_blockref("B", (0, 0))
        space.add_blockref("B", (0, 0))
    refuse(folder, save("b5.dxf", around), "INSERT on layer 0 is a block 17 blocks deep")

    def many(drawing, space):
        for k in range(12):
            block = drawing.blocks.new(f"B{k}")
            for _ in range(10 if k else 0):
                block.add_blockref(f"B{k - 1}", (0, 0))
        space.add_blockref("B11", (0, 0))
    refuse(folder, save("b6.dxf", many), "has more than 100000 entities")
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
    check_curves(Path(name))
    check_blocks(Path(name))
    check_refused(Path(name))
    check_damaged(Path(name))
