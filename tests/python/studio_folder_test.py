# SPDX-License-Identifier: GPL-3.0-or-later
"""Folders that somebody else has sent, opened in the workbench: studio_folder_test.py TOOLS PROGRAM. Nothing in
them is started, no link of theirs is followed, and no file of theirs holds the server up or ends it."""

import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from studio_server import Server  # skips

sys.path.insert(0, sys.argv[1])
from workbench.server.peer import TABLE, may_ask, user_of  # noqa: E402

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


def keys_without_end(place):
    """A key of many parts takes a parser time with their square: the folder is shown, and the file refused."""
    folder = place / "deep"
    folder.mkdir()
    parts = 4 << 18
    texts = {"key": "a." * parts + "a = 1", "header": "[" + "a." * parts + "a]", "quoted": '"a".' * (parts // 2) + "a = 1",
             "inline": "x = { " + "a . " * (parts // 2) + "a = 1 }", "lists": "x = " + "[" * parts}
    for name, text in texts.items():
        (folder / f"{name}.toml").write_text('[[tool]]\nname = "t"\n' + text + "\n")
    with Server(TOOLS, PROGRAM, folder) as server:
        begin = time.monotonic()
        assert len(server.get("api/folder")["cases"]) == len(texts)
        for path in ("api/studies", "api/study/cases", "api/identify/files"):
            server.get(path)
        for name in texts:
            told = server.get("api/case", path=f"{name}.toml")
            assert told["tree"] is None and told["error"], told
            status, said = server.call("GET", "api/check", query={"path": f"{name}.toml", "version": told["version"]})
            assert status == 200 and said["mistakes"] or status in (422, 500), said
        taken = time.monotonic() - begin
        assert taken < 60, taken
        print(f"  keys without end: {taken:.1f} s")


def files_elsewhere(place):
    """Nothing outside the folder is read, by whatever way a page can ask."""
    secret = place / "secret"
    secret.mkdir()
    (secret / "picture.png").write_bytes(b"the secret")
    (secret / "study.toml").write_text('title = "the secret"\ncase = "c.toml"\nmethod = "grid"\n')
    folder = place / "reading"
    with Server(TOOLS, PROGRAM, folder) as server:
        case = server.send("api/cases", {"name": "mine"})["path"]
        (folder / "link.toml").symlink_to(secret / "study.toml")
        for path in ("api/studies", "api/study/cases", "api/identify/files", "api/results/offers", "api/folder"):
            told = json.dumps(server.get(path))
            assert "secret" not in told and "link.toml" not in told, (path, told)
        for name in (f"web/{secret}/picture.png", f"report/{secret}/picture.png", f"codemirror/{secret}/picture.png"):
            assert server.call("GET", name)[0] == 404, name
        (folder / case).write_text((folder / case).read_text() + f'[[tool]]\nname="t"\nshape="mesh"\nfile="{secret}/x.stl"\n')
        results = folder / "results/one"
        results.mkdir(parents=True)
        (results / "results.h5").write_bytes(b"")
        (folder / "trim.csv").write_text("0,0\n")
        for method, path, query, body in (
                ("GET", "api/study/keys", {"case": case}, None), ("POST", "api/cases", {}, {"name": "copy", "from": case}),
                ("POST", "api/results/export", {}, {"what": "pattern", "folder": "results/one", "trim": "trim.csv",
                                                    "case": case})):
            status, said = server.call(method, path, body, query=query)
            assert status == 403 and "leads out" in said["error"], (path, status, said)


def damaged(place):
    """Files of commands and runs with anything in them: told of, and what looks at them again and again goes on."""
    folder = place / "damaged"
    processes = sent(folder, [record_of(1, ["true"], launched=True), record_of(2, ["true"], launched=True, begun="x"),
                              record_of(3, ["true"], about={"output": ["results/a"]}), record_of(4, "true"),
                              {**record_of(5, ["true"]), "id": "000001"}])
    (processes / "000001.end").write_text('{"code": "x", "ended": "y", "pid": [], "stops": {}}')
    (processes / "000002.run").write_text("[]")
    contents = {"progress.json": ("{}", "[]", '{"pid": 1, "case": 5}', '{"pid": 1e9}', "{", '{"pid": -1, "phase": []}'),
                "summary.json": ("{}", "[]", '{"status": []}', '{"status": "done", "plies": 5, "tools": {}}', "{", "9" * 5000),
                "results.h5": ("", "HDF"), "history.csv": ("", "\0\0")}
    for name, texts in contents.items():
        for number, text in enumerate(texts):
            (folder / f"results/{name}_{number}").mkdir(parents=True, exist_ok=True)
            (folder / f"results/{name}_{number}" / name).write_text(text)
    for path, place_ in (("jobs.json", "{"), ("table.csv", "a,b\n1,\"" + "x" * 200_000)):
        (folder / f"results/study_{path}/runs").mkdir(parents=True)
        (folder / f"results/study_{path}" / path).write_text(place_)
    with Server(TOOLS, PROGRAM, folder) as server:
        for path in ("api/processes", "api/runs", "api/results", "api/studies", "api/folder"):
            server.get(path)
        for run in server.get("api/runs"):
            for route in ("runs/messages", "runs/bodies", "runs/state", "results/files", "study/table"):
                status, said = server.call("GET", f"api/{route}", query={"folder": run["folder"]})
                assert status in (200, 403, 404, 409, 422), (route, run, said)
        status, said = server.call("GET", "api/study/table", query={"folder": "results/study_table.csv"})
        assert status == 422 and "table.csv" in said["error"], said


def disk_is_full(place):
    """No file can be longer: nothing is changed by halves, nothing of it stays behind, and it is told."""
    server = Server(TOOLS, PROGRAM, place / "full")
    server.command = ["/usr/bin/prlimit", "--fsize=6000", *server.command]
    with server:
        case = server.send("api/cases", {"name": "mine"})["path"]
        seen, k = server.get("api/case", path=case), 0
        while (answer := server.call("PATCH", "api/case", {"version": seen["version"], "edits": [
                {"op": "set", "key": "tool.0.stroke", "value": 10.0 + k}]}, query={"path": case}))[0] == 200:
            seen, k = answer[1], k + 1
            assert k < 100
        assert answer[0] == 500 and "too large" in answer[1]["error"], answer
        now = server.get("api/case", path=case)
        assert (now["text"], now["version"]) == (seen["text"], seen["version"]) and k > 1
        status, said = server.call("PUT", "api/case", {"text": "# " + "x" * 7000, "version": now["version"]},
                                   query={"path": case})
        assert status == 500 and server.get("api/case", path=case)["text"] == seen["text"], said
        left = [path.name for path in server.folder.rglob("*") if "part_" in path.name]
        assert not left, left
        assert server.call("POST", "api/upload", b"x" * 9000, query={"name": "a.stl"})[0] == 500
        assert not (server.folder / "a.stl").exists() and not list((server.folder / ".plyform/uploads").iterdir())


def folder_goes_away(place):
    """While it is open: told, and again there when it is."""
    folder = place / "away"
    with Server(TOOLS, PROGRAM, folder) as server:
        case = server.send("api/cases", {"name": "mine"})["path"]
        folder.rename(place / "elsewhere")
        for path in ("api/folder", "api/runs", "api/results", "api/studies", "api/processes"):
            status, said = server.call("GET", path)
            assert status == 200 or said["error"], (path, status, said)
        assert server.call("GET", "api/case", query={"path": case})[0] == 404
        assert server.call("POST", "api/runs", {"case": case})[0] == 404
        time.sleep(1.0)
        (place / "elsewhere").rename(folder)
        assert server.get("api/case", path=case)["tree"]


def lock_of_another(place):
    """It came with the folder, for all to read, and with the address of another workbench."""
    lock = place / "locked/.plyform/lock"
    lock.parent.mkdir(parents=True)
    lock.write_text("http://127.0.0.1:1/old/\n" * 100)
    lock.chmod(0o666)
    with Server(TOOLS, PROGRAM, place / "locked") as server:
        server.get("api/folder")
        assert lock.stat().st_mode & 0o777 == 0o600 and lock.read_text() == server.address + "\n"


def users(place):
    """By the system's table of connections; the server's side of one has the ports the other way round."""
    table = ("  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout inode\n"
             "   0: 0100007F:1F90 00000000:0000 0A 00000000:00000000 00:00000000 00000000  1000        0 1 1 0 10 0\n"
             "   1: 0100007F:1F90 0100007F:C350 01 00000000:00000000 00:00000000 00000000  1000        0 2 1 0 20 4\n"
             "   2: 0100007F:C350 0100007F:1F90 01 00000000:00000000 00:00000000 00000000  1001        0 3 1 0 20 4\n"
             "   3: 0100007F:C351 0100007F:1F90 06 00000000:00000000 03:00001770 00000000     0        0 0 3 0\n")
    assert [user_of(port, 8080, table) for port in (50000, 50001, 8080)] == [1001, None, None]
    with socket.create_server(("127.0.0.1", 0)) as there, socket.create_connection(there.getsockname()) as here:
        ports = here.getsockname()[1], there.getsockname()[1]
        assert user_of(*ports, TABLE.read_text()) == os.getuid() and may_ask(*ports)
        assert os.getuid() == 0 or not may_ask(1, ports[1])


def main():
    with tempfile.TemporaryDirectory() as made:
        place = Path(made)
        for part in (commands_that_wait, what_waits_here, links, keys_without_end, files_elsewhere, damaged, disk_is_full,
                     folder_goes_away, lock_of_another, users):
            part(place)
            print(part.__name__, "done")


if __name__ == "__main__":
    main()
