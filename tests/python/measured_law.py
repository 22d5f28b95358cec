# SPDX-License-Identifier: GPL-3.0-or-later
"""Laws of shear that plyform identifies for measured.py, and curves by the theory of both tests."""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from measured_work import MEASURED, Fabric, Work, columns_of

#: What the published curves do not tell is taken to be right: zeros, and a machine that does not
#: give way at a load of some newtons.
ZEROS = ("--zero", 0, "--toe", 0, "--compliance", 0)


@dataclass
class Law:
    """A fabric file with a law that was identified, and all that was said of it."""

    file: Path
    report: str

    @property
    def kind(self) -> str:
        """What was chosen by cross-validation, from the report: table of 5 points, ..."""
        found = re.search(r"^ *(.+): cross-validated ", self.report, re.MULTILINE)
        assert found, self.report
        return found[1]

    @property
    def slip(self) -> str:
        """What identify says of slip in the curve, or nothing: 9.2 % too large (...)."""
        found = re.search(r"the rows show an extension (.+? %) too large \(.*?; (.+? mm) at the end\)"
                          " by slip", self.report)
        return f"{found[1]} too large, by {found[2]} at the end" if found else ""

    def frame(self, work: Work, to: float) -> tuple:
        """Shear angle in degrees and normalised shear force in N/mm of a frame."""
        side = 100.0
        curve = theory(work, self, "frame", to, "--side", side)
        phi = np.radians(45.0 - 0.5 * curve["shear_deg"])
        return curve["shear_deg"], curve["force_N"] / (2.0 * np.cos(phi) * side)

    def bias(self, work: Work, length: float, width: float, to: float) -> dict:
        """displacement_mm, shear_deg, force_N by the formula of the three zones."""
        return theory(work, self, "bias", to, "--length", length, "--width", width)


def theory(work: Work, law: Law, test: str, to: float, *sizes) -> dict:
    output = work.folder / "theory.csv"
    done = work.call("theory", test, "--fabric", law.file, *sizes, "--to", to, "-o", output)
    assert done.returncode == 0, done.stderr
    return columns_of(output)


def frame_law(work: Work, fabric: Fabric, file: str, column: str) -> Law:
    """Law of one curve of a picture-frame table."""
    return identified(work, fabric, f"{Path(file).stem}_{column}", "frame",
                      f"{MEASURED / file}:{column}", "--y-unit", "N/mm")


def bias_law(work: Work, fabric: Fabric, file: str, length: float, width: float,
             to: float) -> Law:
    """Law of a bias-extension test up to a shear angle, by the formula of the three zones."""
    return identified(work, fabric, Path(file).stem, "bias", MEASURED / file, "--length", length,
                      "--width", width, "--to", to)


def identified(work: Work, fabric: Fabric, name: str, *arguments) -> Law:
    base = work.write(f"{name}_base.toml", fabric.text())
    output = work.folder / f"{name}.toml"
    done = work.call("identify", *arguments, *ZEROS, "--fabric", base, "-o", output)
    assert done.returncode == 0, done.stderr
    return Law(output, done.stdout + done.stderr)
