# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scatter of a shear law between laboratories moves in a part: a section of a page.

    measured_scatter.py PROGRAM RESULTS PICTURES > SECTION     # runs what RESULTS lacks

Runs cases/studies/laboratory_scatter.toml into RESULTS, draws two pictures into the folder
PICTURES and writes the section's text; `part` does so for measured.py, which makes the page.
"""

import csv
import subprocess
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")  # draws into a file, needs no screen
import matplotlib.pyplot as plt  # noqa: E402

SOURCES = Path(__file__).resolve().parents[2]
STUDY = SOURCES / "cases/studies/laboratory_scatter.toml"
FABRICS = {"plain": "plain weave", "twill": "balanced twill"}
SIGNS = {"": "mean", " minus": "−1", " plus": "+1"}
FORCES = (300, 30)  # N, of the blank-holder
BLUE, ORANGE = "#0072B2", "#D55E00"
TITLE = "## What a laboratory's scatter means"


@dataclass
class Run:
    """A row of the study's table, and the field of its last state."""

    row: dict
    folder: Path

    def figure(self, name: str) -> float:
        return float(self.row[name])

    def field(self) -> np.ndarray:
        """x0, y0 in mm and shear_angle_deg of each triangle."""
        return np.genfromtxt(self.folder / "plies/ply.csv", delimiter=",", names=True)


def runs_of(program: Path, results: Path) -> dict[str, Run]:
    subprocess.run([sys.executable, SOURCES / "tools/study", STUDY, "--program", program.resolve(),
                    "-o", results], check=True, stdout=subprocess.DEVNULL)
    with open(results / "table.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        assert row["status"] == "done", f"{row['setting']}: {row['status']} {row['message']}"
    runs = {row["setting"]: Run(row, results / row["folder"]) for row in rows}
    named = {f"{fabric}{sign} {force}": f"fabric={fabric}{sign}, blank-holder force, N={force}"
             for fabric in FABRICS for sign in SIGNS for force in FORCES}
    return runs | {name: runs[setting] for name, setting in named.items()}


def moved(program: Path, run: Run, reference: Run) -> tuple[float, float]:
    """Degrees: difference of the shear angles, rms and what 99 % of the area have at most."""
    said = subprocess.run([program, "difference", run.folder, reference.folder], check=True,
                          capture_output=True, text=True).stdout.splitlines()
    values = dict(zip(said[0].split(","), said[1].split(",")))
    return float(values["rms"]), float(values["p99"])


def law(fabric: str, sign: str) -> tuple[np.ndarray, np.ndarray, float]:
    """Degrees, N mm a cell, cells per mm2."""
    name = f"cases/fabrics/glass_pp_{fabric}{sign.replace(' ', '_')}.toml"
    with open(SOURCES / name, "rb") as file:
        read = tomllib.load(file)
    table = np.array(read["shear"]["table"])
    return table[:, 0], table[:, 1], read["warp"]["density"] * read["weft"]["density"]


def measured(fabric: str) -> tuple[list[str], np.ndarray, np.ndarray]:
    """Names of curves, degrees, torque per area in N/mm."""
    path = SOURCES / f"cases/measured/picture_frame_{fabric}.csv"
    with open(path, encoding="utf-8") as file:
        names = file.readline().strip().split(",")[1:]
    rows = np.genfromtxt(path, delimiter=",", skip_header=1)
    return names, rows[:, 0], rows[:, 1:] * np.cos(np.radians(rows[:, :1]))


def draw_laws(picture: Path) -> None:
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.6))
    for axis, (fabric, title) in zip(axes, FABRICS.items()):
        names, angle, torque = measured(fabric)
        for mark, name, curve in zip("ov^sDPX", names, torque.T):
            axis.plot(angle, curve, mark, color="0.4", ms=4, mfc="none", label=name)
        bands = []
        for sign, said in SIGNS.items():
            angle, torque, cells = law(fabric, sign)
            bands.append(torque * cells)
            axis.plot(angle, torque * cells, color=BLUE if sign == "" else ORANGE, lw=1.4,
                      label=said + (" standard deviation" if sign else ""))
        axis.fill_between(angle, bands[1], bands[2], color=ORANGE, alpha=0.15, lw=0)
        axis.set(title=title, xlabel="shear angle, °", xlim=(0, 50), ylim=(0, None))
        axis.grid(alpha=0.3)
        axis.legend(fontsize=7)
    axes[0].set_ylabel("torque per area, N/mm")
    figure.tight_layout()
    figure.savefig(picture, dpi=75)
    plt.close(figure)


def draw_maps(picture: Path, runs: dict[str, Run]) -> None:
    shown_runs = (("plain", 300), ("plain", 30), ("twill", 30))
    figure, axes = plt.subplots(3, 3, figsize=(10, 9), layout="constrained")
    for line, (fabric, force) in zip(axes, shown_runs):
        mean = runs[f"{fabric} {force}"].field()
        for axis, sign in zip(line, SIGNS):
            shown = mean["shear_angle_deg"]
            limit, label = 50.0, "shear angle, °"
            if sign:
                shown = runs[f"{fabric}{sign} {force}"].field()["shear_angle_deg"] - shown
                limit, label = 3.0, "difference, °"
            drawn = axis.tripcolor(mean["x0"], mean["y0"], shown, cmap="RdBu_r", vmin=-limit,
                                   vmax=limit, rasterized=True)
            figure.colorbar(drawn, ax=axis, label=label, extend="both" if sign else "neither")
            said = f"{SIGNS[sign]} less mean" if sign else "mean"
            axis.set_title(f"{FABRICS[fabric]}, {force} N: {said}", fontsize=8)
            axis.set(aspect="equal", xticks=[-150, 0, 150], yticks=[-150, 0, 150])
    figure.savefig(picture, dpi=75)
    plt.close(figure)


def change(run: Run, mean: Run, name: str) -> str:
    return f"{100.0 * (run.figure(name) / mean.figure(name) - 1.0):+.1f} %".replace("-", "−")


def figures_of(run: Run) -> list[str]:
    return [f"{run.figure('punch_N'):.1f} N", f"{run.figure('largest_shear_deg'):.1f}°",
            f"{run.figure('p99_deg'):.1f}°", f"{run.figure('draw_in_mm'):.2f} mm",
            f"{run.figure('wrinkle_mm'):.2f} mm"]


def line_of(cells: list[str]) -> str:
    return "| " + " | ".join(cells) + " |\n"


def table_of(program: Path, runs: dict[str, Run]) -> str:
    head = ["fabric, blank-holder", "law", "punch", "largest shear", "99 % of the area",
            "draw-in, mean", "wrinkle", "shear moved, rms / 99 %"]
    text = line_of(head) + line_of(["---"] * len(head))
    for fabric, words in FABRICS.items():
        for force in FORCES:
            mean = runs[f"{fabric} {force}"]
            for sign, said in SIGNS.items():
                run = runs[f"{fabric}{sign} {force}"]
                cells = [f"{words}, {force} N" if sign == "" else "", said, *figures_of(run)]
                if sign:
                    cells[2] += f" ({change(run, mean, 'punch_N')})"
                    cells.append("{:.2f}° / {:.1f}°".format(*moved(program, run, mean)))
                else:
                    cells.append("")
                text += line_of(cells)
    return text


def beside_of(program: Path, runs: dict[str, Run]) -> str:
    mean = runs["plain 300"]
    text = line_of(["plain weave, mean, 300 N", "punch", "largest shear", "draw-in, mean",
                    "shear moved, rms / 99 %"]) + line_of(["---"] * 5)
    for name in ("yarns half as stiff", "bending half as stiff",
                 "in-plane bending half as stiff", "friction 0.25"):
        run = runs[name]
        said = figures_of(run)
        text += line_of([name, f"{said[0]} ({change(run, mean, 'punch_N')})", said[1], said[3],
                         "{:.2f}° / {:.1f}°".format(*moved(program, run, mean))])
    return text


def spread_of(fabric: str) -> str:
    """The deviation over the mean at 10 to 40 degrees."""
    angle, mean, _ = law(fabric, "")
    above = law(fabric, " plus")[1]
    return ", ".join(f"{100.0 * (above[angle == a][0] / mean[angle == a][0] - 1.0):.0f} % at {a}°"
                     for a in (10, 20, 30, 40))


def laws_of() -> str:
    """The section's title and first paragraph, which no run is needed for."""
    return f"""{TITLE}

Six laboratories measured the plain weave, three the twill. Their mean, and one standard deviation below and above it, are `cases/fabrics/glass_pp_plain.toml`, `_minus`, `_plus` and `glass_pp_twill*.toml`. One deviation of the torque is {spread_of("plain")} for the plain weave, {spread_of("twill")} for the twill.
"""


def part(work) -> str:
    """For measured.py: a Work of measured_work.py."""
    if work.cheap:
        return laws_of()
    return section(work.program, work.folder / "laboratory_scatter", work.pictures)


def section(program: Path, results: Path, pictures: Path) -> str:
    """Markdown, with pictures measured_scatter_laws.png and _shear.png in the folder PICTURES."""
    runs = runs_of(program, results)
    draw_laws(pictures / "measured_scatter_laws.png")
    draw_maps(pictures / "measured_scatter_shear.png", runs)
    others = [(fabric, sign, force) for fabric in FABRICS for sign in SIGNS if sign
              for force in FORCES]
    punch = [100.0 * abs(runs[f"{fabric}{sign} {force}"].figure("punch_N")
                         / runs[f"{fabric} {force}"].figure("punch_N") - 1.0)
             for fabric, sign, force in others]
    waves = [runs[f"twill{sign} 30"].figure("wrinkle_mm") for sign in SIGNS]
    loose = [moved(program, runs[f"twill{sign} 30"], runs["twill 30"])[0] for sign in SIGNS if sign]
    flat = [moved(program, runs[f"{fabric}{sign} {force}"], runs[f"{fabric} {force}"])[0]
            for fabric, sign, force in others if (fabric, force) != ("twill", 30)]
    friction = change(runs["friction 0.25"], runs["plain 300"], "punch_N")
    return f"""{laws_of()}
![Torque per area of each laboratory, their mean and one standard deviation](measured_scatter_laws.png)

A ply is drawn over the hemisphere (`cases/hemisphere_0/glass_pp.toml`) with each of the six laws, under a usual blank-holder and a light one; the study is `cases/studies/laboratory_scatter.toml`. All runs have one mesh.

{table_of(program, runs)}
![Shear angles with the mean law, and what one deviation moves](measured_scatter_shear.png)

- **The force follows the law.** The punch's force moves by {min(punch):.0f} to {max(punch):.0f} % with one deviation, less than the law does, as friction under the holder is in it too. From the law of one laboratory it is not known better than that.
- **The shape hardly does** while the flange lies flat: yarns are stiff and the tool is round, so the net has little choice. Shear moves by {min(flat):.1f} to {max(flat):.1f}° rms.
- **Unless the flange is free to choose.** Under 30 N the twill lifts the holder, in waves {min(waves):.1f} to {max(waves):.1f} mm high that are higher the stiffer its law is, and shear moves by {min(loose):.1f} to {max(loose):.1f}° rms with them. A case whose flange may wave should be run with all three files.

What else is uncertain, beside it: stiffness of yarns in tension and bending are estimates in these files, and friction, which is rarely measured for the fabric at hand, moves the force more ({friction} for a quarter of it) and the shape less than any.

{beside_of(program, runs)}
To do so for a part of yours: a study with the three files as values ([studies.md](../users/studies.md)), such as the one named above.
"""


def main() -> None:
    program, results, pictures = map(Path, sys.argv[1:4])
    pictures.mkdir(parents=True, exist_ok=True)
    print(section(program.resolve(), results.resolve(), pictures), end="")


if __name__ == "__main__":
    main()
