# SPDX-License-Identifier: GPL-3.0-or-later
"""Attempts on the workbench: studio_safety_test.py TOOLS PROGRAM. What must not be done is tried, each is
refused, and the table of them is printed. Without Chromium, those of pages of other sites are left out."""

import http.client
import http.server
import json
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from studio_server import Server  # skips

TOOLS, PROGRAM = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
CASE = "mine/case.toml"
SECRET = "the secret of another folder"
ROWS = []


def attempt(words, answer, *codes):
    """Kept for the table; the answer is a status, or (status, content)."""
    status, content = answer if isinstance(answer, tuple) else (answer, "")
    said = content.get("error", content.get("detail", "")) if isinstance(content, dict) else ""
    ROWS.append((words, status, str(said)[:90]))
    assert status in codes, (words, status, content)
    assert SECRET not in str(content), (words, content)


def head(server, **more):
    """Of a request as the page makes it, with changes; None leaves one out."""
    sent = {"Host": f"127.0.0.1:{server.port}", "Origin": server.origin, "Content-Type": "application/json", **more}
    return {name: value for name, value in sent.items() if value is not None}


def asked(server, method, path, body=b"", headers=None, token=None):
    """With the bytes of the path as they are."""
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=60)
    connection.putrequest(method, f"/{server.token if token is None else token}/{path}", skip_host=True,
                          skip_accept_encoding=True)
    for name, value in (headers or head(server)).items():
        connection.putheader(name, value)
    connection.putheader("Content-Length", str(len(body)))
    connection.endheaders(body)
    answer = connection.getresponse()
    content = answer.read()
    connection.close()
    return answer.status, {"error": content.decode("utf-8", "replace")}


def who_asks(server):
    other = "http://elsewhere.example"
    attempt("no token", asked(server, "GET", "api/folder", token=""), 403)
    attempt("a wrong token", asked(server, "GET", "api/folder", token="A" * 32), 403)
    attempt("most of the token", asked(server, "GET", "api/folder", token=server.token[:-1]), 403)
    tries = [asked(server, "GET", "api/folder", token=f"guess{k}")[0] for k in range(200)]
    attempt("200 guesses of the token", max(set(tries), key=tries.count) if len(set(tries)) == 1 else 0, 403)
    for name in ("Origin", "Host"):
        attempt(f"another {name}", asked(server, "GET", "api/folder", headers=head(server, **{name: other})), 403)
    attempt("Origin null, of a file or a sandbox", asked(server, "GET", "api/folder", headers=head(server, Origin="null")), 403)
    attempt("Origin of another port", asked(server, "GET", "api/folder", headers=head(
        server, Origin=f"http://127.0.0.1:{server.port % 65535 + 1}")), 403)
    attempt("a name that points here (DNS rebinding)", asked(server, "GET", "api/folder", headers=head(
        server, Host=f"rebound.example:{server.port}", Origin=None)), 403)
    attempt("POST without an Origin", asked(server, "POST", "api/cases", b'{"name":"x"}', head(server, Origin=None)), 403)
    attempt("Sec-Fetch-Site: cross-site", asked(server, "GET", "api/folder", headers=head(
        server, Origin=None, **{"Sec-Fetch-Site": "cross-site"})), 403)
    attempt("WebSocket of another Origin", upgraded(server, other), 403)
    attempt("WebSocket without an Origin", upgraded(server, None), 403)
    attempt("from another machine", other_address(server), 0)


def upgraded(server, origin):
    sent = head(server, Origin=origin, Connection="Upgrade", Upgrade="websocket", **{
        "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==", "Sec-WebSocket-Version": "13", "Content-Type": None})
    return asked(server, "GET", "events", headers=sent)


def other_address(server):
    """0 if no address but the loopback one is listened at."""
    lines = Path("/proc/net/tcp").read_text().splitlines()[1:]
    there = [line.split()[1].split(":")[0] for line in lines
             if line.split()[3] == "0A" and int(line.split()[1].split(":")[1], 16) == server.port]
    assert there, "not found"
    return 0 if set(there) == {"0100007F"} else 1


def paths(server, outside):
    relative = os.path.relpath(outside / "secret.toml", server.folder)
    for words, path in (("../", relative), ("../ within", f"mine/../{relative}"),
                        ("an absolute path", str(outside / "secret.toml")),
                        ("backslashes", relative.replace("/", "\\")), ("a zero byte", "mine/case.toml\0.toml"),
                        ("its own records", ".plyform/lock")):
        attempt(f"read by {words}", server.call("GET", "api/case", query={"path": path}), 403)
    for code in ("%2e%2e", "%252e%252e", ".%2e"):
        attempt(f"read by {code}", asked(server, "GET", "api/case?path=" + "/".join([code] * 3) + str(outside)
                                         .replace("/", "%2f") + "%2fsecret.toml"), 403, 404)
    attempt("a file of the server by web/../", asked(server, "GET", "web/../server/app.py"), 404)
    attempt("a file of the server by %2e%2e", asked(server, "GET", "web/%2e%2e/server/app.py"), 404)
    attempt("a file of the system by web//etc/passwd", asked(server, "GET", "web//etc/passwd"), 404)
    attempt("a picture of another folder by web//", asked(server, "GET", f"web/{outside}/picture.png"), 404)
    for folder in ("../other", str(outside), ".plyform"):
        attempt(f"upload into {folder if folder[0] != '/' else 'an absolute path'}", server.call(
            "POST", "api/upload", b"name = 1", query={"name": "a.toml", "folder": folder}), 403)
    attempt("import of a file outside", server.call("POST", "api/import", {"path": relative, "as": "fabric"}), 403)
    attempt("a case from a file outside", server.call("POST", "api/cases", {"name": "x", "from": relative}), 403)
    attempt("a run of a case outside", server.call("POST", "api/runs", {
        "case": relative, "accuracy": "", "threads": 1, "budget": 0, "verify": False, "name": "x"}), 403, 422)


def links(server, outside):
    mine = server.folder / "mine"
    (mine / "link.toml").symlink_to(outside / "secret.toml")
    (mine / "folder").symlink_to(outside)
    (server.folder / "whole").symlink_to(outside)
    for words, path in (("a link to a file", "mine/link.toml"), ("a link to a folder", "mine/folder/secret.toml")):
        attempt(f"read through {words}", server.call("GET", "api/case", query={"path": path}), 403)
        attempt(f"write through {words}", server.call("PUT", "api/case", {"text": "a = 1", "version": "0" * 16},
                                                      query={"path": path}), 403)
    attempt("upload through a link to a folder", server.call(
        "POST", "api/upload", b"x", query={"name": "new.toml", "folder": "mine/folder"}), 403)
    attempt("upload onto a link, replacing", server.call("POST", "api/upload", b"x", query={
        "name": "link.toml", "folder": "mine", "replace": 1}), 409)
    attempt("a new case where a link is", server.call("POST", "api/cases", {"name": "whole"}), 403, 409)
    listed = str(server.get("api/folder"))
    attempt("links in the list of the folder", 0 if "secret" not in listed and "link" not in listed else 1, 0)
    made_after_the_look(server, outside, mine)


def made_after_the_look(server, outside, mine):
    """Files and folders that become links after the page has seen them."""
    shutil.copy(mine / "case.toml", mine / "turned.toml")
    seen = server.get("api/case", path="mine/turned.toml")
    (mine / "turned.toml").unlink()
    (mine / "turned.toml").symlink_to(outside / "secret.toml")
    attempt("a file that has become a link, read", server.call("GET", "api/case", query={"path": "mine/turned.toml"}), 403)
    attempt("a file that has become a link, changed", server.call(
        "PUT", "api/case", {"text": seen["text"] + "#", "version": seen["version"]}, query={"path": "mine/turned.toml"}), 403)
    attempt("a file that has become a link, drawn", server.call(
        "GET", "api/scene", query={"path": "mine/turned.toml", "version": seen["version"]}), 403)
    server.send("api/cases", {"name": "moved"})
    seen = server.get("api/case", path="moved/case.toml")
    (server.folder / "moved").rename(server.folder / "moved_away")
    shutil.copy(mine / "case.toml", outside / "case.toml")
    (server.folder / "moved").symlink_to(outside)
    attempt("a folder that has become a link, changed", server.call(
        "POST", "api/case/undo", {"version": seen["version"]}, query={"path": "moved/case.toml"}), 403)
    (server.folder / "moved").unlink()
    (outside / "case.toml").unlink()
    swapped_all_the_time(server, outside, mine)


def swapped_all_the_time(server, outside, mine):
    """A file and a link change places, and the file is away for moments, while it is read, written and drawn."""
    ending, target = threading.Event(), mine / "swapped.toml"
    before = (outside / "secret.toml").read_bytes()

    def swap():
        while not ending.is_set():
            (mine / "new_link").symlink_to(outside / "secret.toml")
            os.replace(mine / "new_link", target)
            target.unlink()
            shutil.copy(mine / "case.toml", mine / "new_file")
            os.replace(mine / "new_file", target)
    thread = threading.Thread(target=swap)
    thread.start()
    leaks, codes = 0, set()
    begun = time.monotonic()
    while time.monotonic() < begun + 5 or 200 not in codes and time.monotonic() < begun + 120:
        status, content = server.call("GET", "api/case", query={"path": "mine/swapped.toml"})
        leaks += SECRET in str(content)
        codes.add(status)
        if status == 200:
            codes.add(server.call("GET", "api/scene", query={"path": "mine/swapped.toml", "draft": True,
                                                             "version": content["version"]})[0])
            status, content = server.call("PUT", "api/case", {"text": content["text"] + "#", "version": content["version"]},
                                          query={"path": "mine/swapped.toml"})
            codes.add(status)
    ending.set()
    thread.join()
    assert codes <= {200, 403, 404, 409, 422} and 200 in codes, codes
    attempt("a file and a link that change places all the time", leaks + (before != (outside / "secret.toml").read_bytes()), 0)


def sizes(server):
    ten = str(10 << 30)
    attempt("an upload of 10 GB, as Content-Length says", begun(server, "api/upload?name=big.stl", {"Content-Length": ten}, 0)[0], 413)
    attempt("a case of 10 GB, as Content-Length says", begun(server, f"api/case?path={CASE}", {"Content-Length": ten}, 0, "PUT")[0], 413)
    attempt("a Content-Length that is no number", begun(server, "api/upload?name=big.stl", {"Content-Length": "1e3"}, 0)[0], 400)
    attempt("an upload of 10 GB in chunks", begun(server, "api/upload?name=big.stl", {"Transfer-Encoding": "chunked"}, 10 << 30)[0], 413)
    attempt("a case of 10 GB in chunks", begun(server, f"api/case?path={CASE}", {"Transfer-Encoding": "chunked"}, 10 << 30, "PUT")[0], 400, 413)
    left = [path.name for path in server.folder.rglob("*") if path.stat().st_size > 1 << 20 if path.is_file()]
    attempt("what is left of them in the folder", len(left), 0)


def begun(server, path, headers, send, method="POST"):
    """Status of a request of which so many bytes are sent in chunks, or until the server closes; the bytes."""
    with socket.create_connection(("127.0.0.1", server.port), timeout=120) as plug:
        lines = [f"{method} /{server.token}/{path} HTTP/1.1", *[f"{k}: {v}" for k, v in {**head(server), **headers}.items()]]
        plug.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
        piece = b"100000\r\n" + bytes(1 << 20) + b"\r\n"
        sent = 0
        try:
            while sent < send:
                plug.sendall(piece)
                sent += 1 << 20
        except OSError:
            pass  # closed
        try:
            answer = plug.recv(1000)
        except OSError:
            answer = b""
        assert sent < 1 << 30, sent
        return (int(answer.split()[1]) if answer else 413 if 0 < sent < send else 0), sent


def names(server):
    hostile = ["<img src=x onerror=alert(1)>.stl", "a\nb.stl", "a\0.stl", "x" * 300 + ".stl", "-o.stl", ".hidden.stl",
               "../a.stl", "a/b.stl", "$(touch x).stl", "CON .stl", "é.stl", ""]
    for name in hostile:
        attempt(f"an upload named {name[:40]!r}", server.call("POST", "api/upload", b"x", query={"name": name}), 422)
    attempt("an upload of a program", server.call("POST", "api/upload", b"x", query={"name": "a.sh"}), 422)
    for name in ("<b>x</b>", "-o", "a\nb", "x" * 300, "..", ".plyform", "a/b"):
        attempt(f"a case named {name[:40]!r}", server.call("POST", "api/cases", {"name": name}), 422)
    attempt("an upload over a file that is there", twice(server), 409)
    on_disk(server)


def twice(server):
    assert server.call("POST", "api/upload", b"first", query={"name": "once.stl"})[0] == 200
    answer = server.call("POST", "api/upload", b"second", query={"name": "once.stl"})
    assert (server.folder / "once.stl").read_bytes() == b"first"
    return answer


def on_disk(server):
    """Names that another program has made: listed as texts, never taken for an option of a command."""
    for name in ("-o.stl", "--help.step", "a\nb.toml", "<script>.toml"):
        (server.folder / name).write_text("")
    assert server.call("GET", "api/folder")[0] == 200
    record = server.send("api/import", {"path": "--help.step", "as": "tool"})["process"]
    attempt("a part named --help.step as an option", 0 if record["command"][2].startswith("/") else 1, 0)
    for name in ("-o.stl", "--help.step", "a\nb.toml", "<script>.toml"):
        (server.folder / name).unlink()


def cases_that_name_files(server, outside):
    relative = os.path.relpath(outside, server.folder / "mine")
    text = (server.folder / CASE).read_text()
    mine = server.folder / "mine"
    (mine / "out.stl").symlink_to(outside / "tool.stl")
    (mine / "out").symlink_to(outside)
    fabric = (mine / "glass_plain_weave.toml").read_text()
    (mine / "sly.toml").write_text(fabric.replace("glass plain weave", str(outside / "secret.toml")))
    tool = '\n[[tool]]\nname = "t"\nshape = "mesh"\nfile = "{}"\n'
    weave = 'glass = "glass_plain_weave.toml"'
    tries = {
        "a fabric by ../": text.replace(weave, f'glass = "{relative}/secret.toml"'),
        "a fabric by an absolute path": text.replace(weave, f'glass = "{outside}/secret.toml"'),
        "a fabric by a link to a folder": text.replace(weave, 'glass = "out/secret.toml"'),
        "a fabric by .. behind a link": text.replace(weave, f'glass = "out/../{outside.name}/secret.toml"'),
        "a fabric file that names a file in a text": text.replace(weave, 'glass = "sly.toml"'),
        "a fabric in the records of the workbench": text.replace(weave, 'glass = "../.plyform/lock"'),
        "a tool by ../": text + tool.format(f"{relative}/tool.stl"),
        "a tool by a link": text + tool.format("out.stl"),
        "a tool that is a device": text + tool.format("/dev/zero"),
        "a tool by a file that is not there": text + tool.format("/nowhere/at/all.stl"),
        "a drawing of a blank by ../": text.replace("size = [200.0, 200.0]", f'outline_file = "{relative}/tool.stl"'),
        "sizes of a run outside": text.replace('mesh_from = "scene"', f'mesh_from = "{relative}"'),
        "a title that is the name of a file": text.replace('title = "mine"', f'title = "{outside}/secret.toml"'),
        "a key that is none, with the name of a file": text + f'\n[none]\nx = ["{relative}/secret.toml"]\n',
    }
    for words, tried in tries.items():
        assert tried != text, words
        (server.folder / CASE).write_text(tried)
        version = server.get("api/case", path=CASE)["version"]
        for route in ("check", "scene"):
            attempt(f"{route} of a case: {words}", server.call("GET", f"api/{route}", query={
                "path": CASE, "version": version}), 403)
    attempt("run of a case that names a file outside", server.call("POST", "api/runs", {
        "case": CASE, "accuracy": "", "threads": 1, "budget": 0, "verify": False, "name": "x"}), 403)
    (server.folder / CASE).write_text(text)


PAGE = """<!DOCTYPE html><title>another site</title><body><script>
const there = "%s", token = "%s", done = [];
const tried = (name, act) => Promise.resolve().then(act).then((v) => done.push([name, v]), (e) => done.push([name, "refused"]));
const image = (address) => new Promise((go, stop) => { const i = new Image(); i.onload = () => go("loaded");
  i.onerror = () => stop(); i.src = address; });
const socket = (address) => new Promise((go, stop) => { const s = new WebSocket(address);
  s.onopen = () => go("opened"); s.onerror = () => stop(); });
const script = (address) => new Promise((go, stop) => { const s = document.createElement("script");
  s.onload = () => go("ran"); s.onerror = () => stop(); s.src = address; document.body.append(s); });
const frame = (address) => new Promise((go) => { const f = document.createElement("iframe"); f.name = "shown";
  f.onload = () => { try { go(f.contentDocument ? "read" : "refused"); } catch (e) { go("refused"); } };
  f.src = address; document.body.append(f); });
const form = () => { const f = document.createElement("form"); f.method = "POST"; f.enctype = "text/plain";
  f.action = `${there}/${token}/api/cases`; f.target = "taken"; const i = document.createElement("input");
  i.name = '{"name":"by_a_form","x":"'; i.value = '"}'; f.append(i);
  const t = document.createElement("iframe"); t.name = "taken"; document.body.append(t, f); f.submit();
  return new Promise((go) => setTimeout(() => go("sent"), 1500)); };
Promise.all([
  tried("fetch", () => fetch(`${there}/${token}/api/folder`).then((r) => r.text())),
  tried("fetch no-cors", () => fetch(`${there}/${token}/api/folder`, { mode: "no-cors" }).then((r) => r.text()).then((t) => t || "refused")),
  tried("fetch POST", () => fetch(`${there}/${token}/api/cases`, { method: "POST", mode: "no-cors", body: '{"name":"by_fetch"}' }).then(() => "sent")),
  tried("img", () => image(`${there}/${token}/web/icon.svg`)), tried("script", () => script(`${there}/${token}/web/main.js`)),
  tried("WebSocket", () => socket(`${there.replace("http", "ws")}/${token}/events`)), tried("iframe", () => frame(`${there}/${token}/`)),
  tried("form POST", form),
]).then(() => { window.tries = done; });
</script>"""


def page_of_another_site(server):
    """With the token known, the worst case; in real Chromium."""
    if not Path("/usr/bin/chromedriver").is_file():
        print("Chromium is not installed: pages of other sites are left out")
        return
    from report_browser import Browser

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self):
            self.send_response(200)
            self.send_header("Content-Type", "text/html")
            self.end_headers()
            self.wfile.write((PAGE % (server.origin, server.token)).encode())

        def log_message(self, *_):
            pass
    site = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=site.serve_forever, daemon=True).start()
    before = sorted(server.folder.iterdir())
    with Browser() as browser:
        browser.driver.get(f"http://localhost:{site.server_address[1]}/")
        end = time.monotonic() + 30
        while (tries := browser.js("return window.tries || null")) is None and time.monotonic() < end:
            time.sleep(0.1)
        answers = [json.loads(entry["message"])["message"] for entry in browser.driver.get_log("performance")]
    images = {one["params"]["requestId"] for one in answers if one["method"] == "Network.requestWillBeSent"
              and one["params"]["request"]["url"].endswith("icon.svg")}
    codes = [one["params"]["statusCode"] for one in answers
             if one["method"] == "Network.responseReceivedExtraInfo" and one["params"]["requestId"] in images]
    site.shutdown()
    assert tries and len(tries) == 8 and codes, (tries, codes)
    attempt("a page of another site: img, as answered", codes[0], 403)  # 404 to the page itself
    for name, value in tries:
        sent = name in ("form POST", "fetch POST")  # goes out, and is refused there
        attempt(f"a page of another site: {name}", 0 if value == "refused" or sent and value == "sent" else 1, 0)
    attempt("a page of another site: what its POSTs have made", 0 if sorted(server.folder.iterdir()) == before else 1, 0)


WITH_BODY = [("POST", path) for path in (
    "identify", "cases", "studies", "study/start", "study/picture_now",
    "import", "results/differences", "results/report", "results/export", "runs")] + [
    ("PUT", f"case?path={CASE}"), ("PATCH", f"case?path={CASE}"), ("PUT", "study"), ("PUT", "study/text")]


def bodies_that_are_no_text(server):
    text = '{"name": "x", "text": "a = 1", "version": "", "edits": [], "path": "", "case": ""}'
    tries = {"bytes": b"\xff\xfe" + bytes(range(256)), "UTF-16": text.encode("utf-16"), "UTF-16 without a mark":
             text.encode("utf-16-le"), "half a character": text.replace('"x"', '"\\udc80"').encode()}
    for words, body in tries.items():
        for method, path in WITH_BODY:
            attempt(f"{method} {path.partition('?')[0]} with {words}", server.call(method, f"api/{path}", body), 400)


def table():
    wide = max(len(words) for words, _, _ in ROWS)
    for words, status, said in ROWS:
        print(f"{words:{wide}}  {status or 'nothing':>7}  {said}".rstrip().encode("ascii", "backslashreplace").decode())
    print(f"{len(ROWS)} attempts, each refused")


def main():
    with tempfile.TemporaryDirectory() as place:
        outside, folder = Path(place) / "other", Path(place) / "folder"
        outside.mkdir()
        (outside / "secret.toml").write_text(f'name = "{SECRET}"\n')
        (outside / "tool.stl").write_text(f"solid {SECRET}\nendsolid\n")
        (outside / "picture.png").write_text(SECRET)
        begin = sorted(os.walk(outside))
        with Server(TOOLS, PROGRAM, folder) as server:
            server.send("api/cases", {"name": "mine"})
            who_asks(server)
            paths(server, outside)
            links(server, outside)
            sizes(server)
            names(server)
            cases_that_name_files(server, outside)
            bodies_that_are_no_text(server)
            page_of_another_site(server)
            assert server.call("GET", "api/folder")[0] == 200  # it goes on
        assert sorted(os.walk(outside)) == begin and SECRET in (outside / "secret.toml").read_text()
        leaked = subprocess.run(["grep", "-rl", SECRET, str(folder / ".plyform")], capture_output=True, text=True, check=False)
        assert not leaked.stdout, leaked.stdout
    table()


if __name__ == "__main__":
    main()
