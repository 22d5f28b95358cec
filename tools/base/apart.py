# SPDX-License-Identifier: GPL-3.0-or-later
"""Reading by libraries that go down on damaged files, or never come back: in a copy of this process
with bounds on time and memory, as base/helper_process.hpp has it."""

import os
import pickle
import resource
import signal
from collections.abc import Callable
from pathlib import Path

from base.ending import Trouble, place_of
from base.files import MIB

SECONDS = 60             # of processor time, and one more for each
BYTES_A_SECOND = 20 * MIB  # of the file: the slowest disk reads more
MEMORY = 2048 * MIB      # beyond that of this process, and for each byte of the file
COPIES = 6               # bytes: double precision of what was single, and as it is sent


def limits(size: int) -> None:
    for fault in (signal.SIGSEGV, signal.SIGBUS, signal.SIGABRT, signal.SIGTERM, signal.SIGINT):
        signal.signal(fault, signal.SIG_DFL)
    seconds = SECONDS + size // BYTES_A_SECOND
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    memory = pages * resource.getpagesize() + MEMORY + COPIES * size
    for what, most in ((resource.RLIMIT_CORE, 0), (resource.RLIMIT_CPU, seconds),
                       (resource.RLIMIT_AS, memory)):
        hard = resource.getrlimit(what)[1]
        resource.setrlimit(what, (most if hard < 0 else min(most, hard), hard))
    signal.alarm(20 * seconds)  # one that waits for something


def help_and_leave(act: Callable[[], object], size: int, to: int) -> None:
    code = 1
    try:
        limits(size)
        try:
            outcome = (True, act())
        except BaseException as problem:  # the parent raises it
            if not isinstance(problem, Trouble):
                problem.place = place_of(problem)
            outcome = (False, problem)
        with open(to, "wb") as pipe:
            pickle.dump(outcome, pipe, protocol=5)
        code = 0
    finally:
        os._exit(code)  # nothing of this copy is to be flushed or written at exit


def read_apart(path: Path, act: Callable[[], object]):
    """What `act` returns or raises, which reads this file. Raises Trouble if it does not come back."""
    size = path.stat().st_size
    get, put = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(get)
        help_and_leave(act, size, put)
    os.close(put)
    try:
        with open(get, "rb") as pipe:
            content = pipe.read()
        _, state = os.waitpid(child, 0)
    except BaseException:
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        raise
    if state != 0 or not content:
        ended = signal.Signals(state & 0x7f).name if state & 0x7f else "an error"
        why = "takes too long" if ended in ("SIGXCPU", "SIGALRM") else f"ends with {ended}"
        raise Trouble(f"{path} cannot be read: HDF5 {why} on it: the file is damaged, or there is "
                      "not enough memory; run the case again")
    good, outcome = pickle.loads(content)
    if good:
        return outcome
    raise outcome
