# SPDX-License-Identifier: GPL-3.0-or-later
"""The forms of the set-up by clicks in Chromium: each control of outline, forms, lists and text, and what it does
to the files; mistakes at their places; a text that is no TOML.

    studio_setup_forms_test.py TOOLS PROGRAM CASES [PICTURES]
"""

import tomllib

from studio_page import SetupPage as Page, of_key
from studio_setup import go_through


def outline_and_forms(page: Page) -> None:
    """Numbers, choices, references, lists; each is in the file at once, comments stay."""
    before = page.written()
    comments = [line.split("#", 1)[1] for line in before.splitlines() if "#" in line]
    page.item("ply.1")
    page.key("ply.1.angle", "30")
    page.until(lambda: page.tree()["ply"][1]["angle"] == 30)
    page.key("ply.1.seed", "5", part="0")
    page.until(lambda: page.tree()["ply"][1]["seed"] == [5, 0])
    page.until(lambda: page.near(of_key("ply.1.angle")), "the angle can be typed").click()
    marked = page.js("""
      document.activeElement.select();
      plyform_setup.form.show(plyform_setup.chosen);  // as when another program has changed the file
      const { dataset, value, selectionStart, selectionEnd } = document.activeElement;
      return [dataset.key, value, selectionStart, selectionEnd];""")
    assert marked == ["ply.1.angle", "30", 0, 2], marked
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
    page.until(lambda: list(page.tree()["blanks"]) == ["sheet"] and
               all(ply["blank"] == "sheet" for ply in page.tree()["ply"]), "the blank is named so, in plies too")


def fabrics(page: Page) -> None:
    """Added by a dialogue; its own file is edited in its form."""
    page.press('[data-add="fabrics"]')
    page.pick("#add-fabric-path", "../fabrics/ncf_biaxial_pillar.toml")
    page.type("#add-fabric-name", "ncf")
    page.press("#add-fabric-go")
    page.until(lambda: page.tree()["fabrics"].get("ncf") == "../fabrics/ncf_biaxial_pillar.toml")
    page.until(lambda: page.seen('[data-key="fabrics.ncf.thickness"]'))
    file = page.server.folder / "fabrics" / "ncf_biaxial_pillar.toml"
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


def rows_of_fabrics(page: Page) -> None:
    """Families, stitches, crossings: copied, moved, removed; a table taken away and given again."""
    file = page.server.folder / "fabrics" / "ncf_biaxial_pillar.toml"

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
    text = (page.server.folder / "mine" / page.tree()["fabrics"][plain]).read_text()
    page.press(f'[aria-label="Remove fabrics.{plain}.shear"]')
    file = page.server.folder / "mine" / page.tree()["fabrics"][plain]
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
    for group in ("boundary", "load", "friction"):
        page.press(f'[data-add="{group}"]')
        page.until(lambda g=group: len(page.tree()[g]) == 1, group)
    while page.tree() != before:
        now = page.written()
        page.press("#undo")
        page.until(lambda n=now: page.written() != n, "taken back")


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
    page.until(lambda: page.seen(f'.fault[data-line="{line}"]'), "the line is marked")
    page.press("#toml-revert")
    page.until(lambda: page.js("return plyform_setup.editor.mirror.getValue()") == saved)
    page.press("#show-toml")
    page.until(lambda: not page.find("#toml").is_displayed(), "the text is put away")
    page.press("#show-toml")
    page.until(lambda: page.find("#toml").is_displayed(), "it is back")


def mistakes(page: Page) -> None:
    """At the key, in the outline, in the scene, in the text, in the list, which leads there."""
    page.until(lambda: "wrong" not in page.find("#check-state").get_attribute("class"), seconds=120)
    page.until(lambda: page.js("return Boolean(plyform_setup.scene)"), "there is a scene")
    page.item("ply.1")
    first, second = (ply["name"] for ply in page.tree()["ply"])
    page.key("ply.1.name", first)
    page.until(lambda: "is taken" in page.text("#trouble"), "a name of another ply is refused")
    page.write_text(page.written().replace(f'name = "{second}"', f'name = "{first}"'))
    page.until(lambda: page.seen(".fault-words:not(.warning)"), seconds=120)
    page.until(lambda: page.seen('[data-item="ply.1"] b.wrong'), "it is marked in the outline")
    page.until(lambda: page.seen(".fault-line"), "and in the text")
    page.until(lambda: page.seen(".callout.wrong"), seconds=30)
    page.item("case")
    page.press(".fault-words:not(.warning)")
    page.until(lambda: page.js("return plyform_setup.chosen") == "ply.1")
    page.until(lambda: page.seen('[data-at="ply.1.name"] .words'), "it stands at its key")
    page.press("#undo")
    page.until(lambda: not page.seen(".fault-words:not(.warning)"), seconds=120)


go_through([outline_and_forms, either_or, items, fabrics, rows_of_fabrics, lists, text_beside, mistakes])
