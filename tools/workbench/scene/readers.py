# SPDX-License-Identifier: GPL-3.0-or-later
"""Processes that read cases for the workbench, ready before they are asked. One that dies or hangs is told
of and started anew; the workbench goes on."""

import json
import os
import signal
import struct
import subprocess
import sys
import threading
import time
from pathlib import Path

from base.ending import TOOLS

from ..project.project import Refused

WORKER = Path(__file__).resolve().parent / "reader.py"
LIMIT = 60.0  # s for one answer
LONG = 300.0  # s for an outlook, which may run the whole scene coarsely
PATIENCE = 0.7  # s that an older request of the same file may still take; a new process takes as long
LATER = 5.0  # s after which it ends itself, when there is no workbench any more
MOST_ANSWER = 1 << 30


class Gone(Exception):
    """The process has ended before it answered."""


def stamps_of(module: Path) -> list:
    return sorted((file.name, file.stat().st_mtime_ns, file.stat().st_ino)
                  for file in module.glob("plyform/_plyform*.so"))


class Worker:
    """Answers one request after the other. A newer request of the same file ends an older one. asks: it is
    asked to end, as it goes on for long but looks whether it shall; else the process is ended."""

    def __init__(self, module: Path, limit: float = LIMIT, nice: int = 0, asks: bool = False):
        self.asks = asks
        self.command = [sys.executable, "-sP", str(WORKER), str(TOOLS), str(module), f"{limit + LATER:g}"]
        self.limit, self.nice, self.module = limit, nice, module
        self.loaded: list = []  # stamps of the module's files, as the process began
        self.turn = threading.Lock()
        self.state = threading.Lock()
        self.process: subprocess.Popen | None = None
        self.asked: dict | None = None  # what it works at
        self.ended_for = ""             # why it was ended: newer, slow
        self.newest: dict[tuple, dict] = {}

    def start(self) -> None:
        """Anew if it has ended, or if the module has been built again."""
        found = stamps_of(self.module)
        with self.state:
            if self.process and self.process.poll() is None and found == self.loaded:
                return
            if self.process:
                self.close()
            self.loaded = found
            self.process = subprocess.Popen(self.command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                            stderr=subprocess.DEVNULL,  # Ctrl-C ends it too
                                            env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"})
            if self.nice:
                os.setpriority(os.PRIO_PROCESS, self.process.pid, self.nice)

    def close(self) -> None:
        self.process.kill()
        self.process.wait()
        self.process.stdin.close()
        self.process.stdout.close()

    def stop(self) -> None:
        with self.state:
            if self.process:
                self.close()
                self.process = None

    def ask(self, act: str, **request) -> tuple[dict, bytes]:
        """Raises Refused: 409 for what is out of date, 500 for what it has died of."""
        what = act, request.get("file")
        self.newest[what] = request
        while not self.turn.acquire(timeout=0.1):
            self.end_older(what, request)
        try:
            if self.newest[what] != request:
                raise Refused("the case has changed meanwhile", 409)
            return self.answer(act, what, request)
        finally:
            self.turn.release()

    def end_older(self, what: tuple, request: dict) -> None:
        """An answer that nobody wants any more, unless it is about to come."""
        with self.state:
            if self.asked and self.asked["what"] == what and self.asked["request"] != request == self.newest[what] \
                    and time.monotonic() - self.asked["since"] > PATIENCE:
                if self.asks and self.process:
                    self.process.send_signal(signal.SIGUSR1)
                else:
                    self.end("newer")

    def end(self, why: str) -> None:
        """Of what it does now."""
        self.ended_for = self.ended_for or why
        if self.process:
            self.process.kill()

    def answer(self, act: str, what: tuple, request: dict) -> tuple[dict, bytes]:
        self.start()
        with self.state:
            self.ended_for, self.asked = "", {"what": what, "request": request, "since": time.monotonic()}
            process = self.process
        watch = threading.Timer(self.limit, self.end, ["slow"])
        watch.daemon = True
        watch.start()
        try:
            return self.exchanged(process, {"act": act, **request})
        except (Gone, OSError, ValueError) as problem:
            raise self.told(process, act) from problem
        finally:
            watch.cancel()
            with self.state:
                self.asked = None
            if process.poll() is not None:
                self.start()  # ready for the next one

    def exchanged(self, process: subprocess.Popen, request: dict) -> tuple[dict, bytes]:
        process.stdin.write(json.dumps(request).encode() + b"\n")
        process.stdin.flush()
        words, content = struct.unpack("<IQ", self.piece(process, 12))
        if words + content > MOST_ANSWER:
            raise Gone
        said = json.loads(self.piece(process, words))
        return said, self.piece(process, content)

    @staticmethod
    def piece(process: subprocess.Popen, size: int) -> bytes:
        content = process.stdout.read(size)
        if len(content) != size:
            raise Gone
        return content

    def told(self, process: subprocess.Popen, act: str) -> Refused:
        try:
            code = process.wait(1.0)  # of itself
        except subprocess.TimeoutExpired:
            process.kill()
            code = process.wait()
        if self.ended_for == "newer":
            return Refused("the case has changed meanwhile", 409)
        if self.ended_for == "slow":
            return Refused(f"the {act} of this case takes more than {self.limit:g} s: it was given up; larger "
                           "elements or fewer facets make it faster", 500)
        why = signal.Signals(-code).name if code < 0 else f"exit code {code}"
        return Refused(f"the program has come to an end ({why}) at the {act} of this case: this is a fault of "
                       "plyform; please report it with the case", 500)


class Workers:
    """One for pictures, one for the first of them, which come at once, one for checks, one for outlooks, which
    take steps, one for plies that are formed."""

    def __init__(self, module: Path):
        self.scene, self.draft, self.check = Worker(module), Worker(module), Worker(module)
        self.outlook = Worker(module, LONG, nice=10)
        self.instant = Worker(module, asks=True)

    def warm(self) -> None:
        for worker in (self.draft, self.scene, self.check):
            worker.start()

    def stop(self) -> None:
        for worker in (self.scene, self.draft, self.check, self.outlook, self.instant):
            worker.stop()
