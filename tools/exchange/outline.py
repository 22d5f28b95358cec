# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed curves: trim lines read from CSV and DXF, and what can be measured of them. Lengths in mm."""

import csv
import io
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from base.files import TABLE, check_file, read_bytes, read_text
from plotting.reading import Trouble

CHORD = 0.05        # mm: curves of DXF files are followed to within
CORNER_DEG = 25.0   # a turn that is a corner, to be kept
JOINED = 0.1        # mm between the ends of curves that are one
MOST_PAIRS = 1 << 20  # of sides compared at once


@dataclass
class TrimLine:
    """A closed curve, its first point not repeated."""
    points: np.ndarray  # k x 3; z is 0 where it is seen from above
    above: bool         # it is seen from above, whatever the height


def read_outline(path: Path, space: bool) -> TrimLine:
    """Of a CSV file with x,y or x,y,z a line, or a DXF drawing with one closed curve. With `space`
    the curve lies in space, else it is seen from above. Raises Trouble."""
    check_file(path, TABLE)
    readers = {".csv": read_csv, ".dxf": read_dxf}
    if path.suffix.lower() not in readers:
        raise Trouble(f"{path}: a trim line is a .csv file with x,y or x,y,z a line, or a .dxf "
                      "drawing with one closed curve")
    points = readers[path.suffix.lower()](path)
    if space and points.shape[1] < 3:
        raise Trouble(f"{path}: --space needs x, y and z on each line")
    flat = np.zeros((len(points), 3))
    flat[:, :3 if space else 2] = points[:, :3 if space else 2]
    keep = np.linalg.norm(flat - np.roll(flat, 1, axis=0), axis=1) > 1e-6
    flat = flat[keep]
    if len(flat) < 3:
        raise Trouble(f"{path}: a trim line has three different points at least")
    if not space and crosses_itself(flat[:, :2]):
        raise Trouble(f"{path}: the trim line crosses itself: give its points in order")
    return TrimLine(flat, not space)


def read_csv(path: Path) -> np.ndarray:
    rows = []
    text = read_bytes(path, TABLE).decode("utf-8-sig", "replace").splitlines()
    for number, row in rows_of(path, text):
        words = [word.strip() for word in row if word.strip()]
        if not words or words[0].startswith("#"):
            continue
        try:
            values = [float(word) for word in words]
        except ValueError:
            if not rows:
                continue  # names of columns
            raise Trouble(f"{path}:{number}: {','.join(row)!r} are not numbers") from None
        if len(values) not in (2, 3) or (rows and len(values) != len(rows[0])):
            raise Trouble(f"{path}:{number}: {len(values)} numbers: a line has x,y or x,y,z, "
                          "all lines alike")
        if not np.isfinite(values).all():
            raise Trouble(f"{path}:{number}: a coordinate is not finite")
        rows.append(values)
    if not rows:
        raise Trouble(f"{path} has no points")
    return np.array(rows)


def rows_of(path: Path, lines: list[str]) -> Iterator[tuple[int, list[str]]]:
    reader = csv.reader(lines)
    try:
        yield from enumerate(reader, 1)
    except csv.Error as problem:
        raise Trouble(f"{path}:{reader.line_num}: {problem}") from problem


MM = {0: 1.0, 1: 25.4, 2: 304.8, 4: 1.0, 5: 10.0, 6: 1000.0, 14: 100.0}  # of $INSUNITS, as blanks are read
PARTS = {"LWPOLYLINE": "AcDbPolyline", "SPLINE": "AcDbSpline", "ELLIPSE": "AcDbEllipse"}  # newer than R12
OF_ANY = ("5", "330", "8", "6", "62", "370", "48", "60", "67", "410", "420")  # codes of every entity


def completed(text: str) -> str:
    """A drawing whose entities do not say of which part their groups are, which blanks need not, with it said."""
    lines = text.splitlines()
    groups = [(code.strip(), value) for code, value in zip(lines[::2], lines[1::2])]
    made, k = [], 0
    while k < len(groups):
        end = next((i for i in range(k + 1, len(groups)) if groups[i][0] == "0"), len(groups))
        entity, part = groups[k:end], PARTS.get(groups[k][1].strip())
        if part and all(code != "100" for code, _ in entity):
            own = [one for one in entity[1:] if one[0] in OF_ANY]
            entity = [entity[0], *(one for one in own if one[0] in OF_ANY[:2]), ("100", "AcDbEntity"),
                      *(one for one in own if one[0] not in OF_ANY[:2]), ("100", part),
                      *(one for one in entity[1:] if one[0] not in OF_ANY)]
        made += entity
        k = end
    if ("9", "$ACADVER") not in made:
        at = next((i + 1 for i, one in enumerate(made) if one == ("2", "HEADER")), 0)
        version = [("9", "$ACADVER"), ("1", "AC1015")]  # R2000, the first that has such entities
        made[at:at] = version if at else [("0", "SECTION"), ("2", "HEADER"), *version, ("0", "ENDSEC")]
    return "".join(f"{code}\n{value}\n" for code, value in made).replace("\nAC1009\n", "\nAC1015\n")


def read_dxf(path: Path) -> np.ndarray:
    """mm. Lines and arcs that join end to end are one curve."""
    try:
        import ezdxf
        from ezdxf import path as curves
    except ImportError as problem:
        raise Trouble(f"{path} is read by ezdxf: install python3-ezdxf") from problem
    try:
        try:
            drawing = ezdxf.readfile(path)
        except ezdxf.DXFStructureError:
            drawing = ezdxf.read(io.StringIO(completed(read_text(path))))
    except (OSError, ezdxf.DXFError, ValueError) as problem:
        raise Trouble(f"{path} cannot be read as DXF: {problem}") from problem
    if drawing.units not in MM:
        raise Trouble(f"{path}: its unit ($INSUNITS = {drawing.units}) is not known: draw it in mm, cm, m, inches or feet")
    pieces = []
    for entity in drawing.modelspace():
        try:
            curve = curves.make_path(entity)
        except TypeError:
            continue  # texts, points, dimensions
        pieces.append(MM[drawing.units] * np.array([tuple(p) for p in curve.flattening(CHORD / MM[drawing.units])]))
    loops = join(pieces)
    closed = [loop for loop in loops if np.linalg.norm(loop[0] - loop[-1]) < JOINED]
    if len(closed) != 1 or len(loops) != 1:
        raise Trouble(f"{path} has {len(closed)} closed curves and {len(loops) - len(closed)} open "
                      "ones: a trim line is one closed curve")
    return closed[0]


def join(pieces: list[np.ndarray]) -> list[np.ndarray]:
    """Curves that end where others begin, put together."""
    if not pieces:
        return []
    ends = cKDTree(np.array([end for piece in pieces for end in (piece[0], piece[-1])]))
    used, done = np.zeros(len(pieces), bool), []
    for first in range(len(pieces)):
        if used[first]:
            continue
        used[first] = True
        parts = [pieces[first]]
        while np.linalg.norm(parts[0][0] - parts[-1][-1]) > JOINED:
            near = sorted(ends.query_ball_point(parts[-1][-1], JOINED))
            other = next((one for one in near if not used[one // 2]), None)
            if other is None:
                break
            used[other // 2] = True
            piece = pieces[other // 2]
            parts.append(piece[::-1][1:] if other % 2 else piece[1:])
        done.append(np.vstack(parts))
    return done


def crosses_itself(points: np.ndarray) -> bool:
    """Of a closed curve in the plane (k x 2): whether two sides that are no neighbours cut. Only sides
    whose boxes overlap are asked: boxes round halves of the curve, quarters, and so on are compared
    first."""
    a, b = points, np.roll(points, -1, axis=0)
    boxes = halved(np.minimum(a, b), np.maximum(a, b))
    todo = [(0, np.zeros(1, int), np.zeros(1, int))]
    while todo:
        level, one, two = todo.pop()
        low, high = boxes[level]
        meet = (low[one] <= high[two]).all(axis=1) & (low[two] <= high[one]).all(axis=1)
        one, two = one[meet], two[meet]
        if level + 1 == len(boxes):
            if cut(a, b, one, two).any():
                return True
            continue
        pairs = [(2 * one + i, 2 * two + j) for i in (0, 1) for j in (0, 1)]
        one, two = (np.concatenate(some) for some in zip(*pairs))
        once = one <= two
        one, two = one[once], two[once]
        for k in range(0, len(one), MOST_PAIRS):
            todo.append((level + 1, one[k:k + MOST_PAIRS], two[k:k + MOST_PAIRS]))
    return False


def halved(low: np.ndarray, high: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
    """Boxes round all, round halves, and so on, to those given; none is empty but those that fill up a
    power of two."""
    fill = (1 << max(0, (len(low) - 1).bit_length())) - len(low)
    low = np.vstack([low, np.full((fill, 2), np.inf)])
    high = np.vstack([high, np.full((fill, 2), -np.inf)])
    levels = [(low, high)]
    while len(low) > 1:
        low = np.minimum(low[::2], low[1::2])
        high = np.maximum(high[::2], high[1::2])
        levels.insert(0, (low, high))
    return levels


def cut(a: np.ndarray, b: np.ndarray, one: np.ndarray, two: np.ndarray) -> np.ndarray:
    """Whether sides ab of rows `one` and `two`, which are no neighbours, cross."""
    apart = (two - one > 1) & (two - one < len(a) - 1)
    one, two = one[apart], two[apart]

    def side(p, q, r):
        return np.sign((q[:, 0] - p[:, 0]) * (r[:, 1] - p[:, 1])
                       - (q[:, 1] - p[:, 1]) * (r[:, 0] - p[:, 0]))
    return ((side(a[one], b[one], a[two]) * side(a[one], b[one], b[two]) < 0)
            & (side(a[two], b[two], a[one]) * side(a[two], b[two], b[one]) < 0))


def divided(points: np.ndarray, spacing: float) -> np.ndarray:
    """A closed curve with points `spacing` mm apart, or somewhat less; its corners stay."""
    ahead = np.roll(points, -1, axis=0) - points
    behind = points - np.roll(points, 1, axis=0)
    cosine = (ahead * behind).sum(axis=1) / np.maximum(
        np.linalg.norm(ahead, axis=1) * np.linalg.norm(behind, axis=1), 1e-300)
    corners = np.flatnonzero(cosine < np.cos(np.radians(CORNER_DEG)))
    starts = corners if len(corners) else np.array([0])
    along = np.r_[0.0, np.cumsum(np.linalg.norm(ahead, axis=1))]
    closed = np.vstack([points, points[:1]])
    found = []
    for first, last in zip(starts, np.r_[starts[1:], starts[0] + len(points)]):
        begin, end = along[first], along[last % len(points)] + along[-1] * (last >= len(points))
        steps = max(1, int(np.ceil((end - begin) / spacing)))
        at = np.mod(begin + (end - begin) * np.arange(steps) / steps, along[-1])
        found.append(np.column_stack([np.interp(at, along, closed[:, k])
                                      for k in range(closed.shape[1])]))
    return np.vstack(found)


def area_of(points: np.ndarray) -> float:
    """Signed, of a closed curve in the plane; anticlockwise is positive."""
    x, y = points[:, 0], points[:, 1]
    return 0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def distance_to(points: np.ndarray, curve: np.ndarray) -> np.ndarray:
    """Of points (k x d) from a closed curve (c x d)."""
    a, b = curve, np.roll(curve, -1, axis=0)
    longest = np.linalg.norm(b - a, axis=1).max()
    middle = cKDTree(0.5 * (a + b))
    count = min(len(a), 32)
    to_middle, near = middle.query(points, k=count)
    to_middle, near = to_middle.reshape(len(points), -1), near.reshape(len(points), -1)
    least = to_pieces(points[:, None], a[near], b[near]).min(axis=1)
    unsure = np.flatnonzero(to_middle[:, -1] - 0.5 * longest < least) if count < len(a) else []
    for k in unsure:  # a few, of curves with long sides among short ones
        least[k] = to_pieces(points[k], a, b).min()
    return least


def to_pieces(p: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    along = b - a
    t = ((p - a) * along).sum(axis=-1) / np.maximum((along * along).sum(axis=-1), 1e-300)
    return np.linalg.norm(a + np.clip(t, 0, 1)[..., None] * along - p, axis=-1)
