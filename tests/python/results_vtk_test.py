# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens a result folder as users do and compares every number with plies/NAME.csv.

    results_vtk_test.py hdf5|export|xdmf DIR

hdf5    results.h5 with h5py, and every dataset that results.xdmf points to
export  export/*.vtu and *.stl with VTK
xdmf    results.xdmf with the XDMF 2 and XDMF 3 readers of VTK or ParaView

DIR holds the run written by make_results. Leaves with 77 when the module for a part is missing.
"""

import csv
import importlib
import json
import re
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

import numpy as np

SOURCE = Path(__file__).resolve().parents[2]
SCALARS = ["shear_angle_deg", "warp_strain", "weft_strain", "warp_tension_N", "weft_tension_N",
           "thickness_mm"]
VECTORS = ["warp", "weft"]
PRESSURE = "contact_pressure"
REACTION = "reaction_N"  # only of the second ply
PARTS = ["lower", "90° ply & co", "punch", "die"]
TOOLS = {"punch": -50.0, "die": 0.0}  # mm that each moves along z in the example
# The tables hold nine digits: half a unit of the ninth is at most 5e-9 of the value.
DIGITS = 6e-9


def skip(reason):
    print("SKIPPED:", reason)
    sys.exit(77)


def load(module, package):
    try:
        return importlib.import_module(module)
    except ImportError as error:
        skip(f"{module} is missing ({error}): install {package}")


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def tables(folder):
    found = {path.stem: table(path) for path in sorted((folder / "plies").glob("*.csv"))}
    assert len(found) == 2, f"the example has two plies, plies/ holds {list(found)}"
    return found


def equal(found, wanted, what):
    """Fails on NaN too: the example has none."""
    found, wanted = np.asarray(found, float), np.asarray(wanted, float)
    assert found.shape == wanted.shape, f"{what}: shape {found.shape}, not {wanted.shape}"
    # atol for numbers that are 0 but for rounding, like a centroid's third coordinate
    close = np.isclose(found, wanted, rtol=DIGITS, atol=1e-12)
    assert close.all(), f"{what}: {found[~close][:3]} in place of {wanted[~close][:3]}"


def check_ply(name, ply, points, triangles, cell, node, fields):
    """`ply` is the CSV's columns; `cell` and `node` give a field by its name; `fields`: all names
    there are."""
    centres = points[triangles].mean(axis=1)
    equal(centres, np.column_stack([ply["x"], ply["y"], ply["z"]]), f"{name}: positions")
    for field in SCALARS:
        equal(cell(field), ply[field], f"{name}: {field}")
    for field in VECTORS:
        columns = [ply[f"{field}_{axis}"] for axis in "xyz"]
        equal(cell(field), np.column_stack(columns), f"{name}: {field}")
    index = 0 if name == "lower" else 1  # the example's formula at time 1 s
    equal(node(PRESSURE), 0.001 * np.arange(len(points)) + index, f"{name}: {PRESSURE}")
    assert (REACTION in fields) == (name != "lower"), f"{name}: {list(fields)}"
    if name != "lower":
        wanted = [[i, 0.25, -3.0] for i in range(len(points))]
        equal(node(REACTION), wanted, f"{name}: {REACTION}")


# h5py, and results.xdmf read with nothing but an XML parser.

def check_hdf5(folder):
    h5py = load("h5py", "python3-h5py")
    with h5py.File(folder / "results.h5", "r") as file:
        assert list(file["time_s"]) == [0.0, 0.5, 1.0]
        assert list(file["stroke_mm"]) == [0.0, 25.0, 50.0]
        assert list(file["step"]) == [0, 500, 1000]
        names = {key: [name.decode() for name in file.attrs[key]]
                 for key in ("plies", "tools", "boundaries")}
        assert file.attrs["format_version"] == 3
        version = re.search(r"project\(plyform VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text())
        assert file.attrs["plyform_version"].decode() == version[1]
        assert set(names["plies"]) == set(tables(folder)), names
        assert names["tools"] == list(TOOLS)
        assert not any("x" in file[f"frames/000002/tools/{tool}"] for tool in TOOLS)
        last = file["frames/000002"]
        assert last.attrs["time_s"] == 1.0
        assert last["tools/punch"].attrs["force_N"] == 400.0
        assert list(last["tools/punch"].attrs["displacement_mm"]) == [0, 0, -50]
        assert names["boundaries"] == ["grip", "clamp"]
        grip = last["boundaries/grip"].attrs
        assert (grip["force_N"], grip["stroke_mm"]) == (70.0, 8.0)
        assert list(grip["force_vector_N"]) == [70.0, -7.0, 0.5]
        for name, ply in tables(folder).items():
            fixed, now = file["plies"][name], last["plies"][name]
            check_ply(name, ply, now["x"][:], fixed["triangles"][:], lambda f: now[f][:],
                      lambda f: now[f][:], now.keys())
            before = fixed["x0"][:][fixed["triangles"][:]].mean(axis=1)
            equal(before, np.column_stack([ply["x0"], ply["y0"], ply["z0"]]), f"{name}: x0")
        check_descriptions(folder, file)
        check_xdmf_references(folder, file)
    check_summary(folder)


def check_descriptions(folder, file):
    """Every column and number says what it is, and history.csv has the numbers of /history."""
    def unit_of(data, place):
        told = data.attrs
        assert told["place"].decode() == place and told["label"] and told["word"], data.name
        assert told["digits"] >= 0 and told["precision"] > 0.0, data.name
        assert told["scale"].decode() in ("from zero", "whole", "both ways", "magnitude"), data.name
        return told["unit"].decode()

    for name in file["plies"]:
        fixed, now = file["plies"][name], file["frames/000002/plies"][name]
        assert [one.decode() for one in fixed.attrs["families"]] == ["warp", "weft"]
        assert {one.decode() for one in fixed.attrs["columns"]} == set(now) - {"x"}
        for column, data in ((column, data) for column, data in now.items() if column != "x"):
            unit = unit_of(data, "node" if column in (PRESSURE, REACTION) else "triangle")
            ends = {"_deg": "deg", "_mm": "mm", "on_N": "N per yarn" if "tension" in column else "N"}
            wanted = [unit for end, unit in ends.items() if column.endswith(end)]
            assert not wanted or unit == wanted[0], (column, unit)
        assert abs(file[f"history/plies/{name}/rms_shear_deg"][0]) == 0.0
        unit_of(file[f"history/plies/{name}/draw_in_mm"], "ply")
    history = table(folder / "history.csv")
    for heading, values in history.items():
        paths = [heading, f"history/energies/{heading}"]
        for bodies in ("tools", "boundaries"):
            paths += [f"history/{bodies}/{name}/{heading[len(name) + 1:]}"
                      for name in file[f"history/{bodies}"] if heading.startswith(f"{name}_")]
        found = [file[path] for path in paths if path in file]
        assert len(found) == 1, heading
        equal(found[0][:], values, heading)
        unit_of(found[0], {"tools": "tool", "boundaries": "boundary"}.get(
            found[0].name.split("/")[2] if found[0].name.count("/") > 2 else "", "run"))


def check_xdmf_references(folder, file):
    items = list(xml.parse(folder / "results.xdmf").getroot().iter("DataItem"))
    items = [item for item in items if item.get("Format") == "HDF"]
    # 3 times x (2 plies x 11 arrays + the reactions of one + 2 tools x 2 arrays), and of the punch,
    # where it has moved, x0 three times
    assert len(items) == 81 + 2 * 2, len(items)
    for item in items:
        name, where = item.text.split(":", 1)
        assert name == "results.h5"
        data = file[where]
        assert data.shape == tuple(map(int, item.get("Dimensions").split())), where
        assert data.dtype.itemsize == int(item.get("Precision")), where
        assert data.dtype.kind == {"Float": "f", "Int": "i"}[item.get("NumberType")], where


def check_summary(folder):
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    assert summary["boundaries"] == [
        {"name": "grip", "force_N": 70, "displacement_mm": 8},
        {"name": "clamp", "force_N": -9, "displacement_mm": 0}]
    assert {ply["name"] for ply in summary["plies"]} == set(tables(folder))
    for entry in summary["plies"]:
        ply = tables(folder)[entry["name"]]
        equal(entry["max_shear_deg"], np.abs(ply["shear_angle_deg"]).max(), "max_shear_deg")
        # all triangles of the example are of one size
        equal(entry["rms_shear_deg"], np.sqrt((ply["shear_angle_deg"]**2).mean()), "rms_shear_deg")


# VTK.

def arrays(data):
    return lambda name: as_numpy(data.GetArray(name), name)


def as_numpy(array, name):
    assert array is not None, f"no field {name}"
    return importlib.import_module("vtkmodules.util.numpy_support").vtk_to_numpy(array)


def triangles_of(grid):
    numbers = [[grid.GetCell(i).GetPointId(k) for k in range(3)]
               for i in range(grid.GetNumberOfCells())]
    return np.array(numbers, dtype=int)


def check_grid(name, ply, grid):
    check_ply(name, ply, as_numpy(grid.GetPoints().GetData(), "points"), triangles_of(grid),
              arrays(grid.GetCellData()), arrays(grid.GetPointData()),
              [grid.GetPointData().GetArrayName(i)
               for i in range(grid.GetPointData().GetNumberOfArrays())])


def check_export(folder):
    vtu = load("vtkmodules.vtkIOXML", "python3-vtk9 or python3-paraview")
    geometry = load("vtkmodules.vtkIOGeometry", "python3-vtk9 or python3-paraview")
    for name, ply in tables(folder).items():
        reader = vtu.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(folder / "export" / f"{name}.vtu"))
        reader.Update()
        check_grid(name, ply, reader.GetOutput())
        exported = folder / "export" / f"{name}.csv"
        assert exported.read_bytes() == (folder / "plies" / f"{name}.csv").read_bytes()
    for name, triangles in {**{n: len(t["x"]) for n, t in tables(folder).items()},
                            "punch": 8, "die": 2}.items():
        reader = geometry.vtkSTLReader()
        reader.SetFileName(str(folder / "export" / f"{name}.stl"))
        reader.Update()
        assert reader.GetOutput().GetNumberOfCells() == triangles, name


def check_xdmf(folder):
    """Each reader there is; both must be right. That for XDMF 3 loses the names of the blocks: there
    they are known by their order, plies before tools."""
    tried = 0
    for version, module in (("vtkXdmfReader", "vtkIOXdmf2"), ("vtkXdmf3Reader", "vtkIOXdmf3")):
        try:
            make = getattr(importlib.import_module("vtkmodules." + module), version)
        except ImportError as error:
            print(f"{version} is not there: {error}")
            continue
        named = version == "vtkXdmfReader"
        check_time_series(folder, make(), named)
        check_single_block(folder, make(), named)
        print(f"{version}: all blocks, times and fields are right")
        tried += 1
    if not tried:
        skip("this VTK has no XDMF reader: install python3-paraview in place of python3-vtk9")


def check_time_series(folder, reader, named):
    pipeline = importlib.import_module("vtkmodules.vtkCommonExecutionModel")
    reader.SetFileName(str(folder / "results.xdmf"))
    reader.UpdateInformation()
    key = pipeline.vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    times = reader.GetOutputInformation(0).Get(key)
    assert times == (0.0, 0.5, 1.0), times
    for time in (1.0, 0.0, 0.5, 1.0):  # also backwards
        reader.UpdateTimeStep(time)
        blocks = blocks_by_name(reader.GetOutputDataObject(0), named, PARTS)
        for name, speed in TOOLS.items():
            moved = speed * time != 0.0
            points = as_numpy(blocks[name].GetPoints().GetData(), "points")
            if moved and not named:  # the reader of XDMF 3 knows no functions of data
                assert len(points) == 0, f"{name} at {time} s: docs/users/results.md says otherwise"
                continue
            cells = 2 if name == "punch" else 1  # as tests/support/example_results.hpp
            k = np.arange((cells + 1) ** 2)
            start = np.column_stack([10.0 * (k % (cells + 1)), 10.0 * (k // (cells + 1)),
                                     np.full(len(k), 30.0 if name == "punch" else -5.0)])
            equal(points, start + [0.0, 0.0, speed * time], f"{name} at {time} s")
        for name, ply in tables(folder).items():
            shear = arrays(blocks[name].GetCellData())("shear_angle_deg")
            equal(shear, time * ply["shear_angle_deg"], f"{name}: shear at {time} s")
    for name, ply in tables(folder).items():
        check_grid(name, ply, blocks[name])


def blocks_by_name(data, named, wanted):
    assert data.IsA("vtkMultiBlockDataSet"), data.GetClassName()
    count = data.GetNumberOfBlocks()
    assert count == len(wanted), count
    if named:
        name = importlib.import_module("vtkmodules.vtkCommonDataModel").vtkCompositeDataSet.NAME()
        names = [data.GetMetaData(i).Get(name) for i in range(count)]
        assert names == wanted, names
    return dict(zip(wanted, (data.GetBlock(i) for i in range(count))))


def check_single_block(folder, reader, named):
    """One ply and no tool is a named block like any other."""
    reader.SetFileName(str(folder / "single" / "results.xdmf"))
    reader.Update()
    block = blocks_by_name(reader.GetOutputDataObject(0), named, ["lower"])["lower"]
    assert block.GetNumberOfCells() == 18, block.GetNumberOfCells()


if __name__ == "__main__":
    {"hdf5": check_hdf5, "export": check_export, "xdmf": check_xdmf}[sys.argv[1]](Path(sys.argv[2]))
