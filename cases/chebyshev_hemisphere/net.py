#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far the shear of a ply over a hemisphere is from the exact net of inextensible yarns, which is what
kinematic programs answer, where the ply lies on the punch: closed form of README.md.

    cases/chebyshev_hemisphere/net.py RUN [PLY]      e.g. results/hemisphere_0

The punch is the first tool, a sphere; the yarns of the ply cross at right angles, its seed is the pole.
Needs plyform and scipy.
"""

import sys

import numpy as np
import plyform
from scipy.integrate import solve_ivp

POLAR = 75.0  # degrees from the pole, to which the net is compared
NEAR = 0.01   # of the radius: the ply touches the punch


def net(z: np.ndarray) -> np.ndarray:
    """Shear angle, degrees, at z = u v / R^2: z w'' + w' + sin w = 0, w(0) = 90 degrees, w'(0) = -1."""
    begin = 1e-6
    found = solve_ivp(lambda at, w: [w[1], -(w[1] + np.sin(w[0])) / at], [begin, max(z.max(), 2 * begin)],
                      [np.pi / 2 - begin, -1.0], rtol=1e-9, dense_output=True)
    return 90.0 - np.degrees(found.sol(np.maximum(z, begin))[0])


def main() -> None:
    run = plyform.read(sys.argv[1])
    ply = run.plies[sys.argv[2] if len(sys.argv) > 2 else 0]
    punch = run.tools[0]
    surface = punch.x0 + punch.displacement_mm
    centre = 0.5 * (surface.min(axis=0) + surface.max(axis=0))
    turn = np.radians(ply.angle_deg)
    along = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    middle = ply.x[ply.triangles].mean(axis=1) - centre
    u, v = (ply.x0[ply.triangles].mean(axis=1)[:, :2] @ along).T
    distance = np.linalg.norm(middle, axis=1)
    radius = np.quantile(distance, 0.01)  # of the mid-surface: nothing of the ply lies nearer
    polar = np.degrees(np.arccos(np.clip(-middle[:, 2] / distance, -1.0, 1.0)))
    on = (distance < (1.0 + NEAR) * radius) & (polar < POLAR)
    area, shear = ply.areas_before[on], np.abs(ply.shear_angle_deg[on])
    off = shear - net(np.abs(u * v)[on] / radius**2)

    def rms(values: np.ndarray) -> float:
        return float(np.sqrt((values**2 * area).sum() / area.sum()))
    print(f"{ply.name}: within {POLAR:g} degrees of the pole shear is {rms(shear):.2f} degrees rms, "
          f"{rms(off):.2f} off the net")


if __name__ == "__main__":
    main()
