# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel of results of the workbench, by clicks in Chromium: runs are chosen, shown by their report,
compared over a key, saved; and what a hostile folder of a run can do: nothing.

    studio_results_test.py PART TOOLS PROGRAM CASES      PART: clicks, safe
"""

import csv
import io
import json
import os
import re
import shutil
import sys
import tempfile
from pathlib import Path

from studio_server import Server
from studio_three_runs import RUNS, ResultsPage as Page, downloaded, made, summary_of

TOOLS, PROGRAM, CASES = (Path(argument).resolve() for argument in sys.argv[2:5])
TITLE = "(document.getElementById('report-frame') || {title: ''}).title"  # of the report shown
LABEL = "document.querySelector('#figures-chart svg').getAttribute('aria-label')"


def check_list(page):
    page.open("#results")
    page.when("return document.querySelectorAll('#results-list input').length === 3")
    listed = page.js("return [...document.querySelectorAll('#results-list input')].map((box) => box.dataset.folder)")
    assert listed == ["results/c", "results/b", "results/a"], listed  # the newest first
    words = page.texts("#results-list li")[0]
    assert "largest shear" in words and "force of punch" in words and "°" in words, words
    page.type("#results-filter", "ults/b")
    page.when("return document.querySelectorAll('#results-list input').length === 1")
    page.type("#results-filter", "")
    page.when("return document.querySelectorAll('#results-list input').length === 3")
    page.until(lambda: "Choose a run" in page.text("#report-words"), "it says what to do")


def check_report(page, folder):
    page.press(page.run("results/a"))
    page.into_report()
    most = max(ply["max_shear_deg"] for ply in summary_of(folder, "a")["plies"])
    assert page.text(".cards .figure") == f"{most:.1f}°"
    draw = "plyform_report.stage.draw(); return document.getElementById('canvas').toDataURL()"
    before = page.js(draw)
    page.js("document.getElementById('view-top').click()")
    page.until(lambda: page.js(draw) != before, "it is turned")
    page.out()
    page.press(page.run("results/b"))
    page.shown("report 2")
    page.when(f"return {TITLE}.includes(',')")
    titles = page.titles()
    assert len(titles) == 2 and "(a)" in titles[0] and "(b)" in titles[1], titles
    page.until(lambda: page.texts("#results-list .letter") == ["", "B", "A"], "letters tell which is which")
    key = page.js("return document.getElementById('report-frame').src").rpartition("/")[2]
    page.driver.refresh()
    assert page.titles() == titles  # the address says it all
    assert page.js("return document.getElementById('report-frame').src").endswith(key)  # not made again
    answer = page.server.send("api/results/report", {"folders": ["results/a", "results/b"]})
    assert answer == {"key": key, "ready": True, "process": None}, answer
    path = folder / "results/b/summary.json"
    path.write_text(path.read_text(encoding="utf-8") + "\n", encoding="utf-8")
    answer = page.server.send("api/results/report", {"folders": ["results/a", "results/b"]})
    assert answer["key"] != key and not answer["ready"]
    page.press(page.run("results/c"))
    page.shown("report 3")
    page.when(f"return {TITLE}.split(',').length === 3")
    assert len(page.titles()) == 3


def check_saved(page, downloads):
    """The report shown, in a tab of its own and as a file, is what the frame has; then none is chosen."""
    key = page.js("return document.getElementById('report-frame').src").rpartition("/")[2]
    page.press("#report-file")
    saved = downloaded(downloads, "a_b_c_report.html")
    assert saved == page.server.call("GET", f"api/results/report/{key}")[1] and saved.startswith(b"<!")
    titles, here = page.titles(), page.driver.current_window_handle
    page.press("#report-alone")
    page.until(lambda: len(page.driver.window_handles) == 2, "a tab is opened")
    page.driver.switch_to.window(next(one for one in page.driver.window_handles if one != here))
    page.when("return document.documentElement.dataset.ready")
    assert [one.text for one in page.all("h1")] == titles
    assert page.js("return window.opener === null && self.origin === 'null'")  # as in the frame: no way back
    page.driver.close()
    page.driver.switch_to.window(here)
    page.press("#results-none")
    page.shown("report 0")
    page.until(lambda: not page.all("#results-list input:checked") and not page.all("#report-frame") and
               "Choose a run" in page.text("#report-words"), "none is chosen")


def check_tabs(page):
    """What is chosen stays, from view to view, and when another panel was looked at."""
    page.open("#results/report/results%2Fa|results%2Fb")
    for view in ("files", "differences", "report", "figures"):
        page.press(f"#results-{view}")
        page.shown(f"{view} 2")
        shown = page.js("return [...document.querySelectorAll('.results-main > section')].filter((s) => !s.hidden)"
                        ".map((s) => s.className)")
        assert shown == [f"results-{view}"], shown
    for panel in ("setup", "runs", "studies", "identify", "results"):
        page.press(f"#panels a[href='#{panel}']")
        page.when(f"return !document.getElementById('panel-{panel}').hidden")
        page.until(lambda one=panel: page.texts("#panels [aria-selected=true]") == [
            page.text(f"#panels a[href='#{one}']")] and len(page.all("main > section:not([hidden])")) == 1,
            f"{panel} alone is shown")
    page.when("return location.hash === '#results/figures/results%2Fa|results%2Fb'")
    page.until(lambda: len(page.all("#results-list input:checked")) == 2, "both are chosen still")


def check_unfinished(page, folder):
    """Of a run that goes on, or was killed: as far as it is, and made anew when there is more."""
    place = folder / "results/d"
    place.mkdir()
    shutil.copy(folder / "results/a/results.h5", place)
    page.open("#results/report/results%2Fd")
    page.into_report()
    assert "Not finished" in page.text(".verdict")
    page.out()
    page.until(lambda: "As far as" in page.text("#report-words") and page.find("#report-anew").is_displayed(),
               "it is told, and can be made anew")
    first = page.js("return document.getElementById('report-frame').src")
    shutil.copy(folder / "results/b/results.h5", place / "new")
    os.replace(place / "new", place / "results.h5")
    page.server.get("api/results")
    page.js("window.dispatchEvent(new Event('hashchange'))")
    page.when("return document.getElementById('report-words').textContent.includes('More has been written')")
    page.press("#report-anew")
    page.when(f"return ![undefined, '{first}'].includes((document.getElementById('report-frame') || {{}}).src)")
    page.into_report()
    page.out()
    shutil.rmtree(place)


def check_figures(page, folder, downloads):
    """Over the key in which the cases differ; the CSV has the numbers of the summaries."""
    path = folder / "results/b/summary.json"
    summary = json.loads(path.read_text(encoding="utf-8"))
    force = next(tool["force_N"] for tool in summary["tools"] if tool["name"] == "punch")
    summary["verification"] = {"figures": [{"name": "force of punch", "unit": "N", "value": force, "band": 7.5}]}
    path.write_text(json.dumps(summary), encoding="utf-8")
    page.open("#results")
    page.when("return document.querySelectorAll('#results-list input').length === 3")
    page.press("#results-all")
    page.shown("report 3")
    page.press("#results-figures")
    page.shown("figures 3")
    page.when("return document.querySelectorAll('#figures-chart circle.point').length === 3")
    page.when(f"return {LABEL}.includes('over run')")
    page.pick("#figures-figure", "force of punch")
    page.pick("#figures-over", "contact.friction")
    page.when(f"return {LABEL}.includes('force of punch') && {LABEL}.includes('over contact.friction')")
    points = page.texts("#figures-chart circle.point title")
    forces = {name: next(tool["force_N"] for tool in summary_of(folder, name)["tools"] if tool["name"] == "punch")
              for name in RUNS}
    assert len(points) == 3 and {point.partition(":")[0] for point in points} == {f"results/{name}" for name in RUNS}
    for name, friction in (("a", "0.2"), ("b", "0.4"), ("c", "0.3")):
        point = next(one for one in points if one.startswith(f"results/{name}:"))
        numbers = [float(one) for one in re.findall(r"-?\d+\.?\d*", point.partition(":")[2])]
        assert abs(numbers[0] - float(friction)) < 1e-9 and abs(numbers[1] - forces[name]) < 0.6, point
    assert len(page.all("#figures-chart polyline")) == 1  # the band of b
    assert len(page.all("#figures-table tbody tr")) == 3
    page.pick("#figures-over", "ply.ply1.angle")
    page.when(f"return {LABEL}.includes('ply.ply1.angle')")
    page.press("#figures-csv")
    rows = list(csv.DictReader(io.StringIO(downloaded(downloads, "runs.csv").decode())))
    order = sorted(RUNS, key=lambda name: (folder / "results" / name / "summary.json").stat().st_mtime)
    assert [row["run"] for row in rows] == [f"results/{name}" for name in order], rows  # by their age
    for row, name in zip(rows, order):
        summary = summary_of(folder, name)
        assert float(row["force of punch, N"]) == forces[name]
        for ply in summary["plies"]:
            assert float(row[f"largest shear of {ply['name']}, °"]) == ply["max_shear_deg"]
        assert float(row["time, s"]) == summary["wall_time_s"]
    assert [row["band of force of punch, N"] for row in rows] == [{"b": "7.5"}.get(name, "") for name in order]
    assert [row["contact.friction"] for row in rows] == [RUNS[name][0].partition("=")[2] for name in order]
    page.press("#figures-chart circle.point")  # a point leads to its run
    page.shown("report 1")


def check_differences(page, folder):
    page.open("#results/differences/results%2Fa|results%2Fc")
    page.shown("differences 2")
    rows = page.until(lambda: page.rows("#differences-keys tbody tr"), "what differs")
    assert sorted(rows) == [["contact.friction", "0.2", "0.3"], ["ply.ply1.angle", "0", "45"]], rows
    figures = {name: cells for name, *cells in page.rows("#differences-figures tbody tr")}
    first, other = ({tool["name"]: tool["force_N"] for tool in summary_of(folder, name)["tools"]} for name in "ac")
    number, unit = figures["force of punch"][2].replace(",", "").split()
    assert unit == "N", figures["force of punch"]
    shown = float(number)
    assert abs(shown - (other["punch"] - first["punch"])) < 0.6, (figures["force of punch"], first, other)
    page.open("#results/differences/results%2Fa|results%2Fa")
    page.when("return document.getElementById('differences-words').textContent.includes('give the same')")


def check_clicks(folder):
    downloads = folder / "downloads"
    downloads.mkdir()
    with Server(TOOLS, PROGRAM, folder / "folder") as server, Page(server) as page:
        made(server.folder, PROGRAM, CASES)
        page.driver.execute_cdp_cmd("Browser.setDownloadBehavior", {
            "behavior": "allow", "downloadPath": str(downloads)})
        check_list(page)
        check_report(page, server.folder)
        check_saved(page, downloads)
        check_tabs(page)
        check_unfinished(page, server.folder)
        check_figures(page, server.folder, downloads)
        check_differences(page, server.folder)
        others = [url for url in page.requests() if not url.startswith((server.origin, "data:", "blob:", "about:"))]
        assert not others, others


EVIL = '</script><script>window.evil = 1</script><img src=x onerror="window.evil = 2">'
HOSTILE_NAME = "<img src=x onerror='window.evil = 3'>&\"quoted\""
TRIES = {  # of a script in a report, what it would like to do; each gives a word
    "fetch": "fetch('../../results').then((r) => 'GOT ' + r.status, () => 'no')",
    "post": "fetch('../../results/report', {method: 'POST', body: '{}'}).then((r) => 'GOT ' + r.status, () => 'no')",
    "socket": "new Promise((go) => { try { const s = new WebSocket(location.href.replace('http:', 'ws:')"
              ".replace(/api.*/, 'events')); s.onopen = () => go('GOT'); s.onerror = () => go('no'); }"
              " catch (e) { go('no'); } })",
    "image": "new Promise((go) => { const i = new Image(); i.onload = () => go('GOT'); i.onerror = () => go('no');"
             " i.src = '../../../lib/three.min.js'; })",
    "parent": "Promise.resolve().then(() => parent.document.title).then(() => 'GOT', () => 'no')",
    "storage": "Promise.resolve().then(() => localStorage.length).then(() => 'GOT', () => 'no')",
    "module": "import('../../../web/page/server.js').then(() => 'GOT', () => 'no')",
}


def check_frame(page):
    """A script in the frame gets nothing of the server: by the frame, by its header, by the guard."""
    sandbox = page.js("return document.getElementById('report-frame').getAttribute('sandbox')").split()
    assert "allow-scripts" in sandbox and not {"allow-same-origin", "allow-top-navigation", "allow-forms",
                                               "allow-popups"} & set(sandbox), sandbox
    page.into_report()
    assert page.js("return self.origin") == "null"
    for name, attempt in TRIES.items():
        got = page.driver.execute_async_script(
            f"const done = arguments[0]; Promise.resolve({attempt}).then(done, (e) => done('no')); "
            "setTimeout(() => done('no answer'), 8000)")
        print(f"  {name:8} {got}")
        assert got in ("no", "no answer"), (name, got)
    page.out()
    page.js("document.getElementById('report-frame').addEventListener('load', () => { window.gone_there = true; })")
    page.into_report()
    page.js("setTimeout(() => { location.href = '../../results'; }, 0)")  # goes there itself
    page.out()
    page.when("return window.gone_there")

    def what_it_got():
        page.out()
        page.driver.switch_to.frame("report-frame")
        return [page.js("return document.documentElement.textContent")]
    text, = page.until(what_it_got, "it has gone there")
    assert "results/" not in text and "figures" not in text, text[:300]
    page.out()
    for method, path in (("GET", "api/results"), ("POST", "api/results/report"), ("GET", "api/folder")):
        status, _ = page.server.call(method, path, body={}, headers={"Origin": "null", "Content-Type": "text/plain"})
        assert status == 403, (method, path, status)
    status, _ = page.server.call("GET", "api/results", headers={"Sec-Fetch-Site": "cross-site"})
    assert status == 403


def check_hostile_runs(page, folder):
    """Names and titles are texts wherever they stand."""
    place = folder / "results" / HOSTILE_NAME
    shutil.copytree(folder / "results/a", place)
    summary = json.loads((place / "summary.json").read_text(encoding="utf-8"))
    summary["title"], summary["message"] = EVIL, EVIL
    summary["case"]["contact.friction"] = EVIL
    (place / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
    page.open("#results")
    page.when("return document.querySelectorAll('#results-list input').length === 4")
    for count, name in enumerate((HOSTILE_NAME, "a"), 1):
        page.press(page.run(f"results/{name}"))
        page.shown(f"report {count}")
    page.when(f"return {TITLE}.includes(',')")
    titles = page.titles()
    assert len(titles) == 2 and any(EVIL in title for title in titles), titles
    page.into_report()
    assert page.js("return window.evil === undefined && !document.querySelector('img[onerror]')")
    page.out()
    check_frame(page)
    for tab, there in (("figures", "#figures-table td"), ("differences", "#differences-keys td"), ("files", "#exports-files td")):
        page.press(f"#results-{tab}")
        page.when(f"return document.querySelector('{there}')")
    assert page.js("return window.evil === undefined && !document.querySelector('img')")
    shutil.rmtree(place)


def check_files(server, folder):
    """Nothing outside of a run's folder, nothing shown as a page."""
    (folder.parent / "outside.txt").write_text("secret", encoding="ascii")
    run = folder / "results/a"
    (run / "page.html").write_text("<script>fetch('../api/folder')</script>", encoding="ascii")
    (run / "link.txt").symlink_to(folder.parent / "outside.txt")
    (folder / "results/out").symlink_to(folder.parent)
    tries = [("results/a", "../b/summary.json"), ("results/a", "../../trim.csv"), ("results/a", "/etc/passwd"),
             ("results/a", "link.txt"), ("results/out", "outside.txt"), ("..", "outside.txt"), ("results/a", ""),
             ("results/a", "."), (".plyform", "lock"), ("results/a", "plies"), ("results/a", "a\0b"),
             ("results/a", "%2e%2e/b/summary.json"), ("results/a", "..\\b"), ("", "trim.csv")]
    for room, name in tries:
        for route in ("file", "drawing"):
            status, content = server.call("GET", f"api/results/{route}", query={"folder": room, "name": name})
            print(f"  {route:8} {room!r:14} {name!r:28} {status} {content['error'] if isinstance(content, dict) else ''}")
            assert status in (403, 404, 422) and "secret" not in str(content), (room, name, status)
    names = [one["name"] for one in server.get("api/results/files", folder="results/a")]
    assert "page.html" in names and "link.txt" not in names
    status, heads = heads_of(server, "api/results/file?folder=results/a&name=page.html")
    assert status == 200 and heads["content-disposition"].startswith("attachment;"), heads
    assert heads["content-type"] == "application/octet-stream" and heads["x-content-type-options"] == "nosniff"
    assert heads["content-security-policy"].startswith("sandbox;"), heads
    for key in ("..%2F..%2Flock", "lock", "a" * 32, "..", "A" * 32):
        status, _ = server.call("GET", f"api/results/report/{key}")
        assert status == 404, (key, status)
    (run / "link.txt").unlink()
    (folder / "results/out").unlink()


def heads_of(server, path):
    from http.client import HTTPConnection
    connection = HTTPConnection("127.0.0.1", server.port, timeout=30)
    connection.request("GET", f"/{server.token}/{path}")
    answer = connection.getresponse()
    answer.read()
    connection.close()
    return answer.status, {name.lower(): value for name, value in answer.getheaders()}


def check_commands(server, folder):
    """What is asked of a command is of its lists; what it reads and writes lies in the folder."""
    refused = [
        {"what": "export", "folder": "results/a", "formats": ["vtu", "--help"]},
        {"what": "export", "folder": "results/a", "formats": "vtu"},
        {"what": "export", "folder": "results/a", "formats": ["vtu"], "frame": "0 --format stl"},
        {"what": "export", "folder": "results/a", "formats": ["vtu"], "frame": -1},
        {"what": "run", "folder": "results/a"}, {"what": "export", "folder": "../x", "formats": ["vtu"]},
        {"what": "export", "folder": "results", "formats": ["vtu"]},
        {"what": "map", "folder": "results/a", "formats": ["csv"], "part": "../part.inp"},
        {"what": "map", "folder": "results/a", "formats": ["csv"], "part": "trim.csv"},
        {"what": "map", "folder": "results/a", "formats": ["csv"], "reference": "--onto"},
        {"what": "pattern", "folder": "results/a", "trim": "outside.csv"},
        {"what": "pattern", "folder": "results/a", "trim": "trim.csv", "mirror": ["x", "--case"]},
        {"what": "pattern", "folder": "results/a", "trim": "trim.csv", "case": "/etc/passwd"}]
    (folder / "outside.csv").symlink_to(folder.parent / "outside.txt")
    for wish in refused:
        status, answer = server.call("POST", "api/results/export", wish)
        print(f"  {json.dumps(wish)[:90]:90} {status} {answer['error'][:60]}")
        assert status in (403, 404, 422), (wish, status, answer)
    elsewhere = folder.parent / "elsewhere"
    elsewhere.mkdir()
    (folder / "results/a/export").symlink_to(elsewhere)
    status, answer = server.call("POST", "api/results/export",
                                 {"what": "export", "folder": "results/a", "formats": ["vtu"]})
    assert status == 403 and not any(elsewhere.iterdir()), answer
    (folder / "results/a/export").unlink()
    for body in ({"folders": []}, {"folders": ["results/a"] * 5}, {"folders": "results/a"}, {"folders": ["../x"]},
                 {"folders": ["results/b", "results"]}, {"folders": [1]}, {}):
        status, _ = server.call("POST", "api/results/report", body)
        assert status in (403, 404, 409, 422), (body, status)
    assert not server.get("api/processes", kind="export")


def check_links(server, folder):
    """Results that are links to what lies elsewhere are not read."""
    place = folder / "results/linked"
    shutil.copytree(folder / "results/a", place)
    outside = folder.parent / "summary.json"
    shutil.move(place / "summary.json", outside)
    (place / "summary.json").symlink_to(outside)
    run = next(one for one in server.get("api/results") if one["folder"] == "results/linked")
    assert run["status"] == "damaged" and "link" in run["message"] and not run["figures"], run
    status, answer = server.call("POST", "api/results/report", {"folders": ["results/linked"]})
    assert status == 403 and "link" in answer["error"], answer
    shutil.rmtree(place)


def check_safe(folder):
    with Server(TOOLS, PROGRAM, folder / "folder") as server, Page(server) as page:
        made(server.folder, PROGRAM, CASES)
        check_files(server, server.folder)
        check_commands(server, server.folder)
        check_links(server, server.folder)
        check_hostile_runs(page, server.folder)


def main():
    with tempfile.TemporaryDirectory() as name:
        {"clicks": check_clicks, "safe": check_safe}[sys.argv[1]](Path(name))


main()
