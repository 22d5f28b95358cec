#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the mesh of a tool from a solid of a STEP or IGES file, for shape = "mesh".

    mesh_tool.py PART.step [--deflection 0.05] [--minutes 10] [-o punch.stl]

The STL is in mm, closed, its triangles outward; how far they are from the surface of the part is
measured and printed. Exit codes: 0 done, 2 an argument or the part is wrong, 1 anything else.
"""

import argparse
import os
import signal
import sys
from multiprocessing import get_context
from pathlib import Path

try:
    import gmsh  # noqa: F401
    import numpy as np

    from exchange.arguments import NotReached, ended
    from exchange.read_cad import Facets, read_solid, signed_volume
    from plotting.reading import Trouble
    from plotting.whole_file import make_whole
except ImportError as error:
    sys.exit(f"mesh_tool: error: {error}; install python3-gmsh, python3-numpy and python3-scipy")


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="mesh_tool.py", description=__doc__.split("\n", 1)[0])
    parser.add_argument("part", type=Path, metavar="PART",
                        help="a solid: .step, .stp, .iges or .igs")
    parser.add_argument("--deflection", type=float, default=0.05, metavar="MM",
                        help="largest distance between triangles and surface [0.05]")
    parser.add_argument("--minutes", type=float, default=10.0, metavar="MINUTES",
                        help="to give up after [10]")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE.stl",
                        help="[the part's name with .stl, in this folder]")
    options = parser.parse_args()
    options.output = options.output or Path(options.part.stem + ".stl")
    return options


def check(options: argparse.Namespace) -> None:
    if not 1e-4 <= options.deflection <= 10:
        raise Trouble(f"--deflection {options.deflection:g}: 0.0001 to 10 mm")
    if not 0 < options.minutes <= 1e5:
        raise Trouble(f"--minutes {options.minutes:g}: a positive number, 100000 at most")
    if options.output.suffix.lower() != ".stl":
        raise Trouble(f"{options.output}: an .stl file is written: end its name with .stl")


def read_quietly(part: Path, deflection: float, answer) -> None:
    """In a process of its own: without what Open CASCADE prints, and ended by a signal at once."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.dup2(nowhere, 2)
    try:
        answer.send(read_solid(part, deflection))
    except Exception as problem:  # to be raised again where it is told
        answer.send(problem)


def solid_of(part: Path, deflection: float, minutes: float) -> Facets:
    """Raises Trouble, also where Open CASCADE ends its process or comes to no end."""
    ours, theirs = get_context("fork").Pipe(duplex=False)
    process = get_context("fork").Process(target=read_quietly, args=(part, deflection, theirs))
    process.start()
    theirs.close()
    try:
        if not ours.poll(60.0 * minutes):
            raise Trouble(f"{part}: Open CASCADE has come to no end after {minutes:g} minutes: heal the "
                          "part in the CAD program, or give a larger --deflection or more --minutes")
        answer = ours.recv()
    except EOFError:
        raise Trouble(f"{part} cannot be read: Open CASCADE came to an end on it: export the part "
                      "anew") from None
    finally:
        process.kill()
        process.join()
    if isinstance(answer, Exception):
        raise answer
    return answer


def write_stl(path: Path, facets: Facets) -> None:
    corners = facets.x[facets.triangles].astype("<f4")
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-30)[:, None]
    rows = np.zeros(len(corners), dtype=[("n", "<f4", 3), ("x", "<f4", (3, 3)), ("end", "<u2")])
    rows["n"], rows["x"] = normals, corners
    head = b"mm, made by plyform mesh_tool.py".ljust(80, b" ")
    path.write_bytes(head + np.uint32(len(rows)).tobytes() + rows.tobytes())


def tell(part: Path, facets: Facets) -> None:
    away = facets.deviation
    low, high = facets.x.min(axis=0), facets.x.max(axis=0)
    size, first, last = (" x ".join(f"{value:.6g}" for value in high - low),
                         *(", ".join(f"{value:.6g}" for value in point) for point in (low, high)))
    made_of = "faces sewn to one solid" if facets.sewn else "one solid"
    volume = signed_volume(facets.x, facets.triangles)
    print(f"{part.name}: {made_of}, unit of the file {facets.unit}, taken in mm: {size} mm, from "
          f"({first}) to ({last})")
    print(f"{len(facets.triangles)} triangles, closed, outward; volume {volume:.6g} mm3, that of the "
          f"part {facets.volume:.6g} mm3 ({100 * (volume / facets.volume - 1):+.3f} %)")
    print(f"deviation of the triangles from the surface: largest {away.max():.4f} mm, rms "
          f"{np.sqrt((away ** 2).mean()):.4f} mm, at {len(away)} points of the surface")


def run() -> None:
    options = arguments()
    check(options)
    facets = solid_of(options.part, options.deflection, options.minutes)
    tell(options.part, facets)
    print(make_whole(options.output, lambda path: write_stl(path, facets)))
    if facets.deviation.max() > options.deflection:
        raise NotReached(f"the largest deviation is {facets.deviation.max():.4f} mm, more than "
                         f"--deflection {options.deflection:g}: allow more, or look whether the part "
                         "has faces with edges that do not fit")


def main() -> None:
    ended("mesh_tool", run)


if __name__ == "__main__":
    main()
