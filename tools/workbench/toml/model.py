# SPDX-License-Identifier: GPL-3.0-or-later
"""What edits do to what a TOML file says, whatever its text: of which steps an edit is made, and each
step on dicts and lists."""

import copy
import re

from base.ending import one_line

from ..project.project import Refused

NAME = re.compile(r"[A-Za-z0-9_-]{1,80}")
Refers = dict[str, list[str]]  # by pattern of the key: patterns of the tables of whose items it is a name
MAPS = ("blanks", "fabrics", "friction")  # tables of tables, by name
NAMED = ("ply", "tool", "boundary")  # lists of tables with a name


def plain(value):
    """For comparison: 75 is 75.0, nan is nan, and an empty table is none."""
    if isinstance(value, dict):
        parts = {key: plain(part) for key, part in value.items()}
        return {key: part for key, part in parts.items() if part not in ({}, [])}
    if isinstance(value, list):
        return [plain(part) for part in value]
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return str(value), type(value).__name__
    return repr(float(value)) if abs(value) < 2**53 else repr(value)


def at(data, path: tuple):
    """None if there is nothing."""
    for part in path:
        try:
            data = data[part]
        except (KeyError, IndexError, TypeError):
            return None
    return data


def steps_of(data: dict, op, path: tuple, edit: dict, refers: Refers) -> tuple[list[tuple], tuple]:
    """Steps (kind, path, ...) of an edit, and the path of what it makes or leaves. Raises Refused."""
    if op == "set":
        if any(isinstance(part, str) and part.isdigit() for part in path) and at(data, path[:-1]) is None:
            raise Refused(f"there is no {one_line('.'.join(map(str, path[:-1])), 100)}", 422)
        return [("set", path, edit.get("value"))], path
    if op == "add":
        return add_steps(data, path, edit)
    if at(data, path) is None:
        raise Refused(f"there is no {one_line('.'.join(map(str, path)), 100)}", 422)
    if op == "remove":
        return [("remove", path)], path
    if op == "copy":
        return copy_steps(data, path)
    if op == "move":
        return move_steps(data, path, edit)
    if op == "rename":
        return rename_steps(data, path, edit.get("name"), refers)
    raise Refused(f"{one_line(op, 30)!r} is no edit: set, remove, add, copy, move, rename", 422)


def add_steps(data: dict, path: tuple, edit: dict) -> tuple[list[tuple], tuple]:
    value, name, there = edit.get("value", {}), edit.get("name"), at(data, path)
    if path[-1] in MAPS:
        name = free_name(there or {}, checked_name(name or path[-1].removesuffix("s")))
        return [("set", (*path, name), value)], (*path, name)
    if not isinstance(value, dict) or not isinstance(there, (list, type(None))):
        raise Refused("a table can be added to a list of tables, or to blanks or fabrics", 422)
    items = there or []
    if name or path[-1] in NAMED and path[-1] != "boundary":
        taken = {item.get("name"): 1 for item in [*items, *others_named(data, path)] if isinstance(item, dict)}
        value = {"name": free_name(taken, checked_name(name or value.get("name") or f"{path[-1]}{len(items) + 1}")), **
                 {key: part for key, part in value.items() if key != "name"}}
    place = edit.get("at")
    number = len(items) if place is None else number_within(place, len(items))
    if not items:
        return [("set", path, [value])], (*path, 0)
    return [("insert", path, number, value)], (*path, number)


def others_named(data: dict, path: tuple) -> list:
    """Plies and tools may not share names, as frictions are given by them."""
    return [item for key in NAMED if len(path) == 1 for item in listed(data, key)]


def listed(data: dict, key: str) -> list[dict]:
    items = data.get(key)
    return [item for item in items if isinstance(item, dict)] if isinstance(items, list) else []


def number_within(value, most: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value <= most:
        raise Refused(f"{one_line(value, 30)} is no place of {most}", 422)
    return value


def checked_name(name) -> str:
    if not isinstance(name, str) or not NAME.fullmatch(name):
        raise Refused(f"{one_line(name, 100)!r}: take letters, digits, _ and - for a name, 80 at most", 422)
    return name


def free_name(taken: dict, name: str) -> str:
    if name not in taken:
        return name
    match = re.fullmatch(r"(.*[^\d_])(_?)\d+", name)
    stem = "".join(match.groups()) if match else f"{name}_"
    return next(f"{stem}{k}" for k in range(2, len(taken) + 3) if f"{stem}{k}" not in taken)


def copy_steps(data: dict, path: tuple) -> tuple[list[tuple], tuple]:
    parent, key = at(data, path[:-1]), path[-1]
    if isinstance(key, str):
        if not path[:-1] or path[-2] not in MAPS:
            raise Refused("items of lists, blanks, fabrics and laws of friction can be copied", 422)
        new = (*path[:-1], free_name(parent, key))
        return [("copy", path, new)], new
    new, steps = (*path[:-1], key + 1), [("copy", path, (*path[:-1], key + 1))]
    name = parent[key].get("name") if isinstance(parent[key], dict) else None
    if isinstance(name, str):
        taken = {item.get("name"): 1 for item in [*parent, *others_named(data, path[:-1])] if isinstance(item, dict)}
        steps.append(("set", (*new, "name"), free_name(taken, name)))
    return steps, new


def move_steps(data: dict, path: tuple, edit: dict) -> tuple[list[tuple], tuple]:
    if not isinstance(path[-1], int):
        raise Refused("items of a list can be moved", 422)
    to = number_within(edit.get("to"), len(at(data, path[:-1])) - 1)
    return ([("move", path, to)] if to != path[-1] else []), (*path[:-1], to)


def rename_steps(data: dict, path: tuple, name, refers: Refers) -> tuple[list[tuple], tuple]:
    name = checked_name(name)
    if isinstance(path[-1], int):
        kind, old, new = path[-2], at(data, (*path, "name")), path
        taken = [item.get("name") for item in [*at(data, path[:-1]), *others_named(data, path[:-1])]
                 if isinstance(item, dict)]
        steps = [("set", (*path, "name"), name)]
    else:
        kind, old, new = ".".join(map(str, path[:-1])), path[-1], (*path[:-1], name)
        taken = list(at(data, path[:-1]))
        steps = [("rename", path, name)]
        if kind not in MAPS:
            raise Refused("blanks, fabrics and items with a name can be renamed", 422)
    if old == name:
        return [], new
    if name in taken:
        raise Refused(f"the name {name} is taken", 422)
    if isinstance(old, str) and at(data, path[:-1]) is not None:
        steps += [("set", place, name) for place in references(data, path[:-1], old, refers)]
    return steps, new


def references(data: dict, table: tuple, name: str, refers: Refers) -> list[tuple]:
    """Paths of the values by which the file names an item of one of its tables or lists."""
    found = []
    for pattern, parts in refers.items():
        for part in parts:
            for own, names in (ways(pattern, part), fabric_ways(pattern, part)):
                found += [path for path in places_of(data, own, names, table) if at(data, path) == name]
    return list(dict.fromkeys(found))


def ways(pattern: str, part: str) -> tuple[list[str], list[str]]:
    """Of the key that refers, and of the table to whose items it does: their parts, with [] as "#"."""
    return tuple(one.replace("[]", ".#").split(".") for one in (pattern, part))


def fabric_ways(pattern: str, part: str) -> tuple[list[str], list[str]]:
    """The same in a file of a fabric, which has what is below fabrics.NAME."""
    head = "fabrics.NAME."
    both = pattern.startswith(head) and part.startswith(head)
    return ways(pattern.removeprefix(head), part.removeprefix(head)) if both else ([], [])


def places_of(data, own: list[str], names: list[str], table: tuple) -> list[tuple]:
    """Paths of values with this pattern that can name an item of this table: NAME stands for the same in
    both."""
    alike = len(names) == len(table) and all(word in ("NAME", part) for word, part in zip(names, table))
    found: list[tuple] = [()] if alike and own else []
    for k, word in enumerate(own):
        found = [(*path, key) for path in found for key in keys_of(at(data, path), word)
                 if word != "NAME" or own[:k + 1] != names[:k + 1] or key == table[k]]
    lists = [path for path in found if isinstance(at(data, path), list)]
    return [path for path in found if path not in lists] + [(*path, k) for path in lists for k in
                                                            range(len(at(data, path)))]


def keys_of(value, word: str) -> list:
    if word == "#":
        return list(range(len(value))) if isinstance(value, list) else []
    if not isinstance(value, dict):
        return []
    return list(value) if word == "NAME" else [word] if word in value else []


def step(data: dict, kind: str, path: tuple, *rest) -> None:
    """Does one step to the data."""
    parent = at(data, path[:-1])
    if kind == "set":
        put(data, path, rest[0])
    elif kind == "remove":
        del parent[path[-1]]
    elif kind == "insert":
        at(data, path).insert(rest[0], copy.deepcopy(rest[1]))
    elif kind == "copy" and isinstance(path[-1], int):
        parent.insert(path[-1] + 1, copy.deepcopy(parent[path[-1]]))
    elif kind == "copy":
        parent[rest[0][-1]] = copy.deepcopy(parent[path[-1]])
    elif kind == "move":
        parent.insert(rest[0], parent.pop(path[-1]))
    elif kind == "rename":
        parent[rest[0]] = parent.pop(path[-1])


def put(data, path: tuple, value) -> None:
    for part, following in zip(path[:-1], path[1:]):
        if isinstance(data, dict) and part not in data:
            data[part] = [] if isinstance(following, int) else {}
        data = data[part]
    if isinstance(data, list) and path[-1] == len(data):
        data.append(value)
    else:
        data[path[-1]] = copy.deepcopy(value)
