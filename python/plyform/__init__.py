# SPDX-License-Identifier: GPL-3.0-or-later
"""plyform: forming of stacks of woven fabric plies between rigid tools.

Units: mm, N, s, degrees, mJ, N per yarn. docs/users/python.md shows how it is used.
"""

from ._case import Case, Check, Warned, predicted_error
from ._errors import CaseError, Error, Stopped
from ._identify import Identified, Number, identify, identify_tests, theory_shear
from ._parts import Parts
from ._plyform import (BoundaryFrame, Difference, FirstContact, Frame, Key, KeyColumn, LivePly,
                       Mistake, Outlook, PlyFrame, PlyGap, PredictedError, Progress, Scene,
                       SceneBoundary, ScenePly, SceneTool, ToolFrame, keys, version)
from ._run import Result, Simulation, difference, export, form_ply, history, read, run

__version__ = version
__all__ = [
    "BoundaryFrame", "Case", "CaseError", "Check", "Difference", "Error", "FirstContact", "Frame",
    "Identified", "Key", "KeyColumn", "LivePly", "Mistake", "Number", "Outlook", "Parts", "PlyFrame",
    "PlyGap", "PredictedError", "Progress", "Result", "Scene", "SceneBoundary", "ScenePly",
    "SceneTool", "Simulation", "Stopped", "ToolFrame", "Warned", "difference", "export", "form_ply",
    "history", "identify", "identify_tests", "keys", "predicted_error", "read", "run",
    "theory_shear", "version",
]
