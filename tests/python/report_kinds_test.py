# SPDX-License-Identifier: GPL-3.0-or-later
"""Reports of runs that ended in other ways, or form something else: each says what it is.

    report_kinds_test.py TOOLS PROGRAM CASES

Leaves with 77 when Chromium, its driver, selenium, h5py or Jinja2 is missing.
"""

import json
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from report_browser import Browser

import h5py
import numpy as np

TOOLS, PROGRAM, CASES = (Path(argument).resolve() for argument in sys.argv[1:4])

SHEETS = """title = "{title}"
[fabrics]
cloth = {fabric}
[blanks.square]
size = [100.0, 100.0]
mesh = "alternating"
element_size = 25.0
{plies}
[[tool]]
name = "punch"
shape = "sphere"
radius = 30.0
position = [0.0, 0.0, {height}]
motion = "driven"
direction = [0.0, 0.0, -1.0]
stroke = 2.0
[solver]
duration = 0.005
outputs = 2
"""
FOIL = ('{ surface_density = 100.0, thickness = 0.1, law = "isotropic", '
        'isotropic = { youngs_modulus = 100.0, poissons_ratio = 0.3 } }')


def call(*words):
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)


def run(folder, case, *settings):
    words = [word for setting in settings for word in ("--set", setting)]
    done = call("run", case, "-o", folder, *words)
    assert (folder / "results.h5").is_file(), done
    return folder


def sheets(folder, title, fabric, count):
    plies = "\n".join(f'[[ply]]\nname = "p{k}"\nfabric = "cloth"\nblank = "square"\n'
                      f"angle = {45.0 * (k % 2)}" for k in range(1, count + 1))
    folder.mkdir()
    thick = 0.1 if "isotropic" in fabric else 0.6
    case = folder / "case.toml"
    case.write_text(SHEETS.format(title=title, fabric=fabric, plies=plies,
                                  height=30.0 + thick * count), encoding="utf-8")
    return run(folder / "results", case)


def changed(folder, to, **keys):
    """A copy of the results whose summary says otherwise; without one for summary=None."""
    shutil.copytree(folder, to)
    path = to / "summary.json"
    summary = json.loads(path.read_text(encoding="utf-8"))
    for ply in summary["plies"]:
        ply.update(keys.pop("of_plies", {}))
    path.write_text(json.dumps({**summary, **keys}), encoding="utf-8")
    return to


def shown(browser, folder):
    """The words of a page, opened, with the controls that it has."""
    path = folder / "report.html"
    done = call("report", folder)
    assert done.returncode == 0 and done.stdout.strip() == str(path), done
    browser.open(path)
    assert not browser.errors()
    fields = browser.js("return [...document.getElementById('field').options].map((o) => o.value)")
    return browser.find("body").text, fields


def killed_run(folder):
    """A stack with tools, killed after its third state."""
    settings = ("blanks.square.mesh_from=element_size", "blanks.square.element_size=34",
                "solver.duration=0.02")
    words = [word for setting in settings for word in ("--set", setting)]
    process = subprocess.Popen([PROGRAM, "run", CASES / "hemisphere_two_ply", *words, "-o", folder],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while not (folder / "states/000002.h5").exists():
        assert process.poll() is None, "the run has ended before it could be killed"
        time.sleep(0.002)
    process.kill()
    process.wait()
    assert not (folder / "summary.json").exists()
    return folder


def check_endings(browser, folder):
    frame = run(folder / "frame", CASES / "picture_frame", "blanks.square.element_size=25",
                "solver.outputs=3")
    words, fields = shown(browser, frame)
    assert "no tools: a test of the fabric" in words and "gap" not in fields and "shear" in fields
    assert "Grips and frames" in words and "\nframe" in words
    stopped = changed(frame, folder / "stopped", status="stopped", message="ply p is squeezed")
    words, _ = shown(browser, stopped)
    assert "Does not form: plyform stopped the run at" in words and "Ply p is squeezed." in words
    words, _ = shown(browser, changed(frame, folder / "interrupted", status="interrupted"))
    assert "Not finished: the run was interrupted at" in words
    words, _ = shown(browser, killed_run(folder / "killed"))
    assert "Not finished: the run goes on, or was killed" in words and "no summary.json" in words
    doubtful = changed(frame, folder / "doubtful", status="doubtful",
                       missing=["do not trust the corners", "friction: none"],
                       doubts=["do not trust the corners"], advice=["friction: none"],
                       message="do not trust the corners",
                       of_plies={"locking_angle_deg": 40, "area_share_beyond_locking_angle": 0.5})
    words, _ = shown(browser, doubtful)
    assert words.index("Do not trust the corners.") < words.index("Shear angle".upper())
    assert "passes its locking angle on 50.0" in words.replace("\u00a0", " ")
    assert browser.js("return document.getElementById('limit').value") == "40"
    assert "above 40.0" in browser.find(".legend-limit").text


def check_sheets(browser, folder):
    glass = f'"{CASES / "fabrics" / "glass_plain_weave.toml"}"'
    words, fields = shown(browser, sheets(folder / "one", "One ply", glass, 1))
    assert "1 ply," in words and "pressed" in fields and "gap" in fields
    words, _ = shown(browser, sheets(folder / "twenty", "Twenty plies", glass, 20))
    assert "20 plies" in words and words.index("p20\n") < words.index("p1\n")
    assert len(browser.driver.find_elements("css selector", "#plies input")) == 20
    tape = f'"{CASES / "fabrics" / "ud.toml"}"'
    one = sheets(folder / "tape", "A tape", tape, 1)
    words, fields = shown(browser, one)
    assert "tow-opening" in fields and "No family passes its limit" in words
    assert "bridging" not in fields and "BRIDGING" not in words.upper()
    bridges = {"bridging_height_mm": 5.86, "bridging_area_mm2": 126.0, "bridging_at_mm": [0, 0, -20],
               "bridging_family": "tow", "bridging_max_tension_N_per_yarn": 0.5,
               "bridging_mean_tension_N_per_yarn": 0.25}
    words, _ = shown(browser, changed(one, folder / "bridges", of_plies=bridges))
    words = words.replace("\u00a0", " ")
    assert "over 126 mm² of that ply" in words and "0.50 N per yarn at most, 0.25" in words, words
    gapes = {"family": "tow", "largest": 0.25, "at_mm": [1, 2, 3], "limit": 0.1,
             "area_share_beyond_limit": 0.02, "area_mm2_beyond_limit": 120.0}
    words, _ = shown(browser, changed(one, folder / "gapes", of_plies={"openings": [gapes]}))
    words = words.replace("\u00a0", " ")
    assert "gape by 25.0" in words and "pass their limit of 10.0 % on 120 mm²" in words, words
    words, fields = shown(browser, sheets(folder / "foil", "A foil", FOIL, 1))
    assert "pressed" not in fields and "Pressed yarns".upper() not in words
    assert "predicted: not measured: cloth is a sheet without yarns." in words


def check_pressed(browser, folder):
    """A film that pressure forms: nothing has a stroke, and curves go by the time."""
    film = run(folder / "film", CASES / "inflated_membrane", "blanks.quarter.element_size=20", "solver.outputs=4")
    words, _ = shown(browser, film)
    words = words.replace("\u00a0", " ")
    assert "Over the time".upper() in words.upper() and "of stroke" not in words, words
    assert "Forms in" in words and "not measured: pressures form the plies, and nothing has a stroke" in words, words
    assert "Pressure of loads on plies" in words, words
    axis = browser.js("return [...document.querySelectorAll('#chart-load-pressure text')].map((t) => t.textContent)")
    assert "time, ms" in axis and len(axis) > 6, axis
    browser.choose("stroke", 2)
    assert " ms" in browser.find("#state").text and browser.find("#state-number").text == "state 3 of 5"
    one = browser.js("return plyform_report.runs[0].reached")
    assert one[0] == 0 and all(a < b for a, b in zip(one, one[1:])) and 20.0 < one[-1] < 30.0, one


def in_mould(folder, to):
    """A copy of the results, with a stack of 50 % in a closed mould on the first half of the triangles."""
    shutil.copytree(folder, to)
    with h5py.File(to / "results.h5", "r+") as file:
        for ply in file["plies"].values():
            columns = [*ply.attrs["columns"], b"stack_fibre_volume"]
            ply.attrs["columns"] = np.array(columns, dtype=f"S{max(map(len, columns))}")
        for state in file["frames"].values():
            for ply in state["plies"].values():
                own = ply["fibre_volume"]
                there = np.arange(len(own)) < len(own) // 2
                stack = ply.create_dataset("stack_fibre_volume", data=np.where(there, 0.5, 0.0))
                stack.attrs.update(own.attrs)
                stack.attrs["word"] = np.bytes_("stack-fibre-volume")
    return to


def histogram(browser):
    return browser.js("return JSON.parse(document.getElementById('scene').textContent).runs[0].histograms")


def check_fibre_volume(browser, folder):
    """A card and a histogram of runs that know it, and of no others."""
    glass = f'"{CASES / "fabrics" / "glass_plain_weave_compaction.toml"}"'
    two = sheets(folder / "two", "Two plies", glass, 2)
    words, fields = shown(browser, two)
    words = words.replace("\u00a0", " ")
    assert "fibre-volume" in fields and "FIBRE VOLUME" in words.upper() and "Over the area".upper() in words.upper()
    one, = histogram(browser)
    with h5py.File(two / "results.h5") as file:
        last = file["frames"][sorted(file["frames"])[-1]]["plies"]
        for line in one["lines"]:
            ply, triangles = last[line["name"]], file[f"plies/{line['name']}/triangles"][:]
            corners = ply["x"][:][triangles]
            area = np.linalg.norm(np.cross(*(corners[:, k] - corners[:, 0] for k in (1, 2))), axis=1)
            volume = 100.0 * ply["fibre_volume"][:]
            assert abs(line["mean"] - (volume * area).sum() / area.sum()) < 1e-3, line
            assert abs(line["least"] - volume.min()) < 1e-3 and abs(line["largest"] - volume.max()) < 1e-3, line
            assert abs(sum(line["values"]) - 100.0) < 0.01, line
            for at, share in zip(one["at"], line["values"]):
                inside = abs(volume - at) < 0.5 * one["step"] - 1e-9
                assert share >= 100.0 * area[inside].sum() / area.sum() - 1e-3, (at, share)
            assert f"{line['name']} {line['mean']:.1f}" in words, words
    assert len(one["lines"]) == 2
    legend = browser.find("#histogram-fibre-volume .legend-of-lines").text
    assert f"{one['lines'][0]['least']:.1f} to {one['lines'][0]['largest']:.1f}" in legend, legend
    assert len(browser.driver.find_elements("css selector", "#histogram-fibre-volume polyline")) == 2
    words, _ = shown(browser, in_mould(two, folder / "mould"))
    words = words.replace("\u00a0", " ")
    assert "50.0 %\nMean of the stack in the mould, which has 50.0 to 50.0 %." in words, words
    stack = histogram(browser)[0]["lines"][-1]
    assert stack["mean"] == 50.0 and max(stack["values"]) == 100.0, stack
    words, _ = shown(browser, sheets(folder / "none", "A foil", FOIL, 1))
    assert "FIBRE VOLUME" not in words.upper() and not histogram(browser)
    assert not browser.driver.find_elements("css selector", ".histograms")


def check_messages(folder):
    empty = folder / "empty"
    empty.mkdir()
    for words, told in (((empty,), "results.h5 is missing"), ((), "required"),
                        ((empty,) * 5, "5 folders are given")):
        done = call("report", *words)
        assert done.returncode in (1, 2) and told in done.stderr and "Traceback" not in done.stderr, done
    (empty / "results.h5").write_text("no HDF5", encoding="utf-8")
    done = call("report", empty)
    assert done.returncode == 1 and "cannot be read as results of plyform" in done.stderr, done
    done = call("run", CASES / "picture_frame", "-o", folder / "with", "--report", "--set",
                "blanks.square.element_size=50", "--set", "solver.outputs=1")
    assert done.returncode == 0 and (folder / "with" / "report.html").is_file(), done
    assert "Warning" not in done.stderr, done
    assert done.stdout.strip().splitlines()[-1] == str(folder / "with" / "report.html"), done


def check_print(browser, folder):
    """A printed page has pictures of the part, and none of the controls."""
    import base64
    browser.open(folder / "frame" / "report.html")
    pdf = base64.b64decode(browser.driver.execute_cdp_cmd("Page.printToPDF", {})["data"])
    assert pdf.startswith(b"%PDF")
    assert browser.js("return document.querySelectorAll('#prints img').length") == 3
    assert browser.js("return [...document.querySelectorAll('#prints img')].every((i) => i.src.length > 3000)")


def main():
    with tempfile.TemporaryDirectory() as name, Browser() as browser:
        folder = Path(name)
        check_messages(folder)
        check_endings(browser, folder)
        check_print(browser, folder)
        check_sheets(browser, folder)
        check_pressed(browser, folder)
        check_fibre_volume(browser, folder)


main()
