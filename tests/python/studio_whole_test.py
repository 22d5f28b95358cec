# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole way in the workbench, by clicks, keys and chosen files alone: from an empty folder and a STEP
file to a formed double dome, its report, a changed second run beside it; then both by the command lines that
the page shows: the same bits.

    studio_whole_test.py TOOLS PROGRAM CASES [PICTURES]

Leaves with 77 when gmsh, Chromium, its driver, selenium, FastAPI or h5py is missing.
"""

import os
import shlex
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from studio_page import SetupPage
from studio_results import same_results
from studio_server import Server

try:
    import gmsh
    from step_files import write_step
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)

TOOLS, PROGRAM, CASES = (Path(name).resolve() for name in sys.argv[1:4])
PICTURES = Path(sys.argv[4]) if len(sys.argv) > 4 else None
CASE = "dome/case.toml"
HALF, BALL, DEPTH, FILLET = 30.0, 40.0, 25.0, 12.0  # mm: of the double dome
PLATE = 260.0, 190.0                               # mm
OPENING = 58.0                                     # mm, of the holder, from the domes' middles
FABRIC = CASES / "fabrics/glass_plain_weave.toml"


def double_dome(occ):
    """Its lower surface, an open shell: two balls, what lies between them, fillet and flange at z = 0."""
    block = [(3, occ.addBox(-PLATE[0] / 2, -PLATE[1] / 2, -60, *PLATE, 60))]
    up = BALL - DEPTH
    domes = [(3, occ.addSphere(x, 0, up, BALL)) for x in (-HALF, HALF)]
    domes.append((3, occ.addCylinder(-HALF, 0, up, 2 * HALF, 0, 0, BALL)))
    (solid,), _ = occ.cut(block, domes)
    occ.synchronize()
    edges = gmsh.model.getEntitiesInBoundingBox(-100, -60, -1, 100, 60, 1, 1)
    occ.fillet([solid[1]], [tag for _, tag in edges], [FILLET])
    occ.synchronize()
    outside = [face for face in gmsh.model.getEntities(2) if occ.getCenterOfMass(*face)[2] < -29.99]
    dome = [face for face in gmsh.model.getEntities(2) if face not in outside
            or abs(occ.getCenterOfMass(*face)[0]) < 1 and abs(occ.getCenterOfMass(*face)[1]) < 1
            and occ.getCenterOfMass(*face)[2] > -59]
    occ.remove(gmsh.model.getEntities(3))
    occ.remove([face for face in gmsh.model.getEntities(2) if face not in dome])


def holder(occ):
    """A plate of 10 mm with an opening round the domes, its lower face at z = 0."""
    plate = [(3, occ.addBox(-PLATE[0] / 2, -PLATE[1] / 2, 0, *PLATE, 10))]
    hole = [(3, occ.addCylinder(x, 0, -1, 0, 0, 12, OPENING)) for x in (-HALF, HALF)]
    hole.append((3, occ.addBox(-HALF, -OPENING, -1, 2 * HALF, 2 * OPENING, 12)))
    occ.cut(plate, hole)


def new_case(page, _):
    """An empty folder says what to do; the smallest case runs as it is."""
    page.go(page.server)
    page.until(lambda: "no case in this folder" in page.text(".setup-empty"), "it is empty")
    page.press("#first-case")
    page.type("#new-case-name", "dome")
    page.press("#new-case-go")
    page.until(lambda: page.js("return (plyform_setup.main || {}).path") == CASE, "the case is shown")
    page.until(lambda: page.text("#check-state").startswith("no mistakes"), "it has no mistakes")


def plies(page, _):
    """Three, 0/45/0, of a fabric that is brought along; the punch of the smallest case now lies in them, which
    is told where it is."""
    page.give("#add-files", FABRIC.with_name("glass_pp_plain.toml"))
    page.type("#import-fabric-name", "cloth")
    page.press("#import-fabric-go")
    page.until(lambda: "cloth" in page.tree()["fabrics"], "the fabric is in the case")
    page.item("ply.0")
    page.choose("ply.0.fabric", "cloth")
    page.until(lambda: page.tree()["ply"][0]["fabric"] == "cloth", "the ply is of it")
    for k in (1, 2):
        page.press('[data-item="ply.%d"] [data-act="copy"]' % (k - 1))
        page.until(lambda k=k: len(page.tree()["ply"]) == k + 1, f"{k + 1} plies")
        page.item(f"ply.{k}")
    page.item("ply.1")
    page.key("ply.1.angle", "400")
    page.until(lambda: page.text('[data-at="ply.1.angle"] .words'), "an angle that is none is told at its key")
    page.key("ply.1.angle", "45")
    page.until(lambda: [ply["angle"] for ply in page.tree()["ply"]] == [0, 45, 0], "0/45/0")
    page.item("fabrics.glass")
    page.press('[data-item="fabrics.glass"] [data-act="remove"]')
    page.until(lambda: list(page.tree()["fabrics"]) == ["cloth"], "the other fabric is gone")
    page.until(lambda: page.texts(".fault-words:not(.warning)"), "the punch cuts the stack")
    page.until(lambda: page.seen('[data-item^="tool."] b.wrong'), "a tool is marked in the outline")
    page.item("blanks.sheet")
    page.key("blanks.sheet.size", "220", part="0")
    page.key("blanks.sheet.size", "150", part="1")
    page.until(lambda: page.tree()["blanks"]["sheet"]["size"] == [220, 150], "the blank's size")


def tools(page, files):
    """Die and punch by offset from the part, in place of the tools of the smallest case; a holder."""
    for name in ("holder", "die", "punch"):
        at = [tool["name"] for tool in page.tree()["tool"]].index(name)
        page.item(f"tool.{at}")
        page.press(f'[data-item="tool.{at}"] [data-act="remove"]')
        page.until(lambda n=name: n not in [tool["name"] for tool in page.tree().get("tool", [])], f"no {name}")
    page.give("#add-files", files / "double_dome.step")
    page.pick("#import-part-make", "stack")
    page.type("#import-part-shear", "40")
    page.press("#import-part-go")
    page.until(lambda: [tool["name"] for tool in page.tree()["tool"]] == ["die", "punch"], "die and punch")
    page.until(lambda: page.seen("#import-told"), "it is told how near they are")
    told = page.text("#import-told")
    assert "deviation from the exact surface: largest" in told and "off the room by" in told, told
    page.press("#import-told-go")
    punch = page.tree()["tool"][1]
    assert punch["position"] == [0, 0, 25] and punch["stroke"] == 25 and punch["motion"] == "driven", punch
    page.give("#add-files", files / "holder.step")
    page.press("#import-part-go")
    page.until(lambda: len(page.tree()["tool"]) == 3, "the holder")
    page.press("#import-told-go")
    page.until(lambda: page.texts(".fault-words:not(.warning)"), "the holder lies in the stack")
    thick = page.until(lambda: page.js("return plyform_setup.scene && plyform_setup.scene.stack_thickness_mm"))
    page.item("tool.2")
    page.key("tool.2.position", f"{thick:.3f}", part="2")
    page.until(lambda: "position" in page.tree()["tool"][2], "its place")
    page.choose("tool.2.motion", "force")
    page.until(lambda: page.tree()["tool"][2]["motion"] == "force", "it presses")
    page.key("tool.2.direction", "0", part="0")
    page.key("tool.2.direction", "0", part="1")
    page.key("tool.2.direction", "-1", part="2")
    page.key("tool.2.force", "200")
    page.until(lambda: page.tree()["tool"][2].get("force") == 200, "its force")
    page.item("blanks.sheet")
    page.until(lambda: "too coarse" in " ".join(page.texts(".fault-words.warning")), "elements are too coarse")
    page.key("blanks.sheet.element_size", "6")
    page.until(lambda: page.text("#check-state").startswith("1 warning"), "no mistakes; elements are fine enough")
    close, = page.texts(".fault-words")
    assert "punch: comes within" in close and "of tool holder" in close, close


def run(page, name, threads):
    page.press("#run-case-button")
    page.type("#ask-run-name", name)
    page.pick("#ask-run-accuracy", "draft")
    page.type("#ask-run-threads", str(threads))
    page.press("#ask-run-go")
    page.until(lambda: page.text("#run-title") == name, "the run is shown")
    moving = page.when("return Number(document.getElementById('run-picture').dataset.moved) > 1 &&"
                       "[document.getElementById('run-shown').dataset.state]", seconds=300) == ["running"]
    page.until(lambda: page.js("return document.getElementById('run-shown').dataset.state")
               not in ("running", "queued", "starting"), "it ends", seconds=600)
    state = page.js("return document.getElementById('run-shown').dataset.state")
    assert state in ("done", "doubtful"), (state, page.text("#run-message"), page.text("#run-log"))
    assert moving, "plies moved only after the end"
    print(f"  {name}: {state}; {page.text('#run-message')}")
    by_command_line(page, name)


def by_command_line(page, name):
    """As the page says, into another folder."""
    words = shlex.split(page.text("#run-command"))
    words[words.index("-o") + 1] = f"by_hand/{name}"
    place = page.js("return document.querySelector('#run-command').closest('section').querySelector('code').textContent")
    assert Path(place) == page.server.folder.resolve(), place
    path = f"{PROGRAM.parent}{os.pathsep}{os.environ['PATH']}"
    subprocess.run(words, cwd=place, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                   env={**os.environ, "PATH": path})
    found = same_results(page.server.folder / "results" / name, page.server.folder / "by_hand" / name)
    print(f"  {' '.join(words)}: {found} sets of data and history.csv are the same")


def report(page):
    page.press("#run-results")
    page.into_report()
    assert page.text("h1"), "the report has a title"
    most = page.text(".cards .figure")
    page.driver.switch_to.default_content()
    print(f"  report: {most}")


def first_run(page, _):
    run(page, "dome", 1)


def its_report(page, _):
    report(page)


def second_run(page, _):
    """One ply turned, nothing else."""
    page.press("#panels a[href='#setup']")
    page.item("ply.1")
    page.key("ply.1.angle", "30")
    page.until(lambda: page.tree()["ply"][1]["angle"] == 30, "the angle")
    run(page, "dome_30", 2)


def side_by_side(page, _):
    page.press("#run-results")
    page.until(lambda: page.seen("#report-frame"), "its report", seconds=120)
    page.press('#results-list input[data-folder="results/dome"]')
    page.until(lambda: "," in (page.js("return (document.getElementById('report-frame') || {title: ''}).title")),
               "a report of both", seconds=120)
    page.into_report()
    titles = page.texts("h1")
    assert len(titles) == 2, titles
    page.driver.switch_to.default_content()
    page.press("#results-differences")
    page.until(lambda: page.texts("#differences-keys tbody th"), "what differs")
    rows = list(zip(page.texts("#differences-keys tbody th"), page.texts("#differences-keys tbody td:nth-child(2)"),
                    page.texts("#differences-keys tbody td:nth-child(3)")))
    print(f"  differs: {rows}; {page.texts('#differences-figures tbody tr:first-child > *')}")
    assert len(rows) == 1 and rows[0][0].endswith(".angle") and {rows[0][1], rows[0][2]} == {"30", "45"}, rows
    assert len(page.texts("#differences-figures tbody tr")) > 3


PARTS = [new_case, plies, tools, first_run, its_report, second_run, side_by_side]


def main():
    with tempfile.TemporaryDirectory() as scratch:
        files = Path(scratch) / "files"
        files.mkdir()
        write_step(files / "double_dome.step", double_dome)
        write_step(files / "holder.step", holder)
        with Server(TOOLS, PROGRAM, Path(scratch) / "folder") as server, \
                SetupPage(server, server.folder / CASE, 1280, 800) as page:
            for part in PARTS:
                begin = time.monotonic()
                try:
                    part(page, files)
                finally:
                    if PICTURES:
                        PICTURES.mkdir(exist_ok=True)
                        page.screenshot(PICTURES / f"{part.__name__}.png")
                print(f"{part.__name__}: {time.monotonic() - begin:.1f} s", flush=True)
            wrong = [line for line in page.errors() if "422" not in line and "409" not in line]
            assert not wrong, wrong
            outside = [url for url in page.requests() if not url.startswith((server.origin, "data:", "blob:", "about:"))]
            assert not outside, outside


main()
