# SPDX-License-Identifier: GPL-3.0-or-later
"""A process beside the workbench that reads cases with the program's own code: reader.py TOOLS MODULE LIMIT.
Requests come as lines of JSON, answers go as two lengths (uint32 of the JSON, uint64 of the bytes) and both.
It may go down on any file, or never come back: readers.py, which starts it, then starts another. SIGUSR1
says that nobody waits for an answer any more."""

import hashlib
import json
import os
import signal
import struct
import sys
import threading
import time
from pathlib import Path

NEWER = threading.Event()  # a newer request waits


def main() -> None:
    sys.path[:0] = [sys.argv[1], sys.argv[2]]
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a library prints is no answer
    threading.Thread(target=end_with_parent, args=(os.getppid(),), daemon=True).start()
    signal.signal(signal.SIGUSR1, lambda *_: NEWER.set())
    from workbench.scene.scene_bytes import finite
    try:
        import plyform
    except ImportError as problem:
        plyform, missing = None, f"Python's module cannot be loaded: {problem}"
    for line in sys.stdin.buffer:
        request = json.loads(line)
        NEWER.clear()
        signal.setitimer(signal.ITIMER_REAL, float(sys.argv[3]))  # also where no other thread gets a turn any more
        try:
            if plyform is None:
                raise ImportError(missing)
            said, content = ACTS[request["act"]](plyform, request)
        except Exception as problem:  # whatever it is, the page is told
            said, content = {"error": f"{type(problem).__name__}: {problem}"[:2000]}, b""
        words = json.dumps(finite(said)).encode()
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        answers.write(struct.pack("<IQ", len(words), len(content)) + words)
        answers.write(content)
        answers.flush()
        if plyform is None:  # the next process may find it
            return


def end_with_parent(parent: int) -> None:
    while os.getppid() == parent:
        time.sleep(1.0)
    os._exit(0)


def version_of(request: dict) -> str:
    return hashlib.sha256(Path(request["file"]).read_bytes()).hexdigest()[:16]


def scene(plyform, request: dict) -> tuple[dict, bytes]:
    from workbench.scene.scene_bytes import scene_bytes
    case = plyform.Case(request["file"])
    return {}, scene_bytes(case.scene(), version_of(request))


def draft(plyform, request: dict) -> tuple[dict, bytes]:
    """The scene with few facets in the place of very many; nothing if no tool has so many."""
    from workbench.scene.draft_tools import stand_ins
    from workbench.scene.scene_bytes import scene_bytes
    found = stand_ins(Path(request["file"]), Path(request["room"]))
    if not found:
        return {}, b""
    case = plyform.Case(request["file"], {f"tool.{number}.file": str(one.file) for number, one in found.items()})
    return {}, scene_bytes(case.scene(), version_of(request), found)


def check(plyform, request: dict) -> tuple[dict, bytes]:
    found = plyform.Case(request["file"]).check(quick=True)
    mistakes = [{name: getattr(one, name, "") for name in ("file", "line", "column", "key", "item", "value", "rule",
                                                           "remedy")} | {"text": str(one)}
                for one in found.mistakes]
    for one in mistakes:
        one["key"] = one["key"] or one["item"]
    placed = getattr(found, "warnings_at", None)
    warnings = [{"text": text} for text in found.warnings] if placed is None else [
        {"text": getattr(one, "text", str(one)), "key": getattr(one, "key", ""), "line": getattr(one, "line", 0)}
        for one in placed]
    return {"mistakes": mistakes, "warnings": warnings, "notes": list(found.notes),
            "assumed": list(found.assumed)}, b""


def outlook(plyform, request: dict) -> tuple[dict, bytes]:
    try:
        found = plyform.Case(request["file"]).outlook(request["threads"])
    except plyform.Error as problem:
        return {"outlook": None, "why": str(problem)[:2000]}, b""
    return {"outlook": {"lines": found.lines, "steps": found.steps, "step_s": found.step_s,
                        "estimated_s": found.estimated_s, "stop": found.stop}}, b""


def instant(plyform, request: dict) -> tuple[dict, bytes]:
    """The plies, each formed alone, of a case with some values changed, or the one asked for. Says `refused`,
    why, if it cannot be, and `newer` if it was ended."""
    from workbench.scene.scene_bytes import formed_bytes
    case = plyform.Case(request["file"], request["settings"], accuracy="instant")
    how = {"threads": request["threads"], "progress": lambda _: not NEWER.is_set()}
    ply = request["ply"]
    try:
        result = plyform.run(case, **how) if ply is None else plyform.form_ply(case, ply, **how)
    except plyform.CaseError as problem:
        return {"refused": str(problem.mistakes[0])[:2000]}, b""
    except plyform.Error as problem:
        return {"refused": str(problem)[:2000]}, b""
    if result.status == "interrupted":
        return {"newer": True}, b""
    return {}, formed_bytes(result, ply or 0)


ACTS = {"scene": scene, "draft": draft, "check": check, "outlook": outlook, "instant": instant}

if __name__ == "__main__":
    main()
