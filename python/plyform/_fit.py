# SPDX-License-Identifier: GPL-3.0-or-later
"""Laws of a fabric from measured curves, and the curves that a fabric should give."""

from __future__ import annotations

import os
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any, List, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _plyform

Array = NDArray[np.float64]
AnyPath = Union[str, "os.PathLike[str]"]
#: A CSV file, or places and values as a tuple of two sequences; of a shear test also of three, the
#: last a measured shear angle in degrees.
AnyCurve = Union[AnyPath, Tuple[ArrayLike, ArrayLike], Tuple[ArrayLike, ArrayLike, ArrayLike]]
#: A curve, or a list of them, one for each specimen.
AnyCurves = Union[AnyCurve, List[AnyCurve]]
#: A number, "fit" to have it found, or None.
Correction = Union[float, str, None]


@dataclass(frozen=True)
class Fit:
    """How well a law follows the rows that it was fitted to."""

    #: Rows that count.
    rows: int
    #: Residuals over the load, root of their mean square, and the largest.
    rms: float
    largest: float
    #: Where the largest one is: shear angle in degrees, or strain.
    largest_at: float
    #: N, of each row; of tension per yarn.
    measured_N: Array
    fitted_N: Array
    #: Half widths of the 95 % limits: of each coefficient, and the largest of the law, over it. Of
    #: one specimen from its residuals, of several from the spread between them.
    limits: list[float]
    law_limits: float
    #: The coefficients of each specimen, and the largest standard deviation of the law between
    #: specimens, over it.
    of_specimens: list[list[float]]
    scatter: float

    def _law(self) -> tuple[str, str]:
        """Key of the law in its table of a fabric file, and its value as TOML."""
        raise NotImplementedError

    def _write(self, table: str, fabric: AnyPath, output: AnyPath) -> None:
        key, value = self._law()
        comment = [f"Identified by plyform {_plyform.version}: {self.rows} rows,",
                   f"residuals {100 * self.rms:.2g} % of the load rms, {100 * self.largest:.2g} % "
                   f"at most, at {self.largest_at:.3g}."]
        text = _plyform.fabric_with_laws(Path(fabric), [(table, key, value)], comment)
        Path(output).write_text(text, encoding="utf-8")


@dataclass(frozen=True)
class ShearFit(Fit):
    """Law of shear: torque of one unit cell, a polynomial k1 g + k3 g^3 + ... (g in rad), a static
    torque and a polynomial, or a table through which a monotone curve passes.
    """

    #: Which of them, and why it was chosen: "table of 6 points", "cross-validated 1.9 %, ...".
    law: str
    why: str
    #: Residuals as torques over the range, root of their mean square over that of the torque, and
    #: what single rows scatter by.
    misfit: float
    noise: float
    #: k1, k3, k5 ..., N mm; beside a static torque too; empty of a table.
    coefficients: list[float]
    #: N mm; 0 of the others.
    static_torque: float
    #: The table, degrees and N mm, from (0, 0) on; empty of a polynomial.
    table_deg: Array
    table_torque: Array
    #: Of each row: mm, degrees.
    extension_mm: Array
    shear_deg: Array

    def _law(self) -> tuple[str, str]:
        if len(self.table_deg) == 0:
            return "polynomial", "[" + ", ".join(f"{k:.7g}" for k in self.coefficients) + "]"
        rows = "".join(f"\n    [{angle:.6g}, {torque:.6g}],"
                       for angle, torque in zip(self.table_deg, self.table_torque))
        return "table", f"[{rows}\n]"

    def write(self, fabric: AnyPath, output: AnyPath) -> None:
        """Writes the fabric file `output`: `fabric` with this law of shear. Raises CaseError for
        mistakes in the fabric, OSError for a file that cannot be written.
        """
        self._write("shear", fabric, output)


@dataclass(frozen=True)
class TensionFit(Fit):
    """Law of tension of a yarn: a stiffness, or a table where no line fits."""

    #: N per yarn, tension over strain; None if the law is a table.
    stiffness: float | None
    #: The table: strains, and N per yarn; empty if the law is a stiffness.
    table_strain: Array
    table_tension_N: Array
    #: Of each row.
    strain: Array

    def _law(self) -> tuple[str, str]:
        if self.stiffness is not None:
            return "stiffness", f"{self.stiffness:.7g}"
        rows = "".join(f"\n    [{strain:.9g}, {tension:.7g}],"
                       for strain, tension in zip(self.table_strain, self.table_tension_N))
        return "table", f"[{rows}\n]"

    def write(self, yarns: str, fabric: AnyPath, output: AnyPath) -> None:
        """Writes the fabric file `output`: `fabric` with this law for its `yarns`, "warp" or
        "weft". Raises CaseError for mistakes in the fabric, OSError for a file that cannot be
        written.
        """
        if yarns not in ("warp", "weft"):
            raise ValueError(f"yarns: {yarns!r} is neither warp nor weft")
        self._write(yarns, fabric, output)


def _curve(curve: AnyCurve, x_column: str | int, y_column: str | int, test: str,
           angle_column: str | int = "") -> _plyform.Curve:
    if isinstance(curve, (str, os.PathLike)):
        return _plyform.read_curve(Path(curve), str(x_column), str(y_column), str(angle_column),
                                   test)
    x, y, *angle = (np.asarray(values, dtype=float).ravel() for values in curve)
    if test in ("cantilever angle", "zone"):
        y = np.radians(y)
    return _plyform.Curve(x, y, angle[0] if angle else [])


def _curves(curves: AnyCurves, x_column: str | int, y_column: str | int, test: str,
            angle_column: str | int = "") -> list[_plyform.Curve]:
    several = curves if isinstance(curves, list) else [curves]
    return [_curve(curve, x_column, y_column, test, angle_column) for curve in several]


def _strip(gauge_length: float) -> str:
    return "strain" if gauge_length == 1.0 else "displacement"


def _test(bias: Sequence[float] | None, frame: float | None) -> _plyform.ShearTest:
    if (bias is None) == (frame is None):
        raise ValueError("give bias=(length, width) or frame=side, mm")
    if frame is not None:
        return _plyform.frame_test(frame)
    length, width = bias  # type: ignore[misc]
    return _plyform.bias_test(length, width)


def _warn(found: dict[str, Any]) -> dict[str, Any]:
    for text in found.pop("warnings"):
        warnings.warn(text, stacklevel=3)
    return found


def identify_shear(curve: AnyCurves, fabric: AnyPath, *, bias: Sequence[float] | None = None,
                   frame: float | None = None, law: str | None = None,
                   coefficients: int | None = None, points: int | None = None,
                   from_deg: float = 0.0, to_deg: float = np.inf, x_column: str | int = "",
                   y_column: str | int = "", angle_column: str | int = "",
                   normalised: bool = False,
                   compliance: float | None = None, zero: Correction = None,
                   toe: Correction = None, slip: bool = False,
                   doubtful: bool = False) -> ShearFit:
    """Law of shear from extension (mm) and load (N) of shear tests.

    bias: free length and width of a bias-extension specimen, mm; or
    frame: side of a picture frame, from hinge to hinge, mm; any one for a normalised force.
    fabric: file with all but the law of shear.
    law: "polynomial", "static" (a torque, then a polynomial) or "table"; coefficients: of a
    polynomial, 1 to 6; points: of a table, 1 to 20. What is None is chosen by cross-validation.
    from_deg, to_deg: shear angles of the rows that count.
    x_column, y_column: columns of a CSV file by name or number from 1; by its header unless given.
    angle_column: of a measured shear angle, which then counts instead of the extension, as the
    third sequence of a curve does; "none": the extension counts. A column of other angles than
    those of the extension counts unless told, unless compliance or slip is given.
    normalised: loads of a frame are F L_frame / (2 cos(45 deg - g/2) L_fabric^2), N/mm; so they
    are where the header says N/mm.
    compliance: mm/N of machine and clamps; zero: N that the load cell shows without load, toe: mm
    at which the specimen is taut, each a number or "fit"; slip: take a sudden slip off.
    doubtful: accept what is refused as a doubtful curve or law.

    Warns of doubtful rows. Raises CaseError for what is wrong in curve, fabric or specimen,
    ValueError for other arguments.
    """
    if normalised and frame is None:
        raise ValueError("normalised: loads of frames only; give frame=side, mm, any one")
    column = "" if angle_column == "none" else angle_column
    curves = _curves(curve, x_column, y_column, "bias" if frame is None else "frame", column)
    several = curve if isinstance(curve, list) else [curve]
    given = all(isinstance(c, tuple) and len(c) == 3 for c in several)
    measured = False if angle_column == "none" else True if column != "" or given else None
    corrections = {"compliance": compliance, "zero": zero, "toe": toe, "slip": slip,
                   "doubtful": doubtful}
    if (coefficients is not None and not 1 <= coefficients <= 6) or \
            (points is not None and not 1 <= points <= 20):
        raise ValueError("coefficients must be 1 to 6, points 1 to 20")
    form = {"law": law or "", "coefficients": coefficients or 0, "points": points or 0}
    return ShearFit(**_warn(_plyform.identify_shear(curves, _test(bias, frame), Path(fabric),
                                                    form, from_deg, to_deg, measured, normalised,
                                                    corrections)))


def identify_tension(curve: AnyCurves, *, yarns: float = 1.0, gauge_length: float = 1.0,
                     from_strain: float = 0.0, to_strain: float = np.inf, x_column: str | int = "",
                     y_column: str | int = "", compliance: float | None = None,
                     zero: Correction = None, toe: Correction = None, slip: bool = False,
                     doubtful: bool = False) -> TensionFit:
    """Law of tension from strain and force (N) of yarn or strip tests.

    yarns: that share the force. gauge_length: mm, if the curve has displacements in mm.
    from_strain, to_strain: of the rows that count. toe: a strain, or mm with gauge_length. Columns,
    corrections, warnings and errors: as of identify_shear.
    """
    corrections = {"compliance": compliance, "zero": zero, "toe": toe, "slip": slip,
                   "doubtful": doubtful}
    curves = _curves(curve, x_column, y_column, _strip(gauge_length))
    return TensionFit(**_warn(_plyform.identify_tension(curves, yarns, gauge_length, from_strain,
                                                        to_strain, corrections)))


def theory_shear(fabric: AnyPath, *, bias: Sequence[float] | None = None,
                 frame: float | None = None, to_deg: float, points: int = 100,
                 negative: bool = False) -> dict[str, Array]:
    """The curve that a fabric should give in a shear test, `points` + 1 rows from 0 to `to_deg`:
    displacement_mm, shear_deg, force_N. negative: of a specimen that lies the other way round, so
    that the angle from the first family to the second opens. Sizes and errors: as of
    identify_shear.
    """
    return _plyform.theory_shear(_test(bias, frame), Path(fabric), to_deg, points, negative)
