# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of the set-up with a case of two plies, for the tests: parts are done one after the other, timed."""

import shutil
import sys
import tempfile
import time
from pathlib import Path

from studio_page import SetupPage
from studio_server import Server

TOOLS, PROGRAM, CASES = (Path(name).resolve() for name in sys.argv[1:4])
PICTURES = Path(sys.argv[4]) if len(sys.argv) > 4 else None  # of the page after each part
CASE = "mine/case.toml"


def folder_with_case(root: Path) -> Path:
    (root / "mine").mkdir(parents=True)
    shutil.copytree(CASES / "fabrics", root / "fabrics")
    shutil.copy(CASES / "hemisphere_two_ply" / "case.toml", root / "mine" / "case.toml")
    return root


def go_through(parts) -> None:
    """Each a function of the page; nothing goes wrong on it, and nothing is asked of another place."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = folder_with_case(Path(scratch) / "folder")
        with Server(TOOLS, PROGRAM, folder) as server, SetupPage(server, folder / CASE, 1280, 800) as page:
            page.open(f"#setup/{CASE}")
            for part in parts:
                begin = time.monotonic()
                try:
                    part(page)
                finally:
                    if PICTURES:
                        page.screenshot(PICTURES / f"{part.__name__}.png")
                print(f"{part.__name__}: {time.monotonic() - begin:.1f} s", flush=True)
            wrong = [line for line in page.errors() if "422" not in line and "409" not in line]
            assert not wrong, wrong
            outside = [url for url in page.requests() if not url.startswith((server.origin, "data:", "blob:"))]
            assert not outside, outside
