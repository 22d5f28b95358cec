# SPDX-License-Identifier: GPL-3.0-or-later
"""Net of inextensible yarns in a bias specimen: the evenest it can be is not the one of least energy.

Inextensible yarns of two families that cross freely are translates of each other in a plane: places
are A(s) + B(t), with s and t along the families. So the shear angle is phi(s) + phi(t), where phi is
how far a family is turned where it has come from its clamp by s, and 0 where a clamp holds it. The
load's specimen has the phi of least energy for its extension; the formula of three zones has a
constant one.
"""

import tomllib
from pathlib import Path

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.optimize import minimize

CELLS_ALONG = 60  # pieces of a yarn between the clamps


class Energy:
    """Torque of a cell and its integral over the angle, rad, of a fabric file's law."""

    def __init__(self, fabric: Path) -> None:
        shear = tomllib.loads(fabric.read_text(encoding="utf-8"))["shear"]
        self.angle = np.radians(np.linspace(0.0, 85.0, 3401))
        if "table" in shear:
            angle, torque = np.array(shear["table"]).T
            angle = np.radians(angle)
            slope = (torque[-1] - torque[-2]) / (angle[-1] - angle[-2])
            within = np.minimum(self.angle, angle[-1])
            self.torque = PchipInterpolator(angle, torque)(within) + slope * (self.angle - within)
        else:
            self.torque = sum(k * self.angle**(2 * n + 1)
                              for n, k in enumerate(shear["polynomial"]))
        steps = 0.5 * np.diff(self.angle) * (self.torque[1:] + self.torque[:-1])
        self.stored = np.concatenate([[0.0], np.cumsum(steps)])

    def at(self, angle: np.ndarray) -> tuple:
        return np.interp(np.abs(angle), self.angle, self.stored), \
            np.sign(angle) * np.interp(np.abs(angle), self.angle, self.torque)


def least_energy(fabric: Path, width: float, length: float, extension: float) -> tuple:
    """Turn phi in degrees of the pieces of a yarn, from clamp to clamp, and the energy over that of
    a constant turn."""
    law, span = Energy(fabric), length - width
    step = span / np.sqrt(2.0) / CELLS_ALONG
    place = (np.arange(CELLS_ALONG) + 0.5) * step
    across = width / np.sqrt(2.0)  # the edges lie at |s - t| = across
    both = np.clip((across - np.abs(place[:, None] - place[None, :])) / step + 0.5, 0.0, 1.0) \
        * step**2
    end = place[-1] + 0.5 * step
    one = (np.maximum(0.0, across - place) + np.maximum(0.0, across - (end - place))) * step

    def energy(half):
        turn = np.concatenate([half, half[::-1]])
        stored, torque = law.at(turn[:, None] + turn[None, :])
        stored_one, torque_one = law.at(turn)
        slope = 2.0 * (both * torque).sum(axis=1) + 2.0 * one * torque_one
        return 1e-3 * ((both * stored).sum() + 2.0 * (one * stored_one).sum()), \
            1e-3 * (slope[:CELLS_ALONG // 2] + slope[::-1][:CELLS_ALONG // 2])

    goal = span + extension
    extended = {"type": "eq",
                "fun": lambda half: 0.1 * (4 * step * np.cos(0.25 * np.pi - half).sum() - goal),
                "jac": lambda half: 0.4 * step * np.sin(0.25 * np.pi - half)}
    even = np.full(CELLS_ALONG // 2, 0.5 * np.arcsin((1.0 + extension / span)**2 - 1.0))
    found = minimize(energy, even, jac=True, method="SLSQP", constraints=[extended],
                     options={"maxiter": 200, "ftol": 1e-8})
    assert abs(extended["fun"](found.x)) < 1e-4, found.message
    return np.degrees(np.concatenate([found.x, found.x[::-1]])), found.fun / energy(even)[0]


def middle_angle(fabric: Path, width: float, length: float, extension: float) -> float:
    """Shear angle in degrees in the very middle."""
    turn, _ = least_energy(fabric, width, length, extension)
    return float(2.0 * turn[CELLS_ALONG // 2])
