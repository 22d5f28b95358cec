# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of tools/real_cloth.py: how far the shear of each ply moves, a small plot a ply."""

from math import isfinite

from matplotlib import pyplot
from matplotlib.figure import Figure

from plotting import looks

AXIS = "area means of shear:\nrms difference, degrees"


def plies_of(rows: list[dict]) -> int:
    return max(len(row["max_shear_deg"]) for row in rows)


def frame(rows: int, plies: int, sharey: str, head: float = 0.0):
    """The figure, a strip of `head` inches above for a legend (None without), and plots."""
    figure = pyplot.figure(figsize=(2.6 * plies, 2.6 * rows + head), layout="constrained")
    upper, body = figure.subfigures(2, 1, height_ratios=[head, 2.6 * rows]) if head else \
        (None, figure)
    axes = body.subplots(rows, plies, sharex=True, sharey=sharey, squeeze=False)
    looks.finish(axes)
    for i, axis in enumerate(axes[0]):
        axis.set_title(f"ply {i + 1}" + (" (bottom)" if i == 0 else
                                         " (top)" if i == plies - 1 else ""))
    return figure, upper, axes


def values(row: dict, ply: int) -> float:
    """Of the reference, which is compared with nothing, 0."""
    told = row["apart_deg"]
    if row["is_reference"]:
        return 0.0
    return told[ply] if ply < len(told) else float("nan")


def draw_fabric(rows: list[dict]) -> Figure:
    """Over friction: a line for each C and D_g, a row of plots for each B."""
    def key(row):
        yarns = dict(row["run"].yarns)
        return (yarns["bending_stiffness"], yarns["compression_stiffness"],
                yarns["in_plane_bending_stiffness"])
    rows = [row for row in rows if not row["run"].name.endswith("_self")]  # differ by nothing drawn
    keys = sorted({key(row) for row in rows})
    bendings = sorted({b for b, _, _ in keys})
    figure, head, axes = frame(len(bendings), plies_of(rows), "all", 0.5)
    frictions = sorted({row["x"] for row in rows})
    compressions, in_plane = (sorted({k[i] for k in keys}) for i in (1, 2))
    for b, c, d in keys:
        line = sorted((row for row in rows if key(row) == (b, c, d)), key=lambda row: row["x"])
        for i, axis in enumerate(axes[bendings.index(b)]):
            axis.plot([frictions.index(row["x"]) for row in line], [values(row, i) for row in line],
                      "o" + looks.STYLES[in_plane.index(d)], ms=4, label=f"C {c:g}, D_g {d:g}",
                      color=looks.colour(compressions.index(c)),
                      mfc="white" if in_plane.index(d) else None)
    for b, row in zip(bendings, axes):
        row[0].set_ylabel(f"B {b:g} N mm\n{AXIS}")
        row[0].set_ylim(bottom=0.0)
    for axis in axes[-1]:
        axis.set_xticks(range(len(frictions)), [f"{x:g}" for x in frictions])
        axis.set_xlabel("friction")
    known = {}
    for axis in axes.ravel():
        known.update({text: line for line, text in zip(*axis.get_legend_handles_labels())})
    head.legend(known.values(), known, loc="center", ncol=len(known), frameon=False,
                fontsize="medium")
    return figure


def draw_buckling(rows: list[dict]) -> Figure:
    """Over the plateau: differences above, the most pressed yarn of the ply below."""
    line = sorted(rows, key=lambda row: row["x"])
    figure, _, axes = frame(2, plies_of(rows), "row")
    places = range(len(line))
    for i, (upper, lower) in enumerate(axes.T):
        upper.plot(places, [values(row, i) for row in line], "o-", ms=4)
        lower.plot(places, [100.0 * row["ply_pressed"][i] for row in line], "o-", ms=4,
                   color=looks.colour(1))
        lower.set_xticks(places, [f"{row['x']:g}" if isfinite(row["x"]) else "none"
                                  for row in line], rotation=60, fontsize="small")
        lower.set_xlabel("plateau, N/mm")
    axes[0][0].set_ylabel(AXIS)
    axes[1][0].set_ylabel("most pressed yarn, %")
    for axis in (axes[0][0], axes[1][0]):
        axis.set_ylim(bottom=0.0)
    return figure


DRAWN = {"fabric": draw_fabric, "buckling": draw_buckling}
