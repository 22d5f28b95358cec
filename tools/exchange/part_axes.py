# SPDX-License-Identifier: GPL-3.0-or-later
"""Material axes that part meshes of other programs give: coordinate systems, and angles to sides."""

from collections import Counter
from dataclasses import dataclass, field

import numpy as np

from exchange.shell_mesh import ShellMesh, centroids, element_normals, unit

LEAST_RADIUS = 1e-9  # mm: nearer to its axis a cylindrical system has no direction


@dataclass
class System:
    """A coordinate system of a file. Its axes are rows of `axes`; of a cylindrical one the third is
    the axis of rotation, from which points have their own first (radial) and second direction."""
    kind: str           # rectangular, cylindrical or spherical
    origin: np.ndarray  # 3, mm
    axes: np.ndarray    # 3 x 3

    def directions(self, points: np.ndarray, axis: int) -> np.ndarray:
        """Of axis 0, 1 or 2 at points (k x 3). NaN where there is none."""
        if self.kind == "rectangular":
            return np.broadcast_to(self.axes[axis], points.shape).copy()
        out = points - self.origin
        turn = self.axes[2]
        radial = out - (out @ turn)[:, None] * turn
        far = np.linalg.norm(radial, axis=1) > LEAST_RADIUS
        radial = np.where(far[:, None], unit(radial), np.nan)
        around = np.cross(turn, radial)
        if self.kind == "cylindrical":
            return (radial, around, np.where(far[:, None], turn, np.nan))[axis]
        outward = np.where(far[:, None], unit(out), np.nan)
        return (outward, around, np.cross(outward, around))[axis]

    def place(self, coordinates: np.ndarray) -> np.ndarray:
        """In the basic system, of three coordinates in this one; angles in degrees."""
        one, two, three = coordinates
        if self.kind == "cylindrical":
            turn = np.radians(two)
            one, two = one * np.cos(turn), one * np.sin(turn)
        elif self.kind == "spherical":  # radius, angle from z, angle about z
            down, turn = np.radians(two), np.radians(three)
            one, two, three = one * np.array((np.sin(down) * np.cos(turn),
                                              np.sin(down) * np.sin(turn), np.cos(down)))
        return self.origin + np.array((one, two, three)) @ self.axes


def system_of(kind: str, origin, on_z, in_xz) -> System | None:
    """Of three points: the origin, one on the third axis, one in the plane of first and third. None
    if they lie on a line."""
    origin, on_z, in_xz = (np.asarray(p, float) for p in (origin, on_z, in_xz))
    return system_along(kind, origin, np.cross(np.cross(on_z - origin, in_xz - origin),
                                               on_z - origin), on_z - origin)


def system_along(kind: str, origin, first, third) -> System | None:
    """Of directions: the first axis, as far as it is across the third one."""
    third = unit(np.asarray(third, float))
    second = np.cross(third, np.asarray(first, float))
    if not np.isfinite(second).all() or not np.linalg.norm(second) > 0:
        return None
    second = unit(second)
    return System(kind, np.asarray(origin, float), np.array((np.cross(second, third), second, third)))


@dataclass
class AxesFound:
    """Material axes as they are gathered, an element each, and what is said of them."""
    mesh: ShellMesh
    used: Counter = field(default_factory=Counter)   # elements by what gives their axes
    unused: Counter = field(default_factory=Counter)  # by what gives axes that are not read

    def __post_init__(self):
        self.axes = np.full((len(self.mesh.labels), 3), np.nan)
        self.normals = element_normals(self.mesh)[0]
        self.middles = centroids(self.mesh)

    def take(self, rows: np.ndarray, directions: np.ndarray, words: str) -> None:
        self.axes[rows] = directions
        count = int(np.isfinite(directions).all(axis=1).sum())
        if count:
            self.used[words] += count
        if count < len(rows):
            self.unused[words + ", which has no direction there"] += len(rows) - count

    def leave(self, count: int, words: str) -> None:
        if count:
            self.unused[words] += int(count)

    def from_sides(self, rows: np.ndarray, degrees: np.ndarray) -> np.ndarray:
        """Directions of the sides from corner 1 to corner 2, turned about the normals."""
        corners = self.mesh.corners[rows]
        side = self.mesh.nodes[corners[:, 1]] - self.mesh.nodes[corners[:, 0]]
        return self.turned(rows, side, degrees)

    def turned(self, rows: np.ndarray, directions: np.ndarray, degrees) -> np.ndarray:
        """Projections of directions onto the elements, turned about their normals."""
        normal = self.normals[rows]
        flat = unit(directions - (directions * normal).sum(axis=1, keepdims=True) * normal)
        turn = np.radians(np.broadcast_to(degrees, len(flat)))[:, None]
        return np.cos(turn) * flat + np.sin(turn) * np.cross(normal, flat)

    def done(self, others: str, rest=None) -> None:
        """Gives the mesh its axes if any were found. `others` says, and `rest` gives (m x 3), what
        elements without any have: the side from corner 1 to corner 2 unless told."""
        mesh = self.mesh
        mesh.notes += [f"{words} of {count} elements: not used" for words, count in self.unused.items()]
        if not self.used:
            return
        bare = np.flatnonzero(~np.isfinite(self.axes).all(axis=1))
        self.axes[bare] = self.from_sides(bare, 0.0) if rest is None else rest[bare]
        mesh.axes = self.axes
        words = [f"{name} of {count} elements" for name, count in self.used.items()]
        if len(bare):
            words.append(f"{others} of the other {len(bare)}")
        mesh.axes_words = ", ".join(words)
