# SPDX-License-Identifier: GPL-3.0-or-later
"""Edits of case files: studio_edits_test.py TOOLS CASES PROGRAM. Each kind of edit of each kind of key of each
shipped case; comments and all other lines stay."""

import collections
import copy
import difflib
import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

sys.path.insert(0, sys.argv[1])
try:
    import tomlkit  # noqa: F401
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)
from workbench.toml import edits as toml_edits, model as toml_model  # noqa: E402
from workbench.project.project import Refused  # noqa: E402

CASES = Path(sys.argv[2])
KEYS = json.loads(subprocess.run([sys.argv[3], "keys", "--json"], capture_output=True, check=True).stdout)
REFERS = {row["key"]: row["refers"] for row in KEYS if row["refers"]}
ODD = 'with "quotes", \\ and é\n'


def edited(text, **edit):
    return toml_edits.edited(text, [edit], REFERS)


def refused(text, words, **edit):
    try:
        edited(text, **edit)
    except Refused as problem:
        assert words in str(problem), problem
        assert problem.code == 422
        return
    raise AssertionError(f"{edit} was done")


def parts(data, path=()):
    """Paths and values of everything in it."""
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in items:
        yield (*path, key), value
        yield from parts(value, (*path, key))


def one_of_each(data):
    """Of keys that differ by numbers alone the first and the last."""
    alike = collections.defaultdict(list)
    for path, value in parts(data):
        alike[tuple("#" if isinstance(part, int) else part for part in path)].append((path, value))
    return [one for group in alike.values() for one in {str(p): (p, v) for p, v in (group[0], group[-1])}.values()]


def edits_of(data, path, value):
    key = [str(part) for part in path]
    yield {"op": "remove", "key": key}
    if isinstance(value, bool):
        yield {"op": "set", "key": key, "value": not value}
    elif isinstance(value, (int, float)):
        yield {"op": "set", "key": key, "value": 43 if value == 42 else 42}
    elif isinstance(value, str):
        yield {"op": "set", "key": key, "value": ODD}
    elif isinstance(value, list):
        yield {"op": "set", "key": key, "value": [*value, value[-1]]}
        yield {"op": "set", "key": key, "value": value[:-1]}
    else:
        yield {"op": "set", "key": [*key, "new_key"], "value": 1.5}
        yield {"op": "set", "key": [*key, "new_table"], "value": {"a": 1, "b": [1, 2]}}
    if isinstance(path[-1], int):
        last = len(toml_model.at(data, path[:-1])) - 1
        yield {"op": "copy", "key": key}
        yield {"op": "move", "key": key, "to": 0}
        yield {"op": "move", "key": key, "to": last}
        if isinstance(value, dict):
            yield {"op": "add", "key": key[:-1], "value": {"a": 1, "c": {"d": 2}}, "at": path[-1]}
            if path[-2] in ("ply", "tool", "boundary") and "name" in value:
                yield {"op": "rename", "key": key, "name": "fresh"}
    if len(path) == 2 and path[0] in ("blanks", "fabrics"):
        yield {"op": "copy", "key": key}
        yield {"op": "rename", "key": key, "name": "fresh"}


def comments(text):
    return collections.Counter(re.findall(r"#.*$", text, re.MULTILINE))


def lines_changed(before, after):
    marks = [line[0] for line in difflib.ndiff(before.splitlines(), after.splitlines()) if line[0] in "+-"]
    return marks.count("-"), marks.count("+")


def every_case():
    count = 0
    for file in sorted(CASES.glob("*/*.toml")):
        text = file.read_text(encoding="utf-8")
        data = tomllib.loads(text)
        for path, value in one_of_each(data):
            for edit in edits_of(data, path, value):
                after, _ = edited(text, **edit)
                count += 1
                if edit["op"] in ("copy", "move", "add", "rename") or \
                        edit["op"] == "set" and not isinstance(value, list):
                    assert not comments(text) - comments(after), (file, edit)
                if edit["op"] == "set" and isinstance(value, (int, float, str)):
                    assert lines_changed(text, after) == (1, 1), (file, edit)
                    undone, _ = edited(after, op="set", key=edit["key"], value=value)
                    assert undone == text or isinstance(value, str) or "e" in repr(value) or \
                        lines_changed(text, undone) == (1, 1), (file, edit)
    assert count > 3000, count
    print(f"{count} edits of the shipped cases")


TEXT = """# The file's own comment.
title = "two tools"          # its title

[blanks.sheet]
size = [ 10, 20.5 ]

# the first tool
[[tool]]
name = "punch"
stroke = 10.0                # mm
# points = [[0, 0]]

# ---- what follows is still ----

# the second tool
[[tool]]
name = "die"
points = [
  [1.0, 2.0],  # begin
  [3.0, 4.0]   # end
]

[[ply]]
name = "ply1"
blank = "sheet"

[contact]
pair = [ { between = ["punch", "ply1"], friction = 0.1 } ]
"""


def places():
    removed, _ = edited(TEXT, op="remove", key="tool.punch")
    assert "the first tool" not in removed and "# points" not in removed
    assert "# ---- what follows is still ----\n\n# the second tool\n[[tool]]" in removed
    moved, made = edited(TEXT, op="move", key="tool.0", to=1)
    assert moved.index("the second tool") < moved.index("the first tool") < moved.index("[[ply]]")
    assert "# the first tool\n[[tool]]\nname = \"punch\"" in moved and made == ["tool.1"]
    longer, _ = edited(TEXT, op="set", key="tool.1.points", value=[[1, 2], [3, 5], [6, 7]])
    assert "  [1.0, 2.0],  # begin\n  [3.0, 5.0],   # end\n  [6.0, 7.0],\n]" in longer
    shorter, _ = edited(TEXT, op="set", key="tool.1.points", value=[[1, 2]])
    assert "points = [\n  [1.0, 2.0]  # begin\n]" in shorter, shorter
    sized, _ = edited(TEXT, op="set", key="blanks.sheet.size", value=[10, 21])
    assert "size = [ 10, 21.0 ]" in sized
    added, made = edited(TEXT, op="add", key="tool", value={"shape": "mesh", "file": "a.stl"}, name="punch")
    assert '[[tool]]\nname = "punch_2"\nshape = "mesh"\nfile = "a.stl"\n\n[[ply]]' in added and made == ["tool.2"]
    first, made = edited(TEXT, op="add", key="ply", value={"blank": "sheet"}, at=0)
    assert '[[ply]]\nname = "ply2"\nblank = "sheet"\n\n[[ply]]\nname = "ply1"' in first and made == ["ply.0"]
    deep, _ = edited(TEXT, op="set", key="solver.duration", value=0.1)
    assert deep.endswith("\n\n[solver]\nduration = 0.1\n")


FAMILIES = """[[family]]
name = "tow"

[[family]]
name = "axial"

[[crossing]]
families = ["tow", "axial"]
"""
REFERRING = """[blanks.cut]
zone = [ { tool = "a" } ]

[fabrics.other]
family = [ { name = "tow" }, { name = "other" } ]
crossing = [ { families = ["tow", "other"] } ]

[fabrics.glass]
family = [ { name = "tow" }, { name = "axial" } ]
crossing = [ { families = ["tow", "axial"] } ]

[friction.wet]
law = "film"

[[ply]]
name = "low"
blank = "cut"
fabric = "glass"

[[ply]]
name = "top"
blank = "cut"
fabric = "glass"

[[tool]]
name = "a"

[[boundary]]
name = "hung"
ply = "low"
carried_by = "a"

[[load]]
between = ["low", "top"]

[[load]]
ply = "low"

[contact]
friction_law = "wet"

[[contact.pair]]
between = ["a", "low"]
friction_law = "wet"
"""


def references():
    named, _ = edited(TEXT, op="rename", key="tool.punch", name="stamp")
    assert 'name = "stamp"' in named and 'between = ["stamp", "ply1"], friction = 0.1' in named
    named, made = edited(TEXT, op="rename", key="blanks.sheet", name="blank")
    assert "[blanks.blank]" in named and 'blank = "blank"' in named and made == ["blanks.blank"]
    for key, words in (("tool.a", ["carried_by", "tool", "between = [\"new\", \"low\"]"]),
                       ("ply.low", ["ply", "between = [\"a\", \"new\"]", "between = [\"new\", \"top\"]"]),
                       ("blanks.cut", ["blank"]), ("fabrics.glass", ["fabric"]),
                       ("friction.wet", ["friction_law", "friction_law"]),
                       ("fabrics.glass.family.tow", ["families = [\"new\", \"axial\"]"])):
        named, _ = edited(REFERRING, op="rename", key=key, name="new")
        old = key.rpartition(".")[2]
        left = named.partition("[fabrics.glass]")[2] if old == "tow" else named
        assert f'"{old}"' not in left and f".{old}]" not in left, (key, named)
        changed = "\n".join(line for line in named.split("\n") if "new" in line)
        for word in words:
            assert word in changed, (key, word, changed)
        assert 'families = ["tow", "other"]' in named, key  # of another fabric
    of_file, _ = edited(FAMILIES, op="rename", key="family.tow", name="new")
    assert 'families = ["new", "axial"]' in of_file
    refused(TEXT, "is taken", op="rename", key="tool.punch", name="die")
    refused(TEXT, "is taken", op="rename", key="tool.punch", name="ply1")
    refused(TEXT, "take letters", op="rename", key="tool.punch", name="a b")
    copied, made = edited(TEXT, op="copy", key="ply.ply1")
    assert made == ["ply.1"] and 'name = "ply2"' in copied


def what_cannot_be():
    refused(TEXT, "there is no", op="remove", key="tool.0.radius")
    refused(TEXT, "no item", op="set", key="tool.stamp.stroke", value=1)
    refused(TEXT, "no item", op="set", key="tool.7.stroke", value=1)
    refused(TEXT, "no table", op="set", key="title.x", value=1)
    refused(TEXT, "no place", op="move", key="tool.0", to=2)
    refused(TEXT, "no edit", op="burn", key="tool.0")
    refused(TEXT, "null", op="set", key="tool.0.stroke", value=None)
    deep = []
    for _ in range(5000):
        deep = [deep]
    refused(TEXT, "without end", op="set", key="tool.0.stroke", value=deep)
    for key in ("", ".", "a..b", "a\0", 5, "x" * 1000, "tool."):
        refused(TEXT, "key", op="set", key=key, value=1)


def line_ends():
    after, _ = edited(TEXT.replace("\n", "\r\n"), op="set", key="tool.0.stroke", value=12)
    assert after == TEXT.replace("stroke = 10.0 ", "stroke = 12.0 ").replace("\n", "\r\n")
    bare, _ = edited("[a]\nb = 1", op="set", key="a.c", value=[True, "x"])
    assert bare == '[a]\nb = 1\nc = [true, "x"]\n', bare


def many_at_once():
    edits = [{"op": "copy", "key": "ply.0"} for _ in range(19)]
    after, made = toml_edits.edited(TEXT, edits, REFERS)
    names = [ply["name"] for ply in tomllib.loads(after)["ply"]]
    assert len(set(names)) == 20 and made[0] == "ply.1"
    before = copy.copy(TEXT)
    try:
        toml_edits.edited(TEXT, [*edits, {"op": "remove", "key": "nothing"}], REFERS)
        raise AssertionError("half of the edits were done")
    except Refused:
        assert TEXT == before


if __name__ == "__main__":
    places()
    references()
    what_cannot_be()
    line_ends()
    many_at_once()
    every_case()
