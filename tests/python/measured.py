# SPDX-License-Identifier: GPL-3.0-or-later
"""plyform beside what others measured: a page, its simulations and pictures.

    measured.py PROGRAM FOLDER [--only PART] [--keep RUNS]    # writes FOLDER/measured.md and pictures
    measured.py PROGRAM FOLDER --check     # makes what takes seconds; answers 1 if the page differs

FOLDER is docs/verification. --only makes anew one part and leaves the others as they are; --keep
has runs and files on the way in a folder that stays. Leaves with 77 when NumPy, h5py or matplotlib
is missing.
"""

import argparse
import sys
import tempfile
import time
from pathlib import Path

try:
    import measured_bending
    import measured_bias
    import measured_frame
    import measured_scatter
    import measured_sphere
    import measured_two_ply
    from measured_work import Work
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)

PARTS = {"frames": measured_frame.part, "loads": measured_bias.loads_part,
         "angles": measured_bias.angles_part, "bending": measured_bending.part,
         "sphere": measured_sphere.part, "two_ply": measured_two_ply.part,
         "scatter": measured_scatter.part}
#: How their titles begin.
TITLES = {"frames": "Frames", "loads": "A bias specimen", "angles": "Angle in the middle",
          "bending": "Cantilever", "sphere": "The exact net", "two_ply": "Two plies",
          "scatter": measured_scatter.TITLE[3:]}
HEAD = "# plyform beside what others measured\n\n" \
    "Made by `tests/python/measured.py PROGRAM docs/verification` with its pictures; no figure " \
    "is typed. The curves are in [cases/measured](../../cases/measured/README.md), with their " \
    "sources. What published forming experiments lack to stand here says " \
    "[published.md](published.md).\n"


def title_of(section: str) -> str:
    return section.lstrip().split("\n", 1)[0]


def sections_of(page: str) -> dict:
    """Sections of a page by their titles."""
    return {title_of("## " + text): "## " + text.rstrip() + "\n"
            for text in page.split("\n## ")[1:]}


def made(work: Work, only: str) -> dict:
    sections = {}
    for name, part in PARTS.items():
        if only in (None, name):
            start = time.perf_counter()
            sections[name] = part(work)
            print(f"{name}: {time.perf_counter() - start:.0f} s", file=sys.stderr)
    return sections


def missing_lines(page: str, sections: dict) -> list:
    """Lines that were made and do not stand in the section of the same title."""
    there = sections_of(page)
    return [f"{name}: {line}" for name, section in sections.items()
            for line in section.splitlines()
            if line and line not in there.get(title_of(section), "").splitlines()]


def main() -> None:
    parser = argparse.ArgumentParser(prog="measured.py", description=__doc__.split("\n", 1)[0])
    parser.add_argument("program", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", choices=PARTS)
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    page = options.folder / "measured.md"
    before = page.read_text(encoding="utf-8") if page.exists() else ""
    with tempfile.TemporaryDirectory() as scratch:
        runs = options.keep or Path(scratch)
        runs.mkdir(parents=True, exist_ok=True)
        work = Work(options.program.resolve(), options.folder.resolve(), runs.resolve(),
                    options.check, before)
        sections = made(work, options.only)
    if options.check:
        missing = missing_lines(before, sections)
        sys.exit("\n".join([f"{page} is stale: make it anew", *missing]) if missing else 0)
    old = sections_of(before)
    order = [title_of(sections[name]) if name in sections else
             next((title for title in old if title.startswith(f"## {TITLES[name]}")), None)
             for name in PARTS]
    new = {title_of(section): section.rstrip() + "\n" for section in sections.values()}
    sections_in_order = [(old | new)[title] for title in order if title]
    page.write_text("\n".join([HEAD, *sections_in_order]), encoding="utf-8")


main()
