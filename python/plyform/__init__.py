# SPDX-License-Identifier: GPL-3.0-or-later
"""plyform: forming of stacks of woven fabric plies between rigid tools.

Units: mm, N, s, degrees, mJ, N per yarn. docs/users/python.md shows how it is used.
"""

from ._case import Case, Check, predicted_error
from ._errors import CaseError, Error, Stopped
from ._fit import Fit, ShearFit, TensionFit, identify_shear, identify_tension, theory_shear
from ._parts import Parts
from ._plyform import (BoundaryFrame, Difference, Frame, Key, LivePly, Mistake, Outlook, PlyFrame,
                       PredictedError, Progress, ToolFrame, keys, version)
from ._run import Result, Simulation, difference, export, history, read, run

__version__ = version
__all__ = [
    "BoundaryFrame", "Case", "CaseError", "Check", "Difference", "Error", "Fit", "Frame", "Key",
    "LivePly", "Mistake", "Outlook", "Parts", "PlyFrame", "PredictedError", "Progress", "Result",
    "ShearFit", "Simulation", "Stopped", "TensionFit", "ToolFrame", "difference", "export",
    "history", "identify_shear", "identify_tension", "keys", "predicted_error", "read", "run",
    "theory_shear", "version",
]
