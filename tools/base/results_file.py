# SPDX-License-Identifier: GPL-3.0-or-later
"""results.h5 (layout: docs/users/results.md): opened by every Python program here. What it holds is
not trusted: it is numbers of its own, of the shapes and kinds that plyform writes, or one line."""

import re
import stat
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from base.apart import read_apart
from base.ending import Trouble
from base.files import check_file
from base.names import SEPARATORS, checked

# of a run in progress, whose states are files of their own
STATE_FILE = re.compile(r"states/[A-Za-z0-9_]+\.h5")
VERSION = 3  # of the layout
SCALES = ("from zero", "whole", "both ways", "magnitude")
MOST_TEXT = 4096  # bytes
FARTHEST = 1e9  # mm, and any other unit: no result is larger
MOST_NAMES = 100000


class Broken(Exception):
    """What is wrong inside of the file; one line."""


@dataclass(frozen=True)
class Column:
    """What results.h5 says of a column of a ply, or of a number of each state."""
    name: str         # in every file
    word: str         # in options and study files
    label: str
    unit: str         # "1": a ratio
    place: str        # node, triangle, ply, tool, boundary, run
    digits: int       # after the point, where one value is shown
    precision: float  # in its unit; finer steps say nothing
    scale: str        # one of SCALES
    note: str = ""
    quantity: str = ""  # what columns of several families share
    size: int = 1       # numbers in a row

    @property
    def factor(self) -> float:
        """From the file's unit to the one that readers are shown."""
        return 100.0 if self.unit == "1" else 1.0

    @property
    def shown_unit(self) -> str:
        return {"1": "%", "deg": "degrees"}.get(self.unit, self.unit)


class Results:
    """An open results.h5, of t states; plies by name. All raise Broken."""

    def __init__(self, path: Path, file: h5py.File):
        self.path, self.folder, self.file = path, path.parent, file
        self.seen: set[tuple] = set()
        self.check_version()
        self.check_links(file, "/", False)
        self.time_s = self.numbers(file, "time_s", (None,))
        self.count = len(self.time_s)

    def check_version(self) -> None:
        version = int(self.number(self.file, "format_version"))
        if version != VERSION:
            raise Trouble(f"{self.path}: its layout is version {version}, this plyform reads version "
                          f"{VERSION}: run the case again, or read it with h5py")

    def check_links(self, group: h5py.Group, where: str, linked: bool) -> None:
        """All data lies in this file, or in states/ beside it while the run is in progress."""
        for name in group:
            self.check_link(group, name, where, linked)

    def check_link(self, group: h5py.Group, name: str, where: str, linked: bool) -> None:
        here, link = f"{where}{name}", group.get(name, getlink=True)
        away = isinstance(link, h5py.ExternalLink)
        if away and not linked:
            self.check_state_file(here, link.filename)
        elif away or not isinstance(link, h5py.HardLink):
            raise Broken(f"{here} is a link to elsewhere, which plyform does not write")
        at = group.get(name)
        if at is None:
            raise Broken(f"{here} leads nowhere")
        place = h5py.h5o.get_info(at.id)
        if (place.fileno, place.addr) in self.seen:
            raise Broken(f"{here} is a link to what stands elsewhere too, which plyform does "
                         "not write")
        self.seen.add((place.fileno, place.addr))
        if isinstance(at, h5py.Group):
            self.check_links(at, here + "/", linked or away)
        elif not isinstance(at, h5py.Dataset):
            raise Broken(f"{here} holds no numbers")
        elif at.external or at.is_virtual:
            raise Broken(f"{here} has its numbers in another file, which plyform does not write")

    def check_state_file(self, where: str, name: str) -> None:
        path = self.folder / name
        if not STATE_FILE.fullmatch(name) or path.parent.is_symlink() or path.is_symlink():
            raise Broken(f"{where} is a link to {name}, which is no state of this run")
        if not stat.S_ISREG(path.stat().st_mode):
            raise Broken(f"{where} is a link to {name}, which is no file")

    def member(self, group: h5py.Group, name: str, kind: type):
        found = group.get(name) if isinstance(group, h5py.Group) else None
        if not isinstance(found, kind):
            raise Broken(f"{group.name.rstrip('/')}/{name} is missing, or is no {kind.__name__.lower()}")
        return found

    def group(self, *steps: str) -> h5py.Group:
        at = self.file
        for step in steps:
            at = self.member(at, step, h5py.Group)
        return at

    def numbers(self, group: h5py.Group, name: str, shape: tuple, kinds: str = "f",
                finite: bool = True) -> np.ndarray:
        """`shape`: None for any length."""
        data = self.member(group, name, h5py.Dataset)
        if data.dtype.kind not in kinds or data.dtype.itemsize > 8:
            raise Broken(f"{data.name} holds no numbers of the right kind")
        if len(data.shape or ()) != len(shape) or data.shape is None or any(
                want not in (None, have) for want, have in zip(shape, data.shape)):
            raise Broken(f"{data.name} has the shape {data.shape} in place of "
                         f"{tuple('any' if k is None else k for k in shape)}")
        if data.nbytes > Path(data.file.filename).stat().st_size:
            raise Broken(f"{data.name} is larger than the file")
        values = data[()]
        if finite and not (np.abs(values) < FARTHEST).all():
            raise Broken(f"{data.name} holds a number that is not finite, or beyond {FARTHEST:g}: the "
                         "run is broken")
        return values

    def attribute(self, group: h5py.Group, name: str, shape: tuple = ()) -> np.ndarray:
        """float64, finite."""
        if name not in group.attrs:
            raise Broken(f"{group.name}:{name} is missing")
        kept = group.attrs.get_id(name)
        if kept.shape != shape or kept.dtype.kind not in "fiu":
            raise Broken(f"{group.name}:{name} is no {'number' if shape == () else 'vector'}")
        value = np.asarray(group.attrs[name], dtype=float)
        if not (np.abs(value) < FARTHEST).all():
            raise Broken(f"{group.name}:{name} is not finite, or beyond {FARTHEST:g}")
        return value

    def number(self, group: h5py.Group, name: str) -> float:
        return float(self.attribute(group, name))

    def texts(self, group: h5py.Group, name: str, kind: str) -> list[str]:
        """Names of things of one kind; none stands twice."""
        where = f"{group.name}:{name}"
        if name not in group.attrs:
            raise Broken(f"{where} is missing")
        kept = group.attrs.get_id(name)
        if len(kept.shape or ()) != 1 or kept.shape[0] > MOST_NAMES or \
                kept.dtype.kind != "S" or h5py.check_string_dtype(kept.dtype) is None:
            raise Broken(f"{where} is no list of names")
        found = [text.decode() for text in group.attrs[name]]
        for text in found:
            checked(text, kind, self.path, SEPARATORS)
        if len(set(found)) < len(found):
            raise Broken(f"{where} has a name twice")
        return found

    def text(self, data: h5py.Dataset, name: str) -> str:
        """An attribute of one line; empty if there is none."""
        if name not in data.attrs:
            return ""
        kept = data.attrs.get_id(name)
        if kept.shape != () or kept.dtype.kind != "S" or kept.dtype.itemsize > MOST_TEXT:
            raise Broken(f"{data.name}:{name} is no text")
        found = bytes(data.attrs[name]).rstrip(b"\0").decode()
        if not found.isprintable():
            raise Broken(f"{data.name}:{name} is no line of text")
        return found

    def names(self, bodies: str) -> list[str]:
        """Of "plies", from the bottom of the stack, "tools" or "boundaries"."""
        return self.texts(self.file, bodies, {"plies": "ply"}.get(bodies, bodies[:-1]))

    def families(self, ply: str) -> list[str]:
        """Names of its families of yarns."""
        return self.texts(self.group("plies", ply), "families", "family")

    def description(self, group: h5py.Group, name: str) -> Column:
        data = self.member(group, name, h5py.Dataset)
        words = {key: self.text(data, key) for key in
                 ("word", "label", "unit", "place", "scale", "note", "quantity")}
        lacking = [key for key in ("word", "label", "unit", "place") if not words[key]]
        if lacking or words["scale"] not in SCALES:
            raise Broken(f"{data.name}:{(lacking or ['scale'])[0]} is missing or unknown")
        digits, precision = self.number(data, "digits"), self.number(data, "precision")
        if not 0 <= digits <= 17 or digits != int(digits) or precision < 0.0:
            raise Broken(f"{data.name}: its digits or its precision are none")
        return Column(name, digits=int(digits), precision=precision, **words,
                      size=data.shape[1] if len(data.shape or ()) == 2 else 1)

    def columns(self, ply: str) -> list[Column]:
        """What a ply has in every state, in the order of its table."""
        now = self.in_state(0, "plies", ply)
        found = [self.description(now, name)
                 for name in self.texts(self.group("plies", ply), "columns", "column")]
        for column in found:
            if column.place not in ("node", "triangle"):
                raise Broken(f"{now.name}/{column.name}:place is none of a ply")
        return found

    def column(self, number: int, ply: str, column: Column, count: int) -> np.ndarray:
        """Values of a state, of `count` nodes or triangles."""
        return self.numbers(self.in_state(number, "plies", ply), column.name,
                            (count,) if column.size == 1 else (count, column.size))

    def history(self, *steps: str) -> dict[str, tuple[Column, np.ndarray]]:
        """The numbers of each state, with NaN where one is not known, by name: "energies", or
        "plies", "tools" or "boundaries" and one of them."""
        group = self.group("history", *steps)
        return {name: (self.description(group, name),
                       self.numbers(group, name, (self.count,), finite=False))
                for name in self.texts(group, "numbers", "number")}

    def frame_number(self, frame: int) -> int:
        """From 0; -1 is the last. Raises Trouble."""
        number = self.count - 1 if frame == -1 else frame
        if self.count == 0:
            raise Trouble(f"{self.path} has no state yet: wait for the run's first output")
        if not 0 <= number < self.count:
            raise Trouble(f"{self.folder} has no frame {frame}: it has frames 0 to {self.count - 1}")
        return number

    def state(self, number: int) -> h5py.Group:
        return self.group("frames", f"{number:06}")

    def in_state(self, number: int, bodies: str, name: str) -> h5py.Group:
        return self.group("frames", f"{number:06}", bodies, name)

    def body(self, bodies: str, name: str) -> tuple[np.ndarray, np.ndarray]:
        """x0 (n x 3, mm) and triangles (m x 3, int64) of a ply or tool; m is 1 at least."""
        fixed = self.group(bodies, name)
        x0 = self.numbers(fixed, "x0", (None, 3))
        triangles = self.numbers(fixed, "triangles", (None, 3), "iu", finite=False)
        if len(triangles) == 0:
            raise Broken(f"{fixed.name} has no triangle")
        if not (triangles >= 0).all() or not (triangles < len(x0)).all():
            raise Broken(f"{fixed.name}/triangles names a node that is not there")
        return x0, triangles.astype(np.int64)


def read_results(folder: Path, act: Callable[[Results], object], kind: type[Results] = Results):
    """What `act` makes of the results in a folder, opened as `kind`: plain data, as it is read in
    another process. Raises Trouble."""
    path = folder / "results.h5"
    if not path.exists():
        raise Trouble(f"{path} is missing: is {folder} the folder of a run?")
    check_file(path)
    if path.stat().st_size == 0:  # those of the kernel say so, and may let who reads them wait
        raise Trouble(f"{path} is empty: is {folder} the folder of a run?")

    def read():
        try:
            with h5py.File(path, "r") as file:
                return act(kind(path, file))
        except Broken as problem:
            raise Trouble(f"{path} cannot be read as results of plyform: {problem}; run the case "
                          "again") from None
        except (OSError, KeyError, ValueError, TypeError, RuntimeError, OverflowError,
                RecursionError, MemoryError) as problem:  # of h5py, on damaged files
            raise Trouble(f"{path} cannot be read as results of plyform: {problem}") from None
    return read_apart(path, read)
