# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases before they run: `Case.scene`, of cases with every mistake too; warnings and keys in parts.

    module_scene_test.py PACKAGE_FOLDER PROGRAM SOURCE_FOLDER
"""

import json
import math
import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

sys.path.insert(0, sys.argv[1])
program, source = Path(sys.argv[2]).resolve(), Path(sys.argv[3]).resolve()

import numpy as np  # noqa: E402
import plyform  # noqa: E402

CASES = source / "cases"
KEYS = {key.key: key for key in plyform.keys()}


def pattern_of(item):
    """tool.1.radius -> tool[].radius, fabrics.glass.thickness -> fabrics.NAME.thickness"""
    parts = ("[]" if part.isdigit() else "." + part for part in item.split("."))
    pattern = "".join(parts)[1:]
    return re.sub(r"^(fabrics|blanks|friction)\.[^.\[]+", r"\1.NAME", pattern)


def is_known(item):
    pattern = pattern_of(item)
    while pattern and pattern not in KEYS and pattern.endswith("[]"):  # an item of a list
        pattern = pattern[:-2]
    return pattern in KEYS


def check_hemisphere():
    """Everything of a case without mistakes, and arrays without copies."""
    scene = plyform.Case(CASES / "hemisphere_five_ply", {
        "tool.punch.position": [0.0, 0.0, 98.0], "ply.1.angle": 30.0}).scene(threads=1)
    assert not scene.mistakes and scene.gravity.tolist() == [0.0, 0.0, 0.0]
    assert scene.times_s[0] == 0.0 and scene.times_s[-1] == scene.duration_s > 0.0
    assert len(scene.times_s) == 51 and (np.diff(scene.times_s) > 0.0).all()
    assert scene.plies.names == [f"ply{i}" for i in range(1, 6)]
    assert abs(scene.stack_thickness_mm - 3.0) < 1e-9
    assert [(s["lower"], s["upper"], s["gap_mm"]) for s in scene.spacings] == [
        (i, i + 1, 0.0) for i in range(4)]
    ply = scene.plies[1]
    turn = math.radians(30.0)
    assert np.allclose(ply.families["warp"], [math.cos(turn), math.sin(turn), 0.0])
    assert np.allclose(ply.families["weft"], [-math.sin(turn), math.cos(turn), 0.0])
    assert (ply.fabric, ply.blank) == ("glass", "square") and abs(ply.angle_deg - 30.0) < 1e-9
    assert np.allclose(ply.x[:, 2], 0.9) and ply.triangles.max() == len(ply.x) - 1
    around = ply.x[ply.edges[0]][:, :2]
    assert len(ply.edges) == 1 and (np.abs(around).max(axis=1) > 169.9).all()
    area = 0.5 * np.sum(np.cross(around, np.roll(around, -1, axis=0)))
    assert abs(area - 340.0 ** 2) < 1e-6 * area
    x = ply.x
    place = x.__array_interface__["data"][0]
    assert ply.x.__array_interface__["data"][0] == place and not x.flags.writeable
    punch = scene.tools["punch"]
    assert punch.shape == "sphere" and punch.motion == "driven" and punch.forces_N is None
    assert abs(punch.gap.gap_mm - 20.0) < 1e-9 and punch.gap.ply == 4, punch.gap.gap_mm
    assert abs(punch.x0[:, 2].min() - 23.0) < 0.05  # as the shipped case has it, and 20 mm up
    contact = punch.first_contact
    assert abs(contact.stroke_mm - punch.gap.gap_mm) < 1e-6 and contact.ply == 4
    assert np.allclose(contact.where, [0.0, 0.0, 3.0], atol=1e-2)
    there = np.interp(contact.time_s, scene.times_s, punch.strokes_mm)
    assert abs(there - contact.stroke_mm) < 0.05, (there, contact.stroke_mm)
    assert punch.shifts_mm.shape == (51, 3) and punch.shifts_mm[-1].tolist() == [0.0, 0.0, -75.0]
    near = [s for s in scene.tool_spacings if {s["a"], s["b"]} == {0, 1}]  # punch and die
    assert len(scene.tool_spacings) == len(near) == 1 and near[0]["time_s"] == scene.times_s[-1]
    fillet = math.hypot(90.0, 98.0 - 75.0 + 10.0) - 10.0 - 75.0  # its circle to the punch's
    assert abs(near[0]["gap_mm"] - fillet) < 0.05 and abs(near[0]["stack_mm"] - 3.0) < 1e-9, near
    holder, die = scene.tools["blank_holder"], scene.tools["die"]
    assert holder.motion == "force" and holder.shifts_mm is None and holder.forces_N[-1] == 300.0
    assert die.motion == "fixed" and not die.shifts_mm.any() and die.first_contact is None
    del scene, punch, holder, die, ply
    assert np.allclose(x[0], [-170.0, -170.0, 0.9])  # the array keeps its memory


def check_boundaries():
    springs = plyform.Case(CASES / "springs_and_grippers").scene()
    assert [b.kind for b in springs.boundaries] == ["spring"] * 2 + ["gripper"] * 2
    spring, gripper = springs.boundaries[0], springs.boundaries["gripper_south"]
    held = springs.plies[0].x[spring.nodes[0]]
    assert len(held) == 5 and (held[:, 0] == -150.0).all() and spring.strokes_mm is None
    assert spring.fields["anchor"].tolist() == [-210.0, -30.0, 0.3]
    assert gripper.strokes_mm[-1] == 20.0 and gripper.fields["guided"]
    assert len(gripper.strokes_mm) == len(springs.times_s)
    frame = plyform.Case(CASES / "picture_frame").scene().boundaries[0]
    bars = np.linalg.norm(np.roll(frame.hinges_mm, -1, axis=1) - frame.hinges_mm, axis=2)
    assert frame.kind == "frame" and np.allclose(bars, bars[0]), bars  # they are rigid
    film = plyform.Case(CASES / "inflated_membrane").scene()
    assert film.loads == [{"entry": 0, "ply": 0, "side": "below", "pressure_N_mm2": 0.0121}], film.loads
    planes = [b for b in film.boundaries if b.kind == "symmetry"]
    assert [p.fields["normal"].tolist() for p in planes] == [[1.0, 0.0], [0.0, 1.0]]


def check_broken():
    """Each mistake is of a key or stands in none, and what it spares can be drawn."""
    files = sorted((source / "tests/data/broken").glob("*.toml"))
    drawn, left_out, of_no_key = 0, 0, 0
    for file in files:
        case = plyform.Case(file)
        scene = case.scene(threads=1)
        check = case.check()
        assert check.mistakes, file
        for mistake in check.mistakes:
            unknown = "unknown key" in mistake.rule
            item = mistake.item.rpartition(".")[0] if unknown else mistake.item
            assert item == "" or is_known(item), (file, mistake)
            of_no_key += mistake.item == ""
        for part in (*scene.plies, *scene.tools):
            whole = part.triangles is not None
            assert whole == (part.trouble is None), (file, part, part.trouble)
            if whole:
                points = part.x if isinstance(part, plyform.ScenePly) else part.x0
                assert np.isfinite(points).all() and part.triangles.max() < len(points), file
            drawn, left_out = drawn + whole, left_out + (not whole)
        for boundary in scene.boundaries:
            assert boundary.nodes or boundary.trouble, (file, boundary)
    assert len(files) > 200 and drawn > 3 * left_out > 100, (len(files), drawn, left_out)
    assert of_no_key < 10, of_no_key  # no TOML
    assert not plyform.Case(source / "none.toml").scene().plies
    scene = plyform.Case(source / "tests/data/broken/blank_hole_outside.toml").scene()
    assert scene.plies[0].x is None and "hole" in scene.plies[0].trouble, scene.plies[0].trouble


def write_tip(file, z):
    """A tetrahedron upside down, as text: its tip at (0, 0, z)."""
    tip, a, b, c = (0, 0, z), (-20, -20, z + 30), (20, -20, z + 30), (0, 20, z + 30)
    faces = ((a, b, c), (a, tip, b), (b, tip, c), (c, tip, a))
    file.write_text("solid tip\n" + "".join(
        "facet normal 0 0 0\nouter loop\n"
        + "".join(f"vertex {x} {y} {z}\n" for x, y, z in face) + "endloop\nendfacet\n"
        for face in faces) + "endsolid\n", encoding="ascii")


def check_changed_mesh(folder):
    """A mesh that is kept in memory is read again when its file has changed."""
    case = plyform.Case(CASES / "hemisphere_0", {
        "tool.punch": {"name": "punch", "shape": "mesh", "file": str(folder / "tip.stl"),
                       "motion": "driven", "direction": [0, 0, -1], "stroke": 30.0}})
    for z in (20, 20, 10):
        write_tip(folder / "tip.stl", z)
        top = max(ply.x[0, 2] + 0.5 * ply.thickness_mm for ply in case.scene().plies)
        punch = case.scene().tools["punch"]
        assert abs(punch.gap.gap_mm - (z - top)) < 1e-6, (z, punch.gap.gap_mm, punch.trouble)
        assert abs(punch.first_contact.stroke_mm - (z - top)) < 1e-6
    (folder / "tip.stl").unlink()
    assert case.scene().tools["punch"].trouble == "has mistakes: file"


def check_warnings(folder):
    (folder / "case.toml").write_text((CASES / "hemisphere_0/case.toml").read_text(
        encoding="utf-8").replace("../fabrics", str(CASES / "fabrics")), encoding="utf-8")
    check = plyform.Case(folder, {"contact.friction": 3.0}).check()
    friction = [w for w in check.warnings_at if w.item == "contact.friction"]
    assert len(friction) == 1 and friction[0].file == "--set", check.warnings
    assert len(check.warnings_at) == len(check.warnings)
    for warned, message in zip(check.warnings_at, check.warnings):
        assert message.endswith(warned.text) and message.startswith(warned.file)


def check_keys():
    """Keys have what a form needs, in Python as in the program's JSON."""
    kinds = {"table", "tables", "map", "text", "name", "path", "choice", "number", "integer",
             "boolean", "numbers", "pairs", "names", "profile", "outlines", "fabric"}
    told = json.loads(subprocess.run([program, "keys", "--json"], check=True, capture_output=True,
                                     text=True).stdout)
    assert [row["key"] for row in told] == list(KEYS)
    columns = ("unit", "least", "most", "open_least", "open_most", "usual_least", "usual_most")
    for row in told:
        key = KEYS[row["key"]]
        for name, value in row.items():
            there = getattr(key, name)
            if name == "columns":
                there = [{part: getattr(c, part) for part in columns} for c in there]
            assert there == value, (key, name, there, value)
        assert key.kind in kinds and (key.kind == "choice") <= bool(key.choices), key
        assert not key.choices or key.kind == "choice" or key.refers, key
        assert all(any(name.startswith((f"{place}[].", f"{place}.NAME")) for name in KEYS)
                   for place in key.refers), (key, key.refers)
        assert not key.of or set(key.of_values) <= set(
            KEYS[key.key.rpartition(".")[0] + "." + key.of].choices), key
        if key.fallback:
            tomllib.loads("value = " + key.fallback)
        numbers = key.kind in ("number", "integer", "numbers", "pairs", "profile", "outlines")
        assert bool(key.columns) == numbers, key
    assert {key.kind for key in KEYS.values()} == kinds
    friction, radius = KEYS["contact.friction"], KEYS["tool[].radius"]
    assert (friction.columns[0].least, friction.columns[0].most) == (0.0, 10.0)
    assert radius.of == "shape" and "sphere" in radius.of_values
    assert radius.required and radius.columns[0].unit == "mm"
    assert (radius.columns[0].least, radius.columns[0].most) == (1e-6, 1e5)
    assert radius.columns[0].usual_most is None


def main():
    check_hemisphere()
    check_boundaries()
    check_broken()
    check_keys()
    for check in (check_changed_mesh, check_warnings):
        with tempfile.TemporaryDirectory() as name:
            check(Path(name).resolve())


main()
