# SPDX-License-Identifier: GPL-3.0-or-later
"""The scene of the set-up by clicks in Chromium: each control changes the picture; what is clicked in it is chosen,
turned, measured; what cannot be drawn leaves the last picture.

    studio_setup_scene_test.py TOOLS PROGRAM CASES [PICTURES]
"""

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from studio_page import SetupPage as Page
from studio_setup import go_through


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
    found = page.when("""return plyform_setup.area.view.bodies.tools.filter((mesh) => mesh.light).map((mesh) => {
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
    for tool in found:
        assert tool["off"] < 0.01 * tool["size"] and tool["torn"] < 0.02, tool


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
    page.until(lambda: page.text("#scene-stroke-words") == "50 %", "the words follow")
    page.slide("#scene-stroke", 0)
    page.press("#scene-labels")
    page.until(lambda: not page.find(".callouts").is_displayed(), "labels are hidden, with the next picture")
    page.press("#scene-labels")
    page.until(lambda: page.seen(".callout") and page.find(".callouts").is_displayed(), "labels are there again")
    pane = page.find(".scene-pane")
    pane.send_keys("2")
    page.when("return plyform_setup.area.view.stage.camera.elevation === 90")
    pane.send_keys("t")
    page.when("return plyform_setup.area.view.settings.tools === 'solid'")
    pane.send_keys("ttm")
    page.until(lambda: page.find("#scene-measure").get_attribute("aria-pressed") == "true", "m measures")


def measuring(page: Page) -> None:
    """Between two corners of the blank, seen from above: the length of its side."""
    if page.find("#scene-measure").get_attribute("aria-pressed") == "false":
        page.press("#scene-measure")
    page.pick("#scene-tools", "hidden")
    page.press("#scene-view-top")
    page.press("#scene-view-home")
    for corner in (0, 1):
        page.click_node(0, corner, inwards=0.01)  # the corner takes what is nearer than 8 pixels
    size = next(iter(page.tree()["blanks"].values()))["size"]
    page.until(lambda: page.text("#measured").startswith((f"{size[0]:g} mm", f"{size[1]:g} mm")), f"it is one of {size}")
    page.press("#scene-measure")


def chosen_in_scene(page: Page) -> None:
    """A click on a body chooses its form; its handle and dial turn the yarns."""
    page.click_node(-1, 0, inwards=0.3)
    last = len(page.tree()["ply"]) - 1
    page.until(lambda: page.js("return plyform_setup.chosen") == f"ply.{last}")
    before = page.tree()["ply"][last]["angle"]

    def drag():
        knob = page.near('[data-handle="angle"]')
        if knob:
            ActionChains(page.driver).click_and_hold(knob).move_by_offset(-60, -80).move_by_offset(-10, -10).perform()
        return knob
    page.until(drag, "its handle is dragged")
    page.until(lambda: page.js("return plyform_setup.area.view.marks.handle.angle") != before, "it turns the picture")
    assert page.tree()["ply"][last]["angle"] == before  # and nothing else while it is dragged
    ActionChains(page.driver).release().perform()
    page.until(lambda: page.tree()["ply"][last]["angle"] != before)
    turned = page.tree()["ply"][last]["angle"]

    def click_dial():
        dial = page.near(f'[data-dial="ply.{last}.angle"]')
        if dial:
            ActionChains(page.driver).move_to_element_with_offset(dial, 0, -15).click().perform()
        return dial
    page.until(click_dial, "its dial is clicked, which each answer draws anew")
    page.until(lambda: page.tree()["ply"][last]["angle"] == 90)
    assert turned != 90
    page.press(".scene-pane")
    page.find(".scene-pane").send_keys(Keys.CONTROL, "z")
    page.until(lambda: page.tree()["ply"][last]["angle"] == turned)


def last_good_scene(page: Page) -> None:
    """What cannot be drawn leaves the picture, with a note."""
    picture = page.js("return plyform_setup.scene.plies.length")
    page.write_text(page.written() + "\nwhat is this\n")
    page.until(lambda: "not saved" in page.text("#toml-note"))
    assert page.js("return plyform_setup.scene.plies.length") == picture
    page.press("#toml-revert")


go_through([onto_the_stack, simplified_tools, scene_controls, measuring, chosen_in_scene, last_good_scene])
