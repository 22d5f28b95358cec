# SPDX-License-Identifier: GPL-3.0-or-later
"""A workbench for the tests: the program itself, on a folder of its own. Imported, it ends the test
with 77 when anything that the workbench needs is missing."""

import http.client
import json
import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from urllib.parse import quote, urlsplit

try:
    import fastapi  # noqa: F401
    import tomlkit  # noqa: F401
    import uvicorn  # noqa: F401
    import websockets  # noqa: F401
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)


STATE = tempfile.TemporaryDirectory()  # that of this user is left alone
os.environ["XDG_STATE_HOME"] = STATE.name


class Server:
    """Begun by `with`, ended with it; `stop` and `start` in between."""

    def __init__(self, tools: Path, program: Path, folder: Path | None = None):
        self.command = [str(tools / "studio"), "--no-browser", "--program", str(program)]
        self.kept = None if folder else tempfile.TemporaryDirectory()
        self.folder = folder or Path(self.kept.name) / "folder"
        self.process = None

    def __enter__(self):
        self.start()
        return self

    def __exit__(self, *_):
        self.stop()
        if self.kept:
            self.kept.cleanup()

    def start(self):
        self.process = subprocess.Popen([*self.command, str(self.folder)], stdout=subprocess.PIPE,
                                        text=True, env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"})
        self.process.stdout.readline()
        self.address = self.process.stdout.readline().strip()
        assert self.address.startswith("http://127.0.0.1:"), self.address
        self.port = urlsplit(self.address).port
        self.token = urlsplit(self.address).path.strip("/")

    def stop(self, how=signal.SIGINT):
        if self.process and self.process.poll() is None:
            self.process.send_signal(how)
            self.process.wait(20)
        if self.process:
            self.process.stdout.close()

    @property
    def origin(self):
        return f"http://127.0.0.1:{self.port}"

    def call(self, method, path, body=None, headers=None, token=None, query=None):
        """Status and content (JSON where it is) of a request below the token."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        if isinstance(body, (dict, list)):
            body = json.dumps(body).encode()
        words = "" if not query else "?" + "&".join(f"{k}={quote(str(v), safe='')}" for k, v in query.items())
        sent = {"Origin": self.origin, "Content-Type": "application/json"} if headers is None else headers
        connection.request(method, f"/{self.token if token is None else token}/{path}{words}", body, sent)
        answer = connection.getresponse()
        content = answer.read()
        connection.close()
        if answer.getheader("Content-Type", "").startswith("application/json"):
            content = json.loads(content)
        return answer.status, content

    def get(self, path, /, **query):
        status, content = self.call("GET", path, query=query)
        assert status == 200, (status, content)
        return content

    def send(self, path, body=None, method="POST", /, **query):
        status, content = self.call(method, path, body or {}, query=query)
        assert status == 200, (status, content)
        return content
