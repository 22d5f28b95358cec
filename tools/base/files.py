# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of others: opened only if they are regular, read up to a bound, no further than they are
long. A pipe, a device or a file of /proc gives one line, and no wait."""

import json
import os
import re
import stat
import tomllib
from pathlib import Path

from base.ending import Mistake, Trouble
from base.outputs import note_read

MIB = 1 << 20
TEXT = 64 * MIB         # summary.json, case, study: those of 10 000 plies have some MB
TABLE = 1024 * MIB      # history.csv, curves, part meshes: a million elements take some 100 MB
BINARY = 8 * 1024 * MIB  # results and meshes of tools, which libraries or hashes read piece by piece
MOST_PARTS = 20  # of a key of TOML
PART = r"""(?:[\w-]++|"(?:[^"\\\n]|\\.){0,200}+"|'[^'\n]{0,200}+')[ \t]*+"""
CHAIN = re.compile(rf"(?<![\w-]){PART}(?:\.[ \t]*+{PART}){{{MOST_PARTS}}}")
KINDS = ((stat.S_ISDIR, "a folder"), (stat.S_ISFIFO, "a pipe"), (stat.S_ISSOCK, "a socket"),
         (stat.S_ISCHR, "a device"), (stat.S_ISBLK, "a device"))


def checked_size(path: Path, status: os.stat_result, most: int) -> None:
    if not stat.S_ISREG(status.st_mode):
        kind = next((word for test, word in KINDS if test(status.st_mode)), "something else")
        raise Trouble(f"{path} is {kind}, not a file")
    if status.st_size > most:
        raise Trouble(f"{path} has {status.st_size / MIB:.0f} MiB, more than the {most / MIB:.0f} that "
                      "such a file can have")


def check_file(path: Path, most: int = BINARY) -> Path:
    """For libraries that open it themselves, and wait for what some files of the system that seem
    empty will say. Raises Trouble."""
    if size_of(path, most) == 0:
        raise Trouble(f"{path} is empty")
    return path


def size_of(path: Path, most: int) -> int:
    """Raises Trouble unless it is a file of `most` bytes at most."""
    try:
        status = os.stat(path)
    except FileNotFoundError:
        raise Trouble(f"{path} is missing") from None
    except (OSError, ValueError) as problem:
        raise Trouble(f"{path} cannot be read: {getattr(problem, 'strerror', None) or problem}") \
            from problem
    checked_size(path, status, most)
    note_read(path, status)
    return status.st_size


def is_file(path: Path) -> bool:
    """Also of what can be no path at all, as a text with a zero byte."""
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


def read_bytes(path: Path, most: int = TEXT) -> bytes:
    """Raises Trouble."""
    size_of(path, most)
    try:
        opened = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC)
        with open(opened, "rb") as file:
            status = os.fstat(opened)
            checked_size(path, status, most)
            return file.read(status.st_size) or b""
    except OSError as problem:
        raise Trouble(f"{path} cannot be read: {problem.strerror or problem}") from problem


def place(path: Path, before: bytes | str) -> str:
    """FILE:LINE:COLUMN behind this much of it."""
    newline = b"\n" if isinstance(before, bytes) else "\n"
    return f"{path}:{before.count(newline) + 1}:{len(before) - before.rfind(newline)}"


def read_text(path: Path, most: int = TEXT) -> str:
    """UTF-8, with or without its mark. Raises Trouble, a Mistake with its place."""
    content = read_bytes(path, most)
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as problem:
        raise Mistake(f"{place(path, content[:problem.start])}: byte 0x{content[problem.start]:02x} "
                      "is no UTF-8; save the file as UTF-8") from problem
    if "\0" in text:
        raise Mistake(f"{place(path, text[:text.index(chr(0))])}: a zero byte: this is no text file")
    return text


def plain_number(word: str) -> float:
    number = float(word)
    if not abs(number) < 1e300:
        raise ValueError(f"{word[:20]} is no number that can be computed with")
    return number


def whole_number(word: str) -> int | float:
    return int(word) if len(word) < 19 else plain_number(word[:400])


def no_constant(word: str):
    raise ValueError(f"{word} is no number of JSON")


def read_json(path: Path, most: int = TEXT):
    """Numbers are finite, texts have characters only. Raises Trouble, a Mistake with its place."""
    text = read_text(path, most)
    try:
        data = json.loads(text, parse_float=plain_number, parse_int=whole_number,
                          parse_constant=no_constant)
        json.dumps(data, ensure_ascii=False).encode()  # \ud800 is no character
    except json.JSONDecodeError as problem:
        raise Mistake(f"{path}:{problem.lineno}:{problem.colno}: {problem.msg}: this is no JSON") \
            from problem
    except UnicodeEncodeError as problem:
        raise Mistake(f"{path}: a text holds what is no character") from problem
    except (RecursionError, ValueError) as problem:
        why = "it nests too deep" if isinstance(problem, RecursionError) else problem
        raise Mistake(f"{path}: {why}: this is no JSON") from problem
    return data


def read_toml(path: Path) -> dict:
    """Raises Trouble, a Mistake with its place."""
    return parsed_toml(path, read_text(path))


def toml_of(text: str) -> dict:
    """Raises ValueError, RecursionError. A key of many parts takes tomllib time with their square, days of
    those that fit in a few MB."""
    if chain := CHAIN.search(text):
        line = text.count("\n", 0, chain.start()) + 1
        raise ValueError(f"a key of more than {MOST_PARTS} parts (at line {line}, column 1)")
    return tomllib.loads(text)


def parsed_toml(path: Path, text: str) -> dict:
    try:
        return toml_of(text)
    except RecursionError as problem:
        raise Mistake(f"{path}:1: error: tables or lists nest too deep; write it flat") from problem
    except ValueError as problem:  # TOMLDecodeError is one; so are numbers of 5000 digits
        where = re.search(r" \(at line (\d+), column (\d+)\)$", str(problem))
        at = f"{where[1]}:{where[2]}" if where else str(len(text.splitlines()) or 1)
        what = str(problem)[:where.start()] if where else str(problem)
        raise Mistake(f"{path}:{at}: error: {what}; write it as TOML does") from problem
