# SPDX-License-Identifier: GPL-3.0-or-later
"""Edits that were made on one text, done on another one that has come from it since: an edit is of its key,
whose value has to be the same in both. Items of lists are found by their names."""

import json

from base.ending import one_line
from base.files import toml_of

from ..project.project import Changed
from . import edits as toml_edits, model as toml_model

MOST_SHOWN = 60  # characters of a value


def edited_upon(base: str, text: str, edits: list[dict], refers: toml_model.Refers,
                over: bool = False) -> tuple[str, list[str]]:
    """`text` after edits of `base`, and the keys that they have made; `over` values that are others now. Raises
    Changed, Refused."""
    made = []
    for edit in edits:
        before, now = toml_of(base), toml_of(text)
        path = toml_edits.resolved(before, edit.get("key"))
        there = same_place(edit, path, before, now)
        if not over:
            check(edit, path, there, before, now)
        base, _ = toml_edits.edited(base, [edit], refers)
        if not (edit.get("op") == "remove" and toml_model.at(now, there) is None):
            text, keys = toml_edits.edited(text, [{**edit, "key": [str(part) for part in there]}], refers)
            made += keys
    return text, made


def same_place(edit: dict, path: tuple, before, now) -> tuple:
    """The path of the same thing now. Raises Changed."""
    found: tuple = ()
    at_before, at_now = before, now
    for part in path:
        where = same_item(at_before, at_now, part) if isinstance(part, int) else part
        if where is None:
            raise clash(edit, path, before, None, lost=True)
        found = (*found, where)
        at_before, at_now = toml_model.at(at_before, (part,)), toml_model.at(at_now, (where,))
    if toml_model.at(before, path[:-1]) is not None and toml_model.at(now, found[:-1]) is None:
        raise clash(edit, path, before, None, lost=True)
    return found


def same_item(before: list, now, number: int) -> int | None:
    """The number of an item now; None if it is not there, or cannot be told from others."""
    if not isinstance(now, list):
        return None
    if number >= len(before):
        return number if marks(before) == marks(now) else None
    name = name_of(before[number])
    if name is None:
        alike = len(now) == len(before) and toml_model.plain(before[number]) == toml_model.plain(now[number])
        return number if alike else None
    found = [k for k, item in enumerate(now) if name_of(item) == name]
    return found[0] if len(found) == 1 else None


def name_of(item) -> str | None:
    name = item.get("name") if isinstance(item, dict) else None
    return name if isinstance(name, str) else None


def marks(items) -> list:
    return [name_of(item) or toml_model.plain(item) for item in items] if isinstance(items, list) else []


def check(edit: dict, path: tuple, there: tuple, before, now) -> None:
    """Raises Changed."""
    op, was, is_now = edit.get("op"), toml_model.at(before, path), toml_model.at(now, there)
    plain = toml_model.plain
    same = plain(was) == plain(is_now) and (was is None) == (is_now is None)
    if op == "set":
        same = same or plain(is_now) == plain(edit.get("value"))
    elif op == "remove":
        same = same or is_now is None
    elif op == "move":
        same = marks(toml_model.at(before, path[:-1])) == marks(toml_model.at(now, there[:-1]))
    elif op == "add":
        same = edit.get("at") is None or marks(was) == marks(is_now)
    elif op == "rename":
        same = is_now is not None
    if not same:
        raise clash(edit, path, before, is_now)


def clash(edit: dict, path: tuple, before, now, lost: bool = False) -> Changed:
    """lost: there is no such thing any more, or none that can be told from others."""
    what = one_line(toml_edits.dotted(tuple(name_of(toml_model.at(before, path[:k + 1])) or part
                                            for k, part in enumerate(path))), 100)
    wanted = shown(edit["value"]) if edit.get("op") == "set" else str(edit.get("op"))
    words = f"{what} is not where it was: another page or program has changed what it is in; look, and change it anew" \
        if lost else f"{what} has been changed meanwhile by another page or program: it is now {shown(now)}"
    return Changed(words, [{"what": what, "now": shown(now), "wanted": wanted, "lost": lost}])


def shown(value) -> str:
    return "away" if value is None else one_line(json.dumps(value, ensure_ascii=False, default=str), MOST_SHOWN)
