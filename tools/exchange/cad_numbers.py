# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers in STEP and IGES files that no part has, which Open CASCADE would reckon with without end."""

import re
from pathlib import Path

from plotting.reading import Trouble

LARGEST = 1e9  # in the file's unit: a part of more than a thousand kilometres if that is mm
TEXTS = re.compile(r"'[^'\n]{0,10000}'")  # of STEP: numbers in them are words
# with an exponent or eleven digits before the point; NAN and INF as programs print them
SUSPECTS = re.compile(r"(?<![\w.#])[-+]?(?:\d*\.?\d*[EeDd][-+]?\d{1,9}|\d{10,400}\.?\d*)(?![\w.])")
NO_NUMBERS = re.compile(r"(?<![\w.#$])[-+]?(?:NAN|INF|INFINITY|1\.?#\w+)(?![\w(])", re.IGNORECASE)


def expect_lengths(path: Path, text: str) -> None:
    """Raises Trouble with the line of the first number that is none, or larger than any part. Of IGES
    only the section of parameters is looked at."""
    for number, line in enumerate(text.splitlines(), 1):
        if len(line) >= 73 and line[72] in "SGDT" and line[73:80].strip().isdigit():
            continue
        line = TEXTS.sub("''", line[:72] if line[72:73] == "P" else line)
        found = NO_NUMBERS.search(line) or next(
            (one for one in SUSPECTS.finditer(line) if too_large(one[0])), None)
        if found:
            raise Trouble(f"{path}:{number}: {found[0][:30]} is no coordinate of a part (they are finite, "
                          f"and at most {LARGEST:g}): mend the part in the CAD program, and export it "
                          "anew")


def too_large(word: str) -> bool:
    """1.5D3 is 1500 in IGES."""
    try:
        return not abs(float(re.sub("[dD]", "e", word))) <= LARGEST
    except ValueError:
        return False  # E5 alone
