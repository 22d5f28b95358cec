# SPDX-License-Identifier: GPL-3.0-or-later
"""What codes for infusion and permeability begin with, as CSV: infusion_layers.csv, a row for each element
and layer, and infusion.csv, a row for each element with what its layers come to."""

from dataclasses import dataclass

import numpy as np

from exchange.layup import Layup
from exchange.mapping import MappedPly
from exchange.shell_mesh import centroids, element_normals

LAYERS = ["element", "layer", "ply", "thickness_mm", "fibre_volume", "areal_weight_g_m2",
          "warp_angle_deg", "weft_angle_deg", "shear_angle_deg", "covered_share"]
ELEMENTS = ["element", "x_mm", "y_mm", "z_mm", "area_mm2", "layers", "thickness_mm", "fibre_volume",
            "areal_weight_g_m2", "gap_mm", "gap_left_mm", "fibre_volume_in_gap"]
OF_LAYERS = [
    "a row for each element and layer; layer 1 is the first along the element's normal; an element without "
    "plies has no row",
    "fibre_volume: of the layer by itself; areal_weight_g_m2 = 1000 fibre_volume x density of the fibres in "
    "g/cm3 x thickness_mm",
    "warp and weft: the two directions of yarns of a woven layer; of a layer of one family its fibres and the "
    "line across them",
    "shear_angle_deg: what warp and weft have come nearer to each other than they were"]
OF_ELEMENTS = [
    "a row for each element; x, y, z: its middle; infusion_layers.csv has its layers one by one",
    "thickness_mm, areal_weight_g_m2: sums over the layers; fibre_volume: volume of all fibres over that thickness",
    "gap_mm: between the tools of the closed mould there; gap_left_mm: of it what the layers do not fill, a "
    "channel for the resin; fibre_volume_in_gap: volume of all fibres over the gap",
    "empty: not known"]


@dataclass
class StackValues:
    """Of the layers of m elements; NaN where it is not known."""
    layers: np.ndarray        # m
    thickness: np.ndarray     # m, mm
    areal_weight: np.ndarray  # m, g/m2
    fibres: np.ndarray        # m, mm: thickness of the fibres alone
    gap: np.ndarray           # m, mm


def fibre_thickness(ply: MappedPly) -> np.ndarray:
    """m, mm: what the layer's fibres would have without anything between them."""
    volume = ply.fibre_volume()
    return np.full(len(ply.thickness), np.nan) if volume is None else volume * ply.thickness


def weight_of(ply: MappedPly) -> np.ndarray:
    return np.full(len(ply.thickness), np.nan) if ply.areal_weight is None else ply.areal_weight


def stack_values(layup: Layup) -> StackValues:
    count = len(layup.mesh.corners)
    there = np.array([ply.covered() for ply in layup.plies]).reshape(-1, count)

    def total(values):
        return np.where(there, np.array(values).reshape(-1, count), 0.0).sum(axis=0)
    gaps = np.array([ply.gap for ply in layup.plies if ply.gap is not None]).reshape(-1, count)
    known = np.isfinite(gaps)
    part = known.sum(axis=0)
    gap = np.where(part > 0, np.where(known, gaps, 0.0).sum(axis=0) / np.maximum(part, 1), np.nan)
    bare = np.where(there.any(axis=0), 1.0, np.nan)
    return StackValues(there.sum(axis=0), total([ply.thickness for ply in layup.plies]),
                       total([weight_of(ply) for ply in layup.plies]) * bare,
                       total([fibre_thickness(ply) for ply in layup.plies]) * bare, gap)


def text_of(value: float) -> str:
    return f"{value:.9g}" if np.isfinite(value) else ""


def layer_lines(layup: Layup) -> list[str]:
    tables, names = [], [ply.name for ply in layup.plies]
    columns = [(ply.thickness, fibre_thickness(ply) / ply.thickness, weight_of(ply),
                *layup.angles(ply), ply.shear_deg, ply.share) for ply in layup.plies]
    for plies, rows in layup.sequences().items():
        for layer, k in enumerate(plies, 1):
            tables.append(np.column_stack([rows, np.full(len(rows), layer), np.full(len(rows), k),
                                           *(values[rows] for values in columns[k])]))
    if not tables:
        return []
    table = np.vstack(tables)
    table = table[np.lexsort((table[:, 1], table[:, 0]))]
    labels = layup.mesh.labels
    return [f"{labels[int(row)]},{int(layer)},{names[int(k)]}," + ",".join(map(text_of, values))
            for row, layer, k, *values in table.tolist()]


def element_lines(layup: Layup) -> list[str]:
    mesh, stack = layup.mesh, stack_values(layup)
    some = stack.layers > 0
    thick = np.where(some, stack.thickness, np.nan)
    values = np.column_stack([stack.thickness, stack.fibres / thick, stack.areal_weight, stack.gap,
                              stack.gap - thick, stack.fibres / stack.gap])
    places = np.column_stack([centroids(mesh), element_normals(mesh)[1]])
    return [f"{label}," + ",".join(map(text_of, place)) + f",{layers}," + ",".join(map(text_of, row))
            for label, place, layers, row in zip(mesh.labels, places.tolist(), stack.layers, values.tolist())]


def unknown(layup: Layup) -> list[str]:
    """What is left empty, and what would fill it."""
    names = [ply.name for ply in layup.plies if ply.fibre_volume() is None]
    if not names:
        return []
    return [f"infusion: fibre volume of {', '.join(names)} is not known: its fabric needs fibre_density"]


def infusion_files(layup: Layup) -> dict[str, str]:
    """Name of each file, without its folder, and its text."""
    notes = unknown(layup)
    layup.remarks += notes
    prefix = layup.plies[0].name + "_" if layup.own else ""
    files = {}
    for name, words, columns, lines in (
            ("infusion_layers", OF_LAYERS, LAYERS, layer_lines), ("infusion", OF_ELEMENTS, ELEMENTS, element_lines)):
        head = ["# " + line for line in layup.head([*words, *notes])]
        files[f"{prefix}{name}.csv"] = "\n".join([*head, ",".join(columns), *lines(layup)]) + "\n"
    return files
