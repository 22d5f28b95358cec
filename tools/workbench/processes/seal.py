# SPDX-License-Identifier: GPL-3.0-or-later
"""Which records of commands this user has made, in this folder: a folder that somebody else has sent may
bring records of its own, and what waits in them must not be started. The key lies with the user's own
state, never in the folder."""

import hashlib
import hmac
import json
import os
from pathlib import Path

SIZE = 32  # bytes
SEALED = ("id", "kind", "command", "cwd", "about")


def place_of_key() -> Path:
    state = os.environ.get("XDG_STATE_HOME") or os.path.expanduser("~/.local/state")
    return Path(state) / "plyform/studio.key"


def kept_key() -> bytes:
    """Made if there is none; where none can be kept, it is that of this workbench only."""
    path, fresh = place_of_key(), os.urandom(SIZE)
    try:
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        part = path.with_name(f"part_{os.urandom(6).hex()}")
        with open(os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o600), "wb") as file:
            file.write(fresh)
        try:
            os.link(part, path)  # whole, and only if there is none
        except FileExistsError:
            pass
        finally:
            part.unlink()
    except OSError:
        pass
    try:
        kept = path.read_bytes()
    except OSError:
        return fresh
    return kept if len(kept) == SIZE else fresh


class Seal:
    def __init__(self, root: Path):
        self.root, self.key = str(root), kept_key()

    def of(self, record: dict) -> str:
        """Of a record with all of SEALED."""
        text = json.dumps([self.root, *(record[key] for key in SEALED)], sort_keys=True)
        return hmac.new(self.key, text.encode(), hashlib.sha256).hexdigest()

    def fits(self, record: dict) -> bool:
        seal = record.get("seal")
        return isinstance(seal, str) and seal.isascii() and hmac.compare_digest(seal, self.of(record))
