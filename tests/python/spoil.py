# SPDX-License-Identifier: GPL-3.0-or-later
"""Ways to spoil files by their structure; the same chance spoils the same."""

import copy
import json
from pathlib import Path

import h5py
import numpy as np

WORDS = ["", "nan", "inf", "-1", "0", "1e400", "1e308", "9" * 30, "99999999999", "x", "-", "1.5", "\u2028",
         "../x", "1,2", "\"", "é", "*NODE", "-1.0E+30", "1D5", "2-3", "\t", "0x10", "1_0", "٣"]
VALUES = [None, True, -1, 0, 1.5, 1e300, 10**18, "", "x", "../x", "a\nb", "x" * 5000, [], {}, [1], {"a": 1},
          [None, None, None], [[1]], "\u2028<!--</script>", {"name": "x"}]


def places(data, path=()):
    """Of all values inside."""
    yield path
    inner = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in inner:
        yield from places(value, (*path, key))


def json_text(data, chance) -> bytes:
    data = copy.deepcopy(data)
    for _ in range(chance.choice((1, 1, 2, 5))):
        *path, key = chance.choice([place for place in places(data) if place])
        at = data
        for step in path:
            at = at[step]
        way = chance.randrange(4)
        if way == 0:
            del at[key]
        elif way == 1 and isinstance(at, list):
            at.append(copy.deepcopy(at[key]))
        elif way == 2 and isinstance(at, dict):
            at[chance.choice(("x", "", "name", "each", key + "s"))] = at.pop(key)
        else:
            at[key] = copy.deepcopy(chance.choice(VALUES))
    text = json.dumps(data, ensure_ascii=chance.random() < 0.5).encode("utf-8", "surrogatepass")
    if chance.random() < 0.1:
        text = spoilt_bytes(text, chance)
    return text


def words(text: str, chance, comma: str) -> bytes:
    """Of lines with fields: between commas, or in columns."""
    lines = text.split("\n")
    for _ in range(chance.choice((1, 1, 2, 4))):
        k = chance.randrange(len(lines))
        way = chance.randrange(6)
        if way == 0 and len(lines) > 1:
            del lines[k]
        elif way == 1:
            lines.insert(k, lines[chance.randrange(len(lines))])
        elif way == 2:
            lines[k] = lines[k][:chance.randrange(len(lines[k]) + 1)]
        elif comma and comma in lines[k]:
            fields = lines[k].split(comma)
            fields[chance.randrange(len(fields))] = chance.choice(WORDS)
            lines[k] = comma.join(fields)
        elif lines[k]:
            at, wide = chance.randrange(len(lines[k])), chance.choice((1, 8, 9, 16))
            word = chance.choice(WORDS)
            lines[k] = lines[k][:at] + word[:wide].rjust(wide) + lines[k][at + wide:]
    content = "\n".join(lines).encode("utf-8")
    return spoilt_bytes(content, chance) if chance.random() < 0.1 else content


def toml(text: str, chance) -> bytes:
    lines = text.split("\n")
    values = ["true", "-1", "1e9", "10000000000", "9" * 400, "nan", "''", '"x"', "[]", "{}", "[[1]]",
              "[1, 'x']", "{ a = 1 }", '"../x"', '"\\u0000"', "1979-05-27", "[" * 2000 + "]" * 2000,
              "'{a:s}'", "'*'", "'['", "[true, nan]", "9" * 5000, "{ at_most = [] }"]
    for _ in range(chance.choice((1, 1, 2, 4))):
        k = chance.randrange(len(lines))
        key, equals, value = lines[k].partition(" = ")
        way = chance.randrange(5)
        if way == 0 and len(lines) > 1:
            del lines[k]
        elif way == 1:
            lines.insert(k, lines[chance.randrange(len(lines))])
        elif equals and way < 4:
            lines[k] = key + equals + chance.choice(values)
        elif equals:
            others = [line.partition(" = ")[0] for line in lines if " = " in line]
            lines[k] = chance.choice(others) + equals + value
        else:
            lines[k] = chance.choice(("[x]", "[[run]]", "[vary]", "[[figures]]", "[picture.0]", "="))
    content = "\n".join(lines).encode("utf-8")
    return spoilt_bytes(content, chance) if chance.random() < 0.1 else content


def spoilt_bytes(content: bytes, chance) -> bytes:
    content = bytearray(content)
    for _ in range(chance.choice((1, 3))):
        if content:
            content[chance.randrange(len(content))] = chance.randrange(256)
    return bytes(content[:chance.randrange(len(content) + 1)] if chance.random() < 0.2 else content)


def some_bytes(path: Path, chance) -> None:
    path.write_bytes(spoilt_bytes(path.read_bytes(), chance))


def odd_array(have: np.ndarray, chance):
    """Other numbers, another shape, or another kind of the values that stood there."""
    way = chance.randrange(9)
    if way < 3 and have.size:
        have = have.copy()
        odd = (-1, 10**6, 2**31 - 1) if have.dtype.kind in "iu" else (np.nan, np.inf, 1e300, -1e9, 0.0)
        have.flat[chance.randrange(have.size)] = chance.choice(odd)
        return have
    return (have[:-1], have[:0], have.astype("f4"), have.astype("S8"), have.reshape(-1, 1), np.float64(1))[
        way - 3]


def hdf5(file: h5py.File, chance) -> None:
    found = []
    file.visit(found.append)
    for _ in range(chance.choice((1, 1, 2, 4))):
        name = chance.choice(found)
        if name not in file:
            continue
        if chance.random() < 0.35:
            spoil_attribute(file[name] if chance.random() < 0.7 else file, chance)
        else:
            spoil_link(file, name, found, chance)


def spoil_attribute(at, chance) -> None:
    names = list(at.attrs)
    if not names:
        return
    name = chance.choice(names)
    way = chance.randrange(5)
    value = chance.choice((np.nan, "x", [1.0, 2.0], -1, 1e300, [], np.array(["a", "b"], dtype="S1"),
                           np.array(["lower", "../x"], dtype="S8"), np.zeros((2, 2)), h5py.Empty("f8")))
    kept = at.attrs[name]
    del at.attrs[name]
    if way == 1:
        at.attrs[name + "s"] = kept
    elif way > 1:
        at.attrs[name] = value


def spoil_link(file, name, found, chance) -> None:
    at = file[name]
    way = chance.randrange(7)
    values = at[()] if isinstance(at, h5py.Dataset) else None
    if way == 0:
        file.move(name, name + "x")
        return
    if way == 1:
        other = chance.choice(found)
        if other in file and name + "2" not in file:
            file[name + "2"] = file[other]
        return
    del file[name]
    if way == 2:
        file[name] = h5py.SoftLink(chance.choice(("/", "/plies", "nowhere")))
    elif way == 3:
        file[name] = h5py.ExternalLink(chance.choice(("results.h5", "x.h5", "states/x.h5")), "/")
    elif way == 4:
        file.create_group(name)
    elif way == 5 and values is not None:
        file[name] = odd_array(values, chance)
    elif way == 6 and values is not None:
        file.create_dataset(name, (10**chance.randrange(2, 10),), "f8", chunks=(64,))
