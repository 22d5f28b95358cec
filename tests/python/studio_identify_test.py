# SPDX-License-Identifier: GPL-3.0-or-later
"""Identification in the workbench, by clicks: a picture frame that was measured, the fit over it and
the limits of each number; each option; a refusal with its remedy; hostile orders.

    studio_identify_test.py TOOLS_FOLDER PLYFORM CASES_FOLDER [PICTURE.png]
"""

import json
import math
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

from studio_page import Page
from studio_server import Server

TOOLS, PROGRAM, CASES = (Path(word).resolve() for word in sys.argv[1:4])
CURVE = "measured/picture_frame_plain.csv"
BIAS = "measured/bias_plain_115x230.csv"


def frame(page, server):
    """UML's column of the benchmark's frames, in N/mm over the angle."""
    page.go(server, "identify")
    page.pick("#identify-test", "frame")
    page.pick("#curve-file", CURVE)
    page.press("#curve-add")
    page.until(lambda: page.js("return document.querySelectorAll('#curve-chart polyline').length") >= 7,
               "every column is drawn")
    page.until(lambda: "12 rows" in page.text("#curve-rows"), "its rows are counted")
    page.pick("#curve-0-column", "UML")
    page.until(lambda: page.js("return document.querySelectorAll('#curve-chart polyline').length") == 1,
               "the column chosen is drawn")
    page.press("#identify-more summary")
    page.type("#option-y-unit", "N/mm")
    page.pick("#identify-fabric", "cloth/base.toml")
    page.type("#identify-output", "found")
    page.press("#identify-go")
    page.until(lambda: page.text("#identify-state").startswith("shear law"), "it is found")


def shown(page, server):
    """What stands on the page is what the program has written, and what it finds by itself."""
    order = ["identify", "frame", f"{CURVE}:UML", "--y-unit=N/mm", "--fabric", "cloth/base.toml", "-o", "again.toml"]
    done = subprocess.run([PROGRAM, *order], cwd=server.folder, capture_output=True, text=True, check=True)
    law = tomllib.loads((server.folder / "cloth/found.toml").read_text(encoding="utf-8"))["shear"]
    assert law == tomllib.loads((server.folder / "again.toml").read_text(encoding="utf-8"))["shear"], law
    reports = (server.folder / ".plyform/identified").iterdir()
    report = json.loads(max(reports, key=lambda file: file.stat().st_mtime).read_text(encoding="utf-8"))
    assert not list((server.folder / "cloth").glob("*.json"))
    assert report["law"] in done.stdout and all(text in done.stdout for text in report["figures"]), report
    names = page.texts("#identify-numbers tbody th")
    assert names == [one["name"] for one in report["numbers"]] and names[0] == "k1", names
    assert re.search(r"± [\d.]+ %", page.text("#identify-numbers tbody tr")), page.text("#identify-numbers")
    printed = dict(re.findall(r"(k\d) \+- ([\d.e-]+)", done.stdout))
    for one in report["numbers"]:
        if one["name"] in printed:
            assert abs(float(printed[one["name"]]) / one["limits"] - 1) < 0.06, (one, printed)
    rows = (server.folder / "cloth/found_fit.csv").read_text(encoding="utf-8").splitlines()
    assert page.js("return document.querySelectorAll('#identify-chart circle.point').length") == len(rows) - 1, rows
    assert page.js("return document.querySelectorAll('#identify-chart polyline').length") == 1
    assert "shear angle, °" in page.text("#identify-chart") and "load, N" in page.text("#identify-chart")
    assert "fitted / measured − 1, %" in page.text("#identify-residuals")
    assert "identify frame ./measured/picture_frame_plain.csv:UML" in page.text("#identify-command")
    page.when("return document.getElementById('identify-open').href.endsWith('#setup/cloth/found.toml')")
    page.press("#identify-told summary")
    page.until(lambda: page.find("#identify-told details li").is_displayed(), "there is more of it")
    assert page.texts("#identify-told details li") == report["notes"], report["notes"]
    page.press("#identify-log")
    page.until(lambda: "0.05" in page.text("#identify-chart") or "0.1" in page.text("#identify-chart"),
               "the axis is logarithmic")
    page.pick("#identify-x", "displacement_mm")
    for place in ("#identify-chart", "#identify-residuals"):
        page.until(lambda p=place: "displacement, mm" in page.text(p), "it is drawn over the displacement")


def refused_curve(page, server):
    """A torque that falls: the reason, the remedy, nothing written; then --to 50, which does."""
    page.go(server, f"identify/curve/{BIAS}")
    page.pick("#identify-test", "bias")
    page.type("#option-length", "230")
    page.type("#option-width", "115")
    page.pick("#identify-fabric", "cloth/base.toml")
    page.type("#identify-output", "bias.toml")
    page.press("#identify-go")
    page.until(lambda: page.text("#identify-state").startswith("Refused"), "it is refused")
    told = page.text("#identify-told")
    assert "Remedy: " in told and "--to" in told, told
    assert not list((server.folder / "cloth").glob("bias*"))  # no report beside the refusal either
    page.press("#identify-more summary")
    page.type("#option-to", "50")
    page.press("#identify-replace")
    page.press("#identify-go")
    page.until(lambda: page.text("#identify-state").startswith("shear law"), "with --to 50 it is found")
    assert (server.folder / "cloth/bias.toml").exists()
    page.when("return document.getElementById('option-length').value === '230'")  # the form is as it was


def again(page, form, begin):
    """Identifies with other options, from what the form has; what is found or refused begins so."""
    if not page.js("return document.getElementById('identify-more').open"):
        page.press("#identify-more summary")
    for name, value in form.items():
        if value is True:
            page.press(f"#option-{name}")
        elif page.js("return document.getElementById(arguments[0]).tagName", f"option-{name}") == "SELECT":
            page.pick(f"#option-{name}", value)
        else:
            page.type(f"#option-{name}", value)
    before = len(page.server.get("api/processes", kind="identify"))
    page.press("#identify-go")
    page.until(lambda: len(page.server.get("api/processes", kind="identify")) > before, "it is begun")
    command = page.server.get("api/processes", kind="identify")[-1]["command"]
    page.until(lambda: page.text("#identify-command").split() == command and
               page.text("#identify-state").startswith(begin), begin)  # not that of the try before


def every_option(page, server):
    """An extension in cm and a load in kN, without units in the header: what each option does."""
    rows = []
    for angle in range(0, 51, 2):
        g = math.radians(angle)
        along = 2 * math.cos(math.pi / 4 - g / 2)
        rows.append(f"{20 * (along - math.sqrt(2)):.6f},{along * (0.004 * g + 0.02 * g**3):.8f},{angle}")
    (server.folder / "frame.csv").write_text("\n".join(["u,F,phi", *rows]) + "\n", encoding="utf-8")
    page.go(server, "identify/curve/frame.csv")
    page.pick("#curve-0-column", "F")
    page.pick("#identify-fabric", "cloth/base.toml")
    page.type("#identify-output", "options")
    page.press("#identify-replace")
    values = {"side": "200", "law": "polynomial", "coefficients": "2", "from": "10", "to": "40",
              "compliance": "0.001", "zero": "0.1", "toe": "0.02", "slip": "fit", "angle-column": "none",
              "x-column": "u", "x-unit": "cm", "y-unit": "kN"}
    again(page, {**values, "yes-doubtful": True}, "shear law")
    subprocess.run([PROGRAM, "identify", "frame", "frame.csv:F", "--fabric", "cloth/base.toml", "-o", "own.toml",
                    "--yes-doubtful", *(f"--{name}={value}" for name, value in values.items())],
                   cwd=server.folder, capture_output=True, check=True)
    found, own = (tomllib.loads((server.folder / name).read_text(encoding="utf-8"))["shear"]
                  for name in ("cloth/options.toml", "own.toml"))
    assert found == own, (found, own)
    shown_ = {name: page.find(f"#option-{name}").get_attribute("value") for name in values}
    assert shown_ == values and page.find("#option-yes-doubtful").is_selected(), shown_
    for name, value in (("speeds", "100"), ("temperatures", "180"), ("viscosity-coefficients", "2")):
        page.type(f"#option-{name}", value)  # of several curves: tests/cli/identify_test.sh
        assert page.find(f"#option-{name}").get_attribute("value") == value
        page.type(f"#option-{name}", "")
    page.pick("#option-temperature-law", "wlf")
    page.pick("#option-temperature-law", "")
    none = {name: "" for name in ("coefficients", "from", "to", "compliance", "zero", "toe", "slip", "angle-column")}
    again(page, {**none, "law": "table", "points": "5"}, "shear law")
    assert "table of 5 points: as asked for" in page.text("#identify-told"), page.text("#identify-told")
    again(page, {"law": "", "points": "", "stitch": "pillar"}, "Refused")
    assert "stitch = pillar" in page.text("#identify-told"), page.text("#identify-told")


def two_kinds(page, server):
    """Warp beside weft: the specimens of each in their own colours, and how they differ."""
    for name, yarns in (("warp", 3), ("weft", 6)):
        rows = [f"{0.1 * k},{0.001 * k * yarns * 40000 * (1 + 0.002 * (-1)**k)}" for k in range(21)]
        (server.folder / f"{name}.csv").write_text("\n".join(["displacement_mm,load_N", *rows]) + "\n",
                                                   encoding="utf-8")
    page.go(server, "identify/curve/warp.csv")
    page.pick("#identify-test", "warp")
    page.pick("#curve-file", "weft.csv")
    page.press("#curve-add")
    page.pick("#curve-1-kind", "other")
    page.pick("#identify-fabric", "cloth/base.toml")
    page.type("#identify-output", "yarns")
    page.press("#identify-replace")
    for more, ratio in (({"yarns": "3", "gauge-length": "100"}, 2), ({"weft-yarns": "12"}, 0.5)):
        again(page, more, "tension laws of warp and weft")
        table = dict(zip(*(page.texts(f"#identify-numbers tbody {cell}") for cell in ("th", "td:nth-of-type(1)"))))
        warp, weft = (float(table[f"{name}: stiffness"].replace(",", "")) for name in ("warp", "weft"))
        assert abs(warp / 40000 - 1) < 0.01 and abs(weft / (ratio * warp) - 1) < 0.01, table
    assert "they differ" in page.text("#identify-figures"), page.text("#identify-figures")
    assert page.texts("#identify-chart .legend-of-lines li") == [
        " measured warp", " fitted warp", " measured weft", " fitted weft"], page.texts("#identify-chart li")


def pull_out(page, server):
    """Tests of known friction at three speeds: the curve over the Hersey number, as text for a case."""
    for speed in (0.2, 1, 5):
        friction = (400e-6 * speed / 0.05) ** 0.3
        rows = [f"{2 * i},{2 * 4000 * 0.05 * friction * (i > 2):.9g}" for i in range(41)]
        (server.folder / f"pull_{speed}.csv").write_text("\n".join(["u,F", *rows]) + "\n", encoding="utf-8")
    page.go(server, "identify")
    page.pick("#identify-test", "pull-out")
    page.until(lambda: not page.find("#identify-fabric").is_displayed(), "no fabric is asked for")
    for speed in (0.2, 1, 5):
        page.pick("#curve-file", f"pull_{speed}.csv")
        page.press("#curve-add")
        page.until(lambda s=speed: f"pull_{s}.csv" in page.text("#curve-rows"), "it is there")
    page.type("#identify-output", "melt")
    page.press("#identify-replace")
    page.press("#identify-go")
    page.until(lambda: "area is missing" in page.text("#trouble"), "what is missing is told")
    values = {"area": "4000", "speeds": "0.2,1", "pressures": "0.05,0.05,0.05", "viscosity": "400", "from": "20",
              "to": "80", "points": "2", "name": "melt", "x-column": "u", "x-unit": "mm", "y-unit": "N"}
    again(page, values, "Refused")
    assert "must be one for each of the 3 curves" in page.text("#identify-told"), page.text("#identify-told")
    again(page, {"speeds": "0.2,1,5"}, "friction over the Hersey number")
    law = tomllib.loads((server.folder / "melt.toml").read_text(encoding="utf-8"))["friction"]["melt"]
    assert law["viscosity"] == 400 and len(law["curve"]) == 2, law
    for hersey, friction in law["curve"]:
        assert abs(friction / hersey**0.3 - 1) < 1e-4, law
    page.until(lambda: "[friction.melt]" in page.text("#identify-text"), "the text for a case is shown")
    assert not page.seen("#identify-open")
    assert page.js("return document.querySelectorAll('#identify-chart circle.point').length") == 3
    assert page.js("return document.querySelectorAll('#identify-chart polyline').length") == 1
    assert "Hersey number, mm" in page.text("#identify-chart"), page.text("#identify-chart")
    page.pick("#identify-test", "frame")
    page.until(lambda: page.find("#identify-fabric").is_displayed(), "a fabric is asked for again")


def compaction(page, server):
    """Eight plies between plates, in bar: a law of the fabric, and how thick it is without pressure."""
    volumes = [0.40 + 0.02 * k for k in range(12)]
    rows = [f"{8 * 600e-12 / 2.55e-9 / v:.9g},{600 * (v**9 - 0.4**9):.9g}" for v in volumes]  # fibres: 600 g/m2
    (server.folder / "pressed.csv").write_text("\n".join(["gap_mm,pressure_bar", *rows]) + "\n", encoding="utf-8")
    page.go(server, "identify/curve/pressed.csv")
    page.pick("#identify-test", "compaction")
    page.pick("#identify-fabric", "cloth/pressed_base.toml")
    page.type("#identify-output", "pressed")
    page.press("#identify-replace")
    again(page, {"layers": "8", "law": "toll_manson", "x-column": "gap_mm", "x-unit": "mm", "y-unit": "bar"},
          "compaction law")
    found = tomllib.loads((server.folder / "cloth/pressed.toml").read_text(encoding="utf-8"))
    law = found["compaction"]
    assert abs(law["stiffness"] / 60 - 1) < 1e-3 and abs(law["exponent"] / 9 - 1) < 1e-3, law
    assert abs(found["thickness"] / (600e-12 / 2.55e-9 / 0.4) - 1) < 1e-3, found
    page.until(lambda: len(page.texts("#identify-numbers tbody th")) > 3, "its numbers are shown")
    assert page.js("return document.querySelectorAll('#identify-chart circle.point').length") == 12
    assert page.texts("#identify-chart .of-axis") == ["pressure, N/mm²", "thickness, mm"]


def taken_in(page, server):
    """A file that is chosen on the page lies in the folder, and its curve is there at once."""
    source = server.folder.parent / f"{90 * 'x'}.csv"
    page.go(server, "identify")
    source.write_text("extension (mm),load (N)\n0,0\n1,2.5\n2,5\n", encoding="utf-8")
    page.give("#identify-upload", source)
    page.until(lambda: "take letters" in page.text("#trouble"), "a name that cannot be taken is told")
    source.rename(source.with_name("own curve.csv"))  # what no name may have becomes _
    page.give("#identify-upload", source.with_name("own curve.csv"))
    page.until(lambda: "3 rows: extension (mm), load (N)" in page.text("#curve-rows"), "its columns are shown")
    assert (server.folder / "curves/own_curve.csv").read_text(encoding="utf-8").endswith("2,5\n")
    page.until(lambda: page.js("return document.querySelectorAll('#curve-chart polyline').length") == 1, "its plot")
    page.pick("#curve-x", "load")
    page.until(lambda: page.texts("#curve-chart .of-axis") == ["load, N", "extension, mm"], "it is shown over the load")
    page.press("#curve-0-remove")
    page.until(lambda: not page.seen("#curve-chart svg") and not page.text("#curve-rows"), "it is taken out")


def missing_and_taken(page, server):
    page.type("#option-length", "")
    page.press("#identify-go")
    page.until(lambda: "length is missing" in page.text("#trouble"), "a size that is missing is told")
    page.type("#option-length", "230")
    page.js("document.getElementById('identify-replace').checked = false")
    page.press("#identify-go")
    page.until(lambda: "is there already" in page.text("#trouble"), "a name that is taken is told")


def restarted(page, server):
    """A server that begins anew shows what was found before."""
    number = server.get("api/processes", kind="identify")[0]["id"]
    server.stop()
    server.start()
    page.go(server, "identify")
    page.press(f'#identify-before a[href="#identify/{number}"]')
    page.until(lambda: page.texts("#identify-numbers tbody th"), "what was found is shown again")
    page.when("return document.querySelectorAll('#identify-chart circle.point').length > 5")
    page.press("#identify-open")
    page.until(lambda: page.js("return (window.plyform_setup || 0) && plyform_setup.editor.mirror.getValue()") ==
               (server.folder / "cloth/found.toml").read_text(encoding="utf-8"), "its text is shown")
    fabric_alone(page, server)


def fabric_alone(page, server):
    """The form of a fabric's file beside its text, and no parts of a case; then the case again."""
    file = server.folder / "cloth/found.toml"
    before = file.read_text(encoding="utf-8")
    page.until(lambda: page.find("#case-list").get_attribute("value") == "cloth/found.toml", "it is in the list")
    for part in (".outline", ".setup-middle", "#run-case-button", "#add-files"):
        page.when("return !document.querySelector(arguments[0]).getClientRects().length", part)
    page.type('[data-key="thickness"]', "0.6")
    page.until(lambda: tomllib.loads(file.read_text(encoding="utf-8"))["thickness"] == 0.6, "it is in the file")
    page.press("#undo")
    page.until(lambda: file.read_text(encoding="utf-8") == before, "it is taken back")
    page.js("const room = new DataTransfer(); room.items.add(new File(['solid a'], 'a.stl'));"
            "document.getElementById('panel-setup').dispatchEvent(new DragEvent('drop',"
            " { dataTransfer: room, bubbles: true, cancelable: true }));")
    page.until(lambda: "Open or make a case first" in page.text("#trouble"), "a fabric takes no files")
    server.send("api/cases", {"name": "begun"})
    page.go(server, "setup")
    page.until(lambda: page.text("#case-list") == "begun/case.toml" and page.seen("[data-item=case] button"), "a case")
    page.until(lambda: page.find(".outline").is_displayed() and page.find("#run-case-button").is_displayed(),
               "its outline and its button")
    page.go(server, "setup/cloth/found.toml")
    page.until(lambda: page.find("#case-list").get_attribute("value") == "cloth/found.toml", "the fabric again")
    page.pick("#case-list", "begun/case.toml")
    page.until(lambda: page.find(".outline").is_displayed() and page.text("#case-list") == "begun/case.toml", "the case")


def stopped(page, server):
    """One that takes long, which a program that waits before it begins stands for."""
    build = server.folder.parent / "build"  # with the program's Python module
    (build / "tools").mkdir(parents=True)
    (build / "python").symlink_to(PROGRAM.parents[1] / "python")
    slow = build / "tools/slow"
    slow.write_text(f'#!/bin/sh\n[ "$1" = identify ] && sleep 600\nexec "{PROGRAM}" "$@"\n', encoding="utf-8")
    slow.chmod(0o755)
    server.stop()
    server.command[-1] = str(slow)
    server.start()
    page.go(server, f"identify/{server.get('api/processes', kind='identify')[0]['id']}")
    page.until(lambda: page.texts("#identify-numbers tbody th"), "the form is that of the first")
    page.type("#identify-output", "never")
    page.press("#identify-go")
    page.until(lambda: page.text("#identify-state") == "It is computed …", "it goes on")
    page.press("#identify-stop")
    page.until(lambda: page.text("#identify-state") == "Stopped." and not page.find("#identify-stop").is_displayed(),
               "it is stopped")
    assert not (server.folder / "cloth/never.toml").exists()


def hostile(server):
    good = {"test": "frame", "curves": [{"path": CURVE, "column": "UML"}], "fabric": "cloth/base.toml",
            "output": "x.toml", "values": {"y-unit": "N/mm"}}
    for change in ({"test": "version"}, {"curves": [{"path": "../../etc/passwd"}]}, {"curves": []}, {"curves": "x"},
                   {"curves": [{"path": CURVE, "column": "a\nb"}]}, {"fabric": "../base.toml"}, {"output": "../x.toml"},
                   {"output": "-o"}, {"output": "base.toml"}, {"values": {"output": "x"}},
                   {"values": {"side": "1; ls"}}, {"values": {"law": "--report=x"}}, {"values": {"slip": "5"}},
                   {"others": [{"path": "/etc/passwd"}]}, {"test": "pull-out", "values": {"area": "1"}}):
        status, content = server.call("POST", "api/identify", {**good, **change})
        assert status in (403, 404, 409, 422) and content["error"], (change, status, content)
    (server.folder / "words.csv").write_text("only, words\nand, more\n", encoding="utf-8")
    status, content = server.call("GET", "api/identify/curve", query={"path": "words.csv"})
    assert status == 422 and "no row of numbers" in content["error"], content


def options_are_those_of_the_program(server):
    """Each that the page asks for stands in --help of its test, and each that is required there is."""
    for test in server.get("api/identify/tests"):
        told = subprocess.run([PROGRAM, "identify", test["word"], "--help"], capture_output=True, text=True,
                              check=True).stdout
        asked = [*test["sizes"], *test["corrections"]]
        for option in asked:
            assert re.search(rf"--{option['name']}\b", told), (test["word"], option["name"])
        required = set(re.findall(r"--([\w-]+) [^\n]*REQUIRED", told)) - {"fabric", "output"}
        assert required == {option["name"] for option in asked if option["required"]}, (test["word"], required)


def main():
    picture = sys.argv[4] if len(sys.argv) > 4 else ""
    with Server(TOOLS, PROGRAM) as server, Page(1280, 1400) as page:
        page.server = server
        server.folder.joinpath("cloth").mkdir()
        shutil.copy(CASES / "fabrics/glass_pp_plain.toml", server.folder / "cloth/base.toml")
        shutil.copy(CASES / "fabrics/glass_plain_weave_compaction.toml", server.folder / "cloth/pressed_base.toml")
        shutil.copytree(CASES / "measured", server.folder / "measured")
        options_are_those_of_the_program(server)
        frame(page, server)
        shown(page, server)
        if picture:
            page.screenshot(picture)
        refused_curve(page, server)
        missing_and_taken(page, server)
        every_option(page, server)
        two_kinds(page, server)
        pull_out(page, server)
        compaction(page, server)
        taken_in(page, server)
        restarted(page, server)
        hostile(server)
        stopped(page, server)
        assert not [one for one in page.errors() if "status of 4" not in one and "ERR_CONNECTION" not in one
                    and "WebSocket" not in one], page.errors()


if __name__ == "__main__":
    main()
