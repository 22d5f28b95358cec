# SPDX-License-Identifier: GPL-3.0-or-later
"""Folders that somebody else has sent, opened in the workbench: studio_folder_test.py TOOLS PROGRAM. Nothing in
them is started, no link of theirs is followed, and no file of theirs holds the server up or ends it."""

import json
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from studio_server import Server  # skips

TOOLS, PROGRAM = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()


def record_of(number, command, **more):
    return {"id": f"{number:06d}", "kind": "run", "words": "a run", "command": command, "cwd": "/", "about": {},
            "queued": 1.0, "in_queue": True, "launched": False, "order": float(number), **more}


def sent(folder, records):
    """A folder as it comes out of an archive."""
    processes = folder / ".plyform/processes"
    processes.mkdir(parents=True)
    for record in records:
        (processes / f"{record['id']}.json").write_text(json.dumps(record))
    return processes


def commands_that_wait(place):
    """Neither what waits, nor what another file says of it, nor what a run says that can go on, is started."""
    made = [place / f"made_{k}" for k in range(4)]
    touch = [["/usr/bin/touch", str(one)] for one in made]
    folder = place / "waiting"
    processes = sent(folder, [record_of(1, touch[0]), record_of(2, touch[1], seal="0" * 64),
                              record_of(3, touch[2], in_queue=False),
                              record_of(4, ["true"], launched=True)])
    (processes / "000004.run").write_text(json.dumps({"command": touch[3], "launched": False, "in_queue": True}))
    with Server(TOOLS, PROGRAM, folder) as server:
        states = {one["id"]: one["state"] for one in server.get("api/processes")}
        assert states == {f"{k:06d}": "lost" for k in (1, 2, 3, 4)}, states
        time.sleep(1.0)
        assert not any(one.exists() for one in made)
        own = server.send("api/cases", {"name": "mine"})["path"]
        begun = server.send("api/runs", {"case": own, "accuracy": "draft"})
        assert begun["id"] == "000005" and begun["own"]
        server.call("POST", f"api/processes/{begun['id']}/stop", {})


def what_waits_here(place):
    """In a copy of the folder it is not started a second time; here it is found again."""
    folder = place / "here"
    with Server(TOOLS, PROGRAM, folder) as server:
        case = server.send("api/cases", {"name": "mine"})["path"]
        for name in ("first", "second"):
            server.send("api/runs", {"case": case, "name": name, "threads": 1})
        server.stop(signal.SIGKILL)
        subprocess.run(["cp", "-r", folder, place / "copy"], check=True)
        with Server(TOOLS, PROGRAM, place / "copy") as copy:
            assert "queued" not in [one["state"] for one in copy.get("api/processes")]
        server.start()
        records = server.get("api/processes")
        assert not {one["state"] for one in records} - {"running", "starting", "queued", "done"}, records
        for record in reversed(records):
            server.call("POST", f"api/processes/{record['id']}/stop", {})
        ended(server)


def ended(server):
    end = time.monotonic() + 30
    while any(one["state"] in ("queued", "starting", "running") for one in server.get("api/processes")):
        assert time.monotonic() < end
        time.sleep(0.1)


def links(place):
    """In its own folder none is followed: a log would go into any file."""
    for name, number in (("processes/000002.log", 0), ("reports", 1), ("history", 2), ("lock", 3)):
        folder = place / f"linked_{number}"
        (folder / ".plyform/processes").mkdir(parents=True)
        (folder / ".plyform" / name).symlink_to(place / "target")
        done = subprocess.run([TOOLS / "studio", "--no-browser", "--program", PROGRAM, folder], capture_output=True,
                              text=True, timeout=60, check=False)
        assert done.returncode == 1 and "is a link" in done.stderr, done
    assert not (place / "target").exists()


def main():
    with tempfile.TemporaryDirectory() as made:
        place = Path(made)
        for part in (commands_that_wait, what_waits_here, links):
            part(place)
            print(part.__name__, "done")


if __name__ == "__main__":
    main()
