# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of reports without a browser: what is written comes back, tools keep their shape when they
are simplified; any families of yarns are shown.

    report_encoding_test.py TOOLS
"""

import base64
import json
import re
import sys
import tempfile
import zlib
from dataclasses import replace
from pathlib import Path

try:
    import h5py
    import jinja2  # noqa: F401, the page needs it
    import numpy as np
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)

sys.path.insert(0, sys.argv[1])
import made_run  # noqa: E402
from base.ending import Trouble  # noqa: E402
from exchange.formed import FormedPly, layers_of, read_formed  # noqa: E402
from exchange.layup import as_two, own_layup  # noqa: E402
from exchange.mirror import mirrored  # noqa: E402
from exchange.states import read_states  # noqa: E402
from plotting.reading import read_state  # noqa: E402
from reporting.encode import Blocks  # noqa: E402
from reporting.page import page_of  # noqa: E402
from reporting.reading_run import read_run  # noqa: E402
from reporting import simplify  # noqa: E402
from reporting.simplify import simplified  # noqa: E402


def decoded(blocks, told):
    size = told["bits"] // 8
    planes = np.frombuffer(zlib.decompress(base64.b64decode(blocks.texts[told["block"]])), np.uint8)
    numbers = np.ascontiguousarray(planes.reshape(size, -1).T).view(f"<u{size}").reshape(told["shape"])
    if told["differences"] == "place":
        numbers = np.cumsum(numbers, axis=1, dtype=numbers.dtype)
    return told["low"] + told["step"] * np.cumsum(numbers, axis=0, dtype=numbers.dtype)


def check_encoding():
    rng = np.random.default_rng(7)
    for shape, size in (((4, 50, 3), 300.0), ((1, 7, 3), 1e-3), ((21, 40), 90.0)):
        blocks, values = Blocks(), rng.normal(0.0, size / 6.0, shape)
        told = blocks.add(values, "place", 0.002, 0.009)
        assert told["bits"] == 16 and blocks.errors["place"] <= max(size / 6e4, 0.001)
        assert abs(decoded(blocks, told) - values).max() <= blocks.errors["place"] + 1e-12
    blocks, values = Blocks(), rng.uniform(-3000.0, 3000.0, (3, 40, 3))  # too wide for 16 bits
    told = blocks.add(values, "place", 0.002, 0.009)
    assert told["bits"] == 32 and abs(decoded(blocks, told) - values).max() <= 0.0091
    constant = blocks.add(np.full((2, 5), 0.6), "thickness", 1e-5, 1e-3)
    assert abs(decoded(blocks, constant) - 0.6).max() < 1e-12
    nothing = blocks.add(np.zeros((2, 5)), "tension", 0.0, np.inf)
    assert (decoded(blocks, nothing) == 0.0).all()
    numbers = rng.integers(0, 70000, (30, 3))
    assert (decoded(blocks, blocks.add_integers(numbers))[0] == numbers).all()


def tube(radius, height, around, up):
    angle, z = np.meshgrid(2.0 * np.pi * np.arange(around) / around, np.linspace(0.0, height, up))
    x = np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=-1).reshape(-1, 3)
    k = np.arange(around)
    rows = [np.stack([r * around + k, r * around + (k + 1) % around, (r + 1) * around + k], axis=1)
            for r in range(up - 1)]
    rows += [np.stack([r * around + (k + 1) % around, (r + 1) * around + (k + 1) % around,
                       (r + 1) * around + k], axis=1) for r in range(up - 1)]
    return x, np.concatenate(rows)


def check_simplified():
    x, triangles = tube(80.0, 100.0, 200, 60)
    simplify.ENOUGH = 100
    fewer, facets = simplified(x, triangles, 0.3)
    assert len(facets) < 0.35 * len(triangles)
    middles = fewer[facets].mean(axis=1)
    assert abs(np.hypot(*fewer[:, :2].T) - 80.0).max() < 0.3
    assert np.hypot(*middles[:, :2].T).min() > 79.0  # facets are chords: 80 (1 - cos)
    assert abs(fewer[:, 2].min()) < 0.3 and abs(fewer[:, 2].max() - 100.0) < 0.3  # the rims stay


def check_families():
    """Plies of no family, of one, of two and of three: all of their columns are in a report, in
    plots and in exports; what has fibres is mapped, and what has none says so."""
    families = {"foil": (), "tape": ("tape",), "braid": ("a", "b", "c")}
    with tempfile.TemporaryDirectory() as name:
        run = made_run.write(Path(name) / "run", plies=(*families, "weave"), families=families)
        data = json.loads(re.search(r'id="scene">(.*?)</script>', page_of([read_run(run)]), re.S)[1])
        words = [column["word"] for column in data["columns"]]
        for family in ("tape", "a", "b", "c", "warp", "weft"):
            assert f"{family}-strain" in words and f"{family}-tension" in words, words
        plies = {ply["name"]: ply for ply in data["runs"][0]["plies"]}
        assert [one["name"] for one in plies["braid"]["families"]] == ["a", "b", "c"]
        assert "c_strain" in plies["braid"]["cells"] and "c_strain" not in plies["tape"]["cells"]
        assert [line["name"] for line in charts(data, "rms-shear")] == [*families, "weave"]
        assert [line["name"] for line in charts(data, "energies")] == ["kinetic mJ", "fibre mJ"]
        assert read_state(run, "shear").field.name == "shear_angle_deg"
        expect(lambda: read_state(run, "c-strain"), "ply foil has no field c-strain: it has ")
        body = next(body for body in read_states(run, "-1")[0].bodies if body.name == "braid")
        assert {"a", "b", "c", "a_strain", "c_tension_N"} <= set(body.cells)
        tape = read_formed(run, only=["tape"]).plies[0]
        assert abs((tape.warp * tape.weft).sum(axis=1)).max() < 1e-9  # across the fibres
        expect(lambda: read_formed(run), "ply foil has no fibres")
        check_layers(read_formed(run, only=["tape", "braid", "weave"]).plies)


def check_layers(plies):
    """A tape is one layer of the next program, a braid of three families three of a third of its
    thickness, each along its own fibres; a weave is one."""
    tape, braid, weave = (layers_of(ply) for ply in plies)
    assert [layer.name for layer in tape] == ["tape"] and weave == [plies[2]]
    assert [layer.name for layer in braid] == ["braid_a", "braid_b", "braid_c"]
    assert [layer.angle_deg for layer in braid] == [0.0, 60.0, 120.0]
    for layer, yarns in zip(braid, plies[1].yarns):
        assert (layer.warp == yarns).all() and abs((layer.warp * layer.weft).sum(axis=1)).max() < 1e-9
        assert np.allclose(3.0 * layer.thickness, plies[1].thickness)
        assert abs(layer.nominal_thickness - 0.2) < 1e-12 and not layer.shear_deg.any()
    mapped = own_layup(braid[1], "x", "made up")
    assert [ply.name for ply in as_two(mapped).plies] == ["braid_b"]
    assert [ply.name for ply in as_two(own_layup(plies[2], "x", "made up")).plies] == \
        ["weave_warp", "weave_weft"]


def check_images():
    """The image of a braid of 0, 60 and 120 degrees has its families: the second is the third's. That
    of a tape at 30 degrees is no tape of the ply."""
    x = np.array([(0.0, 0, 0), (10, 0, 0), (10, 10, 0), (0, 10, 0)])
    triangles = np.array([(0, 1, 2), (0, 2, 3)])

    def at(degrees):
        return np.tile([np.cos(np.radians(degrees)), np.sin(np.radians(degrees)), 0.0], (2, 1))
    braid = FormedPly("braid", 0.0, x, x, triangles, at(1), at(61), np.full(2, -0.0), np.full(2, 0.6),
                      0.6, 60.0, ("a", "b", "c"), (0.0, 60.0, 120.0), (at(121),))
    whole = mirrored(braid, "x")
    assert np.allclose(whole.warp[2:], at(-1)) and np.allclose(whole.weft[2:], at(59))
    assert np.allclose(whole.further[0][2:], at(119)) and len(whole.triangles) == 4
    tape = replace(braid, families=("a",), family_angles_deg=(30.0,), further=(),
                   weft=at(91), shear_deg=np.full(2, 5.0))
    expect(lambda: mirrored(tape, "x"), "are not those of its image")
    straight = mirrored(replace(tape, family_angles_deg=(0.0,)), "x")
    assert np.allclose(straight.weft[2:], np.cross((0, 0, 1.0), straight.warp[2:]))
    assert np.allclose(straight.shear_deg, [5.0, 5.0, -5.0, -5.0])


def charts(data, word):
    return next(one["lines"] for one in data["runs"][0]["charts"] if one["id"] == word)


def expect(act, words):
    try:
        act()
    except Trouble as problem:
        assert words in str(problem), problem
        return
    raise AssertionError(f"nothing says: {words}")


def check_layout():
    """A file of another layout is refused with what to do, by whatever reads it."""
    with tempfile.TemporaryDirectory() as name:
        run = made_run.write(Path(name) / "run")
        with h5py.File(run / "results.h5", "r+") as file:
            file.attrs["format_version"] = 2
        for read in (read_run, read_formed, lambda run: read_state(run, "shear")):
            expect(lambda: read(run), "its layout is version 2, this plyform reads version 3: run the "
                   "case again")


check_encoding()
check_simplified()
check_families()
check_images()
check_layout()
