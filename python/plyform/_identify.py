# SPDX-License-Identifier: GPL-3.0-or-later
"""Laws of a fabric from measured curves, and the curves that a fabric should give."""

from __future__ import annotations

import csv
import json
import os
import tempfile
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Mapping, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _plyform

Array = NDArray[np.float64]
AnyPath = Union[str, "os.PathLike[str]"]
#: A CSV file, FILE:COLUMN, or columns by their headers: {"extension (mm)": ..., "load (N)": ...}.
Curve = Union[AnyPath, Mapping[str, ArrayLike]]


@dataclass(frozen=True)
class Number:
    """A number of a law."""

    value: float
    #: Half width of its 95 % limits; NaN where they are not known.
    limits: float
    unit: str


@dataclass(frozen=True)
class Identified:
    """What has been found. Of laboratories only `said`."""

    #: As the program says it, with figures and notes.
    said: str
    #: The law in a line.
    law: str
    #: By the names of the report: k1, bending_stiffness, residuals rms ...
    numbers: dict[str, Number]
    figures: list[str]
    notes: list[str]
    #: Measured and fitted rows by the columns of the fit's file; "side" where warp and weft differ.
    fit: dict[str, Any]
    #: The file with the law: of a fabric, or [friction.NAME] of a case.
    text: str

    def write(self, output: AnyPath) -> None:
        """Writes `text`. Raises OSError."""
        Path(output).write_text(self.text, encoding="utf-8")


def _words(value: Any) -> list[str]:
    if isinstance(value, (list, tuple, np.ndarray)):
        return [word for one in value for word in _words(one)]
    if isinstance(value, bool):
        return ["true"] if value else []
    return [repr(float(value)) if isinstance(value, (float, np.floating)) else os.fspath(value)
            if isinstance(value, os.PathLike) else str(value)]


def _files(curves: Curve | Sequence[Curve], folder: Path) -> list[str]:
    """Paths; of columns files in `folder`."""
    several = curves if isinstance(curves, (list, tuple)) else [curves]
    paths = []
    for curve in several:
        if not isinstance(curve, Mapping):
            paths.append(os.fspath(curve))
            continue
        columns = [np.asarray(values, dtype=float).ravel() for values in curve.values()]
        if len({len(one) for one in columns}) != 1:
            raise ValueError(f"a curve has columns of {[len(one) for one in columns]} rows")
        path = folder / f"curve_{len(list(folder.iterdir())) + 1}.csv"
        with path.open("w", encoding="utf-8", newline="") as file:
            table = csv.writer(file)
            table.writerow(curve)
            table.writerows([[repr(float(value)) for value in row] for row in zip(*columns)])
        paths.append(str(path))
    return paths


def _curve_options(test: str) -> list[str]:
    """Options of a test that are curves."""
    return [option["name"] for one in identify_tests() if one["name"] == test
            for option in one["options"] if option["kind"] == "files"]


def _columns(path: Path) -> dict[str, Any]:
    """Of the fit's file; a line `# weft` parts the rows of warp and weft."""
    names: list[str] = []
    rows: list[list[float]] = []
    sides: list[str] = []
    side = "warp"
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith("#"):
            side = line.strip("# ")
        elif not names:
            names = line.split(",")
        else:
            rows.append([float(cell) if cell else np.nan for cell in line.split(",")])
            sides.append(side)
    table: dict[str, Any] = dict(zip(names, np.array(rows).T))
    return {**table, "side": sides} if len(set(sides)) > 1 else table


def identify(test: str, curves: Curve | Sequence[Curve], fabric: AnyPath | None = None,
             output: AnyPath | None = None, **options: Any) -> Identified:
    """The law that `plyform identify TEST` finds.

    curves: one, or a list, for each specimen: files, or columns by headers with units. fabric: file
    with all but the law. output: where to write it; Identified.write does so later. options: those
    of the command (`plyform identify TEST --help`) with _ in the place of -, and from_ for from:
    length=300, width=100, zero="fit", yes_doubtful=True, speeds=[1, 10], negative=[curve, curve].

    Warns as the program does. Raises CaseError for what is wrong in curves, fabric or options'
    values, ValueError for an option that there is not or that is missing, OSError for files that
    cannot be written.
    """
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        file = Path(output) if output is not None else folder / "law.toml"
        curve_options = _curve_options(test)
        named = {key.rstrip("_").replace("_", "-"): value for key, value in options.items()}
        given = {key: _files(value, folder) if key in curve_options else _words(value)
                 for key, value in named.items() if value is not None}
        fit, report = given.get("fit", [str(folder / "fit.csv")]), [str(folder / "report.json")]
        whole = {**given, "output": [str(file)], "fit": fit}
        if fabric is not None:
            whole["fabric"] = [os.fspath(fabric)]
        laboratories = "laboratories" in given
        if not laboratories:
            whole["report"] = report
        said, warned = _plyform.identify(test, _files(curves, folder), whole)
        for text in warned:
            warnings.warn(text, stacklevel=2)
        if laboratories:
            return Identified(said, "", {}, [], [], {}, "")
        told = json.loads(Path(report[0]).read_text(encoding="utf-8"))
        numbers = {one["name"]: Number(one["value"], np.nan if one["limits"] is None else one["limits"],
                                       one["unit"]) for one in told["numbers"]}
        return Identified(said, told["law"], numbers, told["figures"], told["notes"],
                          _columns(Path(fit[0])), file.read_text(encoding="utf-8"))


def identify_tests() -> list[dict[str, Any]]:
    """The tests, with their options: name, kind, unit, words, required."""
    tests: list[dict[str, Any]] = json.loads(_plyform.identify_tests())
    return tests


def theory_shear(fabric: AnyPath, *, bias: Sequence[float] | None = None,
                 frame: float | None = None, to_deg: float, points: int = 100,
                 negative: bool = False) -> dict[str, Array]:
    """The curve that a fabric should give in a shear test, `points` + 1 rows from 0 to `to_deg`:
    displacement_mm, shear_deg, force_N.

    bias: free length and width of a bias-extension specimen, mm; or frame: side of a picture frame
    from hinge to hinge, mm. negative: of a specimen that lies the other way round, so that the angle
    from the first family to the second opens. Raises CaseError for what is wrong in the fabric or
    the specimen, ValueError for other arguments.
    """
    if (bias is None) == (frame is None):
        raise ValueError("give bias=(length, width) or frame=side, mm")
    length, width = bias if bias is not None else (np.nan, np.nan)
    found: dict[str, Array] = _plyform.theory_shear(
        "bias" if frame is None else "frame", length, width, np.nan if frame is None else frame,
        os.fspath(fabric), to_deg, points, negative)
    return found
