# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole plies of runs that modelled a half or a quarter, with planes of symmetry through the origin."""

from dataclasses import replace

import numpy as np

from plotting.reading import Trouble

from exchange.formed import FormedPly

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
    warp, weft = image_yarns(ply, axis, flip)
    seam = np.abs(side) < ON_PLANE
    image = np.where(seam, np.arange(len(side)), len(side) + np.cumsum(~seam) - 1)
    between = np.degrees(np.arccos(np.clip((warp * weft).sum(axis=1), -1, 1)))
    return replace(ply, x0=np.vstack([ply.x0, (ply.x0 * flip)[~seam]]),
                   x=np.vstack([ply.x, (ply.x * flip)[~seam]]),
                   triangles=np.vstack([ply.triangles, image[ply.triangles][:, [0, 2, 1]]]),
                   warp=np.vstack([ply.warp, warp]), weft=np.vstack([ply.weft, weft]),
                   shear_deg=np.r_[ply.shear_deg, ply.yarn_angle_deg - between],
                   thickness=np.r_[ply.thickness, ply.thickness])


def image_yarns(ply: FormedPly, axis: str, flip: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Warp and weft of the image (m x 3): of yarns at 45 degrees the image of the weft is a warp.
    They point the way the ply's own do."""
    angles = np.radians([ply.angle_deg, ply.angle_deg + ply.yarn_angle_deg])
    flat = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(2)])
    same = (flat * flip) @ flat.T  # [image of warp, of weft] by [warp, weft]
    for one, two, yarns in ((same[0, 0], same[1, 1], (ply.warp, ply.weft)),
                            (same[1, 0], same[0, 1], (ply.weft, ply.warp))):
        if min(abs(one), abs(two)) > 1 - ALIKE:
            return (np.sign(one) * yarns[0] * flip, np.sign(two) * yarns[1] * flip)
    raise Trouble(f"--mirror {axis}: the yarns of ply {ply.name}, at {ply.angle_deg:g} degrees, are "
                  "not those of its image: with this angle the whole ply has to be modelled")
