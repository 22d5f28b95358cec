# SPDX-License-Identifier: GPL-3.0-or-later
"""The room that a stack needs between two tools: of a case, or by place as a run left its plies. Lengths
in mm."""

from pathlib import Path

import numpy as np

from base.files import read_toml
from exchange.cad_sheet import Room
from exchange.formed import FormedPly, read_formed
from exchange.offset_crossings import at, closest
from exchange.shell_mesh import triangle_normals
from plotting.reading import Trouble

NEAR = 5.0  # thicknesses of the stack: most points of a tool are nearer to a ply


def same_room(value: float, words: str) -> Room:
    return Room(lambda x: np.full(len(x), value), value, value, words)


def room_of_case(case: Path, factor: float, shear: float) -> Room:
    """The plies' thicknesses before forming, times the factor, sheared by so many degrees: a ply keeps
    its volume, its area goes with the cosine. Raises Trouble."""
    path = case / "case.toml" if case.is_dir() else case
    plies = plies_of(path, read_toml(path))
    total = sum(plies)
    value = factor * total / float(np.cos(np.radians(shear)))
    words = f"{len(plies)} plies of {path}, {total:.6g} mm in all" if len(plies) > 1 else \
        f"1 ply of {path}, {total:.6g} mm"
    words += f", sheared by {shear:g} degrees" if shear else ""
    words += f", times {factor:g}" if factor != 1 else ""
    return same_room(value, words)


def plies_of(path: Path, case: dict) -> list[float]:
    """Thicknesses. What else may be wrong with a case is told by plyform check. Raises Trouble."""
    fabrics, plies = case.get("fabrics"), case.get("ply")
    if not isinstance(fabrics, dict) or not isinstance(plies, list) or not plies:
        raise Trouble(f"{path} is no case with fabrics and plies: plyform check says what is missing; or "
                      "give --offset in mm")
    found = []
    for number, ply in enumerate(plies, 1):
        name = ply.get("fabric") if isinstance(ply, dict) else None
        fabric = fabrics.get(name) if isinstance(name, str) else None
        if isinstance(fabric, str):
            fabric = read_toml(path.parent / fabric)
        thickness = fabric.get("thickness") if isinstance(fabric, dict) else None
        if isinstance(thickness, bool) or not isinstance(thickness, (int, float)) or \
                not 1e-4 <= thickness <= 100:
            raise Trouble(f"{path}: the thickness of ply {number} is not known (fabric {name}): plyform "
                          "check says what is wrong; or give --offset in mm")
        found.append(float(thickness))
    return found


def room_of_run(folder: Path, factor: float) -> Room:
    """By place: the sum of the plies' thicknesses, each where it is closest; beyond their edges as there.
    Raises Trouble."""
    stack = read_formed(folder)
    plies = [(ply.x, ply.triangles, node_thickness(ply)) for ply in stack.plies]
    total = sum(float(value.max()) for _, _, value in plies)

    def room(x: np.ndarray) -> np.ndarray:
        found = np.zeros(len(x))
        for nodes, triangles, value in plies:
            hit, weights, _ = closest(nodes, triangles, x, NEAR * total)
            found += at(value, triangles[hit], weights)
        return factor * found
    words = f"the thickness of {len(plies)} {'plies' if len(plies) > 1 else 'ply'} of {folder} by place"
    least = sum(float(value.min()) for _, _, value in plies)
    return Room(room, factor * least, factor * total,
                words + (f", times {factor:g}" if factor != 1 else ""))


def node_thickness(ply: FormedPly) -> np.ndarray:
    """Mean of the triangles round each node, by their areas."""
    area = triangle_normals(ply.x, ply.triangles)[1]
    weight, value = np.zeros(len(ply.x)), np.zeros(len(ply.x))
    np.add.at(weight, ply.triangles.ravel(), np.repeat(area, 3))
    np.add.at(value, ply.triangles.ravel(), np.repeat(area * ply.thickness, 3))
    return value / np.maximum(weight, 1e-300)
