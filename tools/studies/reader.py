# SPDX-License-Identifier: GPL-3.0-or-later
"""One table of a study file, with the keys that it may have."""

import difflib
import re

from studies.toml_place import Mistakes

KNOWN = {
    "": ("include", "title", "case", "set", "accuracy", "presets", "method", "runs", "seed",
         "run_name", "vary", "run", "reference", "area_means", "figures", "limits", "stops",
         "table", "picture"),
    "vary": ("name", "key", "keys", "each", "values", "names", "factors", "range", "count",
             "scale"),
    "run": ("name", "values", "set", "accuracy", "against", "quarter_turns"),
    "reference": ("values", "set", "factors", "accuracy", "fields"),
    "area_means": ("radius",),
    "limits": ("figure", "at_most", "at_least", "ratio_to", "distance_to", "where", "text"),
    "picture": ("kind", "file", "title", "x", "y", "figure", "figures", "rows",
                "panels", "around")}


LARGEST = 1e300  # whole numbers of TOML have any size
LONGEST = 10000  # characters of a text


def is_number(value) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and \
        -LARGEST < value < LARGEST


def is_word(value) -> bool:
    return isinstance(value, str) and value.isprintable() and 0 < len(value) < LONGEST


def is_value(value) -> bool:
    return is_number(value) or is_word(value) or isinstance(value, bool) or \
        isinstance(value, list) and all(map(is_value, value))


def holds(right, value) -> bool:
    """right(value), and False for a value of a kind that it cannot be asked about: a list or a
    table, say, of which no set knows whether it is in it."""
    try:
        return bool(right(value))
    except TypeError:
        return False


class Reader:
    """One table of the file; whatever is wrong goes to the mistakes, a usable value comes out."""

    def __init__(self, table: dict, item: str, kind: str, mistakes: Mistakes):
        self.table, self.item, self.mistakes = table, item, mistakes
        self.meant: set[str] = set()  # keys that are there, but misspelt
        known = KNOWN[kind]
        for key in table:
            if key not in known:
                near = difflib.get_close_matches(key, known, 1)
                self.meant.update(near)
                self.fail(key, "unknown key",
                          f"did you mean {near[0]}?" if near else f"there are {', '.join(known)}")

    def path(self, key: str) -> str:
        return f"{self.item}.{key}" if self.item else key

    def fail(self, key: str, rule: str, remedy: str, value=None) -> None:
        if rule == "is missing" and key in self.meant:
            return
        self.mistakes.add(self.path(key), rule, remedy, value)

    def get(self, key: str, right, rule: str, remedy: str, default=None, required=False):
        """The value if right(value); else the default."""
        if key not in self.table:
            if required:
                self.fail(key, "is missing", remedy)
            return default
        value = self.table[key]
        if holds(right, value):
            return value
        self.fail(key, rule, remedy, value if is_number(value) or isinstance(value, str) else None)
        return default

    def some(self, key: str, right, rule: str, remedy: str) -> list:
        """A list of items that may be missing, but not empty."""
        if self.table.get(key) == []:
            self.fail(key, "must have at least one item", remedy)
        return self.items(key, right, rule, remedy)

    def word(self, key: str, remedy: str, default="", required=False) -> str:
        return self.get(key, is_word, "must be a text in one line, not empty", remedy, default, required)

    def choice(self, key: str, words: tuple, default: str = "", required=False) -> str:
        return self.get(key, lambda value: value in words, f"must be one of {', '.join(words)}",
                        "take one of these", default, required)

    def whole(self, key: str, least: int, default: int, remedy: str, required=False,
              most: int = 2**32 - 1) -> int:
        return self.get(key, lambda value: type(value) is int and least <= value <= most,
                        f"must be a whole number from {least} to {most}", remedy, default, required)

    def items(self, key: str, right, rule: str, remedy: str, required=False, twice=False) -> list:
        """A list, of which wrong items, and those that stand twice unless they may, are told and
        left out."""
        values = self.get(key, lambda value: isinstance(value, list), "must be a list", remedy, [],
                          required)
        kept = []
        for i, value in enumerate(values):
            if not holds(right, value):
                self.fail(f"{key}.{i}", rule, remedy, value if is_number(value) else None)
            elif value in kept and not twice:
                self.fail(f"{key}.{i}", "stands twice", "take one of the two out",
                          None if isinstance(value, dict) else value)
            else:
                kept.append(value)
        return kept

    def settings(self) -> list[str]:
        return self.items("set", lambda one: is_word(one) and re.match(r"[^=\s]+=.", one),
                          "must be a text KEY=VALUE", 'write for example "contact.friction=0.3"',
                          twice=True)

    def tables(self, key: str) -> list[dict]:
        return self.get(key, lambda value: isinstance(value, list) and
                        all(isinstance(one, dict) for one in value),
                        "must be a list of tables", f"write each under [[{key}]]", [])
