# SPDX-License-Identifier: GPL-3.0-or-later
"""Bending and compression of yarns from measured curves."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import _plyform
from ._fit import AnyCurve, AnyCurves, AnyPath, Array, Correction, _curve, _curves, _strip, _warn


def _families(yarns: str) -> list[str]:
    if yarns not in ("warp", "weft", "both"):
        raise ValueError(f"yarns: {yarns!r} is neither warp nor weft nor both")
    return ["warp", "weft"] if yarns == "both" else [yarns]


def _write(laws: list[tuple[str, str, str]], rows: int, rms: float, fabric: AnyPath,
           output: AnyPath) -> None:
    comment = [f"Identified by plyform {_plyform.version}: {rows} rows,",
               f"residuals {100 * rms:.2g} % rms."]
    text = _plyform.fabric_with_laws(Path(fabric), laws, comment)
    Path(output).write_text(text, encoding="utf-8")


@dataclass(frozen=True)
class BendingFit:
    """Bending stiffness of a fabric, or a table of moments where it falls with curvature."""

    #: Rows that count.
    rows: int
    #: Residuals over the fitted value, root of their mean square, and the largest; the x there.
    rms: float
    largest: float
    largest_at: float
    #: N mm, moment per width over curvature; with a table its first slope.
    stiffness: float
    #: Half width of the 95 % limits, N mm, 0 of one reading; with a table of its curvatures, over
    #: them.
    limits: float
    #: Peirce's bending length, mm; with a table of its first slope.
    bending_length_mm: float
    #: The table: curvatures, 1/mm, and moments per width, N; empty if one stiffness fits.
    table_curvature: Array
    table_moment_N: Array
    #: The stiffness of each specimen, and the standard deviation between them, N mm.
    of_specimens: list[float]
    scatter: float
    #: Of each row: of a cantilever overhang (mm) and stiffness (N mm), of three points deflection
    #: (mm) and force (N), with a table force and deflection.
    x: Array
    measured: Array
    fitted: Array

    def write(self, yarns: str, fabric: AnyPath, output: AnyPath) -> None:
        """Writes the fabric file `output`: `fabric` with this law for its `yarns`, "warp", "weft"
        or "both". Raises CaseError for mistakes in the fabric, OSError for a file that cannot be
        written.
        """
        key, value = "bending_stiffness", f"{self.stiffness:.7g}"
        if len(self.table_curvature) > 0:
            rows = "".join(f"\n    [{curvature:.7g}, {moment:.7g}]," for curvature, moment in
                           zip(self.table_curvature, self.table_moment_N))
            key, value = "bending_table", f"[{rows}\n]"
        _write([(family, key, value) for family in _families(yarns)], self.rows, self.rms, fabric,
               output)


@dataclass(frozen=True)
class InPlaneBendingFit:
    """In-plane bending stiffness from the width of zones between regions of one shear."""

    #: Rows that count.
    rows: int
    #: Residuals over the step of shear, root of their mean square.
    rms: float
    #: N mm, and half width of its 95 % limits.
    stiffness: float
    limits: float
    #: Length over which what is left of the step falls to 1/e, mm; of each profile too.
    length_mm: float
    length_limits_mm: float
    lengths_mm: list[float]
    #: Shear angle that the profiles go to, degrees.
    plateau_deg: float
    #: Of each row.
    distance_mm: Array
    measured_deg: Array
    fitted_deg: Array

    def write(self, yarns: str, fabric: AnyPath, output: AnyPath) -> None:
        """As that of BendingFit."""
        _write([(family, "in_plane_bending_stiffness", f"{self.stiffness:.7g}")
                for family in _families(yarns)], self.rows, self.rms, fabric, output)


@dataclass(frozen=True)
class CompressionFit:
    """Law of a pressed yarn: a stiffness, up to a force at which it gives way."""

    #: Rows that count.
    rows: int
    #: Residuals over the load, root of their mean square, and the largest; the strain there.
    rms: float
    largest: float
    largest_at: float
    #: N per yarn, force over shortening, and half width of its 95 % limits.
    stiffness: float
    limits: float
    #: N per yarn; None if the curve has no plateau.
    buckling_force: float | None
    #: Of each row: shortening, and N per yarn.
    strain: Array
    measured_N: Array
    fitted_N: Array

    def write(self, yarns: str, fabric: AnyPath, output: AnyPath) -> None:
        """As that of BendingFit. Raises CaseError too if the yarns of `fabric` are not as stiff in
        tension.
        """
        buckling = "" if self.buckling_force is None else f"{self.buckling_force:.7g}"
        laws = []
        for family in _families(yarns):
            _plyform.check_compression(self.stiffness, family, Path(fabric))
            laws += [(family, "compression_stiffness", f"{self.stiffness:.7g}"),
                     (family, "buckling_force", buckling)]
        _write(laws, self.rows, self.rms, fabric, output)


def _corrections(compliance: float | None = None, zero: Correction = None,
                 toe: Correction = None, slip: bool = False,
                 doubtful: bool = False) -> dict[str, object]:
    return {"compliance": compliance, "zero": zero, "toe": toe, "slip": slip, "doubtful": doubtful}


def identify_cantilever(curve: AnyCurves, fabric: AnyPath, *, reading: str = "angle",
                        x_column: str | int = "", y_column: str | int = "",
                        doubtful: bool = False) -> BendingFit:
    """Bending stiffness from readings of strips that hang over an edge.

    curve: overhang (mm), and angle of the line from edge to tip below the horizontal (degrees) or,
    with reading="deflection", how much lower the tip is than the edge (mm).
    fabric: file with the surface density; laws may be missing.
    Columns, several specimens, doubtful, warnings and errors: as of identify_shear.
    """
    if reading not in ("angle", "deflection"):
        raise ValueError(f"reading: {reading!r} is neither angle nor deflection")
    curves = _curves(curve, x_column, y_column, f"cantilever {reading}")
    return BendingFit(**_warn(_plyform.identify_cantilever(curves, Path(fabric),
                                                           reading == "angle",
                                                           _corrections(doubtful=doubtful))))


def identify_three_point(curve: AnyCurves, fabric: AnyPath, *, span: float, width: float,
                         from_share: float = 0.0, to_share: float = np.inf,
                         x_column: str | int = "", y_column: str | int = "",
                         compliance: float | None = None, zero: Correction = None,
                         toe: Correction = None, slip: bool = False,
                         doubtful: bool = False) -> BendingFit:
    """Bending stiffness from deflection (mm) and force (N) of strips on two supports.

    span: of the supports, width: of the strip, mm. from_share, to_share: of the span, deflections
    of the rows that count; at most a tenth of the span does.
    fabric: file with the surface density; laws may be missing.
    Columns, corrections, several specimens, warnings and errors: as of identify_shear.
    """
    curves = _curves(curve, x_column, y_column, "three-point")
    corrections = _corrections(compliance, zero, toe, slip, doubtful)
    return BendingFit(**_warn(_plyform.identify_three_point(curves, Path(fabric), span, width,
                                                            from_share, to_share, corrections)))


def identify_in_plane_bending(curve: AnyCurves, fabric: AnyPath, *, x_column: str | int = "",
                              y_column: str | int = "",
                              doubtful: bool = False) -> InPlaneBendingFit:
    """In-plane bending stiffness from profiles of the shear angle, each a curve: distance along a
    yarn from the step of shear (mm), and shear angle (degrees).

    fabric: file with the law of shear.
    Columns, doubtful, warnings and errors: as of identify_shear.
    """
    curves = _curves(curve, x_column, y_column, "zone")
    return InPlaneBendingFit(**_warn(_plyform.identify_zone(curves, Path(fabric),
                                                            _corrections(doubtful=doubtful))))


def identify_compression(curve: AnyCurve, *, yarns: float = 1.0, gauge_length: float = 1.0,
                         from_strain: float = 0.0, to_strain: float = np.inf,
                         x_column: str | int = "", y_column: str | int = "",
                         compliance: float | None = None, zero: Correction = None,
                         toe: Correction = None, slip: bool = False,
                         doubtful: bool = False) -> CompressionFit:
    """Law of compression from shortening and force (N), both positive, of one strip held flat.

    Arguments, warnings and errors: as of identify_tension.
    """
    one = _curve(curve, x_column, y_column, _strip(gauge_length))
    corrections = _corrections(compliance, zero, toe, slip, doubtful)
    return CompressionFit(**_warn(_plyform.identify_compression(one, yarns, gauge_length,
                                                                from_strain, to_strain,
                                                                corrections)))
