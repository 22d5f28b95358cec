# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs in the workbench, by clicks: started, queued, watched, ended, gone on with, removed, found again.

    studio_runs_test.py PART TOOLS PROGRAM CASES      PART: started, watched, found, refused

Leaves with 77 when Chromium, its driver, selenium, FastAPI or h5py is missing.
"""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

from pushed_ply import pushed_ply
from studio_page import PATIENCE, Page as AnyPage
from studio_results import same_results
from studio_server import Server

PART = sys.argv[1]
TOOLS, PROGRAM, CASES = (Path(argument).resolve() for argument in sys.argv[2:5])
QUICK = "cases/hemisphere_0/case.toml"
COARSE = "cases/hemisphere_0/coarse.toml"
LONG = pushed_ply("../cases/fabrics", 340.0, 7.0, 1.5, 100) + "checkpoint_interval = 1.0\n"


class Page(AnyPage):
    def go(self, server, rest="runs"):
        super().go(server, rest)
        self.when("return document.querySelector('#run-threads').value")

    def run(self, case, name="", verify=False, **more):
        self.type("#run-case", case)
        if not self.js("return document.querySelector('.runs-start details').open"):
            self.press("#run-more")
        self.type("#run-name", name)
        for key, value in {"accuracy": "", **more}.items():
            if key == "accuracy":
                self.pick("#run-accuracy", value)
            else:
                self.type(f"#run-{key}", str(value))
        if self.find("#run-verify").is_selected() != verify:
            self.press("#run-verify")
        self.press("#run-start")

    def state(self, name, *states, seconds=PATIENCE):
        """Waits for a state of a run in the list."""
        return self.when("const row = document.querySelector(`li[data-folder=\"${arguments[0]}\"]`);"
                          "return row && arguments[1].includes(row.dataset.state) && row.dataset.state",
                          f"results/{name}", states, seconds=seconds)

    def drawn(self):
        """The picture, when it changes no more: it is drawn finely, with twice the pixels, when nothing moves."""
        kept = []
        def still():
            time.sleep(0.7)
            kept.append(self.js("const c = document.querySelector('#run-picture canvas');"
                                "return c.width > 1.5 * c.clientWidth ? c.toDataURL() : null"))
            return kept[-1] and kept[-2:-1] == kept[-1:]
        self.until(still, "the picture is still")
        return kept[-1]

    def redrawn(self, before):
        """The picture, when it changes no more and is not the one before."""
        return self.until(lambda: [now for now in [self.drawn()] if now != before], "another picture")[0]

    def says(self, place, *words):
        self.until(lambda: all(word in self.text(place) for word in words), f"{place} says {words}")

    def scene(self, key):
        return self.js("return document.getElementById('run-picture').dataset[arguments[0]]", key)

    def colours(self):
        """How many there are in the picture."""
        self.drawn()
        return self.js("const c = document.querySelector('#run-picture canvas'), k = document.createElement('canvas');"
                       "[k.width, k.height] = [c.width, c.height]; const d = k.getContext('2d'); d.drawImage(c, 0, 0);"
                       "return new Set(new Uint32Array(d.getImageData(0, 0, k.width, k.height).data.buffer)).size")

    def faults(self):
        """What the browser complains of."""
        return [error for error in self.errors() if "/api/folder" not in error]

    def queue(self):
        return self.js("return [...document.querySelectorAll('#runs-queue li')].map((row) => row.dataset.folder)")


def filled(server):
    """The folder of a server with two cases."""
    for name in ("hemisphere_0", "fabrics"):
        shutil.copytree(CASES / name, server.folder / "cases" / name)
    (server.folder / "long").mkdir()
    (server.folder / "long/case.toml").write_text(LONG)
    broken = (server.folder / QUICK).read_text().replace("radius = 75.0", "radius = -75.0")
    (server.folder / "cases/hemisphere_0/broken.toml").write_text(broken)
    coarse = (server.folder / QUICK).read_text().replace("element_size = 10.0", "element_size = 22.0")
    coarse = coarse.replace('mesh_from = "scene"', 'mesh_from = "element_size"').replace("duration = 0.1 ", "duration = 0.03 ")
    (server.folder / COARSE).write_text(coarse)


def looked_at(page):
    """Tools drawn in other ways, what was printed put away, the command copied, the report opened."""
    page.press("button[data-view=oblique]")
    pictures = {}
    last = page.drawn()
    for way in ("solid", "hidden", "outlines"):
        page.pick("#run-tools", way)
        last = pictures[way] = page.redrawn(last)
    assert len(set(pictures.values())) == 3
    page.pick("#run-tools", "solid")
    assert page.redrawn(last) == pictures["solid"]  # it is the choice that makes the difference
    page.find("#run-picture .scene-pane").send_keys("t")
    page.until(lambda: page.find("#run-tools").get_attribute("value") == "hidden", "the list follows the key")
    assert page.redrawn(pictures["solid"]) == pictures["hidden"]
    for shown in (False, True):
        page.press("#run-printed summary")
        page.until(lambda: page.find("#run-log").is_displayed() == shown, f"printed: {shown}")
    page.driver.execute_cdp_cmd("Browser.grantPermissions", {
        "permissions": ["clipboardReadWrite", "clipboardSanitizedWrite"]})
    page.press("#run-copy")
    page.until(lambda: page.driver.execute_async_script(
        "navigator.clipboard.readText().then(arguments[0], (e) => arguments[0](String(e)))") ==
        page.text("#run-command"), "the command is copied")
    page.press("#run-results")
    page.when("return location.hash === '#results/report/results%2Ffirst'")
    page.when("return document.getElementById('report-frame')")
    page.when("return document.querySelector('#results-list input:checked').dataset.folder === 'results/first'")
    page.press("#panels a[href='#runs']")
    page.until(lambda: page.find("#run-title").is_displayed() and page.text("#run-title") == "first", "it is shown still")


def started():
    """From the button to the picture of its last state, its words, and the same by command line."""
    with Server(TOOLS, PROGRAM) as server, Page() as page:
        filled(server)
        page.go(server)
        page.when("return document.body.innerText.includes('No runs yet')")
        page.run(QUICK, "first", accuracy="draft", threads=2)
        page.state("first", "doubtful")
        page.when("return location.hash === '#runs/results/first'")
        page.when("return document.getElementById('run-picture').dataset.state === '20'")
        assert float(page.scene("moved")) > 50.0
        page.says("#run-state-words", "state 21 of 21: 75.00 mm")
        page.says("#run-message", "do not trust ply where die cuts into it", "elements 2.8 times smaller")  # the remedy
        page.says("#run-log", "results are in")
        page.says("#run-said", "tensile stiffness")
        page.when("return document.querySelectorAll('#run-said li').length >= 2")
        command = page.text("#run-command")
        assert command == f"plyform run {QUICK} -o results/first --threads 2 --accuracy draft", command
        subprocess.run([PROGRAM, *command.replace("results/first", "results/by_hand").split()[1:-1], "draft"],
                       cwd=server.folder, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        same_results(server.folder / "results/first", server.folder / "results/by_hand")
        page.state("by_hand", "doubtful")  # found, though it was not begun here
        # states are gone through
        page.slide("#run-states", 5)
        page.when("return document.getElementById('run-picture').dataset.state === '5'")
        page.press("#run-play")
        page.when("return document.getElementById('run-picture').dataset.state === '20'")
        for view in ("top", "front", "side", "oblique"):
            page.press(f"button[data-view={view}]")
        assert page.colours() > 100, page.colours()  # of the shear angle
        looked_at(page)
        # with bands from sibling runs
        page.run(COARSE, "verified", verify=True)
        page.state("verified", "doubtful", "done")
        figures = json.loads((server.folder / "results/verified/summary.json").read_text())["verification"]["figures"]
        assert any(figure["band"] for figure in figures), figures
        page.until(lambda: page.text("#run-command").endswith(" --verify"), "its command says so")
        # a mistake is told where it is
        page.run("cases/hemisphere_0/broken.toml", "bad", accuracy="")
        page.state("bad", "failed")
        page.says("#run-message", "broken.toml:", "radius")
        # more than the budget
        page.run("long/case.toml", "dear", budget=1)
        page.state("dear", "failed")
        page.says("#run-message", "--budget 1")
        # the name that is taken; the one that is none
        page.type("#run-budget", "")
        page.run(QUICK, "first")
        page.says("#trouble", "is there already")
        # deleted: asked, kept, deleted
        (server.folder / "results/first/notes.txt").write_text("mine")
        page.press("button[data-act='choose results/first']")
        page.when("return document.getElementById('run-title').textContent === 'first'")
        page.press("#run-delete")
        page.press("#run-keep")
        assert (server.folder / "results/first/results.h5").exists()
        page.press("#run-delete")
        page.press("#run-delete-really")
        page.says("#trouble", "notes.txt")
        page.when("return !document.querySelector('li[data-folder=\"results/first\"]')")
        assert os.listdir(server.folder / "results/first") == ["notes.txt"]
        page.press("button[data-act='choose results/by_hand']")
        page.when("return document.getElementById('run-title').textContent === 'by_hand'")
        page.press("#run-delete")
        page.press("#run-delete-really")
        page.when("return !document.querySelector('li[data-folder=\"results/by_hand\"]')")
        page.until(lambda: not (server.folder / "results/by_hand").exists(), "its folder is gone")
        others = [address for address in page.requests() if not address.startswith((server.address, "data:", "blob:"))]
        assert all(address == "about:blank" or address.startswith("chrome") for address in others), others


def watched():
    """Plies move between states; the queue; stop, resume; two pages at once."""
    with Server(TOOLS, PROGRAM) as server, Page() as page, Page() as second:
        filled(server)
        page.go(server)
        second.go(server)
        begin = time.monotonic()
        page.run("long/case.toml", "long", threads=1)
        page.state("long", "running")
        page.when("return Number(document.getElementById('run-picture').dataset.moved) > 0")
        print(f"the first moving ply after {time.monotonic() - begin:.1f} s")
        page.when("return document.getElementById('run-picture').dataset.step > 0")
        first = int(page.scene("step"))
        page.when("return document.getElementById('run-picture').dataset.step > arguments[0]", first)
        page.when("return /forms the plies, \\d+ %, about .* left/.test("
                   "document.getElementById('run-words').textContent)")
        second.state("long", "running")
        for name in "abc":
            page.run(QUICK, name, accuracy="draft")
            page.state(name, "queued")
        page.until(lambda: page.queue() == [f"results/{name}" for name in "abc"], "they wait in their order")
        page.press("button[data-act='earlier results/c']")
        page.when("return document.querySelectorAll('#runs-queue li')[1].dataset.folder === 'results/c'")
        page.press("button[data-act='later results/a']")
        page.when("return document.querySelectorAll('#runs-queue li')[0].dataset.folder === 'results/c'")
        second.when("return document.querySelectorAll('#runs-queue li')[0].dataset.folder === 'results/c'")
        second.press("button[data-act='out results/b']")
        page.state("b", "taken out")
        page.until(lambda: page.queue() == ["results/c", "results/a"], "two wait")
        page.press("button[data-act='choose results/long']")
        page.when("return document.getElementById('run-title').textContent === 'long'")
        page.when("return document.getElementById('run-stop')")
        page.until((server.folder / "results/long/checkpoint").exists, "a checkpoint is written")
        page.press("#run-stop")
        page.state("long", "interrupted")
        page.says("#run-message", "interrupted at step")
        for name in "ca":
            second.state(name, "doubtful")
        page.press("#run-resume")
        page.state("long", "running")
        page.says("#run-log", "goes on after")
        page.until(lambda: page.text("#run-command").endswith(" --resume"), "its command says so")
        page.when("return Number(document.getElementById('run-picture').dataset.step) > 0")
        page.press("#run-stop")
        page.state("long", "interrupted")
        told = json.loads((server.folder / "results/long/summary.json").read_text())
        assert told["status"] == "interrupted"
        page.until(lambda: not (server.folder / "results/long/picture.bin").exists(), "its picture is taken away")
        faults = page.faults() + second.faults()  # the log is emptied by reading
        assert not faults, faults


def found():
    """A server that is killed leaves its run and its queue, which the next one finds; and runs that a
    command line has begun."""
    with Server(TOOLS, PROGRAM) as server, Page() as page:
        filled(server)
        page.go(server)
        page.run(QUICK, "done", accuracy="draft")
        page.state("done", "doubtful")
        page.run("long/case.toml", "long", threads=1)
        page.state("long", "running")
        page.run(QUICK, "waits", accuracy="draft")
        page.state("waits", "queued")
        pid = server.get("api/runs")[1]["record"]["pid"]
        server.stop(signal.SIGKILL)
        page.when("return document.body.classList.contains('alone')")
        time.sleep(0.5)
        assert Path(f"/proc/{pid}").exists()
        server.start()
        page.go(server)
        assert page.state("long", "running") and page.state("waits", "queued") and page.state("done", "doubtful")
        assert next(r for r in server.get("api/runs") if r["name"] == "long")["record"]["pid"] == pid
        page.press("button[data-act='choose results/long']")
        page.when("return Number(document.getElementById('run-picture').dataset.step) > 0")
        page.press("#run-stop")
        page.state("long", "interrupted")
        page.state("waits", "doubtful")
        line = subprocess.Popen([PROGRAM, "run", "long", "-o", "elsewhere/line", "--threads", "1"], cwd=server.folder,
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            row = "const row = document.querySelector('li[data-folder=\"elsewhere/line\"]'); return row"
            page.when(row + " && row.dataset.state === 'running'")
            page.press("button[data-act='choose elsewhere/line']")
            page.when("return document.getElementById('run-shown').dataset.folder === 'elsewhere/line'")
            page.says(".run-acts", "Ctrl-C there ends it")
            page.when("return Number(document.getElementById('run-picture').dataset.step) > 0")
            page.until((server.folder / "elsewhere/line/checkpoint").exists, "a checkpoint is written")
        finally:
            line.kill()
            line.wait()
        page.when(row + " && row.dataset.state === 'killed'")
        page.says("#run-message", "Resume goes on")
        page.press("#run-resume")
        page.when(row + " && row.dataset.state === 'running'")
        page.press("#run-stop")
        page.when(row + " && row.dataset.state === 'interrupted'")


def refused():
    """What a page may not ask for."""
    with Server(TOOLS, PROGRAM) as server:
        filled(server)
        outside = Path(server.kept.name) / "outside"
        shutil.copytree(CASES / "hemisphere_0", outside)
        (outside / "results.h5").write_text("mine")
        (server.folder / "link").symlink_to(outside)
        (server.folder / "cases/link.toml").symlink_to(outside / "case.toml")
        for case in ("../outside/case.toml", str(outside / "case.toml"), "link/case.toml", "cases/link.toml", "", None,
                     3, "cases", "cases/none.toml", ".plyform/lock", "cases/fabrics", "a\0b"):
            status, answer = server.call("POST", "api/runs", {"case": case})
            assert 400 <= status < 500 and answer["error"], (case, status, answer)
        for wrong in ({"name": "../x"}, {"name": "a/b"}, {"name": "-o"}, {"name": ".x"}, {"name": 3}, {"threads": 0},
                      {"threads": 257}, {"threads": 1.5}, {"threads": "2; rm"}, {"accuracy": "--set"}, {"budget": -1},
                      {"budget": "1"}):
            status, answer = server.call("POST", "api/runs", {"case": QUICK, **wrong})
            assert status == 422, (wrong, status, answer)
        for method, route in (("GET", "state"), ("GET", "bodies"), ("GET", "messages"), ("GET", "picture"),
                              ("POST", "remove"), ("POST", "stop"), ("POST", "resume")):
            for folder in ("link", "../outside", str(outside), "", ".", ".plyform", "cases", "cases/hemisphere_0",
                           "none"):
                status, answer = server.call(method, f"api/runs/{route}", {}, query={"folder": folder})
                assert 400 <= status < 500, (route, folder, status, answer)
        assert sorted(os.listdir(outside)) == sorted([*os.listdir(CASES / "hemisphere_0"), "results.h5"])
        assert server.get("api/runs") == [] and not (server.folder / "results").exists()
        # what a run's folder holds is not trusted
        bad = server.folder / "results/bad"
        bad.mkdir(parents=True)
        (bad / "summary.json").write_text('{"status": "<b>done</b>"}')
        (bad / "results.h5").write_text("no results")
        (bad / "progress.json").write_text(json.dumps({"pid": 1, "words": "x"}))
        (bad / "plies").symlink_to(outside)
        end = time.monotonic() + PATIENCE
        while not (runs := server.get("api/runs")):
            assert time.monotonic() < end, "the folder is not found"
            time.sleep(0.1)
        run, = runs
        assert run["state"] == "damaged" and "status" in run["message"], run
        for route in ("state", "bodies"):
            status, answer = server.call("GET", f"api/runs/{route}", query={"folder": "results/bad"})
            assert status == 422 and "cannot be read" in answer["error"], (status, answer)
        assert server.send("api/runs/remove", folder="results/bad") == {"stay": ["plies"]}
        assert (outside / "case.toml").exists()


{"started": started, "watched": watched, "found": found, "refused": refused}[PART]()
