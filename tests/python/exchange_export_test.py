# SPDX-License-Identifier: GPL-3.0-or-later
"""States in other formats, opened by VTK: VTKHDF, glTF, VTU and STL, of any state and of all.

    exchange_export_test.py TOOLS PROGRAM CASES

Leaves with 77 when numpy, h5py or a reader of VTK is missing.
"""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import h5py
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOGeometry import vtkGLTFReader, vtkSTLReader
    from vtkmodules.vtkIOHDF import vtkHDFReader
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError as error:
    print("SKIPPED:", error)
    sys.exit(77)

PROGRAM, CASES = (Path(argument).resolve() for argument in sys.argv[2:4])
PLIES, TOOLS = ("ply1", "ply2"), ("punch", "die", "blank_holder")


def call(*words, code=0):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)
    assert done.returncode == code, done
    return done


def opened(reader, path):
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def check_grid(grid, file, frame, name):
    """Points and every field of the state, to the bit."""
    ply = file[f"frames/{frame:06}/plies/{name}"]
    assert np.array_equal(vtk_to_numpy(grid.GetPoints().GetData()), ply["x"][:])
    ends = [[grid.GetCell(k).GetPointId(j) for j in range(3)]
            for k in range(grid.GetNumberOfCells())]
    assert np.array_equal(ends, file[f"plies/{name}/triangles"][:])
    for field in ("warp", "weft", "shear_angle_deg", "thickness_mm", "warp_strain", "weft_strain",
                  "warp_tension_N", "weft_tension_N"):
        assert np.array_equal(vtk_to_numpy(grid.GetCellData().GetArray(field)), ply[field][:]), field
    pressure = vtk_to_numpy(grid.GetPointData().GetArray("contact_pressure"))
    assert np.array_equal(pressure, ply["contact_pressure"][:])


def check_vtkhdf(folder, file, frame, ending):
    for name in PLIES:
        check_grid(opened(vtkHDFReader(), folder / f"{name}{ending}.vtkhdf"), file, frame, name)
    for name in TOOLS:
        grid = opened(vtkHDFReader(), folder / f"{name}{ending}.vtkhdf")
        assert np.allclose(vtk_to_numpy(grid.GetPoints().GetData()), tool_at(file, frame, name))


def tool_at(file, frame, name):
    shift = file[f"frames/{frame:06}/tools/{name}"].attrs["displacement_mm"]
    return file[f"tools/{name}/x0"][:] + shift


def check_gltf(path, file, frame):
    """By VTK: nodes of all bodies in metres with y up, and the plies' attributes at nodes."""
    blocks = opened(vtkGLTFReader(), path)
    assert blocks.GetNumberOfBlocks() == len(PLIES) + len(TOOLS)
    for number, name in enumerate((*PLIES, *TOOLS)):
        mesh = blocks.GetBlock(number).GetBlock(0).GetBlock(0)
        found = vtk_to_numpy(mesh.GetPoints().GetData())
        if name in TOOLS:
            x = tool_at(file, frame, name)
        else:
            x = file[f"frames/{frame:06}/plies/{name}/x"][:]
        wanted = np.column_stack([x[:, 0], x[:, 2], -x[:, 1]]) / 1000.0
        assert np.abs(found - wanted).max() < 1e-7
        if name in TOOLS:
            continue
        ply, triangles = file[f"frames/{frame:06}/plies/{name}"], file[f"plies/{name}/triangles"][:]
        shear, thickness = (vtk_to_numpy(mesh.GetPointData().GetArray(field))
                            for field in ("_SHEAR_ANGLE_DEG", "_THICKNESS_MM"))
        node = len(x) // 2
        round_it = (triangles == node).any(axis=1)
        a, b, c = (x[triangles[round_it, k]] for k in range(3))
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        for found, field in ((shear, "shear_angle_deg"), (thickness, "thickness_mm")):
            mean = np.average(ply[field][:][round_it], weights=area)
            assert abs(found[node] - mean) < 1e-5, (field, found[node], mean)
        assert mesh.GetPointData().GetArray("COLOR_0").GetNumberOfTuples() == len(x)


def check_steps(folder, file):
    """All states in one file, by the paths that VTK publishes: Debian's VTK reads no time."""
    for name in PLIES:
        with h5py.File(folder / f"{name}_all.vtkhdf") as all_states:
            root = all_states["VTKHDF"]
            steps, times = root["Steps"], file["time_s"][:]
            assert list(root.attrs["Version"]) == [2, 0] and steps.attrs["NSteps"] == len(times)
            assert np.array_equal(steps["Values"][:], times)
            for frame in range(len(times)):
                ply = file[f"frames/{frame:06}/plies/{name}"]
                part = steps["PartOffsets"][frame]
                at, count = steps["PointOffsets"][frame], root["NumberOfPoints"][part]
                assert np.array_equal(root["Points"][at:at + count], ply["x"][:])
                at = steps["CellDataOffsets/shear_angle_deg"][frame]
                count = root["NumberOfCells"][part]
                assert np.array_equal(root["CellData/shear_angle_deg"][at:at + count],
                                      ply["shear_angle_deg"][:])
            cells = root["Connectivity"][:root["NumberOfConnectivityIds"][0]].reshape(-1, 3)
            assert np.array_equal(cells, file[f"plies/{name}/triangles"][:])


def table(path):
    with open(path, newline="", encoding="utf-8") as rows:
        rows = list(csv.DictReader(rows))
    return np.array([float(row["shear_angle_deg"]) for row in rows])


def check_states(results, file):
    """VTU, STL and CSV of a state that is not the last."""
    folder = results / "export"
    done = call("export", results, "--frame", 1, "--format", "vtu,stl,csv,gltf,vtkhdf")
    written = [Path(line) for line in done.stdout.splitlines()]
    assert len(written) == len(set(written)) == 2 * 4 + 3 * 2 + 1, done.stdout
    assert all(path.is_file() for path in written)
    for name in PLIES:
        check_grid(opened(vtkXMLUnstructuredGridReader(), folder / f"{name}_000001.vtu"), file, 1, name)
        mesh = opened(vtkSTLReader(), folder / f"{name}_000001.stl")
        x = file[f"frames/000001/plies/{name}/x"][:]
        assert np.allclose(mesh.GetBounds()[::2], x.min(axis=0), atol=1e-4)
        wanted = file[f"frames/000001/plies/{name}/shear_angle_deg"][:]
        assert np.allclose(table(folder / f"{name}_000001.csv"), wanted, atol=1e-6)
    punch = opened(vtkSTLReader(), folder / "punch_000001.stl")
    assert np.allclose(punch.GetBounds()[::2], tool_at(file, 1, "punch").min(axis=0), atol=1e-4)
    check_vtkhdf(folder, file, 1, "_000001")
    check_gltf(folder / "state_000001.glb", file, 1)


def check_all(results, file):
    folder = results / "export"
    call("export", results, "--frame", "all", "--format", "vtkhdf,gltf,vtu")
    count = len(file["time_s"])
    for frame in range(count):
        check_vtkhdf(folder, file, frame, f"_{frame:06}")
        check_gltf(folder / f"state_{frame:06}.glb", file, frame)
        grid = opened(vtkXMLUnstructuredGridReader(), folder / f"ply2_{frame:06}.vtu")
        check_grid(grid, file, frame, "ply2")
    assert not (folder / f"ply1_{count:06}.vtu").exists()
    check_steps(folder, file)


def check_last(results, file):
    """Without --frame: the last, in files without its number."""
    call("export", results, "--format", "gltf,vtkhdf")
    last = len(file["time_s"]) - 1
    check_vtkhdf(results / "export", file, last, "")
    check_gltf(results / "export" / "state.glb", file, last)
    call("export", results, "--frame=-1", "--format", "csv")
    assert (results / "export" / f"ply1_{last:06}.csv").is_file()


def check_wrong(results):
    for words, told, code in ((("--frame", "9"), "has no frame 9, but 3 from 0", 1),
                              (("--frame=-9",), "--frame -9: a number from 0", 2),
                              (("--frame", "two"), "--frame two: a number from 0", 2),
                              (("--frame", "9", "--format", "gltf"), "has no frame 9", 2),
                              (("--format", "obj"), "--format", 2)):
        done = call("export", results, *words, code=code)
        assert told in done.stderr, done


def main():
    with tempfile.TemporaryDirectory() as name:
        results = Path(name) / "run"
        call("run", CASES / "hemisphere_two_ply", "--set",
             "blanks.square.mesh_from=element_size", "--set", "blanks.square.element_size=34", "--set",
             "solver.duration=0.02", "--set", "solver.outputs=2", "--threads", "1", "-o", results)
        with h5py.File(results / "results.h5") as file:
            check_states(results, file)
            check_all(results, file)
            check_last(results, file)
        check_wrong(results)


if __name__ == "__main__":
    main()
