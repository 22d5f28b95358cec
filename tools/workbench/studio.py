# SPDX-License-Identifier: GPL-3.0-or-later
"""What all routes share."""

import json
import subprocess
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from base.ending import TOOLS

from .cases.files import CaseFiles
from .processes.processes import Processes
from .project.events import Events
from .project.project import Project, Refused
from .toml.model import Refers


@dataclass
class Studio:
    project: Project
    program: Path  # plyform
    events: Events = field(default_factory=Events)
    processes: Processes = field(init=False)
    cases: CaseFiles = field(init=False)
    tools: Path = TOOLS  # where mesh_tool.py, study, map and others are

    def __post_init__(self):
        self.processes = Processes(self.project, self.events)
        self.cases = CaseFiles(self.project, self.events, lambda: self.refers)

    @cached_property
    def keys(self) -> list[dict]:
        """The program's table of keys. Raises Refused."""
        return self.told("--json")

    @cached_property
    def identify_tests(self) -> list[dict]:
        """The tests of plyform identify, with their options. Raises Refused."""
        return self.told("--identify")

    def told(self, option: str) -> list[dict]:
        """By `plyform keys`. Raises Refused."""
        try:
            said = subprocess.run([self.program, "keys", option], stdin=subprocess.DEVNULL, capture_output=True,
                                  timeout=60.0, check=True).stdout
            return json.loads(said)
        except (OSError, subprocess.SubprocessError, ValueError) as problem:
            raise Refused(f"{self.program} does not tell its keys: build plyform again", 500) from problem

    @cached_property
    def refers(self) -> Refers:
        """Of these keys, those that name parts of a case. Raises Refused."""
        return {row["key"]: row["refers"] for row in self.keys if row["refers"]}
