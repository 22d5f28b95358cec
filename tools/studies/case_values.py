# SPDX-License-Identifier: GPL-3.0-or-later
"""What stands in a case: values of its keys, and a hash of it with all files that it names."""

import contextlib
import fnmatch
import functools
import hashlib
import subprocess
from pathlib import Path

from base.ending import Trouble
from base.files import BINARY, is_file, read_bytes, read_toml
from studies.toml_place import toml_text, toml_value


def split_setting(setting: str) -> tuple[str, str]:
    key, _, value = setting.partition("=")
    return key.strip(), value.strip()


@functools.lru_cache(maxsize=None)
def defaults(program: Path) -> dict[str, object]:
    """Of the keys that have one, as `plyform keys` tells them; lists are KEY[]."""
    values, key = {}, ""
    out = subprocess.run([program, "keys"], capture_output=True, text=True, check=True).stdout
    for line in out.splitlines():
        if not line.startswith(" "):
            key = line.strip()
        elif key not in values and "; default " in line:
            values[key] = toml_value(line.split("; default ", 1)[1].split("; ")[0].strip())
    return values


def number_in(at, step: str) -> int | None:
    """That a step of a key is in a list, by itself or as the name that one item alone has; none if
    it is none of it."""
    if not isinstance(at, list):
        return None
    if step.isascii() and step.isdigit():
        return int(step) if len(step) < 10 and int(step) < len(at) else None
    named = [i for i, item in enumerate(at) if isinstance(item, dict) and item.get("name") == step]
    return named[0] if len(named) == 1 else None


class CaseValues:
    """The case file's tables with settings put in, and those of a fabric file where a key goes
    into it; plyform itself says whether they are right."""

    def __init__(self, file: Path, settings: tuple[str, ...], program: Path):
        self.program, self.folder = program, file.parent
        self.tables = read_toml(file)
        for setting in settings:
            self.put(*split_setting(setting))

    def open_fabrics(self, steps: list[str]) -> None:
        """For a path below a fabric, puts the tables of its file in the place of its path."""
        fabrics = self.tables.get("fabrics")
        if len(steps) < 3 or steps[0] != "fabrics" or not isinstance(fabrics, dict):
            return
        for name, fabric in fabrics.items():
            file = self.folder / fabric if isinstance(fabric, str) else None
            if file and is_file(file) and fnmatch.fnmatchcase(name, steps[1]):
                with contextlib.suppress(Trouble):  # plyform says what is wrong
                    fabrics[name] = read_toml(file)

    def put(self, key: str, text: str) -> None:
        *path, last = key.split(".")
        self.open_fabrics([*path, last])
        at = self.tables
        for step in path:
            if (number := number_in(at, step)) is not None:
                at = at[number]
            elif isinstance(at, dict):
                at = at.setdefault(step, {})
            else:
                return
        if isinstance(at, dict):
            at[last] = toml_value(text)
        elif (number := number_in(at, last)) is not None:
            at[number] = toml_value(text)

    def keys(self, pattern: str) -> list[str]:
        """Keys of the case that fit a pattern with * for any name or number: blanks.*.element_size.
        A pattern without * is itself, whether or not the case gives it. Items of lists go by
        number in what is returned."""
        if "*" not in pattern:
            return [self.numbered(pattern)]
        found, steps = [], pattern.split(".")
        self.open_fabrics(steps)

        def walk(at, path: list[str]) -> None:
            if len(path) == len(steps):
                found.append(".".join(path))
                return
            inner = enumerate(at) if isinstance(at, list) else \
                at.items() if isinstance(at, dict) else ()
            for name, value in inner:
                if fnmatch.fnmatchcase(str(name), steps[len(path)]) or \
                        name == number_in(at, steps[len(path)]):
                    walk(value, [*path, str(name)])
        walk(self.tables, [])
        return found

    def numbered(self, key: str) -> str:
        """A key with the numbers of items that it names."""
        at, steps = self.tables, key.split(".")
        for i, step in enumerate(steps):
            if (number := number_in(at, step)) is not None:
                at, steps[i] = at[number], str(number)
            else:
                at = at.get(step) if isinstance(at, dict) else None
        return ".".join(steps)

    def own(self, key: str):
        """The value of a key, its default where the case has none; None if there is no such."""
        key = self.numbered(key)
        at, steps = self.tables, key.split(".")
        self.open_fabrics(steps)
        for step in steps:
            if (number := number_in(at, step)) is not None:
                at = at[number]
            elif isinstance(at, dict) and step in at:
                at = at[step]
            else:
                general = ".".join("[]" if part.isdigit() else part for part in key.split("."))
                return defaults(self.program).get(general.replace(".[]", "[]"))
        return at


def texts_in(value) -> list[str]:
    if isinstance(value, str):
        return [value]
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return [text for one in inner for text in texts_in(one)]


class FileHash:
    """Hash of files and of all that they name: fabrics, their tables, meshes. Each is read once."""

    def __init__(self):
        self.content: dict[Path, bytes] = {}
        self.named: dict[Path, list[str]] = {}

    def add(self, file: Path, into, seen: set[Path]) -> None:
        file = file.resolve()
        if file in seen:
            return
        seen.add(file)
        if file not in self.content:
            self.content[file] = read_bytes(file, BINARY)
            tables = {}
            if file.suffix == ".toml":
                with contextlib.suppress(Trouble):
                    tables = read_toml(file)
            self.named[file] = texts_in(tables)
        into.update(self.content[file])
        for text in self.named[file]:
            self.add_named(text, file.parent, into, seen)

    def add_named(self, text: str, folder: Path, into, seen: set[Path]) -> None:
        if text and len(text) < 1000 and "\n" not in text and is_file(folder / text):
            self.add(folder / text, into, seen)

    def of(self, case: Path, settings: tuple[str, ...], rest: str) -> str:
        """Of a run: its case, its settings, the files both name, and `rest`."""
        into, seen = hashlib.sha256(rest.encode()), set()
        self.add(case, into, seen)
        for setting in settings:
            key, text = split_setting(setting)
            value = toml_value(text)
            into.update(f"\n{key}={toml_text(value) if not isinstance(value, dict) else text}"
                        .encode())
            for name in texts_in(value):
                self.add_named(name, case.parent, into, seen)
        return into.hexdigest()[:12]
