# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of reports without a browser: what is written comes back, tools keep their shape when they
are simplified.

    report_encoding_test.py TOOLS
"""

import base64
import sys
import zlib

try:
    import h5py  # noqa: F401, the readers need it
    import numpy as np
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)

sys.path.insert(0, sys.argv[1])
from reporting.encode import Blocks  # noqa: E402
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


check_encoding()
check_simplified()
