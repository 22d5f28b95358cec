# SPDX-License-Identifier: GPL-3.0-or-later
"""Simulations and what they leave behind."""

from __future__ import annotations

import csv
import json
import os
from pathlib import Path
from typing import Any, Callable, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _plyform
from ._case import Case
from ._errors import CaseError, Error, Stopped
from ._files import read_text
from ._parts import Parts
from ._plyform import BoundaryFrame, Difference, Frame, LivePly, PlyFrame, Progress, ToolFrame

AnyPath = Union[str, "os.PathLike[str]"]
#: Called with where the run stands; False stops it.
ProgressCallback = Callable[[Progress], Optional[bool]]
#: Called with each output state, the first and the last included; False stops the run.
FrameCallback = Callable[[Frame], Optional[bool]]

_EXIT_CODES = {"done": 0, "doubtful": 0, "instant": 0, "stopped": 3}


class Result:
    """A state of a run, its last one unless another was read, and what the run says of itself."""

    def __init__(self, frame: Frame, summary: dict[str, Any], folder: Path | None):
        #: The state.
        self.frame: Frame = frame
        #: The content of summary.json (docs/users/results.md); empty if the folder has none.
        self.summary: dict[str, Any] = summary
        #: Where files of the run are; None if it wrote none.
        self.folder: Path | None = folder

    @property
    def plies(self) -> Parts[PlyFrame]:
        """Plies by number from the bottom, or by name."""
        return self.frame.plies

    @property
    def tools(self) -> Parts[ToolFrame]:
        """Tools by number or by name."""
        return self.frame.tools

    @property
    def boundaries(self) -> Parts[BoundaryFrame]:
        """Grips and frames by number or by name."""
        return self.frame.boundaries

    @property
    def energies(self) -> dict[str, float]:
        """mJ by name at the end of the run, and balance_error."""
        return dict(self.summary.get("energy", {}))

    @property
    def status(self) -> str:
        """done, doubtful, interrupted or stopped; empty if the run has not ended."""
        return str(self.summary.get("status", ""))

    @property
    def message(self) -> str:
        """Why it stopped, or what not to trust."""
        return str(self.summary.get("message", ""))

    @property
    def exit_code(self) -> int:
        """The program's, for such a run."""
        return _EXIT_CODES.get(self.status, 1)

    def __repr__(self) -> str:
        return f"<Result {self.status or 'not ended'} at {self.frame.stroke_mm:g} mm>"


def _check_start(ply: str, what: str, values: NDArray[np.float64]) -> None:
    """Raises ValueError unless all are finite."""
    wrong = np.flatnonzero(~np.isfinite(values).all(axis=1))
    if len(wrong):
        raise ValueError(f"ply {ply}: {what} of node {wrong[0]} are {values[wrong[0]].tolist()}: give finite "
                         "numbers")


def _sound(case: Case) -> _plyform.Prepared:
    """Raises CaseError if the case has mistakes."""
    prepared = case._prepare()
    if prepared.mistakes:
        raise CaseError(prepared.mistakes)
    return prepared


def _ended(result: Result, error: BaseException | None) -> Result:
    """Raises what a callback raised, and Stopped if the simulation stopped itself."""
    if error is not None:
        raise error
    if result.status == "stopped":
        raise Stopped(result.message, result)
    return result


class Simulation:
    """A case in motion, whose arrays can be looked at while it runs. Runs once.

    threads: as many as there are cores unless given; results do not depend on it.
    Raises CaseError if the case has mistakes.
    """

    def __init__(self, case: Case, threads: int | None = None):
        if threads is not None and not 1 <= threads <= 256:
            raise ValueError(f"threads: {threads} is not 1 to 256")
        self._simulation = _plyform.Simulation(_sound(case), threads or 0)
        #: Plies by number or by name; their positions and velocities are those computed on. Before
        #: the run they may be given other values to start from.
        self.plies: Parts[LivePly] = self._simulation.plies
        #: What the run has come to, also when a callback raised; None before.
        self.result: Result | None = None

    @property
    def time_s(self) -> float:
        """s, simulated so far."""
        return self._simulation.time_s

    @property
    def step(self) -> int:
        """Steps taken so far."""
        return self._simulation.step

    @property
    def stroke_mm(self) -> float:
        """mm so far, of the first tool, grip or frame that is driven."""
        return self._simulation.stroke_mm

    def run(self, output: AnyPath | None = None, progress: ProgressCallback | None = None,
            frame: FrameCallback | None = None) -> Result:
        """Runs to the end.

        output: folder for the files of docs/users/results.md; nothing is written without one.
        progress: called every hundred steps, and at each output.
        frame: called with each output state.

        A callback that returns False ends the run as "interrupted", with the state reached as its
        result. One that raises ends it likewise; its exception is raised when all is written, as is
        KeyboardInterrupt for Ctrl-C. Callbacks run in the calling thread; other threads of Python
        go on while the run computes.

        Raises Stopped if the simulation stops itself, with the last good state, Error for files that
        cannot be written, and ValueError for a start that is not of finite numbers.
        """
        for ply in self.plies:
            _check_start(ply.name, "positions", ply.positions)
            _check_start(ply.name, "velocities", ply.velocities)
        folder = None if output is None else Path(output)
        outcome = self._simulation.run(folder, progress, frame)
        self.result = Result(outcome.last, json.loads(outcome.summary), folder)
        return _ended(self.result, outcome.error)


def run(case: Case, threads: int | None = None, output: AnyPath | None = None,
        progress: ProgressCallback | None = None, frame: FrameCallback | None = None) -> Result:
    """Runs a case: `Simulation(case, threads).run(output, progress, frame)`."""
    return Simulation(case, threads).run(output, progress, frame)


def form_ply(case: Case, ply: int, threads: int | None = None,
             progress: ProgressCallback | None = None) -> Result:
    """One ply of a stack, formed alone as by accuracy="instant"; the only ply of the result.

    ply: its number, from 0. threads, progress: as of Simulation. Raises CaseError, also where a ply alone
    says nothing of the case, and IndexError.
    """
    alone = Case(case.file, accuracy="instant")
    alone._settings.update(case.settings)
    outcome = _plyform.form_ply(_sound(alone), ply, threads or 0, progress)
    return _ended(Result(outcome.last, json.loads(outcome.summary), None), outcome.error)


def read(folder: AnyPath, frame: int = -1) -> Result:
    """A state of a run from its folder: from 0, or from the end; energies of the state are NaN.

    Also of a run that goes on or was killed; the summary is then empty. Raises Error.
    """
    path = Path(folder)
    state = _plyform.read_frame(path / "results.h5", frame)
    try:
        summary = json.loads(read_text(path / "summary.json"))
    except FileNotFoundError:
        summary = {}
    except (ValueError, RecursionError) as problem:
        raise Error(f"{path / 'summary.json'}: {problem}") from problem
    if not isinstance(summary, dict):
        raise Error(f"{path / 'summary.json'}: is no summary of a run")
    return Result(state, summary, path)


def history(folder: AnyPath) -> dict[str, NDArray[np.float64]]:
    """The columns of history.csv by name, one value an output time. Raises Error."""
    file = Path(folder) / "history.csv"
    try:
        names, *rows = csv.reader(read_text(file).splitlines())
        values = np.array(rows, dtype=float).reshape(len(rows), len(names))
    except (OSError, ValueError, csv.Error) as problem:
        raise Error(f"{file}: {problem}") from problem
    return {name: values[:, i] for i, name in enumerate(names)}


def export(folder: AnyPath) -> list[Path]:
    """Writes `export/` in the folder of a run: NAME.vtu, .stl and .csv of each ply and .stl of each
    tool, all of the last state; returns the files. Raises Error.
    """
    return _plyform.export_results(Path(folder))


def difference(a: Result | Frame | AnyPath, b: Result | Frame | AnyPath,
               field: str = "shear_angle_deg") -> Difference:
    """How far a field of `a` is from that of `b`: results, states, or folders of runs.

    Values of triangles are evened out to nodes, and compared at the material's places, the nodes of
    `b` before forming: meshes may differ. Plies are compared in their order. In the unit of the
    field, one of PlyFrame.cell_fields with a number a triangle.

    Raises Error if the two have not as many plies, or a folder cannot be read; ValueError for
    another field.
    """
    return _plyform.difference(_frame_of(a), _frame_of(b), field)


def _frame_of(state: Result | Frame | AnyPath) -> Frame:
    if isinstance(state, Frame):
        return state
    return (state if isinstance(state, Result) else read(state)).frame
