# SPDX-License-Identifier: GPL-3.0-or-later
"""Tools from STEP and IGES files: closed, outward, within the deflection of shapes that are known;
what is wrong with a file told in one line; and plies that form over them as over the primitives. The
tools of cases/double_dome.

    mesh_tool_test.py files|formed|shipped TOOLS PROGRAM CASES

formed: with elements half as large again as those of the shipped cases, in half of the time; shipped:
as they are, a minute, for the figures of docs/users/case.md. The parts are made by gmsh's Open CASCADE. Leaves with 77 when gmsh, numpy or scipy is missing.
"""

import csv
import math
import subprocess
import sys
import tempfile
from pathlib import Path

WHAT = sys.argv[1]
TOOLS, PROGRAM, CASES = (Path(argument).resolve() for argument in sys.argv[2:5])
sys.path.insert(0, str(TOOLS))

try:
    import gmsh
    import numpy as np
    import scipy  # noqa: F401

    import mesh_tool
    from program_call import call
    from step_files import write_step
except ImportError as error:
    print("SKIPPED:", error)
    sys.exit(77)


def half_ball(occ):
    occ.addSphere(0, 0, 0, 75, 1, -math.pi / 2, 0)


def filleted_box(occ):
    """The punch of cases/square_box."""
    occ.addBox(-50, -50, -30, 100, 100, 60, 1)
    occ.synchronize()
    occ.fillet([1], [edge for _, edge in gmsh.model.getEntities(1)], [10.0])


def two_boxes(occ):
    occ.addBox(0, 0, 0, 1, 1, 1)
    occ.addBox(3, 0, 0, 1, 1, 1)


def hollow_box(occ):
    occ.cut([(3, occ.addBox(0, 0, 0, 10, 10, 10))], [(3, occ.addBox(3, 3, 3, 2, 2, 2))])


def one_line(occ):
    occ.addLine(occ.addPoint(0, 0, 0), occ.addPoint(1, 0, 0))


def iges_of(faces):
    """Bilinear surfaces (entity 128), each by four corners, in inches."""
    def numbered(lines, letter):
        return [f"{line:<72}{letter}{k:7d}" for k, line in enumerate(lines, 1)]
    entries, parameters = [], []
    for k, corners in enumerate(faces):
        values = [128, 1, 1, 1, 1, 0, 0, 1, 0, 0, 0., 0., 1., 1., 0., 0., 1., 1., 1., 1., 1., 1.]
        values += [value for corner in corners for value in corner] + [0., 1., 0., 1.]
        words, lines = [f"{value}" for value in values], [""]
        for n, word in enumerate(words):
            word += ";" if n + 1 == len(words) else ","
            if len(lines[-1]) + len(word) > 64:
                lines.append("")
            lines[-1] += word
        first = len(parameters) + 1
        parameters += [f"{line:<64}{2 * k + 1:8d}" for line in lines]
        entries.append(f"{values[0]:8d}{first:8d}" + f"{0:8d}" * 6 + "00000000")
        entries.append(f"{values[0]:8d}" + f"{0:8d}" * 2 + f"{len(lines):8d}{0:8d}" + " " * 32)
    head = ["1H,,1H;,4Hpart,8Hpart.igs,4Hnone,4Hnone,32,38,6,308,15,4Hpart,1.0,1,",
            "4HINCH,1,0.01,15H20260101.000000,0.001,100.0,4Hnone,4Hnone,",
            "11,0,15H20260101.000000;"]
    rows = [*numbered(["made by a test"], "S"), *numbered(head, "G"), *numbered(entries, "D"),
            *numbered(parameters, "P")]
    counts = f"S{1:7d}G{len(head):7d}D{len(entries):7d}P{len(parameters):7d}"
    return "\n".join([*rows, *numbered([counts], "T")]) + "\n"


def box_faces(size):
    corner = [np.array([x, y, z], float) * size for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    return [[corner[k].tolist() for k in face]
            for face in ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 4, 5), (2, 3, 6, 7), (0, 2, 4, 6),
                         (1, 3, 5, 7))]


def made(part, *words):
    stl = part.with_suffix(".stl")
    done = call(mesh_tool, part, "-o", stl, *words)
    assert done.code == 0, done
    rows = np.frombuffer(stl.read_bytes()[84:], dtype=[("n", "<f4", 3), ("x", "<f4", (3, 3)),
                                                       ("end", "<u2")])
    return stl, rows["x"].astype(float), done.out


def check_closed_outward(corners):
    """Every directed side has its opposite, and the volume is positive. Returns the volume."""
    sides = {}
    for triangle in corners.round(6).tolist():
        for k in range(3):
            side = tuple(triangle[k]), tuple(triangle[(k + 1) % 3])
            assert side not in sides, side
            sides[side] = True
    assert all((two, one) in sides for one, two in sides)
    volume = (corners[:, 0] * np.cross(corners[:, 1], corners[:, 2])).sum() / 6
    assert volume > 0
    return volume


def all_over(corners):
    """Middles of triangles and of their sides."""
    a, b, c = (corners[:, k] for k in range(3))
    return np.concatenate([(a + b + c) / 3, (a + b) / 2, (b + c) / 2, (c + a) / 2, a, b, c])


def to_half_ball(p):
    """Distance from the surface of the lower half of a ball of 75 mm, of points near it."""
    return np.minimum(np.abs(np.linalg.norm(p, axis=1) - 75), np.abs(p[:, 2]))


def to_box(p):
    q = np.abs(p) - (40, 40, 20)
    outside = np.linalg.norm(np.maximum(q, 0), axis=1)
    return np.abs(outside + np.minimum(q.max(axis=1), 0) - 10)


def check_parts(folder):
    for name, build, distance, deflections, volume in (
            ("half_ball", half_ball, to_half_ball, (0.1, 0.5), 2 / 3 * math.pi * 75 ** 3),
            ("box", filleted_box, to_box, (0.2,),
             80 * 80 * 40 + 2 * 10 * (80 * 80 + 2 * 80 * 40) + math.pi * 100 * 200
             + 4 / 3 * math.pi * 1000)):
        part = folder / f"{name}.step"
        write_step(part, build)
        for deflection in deflections:
            _, corners, said = made(part, "--deflection", deflection)
            assert abs(check_closed_outward(corners) / volume - 1) < 0.06 * deflection
            away = distance(all_over(corners))
            told = float(said.split("largest ")[1].split(" mm")[0])
            print(f"{name}, deflection {deflection}: {len(corners)} triangles, largest deviation "
                  f"{away.max():.4f} mm, told {told:.4f} mm")
            assert away.max() <= deflection and told <= deflection
            assert away.max() <= 1.3 * told  # measured at other points
            assert "closed, outward" in said and "unit of the file mm" in said
    metres = folder / "metres.step"
    metres.write_text((folder / "half_ball.step").read_text().replace(
        "SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT($,.METRE.)"))
    _, corners, said = made(metres, "--deflection", 10)
    assert "unit of the file m," in said and np.ptp(corners[:, :, 2]) == 75000, said
    done = call(mesh_tool, metres, "-o", folder / "metres.stl", "--deflection", 0.05)
    assert done.code == 2 and "triangles at a deflection of 0.05 mm, more than 500000: check the " \
        "part's unit" in done.err, done
    part = folder / "box.igs"
    part.write_text(iges_of(box_faces(2.0)))
    _, corners, said = made(part)
    assert abs(check_closed_outward(corners) - 50.8 ** 3) < 1e-3 * 50.8 ** 3
    assert "faces sewn to one solid, unit of the file inch" in said, said


def check_faults(folder):
    for name, build in (("two", two_boxes), ("hollow", hollow_box), ("line", one_line),
                        ("sheet", lambda occ: occ.addRectangle(0, 0, 0, 10, 10))):
        write_step(folder / f"{name}.step", build)
    whole = (folder / "two.step").read_text()
    (folder / "short.step").write_text(whole[:len(whole) // 2])
    (folder / "garbage.step").write_text("ISO-10303-21;\ngarbage\nEND-ISO-10303-21;\n")
    (folder / "text.step").write_text("no part\n")
    (folder / "text.igs").write_text("no part\n")
    (folder / "part.txt").write_text("no part\n")
    (folder / "open.igs").write_text(iges_of(box_faces(2.0)[:5]))
    for name, said in (
            ("two.step", "has 2 solids, and a tool is one"), ("hollow.step", "has a hollow inside"),
            ("line.step", "has no faces"), ("sheet.step", "its 1 face is an open shell"),
            ("short.step", "is cut short"), ("garbage.step", "garbage.step"),
            ("text.step", "is no STEP file"), ("text.igs", "is no IGES file"),
            ("open.igs", "its 5 faces are an open shell"),
            ("part.txt", "a part is a .step, .stp, .iges or .igs file"),
            ("absent.step", "absent.step is missing")):
        done = call(mesh_tool, folder / name, "-o", folder / "never.stl")
        assert done.code == 2 and said in done.err, (name, done)
        assert done.err.count("\n") == 1 and not done.out, (name, done)
    box = folder / "one.step"
    write_step(box, lambda occ: occ.addBox(0, 0, 0, 1, 1, 1))
    check_numbers(folder, box)
    for words, said in ((("--deflection", 0), "--deflection 0: 0.0001 to 10 mm"),
                        (("-o", folder / "never.obj"), "an .stl file is written")):
        done = call(mesh_tool, box, *words)
        assert done.code == 2 and said in done.err, done
    assert not list(folder.glob("never.*")) and not list(folder.glob("part_never.*"))


def check_numbers(folder, box):
    """Coordinates that no part has are told with their line, before Open CASCADE reckons without end; a
    part that takes too long is given up."""
    text = box.read_text()
    at = text.index("CARTESIAN_POINT")
    first = text.index("(", text.index("(", at) + 1)  # of its three coordinates
    end = text.index(",", first)
    line = text[:first].count("\n") + 1
    for word in ("1e300", "-1.E+300", "NAN", "-nan", "INF", "1.#QNAN", "1.E400", "12345678901."):
        (folder / "huge.step").write_text(text[:first + 1] + word + text[end:])
        done = call(mesh_tool, folder / "huge.step", "-o", folder / "never.stl")
        assert done.code == 2 and f"huge.step:{line}: {word} is no coordinate" in done.err, (word, done)
        assert done.err.count("\n") == 1
    (folder / "named.step").write_text(text.replace("CARTESIAN_POINT('',", "CARTESIAN_POINT('1e300 NAN',"))
    made(folder / "named.step")
    (folder / "huge.igs").write_text(iges_of(box_faces(2.0)).replace("2.0,", "1D300,", 1))
    done = call(mesh_tool, folder / "huge.igs", "-o", folder / "never.stl")
    assert done.code == 2 and "1D300 is no coordinate" in done.err, done
    slow = folder / "slow.step"
    write_step(slow, half_ball)
    done = call(mesh_tool, slow, "--deflection", 0.01, "--minutes", 0.001, "-o", folder / "never.stl")
    assert done.code == 2 and "has come to no end after 0.001 minutes" in done.err, done


def shear(folder, name):
    with open(folder / "plies" / f"{name}.csv", newline="", encoding="utf-8") as file:
        return np.array([float(row["shear_angle_deg"])
                         for row in csv.DictReader(line for line in file if line[0] != "#")])


def check_formed(folder, shipped):
    for case, build, place, plies, size in (
            ("hemisphere_0", half_ball, "position = [0.0, 0.0, 75.6], stroke = 75.0", ["ply"],
             (6.8, 10.0)),
            ("square_box", filleted_box, "position = [0.0, 0.0, 31.2], stroke = 35.0",
             ["lower", "upper"], (5.0, 7.5))):
        mesh = ["--set", "blanks.square.mesh_from=element_size",  # the same for both tools
                "--set", f"blanks.square.element_size={size[0] if shipped else size[1]}"]
        coarse = mesh if shipped else [*mesh, "--set", "solver.duration=0.05"]
        part = folder / f"{case}.step"
        write_step(part, build)
        stl, _, said = made(part)
        print(said.splitlines()[2])
        punch = f'{{name = "punch", shape = "mesh", file = "{stl}", motion = "driven", {place}}}'
        for name, words in (("primitive", []), ("step", ["--set", f"tool.0={punch}"])):
            done = subprocess.run([PROGRAM, "run", CASES / case, "-o", folder / case / name, *coarse,
                                   *words],
                                  capture_output=True, text=True, check=False)
            assert done.returncode == 0, done
        for ply in plies:
            one, two = (shear(folder / case / name, ply) for name in ("primitive", "step"))
            rms = math.sqrt(((two - one) ** 2).mean())
            print(f"{case}, {ply}: shear angles {rms:.3f} degrees rms apart, up to "
                  f"{np.abs(one).max():.1f}")
            assert np.abs(one).max() > 20 and rms <= 0.3


def check_double_dome(folder):
    """The tools of cases/double_dome are drawn as its README says, and the case is sound with them."""
    case = folder / "double_dome"
    case.mkdir()
    done = subprocess.run([sys.executable, CASES / "double_dome" / "draw_tools.py", case],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0 and done.stdout.count("\n") == 3, done
    stadium = {r: math.pi * r ** 2 + 150 * 2 * r for r in (60, 64, 72)}  # mm2
    plate, corner = 560 * 360, 1 - math.pi / 4  # mm2; of a fillet's square, what it takes away

    def opened(radius, height, fillet):
        centroid = (10 - 3 * math.pi) / (12 - 3 * math.pi) * fillet  # of what it takes, from the edge
        along = 2 * 150 + 2 * math.pi * (radius + centroid)
        return height * (plate - stadium[radius]) - corner * fillet ** 2 * along
    for name, low, high, volume in (
            ("punch", (-135, -60, 0), (135, 60, 80),
             2 / 3 * math.pi * 60 ** 3 + math.pi / 2 * 60 ** 2 * 150 + 20 * stadium[60]),
            ("die", (-280, -180, -75), (280, 180, 0), opened(64, 75, 6)),
            ("blank_holder", (-280, -180, 0), (280, 180, 20), opened(72, 20, 8))):
        _, corners, said = made(case / f"{name}.step", "--deflection", 0.2)
        places = corners.reshape(-1, 3)
        assert np.abs(places.min(axis=0) - low).max() < 0.2, (name, places.min(axis=0))
        assert np.abs(places.max(axis=0) - high).max() < 0.2, (name, places.max(axis=0))
        exact = float(said.split("that of the part ")[1].split()[0])
        assert abs(exact / volume - 1) < 1e-5, (name, exact, volume)
    fabrics = CASES / "fabrics" / "glass_plain_weave.toml"
    text = (CASES / "double_dome" / "case.toml").read_text(encoding="utf-8")
    (case / "case.toml").write_text(text.replace("../fabrics/glass_plain_weave.toml", str(fabrics)))
    done = subprocess.run([PROGRAM, "check", case, "--set", "blanks.sheet.mesh_from=element_size"],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0 and "the case is sound" in done.stdout, done
    for said in ("touches ply lower", "touches ply upper", "driven 60 mm"):
        assert said in done.stdout, done


def check_channel(folder):
    """So is the tool of cases/diaphragm_c_channel: what is taken off its edges is in its hollows."""
    case = folder / "diaphragm_c_channel"
    case.mkdir()
    done = subprocess.run([sys.executable, CASES / "diaphragm_c_channel" / "draw_tools.py", case],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0 and done.stdout.count("\n") == 1, done
    _, corners, said = made(case / "channel.step")
    places = corners.reshape(-1, 3)
    assert np.abs(places.min(axis=0) - (-200, -150, -60)).max() < 1e-3, places.min(axis=0)
    assert np.abs(places.max(axis=0) - (200, 150, 0)).max() < 1e-3, places.max(axis=0)
    exact = float(said.split("that of the part ")[1].split()[0])
    assert abs(exact / (300 * (400 * 20 + 60 * 40)) - 1) < 1e-5, exact
    hollow = places[(places[:, 0] > 31) & (places[:, 0] < 37) & (places[:, 2] > -39.9) & (places[:, 2] < -32.1)]
    assert len(hollow) and np.abs(np.hypot(hollow[:, 0] - 38, hollow[:, 2] + 32) - 8).max() < 0.05
    text = (CASES / "diaphragm_c_channel" / "case.toml").read_text(encoding="utf-8")
    (case / "case.toml").write_text(text.replace("../fabrics", str(CASES / "fabrics")), encoding="utf-8")
    done = subprocess.run([PROGRAM, "check", case], capture_output=True, text=True, check=False)
    assert done.returncode == 0 and "the case is sound" in done.stdout, done
    assert done.stdout.count("pressure above ply") == 2, done


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        if WHAT == "files":
            check_parts(folder)
            check_faults(folder)
            check_double_dome(folder)
            check_channel(folder)
        else:
            check_formed(folder, WHAT == "shipped")


main()
