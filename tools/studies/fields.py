# SPDX-License-Identifier: GPL-3.0-or-later
"""Fields of triangles that runs are compared by, as plyform describes them."""

import csv
import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

from base.ending import Trouble

UNITS = {"deg": "deg", "1": "percent", "N per yarn": "N_per_yarn", "mm": "mm"}


@dataclass(frozen=True)
class Field:
    name: str  # of the column
    word: str
    label: str
    unit: str  # "1": a ratio, which tables have in percent

    @property
    def factor(self) -> float:
        return 100.0 if self.unit == "1" else 1.0

    @property
    def shown_unit(self) -> str:
        return {"1": "%", "deg": "degrees"}.get(self.unit, self.unit)

    def error_columns(self) -> dict[str, str]:
        """Column of each number that a difference has."""
        unit = UNITS.get(self.unit) or re.sub(r"\W+", "_", self.unit)
        return {kind: f"{kind}_{self.word.replace('-', '_')}_error_{unit}"
                for kind in ("rms", "p99", "max")}


def fields_of(program: Path, words: list[str]) -> dict[str, Field]:
    """By word: those of warp and weft, and of the families that the words begin with."""
    if not words:
        return {}
    families = [word.rpartition("-")[0] for word in words if "-" in word]
    named = dict.fromkeys(["warp", "weft", *filter(None, families)])
    try:
        done = subprocess.run([program, "columns", *named], capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError) as problem:
        raise Trouble(f"{program} columns: {problem}; give --program") from problem
    return {row["word"]: Field(row["name"], row["word"], row["label"], row["unit"])
            for row in csv.DictReader(done.stdout.splitlines())
            if row["place"] == "triangle" and row["numbers"] == "1"}
