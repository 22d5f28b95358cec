#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far the shear angles of two runs of plyform are apart, as means over discs of material.

    area_means.py DIR_A DIR_B [--radius MM] [--turn DEGREES] [--json FILE]
    area_means.py DIR --turn 90

The mean at a point of the unformed ply is that of the triangles whose centroid lies within the
radius (10 mm unless told), weighted by their areas before forming. On the same mesh means are
taken at the centroid of each triangle, and their differences weighted by its area; else at the
points of a grid of 5 mm that both plies have, each with the same weight.

With --turn the second run (the first itself, if there is no other) is turned about the z axis by
quarter turns first, anticlockwise from above. Where the warp of a ply then lies along the weft of
the other, the two change names and the shear angle its sign: plies are taken as balanced, with
yarns at right angles. The same holds without --turn for plies at 0 and 90 degrees.

Of each run alone, without discs: "jump" is the root mean square difference of the shear angle
between triangles that share an edge, "outlier" the largest distance of a triangle from the mean of
its neighbours.

Exit codes: 0 done, 1 something is missing or cannot be read, 2 wrong arguments.
"""

import argparse
import json
import sys
from pathlib import Path

try:
    import numpy as np
    from base.ending import EXIT_OTHER, ended
    from plotting.numbers import edges_of
    from plotting.reading import SHEAR, Ply, Trouble, read_state
    from plotting.whole_file import write_whole
except ImportError as error:
    sys.exit(f"area_means.py: error: {error}; install python3-h5py")

GRID_MM = 5.0          # between points where meshes differ: half the usual radius of the discs
SAME_ANGLE_DEG = 1.0   # plies that were disturbed a little still lie along the same yarns


def centroids(ply: Ply) -> np.ndarray:
    return ply.x0[ply.triangles].mean(axis=1)[:, :2]


def areas(ply: Ply) -> np.ndarray:
    corners = ply.x0[ply.triangles]
    return 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0],
                                         corners[:, 2] - corners[:, 0]), axis=1)


def disc_means(ply: Ply, points: np.ndarray, radius: float) -> np.ndarray:
    """Means of the ply's values over discs round points (p x 2, mm); NaN where a disc is empty.
    Triangles are sorted into square bins as wide as the radius: a disc meets nine of them."""
    at, weight = centroids(ply), areas(ply)
    low = np.minimum(at.min(axis=0), points.min(axis=0)) - radius
    bins = np.floor((at - low) / radius).astype(np.int64)
    own = np.floor((points - low) / radius).astype(np.int64)
    columns = max(bins[:, 0].max(), own[:, 0].max()) + 2
    order = np.argsort(bins[:, 1] * columns + bins[:, 0], kind="stable")
    keys = (bins[:, 1] * columns + bins[:, 0])[order]
    total, share = np.zeros(len(points)), np.zeros(len(points))
    for shift in (-columns, 0, columns):
        row = own[:, 1] * columns + own[:, 0] + shift  # three bins of a row stand in one run
        first, last = np.searchsorted(keys, row - 1), np.searchsorted(keys, row + 1, "right")
        count = last - first
        point = np.repeat(np.arange(len(points)), count)
        start = np.repeat(first - np.concatenate([[0], np.cumsum(count)[:-1]]), count)
        triangle = order[start + np.arange(len(point))]
        inside = np.einsum("pk,pk->p", at[triangle] - points[point],
                           at[triangle] - points[point]) <= radius**2
        point, triangle = point[inside], triangle[inside]
        share += np.bincount(point, weight[triangle], len(points))
        total += np.bincount(point, weight[triangle] * ply.value[triangle], len(points))
    return np.where(share > 0.0, total / np.where(share > 0.0, share, 1.0), np.nan)


def turned(ply: Ply, quarters: int) -> Ply:
    """The ply turned about z by quarter turns, in exact arithmetic."""
    c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[quarters % 4]
    matrix = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]], dtype=float)  # for rows
    return Ply(ply.name, ply.angle_deg + 90.0 * quarters, ply.x0 @ matrix, ply.x @ matrix,
               ply.triangles, ply.value)


def sign_between(a: Ply, b: Ply) -> float:
    """-1 if the warp of one lies along the weft of the other, else 1."""
    apart = (b.angle_deg - a.angle_deg) % 180.0
    return -1.0 if abs(apart - 90.0) < SAME_ANGLE_DEG else 1.0


def places_in(ply: Ply) -> set[tuple[int, int]]:
    """Numbers (i, j) of the points (i + 1/2, j + 1/2) GRID_MM that lie in the unformed ply. The
    grid is even about the z axis, so that it fits itself after a quarter turn."""
    corners = ply.x0[ply.triangles][:, :, :2] / GRID_MM - 0.5
    low = np.ceil(corners.min(axis=1) - 1e-9).astype(int)
    size = np.maximum(np.floor(corners.max(axis=1) + 1e-9).astype(int) - low + 1, 0)
    count = size[:, 0] * size[:, 1]  # points in the box round each triangle
    of = np.repeat(np.arange(len(corners)), count)
    number = np.arange(len(of)) - np.repeat(np.cumsum(count) - count, count)
    place = low[of] + np.stack([number % size[of, 0], number // size[of, 0]], axis=1)
    to = corners[of] - place[:, None, :]
    following = np.roll(to, -1, axis=1)
    turn = to[:, :, 0] * following[:, :, 1] - to[:, :, 1] * following[:, :, 0]
    area = turn.sum(axis=1)
    inside = (area != 0.0) & (turn * np.sign(area)[:, None] >= -1e-9 * abs(area)[:, None]).all(axis=1)
    return set(map(tuple, place[inside].tolist()))


def common_points(a: Ply, b: Ply) -> np.ndarray:
    """Points of the grid that lie in both plies."""
    places = sorted(places_in(a) & places_in(b))
    if not places:
        raise Trouble(f"ply {a.name} of the two runs has no place in common")
    return GRID_MM * (np.array(places) + 0.5)


def difference(a: Ply, b: Ply, radius: float) -> dict:
    same = a.triangles.shape == b.triangles.shape and (a.triangles == b.triangles).all() and \
        a.x0.shape == b.x0.shape and np.allclose(a.x0, b.x0, rtol=0.0, atol=1e-6)
    points = centroids(a) if same else common_points(a, b)
    weight = areas(a) if same else np.ones(len(points))
    mine = disc_means(a, points, radius)
    theirs = sign_between(a, b) * disc_means(b, points, radius)
    known = np.isfinite(mine) & np.isfinite(theirs)
    if not known.any():
        raise Trouble(f"ply {a.name}: no disc of {radius:g} mm holds the centroid of a triangle")
    apart, weight = (mine - theirs)[known], weight[known]
    worst = abs(apart).argmax()
    return {"rms_deg": float(np.sqrt(np.average(apart**2, weights=weight))),
            "largest_deg": float(abs(apart[worst])), "largest_at_mm": points[known][worst].tolist(),
            "mean_field_rms_deg": float(np.sqrt(np.average(mine[known]**2, weights=weight))),
            "points": int(known.sum()), "same_mesh": bool(same)}


def roughness(ply: Ply) -> dict:
    """Jumps over edges, and the triangle that stands out most."""
    edges, of_side, count = edges_of(ply.triangles)
    inner = np.flatnonzero(count[of_side] == 2)  # sides, two an edge
    order = inner[np.argsort(of_side[inner], kind="stable")].reshape(-1, 2) // 3
    left, right = order[:, 0], order[:, 1]
    jumps = ply.value[left] - ply.value[right]
    ends, others = np.concatenate([left, right]), np.concatenate([right, left])
    neighbours = np.bincount(ends, minlength=len(ply.value))
    means = np.bincount(ends, ply.value[others], len(ply.value)) / np.maximum(neighbours, 1)
    out = np.where(neighbours > 0, abs(ply.value - means), 0.0)
    return {"jump_deg": float(np.sqrt(np.mean(jumps**2))) if len(jumps) else 0.0,
            "outlier_deg": float(out.max()), "outlier_at_mm": centroids(ply)[out.argmax()].tolist()}


def compare(first: Path, second: Path, radius: float, quarters: int) -> list[dict]:
    a = read_state(first, SHEAR).plies
    b = {ply.name: turned(ply, quarters) for ply in read_state(second, SHEAR).plies}
    rows = []
    for ply in a:
        if ply.name not in b:
            raise Trouble(f"{second} has no ply {ply.name}: it has {', '.join(b)}")
        rows.append({"name": ply.name, **difference(ply, b[ply.name], radius),
                     "a": roughness(ply), "b": roughness(b[ply.name])})
    return rows


def table(plies: list[dict]) -> str:
    width = max(len("ply"), *(len(ply["name"]) for ply in plies))
    lines = [f"{'ply':{width}}  rms, °  largest, °  field rms, °   points   jump A, °  jump B, °  "
             "outlier A, °  outlier B, °"]
    for ply in plies:
        lines.append(
            f"{ply['name']:{width}}  {ply['rms_deg']:6.2f}  {ply['largest_deg']:10.2f}  "
            f"{ply['mean_field_rms_deg']:12.2f}  {ply['points']:7}  {ply['a']['jump_deg']:10.2f}  "
            f"{ply['b']['jump_deg']:9.2f}  {ply['a']['outlier_deg']:12.2f}  "
            f"{ply['b']['outlier_deg']:12.2f}")
    return "\n".join(lines)


def run() -> None:
    parser = argparse.ArgumentParser(prog="area_means.py", description=__doc__.split("\n", 1)[0])
    parser.add_argument("first", type=Path, metavar="DIR_A", help="result folder")
    parser.add_argument("second", type=Path, nargs="?", metavar="DIR_B",
                        help="result folder to compare with; with --turn DIR_A itself unless told")
    parser.add_argument("--radius", type=float, default=10.0, metavar="MM", help="of the discs")
    parser.add_argument("--turn", type=int, choices=(0, 90, 180, 270), default=0,
                        metavar="DEGREES", help="turn the second run about z: 90, 180 or 270")
    parser.add_argument("--json", type=Path, metavar="FILE", help="the numbers, with places")
    options = parser.parse_args()
    if not 0.0 < options.radius < 1e6:
        parser.error("--radius must be above 0 and at most 1e6 mm")
    if options.second is None and options.turn == 0:
        parser.error("a second folder or --turn is needed")
    rows = compare(options.first, options.second or options.first, options.radius,
                   options.turn // 90)
    if options.json:
        write_whole(options.json, json.dumps(rows, indent=2, ensure_ascii=False) + "\n")
    print(table(rows))


def main() -> None:
    ended("area_means.py", run, wrong=EXIT_OTHER)


if __name__ == "__main__":
    main()
