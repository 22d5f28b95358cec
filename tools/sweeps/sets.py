# SPDX-License-Identifier: GPL-3.0-or-later
"""Which runs each set of tools/real_cloth.py has, what each is compared with and what must come
out."""

from collections.abc import Callable
from dataclasses import dataclass, field
from math import inf

from sweeps.runs import Run

DEFAULT = Run("default", "default fabric")
NUDGE = "ply.2.angle=1e-6"  # ply3 of hemisphere_five_ply
REFERENCE = "460_2_8_0.2"


@dataclass(frozen=True)
class Entry:
    """A row of a table: a run, and the run (by name) that it is compared with."""
    run: Run
    against: str = ""
    quarters: int = 0  # by which the other is turned about z first
    x: float = 0.0     # place in a picture or order of a study


@dataclass(frozen=True)
class Must:
    """number(row) <= limit in every row where `where` says so."""
    text: str
    number: Callable[[dict], float]
    limit: float
    where: Callable[[dict], bool] = lambda row: True


@dataclass(frozen=True)
class Set:
    name: str
    title: str
    entries: list[Entry]
    musts: list[Must]
    against: str = ""  # in words, for the table
    rough: bool = False  # jump and outlier too
    extra: dict = field(default_factory=dict)


def missing_stroke(row: dict) -> float:
    """mm; without end for a run that was stopped."""
    ended = row["status"] in ("done", "doubtful")
    return abs(row["target_mm"] - row["stroke_mm"]) if ended else inf


FULL_STROKE = Must("every run reaches its full stroke, mm short", missing_stroke, 0.01)
NO_CROSSING = Must("no pair of triangles crosses, between plies or within",
                   lambda row: row["crossing_between"] + row["crossing_within"], 0)
BALANCE = Must("balance error of energy below 1 %", lambda row: 100 * abs(row["balance_error"]), 1)
DEPTHS = [
    Must("at most 0.1 mm into tools at the end", lambda row: row["tool_depth_mm"], 0.1),
    Must("at most 0.1 mm into tools ever", lambda row: row["tool_deepest_mm"], 0.1),
    Must("at most 0.15 mm between plies at the end", lambda row: row["ply_depth_mm"], 0.15),
    Must("at most 0.15 mm between plies ever", lambda row: row["ply_deepest_mm"], 0.15)]
SOUND = [FULL_STROKE, NO_CROSSING, BALANCE]


def apart(row: dict) -> float:
    """Largest rms difference of a ply; NaN, and so no verdict, where there is none."""
    return max(row["apart_deg"], default=float("nan"))


def fabric_run(c: float, b: float, d: float, friction: float) -> Run:
    yarns = (("compression_stiffness", c), ("bending_stiffness", b),
             ("in_plane_bending_stiffness", d))
    return Run(f"{c:g}_{b:g}_{d:g}_{friction:g}",
               f"C {c:g}, B {b:g}, D_g {d:g}, friction {friction:g}", yarns=yarns,
               settings=(f"contact.friction={friction:g}",))


def fabric_set() -> Set:
    entries = [Entry(fabric_run(c, b, d, mu), REFERENCE, x=mu) for mu in (0.2, 0.1, 0.4, 0.05)
               for c in (460, 46) for d in (8, 2) for b in (2, 0.5)]
    pressed = Must("with C 460 and friction up to 0.2 no yarn pressed by more than 2 %",
                   lambda row: 100 * row["pressed"], 2,
                   lambda row: dict(row["run"].yarns)["compression_stiffness"] == 460
                   and row["x"] <= 0.2)
    return Set("fabric", "Compression C (N per yarn), bending B, in-plane bending D_g (N mm) and "
               "friction", entries, [*SOUND, *DEPTHS, pressed],
               "C 460, B 2, D_g 8, friction 0.2")


SETS = {"fabric": fabric_set}
