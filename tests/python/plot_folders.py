# SPDX-License-Identifier: GPL-3.0-or-later
"""Made-up result folders for the tests of tools/plot.py, with only what it reads."""

import csv

import h5py
import numpy as np

from described import put_columns, put_ply


def grid(cells, size):
    """A flat square round the origin: `cells` x `cells` squares, diagonals alternating."""
    ticks = np.linspace(-size / 2, size / 2, cells + 1)
    x, y = np.meshgrid(ticks, ticks)
    x0 = np.stack([x.ravel(), y.ravel(), 0.0 * x.ravel()], axis=1)
    triangles = []
    for j in range(cells):
        for i in range(cells):
            a = j * (cells + 1) + i
            b, c, d = a + 1, a + cells + 1, a + cells + 2
            triangles += [(a, b, d), (a, d, c)] if (i + j) % 2 else [(a, b, c), (b, d, c)]
    return x0, np.array(triangles)


def disc(radius, rings, spokes):
    """A flat disc: a node in the middle, then `rings` of `spokes` nodes."""
    angle = 2.0 * np.pi * np.arange(spokes) / spokes
    x0 = [(0.0, 0.0, 0.0)]
    for ring in range(1, rings + 1):
        r = radius * ring / rings
        x0 += [(r * np.cos(a), r * np.sin(a), 0.0) for a in angle]
    triangles = []
    for k in range(spokes):
        n = (k + 1) % spokes
        triangles.append((0, 1 + k, 1 + n))
        for ring in range(rings - 1):
            a, b = 1 + ring * spokes + k, 1 + ring * spokes + n
            triangles += [(a, a + spokes, b + spokes), (a, b + spokes, b)]
    return np.array(x0), np.array(triangles)


def draped(x0, table, folds, depth):
    """A disc over a round table: beyond the radius `table` it hangs down, in `folds` waves that
    swell to ± `depth` mm at the rim. Distances from the axis: table + depth * cos(...)."""
    r, angle = np.hypot(x0[:, 0], x0[:, 1]), np.arctan2(x0[:, 1], x0[:, 0])
    over = np.maximum(r - table, 0.0)
    wave = depth * over / max(over.max(), 1e-30) * np.cos(folds * angle)
    reach = np.minimum(r, table) + wave
    return np.stack([reach * np.cos(angle), reach * np.sin(angle), -over], axis=1)


def write(folder, plies, history=None):
    """`plies`: name -> (x0, x, triangles, shear angles in degrees); `history`: columns by name."""
    folder.mkdir(parents=True)
    with h5py.File(folder / "results.h5", "w") as file:
        file.attrs["format_version"] = 3
        file.attrs["plies"] = np.array([name.encode() for name in plies],
                                       dtype=h5py.string_dtype("utf-8", 40))
        file.attrs["tools"] = np.array([], dtype=h5py.string_dtype("utf-8", 1))
        file["time_s"] = [1.0]
        now = file.create_group("frames/000000")
        now.attrs["stroke_mm"] = 12.0
        for name, (x0, x, triangles, shear) in plies.items():
            fixed, ply = file.create_group(f"plies/{name}"), now.create_group(f"plies/{name}")
            fixed["x0"], fixed["triangles"] = x0, triangles
            columns = {"shear_angle_deg": shear}
            for k, other in enumerate(("warp_strain", "weft_strain", "warp_tension_N",
                                       "weft_tension_N", "thickness_mm")):
                columns[other] = 0.001 * shear + 0.1 * k
            put_ply(fixed, list(columns))
            ply["x"] = x
            put_columns(ply, columns)
    if history:
        write_table(folder / "history.csv", history)


def write_table(file, columns):
    with open(file, "w", newline="", encoding="utf-8") as out:
        rows = csv.writer(out)
        rows.writerow(columns)
        rows.writerows(zip(*columns.values()))
