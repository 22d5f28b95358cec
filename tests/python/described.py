# SPDX-License-Identifier: GPL-3.0-or-later
"""Descriptions of made-up columns and numbers, as plyform writes them into results.h5."""

import h5py
import numpy as np


def texts(words, length=None):
    longest = max((len(word.encode()) for word in words), default=1)
    kind = h5py.string_dtype("utf-8", length or longest)
    return np.array([word.encode() for word in words], dtype=kind)


def text(word):
    return np.array(word.encode(), dtype=h5py.string_dtype("utf-8", len(word.encode())))


def put(group, name, values, place, unit, scale="from zero", quantity=""):
    """A dataset with its attributes."""
    word = name
    for end in ("_angle_deg", "_deg", "_mm", "_N"):
        word = word.removesuffix(end)
    word = word.replace("_", "-")
    group[name] = values
    attributes = group[name].attrs
    for key, value in (("word", word), ("label", word.replace("-", " ")), ("unit", unit),
                       ("place", place), ("scale", scale), ("quantity", quantity)):
        if value:
            attributes[key] = text(value)
    attributes["digits"], attributes["precision"] = 3, 1e-6


def put_columns(ply, columns, pressure=None):
    """Columns by name: all that are there."""
    if pressure is not None:
        put(ply, "contact_pressure", pressure, "node", "N/mm²")
    for name, values in columns.items():
        if np.ndim(values) == 2:
            put(ply, name, values, "triangle", "1", "both ways", "direction")
        elif name.endswith("_strain"):
            put(ply, name, values, "triangle", "1", "both ways", "strain")
        elif name.endswith("_tension_N"):
            put(ply, name, values, "triangle", "N per yarn", quantity="tension")
        elif name == "shear_angle_deg":
            put(ply, name, values, "triangle", "deg", "magnitude", "shear")
        else:
            put(ply, name, values, "triangle", "mm", "whole")


def put_ply(fixed, columns, families=("warp", "weft")):
    """Attributes of a ply; `columns`: names in order."""
    fixed.attrs["angle_deg"] = 0.0
    fixed.attrs["family_angles_deg"] = 180.0 / max(len(families), 2) * np.arange(len(families))
    fixed.attrs["families"], fixed.attrs["further_crossings"] = texts(families), texts([])
    fixed.attrs["columns"] = texts(columns)


def put_numbers(group, numbers, place):
    """Numbers of each state: name -> (values, unit)."""
    for name, (values, unit) in numbers.items():
        put(group, name, values, place, unit)
    group.attrs["numbers"] = texts(list(numbers))
