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

    def shown(self, what):
        """Waits until the panel shows that: a view and a number of runs."""
        self.when("return document.documentElement.dataset.results === arguments[0]", what)

    def out(self):
        self.driver.switch_to.default_content()

    def titles(self):
        """Of the report that is shown."""
        def read():
            self.into_report()
            return [one.text for one in self.all("h1")]
        titles = self.until(read, "the report has titles")
        self.out()
        return titles

    def rows(self, selector):
        """Texts of the cells of a table's rows, at one moment."""
        return self.js("return [...document.querySelectorAll(arguments[0])].map((row) => "
                       "[...row.children].map((cell) => cell.innerText))", selector)


def downloaded(downloads, name, seconds=30.0):
    path = downloads / name
    end = time.monotonic() + seconds
    while not path.is_file():
        assert time.monotonic() < end, (name, list(downloads.iterdir()))
        time.sleep(0.05)
    content = path.read_bytes()
    path.unlink()
    return content
