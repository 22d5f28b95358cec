# SPDX-License-Identifier: GPL-3.0-or-later
"""What all routes share."""

from dataclasses import dataclass, field
from pathlib import Path

from base.ending import TOOLS

from ..processes.processes import Processes
from .events import Events
from .project import Project


@dataclass
class Studio:
    project: Project
    program: Path  # plyform
    events: Events = field(default_factory=Events)
    processes: Processes = field(init=False)
    tools: Path = TOOLS  # where mesh_tool.py, study, map and others are

    def __post_init__(self):
        self.processes = Processes(self.project, self.events)
