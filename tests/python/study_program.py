#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Stands for plyform in study_test.py: checks nothing but what it is told to refuse, and writes
made-up results at once.

Beside it lies orders.json: for a setting (contact.friction=0.3) "hang", "fail", "stop" or "refuse".
Each call of run adds a line to calls.txt: the settings that it was given."""

import json
import os
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent


def orders(settings: list[str]) -> set[str]:
    told = json.loads((HERE / "orders.json").read_text(encoding="utf-8"))
    return {told[setting] for setting in settings if setting in told}


def run(words: list[str], settings: list[str]) -> int:
    assert words[words.index("--threads") + 1] == "1", words
    folder = Path(words[words.index("-o") + 1])
    with open(HERE / "calls.txt", "a", encoding="utf-8") as calls:
        calls.write(" ".join(settings) + "\n")
    order = orders(settings)
    while "hang" in order:
        time.sleep(0.02)
    if "fail" in order:
        print("made-up trouble", flush=True)
        os.abort()
    numbers = {key: float(value) for key, value in (one.split("=", 1) for one in settings)
               if value.replace(".", "").isdigit()}
    force = 100.0 + 50.0 * numbers.get("contact.friction", 0.2) + \
        numbers.get("tool.2.force", 300.0) / 100.0
    status = "stopped" if "stop" in order else "done"
    summary = {"status": status, "message": "made up" if status == "stopped" else "", "steps": 10,
               "wall_time_s": 0.5, "elements": 20,
               "plies": [{"name": "lower", "max_shear_deg": 40.0 + force / 100.0},
                         {"name": "upper", "max_shear_deg": 39.0}],
               "tools": [{"name": "punch", "force_N": force}]}
    (folder / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
    return 3 if status == "stopped" else 0


def main() -> int:
    words = sys.argv[1:]
    settings = [after for word, after in zip(words, words[1:]) if word == "--set"]
    if words[0] == "version":
        print("plyform made-up")
    elif words[0] == "keys":
        print("contact.friction\n    number; default 0.2; >= 0\n    friction")
    elif words[0] == "check":
        if "refuse" in orders(settings):
            print("--set:1:18: error: contact.friction = 9: must not be that; give less",
                  file=sys.stderr)
            return 2
        print("estimated time 0 s")
    else:
        return run(words, settings)
    return 0


if __name__ == "__main__":
    sys.exit(main())
