# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of a case with the blanks of flat patterns, until the formed edge lies at the trim line."""

import subprocess
from dataclasses import dataclass
from pathlib import Path

from base.files import read_json, read_toml
from base.progress import Progress
from plotting.reading import Trouble

from exchange.flat_pattern import Pattern, blend, edge_error, flat_pattern
from exchange.formed import FormedStack, read_formed
from exchange.outline import TrimLine


@dataclass
class Try:
    """A run with patterns as blanks."""
    number: int
    folder: Path
    largest: dict[str, float]  # mm, by ply: distance of the formed edge from the trim line
    rms: dict[str, float]
    patterns: list[Pattern]    # the blanks of this run

    def worst(self) -> float:
        return max(self.largest.values())

    def words(self) -> str:
        return (f"run {self.number}: formed edge within "
                + ", ".join(f"{value:.2f} mm ({name})" for name, value in self.largest.items())
                + " of the trim line")


@dataclass
class TrimCase:
    """The case that is run anew."""
    program: str
    path: Path
    settings: list[str]  # KEY=VALUE
    blanks: dict         # of the case file
    plies: list[dict]
    threads: int | None = None  # all cores

    def arguments(self, patterns: list[Pattern]) -> list[str]:
        """Each ply gets a blank of its own, meshed as the one it had, where the pattern lies."""
        words = [f"--set={setting}" for setting in self.settings]
        for pattern in patterns:
            index = next(k for k, ply in enumerate(self.plies) if ply["name"] == pattern.ply)
            blank = self.blanks[self.plies[index]["blank"]]
            points = ", ".join(f"[{x:.6f}, {y:.6f}]" for x, y in pattern.outline)
            kept = {"mesh": f'"{blank.get("mesh", "diagonal")}"',
                    "element_size": repr(float(blank["element_size"])), "outline": f"[{points}]"}
            table = ", ".join(f"{key} = {value}" for key, value in kept.items())
            words += [f"--set=blanks.trimmed_{index}={{{table}}}",
                      f"--set=ply.{index}.blank=trimmed_{index}",
                      f"--set=ply.{index}.seed=[0.0, 0.0]", f"--set=ply.{index}.rotation=0.0"]
        return words

    def element_size(self, ply: str) -> float:
        blank = next(one["blank"] for one in self.plies if one["name"] == ply)
        return float(self.blanks[blank]["element_size"])


def read_case(program: str, path: Path, settings: list[str], stack: FormedStack) -> TrimCase:
    """Raises Trouble if the case cannot have been the run's, or its blanks have no outline."""
    file = path / "case.toml" if path.is_dir() else path
    try:
        case = read_toml(file)
        blanks, plies = case["blanks"], case["ply"]
        names = [ply["name"] for ply in plies]
        for ply in stack.plies:
            if ply.name not in names:
                raise Trouble(f"{file} has no ply {ply.name}, which {stack.folder} has: give the "
                              "case of this run")
            blank = blanks[plies[names.index(ply.name)]["blank"]]
            if "element_size" not in blank:
                raise Trouble(f"{file}: the blank of ply {ply.name} is a mesh file, which cannot "
                              "be cut: give it an outline or a size")
        sizes = dict(word.split("=", 1) for word in settings if word.count("="))
        for name, blank in blanks.items():
            if f"blanks.{name}.element_size" in sizes:
                blank["element_size"] = sizes[f"blanks.{name}.element_size"]
            blank["element_size"] = float(blank.get("element_size", "nan"))
    except (KeyError, TypeError, AttributeError, ValueError) as problem:
        raise Trouble(f"{file} cannot be read as a case: {type(problem).__name__} {problem}; see what "
                      "plyform check says of it") from problem
    return TrimCase(program, path, settings, blanks, plies)


def run_with(case: TrimCase, patterns: list[Pattern], folder: Path) -> None:
    words = [case.program, "run", str(case.path), "-o", str(folder), *case.arguments(patterns)]
    words += ["--threads", str(case.threads)] if case.threads else []
    code, out, error = run_watched(words, folder)
    if code != 0:
        said = (error or out).strip().splitlines()
        raise Trouble(f"the run with the patterns in {folder} ended with code {code}: "
                      f"{said[-1] if said else 'nothing said'}")


def run_watched(words: list[str], folder: Path) -> tuple[int, str, str]:
    """Exit code, standard output and error of a run into `folder`."""
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process, \
            Progress(folder.name.replace("_", " ")) as progress:
        try:
            while True:
                try:
                    out, error = process.communicate(timeout=0.5)
                    return process.returncode, out, error
                except subprocess.TimeoutExpired:
                    progress.show(*progress_of_run(folder))
        except BaseException:
            process.kill()
            raise


def progress_of_run(folder: Path) -> tuple[float | None, str]:
    """What a run says in progress.json (docs/users/results.md): its fraction, and what it does."""
    try:
        now = read_json(folder / "progress.json")
    except Trouble:  # not there yet, or no more
        return None, ""
    now = now if isinstance(now, dict) else {}
    fraction = now.get("fraction")
    return (fraction if isinstance(fraction, float) else None), str(now.get("words", ""))


def iterate(case: TrimCase, stack: FormedStack, trim: TrimLine, tolerance: float, most: int,
            folder: Path, tell) -> tuple[Try, list[Try]]:
    """The run whose edges are nearest to the trim line, and all runs. Stops as soon as the edges of all
    plies are within `tolerance` mm, and after `most` runs. A pattern that made it worse is not gone on
    from: half of the step that led to it is taken from the best one, then a quarter. A run that comes to
    no end counts as one that made it worse, unless it is the first. Later steps are cut as far."""
    names = [ply.name for ply in stack.plies]
    wanted, best, step, tries = meshable(case, stack, trim), None, 1.0, []
    for number in range(1, most + 1):
        patterns = wanted if best is None else [blend(one, two, step)
                                                for one, two in zip(best.patterns, wanted)]
        run_folder = folder / f"iteration_{number}"
        try:
            run_with(case, patterns, run_folder)
            stack = read_formed(run_folder, -1, names)
        except Trouble as problem:
            if best is None:
                raise
            tell(f"run {number}: {problem}")
            step *= 0.5
            continue
        tries.append(measured(number, run_folder, stack, trim, patterns))
        tell(tries[-1].words())
        if best is not None and tries[-1].worst() >= best.worst():
            step *= 0.5
            continue
        best = tries[-1]
        if best.worst() <= tolerance or number == most:
            break
        try:
            wanted = meshable(case, stack, trim)
        except Trouble as problem:
            tell(f"no pattern comes of run {number}: {problem}")
            break
    return best, tries


def measured(number: int, folder: Path, stack: FormedStack, trim: TrimLine,
             patterns: list[Pattern]) -> Try:
    errors = {ply.name: edge_error(ply, trim) for ply in stack.plies}
    return Try(number, folder, {name: one[0] for name, one in errors.items()},
               {name: one[1] for name, one in errors.items()}, patterns)


def meshable(case: TrimCase, stack: FormedStack, trim: TrimLine) -> list[Pattern]:
    """The mesher keeps every point of an outline: they stand an element apart."""
    return [flat_pattern(ply, trim, case.element_size(ply.name)) for ply in stack.plies]
