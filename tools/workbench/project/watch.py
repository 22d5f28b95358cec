# SPDX-License-Identifier: GPL-3.0-or-later
"""What the workbench looks at again and again, whatever befalls it."""

import sys
import threading
from collections.abc import Callable

from base.ending import Trouble, one_line, place_of


def watch(act: Callable[[], None], period: float, ending: threading.Event) -> threading.Thread:
    """Calls it every `period` seconds, in a thread, until `ending`. A full disk, or a folder that is away for
    a while, is waited for; a fault is printed once, and does not end it either."""
    def go_on() -> None:
        told = ""
        while not ending.wait(period):
            try:
                act()
            except (OSError, Trouble):
                continue
            except Exception as problem:  # the page would be shown old things without a word
                words = one_line(f"{type(problem).__name__}: {problem}, at {place_of(problem)}", 500)
                if words != told:
                    print(f"studio: this is a fault of plyform: {words}; please report it", file=sys.stderr, flush=True)
                told = words
    thread = threading.Thread(target=go_on, daemon=True)
    thread.start()
    return thread
