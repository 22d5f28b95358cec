# SPDX-License-Identifier: GPL-3.0-or-later
"""A study file as the page's form has it, and back; comments, order and what the form does not
know stay. tools/study says what is wrong with it."""

import hashlib

import tomlkit
from tomlkit.exceptions import TOMLKitError

from base.ending import one_line

from ..cases.merge import merged
from ..project.project import Changed, Refused

PLAIN = ("title", "case", "accuracy", "method", "runs", "seed", "set")
OF_VARY = ("name", "key", "keys", "each", "values", "names", "factors", "range", "count", "scale")
SHOWN = (*PLAIN, "vary", "figures", "limits", "picture")

NEW = """# Runs of one case over values of its keys: tools/study {file}
# What may stand here: docs/users/studies.md
title = {title}
case = {case}    # seen from this file
method = "grid"    # every combination of the values

[figures]    # columns of the table: paths in summary.json of a run
"""


def new_text(file: str, title: str, case: str) -> str:
    return NEW.format(file=file, title=tomlkit.item(title).as_string(), case=tomlkit.item(case).as_string())


def version_of(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def document(text: str) -> tomlkit.TOMLDocument:
    """Raises Refused with the line."""
    try:
        return tomlkit.parse(text)
    except (TOMLKitError, RecursionError, ValueError) as problem:
        raise Refused(one_line(f"this is no TOML: {problem}", 300), 422) from problem


def plan_of(text: str) -> dict:
    """What the form shows, and `other`: keys of the file that it does not."""
    tables = document(text).unwrap()
    return {**{key: tables[key] for key in SHOWN if key in tables},
            "other": [key for key in tables if key not in SHOWN]}


def put(table, key: str, value) -> None:
    """Leaves what is the same as it is written."""
    if value is None or value == []:
        table.pop(key, None)
    elif key not in table or table[key] != value:
        table[key] = value


def put_list(root, key: str, wanted: list[dict], known: tuple[str, ...], notes: list[str]) -> None:
    """[[key]] tables, each after its number."""
    if not isinstance(root.get(key, []), list):
        raise Refused(f"{key} is no list of tables here: change it in the text", 422)
    if not wanted:
        root.pop(key, None)
        return
    if key not in root:
        root.add(tomlkit.nl())
        root[key] = tomlkit.aot()
    tables = root[key]
    while len(tables) > len(wanted):
        del tables[-1]
    for number, one in enumerate(wanted):
        fresh = number >= len(tables)
        table = tomlkit.table() if fresh else tables[number]
        for name in known:
            put(table, name, one.get(name))
        if fresh:
            if notes[number]:
                table.comment(one_line(notes[number], 200))
            tables.append(table)


def in_a_line(value):
    """A table as { at_most = 50 }."""
    if not isinstance(value, dict):
        return value
    table = tomlkit.inline_table()
    table.update(value)
    return table


def put_table(root, key: str, wanted: dict) -> None:
    if not wanted:
        root.pop(key, None)
        return
    if key not in root:
        root.add(tomlkit.nl())
        root[key] = tomlkit.table()
    for name in [name for name in root[key] if name not in wanted]:
        del root[key][name]
    for name, value in wanted.items():
        put(root[key], name, in_a_line(value) if name not in root[key] else value)


def checked(plan: dict) -> dict:
    """Of the kinds that the form sends; whether values fit is said by tools/study. Raises Refused."""
    kinds = {"vary": list, "picture": list, "figures": dict, "limits": dict, "set": list}
    for key, value in plan.items():
        if key in kinds and not isinstance(value, kinds[key]):
            raise Refused(f"{key}: {one_line(value, 50)!r} is no {kinds[key].__name__}", 422)
    for key in ("vary", "picture"):
        if not all(isinstance(one, dict) for one in plan.get(key, [])):
            raise Refused(f"{key}: each must be a table", 422)
    return plan


def with_plan_upon(before: str | None, now: str, plan: dict, over: bool) -> str:
    """The text as it is now with changes of keys that were made upon the one before, if that is another;
    `over` what has been changed since. Raises Changed, Refused."""
    was, there = (plan_of(text) if text is not None else {} for text in (before, now))
    clashes = [{"what": key, "now": one_line(there.get(key), 60), "wanted": one_line(value, 60)}
               for key, value in plan.items() if before is not None and not over
               and was.get(key) != there.get(key) and there.get(key) != value]
    if clashes:
        raise Changed(f"{clashes[0]['what']} has been changed meanwhile by another page or program: it is now "
                      f"{clashes[0]['now']}", clashes)
    return with_plan(now, plan)


def text_upon(before: str | None, now: str, text: str, over: bool) -> str:
    """Likewise of the whole text."""
    if before is not None:
        text = merged(*(one.replace("\r\n", "\n") for one in (before, text, now)), over)
    try:
        document(text)
    except Refused as problem:
        raise Changed(f"with what another page or program has changed meanwhile, {problem}") from problem
    return text.replace("\r\n", "\n").replace("\n", "\r\n") if "\r\n" in now else text


def with_plan(text: str, plan: dict) -> str:
    """The text with what the form has. Raises Refused."""
    root, plan = document(text), checked(plan)
    for key in PLAIN:
        if key in plan:
            put(root, key, plan[key] if plan[key] != "" else None)
    for key in ("figures", "limits"):
        if key in plan:
            put_table(root, key, plan[key])
    if "vary" in plan:
        notes = [str(one.get("note") or "") for one in plan["vary"]]
        put_list(root, "vary", plan["vary"], OF_VARY, notes)
    if "picture" in plan:
        known = tuple(dict.fromkeys(key for one in plan["picture"] for key in one))
        put_list(root, "picture", plan["picture"], known, [""] * len(plan["picture"]))
    made = tomlkit.dumps(root)
    document(made)
    return made
