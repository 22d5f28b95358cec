# SPDX-License-Identifier: GPL-3.0-or-later
"""Values and tables as TOML that a person could have written."""

import tomlkit

from ..project.project import Refused

TABLES = ("ply", "tool", "boundary", "load", "pair", "zone", "family", "crossing", "stitch")  # lists that get headers
WIDE = 80  # characters of a list in one line


def key_text(key: str) -> str:
    return tomlkit.items.SingleKey(key).as_string()


def value_text(value, like=None) -> str:
    """In one line, or a list of lists with one in each; whole numbers as `like` has them."""
    if isinstance(value, bool) or value is None or isinstance(value, str):
        if value is None:
            raise Refused("a key cannot be set to null: remove it", 422)
        return str(tomlkit.item(value).as_string())
    if isinstance(value, int):
        return f"{value}.0" if isinstance(like, float) else str(value)
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, dict):
        of = like if isinstance(like, dict) else {}
        inside = ", ".join(f"{key_text(key)} = {value_text(item, of.get(key))}" for key, item in value.items())
        return "{ " + inside + " }" if inside else "{}"
    if not isinstance(value, list):
        raise Refused(f"{value!r} is nothing that a key can be", 422)
    return list_text(value, like)


def list_text(value: list, like) -> str:
    whole = isinstance(like, list) and any(isinstance(item, float) for item in like)
    of = [like[min(k, len(like) - 1)] if isinstance(like, list) and like else None for k in range(len(value))]
    texts = [value_text(item, 0.0 if whole else old) for item, old in zip(value, of)]
    line = "[" + ", ".join(texts) + "]"
    if len(line) <= WIDE or not any(isinstance(item, (list, dict)) for item in value):
        return line
    return "[\n" + "".join(f"  {text},\n" for text in texts) + "]"


def header(words: list[str], item: bool = False) -> str:
    name = ".".join(key_text(word) for word in words)
    return f"[[{name}]]\n" if item else f"[{name}]\n"


def has_headers(key: str, value) -> bool:
    """Whether a new key with this value is written as [key] or [[key]]."""
    if isinstance(value, dict):
        return True
    return key in TABLES and isinstance(value, list) and bool(value) and all(isinstance(one, dict) for one in value)


def block_text(words: list[str], value: dict, item: bool = False) -> str:
    """A table with its header, and those in it."""
    inner = {key: one for key, one in value.items() if has_headers(key, one)}
    lines = [f"{key_text(key)} = {value_text(one)}\n" for key, one in value.items() if key not in inner]
    only = not lines and inner and not item
    parts = [] if only else [header(words, item) + "".join(lines)]
    for key, one in inner.items():
        for table in one if isinstance(one, list) else [one]:
            parts.append(block_text([*words, key], table, isinstance(one, list)))
    return "\n".join(parts)
