# SPDX-License-Identifier: GPL-3.0-or-later
"""The set-up page by clicks in Chromium: each control of outline, forms, lists, scene and text, and
what it does to the file; mistakes at their places; two pages; a text that is no TOML.

    studio_setup_test.py TOOLS PROGRAM CASES [PICTURES]
"""

import shutil
import sys
import tempfile
import time
import tomllib
from pathlib import Path

from studio_server import Server
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from studio_page import SetupPage as Page

TOOLS, PROGRAM, CASES = (Path(name).resolve() for name in sys.argv[1:4])
PICTURES = Path(sys.argv[4]) if len(sys.argv) > 4 else None
CASE = "mine/case.toml"


def folder_with_case(root: Path) -> Path:
    (root / "mine").mkdir(parents=True)
    shutil.copytree(CASES / "fabrics", root / "fabrics")
    shutil.copy(CASES / "hemisphere_two_ply" / "case.toml", root / "mine" / "case.toml")
    return root


def outline_and_forms(page: Page) -> None:
    """Numbers, choices, references, lists; each is in the file at once, comments stay."""
    before = page.written()
    comments = [line.split("#", 1)[1] for line in before.splitlines() if "#" in line]
    page.item("ply.1")
    page.key("ply.1.angle", "30")
    page.until(lambda: page.tree()["ply"][1]["angle"] == 30)
    page.key("ply.1.seed", "5", part="0")
    page.until(lambda: page.tree()["ply"][1]["seed"] == [5, 0])
    page.key("ply.1.angle", "")  # needed: taking it away is a mistake, told at the key
    page.until(lambda: "angle" not in page.tree()["ply"][1])
    page.until(lambda: page.seen('[data-at="ply.1"] , [data-at="ply.1.angle"]'))
    page.press("#undo")
    page.until(lambda: page.tree()["ply"][1]["angle"] == 30)
    for comment in comments:
        assert comment in page.written(), comment
    page.item("tool.0")
    page.choose("tool.0.motion", "fixed")  # what goes with driven only goes away too
    page.until(lambda: page.tree()["tool"][0].get("motion") == "fixed")
    assert "stroke" not in page.tree()["tool"][0]
    page.press("#undo")
    page.until(lambda: page.tree()["tool"][0]["motion"] == "driven" and "stroke" in page.tree()["tool"][0])
    page.press("#redo")
    page.until(lambda: page.tree()["tool"][0]["motion"] == "fixed")
    page.press("#undo")
    page.until(lambda: page.written().count("stroke") > 0)


def either_or(page: Page) -> None:
    """stroke or stroke_programme, whose stages are a table."""
    page.item("tool.0")
    page.choose("tool.0.stroke", "tool[].stroke_programme", part="way")
    page.until(lambda: "stroke" not in page.tree()["tool"][0])
    page.press('[data-list="tool.0.stroke_programme"] + [data-act="add-row"]')
    page.until(lambda: page.tree()["tool"][0].get("stroke_programme") == [[0, 0]])
    page.key("tool.0.stroke_programme", "1", part="0.0")
    page.until(lambda: page.tree()["tool"][0]["stroke_programme"] == [[1, 0]])
    page.key("tool.0.stroke_programme", "70", part="0.1")
    page.until(lambda: page.tree()["tool"][0]["stroke_programme"] == [[1, 70]])


def items(page: Page) -> None:
    """Added, copied, moved, removed, renamed."""
    count = len(page.tree()["ply"])
    page.press('[data-add="ply"]')
    page.until(lambda: len(page.tree()["ply"]) == count + 1)
    page.press('[data-item="ply.0"] button.item')
    page.press('[data-item="ply.0"] [data-act="copy"]')
    page.until(lambda: len(page.tree()["ply"]) == count + 2)
    names = [ply["name"] for ply in page.tree()["ply"]]
    assert len(set(names)) == len(names), names
    page.item("ply.1")
    page.press('[data-item="ply.1"] [data-act="up"]')
    page.until(lambda: page.tree()["ply"][0]["name"] == names[1])
    page.item("ply.0")
    page.press('[data-item="ply.0"] [data-act="down"]')
    page.until(lambda: page.tree()["ply"][1]["name"] == names[1])
    for _ in range(2):
        last = len(page.tree()["ply"]) - 1
        page.item(f"ply.{last}")
        page.press(f'[data-item="ply.{last}"] [data-act="remove"]')
        page.until(lambda: len(page.tree()["ply"]) == last)
    page.press('[data-add="tool"]')
    page.until(lambda: page.tree()["tool"][-1]["shape"] == "sphere")
    page.press("#undo")
    page.press('[data-add="blanks"]')
    page.until(lambda: len(page.tree()["blanks"]) == 2)
    page.press("#undo")
    page.until(lambda: len(page.tree()["blanks"]) == 1)
    blank = next(iter(page.tree()["blanks"]))
    page.item(f"blanks.{blank}")
    page.key(f"blanks.{blank}", "sheet", part="name")
    page.until(lambda: list(page.tree()["blanks"]) == ["sheet"])
    assert all(ply["blank"] == "sheet" for ply in page.tree()["ply"])


def fabrics(page: Page, folder: Path) -> None:
    """Added by a dialogue; its own file is edited in its form."""
    page.press('[data-add="fabrics"]')
    page.pick("#add-fabric-path", "../fabrics/ncf_biaxial_pillar.toml")
    page.type("#add-fabric-name", "ncf")
    page.press("#add-fabric-go")
    page.until(lambda: page.tree()["fabrics"].get("ncf") == "../fabrics/ncf_biaxial_pillar.toml")
    page.until(lambda: page.seen('[data-key="fabrics.ncf.thickness"]'))
    file = folder / "fabrics" / "ncf_biaxial_pillar.toml"
    before = tomllib.loads(file.read_text())["thickness"]
    page.key("fabrics.ncf.thickness", "0.77")
    page.until(lambda: tomllib.loads(file.read_text())["thickness"] == 0.77)
    page.press("#undo")  # takes back what was changed last, in whatever file
    page.until(lambda: tomllib.loads(file.read_text())["thickness"] == before)
    assert page.tree()["fabrics"].get("ncf")
    page.press("#redo")
    page.until(lambda: tomllib.loads(file.read_text())["thickness"] == 0.77)
    stitches = len(tomllib.loads(file.read_text())["stitch"])
    page.press('[data-add="fabrics.ncf.stitch"]')
    page.until(lambda: len(tomllib.loads(file.read_text())["stitch"]) == stitches + 1)
    page.press(f'[aria-label="Remove fabrics.ncf.stitch.{stitches}"]')
    page.until(lambda: len(tomllib.loads(file.read_text())["stitch"]) == stitches)


def onto_the_stack(page: Page) -> None:
    """A punch that a ply more has pushed into the stack, and one far above, are set onto it by a click."""
    at = next(i for i, tool in enumerate(page.tree()["tool"]) if tool.get("motion") == "driven")
    place = page.tree()["tool"][at]["position"]
    page.item(f"tool.{at}")
    for other in (-0.8, 25.0):
        page.key(f"tool.{at}.position", f"{place[2] + other:.4f}", part="2")
        page.until(lambda: abs(page.js("return plyform_setup.scene.tools[arguments[0]].gap.mm", at) - other) < 1e-3)
        page.press("#touch-stack")
        page.until(lambda: abs(page.tree()["tool"][at]["position"][2] - place[2]) < 1e-3)


def simplified_tools(page: Page) -> None:
    """Tools are drawn with fewer triangles while something moves: as large, within a cell, and whole."""
    found = page.js("""return plyform_setup.area.view.bodies.tools.filter((mesh) => mesh.light).map((mesh) => {
      const box = ({ x }) => new window.THREE.Box3().setFromArray(x);
      const [whole, light] = [box(mesh.tool), box(mesh.light.tool)];
      const edges = new Map();
      const nodes = mesh.light.tool.triangles;
      for (let i = 0; i < nodes.length; ++i) {
        const pair = [nodes[i], nodes[i % 3 === 2 ? i - 2 : i + 1]].sort().join();
        edges.set(pair, (edges.get(pair) || 0) + 1);
      }
      return { name: mesh.tool.name, off: whole.min.distanceTo(light.min) + whole.max.distanceTo(light.max),
        size: mesh.tool.size, torn: [...edges.values()].filter((count) => count > 2).length / edges.size };
    })""")
    assert found
    for tool in found:
        assert tool["off"] < 0.01 * tool["size"] and tool["torn"] < 0.02, tool
def rows_of_fabrics(page: Page, folder: Path) -> None:
    """Families, stitches, crossings: copied, moved, removed; a table taken away and given again."""
    file = folder / "fabrics" / "ncf_biaxial_pillar.toml"

    def act(word, key, holds):
        page.press(f'[aria-label="{word} fabrics.ncf.{key}"]')
        page.until(lambda: holds(tomllib.loads(file.read_text())), f"{word} {key}")
    page.item("fabrics.ncf")
    for name in ("family", "stitch", "crossing"):
        before = tomllib.loads(file.read_text())[name]
        count = len(before)
        act("Copy", f"{name}.0", lambda tree, n=name, c=count: len(tree[n]) == c + 1)
        first, second = tomllib.loads(file.read_text())[name][:2]
        act("Move down", f"{name}.0", lambda tree, n=name, one=second: tree[n][0] == one)
        act("Move up", f"{name}.1", lambda tree, n=name, one=first: tree[n][0] == one)
        act("Remove", f"{name}.1", lambda tree, n=name, all_=before: tree[n] == all_)
    plain = next(name for name in page.tree()["fabrics"] if name != "ncf")
    page.item(f"fabrics.{plain}")
    text = (folder / "mine" / page.tree()["fabrics"][plain]).read_text()
    page.press(f'[aria-label="Remove fabrics.{plain}.shear"]')
    file = folder / "mine" / page.tree()["fabrics"][plain]
    page.until(lambda: "shear" not in tomllib.loads(file.read_text()), "the table is gone")
    file.write_text(text)
    page.until(lambda: page.seen(f'[aria-label="Remove fabrics.{plain}.shear"]'), "the table is there again")


def lists(page: Page) -> None:
    """Points, arcs, holes, rows; boundaries and loads; all of it is taken back."""
    before = page.tree()
    at = next(k for k, tool in enumerate(before["tool"]) if tool["shape"] == "profile")
    key = f"tool.{at}.points"
    page.item(f"tool.{at}")
    points = before["tool"][at]["points"]
    page.key(key, "-130", part="0.b")
    page.until(lambda: page.tree()["tool"][at]["points"][0][1] == -130, "a point")
    page.key(key, "81", part="0.a")
    page.until(lambda: page.tree()["tool"][at]["points"][0][0] == 81, "a point")
    page.key(key, "9", part="1.fillet")
    page.until(lambda: page.tree()["tool"][at]["points"][1][2] == 9, "a fillet")
    page.choose(key, "arc", part="1.kind")
    page.until(lambda: page.tree()["tool"][at]["points"][1]["turn"] == "left", "an arc")
    for part, where, value in (("1.to0", ("to", 0), 90), ("1.to1", ("to", 1), 5), ("1.centre0", ("centre", 0), 85),
                               ("1.centre1", ("centre", 1), 2)):
        page.key(key, str(value), part=part)
        page.until(lambda w=where, v=value: page.tree()["tool"][at]["points"][1][w[0]][w[1]] == v, part)
    page.choose(key, "right", part="1.turn")
    page.until(lambda: page.tree()["tool"][at]["points"][1]["turn"] == "right", "its turn")
    page.press(f'[data-list="{key}"] [data-act="add-row"]')
    page.until(lambda: len(page.tree()["tool"][at]["points"]) == len(points) + 1, "one more")
    page.press(f'[data-list="{key}"] .point:last-of-type [data-act="remove-row"]')
    page.until(lambda: len(page.tree()["tool"][at]["points"]) == len(points), "one less")
    key = f"blanks.{next(iter(before['blanks']))}"
    page.item(key)
    page.press('[data-act="add-circle"]')
    for part, value in (("0.x", 5), ("0.y", 6), ("0.radius", 7)):
        page.key(f"{key}.holes", str(value), part=part)
    page.until(lambda: list(page.tree()["blanks"].values())[0]["holes"] == [{"centre": [5, 6], "radius": 7}], "a hole")
    page.press('[data-act="add-outline"]')
    page.until(lambda: len(list(page.tree()["blanks"].values())[0]["holes"]) == 2, "two holes")
    page.press('.holes legend [data-act="remove-row"]')
    page.until(lambda: len(list(page.tree()["blanks"].values())[0]["holes"]) == 1, "one hole")
    for group in ("boundary", "load"):
        page.press(f'[data-add="{group}"]')
        page.until(lambda g=group: len(page.tree()[g]) == 1, group)
    while page.tree() != before:
        now = page.written()
        page.press("#undo")
        page.until(lambda n=now: page.written() != n, "taken back")


def cancelled(page: Page, folder: Path) -> None:
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
    page.type("#import-part-deflection", "0.1")
    page.press("#import-part-replace")
    page.press("#import-part-go")
    page.until(lambda: "0 to 80 degrees" in page.text("#import-part .words"), "90 degrees are too many")
    page.type("#import-part-shear", "0")
    page.press("#import-part-go")
    page.until(lambda: "is no STEP file" in page.text("#import-part .words"), "what is no part is told")
    page.press("#import-part-cancel")
    page.drop("other.dxf", DXF)
    page.pick("#import-drawing-unit", "cm")
    page.type("#import-drawing-element_size", "12")
    page.press("#import-drawing-cancel")
    page.drop("again.toml", (folder / "fabrics" / "glass_plain_weave.toml").read_bytes())
    page.press("#import-fabric-cancel")
    page.drop("again.toml", b"")
    page.press("#replace-cancel")
    page.until(lambda: not page.seen("dialog"), "all are closed")
    assert page.written() == before and (folder / "mine/again.toml").read_bytes()


def text_beside(page: Page) -> None:
    """Both ways; what is no TOML is told with its line and not saved."""
    page.item("case")
    page.key("title", "Set by the form")
    page.until(lambda: "Set by the form" in page.js("return plyform_setup.editor.mirror.getValue()"))
    saved = page.written()
    page.write_text(saved.replace("Set by the form", "Set by the text"))
    page.until(lambda: page.tree()["title"] == "Set by the text")
    page.until(lambda: page.value("title") == "Set by the text")
    saved = page.written()
    page.write_text(saved + "\n[[tool\n")
    line = saved.count("\n") + 2
    page.until(lambda: f"line {line}" in page.text("#toml-note") and "not saved" in page.text("#toml-note"))
    assert page.written() == saved
    assert page.seen(f'.fault[data-line="{line}"]')
    page.press("#toml-revert")
    page.until(lambda: page.js("return plyform_setup.editor.mirror.getValue()") == saved)
    page.press("#show-toml")
    assert not page.find("#toml").is_displayed()
    page.press("#show-toml")
    assert page.find("#toml").is_displayed()


def mistakes(page: Page) -> None:
    """At the key, in the outline, in the scene, in the text, in the list, which leads there."""
    page.until(lambda: "wrong" not in page.find("#check-state").get_attribute("class"), seconds=120)
    page.item("ply.1")
    page.key("ply.1.name", page.tree()["ply"][0]["name"])
    page.until(lambda: page.seen(".fault-words:not(.warning)"), seconds=120)
    assert page.seen('[data-item="ply.1"] b.wrong')
    assert page.seen(".fault-line")
    page.until(lambda: page.seen(".callout.wrong"), seconds=30)
    page.item("case")
    page.press(".fault-words:not(.warning)")
    page.until(lambda: page.js("return plyform_setup.chosen") == "ply.1")
    assert page.seen('[data-at="ply.1.name"] .words')
    page.press("#undo")
    page.until(lambda: not page.seen(".fault-words:not(.warning)"), seconds=120)


def scene_controls(page: Page) -> None:
    """Every control of the picture changes it."""
    page.until(lambda: page.js("return Boolean(plyform_setup.scene)"), seconds=60)
    for control in ("top", "bottom", "front", "side", "oblique"):
        page.changes_picture(lambda c=control: page.press(f"#scene-view-{c}"))
    for value in ("solid", "hidden", "outlines"):
        page.changes_picture(lambda v=value: page.pick("#scene-tools", v))
    page.changes_picture(lambda: page.pick("#scene-yarns", "5"))
    for value in ("x", "y", "level", "angle"):
        page.changes_picture(lambda v=value: page.pick("#scene-section", v))
    page.changes_picture(lambda: page.slide("#scene-section-angle", 30))
    page.changes_picture(lambda: page.slide("#scene-section-offset", 10))
    page.pick("#scene-section", "off")
    page.changes_picture(lambda: page.slide("#scene-apart", 30))
    page.slide("#scene-apart", 0)
    page.changes_picture(lambda: page.slide("#scene-stroke", 50))
    assert page.text("#scene-stroke-words") == "50 %"
    page.slide("#scene-stroke", 0)
    page.press("#scene-labels")
    assert not page.find(".callouts").is_displayed()
    page.press("#scene-labels")
    assert page.seen(".callout")
    pane = page.find(".scene-pane")
    pane.send_keys("2")
    assert page.js("return plyform_setup.area.view.stage.camera.elevation") == 90
    pane.send_keys("t")
    assert page.js("return plyform_setup.area.view.settings.tools") == "solid"
    pane.send_keys("ttm")
    assert page.find("#scene-measure").get_attribute("aria-pressed") == "true"


def measuring(page: Page) -> None:
    """Between two corners of the blank, seen from above: the length of its side."""
    if page.find("#scene-measure").get_attribute("aria-pressed") == "false":
        page.press("#scene-measure")
    page.pick("#scene-tools", "hidden")
    page.press("#scene-view-top")
    page.press("#scene-view-home")
    for corner in (0, 1):
        page.click_node(0, corner, inwards=0.01)  # the corner takes what is nearer than 8 pixels
    size = page.tree()["blanks"]["sheet"]["size"]
    words = page.text("#measured")
    assert words.startswith(f"{size[0]:g} mm") or words.startswith(f"{size[1]:g} mm"), (words, size)
    page.press("#scene-measure")


def chosen_in_scene(page: Page) -> None:
    """A click on a body chooses its form; its handle and dial turn the yarns."""
    page.click_node(-1, 0, inwards=0.3)
    last = len(page.tree()["ply"]) - 1
    page.until(lambda: page.js("return plyform_setup.chosen") == f"ply.{last}")
    knob = page.find('[data-handle="angle"]')
    before = page.tree()["ply"][last]["angle"]
    ActionChains(page.driver).click_and_hold(knob).move_by_offset(-60, -80).move_by_offset(-10, -10).perform()
    assert page.tree()["ply"][last]["angle"] == before  # while it is dragged it only turns the picture
    assert page.js("return plyform_setup.area.view.marks.handle.angle") != before
    ActionChains(page.driver).release().perform()
    page.until(lambda: page.tree()["ply"][last]["angle"] != before)
    turned = page.tree()["ply"][last]["angle"]

    def click_dial():
        dial = page.find(f'[data-dial="ply.{last}.angle"]')
        ActionChains(page.driver).move_to_element_with_offset(dial, 0, -15).click().perform()
        return True
    page.until(click_dial, "its dial is clicked, which each answer draws anew")
    page.until(lambda: page.tree()["ply"][last]["angle"] == 90)
    assert turned != 90
    page.find(".scene-pane").click()
    page.find(".scene-pane").send_keys(Keys.CONTROL, "z")
    page.until(lambda: page.tree()["ply"][last]["angle"] == turned)


def last_good_scene(page: Page) -> None:
    """What cannot be drawn leaves the picture, with a note."""
    picture = page.js("return plyform_setup.scene.plies.length")
    page.write_text(page.written() + "\nwhat is this\n")
    page.until(lambda: "not saved" in page.text("#toml-note"))
    assert page.js("return plyform_setup.scene.plies.length") == picture
    page.press("#toml-revert")


def two_pages(page: Page, folder: Path) -> None:
    """Another page, and another program, change the file: this page shows it."""
    first = page.driver.current_window_handle
    page.item("case")
    address = page.driver.current_url
    page.driver.switch_to.new_window("tab")
    page.driver.get(address)
    page.until(lambda: page.seen('[data-key="title"]'), seconds=60)
    page.key("title", "Of the other page")
    page.until(lambda: page.tree()["title"] == "Of the other page")
    page.driver.close()
    page.driver.switch_to.window(first)
    page.until(lambda: page.value("title") == "Of the other page")
    file = folder / CASE
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


def dropped_files(page: Page, folder: Path) -> None:
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
    page.drop("mine.toml", (folder / "fabrics" / "glass_plain_weave.toml").read_bytes())
    page.type("#import-fabric-name", "own")
    page.press("#import-fabric-go")
    page.until(lambda: page.tree()["fabrics"]["own"] == "mine.toml")
    page.press("#undo")
    page.until(lambda: "own" not in page.tree()["fabrics"])
    page.drop("box.stl", STL.replace(b"0.2", b"0.3"))
    page.press("#replace-go")
    page.until(lambda: page.seen("#import-mesh-cancel"))
    page.press("#import-mesh-cancel")
    assert b"0.3" in (folder / "mine" / "box.stl").read_bytes()
    page.drop("what.exe", b"no")
    page.until(lambda: "what.exe" in page.text("#trouble"))


def chosen_files(page: Page, folder: Path) -> None:
    """A file that is chosen does what one that is dropped does; the same may be chosen again; a curve goes on
    to Identification, and the tab of the set-up leads back to the case."""
    tools = len(page.tree()["tool"])
    mesh = folder.parent / "chosen.stl"
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
    assert (folder / "mine/chosen.stl").read_bytes() == STL
    for left in (1, 0):
        page.press("#undo")
        page.until(lambda n=tools - 2 + left: len(page.tree()["tool"]) == n, "it is taken back")
    curve = folder.parent / "curve.csv"
    curve.write_text("extension (mm),load (N)\n0,0\n1,2\n", encoding="utf-8")
    page.give("#add-files", curve)
    page.until(lambda: page.texts("#curve-rows code") == ["mine/curve.csv"], "the curve is there")
    assert page.driver.current_url.endswith("#identify/curve/mine/curve.csv")
    page.press("#panels a:first-child")
    page.until(lambda: page.find("#panel-setup").is_displayed(), "the set-up is shown")


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
        chosen = page.texts("#panels a[aria-selected=true]")
        assert chosen == [page.text(f'#panels a[href="#{name}"]')], (name, chosen)
        page.until(lambda n=name: page.js("return document.getElementById(arguments[0]).childElementCount",
                                          f"panel-{n}"), f"{name} has content")
    time.sleep(0.5)  # the set-up would go to another case now
    assert page.js("return plyform_setup.main.path") == page.find("#case-list").get_attribute("value") \
        == "second/case.toml"
    page.pick("#case-list", CASE)
    page.until(lambda: page.js("return plyform_setup.main.path") == CASE)


def first_case() -> None:
    """An empty folder says so, and its button makes the first case."""
    with Server(TOOLS, PROGRAM) as server, Page(server, server.folder / "begun/case.toml", 1280, 800) as page:
        page.go(server)
        page.until(lambda: page.find(".setup-empty").is_displayed(), "it is empty")
        assert not page.find(".setup-body").is_displayed() and not page.find("#undo").is_displayed()
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


PARTS = [onto_the_stack, simplified_tools, outline_and_forms, either_or, items, fabrics, rows_of_fabrics, lists,
         text_beside, scene_controls, measuring, chosen_in_scene, last_good_scene, two_pages, new_cases,
         tabs, dropped_files, chosen_files, cancelled, mistakes, run]
OF_FOLDER = (fabrics, rows_of_fabrics, two_pages, dropped_files, chosen_files, cancelled)


def main() -> None:
    with tempfile.TemporaryDirectory() as scratch:
        folder = folder_with_case(Path(scratch) / "folder")
        with Server(TOOLS, PROGRAM, folder) as server, Page(server, folder / CASE, 1280, 800) as page:
            page.open(f"#setup/{CASE}")
            for part in PARTS:
                begin = time.monotonic()
                try:
                    part(page, folder) if part in OF_FOLDER else part(page)
                finally:
                    if PICTURES:
                        page.screenshot(PICTURES / f"{part.__name__}.png")
                print(f"{part.__name__}: {time.monotonic() - begin:.1f} s", flush=True)
            wrong = [line for line in page.errors() if "422" not in line and "409" not in line]
            assert not wrong, wrong
            outside = [url for url in page.requests() if not url.startswith((server.origin, "data:", "blob:"))]
            assert not outside, outside
    first_case()


main()
