# SPDX-License-Identifier: GPL-3.0-or-later
"""results.h5 (layout: docs/users/results.md): opened by every Python program here. What it holds is
not trusted: it is numbers of its own, of the shapes and kinds that plyform writes, or one line."""

import re
import stat
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np

from base.apart import read_apart
from base.ending import Trouble
from base.files import check_file
from base.names import SEPARATORS, checked

# of a run in progress, whose states are files of their own
STATE_FILE = re.compile(r"states/[A-Za-z0-9_]+\.h5")
FARTHEST = 1e9  # mm, and any other unit: no result is larger
MOST_NAMES = 100000


class Broken(Exception):
    """What is wrong inside of the file; one line."""


class Results:
    """An open results.h5, of t states; plies by name. All raise Broken."""

    def __init__(self, path: Path, file: h5py.File):
        self.path, self.folder, self.file = path, path.parent, file
        self.seen: set[tuple] = set()
        self.check_links(file, "/", False)
        self.time_s = self.numbers(file, "time_s", (None,))
        self.count = len(self.time_s)

    def check_links(self, group: h5py.Group, where: str, linked: bool) -> None:
        """All data lies in this file, or in states/ beside it while the run is in progress."""
        for name in group:
            here, link = f"{where}{name}", group.get(name, getlink=True)
            away = isinstance(link, h5py.ExternalLink)
            if away and not linked:
                self.check_state_file(here, link.filename)
            elif away or not isinstance(link, h5py.HardLink):
                raise Broken(f"{here} is a link to elsewhere, which plyform does not write")
            at = group.get(name)
            if at is None:
                raise Broken(f"{here} leads nowhere")
            told = h5py.h5o.get_info(at.id)
            if (told.fileno, told.addr) in self.seen:
                raise Broken(f"{here} is a link to what stands elsewhere too, which plyform does "
                             "not write")
            self.seen.add((told.fileno, told.addr))
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

    def names(self, bodies: str) -> list[str]:
        """Of "plies", from the bottom of the stack, "tools" or "boundaries"."""
        if bodies not in self.file.attrs:
            raise Broken(f"/:{bodies} is missing")
        kept = self.file.attrs.get_id(bodies)
        if len(kept.shape or ()) != 1 or kept.shape[0] > MOST_NAMES or \
                kept.dtype.kind not in "SO" or h5py.check_string_dtype(kept.dtype) is None:
            raise Broken(f"/:{bodies} is no list of names")
        # texts of any length in files of layout 1
        told = [name if isinstance(name, str) else name.decode() for name in self.file.attrs[bodies]]
        for name in told:
            checked(name, {"plies": "ply"}.get(bodies, bodies[:-1]), self.path, SEPARATORS)
        if len(set(told)) < len(told):
            raise Broken(f"/:{bodies} has a name twice")
        return told

    def frame_number(self, frame: int) -> int:
        """From 0, of a number that may count from the end. Raises Trouble."""
        number = frame if frame >= 0 else self.count + frame
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


def read_results(folder: Path, act: Callable[[Results], object]):
    """What `act` makes of the results in a folder: plain data, as it is read in another process.
    Raises Trouble."""
    path = folder / "results.h5"
    if not path.exists():
        raise Trouble(f"{path} is missing: is {folder} the folder of a run?")
    check_file(path)

    def read():
        try:
            with h5py.File(path, "r") as file:
                return act(Results(path, file))
        except Broken as problem:
            raise Trouble(f"{path} cannot be read as results of plyform: {problem}; run the case "
                          "again") from None
        except (OSError, KeyError, ValueError, TypeError, RuntimeError, OverflowError,
                RecursionError, MemoryError) as problem:  # of h5py, on damaged files
            raise Trouble(f"{path} cannot be read as results of plyform: {problem}") from None
    return read_apart(path, read)
