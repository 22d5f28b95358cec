# SPDX-License-Identifier: GPL-3.0-or-later
"""Two pages of the set-up in Chromium and an editor that change one case: what both have changed is asked about,
all else stays.

    studio_setup_together_test.py TOOLS PROGRAM CASES
"""

import random
import re
import sys
import tempfile
import time
import tomllib
from pathlib import Path

from studio_page import SetupPage as Page, of_key
from studio_server import Server
from studio_setup import CASE, PROGRAM, TOOLS, folder_with_case

SEEDS, OPS = 4, 5


def texts_of(page, words):
    """The page has heard of it."""
    page.until(lambda: words in page.js("return plyform_setup.main.text"), f"{words} is known")


def by_editor(page, before, after):
    text = page.written()
    assert text.count(before) == 1, (before, text)
    page.file.write_text(text.replace(before, after), encoding="utf-8")


def typed(page, before, after):
    """Put in the place of other words in the text, as by typing."""
    page.js("""
      const m = plyform_setup.editor.mirror, at = m.indexFromPos({line: 0, ch: 0}) + m.getValue().indexOf(arguments[0]);
      if (m.getValue().indexOf(arguments[0]) < 0) throw new Error(`no ${arguments[0]}`);
      m.replaceRange(arguments[1], m.posFromIndex(at), m.posFromIndex(at + arguments[0].length), "+input");""", before, after)


def half_typed(one: Page, other: Page) -> None:
    """A text that is no TOML yet is put together with what another page and an editor write meanwhile."""
    one.item("case")
    typed(one, "[contact]", "[contact")
    one.until(lambda: "not saved" in one.text("#toml-note"))
    other.item("ply.1")
    other.key("ply.1.angle", "33")
    other.until(lambda: other.tree()["ply"][1]["angle"] == 33)
    by_editor(one, "[solver]", "# by an editor\n[solver]")
    texts_of(one, "# by an editor")
    typed(one, "[contact", "[contact] # typed\nskin = 2.5\n#")
    one.until(lambda: one.tree()["contact"].get("skin") == 2.5, "what was typed is saved")
    assert one.tree()["ply"][1]["angle"] == 33 and "# by an editor" in one.written()
    one.until(lambda: one.text("#toml-note") == "saved" and "# by an editor" in
              one.js("return plyform_setup.editor.mirror.getValue()"))
    one.press("#undo")  # what was typed, and not what others have done
    one.until(lambda: "skin" not in one.tree()["contact"])
    assert one.tree()["ply"][1]["angle"] == 33 and "# by an editor" in one.written()


def same_lines(one: Page, other: Page) -> None:
    """Of the same lines the page has its text until one is chosen."""
    for button, kept in (("#toml-revert", 41), ("#toml-keep", 52)):
        before = one.tree()["ply"][1]["angle"]
        line = re.search(r"angle = .*", one.written().split("[[ply]]")[2])[0]
        typed(one, line, "angle = ")
        one.until(lambda: "not saved" in one.text("#toml-note"))
        other.key("ply.1.angle", "41")
        other.until(lambda: other.tree()["ply"][1]["angle"] == 41 != before)
        texts_of(one, line.replace(f"{before:.1f}", "41.0") if f"{before:.1f}" in line else "41")
        typed(one, "angle = \n", "angle = 52.0\n")
        one.until(lambda: "same lines" in one.text("#toml-note"), "that is said")
        assert one.tree()["ply"][1]["angle"] == 41
        one.press(button)
        one.until(lambda kept=kept: one.tree()["ply"][1]["angle"] == kept and one.text("#toml-note") == "saved")
        other.until(lambda: other.value("ply.1.angle") in ("41", "52"))
        other.key("ply.1.angle", "7")
        other.until(lambda: other.tree()["ply"][1]["angle"] == 7)
        texts_of(one, "angle = 7.0")


def same_key(one: Page, other: Page) -> None:
    """A number that is being typed while another page changes it is a question."""
    for page in (one, other):
        page.item("tool.0")
    for answer, value in (("#clash-cancel", 21), ("#clash-go", 23)):
        box = one.until(lambda: one.near(of_key("tool.0.stroke")), "the stroke can be typed")
        box.click()
        one.driver.switch_to.active_element.send_keys("\ue009a\ue00022")
        other.key("tool.0.stroke", "21")
        other.until(lambda: other.tree()["tool"][0]["stroke"] == 21)
        one.until(lambda: one.js("return plyform_setup.main.tree.tool[0].stroke") == 21)
        assert one.value("tool.0.stroke") == "22"  # what is typed stays
        one.driver.switch_to.active_element.send_keys("\ue003\ue003" + str(value) if value == 23 else "")
        one.js("document.activeElement.blur()")
        one.until(lambda: "there 21" in " ".join(one.texts("dialog .note")), "it is asked")
        one.press(answer)
        one.until(lambda value=value: one.tree()["tool"][0]["stroke"] == value and not one.seen("dialog"))
        one.until(lambda value=value: one.value("tool.0.stroke") == str(value))
        other.until(lambda value=value: other.value("tool.0.stroke") == str(value))
        other.key("tool.0.stroke", "30")
        one.until(lambda: one.value("tool.0.stroke") == "30")


def taken_back(one: Page, other: Page) -> None:
    """Undo is of this page; the change of another is asked about."""
    one.key("tool.0.stroke", "31")
    one.until(lambda: one.tree()["tool"][0]["stroke"] == 31)
    other.until(lambda: other.value("tool.0.stroke") == "31")
    other.item("ply.0")
    other.key("ply.0.angle", "5")
    other.until(lambda: other.tree()["ply"][0]["angle"] == 5)
    one.until(lambda: one.js("return plyform_setup.main.tree.ply[0].angle") == 5)
    one.press("#undo")
    one.until(lambda: one.tree()["tool"][0]["stroke"] == 30)
    assert one.tree()["ply"][0]["angle"] == 5
    one.press("#redo")
    one.until(lambda: one.tree()["tool"][0]["stroke"] == 31)
    by_editor(one, "angle = 5.0", "angle = 6.0")
    for page in (one, other):
        page.until(lambda page=page: page.js("return plyform_setup.main.tree.ply[0].angle") == 6)
    one.js("plyform_setup.done = []")  # as after a start
    for answer, value in (("#step-cancel", 6), ("#step-go", 5)):
        one.press("#undo")
        one.press(answer)
        one.until(lambda value=value: not one.seen("dialog") and one.tree()["ply"][0]["angle"] == value)


def kept_while_away(one: Page, _: Page) -> None:
    """A text that is no TOML is there again when another file has been looked at."""
    one.item("case")
    typed(one, "[contact]", "[contact")
    one.item("fabrics.glass")
    one.until(lambda: "glass" in one.text("#toml-file"))
    one.item("case")
    one.until(lambda: "[contact\n" in one.js("return plyform_setup.editor.mirror.getValue()"), "it is there")
    one.until(lambda: "not saved" in one.text("#toml-note"))
    typed(one, "[contact\n", "[contact]\n")
    one.until(lambda: one.text("#toml-note") == "saved")


def gone_and_back(one: Page, _: Page) -> None:
    """What was said of a file that was away is not said when it is back."""
    text = one.written()
    one.file.unlink()
    one.until(lambda: "missing" in one.text("#trouble"))
    one.file.write_text(text, encoding="utf-8")
    one.until(lambda: not one.text("#trouble"), "nothing is missing")
    # the picture's answer alone says so, as of a file that is away for a moment
    one.js("plyform_setup.main.heard = () => Promise.resolve()")
    one.file.unlink()
    one.js("plyform_setup.drawn.ask()")
    one.until(lambda: "missing" in one.text("#trouble"))
    one.js("delete plyform_setup.main.heard")
    one.file.write_text(text, encoding="utf-8")
    one.until(lambda: not one.text("#trouble"), "nothing is missing")


def known(pages, comments):
    for page in pages:
        page.until(lambda page=page: all(words in page.js("return plyform_setup.main.text") for words in comments),
                   f"{comments} are known")


def interleavings(one: Page, other: Page) -> None:
    """Numbers in forms, comments in texts and by an editor, at random: each is there at the end. Where two
    would write the same lines, the second one knows of the first: else it would be asked."""
    numbers = ["ply.0.angle", "ply.1.angle"]
    for seed in range(SEEDS):
        draw, wanted, comments, taken = random.Random(seed), {}, [], set()
        for k in range(OPS):
            act, page = draw.choice(("form", "text", "editor")), draw.choice((one, other))
            if act == "form":
                key, value = draw.choice(numbers), draw.randrange(-89, 89)
                page.item(key.rpartition(".")[0])
                page.key(key, str(value))
                wanted[key] = value
                page.until(lambda key=key, value=value: page.tree()["ply"][int(key[4])]["angle"] == value)
            else:
                place = draw.choice(("[contact]", "[solver]", "[blanks", "[fabrics]"))
                if place in taken:
                    known((one, other), comments)
                taken.add(place)
                comments.append(f"# {act} {seed} {k}")
                if act == "text":
                    page.item("case")
                    typed(page, place, f"{comments[-1]}\n{place}")
                else:
                    by_editor(page, place, f"{comments[-1]}\n{place}")
                if draw.random() < 0.5:  # else the next one comes before it is saved, and known
                    page.until(lambda: comments[-1] in page.written())
        known((one, other), comments)
        tree = one.tree()
        assert {key: tree["ply"][int(key[4])]["angle"] for key in wanted} == wanted, (seed, wanted, tree["ply"])
        assert all(words in one.written() for words in comments), (seed, comments, one.written())
        for words in comments:
            by_editor(one, f"{words}\n", "")
        for page in (one, other):
            page.until(lambda page=page: page.js("return plyform_setup.main.text") == one.written() and
                       page.text("#toml-note") == "saved")


def main():
    assert tomllib and sys.argv
    with tempfile.TemporaryDirectory() as scratch:
        folder = folder_with_case(Path(scratch) / "folder")
        with Server(TOOLS, PROGRAM, folder) as server, Page(server, folder / CASE, 1280, 800) as one, \
                Page(server, folder / CASE, 1280, 800) as other:
            for page in (one, other):
                page.open(f"#setup/{CASE}")
            for part in (kept_while_away, gone_and_back, interleavings, half_typed, same_lines, same_key, taken_back):
                begin = time.monotonic()
                part(one, other)
                print(f"{part.__name__}: {time.monotonic() - begin:.1f} s", flush=True)
            for page in (one, other):
                wrong = [line for line in page.errors() if not re.search("404|409|422", line)]
                assert not wrong, wrong


if __name__ == "__main__":
    main()
