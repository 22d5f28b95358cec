# SPDX-License-Identifier: GPL-3.0-or-later
"""Die and punch from one part: everywhere the room apart, by distances that are known in closed form and
from mesh to mesh both ways; bodies that the program takes; what is refused, in one line.

    offset_tools_test.py TOOLS PROGRAM CASES

The parts are made by gmsh's Open CASCADE. Leaves with 77 when gmsh, numpy or scipy is missing.
"""

import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

TOOLS, PROGRAM, CASES = (Path(argument).resolve() for argument in sys.argv[1:4])
sys.path.insert(0, str(TOOLS))

try:
    import gmsh
    import numpy as np
    import scipy  # noqa: F401

    import mesh_tool
    from exchange.closest import Surface
    from exchange.formed import read_formed
    from exchange.stack_room import room_of_run
    from program_call import call
    from step_files import write_step
except ImportError as error:
    print("SKIPPED:", error)
    sys.exit(77)

BALL, FILLET, FLANGE = 75.0, 10.0, 140.0  # mm: of the bowl
AXIS = math.sqrt((BALL + FILLET) ** 2 - FILLET ** 2)  # from it to the middle of the fillet


def turned_profile(occ, thickness):
    """Hemisphere, fillet and flange at z = 0: an open shell, or a part of this thickness below it."""
    def row(more):
        at = AXIS * (BALL + more) / (BALL + FILLET), -FILLET * (BALL + more) / (BALL + FILLET)
        places = ((0, -BALL - more), at, (AXIS, -more), (FLANGE, -more))
        points = [occ.addPoint(r, 0, z) for r, z in places]
        lines = [occ.addCircleArc(points[0], occ.addPoint(0, 0, 0), points[1]),
                 occ.addCircleArc(points[1], occ.addPoint(AXIS, 0, -FILLET), points[2]),
                 occ.addLine(points[2], points[3])]
        return points, lines
    points, lines = row(0.0)
    if not thickness:
        occ.revolve([(1, line) for line in lines], 0, 0, 0, 0, 0, 1, 2 * math.pi)
        return
    below, under = row(thickness)
    sides = [occ.addLine(points[3], below[3]), occ.addLine(below[0], points[0])]
    section = occ.addPlaneSurface([occ.addCurveLoop([*lines, sides[0], *under[::-1], sides[1]])])
    occ.revolve([(2, section)], 0, 0, 0, 0, 0, 1, 2 * math.pi)


def to_bowl(p, thickness=0.0):
    """Distance from the bowl's upper surface, or from the lower one of the part."""
    r, z = np.hypot(p[:, 0], p[:, 1]), p[:, 2]
    slope = FILLET / AXIS  # below the line through both middles the ball is nearest
    ball = np.where(z <= -slope * r, np.abs(np.hypot(r, z) - BALL - thickness), np.inf)
    across, up = r - AXIS, z + FILLET
    round_it = (across <= 0) & (z > -slope * r) & (up >= 0)
    fillet = np.where(round_it, np.abs(np.hypot(across, up) - FILLET + thickness), np.inf)
    flange = np.where(r >= AXIS, np.hypot(z + thickness, np.maximum(r - FLANGE, 0)), np.inf)
    return np.minimum(np.minimum(ball, fillet), flange)


def filleted_box(occ):
    occ.addBox(-50, -50, -60, 100, 100, 60, 1)
    occ.synchronize()
    occ.fillet([1], [edge for _, edge in gmsh.model.getEntities(1)], [10.0])


def to_box(p):
    q = np.abs(p + (0, 0, 30)) - (40, 40, 20)
    outside = np.linalg.norm(np.maximum(q, 0), axis=1)
    return np.abs(outside + np.minimum(q.max(axis=1), 0) - 10)


def open_box(occ):
    """Sharp edges, without its top."""
    box = occ.addBox(-50, -50, -60, 100, 100, 60)
    occ.synchronize()
    top = [face for face in gmsh.model.getEntities(2)
           if abs(occ.getCenterOfMass(*face)[2]) < 1e-6]
    occ.remove([(3, box)])
    occ.remove(top)


def to_open_box(p):
    """Of points outside of it, below its top."""
    q = np.column_stack([np.abs(p[:, :2]) - 50, -60 - p[:, 2]])
    return np.linalg.norm(np.maximum(q, 0), axis=1)


def read_stl(path):
    rows = np.frombuffer(path.read_bytes()[84:], dtype=[("n", "<f4", 3), ("x", "<f4", (3, 3)),
                                                        ("end", "<u2")])
    return rows["x"].astype(float)


def all_over(corners):
    a, b, c = (corners[:, k] for k in range(3))
    return np.concatenate([(a + b + c) / 3, (a + b) / 2, (b + c) / 2, (c + a) / 2, a, b, c])


def pair(part, *words):
    """Corners of die and punch, and what was printed."""
    done = call(mesh_tool, part, "-o", part.with_suffix(".stl"), *words)
    assert done.code == 0, done
    return *(read_stl(part.with_name(f"{part.stem}_{which}.stl")) for which in ("die", "punch")), done.out


def from_mesh(corners, p, near):
    """Distances of points from triangles, which are searched by size."""
    size = np.floor(np.log2(np.linalg.norm(np.ptp(corners, axis=1), axis=1)))
    found = np.full(len(p), np.inf)
    for one in np.unique(size):
        some = corners[size == one]
        surface = Surface(some.reshape(-1, 3), np.arange(3 * len(some)).reshape(-1, 3), 0 * some[:, 0])
        found = np.minimum(found, surface.closest(p, near)[2])
    return found


def check_room(name, part, room, deflection, exact, words):
    """`exact`: distances from the part's own surface, of which the other tool is all the room away."""
    die, punch, said = pair(part, "--offset", room, "--deflection", deflection, "--backing", 0, *words)
    on, away = (punch, die) if "punch" in words else (die, punch)
    off = np.abs(exact(all_over(away)) - room)
    lies = np.abs(exact(all_over(on)))
    rng = np.random.default_rng(1)
    there, back = (np.abs(from_mesh(two, rng.permutation(all_over(one))[:20000], 1.5 * room) - room)
                   for one, two in ((away, on), (on, away)))
    told = max(float(line.split("off the room by ")[1].split()[0]) for line in said.splitlines()
               if line.startswith("distance"))
    print(f"{name}: {len(away)} triangles; from the exact surface {room:g} mm within {off.max():.4f}, "
          f"on it within {lies.max():.4f}; mesh to mesh within {there.max():.4f} and {back.max():.4f}, "
          f"told {told:.4f}, deflection {deflection:g}")
    assert max(off.max(), lies.max(), there.max(), back.max(), told) <= deflection
    assert max(there.max(), back.max()) <= told + 1e-4  # the same places, of coordinates in floats
    return said


def check_rooms(folder):
    shell, thick, box, sharp = (folder / f"{name}.step" for name in ("bowl", "thick", "box", "sharp"))
    write_step(shell, lambda occ: turned_profile(occ, 0.0))
    write_step(thick, lambda occ: turned_profile(occ, 2.0))
    write_step(box, filleted_box)
    write_step(sharp, open_box)
    for room, words in ((2.0, []), (3.0, ["--on", "punch"])):
        said = check_room("bowl", shell, room, 0.1, to_bowl, words)
        assert "open shell of 3 faces" in said
    # the lower skin of the part is the die: the punch goes into the part
    said = check_room("part of 2 mm", thick, 2.0, 0.1, lambda p: to_bowl(p, 2.0), ["--solid", "part"])
    assert "of whose 7 faces 3 are taken, the skin towards the die" in said, said
    said = check_room("box", box, 3.0, 0.1, to_box, ["--solid", "tool", "--on", "punch"])
    assert "of whose 26 faces 17 are taken" in said, said
    said = check_room("sharp box", sharp, 3.0, 0.1, to_open_box, ["--on", "punch"])
    assert "edges of the part are rounded on the die, with the room as radius" in said, said


def check_domes(folder):
    """Bodies are closed and outward, and the program takes them; both ways the room apart."""
    drawn = subprocess.run([sys.executable, CASES / "double_dome" / "draw_tools.py", folder],
                           capture_output=True, text=True, check=False)
    assert drawn.returncode == 0, drawn
    for name, on in (("punch", "punch"), ("die", "die")):
        part = folder / f"{name}.step"
        die, punch, said = pair(part, "--offset", 2.35, "--deflection", 0.1, "--solid", "tool", "--on", on,
                                "--backing", 0)
        for one, two in ((die, punch), (punch, die)):
            away = np.abs(from_mesh(two, all_over(one)[::5], 4.0) - 2.35).max()
            print(f"double dome from the {name}: within {away:.4f} mm of 2.35 mm")
            assert away <= 0.1


HALF_AXES = np.array([60.0, 40.0, 25.0])  # mm: of the half ellipsoid


def half_ellipsoid(occ):
    """A solid, flat below: a sphere that is scaled has poles where lines of its parameters end."""
    ball = occ.addSphere(0, 0, 0, 50)
    occ.dilate([(3, ball)], 0, 0, 0, *HALF_AXES / 50)
    occ.cut([(3, ball)], [(3, occ.addBox(-100, -100, -100, 200, 200, 100))])


def check_pole_and_base(folder):
    """The default of a page, a part on the die, has its flat base towards the die: its dome is taken. Curvature at
    the pole, on either side of the room, is that of an ellipsoid, c / a^2 and c / b^2."""
    part = folder / "half.step"
    write_step(part, half_ellipsoid)
    for on, solid, said in (("die", "part", "taken for the body of the die, as its skin on the other side is flat"),
                            ("punch", "part", "are taken, the skin towards the punch")):
        die, punch, told = pair(part, "--offset", 1.5, "--on", on, "--solid", solid, "--deflection", 0.2)
        assert said in told, told
        level = np.linalg.norm((die if on == "die" else punch).reshape(-1, 3) / HALF_AXES, axis=1)
        on_it = np.abs(level - 1) < 0.01
        assert on_it.sum() > 1000, on_it.sum()
        height = [tool.reshape(-1, 3)[:, 2] for tool in (die, punch)]
        top = HALF_AXES[2], HALF_AXES[2] + 1.5 * (1 if on == "die" else -1)
        assert abs(height[0].max() - top[on == "punch"]) < 0.1, (on, height[0].max())
    done = call(mesh_tool, part, "-o", folder / "never.stl", "--deflection", 0.2, "--offset", 11.0, "--on", "punch",
                "--solid", "part")
    radius = HALF_AXES[2] ** 2 / HALF_AXES[0]  # the least there is, at the end of the longest axis
    found = re.search(r"the radius of ([0-9.e+-]+) mm", done.err)
    assert done.code == 2 and found and abs(float(found[1]) / radius - 1) < 0.1, (radius, done.err)


def check_closed(corners):
    sides = {}
    for triangle in corners.round(5).tolist():
        for k in range(3):
            sides[tuple(triangle[k]), tuple(triangle[(k + 1) % 3])] = True
    assert len(sides) == 3 * len(corners) and all((two, one) in sides for one, two in sides)
    volume = (corners[:, 0] * np.cross(corners[:, 1], corners[:, 2])).sum() / 6
    assert volume > 0
    return volume


CASE = """
[fabrics]
glass = "{fabric}"
[blanks.sheet]
size = [200.0, 200.0]
element_size = 8.0
[stack]
bottom = 0.0
{plies}
[[tool]]
name = "punch"
shape = "mesh"
file = "bowl_punch.stl"
position = [0.0, 0.0, 75.0]
motion = "driven"
direction = [0.0, 0.0, -1.0]
stroke = 75.0
[[tool]]
name = "die"
shape = "mesh"
file = "bowl_die.stl"
"""
PLY = '[[ply]]\nname = "ply{0}"\nfabric = "glass"\nblank = "sheet"\nangle = {0}.0\n'


def check_bodies(folder):
    """Closed tools for two plies, sheared by 45 degrees: checked by the program as a case."""
    fabric = CASES / "fabrics" / "glass_plain_weave.toml"
    case = folder / "case.toml"
    case.write_text(CASE.format(fabric=fabric, plies=PLY.format(0) + PLY.format(45)))
    die, punch, said = pair(folder / "bowl.step", "--stack", folder, "--shear", 45)
    room = 1.2 * math.sqrt(2)
    assert f"the punch is {room:.4g} mm away (2 plies of {case}, 1.2 mm in all, sheared by 45" in said, said
    assert said.count("a closed body") == 2, said
    assert "stack.bottom = 0; punch: position = [0.0, 0.0, 75], direction" in said, said
    cap = math.pi * (BALL + 20) * FLANGE ** 2
    assert 0.5 * cap < check_closed(die) < cap
    assert check_closed(punch) > 20 * math.pi * FLANGE ** 2
    done = subprocess.run([PROGRAM, "check", folder], capture_output=True, text=True, check=False)
    assert done.returncode == 0 and "the case is sound" in done.stdout, done


def check_run(folder):
    """By the plies of a run: the room is their thickness where they are."""
    results = folder / "run"
    done = subprocess.run([PROGRAM, "run", CASES / "hemisphere_0", "-o", results, "--set",
                           "blanks.square.mesh_from=element_size", "--set",
                           "blanks.square.element_size=10", "--set", "solver.duration=0.05"],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done
    ply, room = read_formed(results).plies[0], room_of_run(results, 1.0)
    found = room(ply.x[ply.triangles].mean(axis=1))
    print(f"run: thickness {ply.thickness.min():.3f} to {ply.thickness.max():.3f} mm, taken "
          f"{found.min():.3f} to {found.max():.3f}, rms apart {np.std(found - ply.thickness):.4f}")
    assert ply.thickness.max() > 1.15 * ply.nominal_thickness
    # means at nodes: peaks of a coarse mesh are a little lower, nothing is anywhere else
    assert np.corrcoef(found, ply.thickness)[0, 1] > 0.9
    assert abs(found.mean() / ply.thickness.mean() - 1) < 0.02
    _, _, said = pair(folder / "bowl.step", "--run", results, "--factor", 2, "--deflection", 0.2)
    assert f"the thickness of 1 ply of {results} by place, times 2)" in said, said


def check_refused(folder):
    bowl, box, sharp = (folder / f"{name}.step" for name in ("bowl", "box", "sharp"))
    for part, words, said in (
            (bowl, ["--offset", 74], "the radius of 75 mm near "),
            (bowl, ["--offset", 80], "the least radius that allows it is 81.63 mm"),
            (bowl, ["--offset", 12, "--on", "punch"], "the radius of 10 mm near "),
            (sharp, ["--offset", 2], "640 mm of inner edges"),
            (box, ["--offset", 2], "say what it is by --solid part"),
            (bowl, ["--offset", 2, "--direction", 1, 0, 0], "as much of the surface faces the punch"),
            (bowl, ["--offset", 2, "--direction", 0, 0, 0], "--direction 0 0 0: three numbers"),
            (bowl, ["--offset", 0], "--offset 0: 0.001 to 1000 mm"),
            (bowl, ["--offset", 2, "--shear", 40], "--shear 40: 0 to 80 degrees, with --stack"),
            (bowl, ["--stack", folder / "none"], "none is missing"),
            (bowl, ["--run", folder / "none"], "none")):
        done = call(mesh_tool, part, "-o", folder / "never.stl", "--deflection", 0.2, *words)
        assert done.code == 2 and said in done.err, (words, done)
        assert done.err.count("\n") == 1 and not done.out, (words, done)
    assert not list(folder.glob("never*"))


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        check_rooms(folder)
        check_refused(folder)
        check_domes(folder)
        check_pole_and_base(folder)
        check_bodies(folder)
        check_run(folder)


main()
