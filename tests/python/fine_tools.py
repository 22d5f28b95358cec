# SPDX-License-Identifier: GPL-3.0-or-later
"""Tools of very many facets, as STL files."""

from pathlib import Path

import numpy as np


def surface(path: Path, facets: int, height, up: bool):
    """An STL file of a height over the plane, from -200 to 200 mm each way; faces look up or down."""
    side = max(2, round((facets / 2) ** 0.5))
    along = np.linspace(-200.0, 200.0, side + 1)
    x, y = np.meshgrid(along, along, indexing="ij")
    points = np.stack([x, y, height(np.hypot(x, y))], axis=-1).reshape(-1, 3)
    corner = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).ravel()
    triangles = np.concatenate([np.stack([corner, corner + side + 1, corner + side + 2], 1),
                                np.stack([corner, corner + side + 2, corner + 1], 1)])
    kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
    content = np.zeros(len(triangles), kind)
    content["corners"] = points[triangles if up else triangles[:, ::-1]]
    with open(path, "wb") as file:
        file.write(bytes(80) + len(triangles).to_bytes(4, "little"))
        content.tofile(file)


def sphere(r, radius=75.0):
    """Of the punch: the lower half, and a cone beyond."""
    inside = radius - np.sqrt(np.maximum(radius ** 2 - np.minimum(r, 0.95 * radius) ** 2, 0.0))
    return inside + np.maximum(r - 0.95 * radius, 0.0)


def hollow(r, radius=95.0):
    """Of the die: flat beyond, its edge rounded."""
    return -60.0 / (1.0 + np.exp((r - radius) / 6.0))
