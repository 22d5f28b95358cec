# SPDX-License-Identifier: GPL-3.0-or-later
"""Which key moves what."""

import math

import numpy as np
from base.summary_file import SOUND
from studies.reader import LARGEST
from studies.study_file import DRAWN, Study

SKIPPED = ("line", "setting", "status", "breaks", "message", "folder", "on_front")
FEW = 10  # different values of a key of which means are taken each


def is_number(value) -> bool:
    return isinstance(value, (int, float)) and -LARGEST < value < LARGEST


def effect_of(values: list, figure: np.ndarray) -> float:
    """By how much the figure moves over the key's values: of few values, between their largest and
    smallest mean; else along the straight line that fits best."""
    groups: dict[str, list[float]] = {}
    for value, number in zip(values, figure):
        groups.setdefault(str(value), []).append(number)
    if len(groups) <= FEW or not all(map(is_number, values)):
        means = [float(np.mean(group)) for group in groups.values()]
        return max(means) - min(means)
    slope = np.polyfit(np.array(values, dtype=float), figure, 1)[0]
    return float(abs(slope) * (max(values) - min(values)))


def standardised(columns: list[np.ndarray], figure: np.ndarray) -> tuple[list[float], float]:
    """Coefficients of the linear regression, all in standard deviations, and the share of the
    figure's variance that it explains."""
    spread = figure.std()
    inputs = np.stack([(column - column.mean()) / column.std() for column in columns], axis=1)
    if len(figure) < len(columns) + 2 or not spread > 0:
        return [math.nan] * len(columns), math.nan
    output = (figure - figure.mean()) / spread
    fit = np.linalg.lstsq(inputs, output, rcond=None)[0]
    rest = output - inputs @ fit
    return [float(one) for one in fit], float(1.0 - (rest**2).mean())


def one_at_a_time(names: list[str], rows: list[dict], figure: str) -> list[dict]:
    effects = []
    for name in names:
        own = [row for row in rows if row["line"] in (name, "case") and is_number(row.get(figure))]
        if len({str(row[name]) for row in own}) > 1:
            effects.append({"figure": figure, "key": name, "runs": len(own), "effect": effect_of(
                [row[name] for row in own], np.array([row[figure] for row in own], dtype=float))})
    return effects


def together(study: Study, names: list[str], rows: list[dict], figure: str) -> list[dict]:
    own = [row for row in rows if row["line"] == study.method and is_number(row.get(figure))]
    if len(own) < 2:
        return []
    numbers = np.array([row[figure] for row in own], dtype=float)
    varied = [name for name in names if len({str(row[name]) for row in own}) > 1]
    plain = [name for name in varied if all(is_number(row[name]) for row in own)]
    logs = {one.name for one in study.vary if one.log}
    columns = [np.array([math.log(row[name]) if name in logs else row[name] for row in own],
                        dtype=float) for name in plain]
    fit, explained = standardised(columns, numbers) if plain else ([], math.nan)
    return [{"figure": figure, "key": name, "runs": len(own),
             "effect": effect_of([row[name] for row in own], numbers),
             **({"standardised": fit[plain.index(name)], "explained": explained}
                if name in plain else {})} for name in varied]


def rank(study: Study, names: list[str], rows: list[dict]) -> list[dict]:
    """Rows of ranking.csv, figure by figure, what moves it most first."""
    ended = [row for row in rows if row["status"] in SOUND]
    figures = dict.fromkeys(name for row in ended for name, value in row.items()
                            if name not in (*SKIPPED, *names) and is_number(value))
    effects = []
    for figure in figures:
        found = one_at_a_time(names, ended, figure) if study.method == "one at a time" else \
            together(study, names, ended, figure)
        drawn = study.method in DRAWN
        effects += sorted(found, key=lambda row: -abs(row.get("standardised", 0.0) if drawn else
                                                   row["effect"]))
    return effects


def ranking_lines(ranks: list[dict], figure: str) -> list[str]:
    """What moves one figure, for the screen."""
    own = [row for row in ranks if row["figure"] == figure]
    return [f"{figure} is moved by", *(f"  {row['key']:42} {row['effect']:9.3g}" for row in own)] \
        if own else []
