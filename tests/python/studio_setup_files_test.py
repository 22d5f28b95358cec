# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases and files of the set-up by clicks in Chromium: made, opened, changed by others, dropped in, run.

    studio_setup_files_test.py TOOLS PROGRAM CASES [PICTURES]
"""

import time
from pathlib import Path

from studio_page import SetupPage as Page
from studio_server import Server
from studio_setup import CASE, PROGRAM, TOOLS, go_through

STL = b"""solid box
facet normal 0 0 1
outer loop
vertex 0 0 0.1
vertex 0.2 0 0.1
vertex 0 0.1 0.1
endloop
endfacet
endsolid
"""
DXF = b"\n".join(b" %s\n%s" % pair for pair in (
    (b"0", b"SECTION"), (b"2", b"ENTITIES"), (b"0", b"CIRCLE"), (b"8", b"0"), (b"10", b"0"), (b"20", b"0"),
    (b"40", b"150"), (b"0", b"ENDSEC"), (b"0", b"EOF"))) + b"\n"


def two_pages(page: Page) -> None:
    """Another page, and another program, change the file: this page shows it."""
    first = page.driver.current_window_handle
    page.item("case")
    address = page.driver.current_url
    page.driver.switch_to.new_window("tab")
    page.driver.get(address)
    page.until(lambda: page.seen('[data-key="title"]'), "the form is shown")
    page.key("title", "Of the other page")
    page.until(lambda: page.tree()["title"] == "Of the other page")
    page.driver.close()
    page.driver.switch_to.window(first)
    page.until(lambda: page.value("title") == "Of the other page")
    file = page.server.folder / CASE
    file.write_text(file.read_text().replace("Of the other page", "Of an editor"))
    page.until(lambda: page.value("title") == "Of an editor")


def new_cases(page: Page) -> None:
    """A copy, and an example; the address leads to each."""
    page.press("#new-case-button")
    page.type("#new-case-name", "second")
    page.pick("#new-case-from", CASE)
    page.press("#new-case-go")
    page.until(lambda: "#setup/second/case.toml" in page.driver.current_url)
    page.until(lambda: page.js("return plyform_setup.main.path") == "second/case.toml")
    page.pick("#case-list", CASE)
    page.until(lambda: page.js("return plyform_setup.main.path") == CASE)


def tabs(page: Page) -> None:
    """Each shows its panel alone; back at the set-up the case is the one before, not the first of the folder."""
    page.pick("#case-list", "second/case.toml")
    page.until(lambda: page.js("return plyform_setup.main.path") == "second/case.toml")
    page.pick("#case-list", CASE)
    page.until(lambda: page.js("return plyform_setup.main.path") == CASE)
    page.pick("#case-list", "second/case.toml")
    page.until(lambda: page.js("return plyform_setup.main.path") == "second/case.toml")
    names = page.js("return [...document.querySelectorAll('#panels a')].map((tab) => tab.hash.slice(1))")
    assert names == ["setup", "runs", "results", "studies", "identify"], names
    for name in [*names[1:], names[0]]:
        page.press(f'#panels a[href="#{name}"]')
        page.until(lambda n=name: page.js("return [...document.querySelectorAll('main > section')]"
                                          ".filter((one) => one.getClientRects().length).map((one) => one.id)")
                   == [f"panel-{n}"], f"{name} alone is shown")
        page.until(lambda n=name: page.texts("#panels a[aria-selected=true]") ==
                   [page.text(f'#panels a[href="#{n}"]')], f"{name} is chosen")
        page.until(lambda n=name: page.js("return document.getElementById(arguments[0]).childElementCount",
                                          f"panel-{n}"), f"{name} has content")
    time.sleep(0.5)  # the set-up would go to another case now
    assert page.js("return plyform_setup.main.path") == page.find("#case-list").get_attribute("value") \
        == "second/case.toml"
    page.pick("#case-list", CASE)
    page.until(lambda: page.js("return plyform_setup.main.path") == CASE)


def dropped_files(page: Page) -> None:
    """A mesh with its unit, a drawing, a fabric; one that is there already is replaced when that is said."""
    tools = len(page.tree()["tool"])
    page.drop("box.stl", STL)
    page.pick("#import-mesh-unit", "m")
    page.until(lambda: "200 × 100 × 0 mm" in page.text("#import-mesh .note"))
    page.press("#import-mesh-go")
    page.until(lambda: len(page.tree()["tool"]) == tools + 1)
    assert page.tree()["tool"][-1] == {"name": "box", "shape": "mesh", "file": "box.stl", "scale": 1000.0}
    page.press("#undo")
    page.drop("blank.dxf", DXF)
    page.press("#import-drawing-go")
    page.until(lambda: page.tree()["blanks"]["blank"]["outline_file"] == "blank.dxf")
    page.press("#undo")
    page.drop("mine.toml", (page.server.folder / "fabrics" / "glass_plain_weave.toml").read_bytes())
    page.type("#import-fabric-name", "own")
    page.press("#import-fabric-go")
    page.until(lambda: page.tree()["fabrics"]["own"] == "mine.toml")
    page.press("#undo")
    page.until(lambda: "own" not in page.tree()["fabrics"])
    page.drop("box.stl", STL.replace(b"0.2", b"0.3"))
    page.press("#replace-go")
    page.until(lambda: page.seen("#import-mesh-cancel"))
    page.press("#import-mesh-cancel")
    assert b"0.3" in (page.server.folder / "mine" / "box.stl").read_bytes()
    for name in ("what.exe", "curve.xlsx"):
        page.drop(name, b"no")
        page.until(lambda n=name: f"{n}: a file that ends with" in page.text("#trouble"), f"{name} is refused")
    page.until(lambda: page.text("#trouble").endswith("save a spreadsheet as CSV"), "the remedy is told")


def chosen_files(page: Page) -> None:
    """A file that is chosen does what one that is dropped does; the same may be chosen again; a curve goes on
    to Identification, and the tab of the set-up leads back to the case."""
    tools = len(page.tree()["tool"])
    mesh = page.server.folder.parent / "chosen.stl"
    mesh.write_bytes(STL)
    for replaced in (False, True):
        page.give("#add-files", mesh)
        if replaced:
            page.press("#replace-go")
        page.pick("#import-mesh-unit", "m")
        page.press("#import-mesh-go")
        tools += 1
        page.until(lambda n=tools: len(page.tree()["tool"]) == n, "the tool is added")
        assert page.tree()["tool"][-1]["file"] == "chosen.stl", page.tree()["tool"][-1]
    assert (page.server.folder / "mine/chosen.stl").read_bytes() == STL
    for left in (1, 0):
        page.press("#undo")
        page.until(lambda n=tools - 2 + left: len(page.tree()["tool"]) == n, "it is taken back")
    curve = page.server.folder.parent / "curve.csv"
    curve.write_text("extension (mm),load (N)\n0,0\n1,2\n", encoding="utf-8")
    second = curve.with_name("second.csv")
    second.write_bytes(curve.read_bytes())
    page.give("#add-files", curve, second)
    page.until(lambda: page.texts("#curve-rows code") == ["mine/curve.csv", "mine/second.csv"], "both curves are there")
    page.until(lambda: "#identify/curve/mine/curve.csv" in page.driver.current_url, "the address is theirs")
    page.press("#panels a:first-child")
    page.until(lambda: page.find("#panel-setup").is_displayed(), "the set-up is shown")


def cancelled(page: Page) -> None:
    """Every window can be left, and nothing is changed by it; a part that is none is told in its window."""
    before = page.written()
    for button, name in (("#new-case-button", "new-case"), ('[data-add="fabrics"]', "add-fabric"),
                         ("#run-case-button", "ask-run")):
        page.press(button)
        page.press(f"#{name}-cancel")
        page.until(lambda: not page.seen("dialog"), f"{name} is closed")
    page.drop("part.step", b"no part")
    page.pick("#import-part-make", "offset")
    page.type("#import-part-offset", "1.5")
    page.pick("#import-part-make", "stack")
    page.type("#import-part-shear", "90")
    page.pick("#import-part-on", "punch")
    page.pick("#import-part-solid", "tool")
    page.pick("#import-part-tools", "stay")
    page.type("#import-part-direction", "0 0 0")
    page.type("#import-part-deflection", "0.1")
    page.press("#import-part-replace")
    page.press("#import-part-go")
    page.until(lambda: "0 to 80 degrees" in page.text("#import-part .words"), "90 degrees are too many")
    page.type("#import-part-shear", "0")
    page.press("#import-part-go")
    page.until(lambda: "not all 0" in page.text("#import-part .words"), "a direction is wanted")
    page.type("#import-part-direction", "0 0 -1")
    page.press("#import-part-go")
    page.until(lambda: "is no STEP file" in page.text("#import-part .words"), "what is no part is told")
    page.press("#import-part-cancel")
    page.drop("other.dxf", DXF)
    page.pick("#import-drawing-unit", "cm")
    page.type("#import-drawing-element_size", "12")
    page.press("#import-drawing-cancel")
    page.drop("again.toml", (page.server.folder / "fabrics" / "glass_plain_weave.toml").read_bytes())
    page.press("#import-fabric-cancel")
    page.drop("again.toml", b"")
    page.press("#replace-cancel")
    page.until(lambda: not page.seen("dialog"), "all are closed")
    assert page.written() == before and (page.server.folder / "mine/again.toml").read_bytes()


def first_case() -> None:
    """An empty folder says so, and its button makes the first case."""
    with Server(TOOLS, PROGRAM) as server, Page(server, server.folder / "begun/case.toml", 1280, 800) as page:
        page.go(server)
        page.until(lambda: page.find(".setup-empty").is_displayed(), "it is empty")
        page.until(lambda: not page.find(".setup-body").is_displayed() and not page.find("#undo").is_displayed(),
                   "there is nothing else")
        page.press("#first-case")
        page.type("#new-case-name", "begun")
        page.press("#new-case-go")
        page.until(lambda: page.find("#case-list").get_attribute("value") == "begun/case.toml", "it is shown")
        page.until(lambda: page.find(".setup-body").is_displayed() and not page.find(".setup-empty").is_displayed())
        assert page.tree()["ply"] and page.tree()["tool"]
        assert not page.errors(), page.errors()


def run(page: Page) -> None:
    """Asked for by its button; the server has a record of it."""
    page.press("#run-case-button")
    page.type("#ask-run-name", "by_click")
    page.pick("#ask-run-accuracy", "draft")
    page.press("#ask-run-verify")
    page.type("#ask-run-threads", "1")
    page.type("#ask-run-budget", "0.001")
    page.press("#ask-run-go")
    page.until(lambda: page.driver.current_url.endswith("#runs/results/by_click"))
    names = [one["name"] for one in page.server.get("api/runs")]
    assert "by_click" in names, names


def in_place_of_tools(page: Page) -> None:
    """Die and punch that were made take the place of the tools that there are, by one change; those of the same
    file stay what they are."""
    before = page.written()
    for name in ("part_die.stl", "part_punch.stl"):
        (page.file.parent / name).write_bytes(STL)
    add = ("return plyform_setup.imports.addMeshes(['mine/part_die.stl', 'mine/part_punch.stl'], { bottom: 3, punch: "
           "{ position: [0, 0, arguments[0]], stroke: arguments[0] } }, [0, 0, -1], arguments[1])")
    page.js(add, 25, True)
    tools = page.until(lambda: page.tree()["tool"], "there are tools")
    assert sorted(tool["name"] for tool in tools) == ["die", "punch"], tools
    punch = next(tool for tool in tools if tool["name"] == "punch")
    assert punch == {"name": "punch", "shape": "mesh", "file": "part_punch.stl", "motion": "driven", "direction": [0, 0, -1],
                     "position": [0, 0, 25], "stroke": 25}, punch
    assert page.tree()["stack"]["bottom"] == 3
    page.js(add, 30, False)  # made once more, of the same names
    tools = page.tree()["tool"]
    assert len(tools) == 2 and next(tool for tool in tools if tool["name"] == "punch")["stroke"] == 30, tools
    page.until(lambda: page.js("return plyform_setup.done.length") >= 2)
    for _ in range(2):
        page.press("#undo")
    page.until(lambda: page.written() == before, "it is as before")


go_through([two_pages, new_cases, tabs, dropped_files, chosen_files, cancelled, in_place_of_tools, run])
first_case()
