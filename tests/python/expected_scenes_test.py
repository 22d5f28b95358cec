# SPDX-License-Identifier: GPL-3.0-or-later
"""Small scenes of which anyone knows what to expect, each a row: the case, what is measured of its
run, and between which values that lies.

    expected_scenes_test.py PROGRAM

Leaves with 77 when numpy or h5py is missing.
"""

import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import h5py
    import numpy as np
except ImportError as error:
    print("SKIPPED:", error)
    sys.exit(77)

PROGRAM = Path(sys.argv[1]).resolve()

WOVEN = """
[fabrics.cloth]
surface_density = 600.0
thickness = {thickness}
warp = {{density = 0.25, stiffness = 4600.0, compression_stiffness = 46, bending_stiffness = 2.0, in_plane_bending_stiffness = 9.3}}
weft = {{density = 0.25, stiffness = 4600.0, compression_stiffness = 46, bending_stiffness = 2.0, in_plane_bending_stiffness = 9.3}}
shear = {{polynomial = [0.37, 0.84, 1.03]}}
"""
CLOTH = WOVEN.format(thickness=0.6)
RUBBER = """
[fabrics.cloth]
law = "neo_hookean"
surface_density = 1650.0
thickness = 1.5
neo_hookean = {shear_modulus = 0.29}
"""
# bends by 0.4 and 0.1 N mm along its fibres, by 0.1 across them
TAPE = """
gravity = [0, 0, -9810]
[fabrics.cloth]
surface_density = 200.0
thickness = 0.2
family = [{name = "fibre", angle = 0.0, density = 0.5, stiffness = 5000.0, bending_stiffness = 0.4}]
sheet = {youngs_modulus = 0.5, poissons_ratio = 0.3, bending_stiffness = 0.1}
"""


def blank(size, element, name="blank", mesh="alternating", more=""):
    return f'[blanks.{name}]\n{size}\nmesh = "{mesh}"\nelement_size = {element}\n{more}\n'


def ply(name, angle=0.0, of="blank", more=""):
    return f'[[ply]]\nname = "{name}"\nfabric = "cloth"\nblank = "{of}"\nangle = {angle}\n{more}\n'


def tool(name, shape, more=""):
    return f'[[tool]]\nname = "{name}"\nshape = "{shape}"\n{more}\n'


def solver(duration, outputs=2, **more):
    rows = "\n".join(f"{key} = {value}" for key, value in more.items())
    return f"[solver]\nduration = {duration}\noutputs = {outputs}\n{rows}\n"


FLOOR = tool("floor", "plane")


def press(force, height, shape="plane", more="axis = [0, 0, -1]"):
    return tool("press", shape, f'{more}\nposition = [0, 0, {height}]\nmotion = "force"\n'
                f"force_programme = [[0.5, {force}], [1.0, {force}]]")


def strip(angle):
    """Of 30 mm beyond its clamp, which bends with half an element of it: 31.5 mm."""
    return (TAPE + blank("size = [36, 9]", 3.0, mesh="diagonal") + ply("strip", angle)
            + '[[boundary]]\nname = "clamp"\nkind = "grip"\nbox = [[-19, -7], [-12, 7]]\n'
            + solver(0.3, mass_damping=150.0, fibre_softening=1000.0))


def bag(mesh, more=""):
    return (RUBBER + blank("size = [60, 40]", 6.0, mesh=mesh, more=more) + ply("sheet") + FLOOR
            + '[[load]]\nply = "sheet"\nside = "above"\npressure_programme = [[0.5, 0.02]]\n'
            + solver(0.02, dwell=1.0, mass_damping=1500))


def pieces(apart):
    """Of 30 mm each, side by side under a plate."""
    half = 0.5 * apart
    left = f"outline = [[-30, -15], [{-half}, -15], [{-half}, 15], [-30, 15]]"
    right = f"outline = [[{half}, -15], [30, -15], [30, 15], [{half}, 15]]"
    return (CLOTH + blank(left, 7.5, "left") + blank(right, 7.5, "right")
            + ply("left", of="left", more="z = 0.3") + ply("right", of="right", more="z = 0.3")
            + FLOOR + press(10, 0.6) + solver(0.01, dwell=1.0, mass_damping=1000))


PENDULUM = ("gravity = [0, 0, -9810]\n" + CLOTH.replace("bending_stiffness = 2.0", "bending_stiffness = 200.0")
            .replace("compression_stiffness = 46", "compression_stiffness = 4600")
            + blank("size = [40, 10]", 10.0, mesh="diagonal") + ply("strip")
            + '[[boundary]]\nname = "pin"\nkind = "grip"\nedge = [[-20, -5], [-20, 5]]\n'
            + solver(0.25, 50, fibre_damping=0, fibre_softening=100))
UNDER_A_PLATE = (CLOTH + blank("size = [40, 40]", 5.0) + ply("sheet") + FLOOR
                 + press(16, 5.6, "box", "size = [60, 60, 10]\nedge_radius = 1.0")
                 + solver(0.005, dwell=1.0, mass_damping=1000))
THICK = (WOVEN.format(thickness=3.0) + blank("size = [20, 20]", 2.0) + ply("lower") + ply("upper", 45)
         + FLOOR + tool("roller", "sphere", 'radius = 12\nposition = [0, 0, 18]\nmotion = "driven"\nstroke = 0.1')
         + solver(0.002))
BALL = 'radius = 15\nmotion = "force"\nforce_programme = [[0.5, 30], [1.0, 30]]\n'
THIN = (CLOTH + blank("size = [40, 40]", 5.0) + ply("lower", more="z = -0.8") + ply("upper", 45, more="z = 0.8")
        + tool("thin", "box", "size = [60, 60, 1]\nedge_radius = 0.4\nposition = [0, 0, 0]")
        + tool("above", "sphere", BALL + "position = [0, 0, 16.1]")
        + tool("below", "sphere", BALL + "position = [4, 3, -16.1]\ndirection = [0, 0, 1]")
        + solver(0.01))


class Run:
    """Of a case that ends as `done` or `doubtful`."""

    def __init__(self, folder, text):
        path = folder / "case.toml"
        path.write_text(text, encoding="utf-8")
        done = subprocess.run([PROGRAM, "run", path, "-o", folder / "run", "--threads", "1"],
                              capture_output=True, text=True, check=False)
        assert done.returncode == 0, done
        self.summary = json.loads((folder / "run/summary.json").read_text(encoding="utf-8"))
        with (folder / "run/history.csv").open(encoding="utf-8", newline="") as file:
            self.history = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        with h5py.File(folder / "run/results.h5") as file:
            self.x0 = {name: ply["x0"][:] for name, ply in file["plies"].items()}
            self.frames = [{name: {key: ply[key][:] for key in ("x", "contact_pressure")}
                            for name, ply in frame["plies"].items()}
                           for _, frame in sorted(file["frames"].items())]

    def height(self, name, frame=-1):
        return self.frames[frame][name]["x"][:, 2]

    def moved(self, name, frame=-1):
        return self.frames[frame][name]["x"] - self.x0[name]

    def force(self, name):
        return next(abs(tool["force_N"]) for tool in self.summary["tools"] if tool["name"] == name)

    def pressures(self):
        """Of each node over the mean of all."""
        pressure = self.frames[-1]["sheet"]["contact_pressure"]
        return pressure / pressure.mean()


def droop(run):
    return -run.moved("strip")[:, 2].min()


def end_height(run):
    """Of the end that swings, at each state, from where it began."""
    node = run.x0["strip"][:, 0].argmax()
    return np.array([run.moved("strip", k)[node, 2] for k in range(len(run.frames))])


def per_bending(stiffness):
    """w = q L^4 / (8 B) of a clamped strip, and 2 % around it."""
    droops = 200e-12 * 9810.0 * 31.5**4 / (8.0 * stiffness)
    return 0.98 * droops, 1.02 * droops


# name, case, what is measured, least, most
SCENES = [
    ("strip of a tape along its fibres", strip(0), droop, *per_bending(0.5)),
    ("and across them", strip(90), droop, *per_bending(0.1)),
    ("bag pressure on one size of elements", bag("alternating"), lambda run: run.force("floor"), 47.95, 48.05),
    ("on graded ones", bag("alternating", "zone = [{element_size = 2.5, radius = 10.0}]"),
     lambda run: run.force("floor"), 47.95, 48.05),
    ("on free ones", bag("free"), lambda run: run.force("floor"), 47.95, 48.05),
    ("a swinging strip keeps its energy", PENDULUM, lambda run: run.summary["energy"]["balance_error"], -1e-4, 1e-4),
    ("and comes up as high on the other side", PENDULUM, lambda run: end_height(run)[25:].max(), -0.3, 0.1),
    ("after hanging down", PENDULUM, lambda run: end_height(run).min(), -41.0, -38.0),
    ("pressure under a plate, lowest over mean", UNDER_A_PLATE, lambda run: run.pressures().min(), 0.99, 1.0),
    ("and highest", UNDER_A_PLATE, lambda run: run.pressures().max(), 1.0, 1.01),
    ("a ply thicker than its elements, where it starts", THICK,
     lambda run: max(np.abs(run.moved(name, 1)).max() for name in ("lower", "upper")), 0.0, 0.1),
    ("and no deeper in another", THICK, lambda run: run.summary["contact"]["max_ply_penetration_mm"], 0.0, 0.06),
    ("plies on both sides of a thin tool: the upper", THIN, lambda run: run.height("upper").min(), 0.7, 0.8),
    ("the lower", THIN, lambda run: run.height("lower").max(), -0.8, -0.7),
    ("two pieces of a ply stay where they are", pieces(0.7),
     lambda run: max(np.abs(run.moved(name)[:, :2]).max() for name in ("left", "right")), 0.0, 1e-6),
]


def check_scenes():
    runs = {}
    with tempfile.TemporaryDirectory() as name:
        for number, (what, text, measure, least, most) in enumerate(SCENES):
            folder = Path(name) / str(number)
            folder.mkdir()
            if text not in runs:
                runs[text] = Run(folder, text)
            value = measure(runs[text])
            print(f"{what}: {value:.6g}, expected {least:.6g} to {most:.6g}", flush=True)
            assert least <= value <= most, what


CUP = (blank("radius = 30", 6.0) + ply("sheet", 20)
       + tool("punch", "sphere", 'radius = 12\nposition = [0, 0, 12.6]\nmotion = "driven"\nstroke = 8')
       + tool("die", "profile", "points = [[16, -30], [16, 0, 7], [60, 0]]")
       + tool("press", "annulus", "inner_radius = 23\nouter_radius = 50\nthickness = 5\nedge_radius = 2\n"
              'position = [0, 0, 0.6]\nmotion = "force"\nforce_programme = [[0.5, 20], [0.6, 20], [1, 20]]'))
COOLING = """
[process]
duration = 4.0
[process.cooling]
tool_conductance = 400.0
ply_conductance = 500.0
air_conductance = 20.0
surroundings = 25.0
"""


def both(text, old, new):
    """Runs of a case and of one with this in the place of that."""
    assert old in text
    with tempfile.TemporaryDirectory() as name:
        folders = [Path(name, one) for one in ("one", "other")]
        for folder in folders:
            folder.mkdir()
        return Run(folders[0], text), Run(folders[1], text.replace(old, new))


def check_programme():
    """A force that changes from half of the stroke on changes nothing before."""
    one, other = both(CLOTH + CUP + solver(0.008, 8), "[0.6, 20], [1, 20]", "[0.6, 60], [1, 60]")
    for k, (a, b) in enumerate(zip(one.frames, other.frames)):
        assert np.array_equal(a["sheet"]["x"], b["sheet"]["x"]) == (k <= 4), k


def check_step():
    """Tools that are at 60 degrees from half of the time on, all at once, give the ply no jerk: forces go
    on from where they were, the balance of energies is closed, and the melt is stiffer at the end."""
    hot = "temperature_programme = [[2.0, 180.0], [2.0001, 180.0]]"
    melt = (CLOTH.replace("polynomial = [0.37, 0.84, 1.03]", "polynomial = [0.2], viscosity = [2.0]")
            + "[fabrics.cloth.temperature]\nreference = 180.0\nviscosity = {activation_energy = 40.0}\n"
            ).replace("thickness = 0.6", "thickness = 0.6\nheat_capacity = 1.0")
    cup = CUP.replace("angle = 20", "angle = 20\ntemperature = 180").replace("[[tool]]", f"[[tool]]\n{hot}")
    one, other = both(melt + cup + COOLING + solver(0.008, 40), "[2.0001, 180.0]", "[2.0001, 60.0]")
    forces = [np.array([row["punch_force_N"] for row in run.history]) for run in (one, other)]
    print(f"punch: {forces[0][-1]:.3g} N hot, {forces[1][-1]:.3g} N cold")
    assert np.array_equal(forces[0][:21], forces[1][:21])
    apart = np.abs(forces[1] - forces[0])
    assert apart[21] < 0.02 * forces[0][21] and apart[-1] > 0.02 * forces[0][-1]
    assert (np.diff(apart[20:]) < 0.15 * forces[0].max()).all()
    assert abs(other.summary["energy"]["balance_error"]) < 2e-3


def check_facets():
    """A sheet that is pressed onto half a cylinder of 12 facets lies on them: between their edges it is
    as much nearer to the axis as the chords are, and no more."""
    def sheet(step):
        angles = np.radians(np.arange(-90.0, 90.1, step))
        around = [f"[{30 * np.sin(a):.9g}, {30 * np.cos(a) - 30:.9g}]" for a in angles]
        return (RUBBER + blank("size = [96, 12]", 3.0) + ply("sheet")
                + tool("drum", "extrusion", f"points = [[-30, -40], {', '.join(around)}, [30, -40]]\nlength = 60")
                + "".join(f'[[boundary]]\nname = "x{x}"\nkind = "grip"\nedge = [[{x}, -6], [{x}, 6]]\n'
                          for x in (-48, 48))
                + '[[load]]\nply = "sheet"\nside = "above"\npressure_programme = [[0.5, 0.02], [1.0, 0.02]]\n'
                + solver(0.05, dwell=1.0, mass_damping=300))

    def radii(step):
        with tempfile.TemporaryDirectory() as name:
            x = Run(Path(name), sheet(step)).frames[-1]["sheet"]["x"]
        radius, angle = np.hypot(x[:, 0], x[:, 2] + 30.0), np.arctan2(x[:, 0], x[:, 2] + 30.0)
        return radius[np.abs(angle) < np.radians(45.0)]

    coarse, fine = radii(15.0), radii(1.5)
    nearer, sag = fine - coarse, 30.0 * (1.0 - np.cos(np.radians(7.5)))
    print(f"facets: {nearer.min():.3f} to {nearer.max():.3f} mm nearer, chords {sag:.3f} mm")
    assert nearer.min() > -0.01 and 0.5 * sag < nearer.max() < sag + 0.01


def check(folder, text):
    path = folder / "case.toml"
    path.write_text(text, encoding="utf-8")
    return subprocess.run([PROGRAM, "check", path], capture_output=True, text=True, check=False)


def check_meshes():
    """A triangle of a blank file that is listed the other way round is the same triangle; one that is
    folded over its neighbour is refused, and so are pieces nearer each other than they are thick."""
    nodes = ["0 0 0", "40 0 0", "40 30 0", "0 30 0", "20 15 0"]
    around = ["3 0 1 4", "3 1 2 4", "3 2 3 4", "3 3 0 4"]
    text = (CLOTH + '[blanks.blank]\nmesh = "file"\nfile = "blank.off"\n' + ply("sheet") + FLOOR + press(2, 0.6)
            + solver(0.002))
    with tempfile.TemporaryDirectory() as name:
        folder, ends = Path(name), []
        for triangles in (around, [*around[:2], "3 2 4 3", around[3]]):
            (folder / "blank.off").write_text("\n".join(["OFF", "5 4 0", *nodes, *triangles]), encoding="utf-8")
            ends.append(Run(folder, text.replace('"blank.off"', f"'{folder}/blank.off'")).frames[-1]["sheet"]["x"])
        assert np.allclose(ends[0][ends[0][:, 0].argsort()], ends[1][ends[1][:, 0].argsort()], atol=1e-9)
        (folder / "blank.off").write_text("\n".join(["OFF", "5 4 0", *nodes[:4], "20 40 0", *around]),
                                          encoding="utf-8")
        done = check(folder, text)
        assert done.returncode == 2 and "triangles overlap along the edge from (20, 40) to (0, 30)" in done.stderr, done
        for apart, told in ((0.5, "0.5 mm apart, edge to edge, and need 0.6 mm"), (0.0, "0 mm apart and need 0.6 mm")):
            done = check(folder, pieces(apart))
            assert done.returncode == 2 and told in done.stderr, done


if __name__ == "__main__":
    check_scenes()
    check_programme()
    check_step()
    check_facets()
    check_meshes()
