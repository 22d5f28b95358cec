# SPDX-License-Identifier: GPL-3.0-or-later
"""How fast the workbench is, no test: twenty plies, tools of 2 million facets, 50 runs in the folder.

    studio_bench.py TOOLS PROGRAM CASES [--plies N] [--facets N] [--runs N]

Prints a table: answers to the page, the first picture of the case, the first moving ply after the button, and
pictures a second while it is turned, drawn by the processor, 1280 x 720. What the workbench at hand has not is
left out.
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

import numpy as np
from report_browser import Browser, By
from studio_server import Server

TURN = """import("workbench/runs/panel.js").then(async ({ runs }) => {
  const { stage } = runs.panel.shown.picture.view, begin = performance.now(), first = stage.frames;
  while (performance.now() - begin < 3000) {
    stage.camera.turn(2, 0);
    await new Promise((go) => requestAnimationFrame(go));
  }
  return (stage.frames - first) / (performance.now() - begin) * 1000;
})"""
TURN_SETUP = """(async () => {
  const pane = document.querySelector("#panel-setup .scene-pane"), begin = performance.now();
  let frames = 0;
  while (performance.now() - begin < 3000) {
    pane.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft", bubbles: true }));
    await new Promise((go) => requestAnimationFrame(go));
    frames += 1;
  }
  return frames / (performance.now() - begin) * 1000;
})()"""
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


def surface(path: Path, facets: int, height, up: bool):
    """An STL file of a height over the plane, from -200 to 200 mm each way; faces look up or down."""
    side = max(2, round((facets / 2) ** 0.5))
    along = np.linspace(-200.0, 200.0, side + 1)
    x, y = np.meshgrid(along, along, indexing="ij")
    points = np.stack([x, y, height(np.hypot(x, y))], axis=-1).reshape(-1, 3)
    corner = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).ravel()
    triangles = np.concatenate([np.stack([corner, corner + side + 1, corner + side + 2], 1),
                                np.stack([corner, corner + side + 2, corner + 1], 1)])
    kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
    content = np.zeros(len(triangles), kind)
    content["corners"] = points[triangles if up else triangles[:, ::-1]]
    with open(path, "wb") as file:
        file.write(bytes(80) + len(triangles).to_bytes(4, "little"))
        content.tofile(file)


def sphere(r, radius=75.0):
    """Of the punch: the lower half, and a cone beyond."""
    inside = radius - np.sqrt(np.maximum(radius ** 2 - np.minimum(r, 0.95 * radius) ** 2, 0.0))
    return inside + np.maximum(r - 0.95 * radius, 0.0)


def hollow(r, radius=95.0):
    """Of the die: flat beyond, its edge rounded."""
    return -60.0 / (1.0 + np.exp((r - radius) / 6.0))


def fill(folder: Path, cases: Path, options) -> None:
    shutil.copytree(cases / "fabrics", folder / "cases/fabrics")
    shutil.copytree(cases / "hemisphere_0", folder / "cases/hemisphere_0")
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


def row(what: str, figure: str) -> None:
    print(f"| {what} | {figure} |", flush=True)


def answers(server: Server) -> None:
    """Of the routes that a page asks while it is open."""
    for what, route, query in (
            ("list of runs", "api/runs", {}), ("folder", "api/folder", {}), ("results", "api/results", {}),
            ("a state of a run", "api/runs/state", {"folder": "results/run_1", "number": 10}),
            ("messages of a run", "api/runs/messages", {"folder": "results/run_1"}),
            ("case", "api/case", {"path": "fine/case.toml"}), ("table of keys", "api/keys", {}),
            ("check of the case", "api/check", {"path": "fine/case.toml"}),
            ("scene of the case, the first time", "api/scene", {"path": "fine/case.toml"}),
            ("scene of the case, again", "api/scene", {"path": "fine/case.toml"})):
        times = []
        for _ in range(1 if "first" in what else 9):
            begin = time.monotonic()
            status, _ = server.call("GET", route, query=query)
            times.append(time.monotonic() - begin)
            if status != 200:
                break
        row(f"answer: {what}", f"{status}" if status != 200 else
            f"{1e3 * statistics.median(times):.0f} ms, {1e3 * max(times):.0f} at most")


def until(browser: Browser, script: str, seconds: float = 300.0) -> float:
    begin = time.monotonic()
    while time.monotonic() - begin < seconds:
        if browser.js(script):
            return time.monotonic() - begin
        time.sleep(0.02)
    return float("nan")


def first_picture(server: Server) -> None:
    with Browser(1280, 720) as browser:
        browser.driver.get(server.address)
        until(browser, "return document.documentElement.dataset.ready", 20)
        browser.js("location.hash = '#setup/fine/case.toml'")
        if not browser.js("return document.getElementById('panel-setup') !== null"):
            row("first picture of the case", "no such panel yet")
            return
        seconds = until(browser, "return document.querySelector('#panel-setup [data-drawn]')", 60)
        row("first picture of the case", f"{seconds:.1f} s")
        row("pictures a second while it is turned, set-up", f"{browser.wait(TURN_SETUP):.0f}")


def first_move(server: Server) -> None:
    with Browser(1280, 720) as browser:
        browser.driver.get(server.address + "#runs/+/fine/case.toml")
        until(browser, "return document.querySelector('#run-threads').value", 20)
        time.sleep(1.0)
        browser.driver.find_element(By.CSS_SELECTOR, "#run-start").click()
        seconds = until(browser, "return Number(document.getElementById('run-picture').dataset.moved) > 0")
        row("first moving ply after the button", f"{seconds:.1f} s")
        row("pictures a second while it is turned, as the run goes on", f"{browser.wait(TURN):.0f}")
        run = next(run for run in server.get("api/runs") if run["state"] == "running")
        os.killpg(run["record"]["pid"], signal.SIGKILL)
        until(browser, "return document.getElementById('run-shown').dataset.state === 'killed'", 20)
        time.sleep(1.0)
        row("pictures a second while it is turned, run ended", f"{browser.wait(TURN):.0f}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    for name in ("tools", "program", "cases"):
        parser.add_argument(name, type=Path)
    parser.add_argument("--plies", type=int, default=20)
    parser.add_argument("--facets", type=int, default=2_000_000)
    parser.add_argument("--runs", type=int, default=50)
    options = parser.parse_args()
    options.program = options.program.resolve()
    with Server(options.tools.resolve(), options.program) as server:
        fill(server.folder, options.cases.resolve(), options)
        time.sleep(2.5)  # the list of folders is looked through every two seconds
        print(f"| {options.plies} plies, {options.facets} facets, {options.runs} runs | |\n|---|---|")
        answers(server)
        first_picture(server)
        first_move(server)


if __name__ == "__main__":
    sys.exit(main())
