# SPDX-License-Identifier: GPL-3.0-or-later
"""Edits of a TOML text. Each is done twice, in the text and in what it says, and the two have to agree:
what cannot be done so is refused, and the text stays as it was."""

import copy
import json
import re

from base.ending import one_line
from base.files import toml_of

from ..project.project import Refused
from . import cuts as toml_cuts, model as toml_model
from .places import Places
from .text import block_text, has_headers, header, key_text, value_text

SEGMENT = re.compile(r'"((?:[^"\\]|\\.)*)"|([^."]+)')
MOST_ONE_BY_ONE = 50  # changed numbers of a list; one of which more change is written anew


def edited(text: str, edits: list[dict], refers: toml_model.Refers) -> tuple[str, list[str]]:
    """The text after all edits, and the keys that they have made. `refers`: of model. Raises Refused."""
    lines = text.replace("\r\n", "\n")
    made = []
    for edit in edits:
        try:
            lines, key = one_edit(lines, edit, refers)
        except RecursionError as problem:
            raise Refused("lists within lists without end", 422) from problem
        made.append(key)
    return (lines.replace("\n", "\r\n") if "\r\n" in text else lines), made


def one_edit(text: str, edit: dict, refers: toml_model.Refers) -> tuple[str, str]:
    data = toml_of(text)
    op, path = edit.get("op"), resolved(data, edit.get("key"))
    wanted = copy.deepcopy(data)
    steps, made = toml_model.steps_of(wanted, op, path, edit, refers)
    for step in steps:
        toml_model.step(wanted, *step)
        text = STEPS[step[0]](text, *step[1:])
    try:
        found = toml_of(text)
    except ValueError as problem:
        raise Refused(f"{one_line(edit.get('key'), 100)} cannot be changed here: {problem}; change it in the "
                      "text", 422) from problem
    if toml_model.plain(found) != toml_model.plain(wanted):
        raise Refused(f"{one_line(edit.get('key'), 100)} cannot be changed here as it is written: change it "
                      "in the text", 422)
    return text, dotted(made)


def resolved(data: dict, key) -> tuple:
    """tool.punch.stroke and tool.1.stroke as ("tool", 1, "stroke"); keys with dots in quotes, or a list
    of keys. What is not there may be its last part."""
    words = list(map(str, key)) if isinstance(key, list) else split(key)
    path: tuple = ()
    at = data
    for word in words:
        if isinstance(at, list):
            number = item_number(at, word)
            path, at = (*path, number), at[number] if number < len(at) else None
        elif isinstance(at, dict) or at is None:
            path, at = (*path, word), at.get(word) if at else None
        else:
            raise Refused(f"{one_line(dotted(path), 100)} is no table that could have {one_line(word, 50)}", 422)
    return path


def split(key) -> list[str]:
    if not isinstance(key, str) or not key or len(key) > 500 or "\0" in key:
        raise Refused("an edit needs a key", 422)
    words, at = [], 0
    while True:
        match = SEGMENT.match(key, at)
        if not match:
            raise Refused(f"{one_line(key, 100)} is no key", 422)
        words.append(match[2] if match[1] is None else json.loads(match[0]))
        if match.end() == len(key):
            return words
        if key[match.end()] != ".":
            raise Refused(f"{one_line(key, 100)} is no key", 422)
        at = match.end() + 1


def item_number(items: list, word: str) -> int:
    names = [k for k, item in enumerate(items) if isinstance(item, dict) and item.get("name") == word]
    if word.isascii() and word.isdigit() and len(word) < 7 and int(word) <= len(items):
        return int(word)
    if not names:
        raise Refused(f"there is no item {one_line(word, 50)}", 422)
    return names[0]


def dotted(path: tuple) -> str:
    return ".".join(str(part) if isinstance(part, int) or re.fullmatch(r"[A-Za-z0-9_-]+", part)
                    else json.dumps(part, ensure_ascii=False) for part in path)


def set_value(text: str, path: tuple, value) -> str:
    places, old = Places(text), toml_model.at(toml_of(text), path)
    span = places.values.get(path)
    if old is None:
        return insert(text, path, value)
    if toml_model.plain(old) == toml_model.plain(value):
        return text
    if isinstance(old, dict) and isinstance(value, dict):
        return set_parts(text, path, old, value)
    if isinstance(old, list) and isinstance(value, list) and (not span or one_by_one(old, value)):
        return set_items(text, path, old, value)
    if not span:
        return insert(toml_cuts.remove(text, path), path, value)
    return text[:span.start] + value_text(value, old) + text[span.end:]


def one_by_one(old: list, new: list) -> bool:
    changed = sum(a != b for a, b in zip(old, new)) + abs(len(old) - len(new))
    return bool(old) and bool(new) and changed <= MOST_ONE_BY_ONE


def set_parts(text: str, path: tuple, old: dict, value: dict) -> str:
    for key in old:
        if key not in value:
            text = toml_cuts.remove(text, (*path, key))
    for key, part in value.items():
        text = set_value(text, (*path, key), part)
    return text


def set_items(text: str, path: tuple, old: list, value: list) -> str:
    for number in range(len(old) - 1, len(value) - 1, -1):
        text = toml_cuts.remove(text, (*path, number))
    for number, part in enumerate(value):
        text = set_value(text, (*path, number), part)
    return text


def insert(text: str, path: tuple, value) -> str:
    """A key or an item that is not there, at the end of what it is in."""
    places, data = Places(text), toml_of(text)
    parent, key = path[:-1], path[-1]
    span, within = places.values.get(parent), toml_model.at(data, parent)
    if within is None:
        return insert(text, parent, {key: value})
    if span:
        like = within[-1] if isinstance(within, list) and within else None
        words = value_text(value, like) if isinstance(key, int) else f"{key_text(key)} = {value_text(value)}"
        return toml_cuts.insert_inside(text, places, span, words)
    if isinstance(key, int):  # of tables with headers
        return insert_block(text, places, parent, block_text(words_of(parent), value, True))
    if has_headers(key, value):
        tables = value if isinstance(value, list) else [value]
        return insert_block(text, places, path, "\n".join(
            block_text(words_of(path), table, isinstance(value, list)) for table in tables))
    return insert_line(text, places, path, value)


def words_of(path: tuple) -> list[str]:
    return [part for part in path if isinstance(part, str)]


def insert_block(text: str, places: Places, path: tuple, block: str) -> str:
    """Behind those of the same list or kind, else of the same table, else at the end."""
    item = [part for part in path if isinstance(part, int)]
    for depth in range(len(path), 0, -1):
        region = places.region(path[:depth])
        if region and (depth > 1 or not item):
            return toml_cuts.put_between(text, region[1], block)
    region = places.region(path[:1])
    return toml_cuts.put_between(text, region[1] if region else len(text), block)


def insert_at(text: str, path: tuple, number: int, value: dict) -> str:
    """An item before the one that has this number now, or behind the last."""
    places = Places(text)
    span = places.values.get((*path, number))
    if span:
        return toml_cuts.insert_before(text, span, value_text(value))
    region = places.region((*path, number))
    if region:
        return toml_cuts.put_between(text, region[0], block_text(words_of(path), value, True))
    return insert(text, (*path, number), value)


def insert_line(text: str, places: Places, path: tuple, value) -> str:
    parent = path[:-1]
    blocks = [block for block in places.blocks if block.path == parent]
    if blocks:
        entries = [line for line in places.entries(blocks[-1])]
        at = max((line.line_end for line in entries), default=blocks[-1].body)
        if not parent and not entries:
            return insert_first(text, places, f"{key_text(path[-1])} = {value_text(value)}\n")
        indent = re.match(r"[ \t]*", text[blocks[-1].start:] if not entries else
                          text[text.rfind("\n", 0, entries[-1].words[0].start) + 1:])[0]
        return put_line(text, at, f"{indent}{key_text(path[-1])} = {value_text(value)}\n")
    beside = [line for line in places.lines() if line.path[:len(parent)] == parent
              and any(word.depth == len(parent) for word in line.words)]
    if beside:  # parent.key = value
        last = beside[-1]
        words = [text[word.start:word.end] for word in last.words if word.depth <= len(parent)]
        return put_line(text, last.line_end, f"{'.'.join([*words, key_text(path[-1])])} = {value_text(value)}\n")
    return put_before(text, places.region(parent)[0],
                      header(words_of(parent)) + f"{key_text(path[-1])} = {value_text(value)}\n\n")


def put_line(text: str, at: int, line: str) -> str:
    return text[:at] + ("\n" if at and text[at - 1] != "\n" else "") + line + text[at:]


def put_before(text: str, at: int, block: str) -> str:
    return text[:at] + block + text[at:]


def insert_first(text: str, places: Places, line: str) -> str:
    """A key of no table, before the first header."""
    if len(places.blocks) == 1:
        return put_line(text, len(text), line)
    return put_before(text, places.blocks[1].lead, line + "\n")


STEPS = {"set": set_value, "remove": toml_cuts.remove, "insert": insert_at, "copy": toml_cuts.copy_part,
         "move": toml_cuts.move, "rename": toml_cuts.rename}
