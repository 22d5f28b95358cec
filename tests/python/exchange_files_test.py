# SPDX-License-Identifier: GPL-3.0-or-later
"""Part meshes of other programs: read as they were written, and as meshio reads them; and what is
wrong with a file told in one line.

    exchange_files_test.py TOOLS

Leaves with 77 when numpy, scipy, h5py or meshio is missing.
"""

import re
import sys
import tempfile
import warnings
from pathlib import Path

try:
    import meshio
    import numpy as np

    from exchange_meshes import TEXTS, disc, dome_ply, grid, shell_mesh
    from exchange.part_files import check_size, placed, read_part
    from exchange.shell_mesh import patches
    from plotting.reading import Trouble
except ImportError as error:
    print("SKIPPED:", error)
    sys.exit(77)


def mixed():
    """Quadrilaterals, some of them cut into triangles."""
    mesh = disc(20.0, False)
    corners = mesh.corners
    cut = np.arange(len(corners)) % 3 == 0
    three = np.vstack([corners[cut][:, [0, 1, 2]], corners[cut][:, [0, 2, 3]]])
    three = np.column_stack([three, np.full(len(three), -1)])
    return shell_mesh(np.round(mesh.nodes, 6), np.vstack([three, corners[~cut]]))


def same(read, mesh, labels=True):
    assert np.allclose(read.nodes[read.corners[:, :3]], mesh.nodes[mesh.corners[:, :3]], atol=2e-6)
    four = ~mesh.triangular()
    assert (read.triangular() == mesh.triangular()).all()
    assert np.allclose(read.nodes[read.corners[four, 3]], mesh.nodes[mesh.corners[four, 3]],
                       atol=2e-6)
    if labels:
        assert (read.labels == mesh.labels).all()
        assert (read.node_labels[read.corners[:, 0]] == mesh.node_labels[mesh.corners[:, 0]]).all()


def check_readers(folder):
    mesh = mixed()
    for ending, text in TEXTS.items():
        path = folder / ("part" + ending)
        path.write_text(text(mesh), encoding="utf-8")
        read = read_part(path)
        same(read, mesh)
        if ending != ".inp":
            assert (read.parts == mesh.parts).all()
        if ending in (".inp", ".bdf"):  # a reader that is not ours
            other = meshio.read(path)
            blocks = {block.type: block.data for block in other.cells}
            for kind, rows in (("triangle", mesh.triangular()), ("quad", ~mesh.triangular())):
                assert np.allclose(other.points[blocks[kind]],
                                   read.nodes[read.corners[rows][:, :blocks[kind].shape[1]]])
    cells = [("triangle", mesh.corners[mesh.triangular(), :3]), ("quad", mesh.corners[~mesh.triangular()])]
    meshio.write(folder / "part.vtu", meshio.Mesh(mesh.nodes, [*cells, ("line", [[0, 1]])]))
    read = read_part(folder / "part.vtu")
    same(read, mesh, labels=False)
    assert read.left_out == {"line": 1}


SMALL = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,2,0,0\n"
GRIDS = "GRID,1,,0.,0.,0.\nGRID,2,,1.+0,0.,0.\nGRID,3,,1.,1.D0,0.\nGRID,4,,0.,1.,0.\n"


def check_more_grammar(folder):
    """What the decks of others have: quadratic shells, continued lines, includes, other elements,
    commas, options with cards of their own."""
    (folder / "sub.inp").write_text(SMALL, encoding="utf-8")
    mesh = read(folder, "a.inp", "*heading\n*INCLUDE, INPUT=sub.inp\n*ELEMENT,TYPE=S4R,ELSET=E\n"
                "7,1,2,\n3,4\n*ELEMENT, TYPE=B31\n8,1,2\n*BOUNDARY\n1,1,6\n")
    assert (mesh.labels == [7]).all() and mesh.left_out == {"B31": 1}
    mesh = read(folder, "b.inp", SMALL + "6,1.5,0.5,0\n*ELEMENT,TYPE=STRI65\n9,1,2,3,4,5,6\n")
    assert mesh.triangular().all()
    mesh = read(folder, "c.bdf", GRIDS + "CQUAD4,5,3,1,2,3,4,30.\nCBAR,6,1,1,2\nCTRIA6,7,3,1,2,3,4,\n"
                "+,4,4\n$ end\n")
    assert (mesh.labels == [5, 7]).all() and mesh.left_out == {"CBAR": 1}
    assert np.allclose(mesh.nodes[1:3], [(1, 0, 0), (1, 1, 0)])
    mesh = read(folder, "d.k", "*KEYWORD\n*NODE\n1,0.,0.,0.\n2,1.,0.,0.\n3,1.,1.,0.\n4,0.,1.,0.\n"
                "*ELEMENT_SHELL_BETA\n       1       2       1       2       3       4\n"
                "             0.0             0.0             0.0             0.0            30.0\n"
                "       2       2       1       2       3       3\n"
                "             0.0             0.0             0.0             0.0            30.0\n"
                "*ELEMENT_SHELL_COMPOSITE\n       3       2       1       2       4       4\n"
                "         1       0.5      30.0                   1       0.5      60.0\n"
                "*ELEMENT_BEAM\n       4       2       1       2       3\n*END\n")
    assert (mesh.labels == [1, 2, 3]).all() and (mesh.triangular() == [False, True, True]).all()
    assert mesh.left_out == {"ELEMENT_BEAM": 1}


def read(folder, name, text):
    (folder / name).write_text(text, encoding="utf-8")
    return read_part(folder / name)


WRONG = [
    ("a.inp", SMALL + "*ELEMENT,TYPE=S7X\n1,1,2,3\n", ":7: element type S7X is not known: shells"),
    ("a.inp", SMALL + "*ELEMENT,TYPE=S4\n1,1,2,3\n", ":8: element 1 has 3 nodes: S4 has 4"),
    ("a.inp", SMALL + "*ELEMENT,TYPE=S3\n1,1,2,9\n", ":8: element 1 has node 9, which is not"),
    ("a.inp", SMALL + "*ELEMENT,TYPE=S3\n1,1,2,3\n1,2,3,4\n", ":9: element 1 is there twice"),
    ("a.inp", SMALL + "*ELEMENT,TYPE=S3\n1,1,2,5\n", "element 1 has no area"),
    ("a.inp", SMALL + "*ELEMENT,TYPE=S3\n1,1,2,2\n", ":8: element 1 has the corners 1, 2, 2"),
    ("a.inp", SMALL + "*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n", "no shell element (it has 1 C3D4"),
    ("a.inp", SMALL + "*NGEN\n1,5\n", ":7: *NGEN makes or moves nodes"),
    ("a.inp", "*NODE\n1,0,zero,0\n", ":2: a coordinate is 'zero', not a number"),
    ("a.inp", "*NODE\n1,0,nan,0\n", ":2: node 1 has a coordinate that is no length: (0.0, nan, 0.0)"),
    ("a.inp", "*INCLUDE, INPUT=none.inp\n", "none.inp, which is missing"),
    ("a.inp", "*INCLUDE, INPUT=a.inp\n", "includes go 8 files deep"),
    ("a.inp", "*PART, NAME=A\n*END PART\n*PART, NAME=B\n", ":3: a second *PART"),
    ("a.bdf", GRIDS + "CQUADZ,5,3,1,2,3,4\n", ":5: element type CQUADZ is not known"),
    ("a.bdf", "GRID,1,7,0.,0.,0.\n", ":1: grid point 1 stands in coordinate system 7"),
    ("a.bdf", GRIDS, "has no shell element"),
    ("a.k", "*NODE\n1,0,0,0\n*ELEMENT_SHELL_NURBS\n", ":3: *ELEMENT_SHELL_NURBS is not known"),
    ("a.cdb", "ET,1,999\nEBLOCK,19,SOLID,1,1\n(19i9)\n" + "".join(
        f"{v:9d}" for v in (1, 1, 1, 1, 0, 0, 0, 0, 4, 0, 1, 1, 2, 3, 4)) + "\n       -1\n",
     ":4: element 1 is of type 999, which is not known"),
    ("a.cdb", "NBLOCK,6,SOLID\n(something)\n", ":2: a block's widths are '(something)'"),
    ("a.cdb", "N,1,0,0,0\n", ":1: N commands are not read"),
    ("a.vtu", "no XML", "cannot be read as VTU"),
    ("a.stp", "", "a part mesh ends in .inp"),
]


def check_wrong(folder):
    for name, text, words in WRONG:
        try:
            read(folder, name, text)
        except Trouble as problem:
            assert words in str(problem) and "\n" not in str(problem), (words, str(problem))
        else:
            raise AssertionError(f"{name} was read: {words}")
    for number, (size, words) in enumerate(((0.001, "may be in metres: give --scale 1000"),
                                            (0.1, None), (1 / 25.4, "inches: give --scale 25.4"))):
        mesh = disc(20.0, False)
        mesh.nodes = size * mesh.nodes
        mesh.path = folder / f"size{number}.inp"
        try:
            check_size(mesh, [dome_ply(0.0)])
            assert words is None
        except Trouble as problem:
            assert words and words in str(problem), problem


def check_damaged(folder):
    """Bytes changed, cut out or put in: each file is read, or refused in one line."""
    random = np.random.default_rng(3)
    mesh = disc(60.0, False)
    meshio.vtu.write(folder / "whole.vtu", meshio.Mesh(mesh.nodes, [("quad", mesh.corners)]))
    texts = {ending: text(mesh).encode() for ending, text in TEXTS.items()}
    texts[".vtu"] = (folder / "whole.vtu").read_bytes()
    for ending, whole in texts.items():
        refused = 0
        for _ in range(100):
            damaged = bytearray(whole)
            at = int(random.integers(len(damaged)))
            kind = random.integers(3)
            if kind == 0:
                damaged[at] = random.integers(32, 127)
            elif kind == 1:
                del damaged[at:at + int(random.integers(1, 60))]
            else:
                damaged[at:at] = random.integers(32, 127, 9).astype(np.uint8).tobytes()
            path = folder / ("damaged" + ending)
            path.write_bytes(bytes(damaged))
            try:
                read_part(path)
            except Trouble as problem:
                refused += 1
                assert str(path) in str(problem) and "\n" not in str(problem), problem
        assert refused > 10, ending


SYSTEMS = {".bdf": "CORD2R,5,,0.,0.,0.,0.,0.,1.\n,0.8660254,0.5,0.\nCORD2C,7,5,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
           "CORD1R,8,11,12,13\nCQUAD8,9001,1,11,12,13,14\n,,,,,,,25.\nCTRIA6,9002,1,11,12,13,,,\n,7\n",
           ".inp": "*ELSET, ELSET=all, GENERATE\n101,140,1\n*Elset, elset=outer\nALL, skin\n*ORIENTATION, "
           "NAME=O, SYSTEM=CYLINDRICAL\n0,0,0,0,0,1\n3,5.\n*SHELL SECTION, ELSET=outer, ORIENTATION=O\n1.\n",
           ".k": "*DEFINE_COORDINATE_SYSTEM\n4,0,0,0,0.866,0.5,0\n-1,1,0\n*DEFINE_COORDINATE_NODES_TITLE\nname\n"
           "5,11,12,13\n*ELEMENT_SHELL_MCID_OFFSET\n9001,1,11,12,13,14\n1,1,1,1,4\n0.5\n*ELEMENT_SHELL_BETA\n"
           "9002,1,11,12,13,13\n1,1,1,1,30.\n*ELEMENT_SHELL_COMPOSITE\n9003,1,11,12,13,14\n1,.5,30.,,1,.5,60\n"}
WORDS = ("", "0", "-1", "1e300", "nan", "inf", "9" * 20, "1.5-3", "*", "+", "$", "**", "\x00", "'", '"', "3", "1",
         "7", "*INCLUDE", "GENERATE", "0.0", "1E", "1D5", ",", ",,", "*END", "ENDDATA", "(19i0)", "%", " +")


def mutant(random, lines):
    """A line left out, doubled, cut off or replaced, or one of its words replaced, a few times over."""
    lines = list(lines)
    for _ in range(int(random.integers(1, 5))):
        at, kind = int(random.integers(len(lines))), int(random.integers(6))
        word = WORDS[int(random.integers(len(WORDS)))]
        if kind == 0 and len(lines) > 1:
            del lines[at]
        elif kind == 1:
            lines.insert(at, lines[int(random.integers(len(lines)))])
        elif kind == 2:
            lines[at] = word
        elif kind == 3:
            lines[at] = lines[at][:int(random.integers(len(lines[at]) + 1))]
        else:
            words = re.split(r"([,\s]+)", lines[at])
            words[int(random.integers(len(words)))] = word
            lines[at] = "".join(words)
    return "\n".join(lines)


def check_mutants(folder):
    """Decks with words and lines changed: each is read, with axes that are directions, or refused in one
    line; nothing is reckoned with that is no number."""
    random, mesh = np.random.default_rng(11), disc(80.0, False)
    for ending, text in TEXTS.items():
        whole = text(mesh).splitlines()
        end = [] if ending != ".bdf" else [whole.pop()]
        whole += SYSTEMS.get(ending, "").splitlines() + end
        whole = [line for line in whole if line != "*END"]
        assert (read(folder, "a" + ending, "\n".join(whole)).axes is not None) == (ending in SYSTEMS)
        kept = whole[:3] + whole[-40:] if ending != ".cdb" else whole
        taken = 0
        for number in range(300):
            path = folder / ("mutant" + ending)
            path.write_text(mutant(random, whole if number % 2 else kept), encoding="utf-8")
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("error")
                    found = read_part(path)
                    patches(found)
                assert found.axes is None or np.isfinite(found.axes).all()
                taken += 1
            except Trouble as problem:
                assert str(folder) in str(problem) and "\n" not in str(problem), problem
        assert 10 < taken < 290, (ending, taken)


def check_placed():
    mesh = shell_mesh([(1.0, 0, 0), (0, 1.0, 0), (0, 0, 1.0), (1.0, 1, 1)], grid(1)[1])
    x = placed(mesh, 2.0, [90.0, 0.0, 90.0], [0.0, 0.0, 5.0]).nodes
    # about x: y to z, z to -y; then about z: x to y, y to -x
    assert np.allclose(x, [(0, 2, 5), (0, 0, 7), (2, 0, 5), (2, 2, 7)])


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        check_readers(Path(name))
        check_more_grammar(Path(name))
        check_wrong(Path(name))
        check_damaged(Path(name))
        check_mutants(Path(name))
        check_placed()
