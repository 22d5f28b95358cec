# SPDX-License-Identifier: GPL-3.0-or-later
"""The exact net on a sphere: a limp ply comes to it, a ply with shear stiffness does not."""

import numpy as np
from measured_work import (CASES, GREY, MEASURED, ORANGE, BLUE, GREEN, PURPLE, Run, Work,
                           columns_of, number, plt, table)

ANGLES = (15.0, 30.0, 45.0, 60.0, 75.0)  # degrees from the pole
LIMP = 3.7e-5  # N mm, the case's k1: a 10 000th of the glass weave's
RADIUS = 100.3  # mm, of the mid-surface


def exact() -> tuple:
    net = columns_of(MEASURED / "net_on_sphere.csv")
    return net["polar_angle_deg"], net["shear_angle_deg"]


def on_meridian(result: Run) -> tuple:
    """Angle from the pole, from the meridian at 45 degrees, and shear angle of each triangle."""
    triangles, _, now, shear = result.ply("ply")
    centre = now[triangles].mean(axis=1) - [0.0, 0.0, -100.0]
    polar = np.degrees(np.arccos(centre[:, 2] / np.linalg.norm(centre, axis=1)))
    off = (np.degrees(np.arctan2(centre[:, 1], centre[:, 0])) % 90.0) - 45.0
    return polar, off, np.abs(shear)


def shear_at(result: Run, polar_angle: float) -> float:
    """On the meridian: triangles around, linear along it, even and quadratic across."""
    polar, off, shear = on_meridian(result)
    size = np.degrees(220.0 * np.sqrt(2.0 / len(polar)) / RADIUS)
    near = (np.abs(polar - polar_angle) < size) \
        & (np.abs(off) * np.sin(np.radians(polar_angle)) < size)
    terms = np.stack([np.ones(near.sum()), polar[near] - polar_angle, off[near]**2], axis=1)
    return float(np.linalg.lstsq(terms, shear[near], rcond=None)[0][0])


def row(words: str, result: Run, strain: bool = True) -> list:
    net = dict(zip(*exact()))
    tension = f"{100 * result.summary['plies'][0]['max_fibre_strain']:.2g} %" if strain else ""
    return [words, *(f"{shear_at(result, a) - net[a]:+.2f}°".replace("-", "−") for a in ANGLES),
            tension]


def part(work: Work) -> str:
    net = dict(zip(*exact()))
    text = "## The exact net on a sphere\n\n" \
        "Yarns of constant length on a sphere, crossing freely, have one answer " \
        "([data](../../cases/measured/README.md)): the limit of stiff yarns and no resistance to " \
        "shear. The case `chebyshev_hemisphere` lays a ply on a smooth sphere by its weight. " \
        "Shear angle on the meridian halfway between the yarns:\n\n"
    head = ["", *(f"{a:.0f}° from the pole" for a in ANGLES), "largest strain of a yarn"]
    exact_row = ["exact net", *(f"{net[a]:.2f}°" for a in ANGLES), "0"]
    if work.cheap:
        return text + table(head, [exact_row])
    case = CASES / "chebyshev_hemisphere"
    size = "blanks__square__element_size"

    def limp(name, **changes):
        return work.run(f"sphere_{name}", case, solver__outputs=2, **changes)

    base = limp("6", **{size: 6})
    rows = [exact_row, row("elements of 6 mm, less the net", base)]
    for element in (4, 3):
        rows.append(row(f"{element} mm", limp(str(element), **{size: element})))
    for factor in (1000, 100000):
        softer = limp(f"soft_{factor}", **{size: 6, "solver__fibre_softening": factor})
        rows.append(row(f"6 mm, yarns {'ten times as stiff' if factor == 1000 else 'a tenth as stiff'}",
                        softer))
    stiff = {}
    for factor in (10, 100, 10000):
        stiff[factor] = limp(f"shear_{factor}", **{size: 6, "fabrics__limp__shear__polynomial":
                                                  f"[{factor * LIMP:g}]"})
        words = "that of the glass weave" if factor == 10000 else f"{factor} times the case's"
        rows.append(row(f"6 mm, shear stiffness {words}", stiff[factor]))
    off = max(abs(shear_at(base, a) - net[a]) for a in ANGLES)
    assert off < 0.25, off
    picture = draw(work, base, stiff)
    return text + table(head, rows) + f"\n![Shear along the meridian]({picture})\n\n" \
        f"The simulated net is within {number(off, 2)} degrees of the exact one with the largest " \
        "elements already, and softer yarns are off by their strain. With more resistance to " \
        "shear the ply no longer lies down by its weight: from where it stands away its angles " \
        "are those of a cloth that hangs, and the glass weave's own stiffness keeps it off the " \
        "sphere but for the pole. A draping program that only lays nets gives the first row for " \
        "any fabric.\n"


def draw(work: Work, base: Run, stiff: dict) -> str:
    figure, axis = plt.subplots(figsize=(7.5, 4.2))
    polar, shear = exact()
    axis.plot(polar, shear, color="black", lw=1.2, label="exact net")
    for result, words, colour in [(base, "limp ply, elements of 6 mm", ORANGE),
                                  (stiff[10], "shear 10 times as stiff", BLUE),
                                  (stiff[100], "100 times", GREEN),
                                  (stiff[10000], "the glass weave's", PURPLE)]:
        angle, off, value = on_meridian(result)
        near = np.abs(off) * np.sin(np.radians(angle)) < 3.0
        axis.plot(angle[near], value[near], ".", color=colour, ms=4, label=words)
    axis.set(xlabel="angle from the pole (degrees)", xlim=(0, 105), ylim=(0, 70),
             ylabel="shear angle within 3° of the meridian (degrees)")
    axis.axvline(90.0, color=GREY, lw=0.6)
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8)
    return work.picture("sphere", figure)
