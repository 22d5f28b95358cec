# SPDX-License-Identifier: GPL-3.0-or-later
"""VTKHDF: an unstructured grid a body.

One state is version 1.0 of the format, which VTK 9.1 and ParaView 5.11 read. All states in one file
are version 2.0, with a group Steps, for VTK 9.3 and later: triangles are stored once, points wherever
they have moved since the step before.
"""

from pathlib import Path

import h5py
import numpy as np

from exchange.states import Body

TRIANGLE = 5  # VTK's number of the cell


def write_vtkhdf(steps: list[Body], times: list[float] | None, path: Path) -> None:
    """The same body at each step; times in s, none for a single state."""
    with h5py.File(path, "w") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = np.array([1, 0] if times is None else [2, 0])
        root.attrs.create("Type", b"UnstructuredGrid", dtype="S16")
        put_mesh(root, steps, times is not None)
        for group, kind in (("PointData", "nodes"), ("CellData", "cells")):
            made = root.create_group(group)
            for name in getattr(steps[0], kind):
                made[name] = np.concatenate([getattr(body, kind)[name] for body in steps])
        if times is not None:
            put_steps(root, steps, times)


def put_mesh(root: h5py.Group, steps: list[Body], repeated: bool) -> None:
    """Cells stand once; of several steps points stand once a step."""
    body = steps[0]
    count = len(body.triangles)
    parts = len(steps) if repeated else 1
    root["NumberOfPoints"] = np.full(parts, len(body.points))
    root["NumberOfCells"] = np.full(parts, count)
    root["NumberOfConnectivityIds"] = np.full(parts, 3 * count)
    root["Points"] = np.concatenate([one.points for one, new in zip(steps, moved(steps)) if new])
    root["Types"] = np.full(count, TRIANGLE, np.uint8)
    root["Connectivity"] = body.triangles.ravel()
    root["Offsets"] = 3 * np.arange(count + 1)


def moved(steps: list[Body]) -> list[bool]:
    """Whether a step has other points than the one before; the first has."""
    return [True, *(not np.array_equal(one.points, two.points)
                    for one, two in zip(steps, steps[1:]))]


def put_steps(root: h5py.Group, steps: list[Body], times: list[float]) -> None:
    made = root.create_group("Steps")
    count = len(steps)
    index = np.arange(count)
    zero = np.zeros(count, np.int64)
    made.attrs["NSteps"] = count
    made["Values"] = np.array(times)
    made["PartOffsets"], made["NumberOfParts"] = index, np.ones(count, np.int64)
    made["PointOffsets"] = (np.cumsum(moved(steps)) - 1) * len(steps[0].points)
    made["CellOffsets"], made["ConnectivityIdOffsets"] = zero[:, None], zero[:, None]
    for group, kind, size in (("PointDataOffsets", "nodes", len(steps[0].points)),
                              ("CellDataOffsets", "cells", len(steps[0].triangles))):
        offsets = made.create_group(group)
        for name in getattr(steps[0], kind):
            offsets[name] = index * size
