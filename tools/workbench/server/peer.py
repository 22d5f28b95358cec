# SPDX-License-Identifier: GPL-3.0-or-later
"""Whose program is at the other end of a connection. The address with its token stands in the list of
processes as soon as a browser is started with it, where every user of the machine can read it."""

import os
from pathlib import Path

TABLE = Path("/proc/net/tcp")
ESTABLISHED = "01"


def user_of(port: int, own_port: int, table: str) -> int | None:
    """Of the program that has `port` connected to `own_port`; None if none has. `table`: as of TABLE."""
    for line in table.splitlines()[1:]:
        _, here, there, state, *rest = line.split()
        if state == ESTABLISHED and int(here.rpartition(":")[2], 16) == port and \
                int(there.rpartition(":")[2], 16) == own_port:
            return int(rest[3])
    return None


def may_ask(port: int, own_port: int) -> bool:
    """This user and root, by whom ports are passed on from the system around a virtual machine. All, where
    root serves, as in a container, or the system does not say."""
    own = os.getuid()
    if own == 0:
        return True
    try:
        table = TABLE.read_text(encoding="ascii")
    except OSError:
        return True
    return user_of(port, own_port, table) in (0, own)
