# SPDX-License-Identifier: GPL-3.0-or-later
"""Columns of a file of measured curves, for a page to show. What plyform identify makes of them it
says itself (docs/users/identify.md): this reads by the same rules, but chooses nothing."""

import re
from pathlib import Path

from base.ending import Trouble, one_line
from base.files import read_bytes

ENDINGS = (".csv", ".txt", ".dat", ".tsv")
MOST_BYTES, MOST_COLUMNS, MOST_ROWS = 16 << 20, 100, 1500  # rows that are drawn
# Load (kN), F / N, force_N
NAME_AND_UNIT = re.compile(r"^(?P<name>.*?)\s*(?:[(\[](?P<a>[^)\]]+)[)\]]|/\s*(?P<b>[^/\s]+)"
                           r"|_(?P<c>N|mm|deg|rad|kN|%))\s*$")


def number(text: str) -> float | None:
    try:
        value = float(text)
    except ValueError:
        return None
    return value if abs(value) < 1e300 else None


def parted(line: str) -> list[str]:
    mark = next((one for one in (";", "\t", ",") if one in line), None)
    cells = line.split(mark) if mark else line.split()
    return [cell.strip().strip('"') for cell in cells]


def is_numbers(cells: list[str]) -> bool:
    return any(cell for cell in cells) and all(not cell or number(cell) is not None for cell in cells)


def heads(header: list[list[str]], width: int) -> list[tuple[str, str]]:
    """Name and unit of each column: of the first row as wide as those of numbers, and the next one."""
    wide = [i for i, cells in enumerate(header) if len(cells) == width]
    if not wide:
        return [(f"column {k + 1}", "") for k in range(width)]
    names = header[wide[0]]
    units = header[wide[0] + 1] if wide[0] + 1 in wide else [""] * width
    found = []
    for name, unit in zip(names, units):
        parts = NAME_AND_UNIT.match(name)
        if parts and not unit:
            name, unit = parts["name"] or name, parts["a"] or parts["b"] or parts["c"]
        found.append((one_line(name, 80), one_line(unit.strip("()[]"), 20)))
    return found


def columns(path: Path) -> dict:
    """{columns: [{name, title, unit, values}], rows, lines above}. Raises Trouble."""
    text = read_bytes(path, MOST_BYTES).decode("utf-8-sig", "replace")
    header, rows = [], []
    for line in text.splitlines():
        line = line.partition("#")[0].strip()
        if not line:
            continue
        cells = parted(line)[:MOST_COLUMNS]
        if is_numbers(cells):
            rows.append([number(cell) if cell else None for cell in cells])
        elif not rows:
            header.append(cells)
        else:
            raise Trouble(f"{path.name}: {one_line(line, 60)!r} below the first row of numbers is no row of "
                          "numbers: take it out, or begin it with #")
    if not rows:
        raise Trouble(f"{path.name} has no row of numbers: give a file of columns parted by comma, semicolon or "
                      "tab, with decimal points")
    width = len(rows[0])
    step = max(1, -(-len(rows) // MOST_ROWS))
    kept = rows[::step]
    raw = next((cells for cells in header if len(cells) == width), [str(k + 1) for k in range(width)])
    return {"rows": len(rows), "columns": [
        {"name": one_line(raw[k], 80), "title": name, "unit": unit,
         "values": [row[k] if k < len(row) else None for row in kept]}
        for k, (name, unit) in enumerate(heads(header, width))]}
