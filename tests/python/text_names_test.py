# SPDX-License-Identifier: GPL-3.0-or-later
"""Every file, test, command, option and key that the texts name exists: README, CHANGELOG, docs, READMEs of
cases. What other programs have is named here.

    text_names_test.py SOURCE PROGRAM
"""

import json
import re
import subprocess
import sys
import tomllib
from fnmatch import fnmatchcase
from functools import cache
from pathlib import Path

from texts import blocks_of, commands_of, quoted, texts

SOURCE, PROGRAM = (Path(argument).resolve() for argument in sys.argv[1:3])
FILE = re.compile(r"(?<![\w/.*-])[\w/-]+\.(?:py|sh|cpp|hpp|ipp|js|cmake|\{hpp,cpp\})(?![\w*])|(?<=`)[a-z_/]+\.\*(?=`)")
MADE = {"acp_tables.py", "job.sh"}  # files that programs of plyform write
TEST = re.compile(r"(?<![\w.])([A-Z]\w+)\.([A-Z]\w+)(\*|…|\.\.\.)?")
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]+")
# of other programs: CMake, ctest, GoogleTest, libFuzzer, apt, Podman, Slurm, Snakemake, Google Benchmark
OTHERS = {"--install", "--build", "--preset", "--target", "--prefix", "--component", "--fresh", "--gtest_filter",
          "--no-install-recommends", "--rm", "--network", "--user", "--partition", "--time", "--benchmark_filter",
          "--parsable"}
TABLES = ("fabrics", "blanks", "solver", "contact", "process", "accuracy", "stack", "boundary", "load", "ply", "tool",
          "friction")
KEY = re.compile(rf"(?:{'|'.join(TABLES)})(?:\.[A-Za-z_]\w*|\.\d+|\[\])+")
faults = []


def wrong(file, line, what):
    faults.append(f"{file.relative_to(SOURCE)}:{line}: {what}")


def called(*words):
    done = subprocess.run(words, capture_output=True, text=True, timeout=120, check=False, cwd=SOURCE)
    return done.stdout + done.stderr


@cache
def files():
    listed = subprocess.run(["git", "ls-files"], cwd=SOURCE, capture_output=True, text=True, check=False).stdout.split("\n")
    return [name for name in listed if name] or [path.relative_to(SOURCE).as_posix() for path in SOURCE.rglob("*")
                                                 if path.is_file() and "build" not in path.parts]


@cache
def names():
    return {name.rsplit("/", 1)[-1] for name in files()}


def is_file(word):
    word = word.replace(".{hpp,cpp}", ".*")
    if "*" in word:
        return any(fnmatchcase(name, f"*/{word}") or fnmatchcase(name, word) for name in files())
    return word in MADE or (word in names() if "/" not in word else
                            any(name == word or name.endswith("/" + word) for name in files()))


@cache
def tests():
    """Of GoogleTest, as Suite.Name."""
    found = set()
    for name in files():
        if name.startswith("tests/") and name.endswith(".cpp"):
            text = (SOURCE / name).read_text(encoding="utf-8")
            found |= {f"{a}.{b}" for a, b in re.findall(r"\bTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\s*\)", text)}
    return found


@cache
def functions():
    """Names that are called somewhere in sources and tests."""
    found = set()
    for name in files():
        if name.endswith((".py", ".cpp", ".hpp")):
            found |= set(re.findall(r"\b(check_\w+)\(", (SOURCE / name).read_text(encoding="utf-8")))
    return found


@cache
def of_summary():
    """Keys of summary.json, some below a name that is a table of cases, too."""
    text = (SOURCE / "core/results/summary_json.cpp").read_text(encoding="utf-8")
    return set(re.findall(r'"(\w+)"', text))


@cache
def subcommands(*words):
    """Of a command of plyform, by its help."""
    below = called(PROGRAM, *words, "--help").partition("Subcommands:")[2]
    return set(re.findall(r"^  ([a-z][a-z-]*)  ", below, re.MULTILINE))


@cache
def options(*words):
    return set(OPTION.findall(called(*words, "--help")))


@cache
def options_of_script(name):
    """As its source adds them, or those of the rooms that it takes them from."""
    rooms = re.findall(r"^ *from (\w+)", (SOURCE / name).read_text(encoding="utf-8"), re.MULTILINE)
    places = [SOURCE / "tools" / room for room in set(rooms)]
    sources = [SOURCE / name, *(path for place in places for path in (*place.glob("*.py"), place.with_suffix(".py"))
                                if path.is_file())]
    return {word for path in sources for word in re.findall(r'"(--[a-z][a-z-]+)"', path.read_text(encoding="utf-8"))}


@cache
def options_of_command(name):
    own = options(PROGRAM, name)
    return own.union(*(options(PROGRAM, name, test) for test in subcommands(name)), {"--help"})


@cache
def programs():
    """Those in tools/ that are called by name."""
    return {name for name in files() if re.fullmatch(r"tools/(\w+\.py|[a-z]+)", name)}


@cache
def all_options():
    found = {"--help", "--version"}
    for name in subcommands():
        found |= options_of_command(name)
    for name in programs():
        found |= options_of_script(name)
    for name in files():  # of scripts and tests, as they read them
        if name.startswith(("tests/", "tools/")) and name.endswith((".sh", ".py")):
            found |= set(re.findall(r"--[a-z][a-z-]+", (SOURCE / name).read_text(encoding="utf-8")))
    return found


@cache
def keys():
    """Patterns of keys: NAME stands for one, [] for an item."""
    rows = json.loads(subprocess.run([PROGRAM, "keys", "--json"], capture_output=True, check=True).stdout)
    return {row["key"] for row in rows}


@cache
def pattern(key):
    return re.compile(re.escape(key).replace(r"\[\]", r"(?:\[\]|\.[\w-]+)?").replace("NAME", r"[\w-]+") + r"(?:\.\d+)*")


def is_key(word):
    return any(pattern(key).fullmatch(word) for key in keys())


def check_words(file):
    """Files anywhere; tests, commands, options and keys between backticks."""
    text = file.read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(text, 1):
        for word in FILE.findall(line):
            if not re.search("[A-Z]{2}", word) and not is_file(word):
                wrong(file, number, f"there is no file {word}")
        for suite, name, more in TEST.findall(line) if "verification" in file.parts else []:
            known = [one for one in tests() if one.startswith(f"{suite}.{name}")]
            if suite in {one.split(".")[0] for one in tests()} and not (known if more else f"{suite}.{name}" in tests()):
                wrong(file, number, f"there is no test {suite}.{name}")
    for number, words in quoted(file):
        if words.startswith("check_") and words.isidentifier() and words not in functions():
            wrong(file, number, f"there is no function {words}")
        if words.startswith("plyform ") or words.startswith("tools/"):
            check_command(file, number, words.split())
        elif OPTION.fullmatch(option := (words.split("=")[0].split() or [""])[0]):
            if option not in all_options() | OTHERS:
                wrong(file, number, f"no program has {option}")
        if KEY.fullmatch(words) and words.split(".")[-1] not in of_summary() and not is_key(words):
            wrong(file, number, f"there is no key {words}")


def check_command(file, number, words):
    if words[0] == "plyform":
        if len(words) < 2 or not re.fullmatch("[a-z-]+", words[1]) or words[1].startswith("--"):
            return
        if words[1] not in subcommands() | {"results"}:  # what the format of results.h5 is called
            return wrong(file, number, f"plyform has no command {words[1]}")
        if words[1] == "results":
            return None
        known = options_of_command(words[1])
        script = "tools/" + words[1]
        if script in programs():  # which has its own
            known = known | options_of_script(script)
        if words[1] in ("identify", "theory") and len(words) > 2 and re.fullmatch("[a-z-]+", words[2]) and \
                words[2] not in subcommands(words[1]):
            wrong(file, number, f"plyform {words[1]} has no {words[2]}")
    elif words[0] in programs():
        known = options_of_script(words[0])
    else:
        return
    for word in words[1:]:
        option = word.split("=")[0].strip("[]")
        if OPTION.fullmatch(option) and option not in known | {"--help"}:
            wrong(file, number, f"{' '.join(words[:2])} has no {option}")


def leaves(table, at=""):
    for name, value in table.items():
        place = f"{at}.{name}" if at else name
        if isinstance(value, dict):
            yield place
            yield from leaves(value, place)
        elif isinstance(value, list) and value and all(isinstance(one, dict) for one in value):
            yield place
            for one in value:
                yield from leaves(one, f"{place}[]")
        else:
            yield place


def check_tables(file):
    """Keys of the examples in TOML, of cases, or of a fabric."""
    for block in blocks_of(file):
        if block.kind != "toml":
            continue
        try:
            table = tomllib.loads("\n".join(block.lines))
        except tomllib.TOMLDecodeError as problem:
            wrong(file, block.line, f"is no TOML: {problem}")
            continue
        start = "fabrics.NAME." if file.name == "fabrics.md" else ""
        part = not any(line.startswith("[") for line in block.lines)  # of a table that the text speaks of
        for key in leaves(table):
            if not is_key(start + key) and not (part and any(one.endswith("." + key) for one in keys())):
                wrong(file, block.line, f"there is no key {key}")


def main():
    for file in texts(SOURCE):
        check_words(file)
        for command in commands_of(file):
            check_command(file, command.line, command.text.replace("[", " ").replace("]", " ").split())
    for name in ("README.md", "docs/users/case.md", "docs/users/fabrics.md", "docs/users/accuracy.md"):
        check_tables(SOURCE / name)
    print("\n".join(faults))
    assert not faults, f"{len(faults)} names of what is not there"


if __name__ == "__main__":
    main()
