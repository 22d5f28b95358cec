# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers as pages get them: the length of a header (uint32, little-endian), the header as JSON, zero
bytes to a multiple of 4, arrays. In the header an array is {at, count, type: "f4" or "u4"}; `at` is
its first byte behind the padding. web/packed.js reads them, core/run/live_picture.cpp writes them too.
"""

import json

import numpy as np

KINDS = {"f": "<f4", "i": "<u4", "u": "<u4"}


class Arrays:
    def __init__(self):
        self.parts: list[bytes] = []
        self.size = 0

    def add(self, values: np.ndarray) -> dict:
        """What stands for it in the header. Integers are not negative."""
        kind = KINDS[values.dtype.kind]
        part = np.ascontiguousarray(values, dtype=kind).tobytes()
        found = {"at": self.size, "count": int(values.size), "type": kind[1:]}
        self.parts.append(part)
        self.size += len(part)
        return found

    def packed(self, header: dict) -> bytes:
        text = json.dumps(header, allow_nan=False).encode()
        return b"".join([len(text).to_bytes(4, "little"), text, bytes(-len(text) % 4), *self.parts])


def unpacked(content: bytes) -> tuple[dict, memoryview]:
    """The header, and the arrays behind it. Raises ValueError."""
    length = int.from_bytes(content[:4], "little")
    if len(content) < 4 + length:
        raise ValueError("it is cut off")
    header = json.loads(content[4:4 + length])
    if not isinstance(header, dict):
        raise ValueError("it has no header")
    return header, memoryview(content)[4 + length + (-length % 4):]
