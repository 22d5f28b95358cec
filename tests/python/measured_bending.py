# SPDX-License-Identifier: GPL-3.0-or-later
"""A cantilever of a measured curve of moment over curvature, by the program and by its elastica."""

import numpy as np
from measured_work import (BLUE, GREY, MEASURED, ORANGE, Run, Work, columns_of, number, percent, plt,
                           table)

WEIGHT = 1385e-9 * 9.81  # N/mm2: 1 mm of 1385 kg/m3
OVERHANGS = (150.0, 200.0, 250.0)  # mm
#: Elements along the overhang, and what is simulated: s, and 1/s about critical for the first mode.
RUNS = {150.0: (20, 1.0, 30.0), 200.0: (20, 1.5, 25.0), 250.0: (20, 3.0, 15.0)}
FINER = (30, 40)  # elements along the longest

CASE = """title = "Strip of {overhang:g} mm under its own weight"
gravity = [0.0, 0.0, -9810.0]

[fabrics.glass]
surface_density = 1385.0
thickness = 1.0
shear = {{polynomial = [1.0]}}

[fabrics.glass.warp]
density = 1.0
stiffness = 100.0            # soft, for large steps: strains stay under 1e-4
compression_stiffness = 100.0
bending_table = {law}

[fabrics.glass.weft]
density = 1.0
stiffness = 100.0
compression_stiffness = 100.0
bending_table = {law}

[blanks.strip]
size = [{length}, {width}]
mesh = "alternating"
element_size = {element}

[[ply]]
name = "strip"
fabric = "glass"
blank = "strip"
angle = 0.0

[[boundary]]
name = "clamp"
kind = "grip"
box = [[{start}, {side}], [{clamped}, {other}]]

[solver]
step_factor = 0.9
duration = {duration}
mass_damping = {damping}
outputs = 10
"""


def measured() -> tuple:
    """Curvature in 1/mm and moment per width in N."""
    curve = columns_of(MEASURED / "moment_curvature_glass.csv")
    return curve["curvature_1_per_m"] / 1000.0, curve["moment_N"]


def initial_stiffness() -> float:
    curvature, moment = measured()
    return float(moment[1] / curvature[1])


def limit_of_line() -> float:
    """Moment from which the curve is a hundredth below its first line."""
    curvature, moment = measured()
    return float(moment[1:][moment[1:] < 0.99 * initial_stiffness() * curvature[1:]][0])


def elastica(overhang: float, curvature_of) -> tuple:
    """Heavy elastica of a strip: places x, z below, and the moment at the clamp.

    theta' = k(M), M(s) = w * integral from s to the end of (x(u) - x(s)) du, by iteration.
    """
    s = np.linspace(0.0, overhang, 4001)
    step = s[1]

    def integral(values):
        return np.concatenate([[0.0], np.cumsum(0.5 * step * (values[1:] + values[:-1]))])

    theta = np.zeros_like(s)
    for _ in range(2000):
        x = integral(np.cos(theta))
        above = integral(x)
        moment = WEIGHT * (above[-1] - above - x * (overhang - s))
        new = integral(curvature_of(moment))
        if np.abs(new - theta).max() < 1e-10:
            return x, integral(np.sin(theta)), float(moment[0])
        theta = 0.5 * (theta + new)
    raise AssertionError("the elastica does not converge")


def softening(moment: np.ndarray) -> np.ndarray:
    """Curvature of the measured curve, its last slope going on."""
    curvature, known = measured()
    slope = (curvature[-1] - curvature[-2]) / (known[-1] - known[-2])
    return np.where(moment > known[-1], curvature[-1] + slope * (moment - known[-1]),
                    np.interp(moment, known, curvature))


def run(work: Work, overhang: float, elements: int) -> Run:
    """A clamp of two cells: it lies half an element behind the last row held."""
    element = overhang / (elements + 0.5)
    length, width = (elements + 2) * element, 4 * element
    _, duration, damping = RUNS[overhang]
    law = [[float(f"{k:.9g}"), float(f"{m:.9g}")] for k, m in zip(*measured())]
    start, gap = -0.5 * length - 0.1, 0.1
    case = CASE.format(overhang=overhang, law=law, length=length, width=width, element=element,
                       start=start, clamped=-0.5 * length + 2 * element + gap,
                       side=-0.5 * width - gap, other=0.5 * width + gap, duration=duration,
                       damping=damping)
    name = f"cantilever_{overhang:g}_{elements}"
    return work.run(name, work.write(f"{name}.toml", case))


def line_of(result: Run, overhang: float) -> tuple:
    """Middle line from the clamp on: x and z below, of the last state; sag of the end."""
    _, before, now, _ = result.ply("strip")
    along = before[:, 0]
    rows = np.unique(np.round(along, 6))
    x = np.array([now[np.abs(along - row) < 1e-3, 0].mean() for row in rows])
    z = np.array([(before - now)[np.abs(along - row) < 1e-3, 2].mean() for row in rows])
    clamp = rows[-1] - overhang
    return x - clamp, z, float(z[-1])


def part(work: Work) -> str:
    stiffness = initial_stiffness()
    rows, lines = [], {}
    for overhang in OVERHANGS:
        x, z, moment = elastica(overhang, softening)
        _, straight, _ = elastica(overhang, lambda m: m / stiffness)
        lines[overhang] = (x, z)
        rows.append([f"{overhang:g} mm", f"{number(moment)} N", f"{straight[-1]:.1f} mm",
                     f"{z[-1]:.1f} mm"])
    # what others computed of this curve: 7.2, 22.6 and 102 mm
    assert all(abs(lines[o][1][-1] - sag) < 0.005 * sag + 0.05
               for o, sag in zip(OVERHANGS, (7.2, 22.6, 102.0)))
    text = "## Cantilever of a measured moment-curvature curve\n\n" \
        "A glass fabric with binder bends like a line up to a moment of " \
        f"{number(limit_of_line())} N (N mm per mm of width; {stiffness:.0f} N mm), and beyond " \
        "gives way to a fraction of that ([data](../../cases/measured/README.md)). Strips of it " \
        "hang under their own weight: sag of the end by the elastica, integrated here of the " \
        "first line alone and of the whole curve.\n\n"
    head = ["overhang", "moment at the clamp", "elastica of the first line",
            "elastica of the curve"]
    text += table(head, rows)
    if work.cheap:
        for overhang in OVERHANGS[:2]:
            sag = line_of(run(work, overhang, RUNS[overhang][0]), overhang)[2]
            work.holds(sag, 0.01, "Cantilever", [f"{overhang:g} mm", RUNS[overhang][0]], 2)
        return text
    runs = {overhang: run(work, overhang, RUNS[overhang][0]) for overhang in OVERHANGS}
    finer = {elements: run(work, OVERHANGS[-1], elements) for elements in FINER}
    text += "\nSimulated with that curve as `bending_table` of both families, under gravity:\n\n"
    told = [(o, RUNS[o][0], runs[o]) for o in OVERHANGS] \
        + [(OVERHANGS[-1], elements, result) for elements, result in finer.items()]
    simulated = []
    for overhang, elements, result in told:
        sag = line_of(result, overhang)[2]
        off = sag / lines[overhang][1][-1] - 1.0
        assert abs(off) < 0.06, (overhang, elements, off)
        simulated.append([f"{overhang:g} mm", elements, f"{sag:.1f} mm", percent(off),
                          f"{result.history['kinetic_mJ'][-1]:.0e} of "
                          f"{number(result.history['bending_mJ'][-1])} mJ".replace("-", "−")])
    text += table(["overhang", "elements along it", "sag", "over the elastica",
                   "kinetic energy, of bending"], simulated)
    picture = draw(work, lines, {**runs, OVERHANGS[-1]: finer[FINER[-1]]})
    root = softening(np.array([elastica(OVERHANGS[-1], softening)[2]]))[0]
    return text + f"\n![The curve, and strips that hang by it]({picture})\n\n" \
        "The longest strip makes a hinge: nearly all of its bend lies in the first centimetres, " \
        f"where the moment is above the line's end, with a radius of {1.0 / root:.0f} mm at the " \
        "clamp. An element there is a good part of that, hence the error that halves with its " \
        "size; a linear law needs no such mesh. A bending stiffness alone, of the first line, " \
        "would have this strip sag by half of what it does.\n"


def draw(work: Work, lines: dict, runs: dict) -> str:
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 3.8))
    curvature, moment = measured()
    left.plot(curvature, moment, ".-", color="black", ms=3, label="measured")
    left.plot([0.0, 0.0035], [0.0, 0.0035 * initial_stiffness()], "--", color=GREY,
              label="first line")
    left.set(xlabel="curvature (1/mm)", ylabel="moment per width (N)", xlim=(0, None),
             ylim=(0, 0.45))
    for overhang, (x, z) in lines.items():
        right.plot(x, -z, color=BLUE, lw=3, alpha=0.4,
                   label="elastica" if overhang == OVERHANGS[0] else None)
        ours_x, ours_z, _ = line_of(runs[overhang], overhang)
        right.plot(ours_x, -ours_z, ".-", color=ORANGE, ms=4, lw=0.8,
                   label="plyform, nodes" if overhang == OVERHANGS[0] else None)
    right.set(aspect="equal", xlabel="distance from the clamp (mm)", ylabel="height (mm)",
              title="strips of 150, 200 and 250 mm")
    for axis in (left, right):
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    return work.picture("cantilever", figure)
