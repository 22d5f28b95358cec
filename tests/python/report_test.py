# SPDX-License-Identifier: GPL-3.0-or-later
"""Clicks through reports of small runs in headless Chromium: every control changes what it should,
numbers are those of the tables and of results.h5, nothing is asked of a network.

    report_test.py PART TOOLS PROGRAM CASES      PART: one, two, more

Leaves with 77 when Chromium, its driver, selenium, h5py or Jinja2 is missing.
"""

import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from report_browser import Browser

import h5py
import numpy as np

TOOLS, PROGRAM, CASES = (Path(argument).resolve() for argument in sys.argv[2:5])
COARSE = ["blanks.square.mesh_from=element_size", "blanks.square.element_size=34",
          "solver.outputs=4", "solver.duration=0.02"]


def run(folder, *settings):
    """Two plies of 200 triangles over a hemisphere, five states."""
    words = [word for setting in [*COARSE, *settings] for word in ("--set", setting)]
    done = subprocess.run([PROGRAM, "run", CASES / "hemisphere_two_ply", "-o", folder, *words],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done
    return folder


def report(path, *folders):
    done = subprocess.run([PROGRAM, "report", *folders, "-o", path], capture_output=True, text=True,
                          check=False)
    assert done.returncode == 0 and done.stdout.strip() == str(path), done
    return path


def table(folder, ply):
    with open(folder / "plies" / f"{ply}.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def pixel_of(browser, view, ply, triangle):
    """Where the middle of a triangle is in the window."""
    return browser.js("""
        const [v, i, t] = arguments, view = plyform_report.stage.views[v], mesh = view.plies[i];
        const x = view.flat ? mesh.ply.flat : view.x[i], p = {x: 0, y: 0, z: 0};
        for (let k = 0; k < 3; ++k) [...'xyz'].forEach((c, n) => {
          p[c] += x[3 * mesh.ply.triangles[3 * t + k] + n] / 3; });
        const place = view.marker.position.clone().set(p.x, p.y, p.z + mesh.object.position.z);
        return plyform_report.stage.pixelOf(view, place);""", view, ply, triangle)


def told(browser):
    """The numbers of the panel by field, and which triangle they are of."""
    return browser.js("""
        const panel = document.getElementById('probe'), out = {};
        for (const row of panel.querySelectorAll('tr[data-field]')) out[row.dataset.field] = Number(row.dataset.value);
        return [panel.dataset.ply, Number(panel.dataset.triangle), out, panel.textContent];""")


def check_numbers(browser, folder):
    """A click on each of some triangles, in the part from above and in the flat blank."""
    browser.click("#view-top")
    browser.js("document.getElementById('part').scrollIntoView()")
    top = 1
    rows = table(folder, "ply2")
    for triangle in range(5, len(rows), 23):
        for view in (0, 1):
            at = pixel_of(browser, view, top, triangle)
            browser.click_at(at["x"], at["y"])
            name, number, values, _ = told(browser)
            assert name == "ply2" and (view == 0 or number == triangle), (view, triangle, name, number)
            row = {key: float(value) for key, value in rows[number].items()}
            assert abs(values["shear-signed"] - row["shear_angle_deg"]) < 0.05
            assert abs(values["shear-signed"] - row["shear_angle_deg"]) < 0.003  # as the page says
            assert abs(values["shear"] - abs(row["shear_angle_deg"])) < 0.003
            assert abs(values["warp-strain"] - 100 * row["warp_strain"]) < 2e-3
            assert abs(values["weft-strain"] - 100 * row["weft_strain"]) < 2e-3
            pressed = 100 * max(0.0, -min(row["warp_strain"], row["weft_strain"]))
            assert abs(values["pressed"] - pressed) < 2e-3
            most = max(row["warp_tension_N"], row["weft_tension_N"])
            assert abs(values["tension"] - most) < 1e-4 * (1 + abs(most)), (values["tension"], most)
            assert abs(values["thickness"] - row["thickness_mm"]) < 1e-4
    at = pixel_of(browser, 1, top, 77)
    browser.driver.execute_cdp_cmd("Input.dispatchMouseEvent",
                                   {"type": "mouseMoved", "x": at["x"], "y": at["y"]})
    browser.wait("new Promise((go) => setTimeout(go, 400))")
    hint = float(browser.js("return document.getElementById('hint').dataset.value"))
    assert abs(hint - abs(float(rows[77]["shear_angle_deg"]))) < 0.003


def check_states(browser, folder):
    """Every state of the slider is that of results.h5."""
    with h5py.File(folder / "results.h5") as file:
        for state in range(len(file["time_s"])):
            browser.choose("stroke", state)
            for i, name in enumerate(("ply1", "ply2")):
                ply = file[f"frames/{state:06}/plies/{name}"]
                x = np.array(browser.js(
                    "return Array.from(plyform_report.stage.views[0].x[arguments[0]])", i))
                assert abs(x.reshape(-1, 3) - ply["x"][:]).max() < 0.01
                shown = np.array(browser.js(
                    "return Array.from(plyform_report.stage.views[0].plies[arguments[0]]"
                    ".surface.geometry.getAttribute('value').array)", i))[::3]
                assert abs(shown - abs(ply["shear_angle_deg"][:])).max() < 0.003
            stroke = file["stroke_mm"][state]
            assert browser.find("#state").text.startswith(f"{stroke:.2f}"), stroke
            assert f"state {state + 1} of" in browser.find("#state-number").text


def distance_to_triangles(p, corners):
    """The least distance of a point from triangles, by brute force on 28 x 28 points of each."""
    k = np.linspace(0.0, 1.0, 28)
    u, v = (grid.ravel() for grid in np.meshgrid(k, k))
    u, v = np.where(u + v > 1.0, 1.0 - u, u), np.where(u + v > 1.0, 1.0 - v, v)
    near = corners[np.argsort(np.linalg.norm(corners.mean(axis=1) - p, axis=1))[:400]]
    points = (near[:, 0, None] + u[:, None] * (near[:, 1] - near[:, 0])[:, None]
              + v[:, None] * (near[:, 2] - near[:, 0])[:, None])
    return np.linalg.norm(points - p, axis=2).min()


def check_computed(browser, folder):
    """Gaps against brute force on the tools of results.h5, wrinkles as the summary has them."""
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    for i, ply in enumerate(summary["plies"]):
        shown = browser.wait("plyform_report.runs[0].plies[arguments[0]].block('wrinkle_height_mm')"
                             ".then((block) => Math.max(...block.state(4)))", i)
        height = ply["wrinkle_height_mm"] if ply["wrinkle_height_mm"] >= 0.3 else 0.0
        assert abs(shown - height) < 2e-3, (shown, height)
    gaps = browser.js("return Array.from(plyform_report.runs[0].plies[1].computed('gap', 4))")
    with h5py.File(folder / "results.h5") as file:
        now, x = file["frames/000004"], file["frames/000004/plies/ply2/x"][:]
        corners = [file[f"tools/{name}/x0"][:][file[f"tools/{name}/triangles"][:]]
                   + now[f"tools/{name}"].attrs["displacement_mm"] for name in file["tools"]]
    half = browser.js("return 0.5 * plyform_report.runs[0].plies[1].data.thickness")
    for node in range(3, len(x), 17):
        gap = min(distance_to_triangles(x[node], one) for one in corners) - half
        assert abs(gaps[node] - min(gap, 30.0)) < 0.25, (node, gaps[node], gap)


def check_controls(browser):
    """Each control changes the picture, and back is as before."""
    browser.choose("stroke", 4)
    browser.click("#view-oblique")
    before = browser.picture()
    for id_, values in (("field", ["shear-signed", "pressed", "tensile", "tension", "wrinkle", "gap",
                                   "pressure", "thickness", "warp-strain", "weft-tension"]),
                        ("colours", ["cividis", "grey"]), ("steps", [5]), ("low", [10]),
                        ("high", [20]), ("limit", [25]), ("yarns", [20, 5]), ("apart", [30]),
                        ("tools", ["solid", "hidden"]), ("flat-ply", [0])):
        usual = browser.js("return document.getElementById(arguments[0]).value", id_)
        seen = {before}
        for value in values:
            browser.choose(id_, value)
            seen.add(browser.picture())
        assert len(seen) == 1 + len(values), f"{id_}: {len(seen)} pictures of {1 + len(values)}"
        browser.choose(id_, usual)
        assert browser.picture() == before, f"{id_} is not back"
    for name in ("top", "bottom", "front", "side"):
        browser.click(f"#view-{name}")
        assert browser.picture() != before
    browser.click("#view-oblique")
    browser.click("#plies input[data-ply=ply2]")
    assert browser.picture() != before
    browser.click("#plies input[data-ply=ply2]")
    assert browser.picture() == before


def check_section(browser):
    before = browser.picture()
    pictures = {before}
    for way in ("x", "y", "level", "angle"):
        browser.choose("section-way", way)
        pictures.add(browser.picture())
    browser.choose("section-angle", 30)
    pictures.add(browser.picture())
    browser.choose("section-offset", 40)
    pictures.add(browser.picture())
    assert len(pictures) >= 6, len(pictures)  # at an angle begins along y
    browser.choose("section-way", "x")
    browser.choose("section-offset", 0)
    cut = np.array(browser.js(
        "return Array.from(plyform_report.stage.views[0].cut.children[0].geometry"
        ".getAttribute('position').array)")).reshape(-1, 3)
    assert abs(cut[:, 1] - cut[0, 1]).max() < 1e-3 and np.ptp(cut[:, 0]) > 200  # in the plane y = c
    thick = np.linalg.norm(cut[0::6] - cut[1::6], axis=1)
    assert abs(thick - browser.js("return plyform_report.runs[0].plies[0].data.thickness")).max() < 1e-3
    browser.choose("section-way", "off")
    assert browser.picture() == before


def check_curves_keys_film(browser):
    browser.choose("stroke", 4)
    svg = browser.find("#chart-forces svg")
    browser.js("arguments[0].scrollIntoView({block: 'center'})", svg)
    room = svg.rect
    box = browser.js("const r = arguments[0].getBoundingClientRect(); return [r.left, r.top]", svg)
    browser.click_at(box[0] + 0.56 * room["width"], box[1] + 0.5 * room["height"])
    assert browser.js("return plyform_report.settings.state") == 2
    browser.js("document.body.focus()")
    for key, state in ((".", 3), (",", 2), (",", 1)):
        browser.js("document.dispatchEvent(new KeyboardEvent('keydown', {key: arguments[0]}))", key)
        browser.settle()
        assert browser.js("return plyform_report.settings.state") == state
    turned = browser.js("return plyform_report.stage.camera.azimuth")
    browser.js("document.getElementById('formed-0').dispatchEvent("
               "new KeyboardEvent('keydown', {key: 'ArrowLeft'}))")
    assert browser.js("return plyform_report.stage.camera.azimuth") != turned
    browser.js("window.seen = []; plyform_report.watchers.push((states) => seen.push(states[0]))")
    browser.click("#film")
    browser.wait("new Promise((go) => { const look = () => (seen.length > 4 ? go() : setTimeout(look, 20)); look(); })")
    browser.click("#film")
    assert browser.find("#film").get_attribute("aria-pressed") == "false"
    seen = browser.js("return seen")
    assert all((b - a) % 5 in (0, 1) for a, b in zip(seen, seen[1:])) and len(set(seen)) > 3, seen


def check_answers(browser, folder):
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    most = max(ply["max_shear_deg"] for ply in summary["plies"])
    assert browser.find(".cards .figure").text == f"{most:.1f}°"
    browser.click("button.place")
    _, _, values, _ = told(browser)
    assert abs(values["shear"] - most) < 0.003
    top = browser.find("main").text[:200]
    assert ("but" in top) or ("nothing found" in top), top
    if summary["status"] == "doubtful":
        assert browser.find(".doubtful[role=note]").rect["y"] < browser.find(".cards").rect["y"]
    punch = next(tool for tool in summary["tools"] if tool["name"] == "punch")
    assert f"{punch['force_N']:.0f}" in browser.find(".cards").text.replace(",", "")


def check_quiet(browser, path):
    errors = browser.errors()
    assert not errors, errors
    others = [url for url in browser.requests()
              if url != path.resolve().as_uri() and not url.startswith(("data:", "blob:"))]
    assert not others, others


def check_one(folder):
    results = run(folder / "a")
    path = report(folder / "one.html", results)
    with Browser() as browser:
        browser.open(path)
        check_answers(browser, results)
        check_numbers(browser, results)
        check_states(browser, results)
        check_computed(browser, results)
        check_controls(browser)
        check_section(browser)
        check_curves_keys_film(browser)
        check_quiet(browser, path)
    with Browser(language="de-DE") as browser:
        browser.open(path)
        assert "," in browser.find(".cards .figure").text
        assert "," in browser.find("#state").text


def largest_differences(second, first):
    done = subprocess.run([PROGRAM, "difference", second, first, "--by-ply"], check=True,
                          capture_output=True, text=True)
    return [float(row["max"]) for row in csv.DictReader(done.stdout.splitlines())]


def check_two(folder):
    first, second = run(folder / "a"), run(folder / "b", "contact.friction=0.4")
    path = report(folder / "two.html", first, second)
    with Browser() as browser:
        browser.open(path)
        before = browser.picture()
        browser.click("#difference")
        assert browser.picture() != before
        rows = [[browser.find(f"#{kind}-{which}").rect for which in ("0", "1", "difference")]
                for kind in ("formed", "flat")]
        for row in rows:  # three pictures of one size beside each other, the flat ones below
            assert row[0]["x"] < row[1]["x"] < row[2]["x"] and len({r["y"] for r in row}) == 1, row
            assert max(r["width"] for r in row) - min(r["width"] for r in row) < 3, row
        assert rows[0][0]["y"] < rows[1][0]["y"]
        titles = [title.text for title in browser.driver.find_elements("css selector", "h1")]
        assert len(titles) == 2 and "(a)" in titles[0] and "(b)" in titles[1], titles
        browser.choose("field", "shear-signed")
        browser.settle()
        largest = largest_differences(second, first)
        shown = browser.js("return plyform_report.differences.map((d) => "
                           "Math.max(...d.values.map(Math.abs)))")
        assert abs(np.array(shown) - largest).max() < 0.006 and max(largest) > 0.1, (shown, largest)
        browser.choose("field", "shear")
        browser.settle()
        turned = browser.picture()
        browser.click("#view-side")  # linked: all pictures turn
        assert browser.picture() != turned
        check_quiet(browser, path)
    path = report(folder / "same.html", first, first)
    with Browser() as browser:
        browser.open(path)
        browser.click("#difference")
        assert browser.js("return Math.max(...plyform_report.differences.map((d) => "
                          "Math.max(...d.values.map(Math.abs))))") == 0
        check_quiet(browser, path)


def check_room(browser, count):
    """Pictures of a kind are of one size, none lies on another, and all are in the room."""
    room = browser.find(".room").rect
    shown = [view for view in browser.driver.find_elements("css selector", ".view")
             if view.is_displayed()]
    assert len(shown) == 2 * count, len(shown)
    rects = [view.rect for view in shown]
    for kind in ("formed", "flat"):
        sizes = {(round(view.rect["width"] / 3), round(view.rect["height"] / 3)) for view in shown
                 if kind in view.get_attribute("class").split()}
        assert len(sizes) <= 2, (kind, sizes)  # of rounding
    for i, a in enumerate(rects):
        assert a["width"] > 150 and a["height"] > 150, a
        assert a["x"] + a["width"] < room["x"] + room["width"] + 2, (a, room)
        assert a["y"] + a["height"] < room["y"] + room["height"] + 2, (a, room)
        for b in rects[:i]:
            apart = (a["x"] >= b["x"] + b["width"] - 2 or b["x"] >= a["x"] + a["width"] - 2
                     or a["y"] >= b["y"] + b["height"] - 2 or b["y"] >= a["y"] + a["height"] - 2)
            assert apart, (a, b)


def check_each_difference(browser, folders):
    """Of each run to the first: the number that plyform difference has, under its name."""
    browser.choose("field", "shear-signed")
    pictures = set()
    for k in range(1, len(folders)):
        browser.choose("difference-of", k)
        assert browser.js("return document.getElementById('difference').checked")
        name = f"{'ABCD'[k]} − A"
        assert name in browser.find("#formed-difference .caption").text
        assert browser.find("#legend-difference .legend-title").text.startswith(f"{name}: ")
        shown = browser.js("return plyform_report.differences.map((d) => "
                           "Math.max(...d.values.map(Math.abs)))")
        largest = largest_differences(folders[k], folders[0])
        assert abs(np.array(shown) - largest).max() < 0.006 and max(largest) > 0.1, (shown, largest)
        pictures.add(browser.picture())
    assert len(pictures) == len(folders) - 1


def check_texts_of_each(browser, folders):
    """Answers, curves and tables of every run, under its letter; a click shows the run's place."""
    count = len(folders)
    assert len(browser.driver.find_elements("css selector", "section.answers")) == count
    assert len(browser.driver.find_elements("css selector", "section.tables")) == count
    titles = [title.text for title in browser.driver.find_elements("css selector", "h1")]
    assert len(set(titles)) == count and all(f"({folder.name})" in title
                                             for folder, title in zip(folders, titles)), titles
    legend = browser.find(".legend-of-lines").text
    for r, folder in enumerate(folders):
        assert f"{'ABCD'[r]}: " in legend, legend
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        most = max(ply["max_shear_deg"] for ply in summary["plies"])
        answers = browser.driver.find_elements("css selector", "section.answers")[r]
        assert answers.find_element("css selector", ".figure").text == f"{most:.1f}°"
        browser.js("arguments[0].click()", answers.find_element("css selector", "button.place"))
        browser.settle()
        assert browser.js("return plyform_report.probe.run") == r
        assert abs(told(browser)[2]["shear"] - most) < 0.003
    marks = browser.js("return ['circle.mark', 'rect.mark'].map((kind) => "
                       "document.querySelectorAll(`.charts figure svg ${kind}`).length > 0)")
    assert marks == [count > 2, count > 3], marks


def check_more(folder):
    """Three and four runs beside each other; five are refused."""
    folders = [run(folder / "a"), run(folder / "b", "contact.friction=0.4"),
               run(folder / "c", "contact.friction=0.1"), run(folder / "d", "ply.0.angle=45")]
    for count in (3, 4):
        path = report(folder / f"{count}.html", *folders[:count])
        with Browser() as browser:
            browser.open(path)
            check_room(browser, count)
            check_texts_of_each(browser, folders[:count])
            check_each_difference(browser, folders[:count])
            check_room(browser, count + 1)
            browser.js("window.dispatchEvent(new Event('beforeprint'))")
            captions = browser.js("return [...document.querySelectorAll('#prints figcaption')]"
                                  ".map((one) => one.textContent)")
            assert len(captions) == 3 * (count + 1), captions
            assert sum(one.startswith("C: ") for one in captions) == 3, captions
            assert sum(one.startswith(f"{'ABCD'[count - 1]} − A") for one in captions) == 3, captions
            check_quiet(browser, path)
    done = subprocess.run([PROGRAM, "report", *folders, folders[0]], capture_output=True, text=True,
                          check=False)
    assert done.returncode == 2 and "up to 4" in done.stderr, done


def main():
    with tempfile.TemporaryDirectory() as name:
        {"one": check_one, "two": check_two, "more": check_more}[sys.argv[1]](Path(name))


main()
