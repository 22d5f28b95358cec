# SPDX-License-Identifier: GPL-3.0-or-later
"""glTF 2.0 in one binary file (.glb): plies coloured by shear angle, tools in grey.

glTF has metres and y upwards: x, y, z in mm here are x, z, -y over 1000 there. Each ply has its
shear angle, thickness and fibre directions as attributes of its own, which begin with _ there; a
viewer that does not know them shows the colours.
"""

import json
import struct

import numpy as np

from exchange.layup import safe_names
from exchange.shell_mesh import triangle_normals, unit
from exchange.states import Body, State

FLOAT, UNSIGNED_INT = 5126, 5125        # component types
ARRAY_BUFFER, ELEMENT_ARRAY = 34962, 34963
SCALE_DEG = 60.0                        # of shear: the end of the colours
# viridis at equal steps: dark violet, blue, green, yellow
COLOURS = np.array([(0.267, 0.005, 0.329), (0.231, 0.318, 0.545), (0.129, 0.567, 0.551),
                    (0.361, 0.785, 0.388), (0.993, 0.906, 0.144)])


def glb_of(state: State) -> bytes:
    document = {"asset": {"version": "2.0", "generator": "plyform"}, "scene": 0,
                "scenes": [{"nodes": list(range(len(state.bodies)))}], "nodes": [], "meshes": [],
                "accessors": [], "bufferViews": [],
                "materials": [material("ply", (1.0, 1.0, 1.0)), material("tool", (0.6, 0.6, 0.6))],
                "extras": {"stroke_mm": state.stroke_mm, "time_s": state.time_s,
                           "colour": f"shear angle, 0 to {SCALE_DEG:g} degrees, viridis"}}
    data = bytearray()
    for number, body in enumerate(state.bodies):
        attributes = {name: add(document, data, values.astype("<f4"), ARRAY_BUFFER)
                      for name, values in attributes_of(body).items()}
        indices = add(document, data, body.triangles.astype("<u4").ravel(), ELEMENT_ARRAY)
        document["nodes"].append({"name": body.name, "mesh": number})
        document["meshes"].append({"name": body.name, "primitives": [
            {"attributes": attributes, "indices": indices, "material": int(body.tool)}]})
    document["buffers"] = [{"byteLength": len(data)}]
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    whole = 12 + 8 + len(text) + 8 + len(data)
    return (struct.pack("<4sII", b"glTF", 2, whole) + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(data), b"BIN\0") + bytes(data))


def material(name: str, colour: tuple[float, ...]) -> dict:
    return {"name": name, "doubleSided": True, "pbrMetallicRoughness": {
        "baseColorFactor": [*colour, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.8}}


def attributes_of(body: Body) -> dict[str, np.ndarray]:
    """At nodes: means of the triangles round them, by area."""
    normals, areas = triangle_normals(body.points, body.triangles)

    def at_nodes(values):
        total = np.zeros((len(body.points), *values.shape[1:]))
        for k in range(3):
            np.add.at(total, body.triangles[:, k], (values.T * areas).T)
        return total
    found = {"POSITION": turned(body.points) / 1000.0,
             "NORMAL": turned(safe_unit(at_nodes(normals)))}
    if body.tool:
        return found
    weight = np.maximum(at_nodes(np.ones(len(areas))), 1e-300)
    shear = at_nodes(body.cells["shear_angle_deg"]) / weight
    found["COLOR_0"] = colours(np.abs(shear))
    found["_SHEAR_ANGLE_DEG"] = shear
    found["_THICKNESS_MM"] = at_nodes(body.cells["thickness_mm"]) / weight
    yarns = [name for name, values in body.cells.items() if values.ndim == 2]
    for name, safe in zip(yarns, safe_names(yarns)):
        found["_" + safe.upper()] = turned(safe_unit(at_nodes(body.cells[name])))
    return found


def turned(vectors: np.ndarray) -> np.ndarray:
    return np.column_stack([vectors[:, 0], vectors[:, 2], -vectors[:, 1]])


def safe_unit(vectors: np.ndarray) -> np.ndarray:
    """Unit vectors in single precision too; z where there is none, as glTF asks for one."""
    made = unit(vectors)
    made[np.linalg.norm(vectors, axis=1) < 1e-12] = (0.0, 0.0, 1.0)
    return made


def colours(shear_deg: np.ndarray) -> np.ndarray:
    at = np.clip(shear_deg / SCALE_DEG, 0, 1) * (len(COLOURS) - 1)
    rgb = [np.interp(at, np.arange(len(COLOURS)), COLOURS[:, k]) for k in range(3)]
    return np.column_stack(rgb) ** 2.2  # glTF's colours are linear


def add(document: dict, data: bytearray, values: np.ndarray, target: int) -> int:
    """Puts an array into the buffer; the number of its accessor."""
    data += b"\0" * (-len(data) % 4)
    document["bufferViews"].append({"buffer": 0, "byteOffset": len(data),
                                    "byteLength": values.nbytes, "target": target})
    data += values.tobytes()
    kind = "SCALAR" if values.ndim == 1 else f"VEC{values.shape[1]}"
    accessor = {"bufferView": len(document["bufferViews"]) - 1, "count": len(values), "type": kind,
                "componentType": FLOAT if target == ARRAY_BUFFER else UNSIGNED_INT}
    if target == ARRAY_BUFFER and kind == "VEC3":
        accessor["min"], accessor["max"] = (values.min(axis=0).tolist(),
                                            values.max(axis=0).tolist())
    document["accessors"].append(accessor)
    return len(document["accessors"]) - 1
