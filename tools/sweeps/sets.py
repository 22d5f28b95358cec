# SPDX-License-Identifier: GPL-3.0-or-later
"""Which runs each set of tools/real_cloth.py has, what each is compared with and what must come
out."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf, nan

from sweeps.runs import Run
from sweeps.stacks import stack_run

DEFAULT = Run("default", "default fabric")
NUDGE = "ply.2.angle=1e-6"  # ply3 of hemisphere_five_ply
REFERENCE = "460_2_8_0.2"
YARNS_PER_MM = 0.25   # of the glass weave, warp and weft


@dataclass(frozen=True)
class Entry:
    """A row of a table: a run, and the run (by name) that it is compared with."""
    run: Run
    against: str = ""
    quarters: int = 0  # by which the other is turned about z first
    x: float = 0.0     # friction, plateau (N/mm) or element size (mm)


@dataclass(frozen=True)
class Must:
    """number(row, all rows) <= limit in every row where `where` says so, by its run and x. No
    number (None): what it is compared with is not there yet."""
    text: str
    number: Callable[[dict, list[dict]], float | None]
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


def missing_stroke(row: dict, _=None) -> float:
    """mm; without end for a run that was stopped."""
    ended = row["status"] in ("done", "doubtful")
    return abs(row["target_mm"] - row["stroke_mm"]) if ended else inf


FULL_STROKE = Must("every run reaches its full stroke, mm short", missing_stroke, 0.01)
NO_CROSSING = Must("no pair of triangles crosses, between plies or within",
                   lambda row, _: row["crossing_between"] + row["crossing_within"], 0)
BALANCE = Must("balance error of energy below 1 %, %",
               lambda row, _: 100 * abs(row["balance_error"]), 1)
DEPTHS = [
    Must("at most 0.1 mm into tools at the end", lambda row, _: row["tool_depth_mm"], 0.1),
    Must("at most 0.1 mm into tools ever", lambda row, _: row["tool_deepest_mm"], 0.1),
    Must("at most 0.15 mm between plies at the end", lambda row, _: row["ply_depth_mm"], 0.15),
    Must("at most 0.15 mm between plies ever", lambda row, _: row["ply_deepest_mm"], 0.15)]
SOUND = [FULL_STROKE, NO_CROSSING, BALANCE]


def apart(row: dict, _=None) -> float | None:
    """Largest rms difference of a ply."""
    return None if row["waits"] else max(row["apart_deg"], default=nan)


def fabric_run(c: float, b: float, d: float, friction: float) -> Run:
    yarns = (("compression_stiffness", c), ("bending_stiffness", b),
             ("in_plane_bending_stiffness", d))
    return Run(f"{c:g}_{b:g}_{d:g}_{friction:g}",
               f"C {c:g}, B {b:g}, D_g {d:g}, friction {friction:g}", yarns=yarns,
               settings=(f"contact.friction={friction:g}",))


def folds(name: str) -> bool:
    """Whether the cloth of a run of this set is so limp that it folds on itself."""
    return any(limp in name for limp in ("_0.5_2_0.2", "_0.5_2_0.4", "_2_2_0.4"))


def fabric_set() -> Set:
    entries = [Entry(fabric_run(c, b, d, mu), REFERENCE, x=mu) for mu in (0.2, 0.1, 0.4, 0.05)
               for c in (460, 46) for d in (8, 2) for b in (2, 0.5)]
    # cloth this limp folds on itself: again with contact of a ply with itself
    limp = [entry for entry in entries if folds(entry.run.name)]
    entries += [replace(entry, run=replace(
        entry.run, name=f"{entry.run.name}_self", label=f"{entry.run.label}, contact.self on",
        settings=(*entry.run.settings, 'contact.self="on"'))) for entry in limp]
    pressed = Must("with C 460 and friction up to 0.2 no yarn pressed by more than 2 %",
                   lambda row, _: 100 * row["pressed"], 2,
                   lambda row: dict(row["run"].yarns)["compression_stiffness"] == 460
                   and row["x"] <= 0.2)
    crossing = [
        Must("no pair of triangles of different plies crosses",
             lambda row, _: row["crossing_between"], 0),
        Must("no pair of triangles of one ply crosses where the cloth does not fold on itself or "
             "contact.self is on", lambda row, _: row["crossing_within"], 0,
             lambda row: not folds(row["run"].name) or row["run"].name.endswith("_self"))]
    return Set("fabric", "Compression C (N per yarn), bending B, in-plane bending D_g (N mm) and "
               "friction", entries, [FULL_STROKE, *crossing, BALANCE, *DEPTHS, pressed],
               "C 460, B 2, D_g 8, friction 0.2")


def buckling_set() -> Set:
    entries = []
    for plateau in (0.0, 0.02, 0.05, 0.1, 0.2, 0.4, 0.8):
        yarn = ("buckling_force", plateau / YARNS_PER_MM)
        entries.append(Entry(Run(f"plateau_{plateau:g}", f"plateau {plateau:g} N/mm",
                                 yarns=(yarn,)), "default", x=plateau))
    entries.append(Entry(replace(DEFAULT, label="no plateau (default)"), "default", x=inf))
    return Set("buckling", "A plateau of the force along pressed yarns, default fabric", entries,
               [*SOUND, *DEPTHS], "the default fabric, no plateau")


def accuracy_set() -> Set:
    levels = ("draft", "standard", "reference")
    entries = [Entry(Run(f"accuracy_{level}", f"--accuracy {level}", accuracy=level),
                     "accuracy_reference") for level in levels]
    return Set("accuracy", "Softer, shorter and coarser runs",
               [*entries, Entry(replace(DEFAULT, label="the case's own dials"),
                                "accuracy_reference")],
               [*SOUND, *DEPTHS], "--accuracy reference")


def nudged(run: Run) -> Run:
    return replace(run, name=f"{run.name}_nudged", label=f"{run.label}, ply3 turned by 1e-6°",
                   settings=(*run.settings, NUDGE))


def of_square_plies(row: dict, _=None) -> float | None:
    """As `apart`, of plies at 0 or 90 degrees: the quarter turn leaves their mesh as it is."""
    return None if row["waits"] else max(
        (apart for apart, angle in zip(row["apart_deg"], row["angles_deg"])
         if angle % 90.0 == 0.0), default=nan)


def repeat_set() -> Set:
    others = [fabric_run(46, 0.5, 8, 0.2), fabric_run(460, 2, 8, 0.2), fabric_run(460, 2, 8, 0.4)]
    entries = [Entry(nudged(DEFAULT), DEFAULT.name), Entry(DEFAULT, DEFAULT.name, 1),
               *(Entry(nudged(run), run.name) for run in others)]
    pair = Must("the default fabric twice, 1e-6 degrees apart: within 0.5 degrees rms in every ply",
                apart, 0.5, lambda row: row["run"].name == "default_nudged")
    turn = Must("a quarter turn of plies at 0 degrees: within 1 degree", of_square_plies, 1.0,
                lambda row: row["run"].name == "default")
    return Set("repeat", "Runs that should be the same",
               [*entries, *(Entry(run) for run in others)], [*SOUND, pair, turn],
               "the same run without the turn")


def over_coarsest(key: str, coarsest: str) -> Callable:
    """Largest ratio of a ply's number per element size to the same of the coarsest mesh."""
    def number(row: dict, rows: list[dict]) -> float | None:
        first = next((other for other in rows if other["run"].name == coarsest), None)
        if first is None:
            return None
        if not row[key] or len(row[key]) != len(first[key]):
            return nan
        return max(a / row["x"] / (b / first["x"]) for a, b in zip(row[key], first[key]))
    return number


def mesh_set() -> Set:
    sizes = (6.8, 4.8, 3.4)
    entries = [Entry(DEFAULT if h == 6.8 else
                     Run(f"mesh_{h:g}", f"elements of {h:g} mm",
                         settings=(f"blanks.square.element_size={h:g}",)), "mesh_3.4", x=h)
               for h in sizes]
    entries[0] = replace(entries[0], run=replace(DEFAULT, label="elements of 6.8 mm (default)"))
    rounder = "tool.1.points=[[80.0, -120.0], [80.0, 0.0, 20.0], [400.0, 0.0]]"
    entries += [Entry(Run(f"fillet_{h:g}", f"elements of {h:g} mm, die fillet of 20 mm",
                          settings=(rounder, f"blanks.square.element_size={h:g}")), "fillet_3.4",
                      x=h) for h in (6.8, 3.4)]
    near = Must("area means within 1.5 degrees rms of the finest mesh", apart, 1.5,
                lambda row: row["x"] > 3.4)
    falls = [Must(f"the {word} falls in proportion to h (over h, at most 1.25 of that at 6.8 mm)",
                  over_coarsest(key, DEFAULT.name), 1.25,
                  lambda row: row["run"].name.startswith("mesh_"))
             for word, key in (("jump", "jump_deg"), ("outlier", "outlier_deg"))]
    return Set("mesh", "Finer meshes, default fabric", entries, [*SOUND, *DEPTHS, near, *falls],
               "elements of 3.4 mm with the same fillet", rough=True)


def from_shipped(key: str, row: dict, rows: list[dict]) -> float | None:
    """Degrees, largest distance of a ply's number from the same of the case as shipped."""
    shipped = next((other for other in rows if other["run"].name == row["run"].case), None)
    if shipped is None:
        return None
    return max((abs(a - b) for a, b in zip(row[key], shipped[key])), default=nan)


def one_ply_set() -> Set:
    """One ply does not need these numbers: they must not change it."""
    entries = []
    for case in ("hemisphere_0", "hemisphere_45"):
        plain = Run(case, f"{case} as shipped", case=case)
        entries.append(Entry(plain))
        for c, b, d in ((460, 2, 8), (460, 0.5, 2), (46, 2, 8), (46, 0.5, 2)):
            yarns = (("compression_stiffness", c), ("bending_stiffness", b),
                     ("in_plane_bending_stiffness", d))
            entries.append(Entry(Run(f"{case}_{c}_{b:g}_{d}", f"{case}, C {c}, B {b:g}, D_g {d}",
                                     case=case, yarns=yarns), case))
    near = [Must(f"{word} shear angle within 1 degree of the case as shipped",
                 lambda row, rows, key=key: from_shipped(key, row, rows), 1.0)
            for word, key in (("largest", "max_shear_deg"), ("rms", "rms_shear_deg"))]
    return Set("one_ply", "One ply with and without these numbers", entries, [*SOUND, *near],
               "the case as shipped")


def stacks_set() -> Set:
    yarns = (("compression_stiffness", 460.0), ("bending_stiffness", 2.0),
             ("in_plane_bending_stiffness", 18.0))  # zones that 10 mm carry
    folding = {(20, 5), (20, 6)}  # plies that fold through themselves without self-contact
    entries = [Entry(stack_run(count, seed, 10.0, "random", yarns, (count, seed) in folding))
               for count in (1, 5, 10, 20) for seed in range(1, 11)]
    return Set("stacks", "Random angles and frictions, elements of 10 mm, C 460, B 2, D_g 18",
               entries, SOUND)


def box_set() -> Set:
    run = Run("box", "square box, two plies at ±30°", case="square_box", stroke_mm=35.0)
    return Set("box", "Two plies over a square box", [Entry(run)], SOUND)


def free_set() -> Set:
    run = Run("free", "five plies, contact.self on", without="blank_holder",
              settings=('contact.self="on"',))
    return Set("free", "Five plies without a blank-holder", [Entry(run)], SOUND)


SETS = {"fabric": fabric_set, "buckling": buckling_set, "accuracy": accuracy_set,
        "repeat": repeat_set, "mesh": mesh_set, "box": box_set, "free": free_set,
        "one_ply": one_ply_set, "stacks": stacks_set}
