# SPDX-License-Identifier: GPL-3.0-or-later
"""Files for other programs, of a run: read back by readers that are not ours where there is one, else
by the published grammar line by line; angles and thickness against plies/NAME.csv.

    exchange_formats_test.py TOOLS PROGRAM CASES

Leaves with 77 when numpy, scipy, h5py, meshio or VTK is missing.
"""

import csv
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import h5py
    import meshio
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

    from exchange_meshes import abaqus_text, disc, nastran_text
    from exchange.formed import read_formed
except ImportError as error:
    print("SKIPPED:", error)
    sys.exit(77)

TOOLS, PROGRAM, CASES = (Path(argument).resolve() for argument in sys.argv[1:4])
ALL = "csv,abaqus,calculix,acp,lsdyna,optistruct,openradioss,h5,vtu"
ANGLE, THICKNESS = 0.01, 1e-6  # degrees, mm or of the flat thickness


def call(*words, code=0):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)
    assert done.returncode == code, done
    return done


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {name: np.array([float(row[name] or "nan") for row in rows]) for name in rows[0]}


class Wanted:
    """What plies/NAME.csv says, with angles to the global x axis and to sides 1-2, by vectors only."""

    def __init__(self, folder, ply):
        columns = table(folder / "plies" / f"{ply.name}.csv")
        self.warp, self.weft = (np.column_stack([columns[f"{yarn}_{axis}"] for axis in "xyz"])
                                for yarn in ("warp", "weft"))
        self.thickness = columns["thickness_mm"]
        self.shear = columns["shear_angle_deg"]
        self.middle = np.column_stack([columns[axis] for axis in "xyz"])
        self.normal = np.cross(self.warp, self.weft)
        self.normal /= np.linalg.norm(self.normal, axis=1)[:, None]
        self.nominal, self.flat = ply.angle_deg, 0.6
        corners = ply.x[ply.triangles]
        self.side = corners[:, 1] - corners[:, 0]

    def angle(self, yarn, base):
        """Degrees from the projection of a direction (a vector, or one a triangle)."""
        base = np.broadcast_to(np.asarray(base, float), yarn.shape)
        base = base - (base * self.normal).sum(axis=1)[:, None] * self.normal
        base = base / np.linalg.norm(base, axis=1)[:, None]
        return np.degrees(np.arctan2((yarn * np.cross(self.normal, base)).sum(axis=1),
                                     (yarn * base).sum(axis=1)))


X = (1.0, 0.0, 0.0)


def close_angle(found, wanted, period=360.0):
    off = np.mod(np.asarray(found) - wanted + 0.5 * period, period) - 0.5 * period
    assert len(off) == len(wanted) and np.abs(off).max() < ANGLE, np.abs(off).max()


def close_thickness(found, wanted):
    assert np.abs(np.asarray(found) - wanted).max() < THICKNESS, np.abs(found - wanted).max()


def check_csv(folder, name, wanted):
    found = table(folder / f"{name}.csv")
    close_angle(found["warp_angle_deg"], wanted.angle(wanted.warp, X))
    close_angle(found["weft_angle_deg"], wanted.angle(wanted.weft, X))
    close_thickness(found["thickness_mm"], wanted.thickness)
    assert np.abs(found["shear_angle_deg"] - wanted.shear).max() < ANGLE
    assert np.allclose(np.column_stack([found[f"warp_{a}"] for a in "xyz"]), wanted.warp, atol=1e-8)


def check_acp(folder, name, wanted):
    found = table(folder / f"acp_{name}.csv")
    close_angle(found["draping_angle_1_deg"], wanted.angle(wanted.warp, X) - wanted.nominal, 180.0)
    close_angle(found["draping_angle_2_deg"], wanted.angle(wanted.weft, X) - wanted.nominal - 90.0,
                180.0)
    close_thickness(found["thickness_mm"], wanted.thickness)
    close_thickness(found["thickness_correction"], wanted.thickness / wanted.flat)
    assert np.allclose(np.column_stack([found[f"{a}_mm"] for a in "xyz"]), wanted.middle, atol=1e-5)
    compile((folder / "acp_tables.py").read_text(encoding="utf-8"), "acp_tables.py", "exec")


KEYWORDS = {  # *KEYWORD: its parameters; a data line below it
    "NODE": ((), r"\d+(, [-+.\de]+){3}"),
    "ELEMENT": (("TYPE",), r"\d+(, \d+){3,4}"),
    "DISTRIBUTION TABLE": (("NAME",), r"(COORD3D, COORD3D|LENGTH|ANGLE)"),
    "DISTRIBUTION": (("NAME", "LOCATION", "TABLE"), r"\d*(, [-+.\de]+)+"),
    "ORIENTATION": (("NAME", "SYSTEM", "DEFINITION"), r"(PLYFORM_AXES|3, 0\.)"),
    "ELSET": (("ELSET",), r"\d+(, \d+){0,15}"),
    "SHELL SECTION": (("ELSET", "COMPOSITE", "ORIENTATION"), r"\w+, 3, \w+, \w+, \w+"),
}


def abaqus_blocks(path):
    """Keyword, parameters and data lines of each block; every line as the grammar has it."""
    blocks = []
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            words = line[1:].split(", ")
            options = dict((*word.split("="), "")[:2] for word in words[1:])
            assert tuple(options) == KEYWORDS[words[0]][0], line
            blocks.append((words[0], options, []))
        else:
            assert re.fullmatch(KEYWORDS[blocks[-1][0]][1], line) and len(line) <= 256, line
            blocks[-1][2].append(line.split(", "))
    return blocks


def check_abaqus(folder, name, wanted):
    path = next(folder.glob(f"{name}_layup.inp"))
    blocks = abaqus_blocks(path)
    fields = {options["NAME"]: data for key, options, data in blocks if key == "DISTRIBUTION"}
    tables = {options["NAME"] for key, options, _ in blocks if key == "DISTRIBUTION TABLE"}
    assert all(options["TABLE"] in tables and data[0][0] == ""
               for key, options, data in blocks if key == "DISTRIBUTION")
    (_, options, layers), = [block for block in blocks if block[0] == "SHELL SECTION"]
    (_, _, listed), = [block for block in blocks if block[0] == "ELSET"]
    assert sum(map(len, listed)) == len(wanted.warp) and options["ORIENTATION"] == "PLYFORM_REFERENCE"
    (thickness, _, _, angle, _), = layers
    axes = np.array([[float(v) for v in row[1:]] for row in fields["PLYFORM_AXES"][1:]])
    angle = np.radians([float(row[1]) for row in fields[angle][1:]])[:, None]
    # what Abaqus makes of it: direction 1 of the system, turned about the normal
    a, b = axes[:, :3], axes[:, 3:]
    yarn = np.cos(angle) * a + np.sin(angle) * b
    off = np.degrees(np.arcsin(np.linalg.norm(np.cross(yarn, wanted.warp), axis=1)))
    assert off.max() < ANGLE and np.abs(angle).max() <= 0.5 * np.pi + 1e-9
    close_thickness([float(row[1]) for row in fields[thickness][1:]], wanted.thickness)
    read = meshio.read(path)
    middles = read.points[read.cells_dict["triangle"]].mean(axis=1)
    assert np.allclose(middles, wanted.middle, atol=1e-5)


def check_lsdyna(folder, name, wanted):
    lines = (folder / f"{name}_layup.k").read_text(encoding="utf-8").splitlines()
    lines = [line for line in lines if not line.startswith("$")]
    assert lines[0] == "*KEYWORD" and lines[-1] == "*END"
    at = lines.index("*ELEMENT_SHELL_COMPOSITE")
    nodes = {int(line[:8]): [float(line[8 + 16 * k:24 + 16 * k]) for k in range(3)]
             for line in lines[2:at]}
    elements, plies = lines[at + 1:-1:2], lines[at + 2:-1:2]
    assert all(len(line) == 48 for line in elements) and all(len(line) == 30 for line in plies)
    ends = np.array([[int(line[8 * k:8 * k + 8]) for k in range(6)] for line in elements])
    assert (ends[:, 5] == ends[:, 4]).all() and (ends[:, 0] == np.arange(1, len(ends) + 1)).all()
    side = np.array([np.subtract(nodes[two], nodes[one]) for one, two in ends[:, 2:4]])
    angle = [float(line[20:30]) for line in plies]
    assert {int(line[:10]) for line in plies} == {1}
    close_angle(angle, wanted.angle(wanted.warp, wanted.side))
    close_angle(angle, wanted.angle(wanted.warp, side))
    close_thickness([float(line[10:20]) for line in plies], wanted.thickness)


def check_optistruct(folder, name, wanted):
    path = folder / f"{name}_drape.fem"
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if line[0] != "$"]
    at = next(k for k, line in enumerate(lines) if line.startswith("DRAPE"))
    assert lines[0] == "BEGIN BULK" and lines.pop() == "ENDDATA" and lines[at] == "DRAPE          1"
    rows = [[line[8 * k:8 * k + 8] for k in range(5)] for line in lines[at + 1:]]
    assert all(len(line) == 40 for line in lines[at + 1:])
    assert all(row[:2] == ["+       ", "ELEM    "] and "." in row[3] and "." in row[4]
               for row in rows)
    assert [int(row[2]) for row in rows] == list(range(1, len(rows) + 1))
    close_thickness([float(row[3]) for row in rows], wanted.thickness / wanted.flat)
    close_angle([float(row[4]) for row in rows], wanted.angle(wanted.warp, X) - wanted.nominal, 180.0)
    read = meshio.read(path, "nastran")
    assert np.allclose(read.points[read.cells_dict["triangle"]].mean(axis=1), wanted.middle, atol=1e-5)


def check_openradioss(folder, name, wanted):
    lines = (folder / f"{name}_drape_0000.inc").read_text(encoding="utf-8").splitlines()
    lines = [line for line in lines if not line.startswith("#")]
    assert lines[:2] == ["/DRAPE/1", name]
    assert all(line[:10] == "SH3N      " and len(line) == 60 for line in lines[2:])
    assert [int(line[10:20]) for line in lines[2:]] == list(range(1, len(lines) - 1))
    close_thickness([float(line[20:40]) for line in lines[2:]], wanted.thickness / wanted.flat)
    close_angle([float(line[40:60]) for line in lines[2:]],
                wanted.angle(wanted.warp, X) - wanted.nominal, 180.0)


def check_h5(folder, name, wanted):
    """By the paths that are published: those a public script reads."""
    with h5py.File(folder / f"{name}_layup.h5") as file:
        root = file["composite_cae"]
        assert root.attrs["format_version"] == b"1.0" and root.attrs["length_unit"] == b"mm"
        (part,) = root["components"].values()
        assert part.attrs["TITLE"].decode() == part["material"].attrs["TITLE"].decode() == name
        assert part.attrs["layer_id"][0] == 1 and part.attrs["orientation"][0] == wanted.nominal
        data = part["data_map"]
        close_angle(data["matorient_0_angles"][:], wanted.angle(wanted.warp, X))
        close_angle(data["matorient_1_angles"][:], wanted.angle(wanted.weft, X))
        close_thickness(data["thicknesses"][:], wanted.thickness)
        (mesh,) = root["meshes"].values()
        for mesh in (mesh, part["mesh"]):
            middles = mesh["nodes"][:][mesh["element_nodes"][:]].mean(axis=1)
            assert np.allclose(middles, wanted.middle, atol=1e-5)

        def named(path, _):
            assert all(re.fullmatch(r"[a-zA-Z_][a-zA-Z0-9_]*", word) for word in path.split("/"))
        file.visititems(named)


def check_vtu(folder, name, wanted):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(folder / f"{name}_layup.vtu"))
    reader.Update()
    cells = reader.GetOutput().GetCellData()

    def field(key):
        return vtk_to_numpy(cells.GetArray(key))
    close_angle(field("warp_angle_deg"), wanted.angle(wanted.warp, X))
    close_angle(field("weft_angle_deg"), wanted.angle(wanted.weft, X))
    close_thickness(field("thickness_mm"), wanted.thickness)


def check_calculix(folder, name, wanted):
    """Axes and thickness of each element, and its six nodes; exchange_calculix_test.py solves such
    files."""
    lines = (folder / f"{name}_layup_calculix.inp").read_text(encoding="utf-8").splitlines()
    at = [k for k, line in enumerate(lines) if line.startswith("*ORIENTATION")]
    axes = np.array([[float(word) for word in lines[k + 1].split(",")] for k in at])
    assert np.allclose(axes[:, :3], wanted.warp, atol=1e-8)
    assert np.abs((axes[:, 3:] * wanted.warp).sum(axis=1)).max() < 1e-8
    at = [k for k, line in enumerate(lines) if line.startswith("*SHELL SECTION")]
    layers = [lines[k + 1].split(", ") for k in at]
    close_thickness([float(layer[0]) for layer in layers], wanted.thickness)
    assert {layer[2] for layer in layers} == {f"MATERIAL_{name}"}
    assert max(map(len, lines)) <= 132 or lines[0].startswith("**")
    labels = [lines[k - 1].split(", ") for k in at]
    assert [int(one) for one, _ in labels] == list(range(1, len(labels) + 1))
    alike = folder / f"{name}_meshio.inp"
    alike.write_text("\n".join(lines).replace("TYPE=S6", "TYPE=STRI65"), encoding="utf-8")
    read = meshio.read(alike)
    six = read.points[read.cells_dict["triangle6"]]
    assert np.allclose(six[:, :3].mean(axis=1), wanted.middle, atol=1e-5)
    assert np.allclose(six[:, 3:], 0.5 * (six[:, :3] + six[:, [1, 2, 0]]), atol=1e-8)


CHECKS = (check_csv, check_acp, check_abaqus, check_calculix, check_lsdyna, check_optistruct, check_openradioss,
          check_h5, check_vtu)


def check_own(results, folder):
    call("map", results, "--format", ALL, "-o", folder)
    for ply in read_formed(results).plies:
        for check in CHECKS:
            check(folder, ply.name, Wanted(results, ply))


def check_two(results, folder):
    """Each woven ply as two: half the thickness each, along warp and along weft."""
    call("map", results, "--two", "-o", folder)
    for ply in read_formed(results).plies:
        wanted = Wanted(results, ply)
        for yarn in ("warp", "weft"):
            found = table(folder / f"{ply.name}_{yarn}.csv")
            close_angle(found["warp_angle_deg"], wanted.angle(getattr(wanted, yarn), X))
            close_angle(found["weft_angle_deg"], found["warp_angle_deg"] + 90.0)
            close_thickness(found["thickness_mm"], 0.5 * wanted.thickness)


def check_part(results, folder, down):
    """On a part mesh: every format says the same; with normals down the stack layers in reverse."""
    mesh = disc(8.0, False, 75.0, 55.0)
    mesh.nodes[:, 2] = -mesh.nodes[:, 2] - 75.0  # the bowl of the case
    mesh.corners = mesh.corners[:, ::-1] if down else mesh.corners
    folder.mkdir()
    part = folder / "part.inp"
    part.write_text(abaqus_text(mesh), encoding="utf-8")
    names = [ply.name for ply in read_formed(results).plies][:2]
    done = call("map", results, "--onto", part, "--format", ALL, "--distance", 6, "-o", folder,
                "--ply", names[0], "--ply", names[1])
    assert f"of {len(mesh.labels)} elements have no ply" in done.stdout, done.stdout
    tables = {name: table(folder / f"{name}.csv") for name in names}
    covered = {name: np.isfinite(found["thickness_mm"]) for name, found in tables.items()}
    both = np.all(list(covered.values()), axis=0)
    assert both.mean() > 0.9
    blocks = abaqus_blocks(folder / "layup.inp")
    sections = [data for key, _, data in blocks if key == "SHELL SECTION"]
    assert [row[4] for row in max(sections, key=len)] == (names[::-1] if down else names)
    listed = np.concatenate([sum(data, []) for key, _, data in blocks if key == "ELSET"]).astype(int)
    assert (np.sort(listed) == mesh.labels[np.any(list(covered.values()), axis=0)]).all()
    lines = [line for line in (folder / "layup.k").read_text(encoding="utf-8").splitlines()
             if line[0] not in "$*"]
    heads = [line for line in lines if len(line) == 48]
    assert len(heads) == len(listed)
    thick = {int(head[:8]): line for head, line in zip(heads, lines[1::2])}
    for label in mesh.labels[both]:
        row = int(np.flatnonzero(tables[names[0]]["element"] == label)[0])
        pair = [float(thick[label][10:20]), float(thick[label][50:60])]
        wanted = [tables[name]["thickness_mm"][row] for name in names]
        close_thickness(pair, wanted[::-1] if down else wanted)
    grid = meshio.read(folder / "layup.vtu")
    for name in names:
        assert np.allclose(np.concatenate(grid.cell_data[f"{name} warp_angle_deg"]),
                           tables[name]["warp_angle_deg"], atol=1e-6, equal_nan=True)
    report = table_of_names(folder / "mapping.csv")
    assert [row["ply"] for row in report] == names
    assert all(float(row["there_and_back_angle_rms_deg"]) < 2.0 for row in report), report
    for name, row in zip(names, report):
        assert int(row["covered"]) == covered[name].sum()
        assert int(row["normals_down"]) == (covered[name].sum() if down else 0)
    warned = "turn their normals round" in (folder / "drape.fem").read_text(encoding="utf-8")
    assert warned == down


def check_axes(results, folder):
    """Material axes of the part mesh are what angles are measured from, or that they are not is told on
    screen and in every file."""
    mesh = disc(12.0, False, 75.0, 50.0)
    mesh.nodes[:, 2] = -mesh.nodes[:, 2] - 75.0
    folder.mkdir()
    part, plain = folder / "part.bdf", folder / "plain.bdf"
    lines = nastran_text(mesh).splitlines()
    lines.insert(3, "CORD2C,7,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.")
    plain.write_text("\n".join(lines), encoding="utf-8")
    part.write_text("\n".join(line + f"{7:8d}" if line.startswith("CQUAD4") else line for line in lines),
                    encoding="utf-8")
    name = read_formed(results).plies[0].name

    def mapped(file, *words):
        done = call("map", results, "--onto", file, "--distance", 8, "--ply", name, "--format",
                    "csv,abaqus,optistruct,openradioss,acp", "-o", folder, *words)
        return done.stdout, {path.name: path.read_text(encoding="utf-8")[:2000] for path in
                             (*folder.glob("*.csv"), folder / "layup.inp", folder / "drape.fem",
                              folder / "drape_0000.inc")}, table(folder / f"{name}.csv")
    said, files, radial = mapped(part)
    for text in (said, *files.values()):
        assert "material axes of the part mesh: MCID 7 (cylindrical: its radial direction) of" in text
    said, files, along_x = mapped(part, "--reference", "x")
    for text in (said, *files.values()):
        assert "MCID 7" in text and "are not used: --reference asks for global x" in text
    angle = np.degrees(np.arctan2(*disc_middles(mesh).T[[1, 0]]))
    close = np.abs(angle) < 20  # there a projected x axis lies as the radius, turned by this angle
    assert close.sum() > 5
    off = along_x["warp_angle_deg"] - radial["warp_angle_deg"]
    off = np.mod(off - angle + 180, 360) - 180
    assert np.abs(off[close]).max() < 8.0, np.abs(off[close]).max()
    said, files, _ = mapped(plain)
    assert "measured from: global x" in said and "MCID" not in said
    done = call("map", results, "--onto", plain, "--reference", "part", "--distance", 8, code=2)
    assert "gives no material axes" in done.stderr


def disc_middles(mesh):
    return mesh.nodes[mesh.corners].mean(axis=1)


def table_of_names(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def check_wrong(results, folder):
    mesh = disc(20.0, False)
    mesh.nodes = 0.001 * mesh.nodes
    metres = folder / "metres.inp"
    metres.write_text(abaqus_text(mesh), encoding="utf-8")
    mesh.nodes = 1000.0 * mesh.nodes + (0.0, 0.0, 900.0)
    far = folder / "far.inp"
    far.write_text(abaqus_text(mesh), encoding="utf-8")
    mesh = disc(20.0, False)
    mesh.nodes[:, 2] = -mesh.nodes[:, 2] - 75.0
    mesh.labels = mesh.labels + 100000000
    numbers = folder / "numbers.inp"
    numbers.write_text(abaqus_text(mesh), encoding="utf-8")
    for name in ("lsdyna", "optistruct"):
        done = call("map", results, "--onto", numbers, "--format", name, "-o", folder / "many", code=2)
        assert "has room for 99999999" in done.stderr and done.stderr.count("\n") == 1, done
    unknown = folder / "unknown.inp"
    unknown.write_text(abaqus_text(mesh, four="Q4X"), encoding="utf-8")
    for words, told in ((("--onto", metres), "give --scale 1000"),
                        (("--onto", far), "no element lies within"),
                        (("--onto", unknown), "element type Q4X is not known"),
                        (("--onto", folder / "none.inp"), "is missing"),
                        (("--format", "inp"), "--format inp: formats are csv"),
                        (("--reference", "0,0,0"), "--reference 0,0,0: a reference direction"),
                        (("--frame", 99), "has no frame 99"),
                        (("--ply", "none"), "there is no ply none"),
                        (("--share", 2), "a share is above 0"),
                        (("--scale", "nan"), "--scale and --distance are positive")):
        done = call("map", results, *words, "-o", folder / "wrong", code=2)
        assert told in done.stderr and done.stderr.count("\n") == 1, done
    assert "results.h5 is missing" in call("map", folder, code=2).stderr
    assert not (folder / "wrong").exists()


DIAPHRAGM = """
[fabrics]
glass = "fabrics/glass_plain_weave.toml"
rubber = {law = "neo_hookean", surface_density = 1100.0, thickness = 1.0, neo_hookean = {shear_modulus = 0.4}}
foil = {law = "isotropic", surface_density = 100.0, thickness = 0.1, isotropic = {youngs_modulus = 50.0, poissons_ratio = 0.3}}
[blanks]
small = {size = [72.0, 72.0], element_size = 12.0}
big = {size = [120.0, 120.0], element_size = 12.0}
[stack]
bottom = 0.0
[solver]
duration = 0.002
fibre_softening = 200.0
[[ply]]
name = "cloth"
fabric = "glass"
blank = "small"
angle = 0.0
[[ply]]
name = "foil"
fabric = "foil"
blank = "small"
angle = 0.0
[[ply]]
name = "skin"
fabric = "rubber"
blank = "big"
angle = 0.0
[[tool]]
name = "dome"
shape = "sphere"
radius = 60.0
position = [0.0, 0.0, 62.0]
motion = "driven"
stroke = 0.5
"""


def check_process_aids(folder):
    """The lay-up of a part is its fibres: diaphragm and foil are in no file unless asked for, and told."""
    shutil.copytree(CASES / "fabrics", folder / "fabrics")
    (folder / "case.toml").write_text(DIAPHRAGM, encoding="utf-8")
    run, part, trim = folder / "pressed", folder / "plane.inp", folder / "trim.csv"
    call("run", folder / "case.toml", "--threads", "1", "-o", run)
    mesh = disc(20.0, False)
    mesh.nodes[:, 2] = 0.0
    part.write_text(abaqus_text(mesh), encoding="utf-8")
    trim.write_text("x,y\n-30,-30\n30,-30\n30,30\n-30,30\n", encoding="utf-8")
    for words in (("map", run, "--onto", part, "--format", ALL, "-o", folder / "a"),
                  ("map", run, "--format", ALL, "-o", folder / "b"),
                  ("pattern", run, "--trim", trim, "-o", folder / "c")):
        done = call(*words)
        assert "left out, without fibres: foil, skin (--ply" in done.stdout, done
        for file in Path(words[-1]).iterdir():
            assert not file.name.startswith(("skin", "foil")), file
            told = [line for line in file.read_bytes().splitlines() if b"skin" in line]
            assert all(b"left out, without fibres" in line for line in told), (file, told)
    done = call("map", run, "--ply", "skin", "--format", "csv", "-o", folder / "d")
    assert (folder / "d/skin.csv").exists() and "left out" not in done.stdout, done
    (run / "summary.json").unlink()  # as while a run goes on: rubber is known by its columns
    assert "left out, without fibres: skin (--ply" in call("map", run, "-o", folder / "e").stdout


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        results = folder / "run"
        call("run", CASES / "hemisphere_two_ply", "--set",
             "blanks.square.mesh_from=element_size", "--set", "blanks.square.element_size=17", "--set",
             "solver.duration=0.02", "--set", "solver.outputs=2", "--threads", "1", "-o", results)
        check_own(results, folder / "own")
        check_two(results, folder / "two")
        check_part(results, folder / "part", False)
        check_part(results, folder / "down", True)
        check_axes(results, folder / "axes")
        check_wrong(results, folder)
        check_process_aids(folder)


if __name__ == "__main__":
    main()
