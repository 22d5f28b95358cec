# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays as text in a page: integers of 16 bits over the range of the values, the difference from
state to state, deflated, base64. web/decode.js reads them.

value = low + step * integer, so that the error is half a step at most. Where 16 bits are not enough
for the error that is allowed, the integers have 32.
"""

import base64
import zlib
from dataclasses import dataclass, field

import numpy as np


@dataclass
class Blocks:
    """Blocks of text, and what is known of each, by number."""
    texts: list[str] = field(default_factory=list)
    errors: dict[str, float] = field(default_factory=dict)  # the largest, by kind

    def add(self, values: np.ndarray, kind: str, least_step: float, most_error: float) -> dict:
        """A block of t x ... values. `least_step`: finer says nothing; `most_error`: more is not
        allowed."""
        values = np.asarray(values, dtype=np.float64)
        low, high = (float(values.min()), float(values.max())) if values.size else (0.0, 0.0)
        step = max((high - low) / 65535.0, least_step) or 1.0
        bits = 16
        if step > 2.0 * most_error:
            step, bits = 2.0 * most_error, 32
        numbers = np.rint((values - low) / step).astype(np.int64)
        error = float(abs(low + step * numbers - values).max(initial=0.0))
        self.errors[kind] = max(self.errors.get(kind, 0.0), error)
        packed = self.pack(numbers, bits)
        return {**packed, "low": low, "step": step, "shape": list(values.shape), "kind": kind}

    def add_integers(self, numbers: np.ndarray) -> dict:
        return {**self.pack(numbers.astype(np.int64)[None], 32), "low": 0, "step": 1,
                "shape": [1, *numbers.shape], "kind": "number"}

    def pack(self, numbers: np.ndarray, bits: int) -> dict:
        kind = np.uint16 if bits == 16 else np.uint32
        in_time = np.diff(numbers, axis=0, prepend=0)
        in_place = np.diff(in_time, axis=1, prepend=0) if in_time.ndim > 1 else in_time
        packed = {along: deflated(one.astype(kind)) for along, one in
                  (("time", in_time), ("place", in_place))}
        best = min(packed, key=lambda along: len(packed[along]))
        self.texts.append(base64.b64encode(packed[best]).decode("ascii"))
        return {"block": len(self.texts) - 1, "bits": bits, "differences": best}


def deflated(numbers: np.ndarray) -> bytes:
    """Low bytes of all, then the next ones, ...: like beside like is packed better."""
    planes = np.ascontiguousarray(numbers.reshape(-1)).view(np.uint8)
    planes = planes.reshape(-1, numbers.itemsize).T
    return zlib.compress(np.ascontiguousarray(planes).tobytes(), 6)
