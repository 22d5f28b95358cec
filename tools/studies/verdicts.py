# SPDX-License-Identifier: GPL-3.0-or-later
"""Which runs keep the limits of a study, and a sentence for each limit."""

import fnmatch
import math

from base.summary_file import SOUND
from studies.discs import APART
from studies.ranking import is_number
from studies.shown import Limit
from studies.study_file import METHODS, Study


def title(row: dict) -> str:
    """Of a run, in tables and sentences."""
    known = {"case": "the case", "reference": "the reference",
             "preset": f"--accuracy {row['setting']}"}
    return known.get(row["line"]) or (row["setting"] if row["line"] in ("run", *METHODS) else
                                      f"{row['line']} {row['setting']}")


def columns_of(row: dict, figure: str) -> list[str]:
    """Those of a figure: itself; else one for each of what a * stood for; or a pattern."""
    if figure in row:
        return [figure]
    return [name for name in row if name.startswith(f"{figure}_")] or \
        fnmatch.filter(row, figure)


def named(rows: list[dict], label: str) -> dict:
    return next((row for row in rows if row["setting"] == label), {})


def numbers(limit: Limit, row: dict, rows: list[dict]) -> list[float]:
    """What the limit is about, NaN for what is no number; none if the run has no such figure."""
    names = columns_of(row, limit.figure)
    values = [float(row[name]) if is_number(row[name]) else math.nan for name in names]
    other = limit.ratio_to or limit.distance_to
    if not other:
        return values
    others = [float(value) if is_number(value := named(rows, other).get(name)) else math.nan
              for name in names]
    return [math.nan if limit.ratio_to and b == 0 else a / b if limit.ratio_to else abs(a - b)
            for a, b in zip(values, others)]


def fits(wanted, value) -> bool:
    if isinstance(wanted, dict):
        return is_number(value) and \
            wanted.get("at_least", -math.inf) <= value <= wanted.get("at_most", math.inf)
    if isinstance(wanted, str):
        return fnmatch.fnmatchcase(str(value), wanted)
    return is_number(value) and value == wanted


def concerns(limit: Limit, row: dict) -> bool:
    values = row | {"run": row["setting"]}
    return not limit.where or any(all(fits(wanted, values.get(name, "")) for name, wanted in
                                      one.items()) for one in limit.where)


def breaks(study: Study, row: dict, rows: list[dict]) -> str:
    """The first limit that a run does not keep, or how it ended; empty: it keeps all."""
    if row["status"] not in SOUND:
        return row["status"]
    for name, limit in study.limits.items():
        if concerns(limit, row):
            values = numbers(limit, row, rows)
            if not values or not all(map(limit.kept_by, values)):
                return name
    return ""


def waits(limit: Limit, row: dict, rows: list[dict]) -> bool:
    """Whether the run, or what it is compared with, has not ended yet."""
    others = [limit.ratio_to or limit.distance_to]
    if limit.figure.startswith(APART):
        others.append(row.get("against", ""))
    return row["status"] in ("missing", "failed", "refused") or any(
        named(rows, other).get("status") == "missing" for other in others if other)


def beyond(limit: Limit, value: float) -> float:
    return max(value - limit.at_most, limit.at_least - value)


def farthest(limit: Limit, values: list[float]) -> float:
    """The value nearest to breaking the limit, or farthest beyond it."""
    if not values or any(map(math.isnan, values)):
        return math.nan
    return max(values, key=lambda value: beyond(limit, value))


def verdict(limit: Limit, rows: list[dict]) -> tuple[str, str]:
    """holds, fails or open, and the rest of the sentence. What is no number fails: it is not known
    to hold."""
    own = [row for row in rows if concerns(limit, row)]
    judged = [(farthest(limit, numbers(limit, row, rows)), row) for row in own
              if not waits(limit, row, rows)]
    bad = [(value, row) for value, row in judged
           if row["status"] not in SOUND or not limit.kept_by(value)]
    if bad:
        value, row = next((pair for pair in bad if math.isnan(pair[0])),
                          max(bad, key=lambda pair: beyond(limit, pair[0])))
        return "fails", f"{limit.text}: {len(bad)} of {len(judged)}, {value:.3g} in {title(row)}"
    words = limit.text
    if judged:
        values = [value for value, _ in judged]
        range_ = f"{max(values):.3g} at most" if math.isinf(limit.at_least) else \
            f"{min(values):.3g} at least" if math.isinf(limit.at_most) else \
            f"{min(values):.3g} to {max(values):.3g}"
        words += f" ({range_}, {len(judged)} judged)"
    missing = len(own) - len(judged)
    return (f"open, {missing} missing" if missing else "holds"), words


def verdicts(study: Study, rows: list[dict]) -> list[tuple[str, str]]:
    rows = [row for row in rows if row["line"] != "reference"]
    return [verdict(limit, rows) for limit in study.limits.values()]
