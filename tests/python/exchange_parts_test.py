# SPDX-License-Identifier: GPL-3.0-or-later
"""Part meshes as people have them: of any topology, of first and second order, with cards of every
option, and with material axes of their own.

    exchange_parts_test.py TOOLS

Each is mapped onto, or refused in one line. Leaves with 77 when numpy, scipy, h5py or meshio is missing.
"""

import sys
import tempfile
from pathlib import Path

try:
    import meshio
    import numpy as np

    from exchange_meshes import TEXTS, disc, dome_ply, grid, shell_mesh
    from exchange.angles import angles_to, reference_of
    from exchange.layup import Layup, map_all
    from exchange.midside import second_order
    from exchange.part_files import placed, read_part
    from exchange.shell_mesh import element_normals, patches
    from plotting.reading import Trouble
except ImportError as error:
    print("SKIPPED:", error)
    sys.exit(77)


def read(folder, name, text):
    (folder / name).write_text(text, encoding="utf-8")
    return read_part(folder / name)


def refused(folder, name, text, words):
    try:
        read(folder, name, text)
    except Trouble as problem:
        assert words in str(problem) and "\n" not in str(problem), (words, str(problem))
    else:
        raise AssertionError(f"{name} was read: {words}")


def topologies():
    """Meshes of elements that share edges with none, one, and more than one other."""
    flat, quads = grid(3)
    flat = np.column_stack([20.0 * flat, 0.01 * flat[:, 0]])
    yield "one shell", shell_mesh(flat, quads[:1])
    yield "islands", shell_mesh(flat, quads[[0, 4, 8]])
    yield "an island and a patch", shell_mesh(flat, quads[[0, 1, 3, 8]])
    yield "unmerged nodes", shell_mesh(flat[quads].reshape(-1, 3), np.arange(4 * len(quads)).reshape(-1, 4))
    yield "the same element twice", shell_mesh(flat, quads[[0, 0, 1, 2]])
    rib = np.vstack([flat, flat[4:8] - (0, 0, 3.0)])
    foot = np.array([[4 + k, 5 + k, 17 + k, 16 + k] for k in range(3)])
    yield "a rib", shell_mesh(rib, np.vstack([quads, foot]))
    yield "turned at random", turned_at_random(flat, quads)
    half = np.vstack([flat, 0.5 * (flat[0] + flat[1]), 0.5 * (flat[4] + flat[5])])
    yield "a hanging node", shell_mesh(half, np.vstack([quads[3:], [[0, 16, 17, 4], [16, 1, 5, 17]]]))
    yield "a Moebius strip", moebius()


def turned_at_random(nodes, quads):
    turned = quads.copy()
    turned[::2] = turned[::2][:, ::-1]
    return shell_mesh(nodes, turned)


def moebius():
    count, half = 24, 3.0
    angle = 2 * np.pi * np.arange(count) / count
    out = np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    across = np.cos(angle / 2)[:, None] * out + np.sin(angle / 2)[:, None] * (0.0, 0.0, 1.0)
    x = np.vstack([20.0 * out - half * across, 20.0 * out + half * across])
    after = (np.arange(count) + 1) % count
    quads = np.column_stack([np.arange(count), after, after + count, np.arange(count) + count])
    quads[-1] = [count - 1, count, 0, 2 * count - 1]
    return shell_mesh(x, quads)


def check_topologies(folder):
    """In every format: patches as they hang together, and mapped."""
    ply = dome_ply(30.0)
    for name, mesh in topologies():
        for ending, text in TEXTS.items():
            part = read(folder, "part" + ending, text(mesh))
            patch, turned = patches(part)
            assert len(patch) == len(turned) == len(mesh.labels), (name, ending)
            (mapped,), _ = map_all([ply], part, 8.0, 0.5, False)
            if "Moebius" not in name and "rib" not in name:
                assert mapped.covered().all(), (name, ending)
        meshio.vtu.write(folder / "part.vtu", meshio.Mesh(mesh.nodes, [("quad", mesh.corners)]))
        assert (patches(read_part(folder / "part.vtu"))[0] == patch).all()
        kinds = {"one shell": 1, "islands": 3, "an island and a patch": 2, "unmerged nodes": 1,
                 "turned at random": 1, "a Moebius strip": 24}
        if name in kinds:
            assert len(np.unique(patch)) == kinds[name], (name, patch)
        if name == "turned at random":
            assert (turned == (np.arange(9) % 2 == 1)).all()


NODES = "*NODE\n1,0,0,0\n2,10,0,0\n3,10,10,0\n4,0,10,0\n5,5,0,0\n6,10,5,0\n7,5,10,0\n8,0,5,0\n9,5,5,0\n"


def check_corners(folder):
    """Corners in one node, in the wrong order, on a line."""
    for four in ("1,1,3,4", "1,3,3,4", "1,3,4,4", "1,3,4,1"):
        mesh = read(folder, "a.inp", NODES + f"*ELEMENT,TYPE=S4R\n1,{four}\n")
        assert mesh.triangular().all() and element_normals(mesh)[1][0] == 50.0, four
    mesh = read(folder, "a.inp", NODES + "*ELEMENT,TYPE=S8R\n1,1,2,3,3,5,6,3,9\n")
    assert (mesh.node_labels[mesh.middles[0, :3]] == [5, 6, 9]).all() and mesh.triangular().all()
    mesh = read(folder, "a.inp", NODES + "*ELEMENT,TYPE=S4R\n1,1,2,3,9\n")  # one corner pushed to the middle
    assert not mesh.triangular().any()
    for four, words in (("1,3,2,4", "element 1 has sides that cross"), ("1,5,2,5", "has the corners"),
                        ("1,1,1,4", "has the corners"), ("1,5,2,1", "has no area"),
                        ("1,2,3,77", "has node 77, which is not")):
        refused(folder, "a.inp", NODES + f"*ELEMENT,TYPE=S4R\n1,{four}\n", words)


KINDS = {"S3": 3, "s3r": 3, "S4": 4, "S4R5": 4, "S6": 6, "STRI65": 6, "S8": 8, "S8R": 8, "S9R5": 9,
         "CPS3": 3, "CPS4": 4, "CPS4R": 4, "CPS6": 6, "CPS8R": 8, "M3D3": 3, "M3D4R": 4, "M3D6": 6,
         "M3D8": 8, "M3D9R": 9, "R3D3": 3, "DS6": 6, "CPE4": 4}
THREE, FOUR = ["1", "2", "3", "5", "6", "9"], ["1", "2", "3", "4", "5", "6", "7", "8", "9"]


def check_kinds(folder):
    """Of the first and second order, by their corners, with the nodes of the sides kept."""
    for kind, count in KINDS.items():
        ends = (THREE if count in (3, 6) else FOUR)[:count]
        for line in (",".join(ends), ",".join(ends[:3]) + ",\n" + ",".join(ends[3:])):
            mesh = read(folder, "a.inp", NODES + f"*Element, Type={kind}, Elset=E\n1," + line.strip(",\n"))
            corners = 3 if count in (3, 6) else 4
            assert mesh.triangular()[0] == (corners == 3), kind
            full = second_order(mesh)
            assert full.made == (0 if count > 4 else corners), kind
            if count > 4:
                wanted = ends[corners:2 * corners]
                assert [str(n) for n in full.node_labels[full.middles[0, :corners]]] == wanted, kind
    mesh = read(folder, "a.inp", NODES + "*ELEMENT,TYPE=S8R\n1,1,2,3,4,5,6,7,8\n*NODE\n10,20,0,0\n11,20,10,0\n"
                "*ELEMENT,TYPE=S4\n2,2,10,11,3\n*ELEMENT,TYPE=T3D2\n3,1,2\n")
    full = second_order(mesh)
    assert full.made == 3 and full.node_labels[full.middles[1, 3]] == 6  # the neighbour's own
    assert np.allclose(full.nodes[full.middles[1, 0]], (15, 0, 0)) and full.node_labels.max() == 14
    grids = "".join(f"GRID,{n},,{x}.,{y}.,0.\n" for n, (x, y) in enumerate(
        ((0, 0), (10, 0), (10, 10), (0, 10), (5, 0), (10, 5), (5, 10), (0, 5), (5, 5)), 1))
    mesh = read(folder, "a.bdf", grids + "CQUAD8,1,1,1,2,3,4,5,6\n,7,8\nCTRIA6,2,1,1,2,3,5,6,9\n"
                "CQUAD,3,1,1,2,3,4,5,6\n+,7,8,9\n")
    assert second_order(mesh).made == 0 and (mesh.triangular() == [False, True, False]).all()
    card = "".join(f"{n:8d}" for n in (1, 1, 1, 2, 3, 4, 5, 6, 7, 8))
    nodes = "".join(f"{n:8d}{x:16.1f}{y:16.1f}{0:16.1f}\n" for n, (x, y) in enumerate(
        ((0, 0), (10, 0), (10, 10), (0, 10), (5, 0), (10, 5), (5, 10), (0, 5)), 1))
    assert second_order(read(folder, "a.k", f"*NODE\n{nodes}*ELEMENT_SHELL\n{card}\n")).made == 0
    points = np.array([(0, 0, 0), (10, 0, 0), (10, 10, 0), (0, 10, 0), (5, 0, 0), (10, 5, 0), (5, 10, 0),
                       (0, 5, 0), (5, 5, 0)], float)
    for kind, ends in (("triangle6", [0, 1, 2, 4, 5, 8]), ("quad8", range(8)), ("quad9", range(9))):
        meshio.vtu.write(folder / "a.vtu", meshio.Mesh(points, [(kind, [list(ends)])]))
        assert second_order(read_part(folder / "a.vtu")).made == 0


def shell_cards(options, form, ends):
    """An element with the cards of its options: plain columns, commas, ten digits, long."""
    width = {"plain": 8, "commas": 0, "i10": 10, "long": 20}[form]

    def card(values, wide):
        wide = 20 if form == "long" else (wide if wide == 16 else width)
        return (",".join(map(str, values)) if form == "commas"
                else "".join(f"{value:>{wide}}" for value in values))
    lines = [card(ends, 8)]
    if {"THICKNESS", "BETA", "MCID"} & set(options):
        lines.append(card(["1.2"] * 4 + (["30.0"] if "BETA" in options else ["0"]), 16))
        if any(ends[6:]):
            lines.append(card(["1.2"] * 4, 16))
    lines += [card(["0.25"], 16)] * ("OFFSET" in options) + [card([0] * 8, 8)] * ("DOF" in options)
    return lines


def check_cards(folder):
    """Every option and pairs of them, with and without the nodes N5 to N8, zeros written or not."""
    options = [(), ("THICKNESS",), ("BETA",), ("MCID",), ("OFFSET",), ("DOF",), ("THICKNESS", "OFFSET"),
               ("BETA", "OFFSET"), ("MCID", "OFFSET"), ("THICKNESS", "BETA"), ("THICKNESS", "MCID", "DOF"),
               ("BETA", "OFFSET", "DOF")]
    places = ((0, 0), (10, 0), (10, 10), (0, 10), (5, 0), (10, 5), (5, 10), (0, 5), (20, 0), (20, 10))
    for form in ("plain", "commas", "i10", "long"):
        wide = {"plain": (8, 16), "i10": (10, 16), "long": (20, 20), "commas": (0, 0)}[form]
        nodes = [",".join(map(str, (n, x, y, 0))) if form == "commas" else
                 f"{n:{wide[0]}d}" + "".join(f"{v:{wide[1]}.4f}" for v in (x, y, 0))
                 for n, (x, y) in enumerate(places, 1)]
        head = "*KEYWORD" + {"long": " LONG=Y", "i10": " I10=Y"}.get(form, "")
        for some in options:
            for rest in ([], [0] * 4, [5, 6, 7, 8]):
                lines = [head, "*NODE", *nodes, "*ELEMENT_SHELL" + "".join("_" + one for one in some)]
                for label, four in ((1, [1, 2, 3, 4]), (2, [2, 9, 10, 3]), (3, [1, 2, 4, 4])):
                    more = rest if label == 1 or not any(rest) else [0] * len(rest)
                    lines += shell_cards(some, form, [label, 1, *four, *more])
                mesh = read(folder, "a.k", "\n".join([*lines, "*END"]) + "\n")
                assert (mesh.labels == [1, 2, 3]).all(), (form, some, rest)
                assert (mesh.triangular() == [False, False, True]).all()
                assert (mesh.middles is not None) == any(rest)
                assert (mesh.axes is not None) == ("BETA" in some or "MCID" in some), (form, some)
    for mark, width in (("+", 20), ("%", 10)):
        text = (f"*NODE{mark}\n" + "".join(
            f"{n:{width}d}" + "".join(f"{v:{20 if width == 20 else 16}.4f}" for v in (x, y, 0)) + "\n"
            for n, (x, y) in enumerate(places, 1)) + f"*ELEMENT_SHELL {mark}\n"
            + "".join(f"{n:{width}d}" for n in (1, 1, 1, 2, 3, 4)) + "\n")
        (folder / "sub.k").write_text(text, encoding="utf-8")
        mesh = read(folder, "a.k", "*KEYWORD\n*INCLUDE\nsub.k\n*END\n")
        assert (mesh.labels == [1]).all() and np.allclose(element_normals(mesh)[1], 100.0)
    refused(folder, "a.k", "*KEYWORD\n*NODE\n" + "\n".join(f"{n},{x},{y},0" for n, (x, y) in
            enumerate(places, 1)) + "\n*ELEMENT_SHELL_BETA\n1,1,1,2,3,4\n", "are cut off")


def angle_of(mesh):
    """Of the axes of its first element to its side from corner 1 to corner 2, degrees."""
    normals = element_normals(mesh)[0]
    base, axes = (reference_of(mesh, which, normals).directions for which in ("side", "part"))
    return angles_to(base, axes, normals)[0]


def check_axes(folder):
    """A square of 10 mm with corners at (0, 0), (10, 0), ...: sides along x; of (90, 90): a radius at 45
    degrees."""
    square = ["GRID,1,,40.,40.,0.", "GRID,2,,50.,40.,0.", "GRID,3,,50.,50.,0.", "GRID,4,,40.,50.,0.",
              "GRID,11,,0.,0.,0.", "GRID,12,,0.,0.,1.", "GRID,13,,0.,1.,0."]
    systems = ["CORD2R,5,,0.,0.,0.,0.,0.,1.", ",0.8660254,0.5,0.", "CORD2C,7,,0.,0.,0.,0.,0.,1.",
               ",1.,0.,0.", "CORD1R,8,11,12,13", "CORD2R,9,5,0.,0.,0.,0.,0.,1.", ",0.8660254,0.5,0.",
               "CORD2S,10,,0.,0.,0.,0.,0.,1.", ",1.,0.,0.", "CORD2R,3,9,1.,2.,3.,1.,2.,4.", ",2.,2.,3."]
    for word, wanted in (("25.", 25.0), ("-100.5", -100.5), ("0", 0.0), ("5", 30.0), ("7", 45.0),
                         ("8", 90.0), ("9", 60.0), ("10", 45.0), ("3", 60.0)):
        for card in (f"CQUAD4,1,1,1,2,3,4,{word}", f"CQUAD4  {1:8d}{1:8d}{1:8d}{2:8d}{3:8d}{4:8d}{word:>8}",
                     f"CTRIA3,1,1,1,2,3,{word}", f"CQUADR,1,1,1,2,3,4,{word}",
                     f"CQUAD8,1,1,1,2,3,4\n,,,,,,,{word}", f"CTRIA6,1,1,1,2,3,,,\n,{word}",
                     f"CQUAD4* {1:16d}{1:16d}{1:16d}{2:16d}\n*       {3:16d}{4:16d}{word:>16}"):
            mesh = read(folder, "a.bdf", "\n".join([*square, *systems, card]) + "\n")
            # the middle of the triangle is not on the square's diagonal
            here = wanted if word not in ("7", "10") or "QUAD" in card else 42.878904
            assert abs(angle_of(mesh) - here) < 1e-4, (card, angle_of(mesh), here)
            assert ("THETA" if "." in word else f"MCID {word}") in mesh.axes_words
    mesh = read(folder, "a.bdf", "\n".join([*square, "CQUAD4,1,1,1,2,3,4,77"]))
    assert mesh.axes is None and "MCID 77" in mesh.notes[0]
    mesh = read(folder, "a.bdf", "\n".join([*square, "CQUAD4,1,1,1,2,3,4,30.", "CTRIA3,2,1,1,2,3"]))
    assert "THETA of 1 elements, side from corner 1 to corner 2 of the other 1" == mesh.axes_words
    turned = placed(mesh, 2.0, [0.0, 90.0, 0.0], [5.0, 0, 0])
    assert abs(angle_of(turned) - 30.0) < 1e-9  # axes turn with the mesh

    body = ("*NODE\n1,40,40,0\n2,50,40,0\n3,50,50,0\n4,40,50,0\n*ELEMENT,TYPE=S4R,ELSET=Skin\n1,1,2,3,4\n"
            "*ELSET,ELSET=all,GENERATE\n1,1\n*Elset, elset=outer\nALL,\n")
    for lines, options, wanted in (
            ("0.5,0.8660254,0, -1,0,0\n3, 0.", "", 60.0), ("0.5,0.8660254,0, -1,0,0\n3, 10.", "", 70.0),
            ("0,0,1, 1,0,0\n", "", 0.0), ("0,0,0, 0,0,1\n3, 0.", ", SYSTEM=CYLINDRICAL", 45.0),
            ("0,0,0, 0,0,1\n1, 0.", ", SYSTEM=cylindrical", None),
            ("0,0,1, 0,1,0\n3, 0.", ", SYSTEM=Z RECTANGULAR", 90.0)):
        for group in ("SKIN", "all", "Outer"):
            mesh = read(folder, "a.inp", body + f"*Orientation, name=Ori{options}\n{lines}\n"
                        f"*Shell Section, elset={group}, composite, orientation=ORI\n0.5,3,M,0.\n")
            assert wanted is None or abs(angle_of(mesh) - wanted) < 1e-4, (lines, angle_of(mesh))
            assert "*ORIENTATION ORI of 1 elements" in mesh.axes_words + str(mesh.notes)
    mesh = read(folder, "a.inp", body + "*ORIENTATION, NAME=O\nDIST\n3,0.\n"
                "*SHELL SECTION, ELSET=SKIN, ORIENTATION=O\n1.\n")
    assert mesh.axes is None and "distribution" in mesh.notes[0]
    check_k_axes(folder)


def check_k_axes(folder):
    nodes = "*NODE\n1,40,40,0\n2,50,40,0\n3,50,50,0\n4,40,50,0\n5,0,0,0\n6,0,1,0\n7,-1,0,0\n"
    element = "1,1,1,2,3,4\n1,1,1,1,{}\n"
    systems = ("*DEFINE_COORDINATE_SYSTEM\n4,0,0,0,0.8660254,0.5,0\n-1,1,0\n*DEFINE_COORDINATE_NODES_TITLE\n"
               "name\n5,5,6,7\n*DEFINE_COORDINATE_VECTOR\n6,0.5,0.8660254,0,-1,0,0\n")
    for option, value, wanted in (("BETA", 25.5, 25.5), ("MCID", 4, 30.0), ("MCID", 5, 90.0),
                                  ("MCID", 6, 60.0), ("THICKNESS_MCID", 0, 0.0)):
        mesh = read(folder, "a.k", nodes + systems + f"*ELEMENT_SHELL_{option}\n" + element.format(value))
        assert abs(angle_of(mesh) - wanted) < 1e-4, (option, value, angle_of(mesh))
    mesh = read(folder, "a.k", nodes + "*MAT_ENHANCED_COMPOSITE_DAMAGE_TITLE\nname\n"
                "*ELEMENT_SHELL_MCID\n" + element.format(9))
    assert mesh.axes is None and "MCID 9" in str(mesh.notes) and "AOPT" in str(mesh.notes)


def check_offsets(folder):
    """Offsets are told, whatever the format calls them; what is none is not."""
    inp = "*NODE\n1,0,0,0\n2,9,0,0\n3,9,9,0\n*ELEMENT,TYPE=S3,ELSET=E\n1,1,2,3\n*SHELL SECTION,ELSET=E"
    bdf = "GRID,1,,0.,0.,0.\nGRID,2,,9.,0.,0.\nGRID,3,,9.,9.,0.\n"
    short = f"CTRIA3  {1:8d}{1:8d}{1:8d}{2:8d}{3:8d}{'':8}"
    k = "*KEYWORD\n*NODE\n1,0,0,0\n2,9,0,0\n3,9,9,0\n*ELEMENT_SHELL"
    shell, section = "\n1,1,1,2,3,3\n", "*SECTION_SHELL_TITLE\nskin\n1,2\n1.,1.,1.,1."
    cdb = ("ET,1,181\nNBLOCK,6,SOLID,3,3\n(3i9,6e21.13e3)\n" + "".join(
        f"{n:9d}{0:9d}{0:9d}{x:21.13E}{y:21.13E}\n" for n, x, y in ((1, 0, 0), (2, 9, 0), (3, 9, 9)))
        + "N,R5.3,LOC,      -1,\nEBLOCK,19,SOLID,1,1\n(19i9)\n"
        + "".join(f"{n:9d}" for n in (1, 1, 1, 1, 0, 0, 0, 0, 4, 0, 1, 1, 2, 3, 3)) + "\n       -1\n")
    for name, text, told in (
            ("a.inp", f"{inp}, OFFSET=0.5\n1.\n", "OFFSET of *SHELL SECTION"),
            ("a.inp", f"{inp}, offset=SPOS\n1.\n", "OFFSET of *SHELL SECTION"),
            ("a.inp", f"{inp}, OFFSET=0.0\n1.\n", ""), ("a.inp", f"{inp}\n1.\n", ""),
            ("a.bdf", f"{bdf}CTRIA3,1,1,1,2,3,,0.5\n", "ZOFFS of CTRIA3"),
            ("a.bdf", f"{bdf}{short}{0.5:8.3f}\n", "ZOFFS of CTRIA3"),
            ("a.bdf", f"{bdf}{short}{0.0:8.3f}\n", ""), ("a.bdf", f"{bdf}{short}\n", ""),
            ("a.bdf", f"{bdf}{short}\nPCOMP,1,-1.0\n", "Z0 of PCOMP"), ("a.bdf", f"{bdf}{short}\nPCOMP,1\n", ""),
            ("a.bdf", f"{bdf}{short}\nPSHELL,1,1,1.0,,,,,,\n,,,,,0.5\n", "ZOFFS of PSHELL"),
            ("a.k", f"{k}_OFFSET{shell}0.25\n*END\n", "OFFSET of *ELEMENT_SHELL"),
            ("a.k", f"{k}_OFFSET{shell}0.0\n*END\n", ""),
            ("a.k", f"{k}{shell}{section},-1.0\n*END\n", "NLOC of *SECTION_SHELL"),
            ("a.k", f"{k}{shell}{section}\n*END\n", ""),
            ("a.cdb", f"{cdb}SECOFFSET,TOP\n", "SECOFFSET"), ("a.cdb", f"{cdb}SECO,USER,0.3\n", "SECOFFSET"),
            ("a.cdb", f"{cdb}SECOFFSET,MID\n", ""), ("a.cdb", cdb, "")):
        mesh = read(folder, name, text)
        found = [words for words in mesh.notes if "offsets" in words]
        assert len(found) == bool(told) and told in "".join(found), (text, mesh.notes)
        (mapped,), _ = map_all([dome_ply(0.0)], disc(6.0, False, reach=40.0), 5.0, 0.5, False)
        assert ("not taken over" in "\n".join(Layup(mesh, [mapped], "side", "", False,
                                                    tuple(mesh.notes)).head())) == bool(told)


def check_along_normal():
    """Where the reference is along the normal another axis is taken: told with number and place, and how
    far it turns from an element to the next."""
    ply = dome_ply(0.0)
    mesh = disc(6.0, False, reach=40.0)
    mesh.labels = np.arange(1, len(mesh.labels) + 1)
    (mapped,), _ = map_all([ply], mesh, 5.0, 0.5, False)
    for reference, count in (("x", 0), ("z", 1), ((0.0, 0.0, -3.0), 1)):
        layup = Layup(mesh, [mapped], reference, "", False)
        middle = int(np.abs(np.degrees(np.arccos(np.clip(element_normals(mesh)[0][:, 2], -1, 1)))).argmin())
        assert len(layup.base.replaced) == count
        words = "\n".join(layup.head())
        assert ("global x is projected there in its place" in words) == bool(count), words
        if count:
            assert f"1 element ({mesh.labels[middle]}; at (" in words and "see below" in words
            assert "turns fast" in words and "degrees from an element to the next" in words
    assert "corner 2" in "\n".join(Layup(mesh, [mapped], "side", "", False).head())


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as where:
        check_topologies(Path(where))
        check_corners(Path(where))
        check_kinds(Path(where))
        check_cards(Path(where))
        check_axes(Path(where))
        check_offsets(Path(where))
    check_along_normal()
