# SPDX-License-Identifier: GPL-3.0-or-later
"""What the readers of input decks share: lines with their places, numbers, and columns of numbers of
many lines at once. Every complaint is a Trouble with file, line, value, rule and remedy."""

import warnings
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from base.files import is_file, read_bytes
from plotting.reading import Trouble

MOST_INCLUDES = 8      # one in another
FARTHEST = 1e9         # mm
MOST_BYTES = 8 << 30   # of a part mesh: some hundred million elements


@dataclass
class Line:
    path: Path
    number: int  # from 1; 0 where there are no lines
    text: str

    def wrong(self, what: str) -> Trouble:
        place = f"{self.path}:{self.number}" if self.number else str(self.path)
        return Trouble(f"{place}: {what}")


def texts_of(path: Path) -> list[str]:
    """The lines of a file. Raises Trouble unless it is a file, and not too large."""
    return read_bytes(path, MOST_BYTES).decode("utf-8", "replace").splitlines()


def included(line: Line, name: str, depth: int, beside: Path) -> Path:
    """The file that a line names, seen from the line's own folder, or from `beside`, that of the
    first file."""
    if depth >= MOST_INCLUDES:
        raise line.wrong(f"includes go {depth} files deep: put the mesh into one file")
    name = name.strip().strip("'\"")
    for folder in (line.path.parent, beside):
        if is_file(folder / name):
            return folder / name
    raise line.wrong(f"includes {line.path.parent / name}, which is missing")


def whole(line: Line, text: str, what: str) -> int:
    try:
        value = int(text)
    except ValueError:
        raise line.wrong(f"{what} is {text.strip()[:40]!r}, not a whole number") from None
    if abs(value) >= 2**62:
        raise line.wrong(f"{what} is {text.strip()[:40]}: numbers have 18 digits at most")
    return value


def number(line: Line, text: str, what: str) -> float:
    """Also 1.5-3 for 1.5e-3 and 1.0D2, as Nastran writes them."""
    text = text.strip()
    try:
        return float(mended(text))
    except ValueError:
        raise line.wrong(f"{what} is {text[:40]!r}, not a number") from None


def bounded(line: Line, text: str, what: str) -> float:
    """A length or an angle: finite, and not beyond all parts."""
    value = number(line, text, what)
    if not abs(value) < FARTHEST:
        raise line.wrong(f"{what} is {text.strip()[:40]!r}: it is beyond {FARTHEST:g}, or not finite")
    return value


def are_whole(values: np.ndarray) -> bool:
    """Whether numbers are whole, and exact."""
    return bool(((values == np.round(values)) & (np.abs(values) < 2**53)).all())


def mended(text: str) -> str:
    try:
        float(text)
        return text
    except ValueError:
        pass
    text = text.upper().replace("D", "E")
    if "E" not in text:
        cut = max(text.rfind("+"), text.rfind("-"))
        if cut > 0:
            text = text[:cut] + "E" + text[cut:]
    return text


def by_commas(texts: list[str]) -> np.ndarray | None:
    """k x c numbers of lines that all have c of them with commas between; else None."""
    commas = texts[0].count(",")
    if any(text.count(",") != commas for text in texts):
        return None
    return numbers_of(",".join(texts), ",", (len(texts), commas + 1))


def numbers_of(text: str, between: str, shape: tuple[int, int]) -> np.ndarray | None:
    """None unless the text is just so many numbers."""
    if "d" in text or "D" in text:
        text = text.replace("D", "E").replace("d", "E")
    with warnings.catch_warnings():
        warnings.simplefilter("error", DeprecationWarning)
        try:
            found = np.fromstring(text, sep=between)
        except (DeprecationWarning, ValueError):
            return None
    return found.reshape(shape) if len(found) == shape[0] * shape[1] else None


class Fields:
    """Fields of fixed widths of many lines."""

    def __init__(self, texts: list[str], width: int):
        joined = "".join([text.ljust(width)[:width] for text in texts])
        data = joined.encode("ascii", "replace")
        self.bytes = np.frombuffer(data, np.uint8).reshape(len(texts), width)

    def words(self, start: int, stop: int) -> np.ndarray:
        field = np.ascontiguousarray(self.bytes[:, start:stop])
        return field.view(f"S{stop - start}").ravel()

    def blank(self, start: int, stop: int) -> np.ndarray:
        return (self.bytes[:, start:stop] == 32).all(axis=1)

    def whole(self, start: int, stop: int) -> np.ndarray:
        """Whole numbers, 0 where blank. Raises ValueError: ask the lines one by one."""
        try:
            return self._filled(start, stop).astype(np.int64)
        except OverflowError as problem:
            raise ValueError from problem

    def number(self, start: int, stop: int) -> np.ndarray:
        """As `number` reads them. Raises ValueError."""
        words = self._filled(start, stop)
        try:
            return words.astype(float)
        except ValueError:
            return np.array([float(mended(word.decode().strip())) for word in words.tolist()])

    def _filled(self, start: int, stop: int) -> np.ndarray:
        words = self.words(start, stop)
        blank = self.blank(start, stop)
        return np.where(blank, b"0", words) if blank.any() else words
