#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the mesh of a tool from a solid of a STEP or IGES file, or die and punch from one part, for
shape = "mesh".

    mesh_tool.py PART.step [--deflection 0.05] [--minutes 10] [-o punch.stl]
    mesh_tool.py PART.step --offset T | --stack CASE | --run RESULTS [--on die] [--solid part] [...]

The STL is in mm, closed, its triangles outward; how far they are from the surface of the part is
measured and printed. With room for the stack, PART_die.stl and PART_punch.stl are made of an open shell
or of one skin of a solid: one tool on it, the other so far away. Exit codes: 0 done, 2 an argument or the
part is wrong, 1 anything else.
"""

import argparse
import os
import signal
import sys
import time
from collections.abc import Callable
from multiprocessing import get_context
from pathlib import Path

try:
    import gmsh  # noqa: F401
    import numpy as np

    from base.progress import Progress
    from exchange.arguments import NotReached, ended
    from exchange.cad_facets import Say
    from exchange.cad_sheet import Asked, Room
    from exchange.offset_tools import lines_of, make_tools, unit_direction, worst_error
    from exchange.orient_facets import signed_volume
    from exchange.read_cad import Facets, read_solid
    from exchange.stack_room import room_of_case, room_of_run, same_room
    from plotting.reading import Trouble
    from plotting.whole_file import make_whole
except ImportError as error:
    sys.exit(f"mesh_tool: error: {error}; install python3-gmsh, python3-numpy and python3-scipy")


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="mesh_tool.py", description=__doc__.split("\n", 1)[0])
    parser.add_argument("part", type=Path, metavar="PART",
                        help="a solid, or with --offset, --stack or --run an open shell too: .step, .stp, "
                        ".iges or .igs")
    parser.add_argument("--deflection", type=float, default=0.05, metavar="MM",
                        help="largest distance between triangles and surface [0.05]")
    parser.add_argument("--minutes", type=float, default=10.0, metavar="MINUTES",
                        help="to give up after [10]")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE.stl",
                        help="[the part's name with .stl, in this folder]; of two tools FILE_die.stl and "
                        "FILE_punch.stl")
    two = parser.add_argument_group("die and punch from one part")
    room = two.add_mutually_exclusive_group()
    room.add_argument("--offset", type=float, metavar="MM", help="room between them")
    room.add_argument("--stack", type=Path, metavar="CASE",
                      help="room for the plies of a case, as thick as before forming")
    room.add_argument("--run", type=Path, metavar="DIR",
                      help="room for the plies of a run, as thick as they are formed, by place")
    two.add_argument("--shear", type=float, default=0.0, metavar="DEGREES",
                     help="with --stack: as thick as plies that are sheared so [0]")
    two.add_argument("--factor", type=float, default=1.0, help="with --stack or --run: times the room [1]")
    two.add_argument("--on", choices=["die", "punch"], default="die",
                     help="the tool that lies on the part's surface [die]")
    two.add_argument("--solid", choices=["part", "tool"], default="",
                     help="what a solid is: the formed part with its thickness, or the tool of --on")
    two.add_argument("--direction", type=float, nargs=3, default=[0.0, 0.0, -1.0],
                     metavar=("X", "Y", "Z"), help="of pressing, from the punch to the die [0 0 -1]")
    two.add_argument("--backing", type=float, default=20.0, metavar="MM",
                     help="depth of the bodies behind the surfaces; 0: surfaces alone [20]")
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


def check_room(options: argparse.Namespace) -> None:
    if options.offset is not None and not 1e-3 <= options.offset <= 1000:
        raise Trouble(f"--offset {options.offset:g}: 0.001 to 1000 mm")
    if not 0 <= options.shear <= 80 or (options.shear and options.stack is None):
        raise Trouble(f"--shear {options.shear:g}: 0 to 80 degrees, with --stack")
    if not 0.1 <= options.factor <= 10 or (options.factor != 1 and options.offset is not None):
        raise Trouble(f"--factor {options.factor:g}: 0.1 to 10, with --stack or --run")
    if not 0 <= options.backing <= 1e4:
        raise Trouble(f"--backing {options.backing:g}: 0 to 10000 mm")


def room_of(options: argparse.Namespace) -> Room | None:
    """None: one tool is to be made."""
    check_room(options)
    if options.offset is not None:
        return same_room(options.offset, "--offset")
    if options.stack is not None:
        return room_of_case(options.stack, options.factor, options.shear)
    return room_of_run(options.run, options.factor) if options.run is not None else None


def work_quietly(act: Callable[[Say], object], answer) -> None:
    """In a process of its own: without what Open CASCADE prints, and ended by a signal at once. Sends
    fractions and words of what it does, then what `act` returns or raises."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.dup2(nowhere, 2)
    try:
        answer.send((True, act(lambda *step: answer.send((False, step)))))
    except Exception as problem:  # to be raised again where it is told
        answer.send((True, problem))


def made_apart(part: Path, minutes: float, act: Callable[[Say], object]):
    """Raises Trouble, also where Open CASCADE ends its process or comes to no end."""
    ours, theirs = get_context("fork").Pipe(duplex=False)
    process = get_context("fork").Process(target=work_quietly, args=(act, theirs))
    process.start()
    theirs.close()
    end, over, answer = time.monotonic() + 60.0 * minutes, False, None
    try:
        with Progress(f"mesh_tool: {part.name}", staged=True) as progress:
            while not over:
                if not ours.poll(max(end - time.monotonic(), 0.0)):
                    raise Trouble(f"{part}: the work has come to no end after {minutes:g} minutes: "
                                  "heal the part in the CAD program, or give a larger --deflection or "
                                  "more --minutes")
                over, answer = ours.recv()
                if not over:
                    progress.show(*answer)
    except EOFError:
        raise Trouble(f"{part} cannot be read: Open CASCADE came to an end on it: export the part "
                      "anew") from None
    finally:
        process.kill()
        process.join()
    if isinstance(answer, Exception):
        raise answer
    return answer


def write_stl(path: Path, x: np.ndarray, triangles: np.ndarray) -> None:
    corners = x[triangles].astype("<f4")
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


def make_one(options: argparse.Namespace) -> None:
    facets = made_apart(options.part, options.minutes,
                        lambda say: read_solid(options.part, options.deflection, say))
    tell(options.part, facets)
    print(make_whole(options.output, lambda path: write_stl(path, facets.x, facets.triangles)))
    if facets.deviation.max() > options.deflection:
        raise NotReached(f"the largest deviation is {facets.deviation.max():.4f} mm, more than "
                         f"--deflection {options.deflection:g}: allow more, or look whether the part "
                         "has faces with edges that do not fit")


def make_two(options: argparse.Namespace, room: Room) -> None:
    asked = Asked(options.deflection, unit_direction(options.direction), options.on, options.solid, room)
    tools = made_apart(options.part, options.minutes,
                       lambda say: make_tools(options.part, asked, options.backing, say))
    die, punch = (options.output.with_name(f"{options.output.stem}_{which}.stl")
                  for which in ("die", "punch"))
    print("\n".join(lines_of(options.part, asked, tools, (die, punch))))
    for name, body in ((die, tools.die), (punch, tools.punch)):
        print(make_whole(name, lambda path, body=body: write_stl(path, body.x, body.triangles)))
    if worst_error(tools) > options.deflection:
        raise NotReached(f"surfaces and room are {worst_error(tools):.4f} mm off at most, more than "
                         f"--deflection {options.deflection:g}: allow more, or look whether the part has "
                         "faces with edges that do not fit")


def run() -> None:
    options = arguments()
    check(options)
    room = room_of(options)
    if room is None:
        make_one(options)
    else:
        make_two(options, room)


def main() -> None:
    ended("mesh_tool", run)


if __name__ == "__main__":
    main()
