# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of a run in the workbench, by clicks in Chromium: exported, mapped onto a part, cut patterns, saved.
Each choice of the three forms is made, and what lies in the folder shows that it was heard.

    studio_exports_test.py TOOLS PROGRAM CASES

Leaves with 77 when Chromium, its driver, selenium, FastAPI, NumPy or ezdxf is missing.
"""

import csv
import math
import shutil
import sys
import tempfile
from pathlib import Path

from studio_server import Server
from studio_three_runs import ResultsPage, downloaded, made

try:
    import ezdxf
    import numpy as np
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)

TOOLS, PROGRAM, CASES = (Path(argument).resolve() for argument in sys.argv[1:4])
SCALE, TURN, MOVE = 1000.0, (30.0, -20.0, 100.0), (5.0, -3.0, 12.0)  # of the part mesh
LAYUPS = ("csv", "vtu", "infusion", "abaqus", "calculix", "lsdyna", "optistruct", "openradioss", "acp", "h5")


class Page(ResultsPage):
    def only(self, form, *words):
        """Ticks these formats, and no other."""
        boxes = self.when("return [...document.querySelectorAll(arguments[0])].map((box) => "
                          "[box.id, box.value, box.checked])",
                          f"#{form}-form fieldset:not(:has(#{form}-mirror-x)) input")
        assert set(words) <= {value for _, value, _ in boxes}, boxes
        for name, value, on in boxes:
            if on != (value in words):
                self.press(f"#{name}")

    def go_on(self, form, well=True):
        """Presses the button of a form; what it says when its process has ended."""
        words = f"document.getElementById('{form}-words')"
        self.js(f"{words}.textContent = ''; {words}.classList.remove('bad')")  # of the time before
        self.press(f"#{form}-go")
        self.when(f"return {words}.textContent.startsWith('Done.') || {words}.classList.contains('bad')")
        assert self.js(f"return {words}.classList.contains('bad')") != well, self.text(f"#{form}-words")
        return self.text(f"#{form}-words")

    def refused(self, form, words):
        """Presses the button of a form, with what the server does not take."""
        self.js("document.getElementById('trouble').textContent = ''")
        self.press(f"#{form}-go")
        self.until(lambda: words in self.text("#trouble"), words)

    def command(self, form):
        return self.text(f"#{form}-form .command")


def names(place):
    return {path.name for path in place.iterdir()}


def check_runs(page):
    """Files of the run chosen in the list of this view."""
    page.open("#results/differences/results%2Fa|results%2Fc")
    page.press("#results-files")
    page.when("return document.querySelectorAll('#exports-files tr').length > 3")
    page.when("return document.getElementById('exports-run').value === 'results/a'")
    page.pick("#exports-run", "results/c")
    page.when("return document.querySelector('#exports-files a').href.includes('folder=results%2Fc')")
    page.pick("#exports-run", "results/a")
    page.when("return document.querySelector('#exports-files a').href.includes('folder=results%2Fa')")


def check_states(page, run):
    page.only("export")
    page.refused("export", "formats: one or more of")
    page.only("export", "gltf")
    page.go_on("export")
    assert names(run / "export") == {"state.glb"}, names(run / "export")
    assert " export " in page.command("export")
    page.only("export", "vtu", "stl", "csv", "vtkhdf")
    page.type("#export-frame", "some")
    page.refused("export", "frame: a number")
    page.type("#export-frame", "1")
    page.go_on("export")
    made_ = names(run / "export") - {"state.glb"}
    assert {f"ply{k}_000001.{kind}" for k in (1, 2) for kind in ("vtu", "stl", "csv", "vtkhdf")} <= made_, made_
    assert all("_000001." in name for name in made_), made_
    page.only("export", "stl")
    page.type("#export-frame", "all")
    page.go_on("export")
    assert {f"ply1_00000{k}.stl" for k in range(5)} <= names(run / "export")


def layup(file):
    """Columns of a table of elements."""
    lines = [line for line in file.read_text(encoding="ascii").splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    return {key: np.array([float(row[key] or "nan") for row in rows]) for key in rows[0]}


def inverse(x):
    """What scaled, turned about x, y and z, and moved gives x."""
    x = x - np.array(MOVE)
    for axis in (2, 1, 0):
        angle = math.radians(-TURN[axis])
        i, j = (axis + 1) % 3, (axis + 2) % 3
        turned = x.copy()
        turned[:, i] = math.cos(angle) * x[:, i] - math.sin(angle) * x[:, j]
        turned[:, j] = math.sin(angle) * x[:, i] + math.cos(angle) * x[:, j]
        x = turned
    return x / SCALE


def part_of(file):
    """The formed ply of a written lay-up as a part mesh in m, that lies elsewhere."""
    lines = file.read_text(encoding="ascii").splitlines()
    at = lines.index("*NODE") + 1
    end = next(i for i in range(at, len(lines)) if lines[i].startswith("*"))
    last = next(i for i in range(end + 1, len(lines)) if lines[i].startswith("*"))
    nodes = inverse(np.array([[float(one) for one in line.split(",")[1:]] for line in lines[at:end]]))
    rows = [f"{i + 1}, {x:.12g}, {y:.12g}, {z:.12g}" for i, (x, y, z) in enumerate(nodes)]
    return "\n".join(["*NODE", *rows, *lines[end:last]]) + "\n"


def check_layups(page, folder, run):
    page.only("map")
    page.refused("map", "formats: one or more of")
    page.only("map", *LAYUPS)
    page.press("#map-two")
    page.pick("#map-reference", "y")
    page.go_on("map")
    found = names(run / "map")
    kinds = ("ply1_warp.csv", "ply1_weft.csv", "ply1_warp_layup.vtu", "ply1_warp_layup.inp", "ply1_warp_layup.k",
             "ply1_warp_layup_calculix.inp", "ply1_warp_drape.fem", "ply1_warp_drape_0000.inc", "acp_ply1_warp.csv",
             "ply1_warp_layup.h5", "ply1_warp_infusion.csv", "ply1_warp_infusion_layers.csv")
    assert set(kinds) <= found, set(kinds) - found
    own = layup(run / "map/ply1_warp.csv")
    assert "global y projected" in (run / "map/ply1_warp.csv").read_text(encoding="ascii")
    # the same ply as a part, in m and elsewhere: scaled, turned and moved, it lies upon itself
    (folder / "part.inp").write_text(part_of(run / "map/ply1_warp_layup.inp"), encoding="ascii")
    page.press("#results-differences")
    page.press("#results-files")
    page.pick("#map-part", "part.inp")
    page.only("map", "csv")
    page.type("#map-scale", f"{SCALE:g}")
    for axis, turn, move in zip("xyz", TURN, MOVE):
        page.type(f"#map-turn-{axis}", f"{turn:g}")
        page.type(f"#map-move-{axis}", f"{move:g}")
    page.go_on("map")
    onto = layup(run / "map/ply1_warp.csv")
    assert len(onto["element"]) == len(own["element"]) and (onto["covered_share"] == 1.0).all()
    assert onto["distance_mm"].max() < 1e-3, onto["distance_mm"].max()
    # an earlier state, on the plies' own meshes, each ply as one
    shutil.rmtree(run / "map")
    page.pick("#map-part", "")
    page.press("#map-two")
    page.type("#map-frame", "0")
    page.go_on("map")
    assert names(run / "map") == {"ply1.csv", "ply2.csv"}, names(run / "map")
    flat = layup(run / "map/ply1.csv")
    assert np.abs(flat["shear_angle_deg"]).max() < 0.1 < 10.0 < np.abs(own["shear_angle_deg"]).max()
    for axis in "xy":  # the whole was modelled: there is nothing to mirror
        page.press(f"#map-mirror-{axis}")
        assert f"both sides of {axis} = 0" in page.go_on("map", well=False)
        page.press(f"#map-mirror-{axis}")


def outline_of(file):
    """Corners of the cut in a drawing."""
    line = next(iter(ezdxf.readfile(file).modelspace().query('LWPOLYLINE[layer=="CUT"]')))
    return np.array([(x, y) for x, y, *_ in line.get_points()])


def box_of(points):
    return np.concatenate([points.min(axis=0), points.max(axis=0)])


def check_drawing(page, run):
    page.press("[data-name='pattern/ply1.dxf'] button")
    page.when("return document.querySelectorAll('#exports-drawing polyline').length === 2")
    drawn = page.js("const b = document.querySelector('#exports-drawing polyline[data-layer=CUT]').getBBox();"
                    "return [b.x, -b.y - b.height, b.x + b.width, -b.y]")
    there = box_of(outline_of(run / "pattern/ply1.dxf"))
    assert np.abs(np.array(drawn) - there).max() < 1e-2, (drawn, there)
    assert "ply1" in page.text("#exports-drawing text")


def check_patterns(page, folder, run):
    page.refused("pattern", "choose a trim line")  # no trim line
    page.pick("#pattern-trim", "trim.csv")
    assert "saved" in page.go_on("pattern")
    page.when("return document.querySelector('[data-name=\"pattern/ply1.dxf\"] button')")
    check_drawing(page, run)
    last = box_of(outline_of(run / "pattern/ply1.dxf"))
    page.press("#pattern-space")
    assert "needs x, y and z" in page.go_on("pattern", well=False)  # the line is plane
    page.pick("#pattern-trim", "trim_space.csv")
    page.go_on("pattern")
    apart = np.abs(box_of(outline_of(run / "pattern/ply1.dxf")) - last).max()
    assert 0.0 < apart < 3.0, apart  # the same circle, at the height of the flange
    page.press("#pattern-space")
    page.pick("#pattern-trim", "trim.csv")
    for axis in "xy":
        page.press(f"#pattern-mirror-{axis}")
        assert f"both sides of {axis} = 0" in page.go_on("pattern", well=False)
        page.press(f"#pattern-mirror-{axis}")
    page.type("#pattern-frame", "0")
    page.go_on("pattern")
    flat = box_of(outline_of(run / "pattern/ply1.dxf"))
    assert np.abs(np.abs(flat) - 110.0).max() < 0.5, flat  # nothing is formed yet: the trim line itself
    page.type("#pattern-frame", "")
    # corrected by runs: as many as are allowed, with a tolerance that none keeps; then one that is wide
    page.pick("#pattern-trim", "trim_small.csv")
    page.pick("#pattern-case", "cases/hemisphere_two_ply/coarse.toml")
    page.type("#pattern-tolerance", "0.01")
    page.type("#pattern-iterations", "2")
    said = page.go_on("pattern", well=False)
    assert "after 2 runs the edge is still" in said, said
    assert {"iteration_1", "iteration_2"} == {path.name for path in (run / "pattern").glob("iteration_*")}
    shutil.rmtree(run / "pattern")
    page.type("#pattern-tolerance", "200")
    assert "run 1: formed edge within" in page.go_on("pattern")
    assert ["iteration_1"] == [path.name for path in (run / "pattern").glob("iteration_*")]


def check_saved(page, run, downloads):
    for name in ("pattern/ply1.dxf", "export/state.glb", "summary.json"):
        page.press(f"[data-name='{name}'] a")
        assert downloaded(downloads, name.rpartition("/")[2]) == (run / name).read_bytes()


def filled(folder):
    """Runs, their case as it was run, and trim lines."""
    made(folder, PROGRAM, CASES)
    for name in ("hemisphere_two_ply", "fabrics"):
        shutil.copytree(CASES / name, folder / "cases" / name)
    text = (CASES / "hemisphere_two_ply/case.toml").read_text(encoding="utf-8")
    for line in text.splitlines():
        key = line.partition("=")[0].strip()
        other = {"element_size": "34.0", "mesh_from": '"element_size"', "outputs": "4", "duration": "0.02"}.get(key)
        if other:
            text = text.replace(line, f"{key} = {other}")
    (folder / "cases/hemisphere_two_ply/coarse.toml").write_text(text, encoding="utf-8")
    plane = (folder / "trim.csv").read_text(encoding="ascii").split()[1:]
    (folder / "trim_space.csv").write_text("\n".join(["x,y,z", *(f"{row},0.4" for row in plane)]) + "\n",
                                           encoding="ascii")
    small = [f"{85 * math.cos(k / 10):.3f},{85 * math.sin(k / 10):.3f}" for k in range(63)]
    (folder / "trim_small.csv").write_text("\n".join(["x,y", *small]) + "\n", encoding="ascii")


def main():
    with tempfile.TemporaryDirectory() as name:
        downloads = Path(name) / "downloads"
        downloads.mkdir()
        with Server(TOOLS, PROGRAM, Path(name) / "folder") as server, Page(server) as page:
            filled(server.folder)
            page.driver.execute_cdp_cmd("Browser.setDownloadBehavior", {
                "behavior": "allow", "downloadPath": str(downloads)})
            run = server.folder / "results/a"
            check_runs(page)
            check_states(page, run)
            check_layups(page, server.folder, run)
            check_patterns(page, server.folder, run)
            check_saved(page, run, downloads)


main()
