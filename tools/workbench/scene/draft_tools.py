# SPDX-License-Identifier: GPL-3.0-or-later
"""Tools of very many facets for a first picture, with few of them, made in a part of the time that reading
them whole, cleaning them and looking for gaps take. Joined facets need not be a surface that the program
takes; so it gets a tetrahedron in the place of each, and where it puts that is where the tool goes."""

import os
import tomllib
from dataclasses import dataclass
from pathlib import Path

import numpy as np

MOST = 30_000     # facets of all tools that are joined
LARGE = 200_000   # facets of a file that is joined
CELLS = 1 << 21   # of the grid of a surface
FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
HEAD = 84         # bytes before the facets
MOST_KEPT = 20    # tools
CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 4]], float)  # each at other distances to the rest
SIDES = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])


@dataclass
class StandIn:
    file: Path             # the tetrahedron
    size: float            # of CORNERS, in units of the file
    facets: int            # of the tool
    x: np.ndarray          # n x 3, in units of the file
    triangles: np.ndarray  # m x 3

    def placed(self, seen: np.ndarray) -> np.ndarray:
        """The nodes, mm, where the corners of the tetrahedron, in any order, have come to be `seen`."""
        apart = np.linalg.norm(seen[:, None] - seen[None], axis=2).sum(axis=1)
        origin, *along = seen[np.argsort(apart)]
        axes = (np.array(along) - origin) / (self.size * np.diag(CORNERS[1:]))[:, None]
        return origin + self.x @ axes


_kept: dict[tuple, StandIn] = {}


def is_large(name: str, size: int) -> bool:
    return name.lower().endswith(".stl") and size > HEAD + LARGE * FACET.itemsize


def stand_ins(case: Path, room: Path) -> dict[int, StandIn]:
    """Of tools, by number; their files are made in `room`."""
    try:
        tools = tomllib.loads(case.read_text(encoding="utf-8-sig")).get("tool")
    except (OSError, ValueError, RecursionError):
        return {}
    large = {}
    for number, tool in enumerate(tools if isinstance(tools, list) else ()):
        name = tool.get("file") if isinstance(tool, dict) else None
        path = case.parent / name if isinstance(name, str) and "\0" not in name else None
        if path and (count := facets_of(path)):
            large[number] = path, count
    most = MOST // max(1, len(large))
    return {number: stand_in(path, count, most, room) for number, (path, count) in large.items()}


def facets_of(path: Path) -> int:
    """0 unless this is a large binary STL file."""
    try:
        size = path.stat().st_size
        if not is_large(path.name, size):
            return 0
        with open(path, "rb") as file:
            count = int.from_bytes(file.read(HEAD)[80:], "little")
    except OSError:
        return 0
    return count if HEAD + count * FACET.itemsize == size else 0


def stand_in(path: Path, count: int, most: int, room: Path) -> StandIn:
    status = os.stat(path)
    key = str(path), status.st_mtime_ns, status.st_size, status.st_ino, most
    if key not in _kept:
        while len(_kept) >= MOST_KEPT:
            _kept.pop(next(iter(_kept))).file.unlink(missing_ok=True)
        corners = np.fromfile(path, FACET, count, offset=HEAD)["corners"].reshape(-1, 3).astype(np.float32)
        x, triangles = joined(np.where(np.isfinite(corners), corners, 0.0), most)
        size = max(float(np.ptp(x, axis=0).max()), 1e-9) / 4.0
        _kept[key] = StandIn(tetrahedron(room, size), size, count, x, triangles)
    return _kept[key]


def tetrahedron(room: Path, size: float) -> Path:
    """An STL file."""
    room.mkdir(exist_ok=True)
    facets = np.zeros(len(SIDES), FACET)
    facets["corners"] = size * CORNERS[SIDES]
    path = room / f"{os.urandom(8).hex()}.stl"
    path.write_bytes(bytes(80) + len(facets).to_bytes(4, "little") + facets.tobytes())
    return path


def joined(x: np.ndarray, most: int) -> tuple[np.ndarray, np.ndarray]:
    """Nodes and triangles of facets with these corners, 3 each, after those of one cell of a grid have become
    the first of them: nodes stay on the surface, and edges where they are."""
    low = x.min(axis=0)
    size = np.maximum(x.max(axis=0) - low, 1e-9)
    cell = float(np.sqrt((size[0] * size[1] + size[1] * size[2] + size[2] * size[0]) * 2.0 / most))
    while True:
        count = np.floor(size / cell).astype(np.int64) + 1
        if count.prod() <= CELLS:
            at = ((x - low) / np.float32(cell)).astype(np.int32)
            of = (at[:, 0] * count[1] + at[:, 1]) * count[2] + at[:, 2]
            facets = of.reshape(-1, 3)
            facets = facets[(facets[:, 0] != facets[:, 1]) & (facets[:, 1] != facets[:, 2]) &
                            (facets[:, 2] != facets[:, 0])]
            _, once = np.unique(np.sort(facets, axis=1), axis=0, return_index=True)
            if len(once) <= most:
                break
        cell *= 1.2
    first = np.zeros(count.prod(), np.int64)
    first[of[::-1]] = np.arange(len(of) - 1, -1, -1)
    used, triangles = np.unique(facets[once], return_inverse=True)
    return x[first[used]].astype(float), triangles.reshape(-1, 3)
