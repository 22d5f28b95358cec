# SPDX-License-Identifier: GPL-3.0-or-later
"""Identification in the workbench, by clicks: a picture frame that was measured, the fit over it and
the limits of each number; a refusal with its remedy; hostile orders.

    studio_identify_test.py TOOLS_FOLDER PLYFORM CASES_FOLDER [PICTURE.png]
"""

import json
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
    assert "12 rows" in page.text("#curve-rows"), page.text("#curve-rows")
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
    report = json.loads((server.folder / "cloth/found_fit.json").read_text(encoding="utf-8"))
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
    assert page.find("#identify-open").get_attribute("href").endswith("#setup/cloth/found.toml")
    page.press("#identify-log")
    page.until(lambda: "0.05" in page.text("#identify-chart") or "0.1" in page.text("#identify-chart"),
               "the axis is logarithmic")


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
    assert not (server.folder / "cloth/bias.toml").exists()
    page.press("#identify-more summary")
    page.type("#option-to", "50")
    page.press("#identify-replace")
    page.press("#identify-go")
    page.until(lambda: page.text("#identify-state").startswith("shear law"), "with --to 50 it is found")
    assert (server.folder / "cloth/bias.toml").exists()
    assert page.find("#option-length").get_attribute("value") == "230", "the form is as it was"


def two_kinds(page, server):
    """Warp beside weft: the specimens of each in their own colours, and how they differ."""
    for name, stiffness in (("warp", 40000.0), ("weft", 30000.0)):
        rows = [f"{0.001 * k},{0.001 * k * stiffness * (1 + 0.002 * (-1)**k)}" for k in range(21)]
        (server.folder / f"{name}.csv").write_text("\n".join(["strain,load_N", *rows]) + "\n", encoding="utf-8")
    page.go(server, "identify/curve/warp.csv")
    page.pick("#identify-test", "warp")
    page.pick("#curve-file", "weft.csv")
    page.press("#curve-add")
    page.pick("#curve-1-kind", "other")
    page.pick("#identify-fabric", "cloth/base.toml")
    page.type("#identify-output", "yarns")
    page.press("#identify-go")
    page.until(lambda: page.text("#identify-state").startswith("tension laws of warp and weft"), "both are found")
    names = page.texts("#identify-numbers tbody th")
    assert names[0] == "warp: stiffness" and "weft: stiffness" in names, names
    assert "they differ" in page.text("#identify-figures"), page.text("#identify-figures")
    assert page.texts("#identify-chart .legend-of-lines li") == [
        " measured warp", " fitted warp", " measured weft", " fitted weft"], page.texts("#identify-chart li")


def taken_in(page, server):
    """A file that is chosen on the page lies in the folder, and its curve is there at once."""
    source = server.folder.parent / "own curve.csv"
    page.go(server, "identify")
    source.write_text("extension (mm),load (N)\n0,0\n1,2.5\n2,5\n", encoding="utf-8")
    page.find("#identify-upload").send_keys(str(source))
    page.until(lambda: "take letters" in page.text("#trouble"), "a name that cannot be taken is told")
    source.rename(source.with_name("own_curve.csv"))
    page.find("#identify-upload").send_keys(str(source.with_name("own_curve.csv")))
    page.until(lambda: "3 rows: extension (mm), load (N)" in page.text("#curve-rows"), "its columns are shown")
    assert (server.folder / "curves/own_curve.csv").read_text(encoding="utf-8").endswith("2,5\n")
    page.until(lambda: page.js("return document.querySelectorAll('#curve-chart polyline').length") == 1, "its plot")


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
    page.go(server, f"identify/{number}")
    page.until(lambda: page.texts("#identify-numbers tbody th"), "what was found is shown again")
    assert page.js("return document.querySelectorAll('#identify-chart circle.point').length") > 5


def hostile(server):
    good = {"test": "frame", "curves": [{"path": CURVE, "column": "UML"}], "fabric": "cloth/base.toml",
            "output": "x.toml", "values": {"y-unit": "N/mm"}}
    for change in ({"test": "version"}, {"curves": [{"path": "../../etc/passwd"}]}, {"curves": []}, {"curves": "x"},
                   {"curves": [{"path": CURVE, "column": "a\nb"}]}, {"fabric": "../base.toml"}, {"output": "../x.toml"},
                   {"output": "-o"}, {"output": "base.toml"}, {"values": {"output": "x"}},
                   {"values": {"side": "1; ls"}}, {"values": {"law": "--report=x"}}, {"values": {"slip": "5"}},
                   {"others": [{"path": "/etc/passwd"}]}):
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
        server.folder.joinpath("cloth").mkdir()
        shutil.copy(CASES / "fabrics/glass_pp_plain.toml", server.folder / "cloth/base.toml")
        shutil.copytree(CASES / "measured", server.folder / "measured")
        options_are_those_of_the_program(server)
        frame(page, server)
        shown(page, server)
        if picture:
            page.screenshot(picture)
        refused_curve(page, server)
        missing_and_taken(page, server)
        two_kinds(page, server)
        taken_in(page, server)
        restarted(page, server)
        hostile(server)
        assert not [one for one in page.errors() if "status of 4" not in one and "ERR_CONNECTION" not in one
                    and "WebSocket" not in one], page.errors()


if __name__ == "__main__":
    main()
