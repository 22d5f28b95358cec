# SPDX-License-Identifier: GPL-3.0-or-later
"""STEP files for the tests, drawn as those of the cases are."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "cases"))

from step_file import write_step  # noqa: E402

__all__ = ["write_step"]
