# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of each state: what the curves of a report show."""

import numpy as np

from plotting.numbers import border_loop
from plotting.reading import Trouble

from .reading_run import PlyStates, Run

ENERGIES = ["fibre", "shear", "bending", "contact", "friction", "damping", "kinetic", "external"]


def largest_shear(ply: PlyStates) -> np.ndarray:
    return abs(ply.cells["shear_angle_deg"]).max(axis=1)


def rms_shear(ply: PlyStates) -> np.ndarray:
    squares = ply.cells["shear_angle_deg"]**2
    return np.sqrt((squares * ply.area).sum(axis=1) / ply.area.sum())


def draw_in(ply: PlyStates) -> np.ndarray | None:
    """Mean over the eight walks of docs/users/results.md, of each state; none where a walk does not
    meet the border."""
    try:
        loop = border_loop(ply.x0, ply.triangles)
    except Trouble:
        return None
    flat = ply.x0[:, :2]
    middle = 0.5 * (flat.min(axis=0) + flat.max(axis=0))
    fibres = np.degrees(np.arctan2(ply.weft[1], ply.weft[0])
                        - np.arctan2(ply.warp[1], ply.warp[0])) % 360.0
    warp, weft = ply.angle_deg, ply.angle_deg + fibres
    bisectors = [0.5 * (warp + weft) + 90.0 * k for k in range(4)]
    walks = [draw_in_of_walk(ply, loop, middle, angle)
             for angle in (warp, weft, warp + 180.0, weft + 180.0, *bisectors)]
    return None if any(walk is None for walk in walks) else np.mean(walks, axis=0)


def draw_in_of_walk(ply: PlyStates, loop: np.ndarray, middle: np.ndarray, angle_deg: float):
    angle = np.radians(angle_deg)
    along = np.array([np.cos(angle), np.sin(angle)])
    across = np.array([-along[1], along[0]])
    following = np.roll(loop, -1)
    start, end = ply.x0[loop, :2] - middle, ply.x0[following, :2] - middle
    from_line, to_line = start @ across, end @ across
    meets = np.flatnonzero((from_line < 0.0) != (to_line < 0.0))
    share = from_line[meets] / (from_line[meets] - to_line[meets])
    at = ((1.0 - share)[:, None] * start[meets] + share[:, None] * end[meets]) @ along
    if (at > 0.0).sum() % 2 == 0:
        return None
    nearest = np.where(at > 0.0, at, np.inf).argmin()
    w, a, b = share[nearest], loop[meets[nearest]], following[meets[nearest]]
    formed = (1.0 - w) * ply.x[:, a, :2] + w * ply.x[:, b, :2]
    return at[nearest] - np.hypot(*(formed - middle).T)


def charts_of(run: Run) -> list[dict]:
    """Curves over the states: title, unit, and a list of names with values."""
    charts = []
    forces = [(tool.name, tool.force_N) for tool in run.tools]
    forces += [(name, force) for name in run.grips
               if (force := of_states(run, f"{name}_force_N")) is not None]
    if forces:
        charts.append({"id": "forces", "title": "Forces", "unit": "N", "lines": lines(forces)})
    charts.append({"id": "largest-shear", "title": "Largest shear angle", "unit": "°",
                   "lines": lines((ply.name, largest_shear(ply)) for ply in run.plies)})
    charts.append({"id": "rms-shear", "title": "Shear angle, rms over the area", "unit": "°",
                   "lines": lines((ply.name, rms_shear(ply)) for ply in run.plies)})
    drawn = [(ply.name, draw_in(ply)) for ply in run.plies]
    drawn = [(name, values) for name, values in drawn if values is not None]
    if drawn:
        charts.append({"id": "draw-in", "title": "Draw-in, mean of eight walks", "unit": "mm",
                       "lines": lines(drawn)})
    if run.history:
        energies = [(name, values / 1000.0) for name in ENERGIES
                    if (values := of_states(run, f"{name}_mJ")) is not None]
        charts.append({"id": "energies", "title": "Energies", "unit": "J",
                       "lines": lines((name, values) for name, values in energies
                                      if np.nanmax(abs(values), initial=0.0) > 0.0)})
    return charts


def of_states(run: Run, column: str) -> np.ndarray | None:
    """A column of history.csv, which may have a row less than there are states, or more, while the
    run goes on: NaN where there is none."""
    if not run.history or column not in run.history:
        return None
    values = np.full(len(run.time_s), np.nan)
    told = run.history[column][:len(values)]
    values[:len(told)] = told
    return values


def lines(named) -> list[dict]:
    """None where a value is not known."""
    return [{"name": name, "values": [float(f"{v:.7g}") if np.isfinite(v) else None for v in values]}
            for name, values in named]
