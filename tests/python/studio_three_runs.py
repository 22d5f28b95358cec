# SPDX-License-Identifier: GPL-3.0-or-later
"""Three small runs, and the panel of results that shows them, for the tests."""

import json
import math
import subprocess
import time

from studio_page import Page

COARSE = ["blanks.square.mesh_from=element_size", "blanks.square.element_size=34",
          "solver.outputs=4", "solver.duration=0.02"]
RUNS = {"a": ["contact.friction=0.2"], "b": ["contact.friction=0.4"],
        "c": ["contact.friction=0.3", "ply.ply1.angle=45"]}


def made(folder, program, cases):
    """Three small runs, the oldest first."""
    for name, settings in RUNS.items():
        words = [word for setting in [*COARSE, *settings] for word in ("--set", setting)]
        done = subprocess.run([program, "run", cases / "hemisphere_two_ply", "-o", folder / "results" / name,
                               *words], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done
    rows = [f"{110 * math.cos(k / 10):.3f},{110 * math.sin(k / 10):.3f}" for k in range(63)]
    (folder / "trim.csv").write_text("x,y\n" + "\n".join(rows) + "\n", encoding="ascii")


def summary_of(folder, name):
    return json.loads((folder / "results" / name / "summary.json").read_text(encoding="utf-8"))


class ResultsPage(Page):
    def __init__(self, server):
        super().__init__(1440, 1000)
        self.server = server

    def open(self, rest=""):
        self.go(self.server, rest.lstrip("#"))

    def all(self, selector):
        return self.driver.find_elements("css selector", selector)

    def run(self, folder):
        return f"#results-list input[data-folder={json.dumps(folder)}]"

    def frame(self):
        """Into the report, when it is shown."""
        self.driver.switch_to.default_content()
        self.when("return document.getElementById('report-frame')")
        self.driver.switch_to.frame("report-frame")
        self.when("return document.documentElement.dataset.ready")
        assert self.js("return document.documentElement.dataset.ready") != "failed"

    def out(self):
        self.driver.switch_to.default_content()

    def titles(self):
        self.frame()
        titles = [one.text for one in self.all("h1")]
        self.out()
        return titles


def downloaded(downloads, name, seconds=30.0):
    path = downloads / name
    end = time.monotonic() + seconds
    while not path.is_file():
        assert time.monotonic() < end, (name, list(downloads.iterdir()))
        time.sleep(0.05)
    content = path.read_bytes()
    path.unlink()
    return content
