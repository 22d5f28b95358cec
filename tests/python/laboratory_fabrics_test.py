# SPDX-License-Identifier: GPL-3.0-or-later
"""The shear laws of cases/fabrics/glass_pp_*.toml beside the laboratories' curves.

    laboratory_fabrics_test.py CASES

Mean and standard deviation anew from cases/measured, as cases/fabrics/README.md says them.
"""

import csv
import math
import statistics
import sys
import tomllib
from pathlib import Path

cases = Path(sys.argv[1])
SIGN = {"": 0, "_minus": -1, "_plus": 1}


def laboratories(fabric: str) -> dict[float, dict[str, float]]:
    """Torque per area, N/mm, of each laboratory at each angle in degrees; it is the mean of its
    curves."""
    path = cases / f"measured/picture_frame_{fabric}.csv"
    with open(path, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    found: dict[float, dict[str, float]] = {}
    for row in rows:
        angle = float(row.pop("shear_angle_deg"))
        curves: dict[str, list[float]] = {}
        for name, force in row.items():
            if force:
                curves.setdefault(name.split("_")[0], []).append(float(force))
        if curves and angle > 0.0:
            found[angle] = {name: statistics.fmean(forces) * math.cos(math.radians(angle))
                            for name, forces in curves.items()}
    return found


def expected(fabric: str) -> dict[float, tuple[float, float]]:
    """Mean and deviation, N/mm."""
    curves = laboratories(fabric)
    everyone = max(map(len, curves.values()))
    law: dict[float, tuple[float, float]] = {}
    before: dict[str, float] = {}
    mean = share = 0.0
    for angle, here in curves.items():
        own = statistics.stdev(here.values()) / statistics.fmean(here.values()) \
            if len(here) > 1 else 0.0
        share = own if len(here) == everyone else max(share, own)
        if len(here) == everyone:
            mean = statistics.fmean(here.values())
        else:
            mean *= sum(here.values()) / sum(before[name] for name in here)
        law[angle] = (mean, share * mean)
        before = here
    return law


for fabric in ("plain", "twill"):
    law = expected(fabric)
    for suffix, sign in SIGN.items():
        name = f"glass_pp_{fabric}{suffix}.toml"
        read = tomllib.loads((cases / "fabrics" / name).read_text(encoding="utf-8"))
        cells = read["warp"]["density"] * read["weft"]["density"]
        rows = dict(read["shear"]["table"])
        assert rows.pop(0.0) == 0.0, name
        assert list(rows) == list(law), f"{name}: {list(rows)} and not {list(law)}"
        assert sorted(rows.values()) == list(rows.values()), f"{name}: torque falls"
        for angle, (mean, deviation) in law.items():
            wanted = (mean + sign * deviation) / cells
            off = abs(rows[angle] / wanted - 1.0)
            assert off < 1e-3, f"{name}: {rows[angle]} N mm at {angle} degrees, not {wanted:.4g}"
print("6 fabrics as the laboratories' curves make them")
