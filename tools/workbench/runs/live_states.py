# SPDX-License-Identifier: GPL-3.0-or-later
"""States of a run for the picture that moves, also while it goes on: of results.h5, one state read at
a time, and in between what the run draws when it is asked to (docs/users/results.md, picture.bin)."""

import os
from pathlib import Path

import h5py
import numpy as np

from base.ending import Trouble
from base.files import MIB, read_bytes
from base.results_file import Broken, Results, read_results

from ..project.arrays import Arrays, unpacked
from ..project.project import Refused
from ..scene.coarser import coarser

ASK, PICTURE = "picture.ask", "picture.bin"
MOST_PICTURE = 1024 * MIB
FARTHEST = 1e9         # mm


class OneState(Results):
    """Looks only at the links of what is read: a run of many states and plies has 100 000 of them."""

    def __init__(self, path: Path, file: h5py.File):
        self.looked_at: set[tuple[str, ...]] = set()
        self.away: set[str] = set()  # groups that lie in a file of states/
        super().__init__(path, file)

    def check_links(self, group: h5py.Group, where: str, linked: bool) -> None:
        if where != "/":
            super().check_links(group, where, linked)
            return
        for name in group:
            link = group.get(name, getlink=True)
            if isinstance(link, h5py.ExternalLink):
                self.check_state_file(f"/{name}", link.filename)
                self.away.add(name)
            elif not isinstance(link, h5py.HardLink):
                raise Broken(f"/{name} is a link to elsewhere, which plyform does not write")

    def group(self, *steps: str) -> h5py.Group:
        if len(steps) == 2 and steps not in self.looked_at:
            self.looked_at.add(steps)
            self.check_link(super().group(steps[0]), steps[1], f"/{steps[0]}/", steps[0] in self.away)
        return super().group(*steps)


def bodies(folder: Path) -> bytes:
    """Header: {count, plies: [{name, key, angle_deg, families: {NAME: direction}, x, triangles}],
    tools: [{name, key, x, triangles, facets: as computed with}]}, all at time 0. Raises Trouble."""
    def read(results: Results):
        results.frame_number(0)
        return (results.count, [flat_ply(results, name) for name in results.names("plies")],
                [(name, *results.body("tools", name)) for name in results.names("tools")])
    count, plies, tools = read_results(folder, read, OneState)
    arrays = Arrays()
    return arrays.packed({
        "count": count,
        "plies": [{**about, "key": f"ply.{k}", "x": arrays.add(x), "triangles": arrays.add(triangles)}
                  for k, (about, x, triangles) in enumerate(plies)],
        "tools": [{"name": name, "key": f"tool.{k}", "facets": len(triangles),
                   **for_picture(arrays, x, triangles)}
                  for k, (name, x, triangles) in enumerate(tools)]})


def flat_ply(results: Results, name: str):
    x, triangles = results.body("plies", name)
    results.state(0)
    now = results.in_state(0, "plies", name)
    families = {family: results.numbers(now, family, triangles.shape).mean(axis=0).tolist()
                for family in results.families(name)}
    angle = results.number(results.group("plies", name), "angle_deg")
    return {"name": name, "angle_deg": angle, "families": families}, x, triangles


def for_picture(arrays: Arrays, x: np.ndarray, triangles: np.ndarray) -> dict:
    x, triangles = coarser(x, triangles)
    return {"x": arrays.add(x), "triangles": arrays.add(triangles)}


def state(folder: Path, number: int) -> bytes:
    """Header: {number, count, time_s, stroke_mm, plies: [{name, x, field}], tools: [{name, shift}]};
    field: the shear angle of each triangle, degrees. Raises Trouble, Refused."""
    def read(results: Results):
        if not -results.count <= number < results.count:
            return None
        at = results.frame_number(number)
        stroke = results.numbers(results.file, "stroke_mm", (results.count,))
        results.state(at)
        return (at, results.count, float(results.time_s[at]), float(stroke[at]),
                [ply_in(results, at, name) for name in results.names("plies")],
                [(name, results.attribute(results.in_state(at, "tools", name), "displacement_mm", (3,)))
                 for name in results.names("tools")])
    found = read_results(folder, read, OneState)
    if found is None:
        raise Refused(f"{folder.name} has no state {number}", 404)
    at, count, time_s, stroke, plies, tools = found
    arrays = Arrays()
    return arrays.packed({
        "number": at, "count": count, "time_s": time_s, "stroke_mm": stroke,
        "plies": [{"name": name, "x": arrays.add(x), "field": arrays.add(shear)} for name, x, shear in plies],
        "tools": [{"name": name, "shift": shift.tolist()} for name, shift in tools]})


def ply_in(results: Results, at: int, name: str):
    now = results.in_state(at, "plies", name)
    return (name, results.numbers(now, "x", (None, 3)).astype(np.float32),
            results.numbers(now, "shear_angle_deg", (None,)).astype(np.float32))


def picture(folder: Path, after: int) -> bytes:
    """What a run that goes on looks like now, as `state` with `step` in the place of `number`; asks
    the run for another one. Empty if it is of that step. Raises Refused."""
    ask(folder)
    path = folder / PICTURE
    if path.is_symlink() or not path.is_file():
        return b""
    try:
        content = read_bytes(path, MOST_PICTURE)
        header, arrays = unpacked(content)
        check_picture(header, arrays)
    except (Trouble, ValueError, KeyError, TypeError) as problem:
        raise Refused(f"{PICTURE} of {folder.name} cannot be read: {problem}", 422) from problem
    return content if header["step"] != after else b""


def ask(folder: Path) -> None:
    """The run that writes into this folder draws itself soon, and takes the request away."""
    try:
        os.close(os.open(folder / ASK, os.O_WRONLY | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC, 0o666))
    except OSError:
        pass  # a folder that cannot be written to: states come all the same


def check_surface(body: dict, arrays: memoryview) -> None:
    """Of a picture that has meshes of its own. Raises ValueError, KeyError, TypeError."""
    if "triangles" not in body:
        return
    places, corners = body.get("x0", body["x"]), body["triangles"]
    x = np.frombuffer(arrays, "<f4", int(places["count"]), int(places["at"]))
    triangles = np.frombuffer(arrays, "<u4", int(corners["count"]), int(corners["at"]))
    if places["type"] != "f4" or corners["type"] != "u4" or not (np.abs(x) < FARTHEST).all() \
            or (triangles >= len(x) // 3).any():
        raise ValueError("triangles without corners")


def check_picture(header: dict, arrays: memoryview) -> None:
    """Raises ValueError, KeyError, TypeError."""
    int(header["step"]), float(header["time_s"]), float(header["stroke_mm"])
    for body in (*header["plies"], *header["tools"]):
        check_surface(body, arrays)
    for tool in header["tools"]:
        if len(tool["shift"]) != 3 or not all(abs(float(part)) < FARTHEST for part in tool["shift"]):
            raise ValueError("a tool is nowhere")
    for ply in header["plies"]:
        for what in (ply["x"], ply["field"]):
            values = np.frombuffer(arrays, "<f4", int(what["count"]), int(what["at"]))
            if what["type"] != "f4" or not (np.abs(values) < FARTHEST).all():
                raise ValueError("numbers that are not finite")
