# SPDX-License-Identifier: GPL-3.0-or-later
"""Die and punch from one part: one on its surface, the other the room of the stack away. Lengths in mm."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from exchange.cad_facets import Say
from exchange.cad_sheet import Asked, Pair, read_sheet
from exchange.offset_crossings import Gap, expect_room, gap_of, told
from exchange.tool_body import Body, body_of
from plotting.reading import Trouble

UNDERCUT = 1e-3  # of the cosine: what turns away from the direction of pressing


@dataclass
class Tools:
    die: Body
    punch: Body
    pair: Pair
    to_sheet: Gap     # from the tool that is away
    from_sheet: Gap
    undercut: str     # the place, if there is one
    die_top: float    # mm against the direction of pressing, of the surface
    draw_back: float  # mm, that the punch is drawn back before pressing


def make_tools(path: Path, asked: Asked, backing: float, say: Say) -> Tools:
    """backing: mm behind the surface, of the bodies; 0: open surfaces. Call it in a process of its own.
    Raises Trouble."""
    pair = read_sheet(path, asked, say)
    say(0.9, f"measures the room at {len(pair.away.triangles)} triangles")
    to_sheet, from_sheet = gap_of(pair.sheet, pair.room, pair.away)
    expect_room(path, to_sheet, asked.deflection, asked.remedy)
    say(0.97, "makes the bodies behind the surfaces")
    on_it = pair.sheet.x, pair.sheet.triangles
    away = pair.away.x, pair.away.triangles[:, ::-1]  # to face the sheet
    die, punch = (on_it, away) if asked.on == "die" else (away, on_it)
    undercut = undercut_of(pair, asked)
    bodies = [made(surface, asked.direction * sign, backing, undercut)
              for surface, sign in ((die, 1.0), (punch, -1.0))]
    top, lowest = (-(x @ asked.direction) for x, _ in (die, punch))
    return Tools(*bodies, pair, to_sheet, from_sheet, undercut, round(float(top.max()), 6) + 0.0,
                 float(max(0.0, top.max() - lowest.min() + pair.room.max())))


def made(surface: tuple[np.ndarray, np.ndarray], back: np.ndarray, backing: float,
         undercut: str) -> Body:
    if backing and not undercut:
        return body_of(*surface, back, backing)
    return Body(*surface, False, "it has an undercut" if undercut else "")


def undercut_of(pair: Pair, asked: Asked) -> str:
    """Where the surface turns away from the other tool: there the two cannot be pressed together."""
    towards = -asked.direction if asked.on == "die" else asked.direction
    cosine = (pair.sheet.normals @ towards).min(axis=1)
    worst = int(cosine.argmin())
    return told(pair.sheet.x[pair.sheet.triangles[worst]].mean(axis=0)) if cosine[worst] < -UNDERCUT else ""


def lines_of(part: Path, asked: Asked, tools: Tools, names: tuple[Path, Path]) -> list[str]:
    """What is printed of them."""
    pair, other = tools.pair, asked.other
    room = f"{asked.room.least:.4g} to {asked.room.most:.4g}" if asked.room.most > asked.room.least else \
        f"{asked.room.most:.4g}"
    lines = [f"{part.name}: {pair.words}, unit of the file {pair.unit}, taken in mm; the {asked.on} lies on "
             f"it, the {other} is {room} mm away ({asked.room.words})"]
    for name, body, which in ((names[0], tools.die, "die"), (names[1], tools.punch, "punch")):
        away = pair.deviation if which == asked.on else pair.deviation_away
        kind = "a closed body" if body.closed else "an open surface" + \
            (f", as {body.why_open}" if body.why_open else "")
        lines.append(f"{name.name}: {len(body.triangles)} triangles, {kind}; deviation from the exact "
                     f"surface: largest {away.max():.4f} mm, rms {np.sqrt((away ** 2).mean()):.4f} mm, at "
                     f"{len(away)} points")
    for gap, words in ((tools.to_sheet, f"from the {other} to the {asked.on}"),
                       (tools.from_sheet, f"from the {asked.on} to the {other}")):
        lines.append(f"distance {words}: {gap.distance.min():.4f} to {gap.distance.max():.4f} mm, off the "
                     f"room by {np.abs(gap.error).max():.4f} mm at most, rms "
                     f"{np.sqrt((gap.error ** 2).mean()):.4f} mm, at {len(gap.error)} points")
    return lines + hints(asked, tools)


def hints(asked: Asked, tools: Tools) -> list[str]:
    lines = []
    if tools.pair.away.strips:
        lines.append(f"edges of the part are rounded on the {asked.other}, with the room as radius")
    if tools.undercut:
        lines.append(f"undercut near {tools.undercut}: seen along the direction of pressing the surface "
                     "turns away there, and rigid tools do not close over it")
    elif np.allclose(asked.direction, (0, 0, -1)):
        lines.append(f"in a case, closed at the end of the stroke: stack.bottom = {tools.die_top:.6g}; "
                     f"punch: position = [0.0, 0.0, {tools.draw_back:.6g}], direction = "
                     f"[0.0, 0.0, -1.0], stroke = {tools.draw_back:.6g}")
    return lines


def worst_error(tools: Tools) -> float:
    """mm, of the surfaces and of the room between them."""
    return max(float(np.abs(values).max()) for values in
               (tools.pair.deviation, tools.pair.deviation_away, tools.to_sheet.error,
                tools.from_sheet.error))


def unit_direction(values: list[float]) -> np.ndarray:
    """Raises Trouble."""
    direction = np.array(values, float)
    length = float(np.linalg.norm(direction))
    if not np.isfinite(direction).all() or not 1e-6 < length < 1e6:
        raise Trouble(f"--direction {' '.join(f'{value:g}' for value in values)}: three numbers that are "
                      "not all 0, from the punch to the die")
    return direction / length
