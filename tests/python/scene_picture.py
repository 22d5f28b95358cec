#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws which type of a scene has which member, from the headers that declare them.

    scene_picture.py SOURCE_FOLDER -o PICTURE
    scene_picture.py SOURCE_FOLDER --check PICTURE    does the picture show what the headers have?

The picture carries what it shows as a text (PNG, "Description"); --check compares that text and
needs nothing to draw with. A type that is reached from Scene and has no place in COLUMNS is told.

Exit codes: 0 done, 1 the picture is of other headers, or a type has no place.
"""

import argparse
import re
import struct
import sys
import textwrap
import zlib
from dataclasses import dataclass, field
from pathlib import Path

HEADERS = tuple(f"core/solver/{name}.hpp" for name in (
    "scene", "force_kinds", "contact_state", "layup", "ply_body"))
# Boxes from top to bottom, column by column.
COLUMNS = (("Layup", "SceneModel", "SceneProgress", "SceneWorkspace", "NodeSums", "Block"),
           ("PlyModel", "PlyState"), ("PlyCache",),
           ("ElementForces", "ElementState", "BendingForces", "BoundaryForces", "BoundaryState"),
           ("ToolContacts", "ToolLoad", "ToolState", "PlyContacts", "PlyPair", "PlyContact",
            "PlyEdgeContact", "PassPlace"))
UNIT = re.compile(r"(?:of a |the )?((?:N mm|mm/s|mm\^2|1/s\^2|mm|N|s|t|rad)(?=[,:]|$))")
WIDTH = 54  # characters of a line in a box


@dataclass
class Member:
    name: str
    type: str
    unit: str = ""
    kept: bool = False
    place: str = ""  # what an array has an entry for

    def text(self) -> str:
        kind = self.type + (f" a {self.place}" if self.place else "")
        return f"{'*' if self.kept else ' '} {self.name}: {kind}{f', {self.unit}' if self.unit else ''}"


@dataclass
class Type:
    name: str
    doc: str
    bases: list[str] = field(default_factory=list)
    members: list[Member] = field(default_factory=list)


def short(kind: str) -> str:
    """A type as the picture has it: what std::vector holds, with [] behind."""
    kind = re.sub(r"\b(?:const|std::)\s*", "", kind).replace("::", ".")
    kind = kind.strip().rstrip("*& ")
    for pattern, form in ((r"unique_ptr<(.*)>", r"\1"), (r"optional<(.*)>", r"\1 or none"),
                          (r"array<(.*), (\d+)>", r"\1 [\2]"), (r"vector<(.*)>", r"\1 []")):
        if found := re.fullmatch(pattern, kind):
            return re.sub(r"\\1", lambda _, found=found: short(found[1]),
                          form.replace(r"\2", found[2] if pattern.startswith("array") else ""))
    return kind


def declared(code: str, doc: str) -> list[Member]:
    """Members of one declaration: a type, and names with values."""
    depth, cut = 0, []
    for at, letter in enumerate(code):
        depth += letter in "<({"
        depth -= letter in ">)}"
        if letter == "," and depth == 0:
            cut.append(at)
    parts = [code[a + 1:b] for a, b in zip([-1, *cut], [*cut, len(code)])]
    parts = [re.sub(r"\s*=.*", "", part, flags=re.S).strip() for part in parts]
    found = re.fullmatch(r"(.*[\s>*&])(\w+)", parts[0], re.S)
    if not found or "(" in parts[0] or re.match(r"(?:static|using|template)\b", parts[0]):
        return []
    unit = UNIT.match(doc)
    return [Member(name, short(" ".join(found[1].split())), unit[1] if unit else "")
            for name in [found[2], *parts[1:]]]


def members_of(body: str) -> list[Member]:
    members, code, before = [], "", ""
    lines = body.splitlines()
    for at, line in enumerate(lines):
        text, _, comment = line.partition("//")
        if not text.strip() and not code:
            before += comment[1:].strip() + " " if comment.startswith("/") else ""
            continue
        code += text.strip() + " "
        if code.count("{") != code.count("}") or not (";" in code or code.strip().endswith("}")):
            continue
        after = comment[2:].strip() if comment.startswith("/<") else ""
        for more in lines[at + 1:] if after else ():  # the comment goes on alone
            if not (found := re.fullmatch(r"\s*///< ?(.*)", more)):
                break
            after += " " + found[1]
        if "operator" not in code and code.strip().endswith(";") and " { return" not in code:
            members += declared(code.strip().rstrip(";"), after or before.strip())
        code, before = "", ""
    return members


def types_of(text: str) -> dict[str, Type]:
    """Those of a header; AllOf of a tuple stands for what that lists."""
    types = {}
    for found in re.finditer(r"((?:^///.*\n)*)^struct (\w+)(?: : ([\w, ]+))? \{(\};|(?:.*\n)*?\};)",
                             text, re.M):
        doc = " ".join(line[3:].strip() for line in found[1].splitlines())
        bases = [base.strip() for base in found[3].split(",")] if found[3] else []
        types[found[2]] = Type(found[2], doc, bases, members_of(found[4].removesuffix("};")))
    return types


def all_bases(one: Type, types: dict[str, Type]) -> list[Type]:
    direct = [types[base] for base in one.bases]
    return direct + [more for base in direct for more in all_bases(base, types)]


def mark_kept(text: str, types: dict[str, Type]) -> None:
    """By the lists of each type: f("name", [On::place,] member). What is kept and has no list of its
    own is kept whole."""
    listed = set()
    for found in re.finditer(r"void each_(?:member|array)\((\w+)& \w*, F&& f\) \{\n((?:.*\n)*?)\}",
                             text):
        for place, what in re.findall(r'^  f\("[\w.]+", (?:On::(\w+), )?(.*)\);', found[2], re.M):
            words = re.findall(r"\w+", what)
            one = types[found[1]]
            whole = [one, *all_bases(one, types)]
            listed |= {one.name, *one.bases}
            for member in [member for part in whole for member in part.members]:
                if member.name in words:
                    member.kept = True
                    member.place = place if "[]" in member.type else ""
    for held in [member.type for one in types.values() for member in one.members if member.kept]:
        for one in [types[word] for word in re.findall(r"\w+", held) if word in types]:
            for member in one.members if one.name not in listed else ():
                member.kept = True


def read_types(source: Path) -> dict[str, Type]:
    """Those that are reached from Scene."""
    text = "\n".join((source / header).read_text(encoding="utf-8") for header in HEADERS)
    for name, listed in re.findall(r"^using (\w+) =\s+std::tuple<([^;]*)>;", text, re.M):
        text = text.replace(f"AllOf<{name}>", " ".join(listed.split()))
    types = types_of(text)
    mark_kept(text, types)
    reached, todo = {}, ["Scene"]
    while todo:
        name = todo.pop(0)
        if name in types and name not in reached:
            one = reached[name] = types[name]
            todo += one.bases + [word for member in one.members
                                 for word in re.findall(r"\w+", member.type)]
    return reached


def paths_of(types: dict[str, Type]) -> dict[str, str]:
    """Where in a scene a type stands: plies[], ply_pairs[].passes[]."""
    paths = {"Scene": ""}
    todo = ["Scene"]
    while todo:
        one = types[todo.pop(0)]
        steps = [(base, "") for base in one.bases]
        steps += [(word, member.name + ("[]" if "[]" in member.type else ""))
                  for member in one.members for word in re.findall(r"\w+", member.type)]
        for name, step in steps:
            if name in types and name not in paths:
                paths[name] = ".".join(filter(None, (paths[one.name], step)))
                todo.append(name)
    return paths


def boxes(types: dict[str, Type]) -> dict[str, list[str]]:
    """Lines of each box, by its type."""
    paths = paths_of(types)
    return {name: [f"{paths[name] or 'Scene'}: {name}",
                   *textwrap.wrap(one.doc.split(": ")[0].split(". ")[0].rstrip("."), WIDTH),
                   *(member.text() for member in one.members)]
            for name, one in types.items() if one.members}


def as_text(types: dict[str, Type]) -> str:
    return "\n\n".join("\n".join(lines) for lines in boxes(types).values()) + "\n"


def text_in(picture: Path) -> str:
    """What a PNG of this program shows."""
    data, at = picture.read_bytes(), 8
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        chunk = data[at + 8:at + 8 + size]
        key, _, rest = chunk.partition(b"\0")
        if key == b"Description" and kind == b"tEXt":
            return rest.decode("latin-1")
        if key == b"Description" and kind == b"iTXt":
            packed, text = rest[0], rest[2:].split(b"\0", 2)[2]
            return (zlib.decompress(text) if packed else text).decode("utf-8")
        at += 12 + size
    return ""


def draw(types: dict[str, Type], picture: Path) -> None:
    import matplotlib
    matplotlib.use("Agg")  # draws into a file, needs no screen
    import matplotlib.pyplot as plt
    shown = boxes(types)
    rows = max(sum(len(shown[name]) + 1.2 for name in column) for column in COLUMNS) + 1.8
    figure = plt.figure(figsize=(3.6 * len(COLUMNS), 0.155 * rows))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_xlim(0, len(COLUMNS))
    axes.set_ylim(rows, 0)
    axes.axis("off")
    axes.text(0.02, 0.9, "Scene: where each array is. In blue what lives from step to step: a "
              "checkpoint keeps it, states are compared and hashed by it.", size=9, va="center")
    for x, column in enumerate(COLUMNS):
        y = 1.6
        for name in column:
            lines = shown[name]
            doc = len(lines) - 1 - len(types[name].members)
            axes.add_patch(plt.Rectangle((x + 0.01, y), 0.98, len(lines) + 0.6, fill=False, lw=0.8))
            axes.add_patch(plt.Rectangle((x + 0.01, y), 0.98, 1.2, color="#DDE6EE", lw=0))
            for i, line in enumerate(lines):
                looks = {"weight": "bold", "size": 8} if i == 0 else \
                    {"style": "italic", "size": 7} if i <= doc else \
                    {"size": 7.5, "color": "#0050A0" if line[0] == "*" else "black"}
                axes.text(x + 0.025, y + 0.6 + i, line[2 if i > doc else 0:], va="center", **looks)
            y += len(lines) + 1.2
    figure.savefig(picture, dpi=85, metadata={"Description": as_text(types), "Software": None})


def main() -> None:
    parser = argparse.ArgumentParser(prog="scene_picture.py", description=__doc__.split("\n", 1)[0])
    parser.add_argument("source", type=Path, metavar="SOURCE_FOLDER")
    wanted = parser.add_mutually_exclusive_group(required=True)
    wanted.add_argument("-o", type=Path, dest="picture", metavar="PICTURE")
    wanted.add_argument("--check", type=Path, metavar="PICTURE")
    options = parser.parse_args()
    types = read_types(options.source)
    placed = {name for column in COLUMNS for name in column}
    if placed != {name for name, one in types.items() if one.members}:
        sys.exit("scene_picture.py: COLUMNS and the headers differ in "
                 f"{', '.join(sorted(placed ^ {n for n, one in types.items() if one.members}))}")
    if options.picture:
        draw(types, options.picture)
    elif text_in(options.check) != as_text(types):
        sys.exit(f"{options.check} is of other headers; make it anew: "
                 f"tests/python/scene_picture.py . -o {options.check}")


main()
