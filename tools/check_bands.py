#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the bands of plyform run --verify hold: each scene of a list is run with --verify and
again with all cost parameters halved, and the error that the two show stands beside the band.

    check_bands.py SCENES.toml [-o DIR] [--jobs N] [--program PLYFORM] [--table] [--doc TEXT]

SCENES.toml has tables [[scene]] with name, case (a file, seen from SCENES.toml) and set (a list of
KEY=VALUE). Halved are element sizes, the speed (twice solver.duration) and solver.fibre_softening;
each triangle of a mesh file (OFF) is cut into four.
With d the difference of the two runs, of shear its root mean square over the ply, the error of the
first is taken for

    e = d / (1 - 2^-p),   p = 1.6                                                          (1)

the Richardson extrapolation of the two with the order of the mesh, whose error is the largest. Those
of inertia (p = 3) and softening (p = 1) are smaller; of them e is 1.3 times too large or 0.75.

Forces that are given and draw-ins that are held are left out.

DIR [results/NAME of SCENES.toml] gets a folder a run, and bands.csv with a row a figure. What has
ended is not repeated: the same command goes on after any stop. --table runs nothing. --doc fills
the table into a text in Markdown, between <!-- table: NAME --> and <!-- end -->.

Exit codes: 0 done; 1 a run is missing, was stopped, or cannot be read; 2 wrong arguments or scenes.
"""

import argparse
import csv
import io
import shutil
import statistics
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

try:
    from base.ending import Mistake, ended
    from base.files import TEXT, check_file, read_text, read_toml
    from base.program import find_program
    from base.summary_file import SOUND, read_summary
    from compare import table
    from plotting.reading import Trouble
    from plotting.whole_file import write_whole
    from studies.case_values import CaseValues, FileHash
    from studies.text_table import MARK
except ImportError as error:
    sys.exit(f"check_bands.py: error: {error}; install python3-h5py")

ORDER = 1.6                               # p, core/verification/bands.hpp
HALVED = {"blanks.*.element_size": 0.5, "solver.duration": 2.0, "solver.fibre_softening": 0.5}
NOT_ASKED = ("given", "held")             # reasons for no band, core/verification/no_band.cpp
KINDS = {"shear": "angles", "force": "forces", "draw-in": "draw-ins", "largest": "compressions"}


@dataclass
class Scene:
    name: str
    case: Path
    settings: tuple[str, ...]


@dataclass
class Run:
    scene: Scene
    folder: Path
    settings: tuple[str, ...]
    verify: bool


@dataclass
class Figure:
    scene: str
    name: str
    unit: str
    value: float
    band: float | None                    # None: a part of the error was not measured
    error: float

    @property
    def kind(self) -> str:
        return KINDS[self.name.split(" ", 1)[0]]

    @property
    def beyond(self) -> bool:
        """Whether the band is wider than the figure: it says nothing."""
        return self.band is not None and not self.band <= abs(self.value)

    @property
    def inside(self) -> bool:
        return self.band is not None and self.error <= self.band  # false for NaN


def read_scenes(file: Path) -> list[Scene]:
    tables, scenes = read_toml(file).get("scene", []), []
    if not isinstance(tables, list) or not all(isinstance(one, dict) for one in tables):
        raise Mistake(f"{file}: scene is no list of tables; write each under [[scene]]")
    for number, one in enumerate(tables, 1):
        where = f"{file}: scene {number}"
        if set(one) - {"name", "case", "set"} or not {"name", "case"} <= set(one):
            raise Trouble(f"{where} has {', '.join(one)}; it takes name, case and set")
        settings = one.get("set", [])
        if not (isinstance(settings, list) and all(isinstance(text, str) for text in settings)):
            raise Trouble(f"{where}: set must be a list of texts KEY=VALUE")
        if not all(isinstance(one[key], str) and one[key] for key in ("name", "case")):
            raise Trouble(f"{where}: name and case must be texts")
        case = file.parent / one["case"]
        case = check_file(case / "case.toml" if case.is_dir() else case, TEXT)
        if one["name"] in (scene.name for scene in scenes):
            raise Trouble(f"{where}: there is another {one['name']}")
        scenes.append(Scene(one["name"], case, tuple(settings)))
    if not scenes:
        raise Trouble(f"{file} has no [[scene]]")
    return scenes


def cut_into_four(source: Path, target: Path) -> None:
    """A mesh in OFF with every triangle cut at the middles of its sides."""
    words = source.read_text(encoding="utf-8").split()
    if words[0] != "OFF":
        raise Trouble(f"{source} is no OFF; only such meshes can be halved")
    nodes, count = int(words[1]), int(words[2])
    points = [tuple(map(float, words[4 + 3 * i:7 + 3 * i])) for i in range(nodes)]
    middles: dict[tuple[int, int], int] = {}

    def middle(a: int, b: int) -> int:
        side = (min(a, b), max(a, b))
        if side not in middles:
            middles[side] = len(points)
            points.append(tuple(0.5 * (p + q) for p, q in zip(points[a], points[b])))
        return middles[side]

    triangles = []
    for i in range(count):
        a, b, c = map(int, words[5 + 3 * nodes + 4 * i:8 + 3 * nodes + 4 * i])
        ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
        triangles += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
    target.parent.mkdir(parents=True, exist_ok=True)
    lines = ["OFF", f"{len(points)} {len(triangles)} 0",
             *(" ".join(f"{value:.17g}" for value in point) for point in points),
             *(f"3 {a} {b} {c}" for a, b, c in triangles)]
    target.write_text("\n".join(lines) + "\n", encoding="utf-8")


def halved_meshes(scene: Scene, folder: Path) -> list[str]:
    """Settings that put finer meshes, written into the folder, in the place of mesh files."""
    settings = []
    blanks = read_toml(scene.case).get("blanks", {})
    for name, blank in blanks.items():
        if blank.get("mesh") == "file":
            source = scene.case.parent / blank["file"]
            fine = folder / f"{source.stem}-halved.off"
            cut_into_four(source, fine)
            settings.append(f"blanks.{name}.file='{fine}'")
    return settings


def halved(scene: Scene, program: Path, folder: Path) -> tuple[str, ...]:
    values = CaseValues(scene.case, scene.settings, program)
    settings = halved_meshes(scene, folder)
    for pattern, factor in HALVED.items():
        for key in values.keys(pattern):
            least = 1.0 if key.endswith("softening") else 0.0
            settings.append(f"{key}={max(factor * values.own(key), least):.9g}")
    return tuple(settings)


def version_of(program: Path) -> str:
    return subprocess.run([program, "version"], capture_output=True, text=True,
                          check=True).stdout.strip()


def folder_of(scene: Scene, kind: str, settings: tuple[str, ...], version: str,
              files: FileHash | None = None) -> str:
    """What changes a run changes its folder's name."""
    name = "".join(c if c.isalnum() or c in "._" else "_" for c in scene.name)
    return f"{name}-{kind}-{(files or FileHash()).of(scene.case, settings, version)}"


def runs_of(scenes: list[Scene], folder: Path, program: Path) -> list[tuple[Run, Run]]:
    """Of each scene the run with bands and the one with everything halved."""
    version, files, pairs = version_of(program), FileHash(), []
    for scene in scenes:
        def run(kind: str, more: tuple[str, ...], verify: bool, scene: Scene = scene) -> Run:
            settings = ("solver.outputs=1", *scene.settings, *more)
            return Run(scene, folder / folder_of(scene, kind, settings, version, files), settings,
                       verify)
        pairs.append((run("verified", (), True), run("halved", halved(scene, program, folder), False)))
    return pairs


def summary_of(run: Run) -> dict:
    """Empty if the run has not ended, or has no bands where it should."""
    try:
        summary = read_summary(run.folder, ("status", "plies", "tools"))
    except Trouble:
        return {}
    missing = summary["status"] == "interrupted" or (run.verify and "verification" not in summary)
    return {} if missing else summary


def do_run(run: Run, program: Path) -> None:
    if summary_of(run):
        return
    if (run.folder / "summary.json").is_file():
        shutil.rmtree(run.folder)  # interrupted among its siblings
    words = [word for setting in run.settings for word in ("--set", setting)]
    done = subprocess.run([program, "run", run.scene.case, "-o", run.folder, "--threads", "1",
                           "--resume", *words, *(["--verify"] if run.verify else [])],
                          capture_output=True, text=True, check=False)
    said = done.stderr.strip().splitlines()
    summary = summary_of(run)
    state = f"{summary['status']}, {summary.get('steps')} steps" if summary else said[-1] if said else "no results"
    print(f"{run.folder.name}: {state}", file=sys.stderr, flush=True)


def shear_differences(program: Path, run: Run, other: Run) -> dict[str, float]:
    """Degrees rms, by ply."""
    done = subprocess.run([program, "difference", run.folder, other.folder, "--by-ply"],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Trouble(done.stderr.strip())
    return {row["ply"]: float(row["rms"]) for row in csv.DictReader(done.stdout.splitlines())}


def scalars(summary: dict) -> dict[str, float]:
    """By the names that figures have."""
    found = {f"force of {tool['name']}": tool.get("force_N") for tool in summary["tools"]}
    for ply in summary["plies"]:
        found[f"draw-in of {ply['name']}"] = ply.get("draw_in_mm", {}).get("mean")
        pressed = ply.get("max_pressed_strain")
        found[f"largest compression of {ply['name']}"] = None if pressed is None else 100.0 * pressed
    return found


def figures_of(program: Path, first: Run, second: Run) -> list[Figure]:
    """Those of a scene, by (1)."""
    one, two = summary_of(first), summary_of(second)
    for run, summary in ((first, one), (second, two)):
        if summary.get("status") not in SOUND:
            raise Trouble(f"{run.folder}: {summary.get('message') or 'is missing'}")
    apart = {f"shear of {ply}": by for ply, by in shear_differences(program, first, second).items()}
    a, b = scalars(one), scalars(two)
    apart |= {name: abs(a[name] - b[name]) for name in a
              if a[name] is not None and b.get(name) is not None}
    try:
        return [Figure(first.scene.name, figure["name"], figure["unit"], figure["value"],
                       figure["band"], apart[figure["name"]] / (1.0 - 2.0**-ORDER))
                for figure in one["verification"]["figures"]
                if figure["name"] in apart and not figure.get("no_band", "").startswith(NOT_ASKED)]
    except KeyError as problem:
        raise Trouble(f"{first.folder}: its bands, or the other run, lack {problem}") from problem


def ratio(figures: list[Figure]) -> float:
    """Band over error, in the median."""
    known = [f.band / f.error if f.error > 0.0 else float("inf")
             for f in figures if f.band is not None]
    return statistics.median(known) if known else float("nan")


def cells(figures: list[Figure]) -> list[str]:
    """Inside of how many, and the median of the band over the error."""
    if not figures:
        return ["–", "–"]
    known = [f for f in figures if f.band is not None]
    if not known:
        return [f"– of 0 ({len(figures)} without)", "–"]
    without = f" ({len(figures) - len(known)} without)" if len(known) < len(figures) else ""
    return [f"{sum(f.inside for f in known)} of {len(known)}{without}", f"{ratio(known):.1f}"]


def markdown(figures: list[Figure]) -> str:
    """A row a scene; then all; then each figure outside of its band."""
    columns = ("angles", "forces", "draw-ins", "compressions")
    head = ["scene", "error of angles, °",
            *(text for kind in columns for text in (f"{kind} inside", "band / error"))]
    rows = []
    for name in [*dict.fromkeys(f.scene for f in figures), None]:
        own = [f for f in figures if name in (None, f.scene)]
        errors = [f.error for f in own if f.kind == "angles"]
        rows.append([name or "**all**", f"{min(errors):.2f} to {max(errors):.2f}",
                     *(text for kind in columns
                       for text in cells([f for f in own if f.kind == kind]))])
    asked = [f for f in figures if f.kind in ("angles", "forces")]
    known = [f for f in asked if f.band is not None]
    share = 100.0 * sum(f.inside for f in known) / len(known) if known else float("nan")
    banded = [f for f in figures if f.band is not None]
    lines = [table(head, rows, 1),
             f"Of angles and forces {share:.0f} % are "
             f"inside; the band is {ratio(known):.1f} times the error in the median."]
    if banded:
        lines[-1] += (f" Of all {len(banded)} figures with a band "
                      f"{100.0 * sum(f.inside for f in banded) / len(banded):.0f} % are inside; "
                      f"{sum(f.beyond for f in banded)} have a band beyond the figure.")
    if without := len(asked) - len(known):
        lines[-1] += f" {without} of {len(asked)} have no band."
    if outside := [f for f in figures if f.band is not None and not f.inside]:
        lines.append("Outside: " + "; ".join(
            f"{f.scene}, {f.name}: {f.value:.4g} ± {f.band:.2g} {f.unit}, error {f.error:.2g}"
            for f in outside) + ".")
    return "\n\n".join(lines)


def fill(text: Path, name: str, inner: str) -> None:
    before = read_text(text)
    if ("table", name) not in MARK.findall(before):
        raise Trouble(f"{text} has no place for this; write a line <!-- table: {name} -->")
    write_whole(text, MARK.sub(lambda match: match[0] if match[2] != name else
                               f"<!-- table: {name} -->\n\n{inner}\n\n<!-- end -->\n", before),
                rewrite=True)


def write_csv(file: Path, figures: list[Figure]) -> None:
    out = io.StringIO()
    writer = csv.writer(out)
    writer.writerow(["scene", "figure", "unit", "value", "band", "error", "inside"])
    for f in figures:
        writer.writerow([f.scene, f.name, f.unit, f.value, "" if f.band is None else f.band,
                         f.error, int(f.inside)])
    write_whole(file, out.getvalue())


def check(options: argparse.Namespace) -> int:
    program, scenes = find_program(options.program), read_scenes(options.scenes)
    folder = (options.output or Path("results") / options.scenes.stem).resolve()
    pairs = runs_of(scenes, folder, program)
    if not options.table:
        with ThreadPoolExecutor(options.jobs) as pool:
            for kind in (0, 1):
                list(pool.map(lambda pair, kind=kind: do_run(pair[kind], program), pairs))
    figures, missing = [], []
    for pair in pairs:
        try:
            figures += figures_of(program, *pair)
        except Trouble as problem:
            missing.append(str(problem))
    for line in missing:
        print(f"check_bands.py: {line}", file=sys.stderr)
    if not figures:
        return 1
    write_csv(folder / "bands.csv", figures)
    print(markdown(figures))
    if options.doc:
        fill(options.doc, options.scenes.stem, markdown(figures))
    return 1 if missing else 0


def parser_of(name: str, text: str) -> argparse.ArgumentParser:
    """With the arguments that lists of scenes have in common."""
    parser = argparse.ArgumentParser(prog=name, description=text.split("\n\n", 1)[0])
    parser.add_argument("scenes", type=Path, metavar="SCENES.toml")
    parser.add_argument("-o", "--output", type=Path, metavar="DIR", help="[results/SCENES]")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="at a time [1]")
    parser.add_argument("--program", type=Path, metavar="PLYFORM",
                        help="[build/release of this source tree, or the one installed]")
    parser.add_argument("--doc", type=Path, metavar="TEXT", help="fill the table into a text, too")
    return parser


def parsed(parser: argparse.ArgumentParser) -> argparse.Namespace:
    options = parser.parse_args()
    if options.jobs < 1:
        parser.error("--jobs must be at least 1")
    return options


def arguments() -> argparse.Namespace:
    parser = parser_of("check_bands.py", __doc__)
    parser.add_argument("--table", action="store_true", help="of what has ended, run nothing")
    return parsed(parser)


def main() -> None:
    ended("check_bands.py", lambda: check(arguments()))


if __name__ == "__main__":
    main()
