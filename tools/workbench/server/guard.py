# SPDX-License-Identifier: GPL-3.0-or-later
"""What a request must be before anything looks at it: of this machine and user, of the page of this server,
with the token in its path, and of bounded size. Pages of other sites have another Origin or none,
and names that are made to point here (DNS rebinding) another Host."""

import hmac
import json
import re
from urllib.parse import urlsplit

from .peer import may_ask

MOST_BODY = 4 << 20  # bytes; of uploads, which are written as they come, see uploads
MOST_UPLOAD = 512 << 20
ESCAPED = re.compile(r"\\\\|\\u[dD][89abAB]..\\u[dD][c-fC-F]..")  # a backslash, or both halves of a character
HALF = re.compile(r"\\u[dD][89a-fA-F]")
HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cache-Control": "no-store",
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
                               "img-src 'self' data: blob:; connect-src 'self'; frame-src 'self'; "
                               "frame-ancestors 'self'; base-uri 'none'; form-action 'none'",
}


class Refusal(Exception):
    def __init__(self, code: int, words: str):
        super().__init__(words)
        self.code = code


class Guard:
    """ASGI, around the application, which sees paths without the token."""

    def __init__(self, app, token: str, port: int):
        self.app = app
        self.token = token
        self.port = port
        self.hosts = {f"127.0.0.1:{port}", f"localhost:{port}"}

    async def __call__(self, scope, receive, send):
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        too_long: list[Refusal] = []
        try:
            inner = self.checked(scope)
            limited = receive if scope["type"] == "websocket" else self.bounded(inner, receive, too_long)
        except Refusal as refusal:
            await refuse(scope, receive, send, refusal)
            return
        started = False

        async def with_headers(message):
            nonlocal started
            if message["type"] == "http.response.start":
                started = True
                known = {name.lower() for name, _ in message.get("headers", [])}
                more = [(name.lower().encode(), value.encode()) for name, value in HEADERS.items()
                        if name.lower().encode() not in known]
                if too_long:  # the rest is not waited for
                    more.append((b"connection", b"close"))
                message = {**message, "headers": [*message.get("headers", []), *more]}
            await send(message)

        try:
            await self.app(inner, limited, with_headers)
        except Refusal as refusal:  # too long on the way
            if started:
                raise
            await refuse(scope, receive, send, refusal)

    def checked(self, scope) -> dict:
        headers = [(name.decode("latin-1").lower(), value.decode("latin-1"))
                   for name, value in scope["headers"]]
        def only(name: str) -> str | None:
            found = [value for key, value in headers if key == name]
            if len(found) > 1:
                raise Refusal(400, f"{name} is given twice")
            return found[0] if found else None

        if only("host") not in self.hosts:
            raise Refusal(403, "another Host than this server")
        origin, site = only("origin"), only("sec-fetch-site")
        if origin is None and (scope["type"] == "websocket" or scope["method"] not in ("GET", "HEAD")):
            raise Refusal(403, "no Origin")
        if origin is not None and (urlsplit(origin).scheme != "http"
                                   or origin.removeprefix("http://") not in self.hosts):
            raise Refusal(403, "another Origin than this server")
        if site not in (None, "same-origin", "none"):
            raise Refusal(403, "a request of another site")
        if not may_ask((scope.get("client") or ("", 0))[1], self.port):
            raise Refusal(403, "of another user of this machine")
        first, _, rest = scope["path"].removeprefix("/").partition("/")
        if not hmac.compare_digest(first.encode("utf-8", "replace"), self.token.encode()):
            raise Refusal(403, "the address has not this server's token: take the one that it printed")
        return {**{key: value for key, value in scope.items() if key != "raw_path"}, "path": "/" + rest}

    def bounded(self, scope, receive, too_long: list[Refusal]):
        """`receive` that ends a body which is longer than it may be, and says so in `too_long`."""
        most = MOST_UPLOAD if scope["path"] == "/api/upload" else MOST_BODY
        told = dict(scope["headers"]).get(b"content-length", b"0")
        if not told.isdigit() or len(told) > 15:
            raise Refusal(400, "Content-Length is no number")
        words = f"more than the {most >> 20} MiB that can be sent at once"
        if int(told) > most:
            raise Refusal(413, f"{int(told) / (1 << 20):.0f} MiB are {words}")
        got, pieces = 0, []

        async def counted():
            nonlocal got
            message = await receive()
            got += len(message.get("body", b""))
            if got > most:
                too_long.append(Refusal(413, words))
                raise too_long[0]
            if scope["path"] != "/api/upload":
                pieces.append(message.get("body", b""))
                if not message.get("more_body"):
                    check_text(b"".join(pieces))
            return message
        return counted


def check_text(body: bytes) -> None:
    """JSON is UTF-8: what reads it takes UTF-16 as well, and halves of characters, of which no file can be
    written. Raises Refusal."""
    try:
        text = body.decode("utf-8")
    except UnicodeDecodeError as problem:
        raise Refusal(400, f"the request is no text in UTF-8: byte {problem.start + 1}") from problem
    if "\0" in text or HALF.search(ESCAPED.sub("", text)):
        raise Refusal(400, "the request has a character that no text has: half of one, or NUL")


async def refuse(scope, receive, send, refusal: Refusal) -> None:
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.close", "code": 1008})
        return
    body = json.dumps({"error": str(refusal)}).encode()
    head = {"Content-Type": "application/json", "Content-Length": str(len(body)), "Connection": "close",
            **HEADERS}
    await send({"type": "http.response.start", "status": refusal.code,
                "headers": [(name.lower().encode(), value.encode()) for name, value in head.items()]})
    await send({"type": "http.response.body", "body": body})
