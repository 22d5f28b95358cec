# SPDX-License-Identifier: GPL-3.0-or-later
"""HDF5 Composite CAE 1.0, as far as its specification could be read (docs/users/exchange.md says
how far): a mesh, a material and a component a ply, whose data_map has angles and thickness an
element."""

from pathlib import Path

import h5py
import numpy as np

from exchange.layup import Layup, safe_names
from exchange.shell_mesh import ShellMesh


def write_composite_cae(layup: Layup, path: Path) -> None:
    """Each component has a mesh of the elements that its ply covers."""
    names = safe_names([ply.name for ply in layup.plies])
    base, normals = layup.base.directions, layup.normals
    with h5py.File(path, "w", track_order=True) as file:
        root = file.create_group("composite_cae")
        for name, value in (("format_version", "1.0"), ("vendor", "plyform"), ("unit_system", "SI"),
                            ("length_unit", "mm")):
            root.attrs[name] = text(value)
        root.attrs["comment"] = text("; ".join(layup.head()))
        meshes, materials, components = (root.create_group(name) for name in
                                         ("meshes", "materials", "components"))
        for layer, (ply, name) in enumerate(zip(layup.plies, names), 1):
            rows = np.flatnonzero(ply.covered())
            mesh = add_mesh(meshes.create_group("mesh_" + name), layup.mesh, rows, ply.name)
            material = materials.create_group("material_" + name)
            material.attrs["TITLE"] = text(ply.name)
            part = components.create_group(name)
            part.attrs["TITLE"] = text(ply.name)
            part.attrs["layer_id"] = np.array([layer])
            part.attrs["orientation"] = np.array([ply.nominal_angle_deg])
            part["mesh"] = h5py.SoftLink(mesh.name)
            part["material"] = h5py.SoftLink(material.name)
            warp, weft = layup.angles(ply)
            data = part.create_group("data_map")
            data["matorient_0_angles"], data["matorient_1_angles"] = warp[rows], weft[rows]
            data["thicknesses"] = ply.thickness[rows]
            data["refdirs"], data["normals"] = base[rows], normals[rows]


def text(value: str) -> np.bytes_:
    return np.bytes_(value.encode("utf-8"))


def add_mesh(group: h5py.Group, mesh: ShellMesh, rows: np.ndarray, title: str) -> h5py.Group:
    """element_nodes counts nodes from 0; triangles have -1 as their fourth where the mesh has
    quadrilaterals too. element_labels are the part mesh's own numbers."""
    corners = mesh.corners[rows]
    used = np.unique(corners[corners >= 0])
    row = np.full(len(mesh.nodes) + 1, -1)
    row[used] = np.arange(len(used))
    corners = row[corners]
    group.attrs["TITLE"] = text(title)
    group["nodes"] = mesh.nodes[used]
    group["element_nodes"] = corners[:, :3] if (corners[:, 3] < 0).all() else corners
    group["element_labels"] = mesh.labels[rows]
    return group
