# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases in the workbench: studio_cases_test.py TOOLS PROGRAM. Made, changed from two sides, taken back,
checked, drawn; a process that dies or hangs in between."""

import asyncio
import json
import os
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from studio_server import Server  # skips

sys.path.insert(0, sys.argv[1])
import websockets  # noqa: E402
from workbench.scene.coarser import coarser  # noqa: E402
from workbench.scene.readers import Worker  # noqa: E402
from workbench.scene.reading import module_of  # noqa: E402
from workbench.project.arrays import unpacked  # noqa: E402
from workbench.project.project import Refused  # noqa: E402

TOOLS, PROGRAM = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
CASE = "first/case.toml"
FABRIC = "first/glass_plain_weave.toml"


class Page:
    """What an open page hears."""

    def __init__(self, server):
        self.events, self.ready, self.loop = [], threading.Event(), asyncio.new_event_loop()
        self.address = server.address.replace("http:", "ws:") + "events"
        self.origin = server.origin
        self.thread = threading.Thread(target=self.loop.run_until_complete, args=(self.listen(),), daemon=True)
        self.thread.start()
        assert self.ready.wait(20)

    async def listen(self):
        async with websockets.connect(self.address, origin=self.origin) as socket:
            self.ready.set()
            try:
                async for message in socket:
                    self.events.append(json.loads(message))
            except websockets.ConnectionClosed:
                pass

    def heard(self, kind, seconds=20.0, **what):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for event in self.events:
                if event["kind"] == kind and all(event.get(key) == value for key, value in what.items()):
                    return event
            time.sleep(0.02)
        raise AssertionError(f"no {kind} {what}: {self.events[-5:]}")


def made_and_listed(server):
    assert server.get("api/folder")["cases"] == []
    assert server.send("api/cases", {"name": "first"}) == {"path": CASE}
    assert server.call("POST", "api/cases", {"name": "first"})[0] == 409
    assert server.call("POST", "api/cases", {"name": "../x"})[0] == 422
    assert server.call("POST", "api/cases", {"name": "x", "from": "example:../x"})[0] == 404
    names = [one["name"] for one in server.get("api/examples")]
    assert "hemisphere_five_ply" in names and "circular_table/circular_table_bending" in names
    assert "double_dome" not in names  # its tools are made first
    server.send("api/cases", {"name": "five", "from": "example:hemisphere_five_ply"})
    server.send("api/cases", {"name": "copied", "from": "five/case.toml"})
    tree = server.get("api/case", path="copied/case.toml")["tree"]
    assert tree["fabrics"]["glass"] == "../five/glass_plain_weave.toml"
    found = server.get("api/folder")
    assert [one["path"] for one in found["cases"]] == ["copied/case.toml", CASE, "five/case.toml"]
    assert {one["name"] for one in found["fabrics"]} == {"glass plain weave"}


def stepped(server, way):
    return server.send(f"api/case/{way}", {"version": server.get("api/case", path=CASE)["version"]}, path=CASE)


def changed_and_taken_back(server):
    begun = server.get("api/case", path=CASE)
    assert begun["error"] is None and not begun["can_undo"] and not begun["can_redo"]
    edit = {"op": "set", "key": "tool.punch.stroke", "value": 20}
    once = server.send("api/case", {"version": begun["version"], "edits": [edit]}, "PATCH", path=CASE)
    assert once["tree"]["tool"][0]["stroke"] == 20 and once["made"] == ["tool.0.stroke"] and once["can_undo"]
    assert (server.folder / CASE).read_text() == once["text"] != begun["text"]
    other = {"op": "set", "key": "tool.punch.stroke", "value": 21}
    stale = {"version": begun["version"], "edits": [other]}
    assert server.call("PATCH", "api/case", stale, query={"path": CASE})[0] == 409
    status, said = server.call("PATCH", "api/case", {**stale, "base": begun["text"]}, query={"path": CASE})
    assert (status, said["clashes"][0]["what"]) == (409, "tool.punch.stroke") and said["now"]["text"] == once["text"]
    twice = server.send("api/case", {"version": once["version"], "text": once["text"] + "# more\n"}, "PUT", path=CASE)
    status, said = server.call("PUT", "api/case", {"version": twice["version"], "text": "[ply\n"}, query={"path": CASE})
    assert status == 422 and said["line"] == 1 and said["column"] > 1 and said["error"], said
    assert server.get("api/case", path=CASE)["text"] == twice["text"]
    server.stop(signal.SIGKILL)
    server.start()  # earlier texts are found again
    assert stepped(server, "undo")["text"] == once["text"]
    back = stepped(server, "undo")
    assert back["text"] == begun["text"] and not back["can_undo"] and back["can_redo"]
    assert server.call("POST", "api/case/undo", {"version": back["version"]}, query={"path": CASE})[0] == 409
    assert server.call("POST", "api/case/redo", {"version": once["version"]}, query={"path": CASE})[0] == 409
    assert stepped(server, "redo")["text"] == once["text"]
    again = stepped(server, "redo")
    assert again["text"] == twice["text"] and not again["can_redo"]
    stepped(server, "undo")


def two_pages(server):
    one, other = Page(server), Page(server)
    now = server.get("api/case", path=CASE)
    server.call("GET", "api/check", query={"path": CASE, "version": now["version"]})
    edit = {"op": "set", "key": "title", "value": "two pages"}
    after = server.send("api/case", {"version": now["version"], "edits": [edit]}, "PATCH", path=CASE)
    for page in (one, other):
        page.heard("case", path=CASE, version=after["version"])
    text = after["text"] + "# by an editor\n"
    (server.folder / CASE).write_text(text)
    other.heard("case", path=CASE, version=server.get("api/case", path=CASE)["version"])
    assert server.call("PATCH", "api/case", {"version": after["version"], "edits": [edit]}, query={"path": CASE})[0] == 409
    assert server.call("POST", "api/case/undo", {"version": after["version"]}, query={"path": CASE})[0] == 409
    assert stepped(server, "undo")["text"] == after["text"]  # that of the editor
    undone = server.get("api/case", path=CASE)["version"]
    server.call("GET", "api/check", query={"path": CASE, "version": undone})
    fabric = server.folder / FABRIC
    fabric.write_text(fabric.read_text() + "# changed\n")
    one.heard("case", path=CASE, version=undone, others={FABRIC: server.get("api/case", path=FABRIC)["version"]})
    (server.folder / "dropped.stl").write_text("solid a\nendsolid a\n")
    one.heard("folder")


def told_by_the_program(server):
    now = server.get("api/case", path=CASE)
    said = server.get("api/check", path=CASE, version=now["version"])
    assert said["mistakes"] == [] and said["version"] == now["version"]
    page = Page(server)
    end = time.monotonic() + 120
    while (said := server.get("api/check", path=CASE, version=now["version"]))["outlook"] is None:
        assert time.monotonic() < end, page.events
        time.sleep(0.2)
    assert said["outlook"]["steps"] > 100 and any("stable step" in line for line in said["outlook"]["lines"])
    edits = [{"op": "set", "key": "tool.punch.radius", "value": -1}, {"op": "remove", "key": "ply.0.angle"}]
    broken = server.send("api/case", {"version": now["version"], "edits": edits}, "PATCH", path=CASE)
    said = server.get("api/check", path=CASE, version=broken["version"])
    keys = {one["key"]: one for one in said["mistakes"]}
    assert set(keys) == {"tool.0.radius", "ply.0.angle"} or set(keys) == {"tool.punch.radius", "ply.ply1.angle"}, keys
    radius = next(one for key, one in keys.items() if key.endswith("radius"))
    line = broken["text"].split("\n")[radius["line"] - 1]
    assert radius["file"] == CASE and line.startswith("radius = -1"), radius
    assert str(server.folder) not in json.dumps(said)
    assert server.call("GET", "api/check", query={"path": CASE, "version": now["version"]})[0] == 409
    stepped(server, "undo")
    rows = {row["key"]: row for row in server.get("api/keys")}
    assert rows["tool[].radius"]["unit"] == "mm" and len(rows) > 150


def drawn(server):
    now = server.get("api/case", path="five/case.toml")
    status, content = server.call("GET", "api/scene", query={"path": "five/case.toml", "version": now["version"]})
    if status == 500 and "no attribute 'scene'" in content["error"]:
        print("this build of the module has no scenes: they are not tested")
        return
    assert status == 200, content
    length = struct.unpack("<I", content[:4])[0]
    header, arrays = json.loads(content[4:4 + length]), 4 + length + -length % 4
    assert [ply["key"] for ply in header["plies"]] == [f"ply.{k}" for k in range(5)]
    for body in [*header["plies"], *header["tools"]]:
        x, triangles = body["x"], body["triangles"]
        nodes = struct.unpack_from(f"<{triangles['count']}I", content, arrays + triangles["at"])
        assert max(nodes) == x["count"] // 3 - 1 and (x["type"], triangles["type"]) == ("f4", "u4")
    punch, _, holder = header["tools"]
    assert abs(punch["gap"]["mm"]) < 1e-3 and punch["first_contact"]["ply"] == "ply5" and holder["shifts"] is None
    last = struct.unpack_from("<3f", content, arrays + punch["shifts"]["at"] + 4 * (punch["shifts"]["count"] - 3))
    assert abs(last[2] + 75) < 1e-3 and punch["shares"][-1] == 1 and header["missing"] == []


def formed_at_once(server):
    wish = {"path": "five/case.toml", "version": server.get("api/case", path="five/case.toml")["version"]}
    for change, plies in (({}, range(5)), ({"key": "ply.1.angle", "value": 33}, [1])):
        content = server.get("api/instant", **wish, **change)
        header = json.loads(content[4:4 + struct.unpack("<I", content[:4])[0]])
        assert [ply["key"] for ply in header["plies"]] == [f"ply.{k}" for k in plies] and header["told_deg"] > 0
        assert all(20 < ply["p99_deg"] < 60 for ply in header["plies"]), header
    assert server.call("GET", "api/instant", query={**wish, "key": "tool.0.file", "value": 1})[0] == 422


def taken_in(server):
    """Files that are dropped in, and what they become."""
    def upload(name, content, **query):
        status, said = server.call("POST", "api/upload", content, query={"name": name, "folder": "first", **query})
        assert status == 200, said
        return said

    row = struct.pack("<12fH", *[0.0] * 3, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0)
    stl = bytes(80) + struct.pack("<I", 1) + row
    assert upload("a.stl", stl) == {"path": "first/a.stl", "kind": "mesh", "size": len(stl)}
    status, said = server.call("POST", "api/upload", stl, query={"name": "a.stl", "folder": "first"})
    assert status == 409, said
    there = said["clashes"][0]["now"]
    assert upload("a.stl", stl, replace=there)["path"] == "first/a.stl"
    status, said = server.call("POST", "api/upload", stl, query={"name": "a.stl", "folder": "first", "replace": there})
    assert status == 409 and "written meanwhile" in said["error"], said
    tool = server.send("api/import", {"path": "first/a.stl", "as": "tool", "unit": "inch", "case": CASE})
    assert tool["value"] == {"shape": "mesh", "file": "a.stl", "scale": 25.4} and tool["facets"] == 1
    assert max(abs(a - b) for a, b in zip(tool["box_mm"][1], [25.4, 50.8, 0])) < 1e-9
    upload("b.stl", b"solid b\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1\nvertex 1 0 1\nvertex 0 3 1\nendloop\n"
           b"endfacet\nendsolid b\n")
    assert server.send("api/import", {"path": "first/b.stl", "as": "tool"})["box_mm"] == [[0, 0, 1], [1, 3, 1]]
    for unit, scale in (("ft", 304.8), ("mil", 0.0254), ("um", 1e-3), ("yd", 914.4)):
        tool = server.send("api/import", {"path": "first/a.stl", "as": "tool", "unit": unit, "case": CASE})
        assert abs(tool["value"]["scale"] / scale - 1) < 1e-12, (unit, tool)
    for unit in ("ell", "furlong", "fathom", "N", "Mm", "", 5):
        wish = {"path": "first/a.stl", "as": "tool", "unit": unit}
        assert server.call("POST", "api/import", wish)[0] == 422, unit
    tool = server.send("api/import", {"path": "first/a.stl", "as": "tool", "unit": "inch", "case": CASE})
    upload("c.dxf", b"0\nEOF\n")
    blank = server.send("api/import", {"path": "first/c.dxf", "as": "blank", "unit": "mm", "case": CASE})
    assert blank["key"] == "blanks" and blank["value"]["outline_file"] == "c.dxf" and "scale" not in blank["value"]
    now = server.get("api/case", path=CASE)
    edits = [{"op": "add", **{key: tool[key] for key in ("key", "name", "value")}}]
    after = server.send("api/case", {"version": now["version"], "edits": edits}, "PATCH", path=CASE)
    assert after["made"] == ["tool.3"] and after["tree"]["tool"][3]["name"] == "a"
    stepped(server, "undo")
    for wish in ({"path": "first/a.stl", "as": "blank"}, {"path": "first/a.stl", "as": "tool", "unit": "ell"},
                 {"path": CASE, "as": "fabric"}, {"path": "first", "as": "tool"}):
        assert server.call("POST", "api/import", wish)[0] == 422, wish
    upload("d.step", b"no part")
    begun = server.send("api/import", {"path": "first/d.step", "as": "tool", "deflection": 0.1, "offset": 1.5})
    assert begun["outputs"] == ["first/d_die.stl", "first/d_punch.stl"]
    assert begun["process"]["command"][-2:] == ["--offset", "1.5"]
    while server.get(f"api/processes/{begun['process']['id']}")["state"] not in ("done", "failed"):
        time.sleep(0.1)
    part = {"path": "first/d.step", "as": "tool", "replace": True, "case": CASE}
    begun = server.send("api/import", {**part, "stack": True, "shear": 30, "solid": "part"})
    assert begun["process"]["command"][-6:] == ["--stack", str(server.folder.resolve() / CASE), "--shear", "30",
                                                "--solid", "part"], begun
    for more, code in (({"stack": True, "shear": 81}, 422), ({"run": "first"}, 404), ({"run": "../x"}, 403),
                       ({"stack": True, "solid": "x"}, 422)):
        assert server.call("POST", "api/import", {**part, **more})[0] == code, more
    assert server.call("POST", "api/import", {"path": "first/d.step", "as": "tool", "deflection": "x"})[0] == 422


def process_dies(server):
    """One that is killed while it works, and while it waits: told, and the server goes on."""
    def workers():
        mine = [int(name) for name in os.listdir("/proc") if name.isdigit()]
        return [pid for pid in mine if b"scene/reader.py" in words_of(pid) and parent_of(pid) == server.process.pid]
    for pid in workers():
        os.kill(pid, signal.SIGSEGV)
    time.sleep(0.3)
    text = (server.folder / CASE).read_text() + "# anew\n"
    (server.folder / CASE).write_text(text)
    version = server.get("api/case", path=CASE)["version"]
    status, said = server.call("GET", "api/check", query={"path": CASE, "version": version})
    assert status == 200 or "SIGSEGV" in said["error"], said  # told, or begun anew before
    assert server.get("api/check", path=CASE, version=version)["mistakes"] == []


def words_of(pid):
    try:
        return Path(f"/proc/{pid}/cmdline").read_bytes()
    except OSError:
        return b""


def parent_of(pid):
    try:
        return int(Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[1])
    except OSError:
        return 0


def process_hangs(case):
    worker = Worker(module_of(PROGRAM), limit=60.0)
    assert worker.ask("check", file=str(case), stamp=0)[0]["mistakes"] == []
    worker.limit = 1.0
    for how, words in ((signal.SIGSTOP, "more than 1 s"), (signal.SIGABRT, "SIGABRT")):
        process = worker.process
        threading.Timer(0.3 if how == signal.SIGABRT else 0.0, process.send_signal, [how]).start()
        if how == signal.SIGABRT:
            process.send_signal(signal.SIGSTOP)  # it is at work until then
            worker.limit = 30.0
            threading.Timer(0.35, process.send_signal, [signal.SIGCONT]).start()
        else:
            time.sleep(0.2)
        try:
            worker.ask("check", file=str(case), stamp=0)
            raise AssertionError("no answer was wanted")
        except Refused as problem:
            assert words in str(problem) and problem.code == 500, problem
        worker.limit = 30.0
        assert worker.ask("check", file=str(case), stamp=0)[0]["mistakes"] == []
    newer_first(worker, case)
    worker.stop()


def newer_first(worker, case):
    """A question that has been waiting is out of date when a newer one of the same file comes."""
    answers = {}

    def ask(stamp):
        try:
            answers[stamp] = worker.ask("check", file=str(case), stamp=stamp)
        except Refused as problem:
            answers[stamp] = problem.code
    worker.process.send_signal(signal.SIGSTOP)
    threads = [threading.Thread(target=ask, args=(stamp,)) for stamp in (1, 2, 3)]
    for thread in threads:
        thread.start()
        time.sleep(0.3)
    for thread in threads:
        thread.join(60)
    assert answers[1] == answers[2] == 409 and answers[3][0]["mistakes"] == [], answers


def fewer_facets():
    import numpy as np
    rows = np.linspace(0, 1, 400)
    u, v = np.meshgrid(2 * np.pi * rows, np.pi * rows)
    x = 50 * np.stack([np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)], axis=-1).reshape(-1, 3)
    k = (np.arange(399)[:, None] * 400 + np.arange(399)).reshape(-1)
    triangles = np.concatenate([np.stack([k, k + 1, k + 400], axis=1), np.stack([k + 1, k + 401, k + 400], axis=1)])
    few_x, few = coarser(x, triangles)
    assert 20_000 < len(few) <= 100_000 and few.max() < len(few_x)
    assert abs(np.linalg.norm(few_x, axis=1) - 50).max() < 0.05
    same_x, same = coarser(x, triangles[:1000])
    assert same_x is x and len(same) == 1000


def drawn_at_once(server):
    """A tool of very many facets: a draft with few of them where the tool is, then the whole scene."""
    import numpy as np
    from fine_tools import hollow, surface
    server.send("api/cases", {"name": "fine", "from": "example:hemisphere_0"})
    surface(server.folder / "fine/die.stl", 210_000, hollow, True)
    text = server.get("api/case", path="fine/case.toml")
    tools = [{"op": "add", "key": "tool", "value": {"name": "fine", "shape": "mesh", "file": "die.stl",
                                                    "position": [7.0, 0.0, -90.0]}}]
    status, made = server.call("PATCH", "api/case", {"version": text["version"], "edits": tools},
                               query={"path": "fine/case.toml"})
    assert status == 200, made
    wish = {"path": "fine/case.toml", "version": made["version"]}
    seen = []
    for more in ({"draft": "true"}, {}, {"draft": "true"}):
        header, arrays = unpacked(server.get("api/scene", **wish, **more))
        tool = header["tools"][-1]
        x = np.frombuffer(arrays, "<f4", tool["x"]["count"], tool["x"]["at"]).reshape(-1, 3)
        assert abs(x.min(axis=0) - [-193, -200, -150]).max() < 3.0 and abs(x.max(axis=0) - [207, 200, -90]).max() < 3.0
        assert header["missing"] == [] and 209_000 < tool["facets"] < 211_000, tool
        seen.append((header["draft"], bool(tool["gap"]), tool["drawn_facets"]))
    assert seen[0][:2] == (True, False) and 5_000 < seen[0][2] <= 30_000, seen
    assert seen[1][:2] == (False, True) and seen[2] == seen[1], seen


def module_comes_later():
    """A build whose Python module is not there, not whole, and then is: forms are never empty."""
    with tempfile.TemporaryDirectory() as build:
        program, package = Path(build) / "tools/plyform", Path(build) / "python/plyform"
        program.parent.mkdir()
        shutil.copy2(PROGRAM, program)
        command = [TOOLS / "studio", "--no-browser", "--program", program, Path(build) / "folder"]
        said = subprocess.run(command, capture_output=True, text=True, timeout=60)
        assert said.returncode == 1 and "there is no Python module beside" in said.stderr, said
        shutil.copytree(module_of(PROGRAM) / "plyform", package, ignore=shutil.ignore_patterns("*.so", "__pycache__"))
        compiled, = (module_of(PROGRAM) / "plyform").glob("_plyform*.so")
        with Server(TOOLS, program) as server:
            assert "tool[].radius" in {row["key"] for row in server.get("api/keys")}  # by the program itself
            server.send("api/cases", {"name": "first", "from": "example:hemisphere_0"})
            version = server.get("api/case", path="first/case.toml")["version"]
            asked = {"path": "first/case.toml", "version": version}
            status, said = server.call("GET", "api/check", query=asked)
            assert status == 500 and "cannot be loaded" in said["error"], (status, said)
            shutil.copy2(compiled, package / compiled.name)
            assert server.get("api/check", **asked)["mistakes"] == []


def main():
    fewer_facets()
    module_comes_later()
    with Server(TOOLS, PROGRAM) as server:
        for part in (made_and_listed, changed_and_taken_back, two_pages, taken_in, told_by_the_program, drawn, drawn_at_once,
                     formed_at_once, process_dies):
            begun = time.monotonic()
            part(server)
            print(f"{part.__name__}: {time.monotonic() - begun:.1f} s")
        process_hangs(server.folder / CASE)


if __name__ == "__main__":
    main()
