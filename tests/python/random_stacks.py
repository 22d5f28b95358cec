#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Forms stacks of plies at angles drawn at random as cases/hemisphere_five_ply does, with the die's
clearance to suit, and checks that no run stops and no triangles of different plies cross.

    tests/python/random_stacks.py PROGRAM [--plies 1 5 10 20] [--seeds 1] [--element-size 6.8]
                           [--friction 0.2] [-o FOLDER]

--friction random draws one for the tools and one for each two neighbours, 0.05 to 0.4. Goes on
where it stopped; --again repeats what has ended. tools/real_cloth.py stacks runs ten seeds of real
cloth, with tables. Exits with 1 if a run does not end soundly."""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
from plotting.reading import Trouble, ended, read_summary  # noqa: E402
from sweeps.runs import ENDED, Folder, Run, Runner  # noqa: E402
from sweeps.stacks import case_text, stack_run  # noqa: E402, F401


def sound(folder: Folder, run: Run) -> bool:
    """Prints a line; whether the stack is sound."""
    if folder.status(run) not in ENDED:
        print(f"{run.label}: no results", flush=True)
        return False
    told = read_summary(folder.of(run))
    contact, shear = told["contact"], max(ply["max_shear_deg"] for ply in told["plies"])
    crossing = contact["intersections_between_plies"] + contact["intersections_within_plies"]
    print(f"{run.label}: {told['status']}, {told['elements']} triangles, {told['steps']} steps, "
          f"{told['wall_time_s']:.0f} s, crossing {crossing}, "
          f"depth {contact['max_tool_penetration_mm']:.3f} / "
          f"{contact['max_ply_penetration_mm']:.3f} mm, largest shear {shear:.1f} deg, "
          f"balance {told['energy']['balance_error']:.1e}", flush=True)
    return ended(told) and contact["intersections_between_plies"] == 0


def friction(text: str) -> float | str:
    return text if text == "random" else float(text)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("program", type=Path, help="plyform")
    parser.add_argument("--plies", type=int, nargs="+", default=[1, 5, 10, 20])
    parser.add_argument("--seeds", "--seed", type=int, nargs="+", default=[1])
    parser.add_argument("--element-size", type=float, default=6.8, help="mm")
    parser.add_argument("--friction", type=friction, default=0.2, help="a number, or random")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time")
    parser.add_argument("--again", action="store_true", help="repeat what has ended, too")
    parser.add_argument("-o", "--output", type=Path, default=Path("results/random_stacks"))
    options = parser.parse_args()
    folder = Folder(options.output)
    runs = [stack_run(count, seed, options.element_size, options.friction)
            for seed in options.seeds for count in options.plies]
    try:
        for trouble in Runner(options.program, folder, options.jobs).run_all(runs, options.again):
            print(trouble, flush=True)
        sys.exit(0 if all([sound(folder, run) for run in runs]) else 1)
    except (Trouble, OSError) as problem:
        sys.exit(f"random_stacks.py: error: {problem}")


if __name__ == "__main__":
    main()
