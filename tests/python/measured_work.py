# SPDX-License-Identifier: GPL-3.0-or-later
"""What the parts of measured.py share: runs of plyform, their results, curves that others measured.

A part is a function part(work) that returns its section of the page. Where `work.cheap` is true it
leaves out what takes long, and each line that it returns must stand in the page all the same.
"""

import json
import subprocess
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")  # draws into a file, needs no screen
import matplotlib.pyplot as plt  # noqa: E402

SOURCES = Path(__file__).resolve().parents[2]
MEASURED = SOURCES / "cases/measured"
CASES = SOURCES / "cases"
BLUE, ORANGE, GREEN, PURPLE, GREY = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#777777"
#: Error bars of one laboratory over its mean, smallest and largest (Cao et al. 2008).
ERROR_BARS = (0.05, 0.21)


@dataclass
class Fabric:
    """Yarns of a fabric of cases/fabrics, to which a law of shear is added; nothing else of it."""

    name: str
    surface_density: float  # g/m2
    thickness: float  # mm
    yarns: tuple  # warp, weft, 1/mm
    stiffness: float  # N per yarn, an estimate; no figure of frames and bias tests depends on it

    @classmethod
    def of(cls, file: str) -> "Fabric":
        data = tomllib.loads((CASES / f"fabrics/{file}.toml").read_text(encoding="utf-8"))
        return cls(data["name"].split(",")[0], data["surface_density"], data["thickness"],
                   (data["warp"]["density"], data["weft"]["density"]), data["warp"]["stiffness"])

    @property
    def cells(self) -> float:
        """Cells per mm2."""
        return self.yarns[0] * self.yarns[1]

    def text(self, shear: str = "") -> str:
        """A fabric file, without a law of shear unless it is given."""
        families = "".join(f"[{family}]\ndensity = {yarns}\nstiffness = {self.stiffness}\n"
                           for family, yarns in zip(("warp", "weft"), self.yarns))
        return f'name = "{self.name}"\nsurface_density = {self.surface_density}\n' \
            f"thickness = {self.thickness}\n{families}" + (f"[shear]\n{shear}\n" if shear else "")


PLAIN, TWILL = Fabric.of("glass_pp_plain"), Fabric.of("glass_pp_twill")


@dataclass
class Run:
    """Results of a run that ended."""

    folder: Path
    summary: dict = field(init=False)
    history: np.ndarray = field(init=False)

    def __post_init__(self) -> None:
        self.summary = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))
        self.history = np.genfromtxt(self.folder / "history.csv", delimiter=",", names=True)

    def ply(self, name: str, state: int = -1) -> tuple:
        """Triangles, places before and now (mm) and shear angles (degrees) of a state."""
        with h5py.File(self.folder / "results.h5") as file:
            count = len(file["time_s"])
            frame = file[f"frames/{state % count:06}/plies/{name}"]
            base = file[f"plies/{name}"]
            return base["triangles"][:], base["x0"][:], frame["x"][:], frame["shear_angle_deg"][:]

    @property
    def states(self) -> int:
        return len(self.history)

    def cost(self) -> str:
        """Triangles and steps: what computing time goes by, on any machine."""
        elements, steps = (f"{self.summary[key]:,}".replace(",", " ")
                           for key in ("elements", "steps"))
        return f"{elements} triangles, {steps} steps"


@dataclass
class Work:
    """One making of the page."""

    program: Path
    pictures: Path  # where they go; the page stands beside them
    folder: Path  # for runs and files on the way
    cheap: bool
    page: str = ""  # as it is, for what is cheap to be compared with it
    done: set = field(default_factory=set)  # names of runs, which parts may share

    def cell(self, title: str, row: list, column: int) -> float:
        """Number in the page's first row of a section that begins with these cells."""
        section = self.page.split(f"\n## {title}", 1)[1].split("\n## ", 1)[0]
        begin = "| " + " | ".join(map(str, row)) + " |"
        line = next(line for line in section.splitlines() if line.startswith(begin))
        text = line.strip("| ").split(" | ")[column]
        return float(text.split(",")[0].split()[0].rstrip("°%").replace("−", "-"))

    def holds(self, value: float, share: float, *place) -> None:
        """The page has this number there, but for a share of it."""
        known = self.cell(*place)
        assert abs(value - known) <= share * abs(known), f"{place}: {known} in the page, now {value}"

    def call(self, *arguments) -> subprocess.CompletedProcess:
        return subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True,
                              check=False)

    def run(self, name: str, case: Path, **changes) -> Run:
        """Runs a case with keys changed; a dot in a key is written as two underscores."""
        folder = self.folder / name
        if (folder / "summary.json").exists() and name in self.done:
            return Run(folder)
        self.done.add(name)
        sets = [part for key, value in changes.items()
                for part in ("--set", f"{key.replace('__', '.')}={value}")]
        done = self.call("run", case, "-o", folder, *sets)
        assert done.returncode == 0, f"{name}: {done.stderr or done.stdout}"
        return Run(folder)

    def write(self, name: str, text: str) -> Path:
        file = self.folder / name
        file.write_text(text, encoding="utf-8")
        return file

    def picture(self, name: str, figure) -> str:
        """Saves measured_NAME.png; what the page says in its place."""
        file = self.pictures / f"measured_{name}.png"
        figure.tight_layout()
        figure.savefig(file, dpi=80)
        plt.close(figure)
        return file.name


def columns_of(file: Path) -> dict:
    """Columns of a table by their names, NaN where a cell is empty."""
    lines = [line for line in file.read_text(encoding="utf-8").splitlines()
             if not line.startswith("#")]
    names = [name.strip() for name in lines[0].split(",")]
    rows = np.genfromtxt(lines[1:], delimiter=",")
    return dict(zip(names, rows.T))


def table(head: list, rows: list) -> str:
    lines = ["| " + " | ".join(map(str, row)) + " |" for row in (head, ["---"] * len(head), *rows)]
    return "\n".join(lines).replace("| --- |", "|---|").replace(" --- |", "---|") + "\n"


def percent(share: float) -> str:
    """A deviation: +7 %, -0.4 %."""
    size = abs(100 * share)
    return f"{100 * share:+.{0 if size >= 9.95 else 1}f} %".replace("-", "−")


def number(value: float, digits: int = 3) -> str:
    return f"{value:#.{digits}g}".rstrip(".").replace("-", "−")
