#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What `plyform run` says of how far it is: a line on a pseudo-terminal that is wiped in the end, whole
lines elsewhere, and progress.json in the folder of results, whole whenever it is read, until the run
has ended.

    run_progress_test.py TOOLS PROGRAM CASES
"""

import json
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from on_terminal import on_terminal

KEYS = {"phase", "words", "fraction", "stroke_mm", "step", "elapsed_s", "remaining_s",
        "kinetic_over_shear", "balance_error", "states", "pid", "case"}
DURATION = 0.05  # s, simulated: some seconds


def arguments(program: str, cases: Path, duration: float, *more: str) -> list[str]:
    """Five plies, of elements of 13 mm."""
    return [program, "run", f"{cases}/hemisphere_five_ply", "--set",
            "blanks.square.mesh_from=element_size", "--set", "blanks.square.element_size=13",
            "--set", f"solver.duration={duration}", "--set", "tool.0.stroke=30", "--set",
            "solver.outputs=4", "--threads", "1",
            *more]


def read(file: Path) -> dict | None:
    """Of a file that is replaced meanwhile."""
    try:
        return json.loads(file.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return None


def watch(process: subprocess.Popen, file: Path) -> list[dict]:
    seen = []
    while process.poll() is None:
        now = read(file)
        if now is not None and (not seen or now != seen[-1]):
            seen.append(now)
        time.sleep(0.01)
    return seen


def terminal_text(words: list[str]) -> str:
    code, text = on_terminal(words, stdout=subprocess.DEVNULL)
    assert code == 0, text
    return text


def check_file(program: str, cases: Path, folder: Path, duration: float) -> float:
    """Returns how long the run took, s."""
    out, start = folder / "out", time.monotonic()
    file = out / "progress.json"
    process = subprocess.Popen(arguments(program, cases, duration, "-o", str(out)),
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    seen = watch(process, file)
    took = time.monotonic() - start
    assert process.returncode == 0 and not file.exists() and (out / "summary.json").exists()
    assert all(set(one) == KEYS and one["pid"] == process.pid for one in seen), seen
    assert all(one["case"] == f"{cases}/hemisphere_five_ply/case.toml" for one in seen), seen[0]
    forming = [one for one in seen if one["phase"] == "forming" and one["fraction"] is not None]
    assert len(forming) >= 2, seen
    for before, after in zip(forming, forming[1:]):
        assert after["elapsed_s"] - before["elapsed_s"] > 0.35, (before, after)
        assert before["fraction"] < after["fraction"] <= 1 and before["step"] < after["step"]
        assert before["states"] <= after["states"]
    last = forming[-1]
    assert 0 < last["stroke_mm"] and last["states"] >= 2 and last["remaining_s"] >= 0, last

    process = subprocess.Popen(arguments(program, cases, 100 * duration, "-o", str(out)),
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while read(file) is None:
        time.sleep(0.01)
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert read(file)["pid"] == process.pid  # who reads sees that it does not live
    process = subprocess.Popen(arguments(program, cases, 100 * duration, "-o", str(out)),
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while (read(file) or {}).get("phase") != "forming" or read(file)["pid"] != process.pid:
        time.sleep(0.01)
    process.send_signal(signal.SIGTERM)
    process.wait()
    assert not file.exists() and read(out / "summary.json")["status"] == "interrupted"

    blocked = folder / "blocked"  # it cannot be written or removed: no complaint
    (blocked / "progress.json" / "full").mkdir(parents=True)
    done = subprocess.run(arguments(program, cases, 0.02, "-o", str(blocked), "--set",
                                    "blanks.square.element_size=26"),
                          capture_output=True, text=True)
    assert done.returncode == 0 and "progress" not in done.stderr, done.stderr
    assert not (blocked / "progress.json.tmp").exists()
    return took


def check_phases(program: str, cases: Path, folder: Path) -> None:
    out = folder / "verified"
    process = subprocess.Popen(
        [program, "run", f"{cases}/verify/hemisphere_small.toml", "--verify", "-o", str(out), "--set",
         "blanks.square.mesh_from=scene"],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    phases = [one["phase"] for one in watch(process, out / "progress.json")]
    assert process.returncode == 0
    order = list(dict.fromkeys(phases))
    assert [phase for phase in order if phase != "checking"] == ["meshing", "forming", "verifying"], \
        order


def check_line(program: str, cases: Path, folder: Path, duration: float) -> None:
    run = arguments(program, cases, duration, "-o", f"{folder}/line")
    text = terminal_text(run)
    drawn = [line for line in text.split("\n") if "\033" in line]
    assert len(drawn) == 1, text  # others are of warnings
    before, *pieces, after = drawn[0].removesuffix("\r").split("\r")
    assert before == "" and len(pieces) > 3 and after.startswith("\033[Kplyform: doubtful"), text
    # how long it will take is not known at once
    assert all(re.match(r" *\d+ %(, \d+ s left)?, stroke \d.*\033\[K$", piece) and len(piece) < 83
               for piece in pieces), text
    assert sum(" s left, " in piece for piece in pieces) >= len(pieces) // 2, text
    told = []
    for longer in (1, 2, 4, 8):  # a line after some seconds each: how many, the machine decides
        lines = subprocess.run(arguments(program, cases, longer * duration, "-o", f"{folder}/line"),
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True).stderr
        assert "\r" not in lines and "\033" not in lines and lines.endswith("\n"), lines
        told = [line for line in lines.splitlines() if " left, stroke " in line]
        if told:
            break
    assert told and all(re.match(r" *\d+ %, \d+ s left.* balance [-+.e\d]+$", line)
                        for line in told), lines
    short = [program, "check", f"{cases}/picture_frame"]
    assert terminal_text(short) == ""


def main() -> None:
    program, cases = sys.argv[2], Path(sys.argv[3]).resolve()
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        took = check_file(program, cases, folder, DURATION)
        check_phases(program, cases, folder)
        check_line(program, cases, folder, DURATION * max(1.0, 8.0 / took))


if __name__ == "__main__":
    main()
