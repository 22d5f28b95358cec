# SPDX-License-Identifier: GPL-3.0-or-later
"""How fast the workbench is, no test: twenty plies, tools of 2 million facets, 50 runs in the folder.

    studio_bench.py TOOLS PROGRAM CASES [--plies N] [--facets N] [--runs N] [--only PART]

Prints a table: answers to the page, the first picture of the case, the first moving ply after the button (of two
shipped cases and of the large one), and pictures a second while they are turned, drawn by the processor, 1280 x
720. Beside the clock stands the processor time of all that works for it, workbench, plyform and browser, which
other work on the machine does not make much longer; of pictures the browser's for each.
"""

import argparse
import os
import shutil
import signal
import statistics
import subprocess
import sys
import time
from pathlib import Path

from fine_tools import hollow, sphere, surface
from report_browser import Browser, By
from studio_server import Server

TURN = """VIEW.then(async ({ stage }) => {
  const begin = performance.now(), first = stage.frames;
  while (performance.now() - begin < 4000) {
    stage.camera.turn(2, 0);
    await new Promise((go) => requestAnimationFrame(go));
  }
  const seconds = (performance.now() - begin) / 1000;
  return [stage.frames - first, seconds, stage.renderer.info.render.triangles];
})"""
VIEWS = {"set-up": "Promise.resolve(window.plyform_setup.area.view)",
         "runs": 'import("workbench/runs/panel.js").then(({ runs }) => runs.panel.shown.picture.view)'}
SHIPPED = ("hemisphere_0", "hemisphere_five_ply")
CASE = """title = "Twenty plies in fine tools"
[fabrics]
glass = "../cases/fabrics/glass_plain_weave.toml"
[blanks.square]
size = [300.0, 300.0]
mesh = "alternating"
element_size = 10.0
{plies}
[[tool]]
name = "punch"
shape = "mesh"
file = "punch.stl"
position = [0.0, 0.0, {top}]
motion = "driven"
direction = [0.0, 0.0, -1.0]
stroke = 60.0
[[tool]]
name = "die"
shape = "mesh"
file = "die.stl"
[solver]
duration = 0.5
fibre_softening = 100.0
outputs = 20
"""


def fill(folder: Path, cases: Path, options) -> None:
    shutil.copytree(cases / "fabrics", folder / "cases/fabrics")
    for name in SHIPPED:
        shutil.copytree(cases / name, folder / "cases" / name)
    (folder / "fine").mkdir()
    plies = "".join(f'[[ply]]\nname = "ply_{k}"\nfabric = "glass"\nblank = "square"\nangle = {45.0 * (k % 2)}\n'
                    for k in range(options.plies))
    (folder / "fine/case.toml").write_text(CASE.format(plies=plies, top=0.6 * options.plies + 0.1))
    surface(folder / "fine/punch.stl", options.facets // 2, sphere, False)
    surface(folder / "fine/die.stl", options.facets // 2, hollow, True)
    subprocess.run([options.program, "run", "cases/hemisphere_0", "--accuracy", "draft", "-o", "results/run_0"],
                   cwd=folder, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    for k in range(1, options.runs):
        shutil.copytree(folder / "results/run_0", folder / f"results/run_{k}")


def cpu_of(*roots: int) -> float:
    """Processor seconds of processes, of those that they have started, and of those that have ended."""
    ticks, children = {}, {}
    for entry in Path("/proc").iterdir():
        try:
            words = (entry / "stat").read_text(errors="replace").rpartition(")")[2].split() if entry.name.isdigit() else []
        except OSError:
            continue  # ended just now
        if words:
            children.setdefault(int(words[1]), []).append(int(entry.name))
            ticks[int(entry.name)] = sum(map(int, words[11:15]))
    waiting, found = list(roots), set()
    while waiting:
        one = waiting.pop()
        if one not in found:
            found.add(one)
            waiting += children.get(one, [])
    return sum(ticks.get(one, 0) for one in found) / os.sysconf("SC_CLK_TCK")


class Cost:
    """Of what happens within `with`: clock and processor seconds."""

    def __init__(self, *roots: int):
        self.roots = roots

    def __enter__(self):
        self.began, self.cpu = time.monotonic(), -cpu_of(*self.roots)
        return self

    def __exit__(self, *_):
        self.clock, self.cpu = time.monotonic() - self.began, self.cpu + cpu_of(*self.roots)


def both(server: Server, browser: Browser) -> tuple[int, int]:
    return server.process.pid, browser.driver.service.process.pid


def row(what: str, figure: str, cpu: str, limit: str) -> None:
    print(f"| {what} | {figure} | {cpu} | {limit} |", flush=True)


def answers(server: Server) -> None:
    """Of the routes that a page asks while it is open."""
    case = {"path": "fine/case.toml"}
    case["version"] = server.get("api/case", **case)["version"]
    for what, route, query, limit in (
            ("list of runs", "api/runs", {}, "0.2 s"), ("folder", "api/folder", {}, "0.2 s"),
            ("results", "api/results", {}, "0.2 s"),
            ("a state of a run", "api/runs/state", {"folder": "results/run_1", "number": 10}, "0.2 s"),
            ("messages of a run", "api/runs/messages", {"folder": "results/run_1"}, "0.2 s"),
            ("case", "api/case", case, "0.2 s"), ("table of keys", "api/keys", {}, "0.2 s"),
            ("scene, again", "api/scene", case, "0.2 s"), ("check, the first time", "api/check", case, ""),
            ("check, again", "api/check", case, "0.2 s")):
        times, count = [], 1 if "first" in what else 9
        with Cost(server.process.pid) as cost:
            for _ in range(count):
                begin = time.monotonic()
                status, _ = server.call("GET", route, query=query)
                times.append(time.monotonic() - begin)
                assert status == 200, (what, status)
        row(f"answer: {what}", f"{statistics.median(times):.3f} s, at most {max(times):.3f}",
            f"{cost.cpu / count:.3f} s", limit)


def until(browser: Browser, script: str, seconds: float = 300.0) -> None:
    end = time.monotonic() + seconds
    while not browser.js(script):
        if time.monotonic() > end:
            raise TimeoutError(script)
        time.sleep(0.05)


def turned(browser: Browser, what: str, view: str) -> None:
    browser.js("document.activeElement && document.activeElement.blur()")
    with Cost(browser.driver.service.process.pid) as cost:
        frames, seconds, triangles = browser.wait(TURN.replace("VIEW", VIEWS[view]))
    row(f"turned: {what}, {triangles} triangles", f"{frames / seconds:.0f} a second", f"{1e3 * cost.cpu / frames:.0f} ms",
        "30 a second")


def opened(server: Server, browser: Browser, address: str) -> None:
    browser.driver.get(server.address + address)
    until(browser, "return document.documentElement.dataset.ready", 20)


def first_picture(server: Server) -> None:
    with Browser(1280, 720) as browser:
        opened(server, browser, "#runs")
        time.sleep(3.0)  # the processes that read cases are there
        with Cost(*both(server, browser)) as cost:
            browser.js("location.hash = '#setup/fine/case.toml'")
            until(browser, "const s = window.plyform_setup; return s && s.area.scene && s.area.view.stage.frames > 0")
        row("first picture of the case", f"{cost.clock:.1f} s", f"{cost.cpu:.1f} s", "2 s")
        with Cost(*both(server, browser)) as whole:
            until(browser, "return !window.plyform_setup.area.scene.draft")
        row("its gaps and first contacts", f"{cost.clock + whole.clock:.1f} s", f"{cost.cpu + whole.cpu:.1f} s", "")
        time.sleep(5.0)
        turned(browser, "set-up", "set-up")


def first_move(server: Server, case: str) -> None:
    with Browser(1280, 720) as browser:
        opened(server, browser, f"#runs/+/{case}/case.toml")
        until(browser, "return document.querySelector('#run-threads').value", 20)
        time.sleep(2.0)
        with Cost(*both(server, browser)) as cost:
            browser.driver.find_element(By.CSS_SELECTOR, "#run-start").click()
            until(browser, "return Number(document.getElementById('run-picture').dataset.moved) > 0")
        row(f"first moving ply after the button, {case}", f"{cost.clock:.1f} s", f"{cost.cpu:.1f} s",
            "5 s" if "/" in case else "")
        if "/" not in case:
            until(browser, "return !document.getElementById('run-picture').dataset.scouting")
            turned(browser, "as the run goes on", "runs")
        run = next((run for run in server.get("api/runs") if run["state"] == "running"), None)
        if run:
            os.killpg(run["record"]["pid"], signal.SIGKILL)
        until(browser, "return !['running', 'starting'].includes(document.getElementById('run-shown').dataset.state)")
        time.sleep(2.0)
        if "/" not in case:
            turned(browser, "run ended", "runs")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    for name in ("tools", "program", "cases"):
        parser.add_argument(name, type=Path)
    parser.add_argument("--plies", type=int, default=20)
    parser.add_argument("--facets", type=int, default=2_000_000)
    parser.add_argument("--runs", type=int, default=50)
    parser.add_argument("--only", choices=("answers", "picture", "move", "large"))
    options = parser.parse_args()
    options.program = options.program.resolve()
    with Server(options.tools.resolve(), options.program) as server:
        fill(server.folder, options.cases.resolve(), options)
        time.sleep(2.5)  # the list of folders is looked through every two seconds
        print(f"| {options.plies} plies, {options.facets} facets, {options.runs} runs | clock | processor | asked |\n"
              "|---|---|---|---|")
        parts = {"picture": lambda: first_picture(server), "answers": lambda: answers(server),
                 "move": lambda: [first_move(server, f"cases/{name}") for name in SHIPPED],
                 "large": lambda: first_move(server, "fine")}
        for name, part in parts.items():
            if options.only in (None, name):
                part()


if __name__ == "__main__":
    sys.exit(main())
