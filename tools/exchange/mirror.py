# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole plies of runs that modelled a half or a quarter, with planes of symmetry through the origin."""

from dataclasses import replace

import numpy as np

from plotting.reading import Trouble

from exchange.formed import FormedPly, across

ON_PLANE = 1e-3  # mm: nodes so near are their own mirror images
ALIKE = 1e-6


def mirrored(ply: FormedPly, axis: str) -> FormedPly:
    """With its image in the plane x = 0 (axis "x") or y = 0. Raises Trouble if the plane cannot be
    one of symmetry: the ply lies on both sides of it, or the image of its yarns are no yarns."""
    k = "xy".index(axis)
    flip = np.where(np.arange(3) == k, -1.0, 1.0)
    side = ply.x0[:, k]
    if side.min() < -ON_PLANE and side.max() > ON_PLANE:
        raise Trouble(f"--mirror {axis}: ply {ply.name} lies on both sides of {axis} = 0, from "
                      f"{side.min():.4g} to {side.max():.4g} mm before forming")
    images = image_yarns(ply, axis, flip)
    seam = np.abs(side) < ON_PLANE
    image = np.where(seam, np.arange(len(side)), len(side) + np.cumsum(~seam) - 1)
    other = (ply.x * flip)[~seam]
    x = np.vstack([ply.x, other])
    triangles = image[ply.triangles][:, [0, 2, 1]]
    if len(images) == 1:  # shear is that of the right angle to the line across them
        images, shear = [*images, across(images[0], x, triangles)], -ply.shear_deg
    else:
        between = (images[0] * images[1]).sum(axis=1)
        shear = ply.yarn_angle_deg - np.degrees(np.arccos(np.clip(between, -1, 1)))
    warp, weft, *further = [np.vstack(pair) for pair in
                            zip([ply.warp, ply.weft, *ply.further], images)]
    return replace(ply, x0=np.vstack([ply.x0, (ply.x0 * flip)[~seam]]), x=x,
                   triangles=np.vstack([ply.triangles, triangles]),
                   warp=warp, weft=weft, further=tuple(further),
                   shear_deg=np.r_[ply.shear_deg, shear],
                   thickness=twice(ply.thickness), areal_weight=twice(ply.areal_weight), gap=twice(ply.gap))


def twice(values: np.ndarray | None) -> np.ndarray | None:
    return None if values is None else np.r_[values, values]


def image_yarns(ply: FormedPly, axis: str, flip: np.ndarray) -> list[np.ndarray]:
    """Directions of each family in the image (m x 3): of yarns at 45 degrees the image of the weft
    is a warp. They point the way the ply's own do."""
    angles = np.radians(ply.angles_deg)
    flat = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(len(angles))])
    same = (flat * flip) @ flat.T  # image of which family, by that which it is
    which = np.abs(same).argmax(axis=0)
    if np.abs(same).max(axis=0).min() <= 1 - ALIKE:
        raise Trouble(f"--mirror {axis}: the yarns of ply {ply.name}, at {ply.angle_deg:g} degrees, "
                      "are not those of its image: with this angle the whole ply has to be modelled")
    return [np.sign(same[one, k]) * ply.yarns[one] * flip for k, one in enumerate(which)]
