# SPDX-License-Identifier: GPL-3.0-or-later
"""What summary.json says of its figures beside their values: core/results/figures.hpp."""

import math
from dataclasses import dataclass

MOST_DIGITS = 9


@dataclass(frozen=True)
class Figure:
    name: str         # a path from the ply, or from the top: draw_in_mm.mean
    label: str
    unit: str         # "1": a ratio
    digits: int       # after the point, where it is shown
    compared: bool    # lists of runs show it
    verified: str     # begins the name of the verified figure, if there can be one

    @property
    def factor(self) -> float:
        """From the file's unit to the one that readers are shown."""
        return 100.0 if self.unit == "1" else 1.0

    @property
    def shown_unit(self) -> str:
        return {"1": "%", "deg": "°"}.get(self.unit, self.unit)

    def of(self, item: dict) -> float | None:
        """As it is shown, of a ply or of a summary; None where it is not known."""
        value = item
        for key in self.name.split("."):
            value = value.get(key) if isinstance(value, dict) else None
        if not isinstance(value, (int, float)) or not math.isfinite(value):
            return None
        # with the nine digits that a summary has
        return value if self.factor == 1.0 else float(f"{self.factor * value:.9g}")


def described(summary: dict, kind: str) -> dict[str, Figure]:
    """By name, in the order of the file; `kind`: plies or run. Empty of runs before 0.9, which said
    nothing of them."""
    return {name: Figure(name, one.get("label", name), one.get("unit", ""),
                         min(max(int(one.get("digits") or 0), 0), MOST_DIGITS),
                         bool(one.get("compared")), one.get("verified", ""))
            for name, one in summary.get("figures", {}).get(kind, {}).items()}
