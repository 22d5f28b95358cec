#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""One table (Markdown) of what plyform_bench measures, with the limits of the machine and of the
design beside it. docs/verification/speed.md says what each figure means.

    report.py PROGRAM [-r REPETITIONS] [--filter REGEX] [--json FILE]
    report.py FILE.json

Runs the program, or reads what it wrote with --benchmark_format=json. Of repeated measurements
the fastest counts: other work on the machine only ever adds. Exit code 0 unless the program or the
file cannot be read.
"""

import argparse
import json
import subprocess
import sys
from pathlib import Path

LIMITS = {"element_stream": 3.0, "element_ns": 10.0}  # times the stream; ns on one core
CACHES = {"16": "16 kB", "256": "256 kB", "8192": "8 MB", "262144": "256 MB"}


def run(program: str, repetitions: int, chosen: str) -> dict:
    command = [program, "--benchmark_format=json", f"--benchmark_filter={chosen}",
               f"--benchmark_repetitions={repetitions}"]
    return json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)


def fastest(data: dict) -> dict[str, dict]:
    """The fastest repetition of each benchmark, by its name without the number of repetitions."""
    best: dict[str, dict] = {}
    for b in data["benchmarks"]:
        if b.get("run_type") == "aggregate" or b.get("error_occurred"):
            continue
        name = "/".join(p for p in b["name"].split("/")
                        if not p.startswith(("repeats:", "iterations:")))
        if name not in best or measure(b) < measure(best[name]):
            best[name] = b
    return best


def measure(b: dict) -> float:
    """What decides which repetition is fastest."""
    for key in ("wall_ns_an_element", "ns_a_triangle", "wall_s"):
        if key in b:
            return b[key]
    for key in ("GB_s", "Gflop_s"):
        if key in b and "of_stream" not in b:
            return -b[key]
    return b["cpu_time"]


def count(n: float) -> str:
    return f"{n / 1e6:.1f} M" if n >= 999.5e3 else f"{n / 1e3:.0f} k"


def number(value: float) -> str:
    return f"{value:.3g}" if value < 1000 else f"{value:.0f}"


def judged(value: float, limit: float) -> str:
    return f"{number(value)} ({'at most' if value <= limit else '**over**'} {limit:g})"


def machine_lines(best: dict) -> list[str]:
    lines = []
    for name, b in best.items():
        if name.startswith("Bandwidth/"):
            size = CACHES.get(name.split("/")[1], name.split("/")[1] + " kB")
            lines.append(f"- one core streams {size}: {number(b['GB_s'])} GB/s")
        if name.startswith("Arithmetic"):
            lines.append(f"- one core computes ({b.get('label', '')}): {number(b['Gflop_s'])} Gflop/s")
    return lines


Row = tuple[str, str, str, str, str]  # part, triangles, ns a triangle, times its stream, more


def element_rows(best: dict) -> list[Row]:
    rows = []
    for name, b in best.items():
        kind, size = b.get("label", ""), count(b.get("triangles", 0))
        if name.startswith("ElementSimd/"):
            rows.append((f"element, {kind}", size, judged(b["ns_an_element"], LIMITS["element_ns"]),
                         judged(b["of_stream"], LIMITS["element_stream"]),
                         f"{100 * b['of_peak']:.0f} % of the arithmetic"))
        if name.startswith("ElementForces/"):
            rows.append((f"element one by one, {kind}", size, number(b["ns_an_element"]), "", ""))
        if name.startswith("Bending"):
            how = "bending" if name.startswith("BendingLanes") else "bending one by one"
            rows.append((f"{how}, {kind}", size, number(b["ns_an_element"]), "", ""))
    return rows


def contact_rows(best: dict) -> list[Row]:
    rows = []
    for name, b in best.items():
        size = count(b["triangles"]) if "triangles" in b else ""
        if name.startswith("ContactStep/"):
            rows.append((f"contact, {b.get('label', '')}", size, number(b["ns_an_element"]),
                         number(b["of_stream"]), f"{number(b['ns_a_point'])} ns a point"))
        if name.startswith("Search"):
            part = "larger sheet" if name.startswith("SearchLarger") else "finer mesh"
            rows.append((f"search, {part}", size, number(b["ns_a_triangle"]), "",
                         f"{number(b['ns_a_triangle_log_n'])} ns by log2 n, "
                         f"{b['faces_a_node']:.1f} faces a node"))
        if name.startswith("TreeBuild"):
            rows.append(("tree, once a run", size, number(b["ns_a_triangle"]), "", ""))
        if name.startswith("Audit"):
            rows.append(("exact audit, once a run", size, number(b["ns_a_triangle"]), "", ""))
    return rows


def step_rows(best: dict) -> list[Row]:
    rows, alone = [], {}
    for name, b in best.items():
        if not name.startswith("WholeStep/"):
            continue
        size, threads = count(b["triangles"]), int(b["threads"])
        more = ""
        if threads == 1:
            alone[size] = b
            more = f"{number(b['memory_a_triangle'])} bytes of memory a triangle"
        elif size in alone:
            ratio = alone[size]["wall_ns_an_element"] / b["wall_ns_an_element"]
            more = f"{ratio:.2f} times as fast as one"
        rows.append((f"whole step, {threads} thread{'s' if threads > 1 else ''}", size,
                     number(b["cpu_ns_an_element"]), number(b["of_stream"]), more))
    return rows


def run_lines(best: dict) -> list[str]:
    """Whole runs with tools as shapes, and with the same tools as meshes."""
    shapes, meshes = best.get("WholeRun/meshes:0"), best.get("WholeRun/meshes:1")
    if not shapes or not meshes:
        return []
    return [f"\nTools as meshes of {count(meshes['facets'])} facets, two threads: "
            f"{meshes['wall_s']:.1f} s for {shapes['wall_s']:.1f} s as shapes "
            f"({meshes['wall_s'] / shapes['wall_s']:.2f} times), processor time "
            f"{meshes['cpu_s'] / shapes['cpu_s']:.2f} times."]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", help="plyform_bench, or a file of its results")
    parser.add_argument("-r", "--repetitions", type=int, default=3)
    parser.add_argument("--filter", default=".", help="benchmarks to run (default: all)")
    parser.add_argument("--json", help="where to keep the results")
    a = parser.parse_args()
    try:
        if a.source.endswith(".json"):
            data = json.loads(Path(a.source).read_text())
        else:
            data = run(a.source, a.repetitions, a.filter)
        if a.json:
            Path(a.json).write_text(json.dumps(data))
    except (OSError, ValueError, subprocess.CalledProcessError) as error:
        print(f"report.py: error: {a.source}: {error}", file=sys.stderr)
        return 1
    best = fastest(data)
    context = data["context"]
    print(f"{context['processor']}, {context['num_cpus']} processors, "
          f"{context['date'][:10]}, load {', '.join(f'{l:.1f}' for l in context['load_avg'])}\n")
    print("\n".join(machine_lines(best)))
    print("\n| part | triangles | ns of CPU a triangle | times its stream | more |\n|---|---|---|---|---|")
    for row in element_rows(best) + contact_rows(best) + step_rows(best):
        print(f"| {' | '.join(row)} |")
    print("\n".join(run_lines(best)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
