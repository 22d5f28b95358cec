# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies in the workbench, by clicks: set up, checked, started, its table filling, one begun by the
command line, one that is stopped and goes on.

    studio_studies_test.py TOOLS_FOLDER PLYFORM CASES_FOLDER [PICTURE.png]
"""

import shutil
import subprocess
import sys
import time
import tomllib
from pathlib import Path

from studio_page import Page
from studio_server import Server

if shutil.which("snakemake") is None:
    print("SKIPPED: no snakemake")
    sys.exit(77)
TOOLS, PROGRAM, CASES = (Path(word).resolve() for word in sys.argv[1:4])
CASE = """# a cap that takes a tenth of a second
title = "A small cap"
[fabrics]
glass = "glass.toml"
[blanks.square]
size = [60.0, 60.0]
mesh = "alternating"
element_size = 6.0
[[ply]]
name = "sheet"
fabric = "glass"
blank = "square"
angle = 0.0
[[tool]]
name = "punch"
shape = "sphere"
radius = 25.0
position = [0.0, 0.0, 25.6]
motion = "driven"
direction = [0.0, 0.0, -1.0]
stroke = 8.0
[[tool]]
name = "die"
shape = "annulus"
inner_radius = 26.0
outer_radius = 60.0
thickness = 10.0
edge_radius = 4.0
position = [0.0, 0.0, -10.0]
[solver]
duration = 0.01
fibre_softening = 100.0
outputs = 2
"""
FILE = "studies/strokes.toml"
EDITED = """title = "Two keys"
case = "../cap/case.toml"
method = "grid"
[[vary]]
name = "stroke"
key = "tool.punch.stroke"
values = [2, 4]
[[vary]]
name = "friction"
key = "contact.friction"
values = [0.1, 0.2]
"""


def study_text(server):
    return (server.folder / FILE).read_text(encoding="utf-8")


def opened(page):
    """What is run, which is put away once there are results."""
    page.when("return document.getElementById('study-setup').open === false")
    page.press("#study-setup > summary")


def set_up(page, server):
    """A study from nothing: its case, a key by click, values, figures, a limit."""
    page.go(server, "studies")
    page.type("#new-study-name", "strokes")
    page.until(lambda: page.find("#new-study-case").get_attribute("value") == "cap/case.toml", "the only one is chosen")
    for case in ("", "cap/case.toml"):
        page.pick("#new-study-case", case)
    page.press("#new-study")
    page.until(lambda: "nothing is varied" in page.text("#study-mistakes"), "it is told that nothing varies")
    page.until(lambda: not page.find("#study-go").is_enabled(), "it cannot start")
    page.when("return document.getElementById('key-chooser').open")  # nothing varies yet
    page.type("#key-search", "punch.stroke")
    page.until(lambda: page.texts("#key-chooser li code") == ["tool.punch.stroke"], "the key is found")
    assert "8 mm" in page.text("#key-chooser li") and "stroke along the direction" in page.text("#key-chooser li")
    page.press("[data-key='tool.punch.stroke'].key")
    page.until(lambda: page.find("#vary-0-values").get_attribute("value") == "6.4, 8, 9.6", "values are proposed")
    page.type("#vary-0-values", "2, four")
    page.until(lambda: "must be a number" in page.text("#study-mistakes"), "a value that is none is told")
    page.type("#vary-0-values", "2, 4, 6")
    page.press("#figure-punch_N")
    page.until(lambda: "punch_N" in study_text(server), "the figure is in the file")
    page.press("#figure-wrinkle_mm")
    page.until(lambda: "wrinkle_mm" in study_text(server), "the figure is in the file")
    page.type("#limit-punch_N-at_most", "0.5")
    page.until(lambda: "at_most" in study_text(server), "the limit is in the file")
    page.press("#picture-add-window")
    page.until(lambda: "two keys" in page.text("#trouble"), "a window of one key is refused")
    page.press("#picture-add-scatter")
    page.until(lambda: page.text("#study-told").startswith("3 runs; "), "runs are counted")
    tables = tomllib.loads(study_text(server))
    assert tables["vary"] == [{"name": "punch stroke, mm", "key": "tool.punch.stroke", "values": [2, 4, 6]}], tables
    assert tables["limits"] == {"punch_N": {"at_most": 0.5}} and tables["case"] == "../cap/case.toml", tables
    assert "# seen from this file" in study_text(server) and "# every combination" in study_text(server)


def run_it(page, server):
    """Its table, chart and picture; a row leads to its run."""
    page.press("#study-go")
    page.until(lambda: len(page.texts("#study-table tbody tr")) == 3, "the table is there")
    page.until(lambda: server.get("api/study/table", folder="results/strokes")["state"] == "ended", "it ends")
    page.until(lambda: "3 doubtful of 3 runs" in page.text("#study-progress"), "the counts are told")
    page.until(lambda: len(page.texts("#study-chart circle.point")) == 3, "the chart has three points")
    page.until(lambda: page.texts("#study-ranking li"), "the ranking is shown")
    page.until(lambda: page.js("return [...document.querySelectorAll('img.drawn')].some((i) => i.naturalWidth > 100)"),
               "the scatter plot is shown")
    page.until(lambda: "yarns are pressed" in page.text("#study-table tbody"), "the reason of a doubt is told")
    rows = server.get("api/study/table", folder="results/strokes")["rows"]
    assert [row["punch stroke, mm"] for row in rows] == [2, 4, 6] and all(row["punch_N"] for row in rows), rows
    page.pick("#chart-y", "wrinkle_mm")
    page.until(lambda: "wrinkle_mm" in page.text("#study-chart svg"), "the figure is drawn")
    page.until(lambda: "What moves wrinkle_mm most" in page.text("#study-ranking"), "the ranking is of it")
    page.pick("#chart-x", "punch_N")
    page.pick("#chart-by", "punch stroke, mm")
    page.until(lambda: page.texts("#study-chart .legend-of-lines li") == [f" punch stroke, mm: {k}" for k in (2, 4, 6)],
               "a line for each stroke")
    page.until(lambda: "punch_N" in page.text("#study-chart svg") and
               len(page.texts("#study-chart circle.point")) == 3, "three points over the force")
    for place, row in (("#study-chart circle.point", rows[0]), ("#study-table tbody tr:nth-child(2) a", rows[1])):
        page.go(server, f"studies/{FILE}")
        page.press(place)
        page.until(lambda: page.js("return decodeURIComponent(location.hash)") ==
                   f"#results/report/results/strokes/{row['folder']}", "it leads to the report of its run")
    page.until(lambda: page.js("return document.documentElement.dataset.results") == "report 1", "its report is shown")


def one_more(page, server):
    """A value more costs a run more."""
    page.go(server, f"studies/{FILE}")
    opened(page)
    page.type("#vary-0-values", "2, 4, 6, 7")
    page.until(lambda: page.text("#study-told").startswith("4 runs, 3 of them have ended; "), "one is missing")
    page.until(lambda: page.text("#study-go") == "Go on", "it can go on")
    page.type("#study-jobs", "2")
    page.type("#study-threads", "3")
    page.press("#study-again")
    page.press("#study-go")
    page.until(lambda: "4 doubtful of 4 runs" in page.text("#study-progress"), "the fourth has ended")
    record = server.get("api/processes", kind="study")[-1]
    page.until(lambda: server.get(f"api/processes/{record['id']}")["state"] == "done", "the command has ended")
    assert "4/4 runs" in server.get(f"api/processes/{record['id']}")["log"]
    command = " ".join(map(str, record["command"]))
    assert "--threads 3 --jobs 2 --again" in command, command
    page.press("#study-again")


def stopped(page, server):
    """Stopped on its way; the same button goes on."""
    opened(page)
    page.type("#vary-0-values", ", ".join(str(0.1 * k) for k in range(1, 31)))
    page.until(lambda: page.text("#study-told").startswith("30 runs"), "30 are counted")
    page.press("#study-go")
    page.until(lambda: page.find("#study-stop").is_displayed() and "missing" in page.text("#study-progress"),
               "it goes on")
    page.press("#study-stop")
    page.until(lambda: server.get("api/processes", kind="study")[-1]["state"] == "stopped", "it has stopped")
    page.until(lambda: server.get("api/study/table", folder="results/strokes")["state"] == "has missing runs",
               "runs are missing")
    page.until(lambda: page.find("#study-go").is_displayed(), "it can go on")
    drawn = server.folder / "results/strokes/scatter.png"
    before = drawn.stat().st_mtime_ns
    page.press("#study-draw")
    page.until(lambda: drawn.stat().st_mtime_ns > before, "the picture is drawn of what has ended")


def window(page, server):
    """Two keys in a grid with a limit: its process window, and how far each key goes."""
    page.go(server, "studies")
    page.type("#new-study-name", "window")
    page.pick("#new-study-case", "cap/case.toml")
    page.press("#new-study")
    for i, (key, values) in enumerate((("tool.punch.stroke", "4, 8"), ("contact.friction", "0.1, 0.2"))):
        page.until(lambda: page.find("#study-heading").text == "window", "the new study is shown")
        page.when("return document.getElementById('key-chooser').open")
        page.press(f"[data-key='{key}'].key")
        page.type(f"#vary-{i}-values", values)
        page.until(lambda: values.replace(" ", "") in (server.folder / "studies/window.toml").read_text(
            encoding="utf-8").replace(" ", ""), "the values are in the file")
    page.press("#figure-max_shear_deg")
    page.until(lambda: page.find("#figure-max_shear_deg").is_selected(), "the figure is chosen")
    page.type("#limit-max_shear_deg-at_most", "8")
    page.until(lambda: "at_most" in (server.folder / "studies/window.toml").read_text(encoding="utf-8"), "the limit")
    page.press("#picture-add-window")
    page.until(lambda: page.text("#study-told").startswith("4 runs; "), "runs are counted")
    page.press("#study-go")
    page.until(lambda: "4 doubtful of 4 runs" in page.text("#study-progress"), "all have ended")
    page.until(lambda: page.js("return [...document.querySelectorAll('img.drawn')].some((i) => "
                               "i.alt.startsWith('window.png') && i.naturalWidth > 100)"), "the window is shown")
    page.until(lambda: "How far each key goes" in page.text("#study-ranking"), "how far the keys go")
    page.until(lambda: len(page.texts("#study-chart .legend-of-lines li")) == 2,
               "a line for each value of the second key")
    page.until(lambda: "Hollow" in page.text("#study-chart"), "what is hollow is told")


def edited(page, server):
    """Each control of the form changes what it names in the file."""
    file = server.folder / "studies/edited.toml"
    file.write_text(EDITED, encoding="utf-8")
    page.go(server, "studies")
    page.press("#study-list [data-study='studies/edited.toml']")
    page.until(lambda: page.find("#study-title").get_attribute("value") == "Two keys", "the study is shown")

    def tree():
        return tomllib.loads(file.read_text(encoding="utf-8"))

    def changes(act, place, *value, holds):
        page.js("document.querySelector('#study-form').firstChild.mark = 1")
        act(place, *value)
        page.until(lambda: holds(tree()), f"{place} {value} is in the file")
        page.until(lambda: page.js("return !document.querySelector('#study-form').firstChild.mark"), "it is redrawn")

    def varies(act, place, *value, **wanted):
        changes(act, f"#vary-0-{place}", *value, holds=lambda now: now["vary"][0] == {
            "key": "tool.punch.stroke", **wanted})

    changes(page.type, "#study-title", "Edited", holds=lambda now: now["title"] == "Edited")
    page.until(lambda: page.text("#study-heading") == "Edited", "the heading is its title")
    varies(page.type, "name", "path", name="path", values=[2, 4])
    varies(page.pick, "kind", "factors", name="path", factors=[0.5, 1, 2])
    varies(page.type, "values", "0.5, 1", name="path", factors=[0.5, 1])
    varies(page.pick, "kind", "range", name="path", range=[4, 12], count=3)
    varies(page.type, "from", "3", name="path", range=[3, 12], count=3)
    varies(page.type, "to", "9", name="path", range=[3, 9], count=3)
    varies(page.type, "count", "2", name="path", range=[3, 9], count=2)
    varies(page.pick, "scale", "log", name="path", range=[3, 9], count=2, scale="log")
    changes(page.pick, "#study-method", "sobol", holds=lambda now: now["method"] == "sobol" and now["runs"] == 20 and
            now["vary"][1]["range"] == [0.1, 0.2] and "count" not in now["vary"][0])
    changes(page.type, "#study-runs", "8", holds=lambda now: now["runs"] == 8)
    changes(page.type, "#study-seed", "5", holds=lambda now: now["seed"] == 5)
    page.until(lambda: page.text("#study-told").startswith("8 runs; "), "as many runs as are drawn")
    changes(page.pick, "#study-method", "grid", holds=lambda now: now["method"] == "grid" and "runs" not in now and
            "seed" not in now and now["vary"][1]["count"] == 3)
    changes(page.pick, "#study-accuracy", "draft", holds=lambda now: now["accuracy"] == "draft")
    page.type("#figure-name", "of_all")
    page.type("#figure-path", "max plies.*.max_shear_deg")
    changes(page.press, "#figure-add", holds=lambda now: now["figures"] == {"of_all": "max plies.*.max_shear_deg"})
    for name in ("of_all", "largest_shear_deg"):
        for end in ("at_least", "at_most"):
            changes(page.type, f"#limit-{name}-{end}", "7", holds=lambda now: now["limits"][name][end] == 7)
    changes(page.type, "#limit-largest_shear_deg-at_most", "",
            holds=lambda now: now["limits"]["largest_shear_deg"] == {"at_least": 7})
    changes(page.press, "#picture-add-map", holds=lambda now: now["picture"] == [
        {"kind": "map", "x": "path", "y": "friction", "figure": "of_all"}])
    changes(page.press, "#picture-0-remove", holds=lambda now: not now.get("picture"))
    changes(page.press, "#figure-of_all", holds=lambda now: not now.get("figures") and "of_all" not in now["limits"])
    changes(page.press, "#vary-1-remove", holds=lambda now: [one["name"] for one in now["vary"]] == ["path"])
    page.js("""for (const [id, value] of [["study-title", "At once"], ["study-accuracy", "standard"], ["vary-0-name", "p"]]) {
        const box = document.getElementById(id); box.value = value; box.dispatchEvent(new Event("change")); }""")
    page.until(lambda: [tree()["title"], tree()["accuracy"], tree()["vary"][0]["name"]] == ["At once", "standard", "p"],
               "three changes at once")
    changes(page.type, "#study-title", "Edited", holds=lambda now: now["title"] == "Edited")
    page.press("#key-chooser > summary")
    page.until(lambda: page.find("#key-search").is_displayed(), "keys are offered")
    page.press("details:has(> #study-text) > summary")
    text = file.read_text(encoding="utf-8")
    page.type("#study-text", "a = [")
    page.press("#study-text-save")
    page.until(lambda: "no TOML" in page.text("#trouble"), "a text that is no TOML is refused")
    assert file.read_text(encoding="utf-8") == text
    page.type("#study-text", text.replace('"Edited"', '"By hand"'))
    page.press("#study-text-save")
    page.until(lambda: page.text("#study-heading") == "By hand" and tree()["title"] == "By hand", "the text is saved")


def of_the_command_line(page, server):
    """Found with its table, without the workbench."""
    text = study_text(server).replace("[0.1", "[0.5, 0.7] # [0.1")
    (server.folder / "by_hand.toml").write_text(text.replace("../cap", "cap"), encoding="utf-8")
    subprocess.run([TOOLS / "study", "by_hand.toml", "--program", PROGRAM], cwd=server.folder, check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    page.go(server, "studies/by_hand.toml")
    page.until(lambda: "of 2 runs" in page.text("#study-progress"), "its runs are shown")
    page.until(lambda: any("of 2 runs" in text for text in page.texts("#study-list li")), "it is in the list")


def refused(server):
    """What leads out of the folder, or is changed by somebody else meanwhile."""
    def answer(method, address, body=None, query=None):
        status, content = server.call(method, address, body, query=query)
        return status, str(content)

    outside = server.folder.parent / "outside.toml"
    outside.write_text(CASE, encoding="utf-8")
    (server.folder / "bad.toml").write_text('case = "../outside.toml"\n[[vary]]\nkey = "tool.0.stroke"\nvalues = [1]\n')
    for method, path, body, query in (
            ("GET", "api/study/check", None, {"path": "bad.toml"}),
            ("POST", "api/study/start", {"path": "bad.toml"}, {}),
            ("GET", "api/study", None, {"path": "../outside.toml"}),
            ("GET", "api/study/keys", None, {"case": "../outside.toml"}),
            ("POST", "api/studies", {"name": "../x", "case": "cap/case.toml"}, {}),
            ("GET", "api/study/picture", None, {"folder": "results/strokes", "name": "../../cap/case.toml"}),
            ("GET", "api/study/table", None, {"folder": "../"})):
        status, words = answer(method, path, body, query)
        assert status in (403, 404, 422), (path, status, words)
    status, words = answer("PUT", "api/study", {"path": FILE, "version": "old", "plan": {"title": "x"}})
    assert status == 409 and "changed meanwhile" in words, (status, words)
    status, words = answer("PUT", "api/study/text", {"path": FILE, "version": "old", "text": "a = ["})
    assert status == 422 and "no TOML" in words, (status, words)


def main():
    picture = sys.argv[4] if len(sys.argv) > 4 else ""
    with Server(TOOLS, PROGRAM) as server, Page(1280, 1000) as page:
        (server.folder / "cap").mkdir()
        (server.folder / "cap/case.toml").write_text(CASE, encoding="utf-8")
        shutil.copy(CASES / "fabrics/glass_plain_weave.toml", server.folder / "cap/glass.toml")
        for part in (set_up, run_it, one_more, stopped, window, edited, of_the_command_line):
            begin = time.monotonic()
            part(page, server)
            print(f"{part.__name__}: {time.monotonic() - begin:.1f} s", flush=True)
            if picture and part in (run_it, window):
                page.screenshot(picture if part is run_it else picture.replace(".png", "_window.png"), whole=False)
        refused(server)
        assert not [one for one in page.errors() if "status of 4" not in one], page.errors()


if __name__ == "__main__":
    main()
