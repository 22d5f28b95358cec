# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames of the benchmark: a law from one laboratory beside the curves of the others."""

import numpy as np
from measured_law import frame_law
from measured_work import (BLUE, CASES, GREY, MEASURED, ORANGE, PLAIN, TWILL, Fabric, Work,
                           columns_of, number, percent, plt, table)

FRAMES = {"picture_frame_plain.csv": PLAIN, "picture_frame_twill.csv": TWILL}
CHOSEN = "UML"  # whose law is drawn and run
ANGLES = (10.0, 20.0, 30.0, 40.0)


def laboratory(column: str) -> str:
    return column.split("_")[0]  # KUL_1st and KUL_3rd are of one


def by_laboratory(curve: dict, leave_out: str = "") -> dict:
    """Mean curve of each laboratory but one."""
    names = {laboratory(column) for column in curve if column != "shear_angle_deg"} - {leave_out}
    return {name: np.array([np.mean(row) for row in zip(*(values for column, values in
                            curve.items() if laboratory(column) == name))])
            for name in sorted(names)}


def scatter(curve: dict, leave_out: str = "") -> tuple:
    """Mean and standard deviation between laboratories at each angle, NaN where too few measured."""
    values = np.stack(list(by_laboratory(curve, leave_out).values()))
    count = (~np.isnan(values)).sum(axis=0)
    mean = np.nansum(values, axis=0) / np.where(count, count, np.nan)
    square = np.nansum((values - mean)**2, axis=0) / np.where(count > 1, count - 1, np.nan)
    return mean, np.sqrt(square)


def rows_of(work: Work, file: str, fabric: Fabric) -> list:
    """A row a curve: its law over the mean of the other laboratories, and over its own rows."""
    curve = columns_of(MEASURED / file)
    angle, rows = curve["shear_angle_deg"], []
    for column in [name for name in curve if name != "shear_angle_deg"]:
        own = curve[column]
        to = angle[~np.isnan(own)].max()
        law = frame_law(work, fabric, file, column)
        law_angle, force = law.frame(work, to)
        at = np.interp(angle, law_angle, force, left=np.nan, right=np.nan)
        mean, _ = scatter(curve, laboratory(column))
        there = (~np.isnan(own)) & (angle > 0.0)
        apart = np.sqrt(np.mean((at - own)[there]**2) / np.mean(own[there]**2))
        rows.append([column.replace("_", ", "), law.kind]
                    + [percent(at[angle == a][0] / mean[angle == a][0] - 1.0)
                       if not np.isnan(at[angle == a] - mean[angle == a]) else "" for a in ANGLES]
                    + [f"{100 * apart:.1f} %"])
    mean, deviation = scatter(curve)
    rows.append(["mean of all, N/mm", ""] + [number(mean[angle == a][0]) for a in ANGLES] + [""])
    rows.append(["standard deviation between laboratories", ""]
                + [f"{100 * (deviation / mean)[angle == a][0]:.0f} %" for a in ANGLES] + [""])
    return rows


def simulated(work: Work, fabric: Fabric, file: str) -> tuple:
    """Shear angles and normalised force of the case picture_frame with the law of CHOSEN."""
    law = frame_law(work, fabric, file, CHOSEN)
    run = work.run(f"frame_{file[:-4]}", CASES / "picture_frame", fabrics__glass=law.file,
                   solver__duration=0.25)
    side = 100.0
    stroke = run.history["frame_displacement_mm"]
    angle = np.degrees(np.arcsin(np.minimum((1.0 + stroke / (np.sqrt(2.0) * side))**2 - 1.0, 1.0)))
    force = run.history["frame_force_N"] \
        / (2.0 * np.cos(np.radians(45.0 - 0.5 * angle)) * side)
    to = columns_of(MEASURED / file)["shear_angle_deg"][
        ~np.isnan(columns_of(MEASURED / file)[CHOSEN])].max()
    angle_law, theory = law.frame(work, to)
    within = (angle > 5.0) & (angle < to)
    apart = np.abs(force[within] / np.interp(angle[within], angle_law, theory) - 1.0).max()
    assert apart < 0.01, f"{file}: the simulated frame is {apart} from its formula"
    return angle[within], force[within], apart


def draw(work: Work, results: dict) -> str:
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.2))
    for axis, (file, fabric) in zip(axes, FRAMES.items()):
        curve = columns_of(MEASURED / file)
        angle = curve["shear_angle_deg"]
        for column, values in curve.items():
            if column != "shear_angle_deg":
                axis.plot(angle, values, ".-", color=GREY, lw=0.7, ms=4,
                          label=None if column != "UT" else "curves of the laboratories")
                last = np.flatnonzero(~np.isnan(values))[-1]
                axis.annotate(column.replace("_", " "), (angle[last], values[last]), fontsize=7,
                              xytext=(3, -2), textcoords="offset points", color=GREY)
        mean, deviation = scatter(curve)
        few = sum(np.isnan(values) for values in by_laboratory(curve).values()) \
            > len(by_laboratory(curve)) / 2
        mean, deviation = np.where(few, np.nan, mean), np.where(few, np.nan, deviation)
        axis.fill_between(angle, mean - deviation, mean + deviation, color=BLUE, alpha=0.18, lw=0,
                          label="mean ± standard deviation between laboratories")
        axis.plot(angle, mean, color=BLUE, lw=1.5, label="their mean, where half of them measured")
        x, y, _ = results[file]
        axis.plot(x, y, color=ORANGE, lw=1.8, label=f"plyform, law from {CHOSEN} alone, simulated")
        axis.set(title=fabric.name, xlabel="shear angle (degrees)", xlim=(0, 53),
                 ylabel="normalised shear force (N/mm)", ylim=(0, None))
        axis.grid(alpha=0.3)
        axis.legend(fontsize=7, loc="upper left")
    return work.picture("frames", figure)


def part(work: Work) -> str:
    text = "## Frames: a law from one laboratory beside the others\n\n" \
        "Picture frames of seven and four curves ([data](../../cases/measured/README.md)): a " \
        "torque law is identified from each curve, and its force compared with the mean of the " \
        "other laboratories; Leuven's two loadings are one laboratory. The last column is the " \
        "misfit of the law on its own curve, rms over rms: what a law can do where only its own " \
        "curve counts. Which law follows a curve, `plyform identify` chooses by cross-validation.\n\n"
    head = ["law from", "which", *(f"{a:.0f}°" for a in ANGLES), "own curve"]
    for file, fabric in FRAMES.items():
        text += f"{fabric.name[0].upper()}{fabric.name[1:]}, force by the law over the mean of " \
            f"the other laboratories:\n\n{table(head, rows_of(work, file, fabric))}\n"
    if work.cheap:
        return text
    results = {file: simulated(work, fabric, file) for file, fabric in FRAMES.items()}
    apart = max(result[2] for result in results.values())
    picture = draw(work, results)
    return text + f"Simulated (`cases/picture_frame` with the law of {CHOSEN}, in orange below), " \
        f"the force is within {100 * apart:.1f} % of that law from 5° on. So in this test " \
        "the program adds next to nothing: how far a forecast is from another laboratory's frame " \
        "is decided by the laboratory whose curve was taken. A single curve is as far off as the " \
        "table says; the mean of several, with their standard deviation, is what a fabric file " \
        f"should have.\n\n![Frames of the benchmark and the law of one]({picture})\n"
