# SPDX-License-Identifier: GPL-3.0-or-later
"""What happens, told to every open page by its WebSocket: {"kind": WORD, ...}."""

import asyncio
from collections.abc import AsyncIterator

MOST_WAITING = 1000  # events of a page that does not read; it is sent "lost" then and asks anew


class Events:
    def __init__(self):
        self.pages: set[asyncio.Queue] = set()
        self.loop: asyncio.AbstractEventLoop | None = None

    def send(self, kind: str, **what) -> None:
        """From any thread."""
        if self.loop and self.loop.is_running():
            self.loop.call_soon_threadsafe(self.put, {"kind": kind, **what})

    def put(self, event: dict) -> None:
        for page in self.pages:
            if page.qsize() >= MOST_WAITING:
                while not page.empty():
                    page.get_nowait()
                page.put_nowait({"kind": "lost"})
            page.put_nowait(event)

    async def of_page(self) -> AsyncIterator[dict]:
        queue: asyncio.Queue = asyncio.Queue()
        self.pages.add(queue)
        try:
            while True:
                yield await queue.get()
        finally:
            self.pages.discard(queue)
