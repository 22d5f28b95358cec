# SPDX-License-Identifier: GPL-3.0-or-later
"""plyform: forming of stacks of woven fabric plies between rigid tools.

Units: mm, N, s, degrees, mJ, N per yarn. docs/users/python.md shows how it is used.
"""

from ._bending import (BendingFit, CompressionFit, InPlaneBendingFit, identify_cantilever,
                       identify_compression, identify_in_plane_bending, identify_three_point)
from ._case import Case, Check, Warned, predicted_error
from ._errors import CaseError, Error, Stopped
from ._fit import Fit, ShearFit, TensionFit, identify_shear, identify_tension, theory_shear
from ._parts import Parts
from ._plyform import (BoundaryFrame, Difference, FirstContact, Frame, Key, KeyColumn, LivePly,
                       Mistake, Outlook, PlyFrame, PlyGap, PredictedError, Progress, Scene,
                       SceneBoundary, ScenePly, SceneTool, ToolFrame, keys, version)
from ._run import Result, Simulation, difference, export, history, read, run

__version__ = version
__all__ = [
    "BendingFit", "BoundaryFrame", "Case", "CaseError", "Check", "CompressionFit", "Difference",
    "Error", "FirstContact", "Fit", "Frame", "InPlaneBendingFit", "Key", "KeyColumn", "LivePly",
    "Mistake", "Outlook", "Parts", "PlyFrame", "PlyGap", "PredictedError", "Progress", "Result",
    "Scene", "SceneBoundary", "ScenePly", "SceneTool", "ShearFit", "Simulation", "Stopped",
    "TensionFit", "ToolFrame", "Warned", "difference", "export", "history", "identify_cantilever",
    "identify_compression", "identify_in_plane_bending", "identify_shear", "identify_tension",
    "identify_three_point", "keys", "predicted_error", "read", "run", "theory_shear", "version",
]
