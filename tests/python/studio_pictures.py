# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the workbench for the texts: a set-up, a run that goes on, its report. About two minutes.

    studio_pictures.py [TOOLS PROGRAM] -o FOLDER        e.g. -o docs/users
"""

import argparse
import io
import time
from pathlib import Path

from PIL import Image
from studio_page import Page
from studio_server import Server

ROOT = Path(__file__).resolve().parents[2]
MOST = 250_000  # bytes of a picture
CASE = "hemisphere/case.toml"


def saved(page: Page, path: Path) -> None:
    """With as many colours as fit."""
    page.screenshot(path)
    image = Image.open(path).convert("RGB")
    for colours in (256, 128, 64, 32):
        content = io.BytesIO()
        image.quantize(colours).save(content, "png", optimize=True)
        if len(content.getvalue()) <= MOST:
            break
    path.write_bytes(content.getvalue())
    print(f"{path}: {image.width} x {image.height}, {len(content.getvalue()) // 1000} kB, {colours} colours")


def set_up(page: Page, server: Server) -> None:
    page.go(server, f"setup/{CASE}")
    page.until(lambda: page.js("return plyform_setup.scene && plyform_setup.scene.plies.length === 3"), "the scene")
    page.press('button.item[data-item="ply.2"]')
    page.pick("#scene-tools", "solid")
    page.pick("#scene-section", "x")
    page.until(lambda: page.text("#check-state").startswith("no mistakes"), "it is checked", 300)
    time.sleep(5.0)  # smooth edges come when all is at rest


def run_on(page: Page, server: Server, folder: str) -> None:
    page.go(server, f"runs/{folder}")
    page.until(lambda: server.get("api/runs")[0]["states"] >= 13, "more than half the states are there", 600)
    time.sleep(0.5)


def result(page: Page, server: Server, folder: str) -> None:
    page.until(lambda: server.get("api/runs")[0]["state"] in ("done", "doubtful"), "it has ended", 600)
    page.go(server, f"results/{folder}")
    page.into_report()
    page.js("document.getElementById('canvas').parentElement.scrollIntoView({ block: 'end' })")
    time.sleep(5.0)
    page.driver.switch_to.default_content()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("tools", type=Path, nargs="?", default=ROOT / "tools")
    parser.add_argument("program", type=Path, nargs="?", default=ROOT / "build/release/tools/plyform")
    parser.add_argument("-o", dest="out", type=Path, required=True)
    options = parser.parse_args()
    with Server(options.tools, options.program) as server, Page(1280, 720) as page:
        server.send("api/cases", {"name": "hemisphere", "from": "example:hemisphere_three_ply"})
        edit = {"op": "set", "key": "blanks.square.element_size", "value": 8.0}
        server.send("api/case", {"version": server.get("api/case", path=CASE)["version"], "edits": [edit]}, "PATCH",
                    path=CASE)
        set_up(page, server)
        saved(page, options.out / "studio_setup.png")
        record = server.send("api/runs", {"case": CASE})
        folder = record["about"]["output"]
        run_on(page, server, folder)
        saved(page, options.out / "studio_run.png")
        result(page, server, folder)
        saved(page, options.out / "studio_result.png")


if __name__ == "__main__":
    main()
