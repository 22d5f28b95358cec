# SPDX-License-Identifier: GPL-3.0-or-later
"""Steps that cut a TOML text and put it together again. Tables go with the comments directly above them,
keys and items with those of their lines."""

from .places import BLANK, Places, Value
from .text import key_text


def line_start(text: str, place: int) -> int:
    return text.rfind("\n", 0, place) + 1


def line_end(text: str, place: int) -> int:
    end = text.find("\n", place)
    return len(text) if end < 0 else end + 1


def put_between(text: str, at: int, block: str) -> str:
    """With an empty line before it and after it."""
    before, after = text[:at], text[at:]
    if before and not before.endswith("\n"):
        before += "\n"
    if before and not before.endswith("\n\n"):
        before += "\n"
    if after and not after.startswith("\n"):
        block = block.rstrip("\n") + "\n\n"
    return before + block + after


def remove(text: str, path: tuple) -> str:
    places = Places(text)
    span = places.values.get(path)
    if span and span.line_end < 0:
        return remove_inside(text, places, span)
    cuts = [(line_start(text, line.words[0].start), line.line_end) for line in places.lines()
            if line.path[:len(path)] == path]
    cuts += [(block.lead, block.end) for block in places.below(path)]
    last = 0
    kept = []
    for start, end in sorted(cuts):  # keys lie in their block
        kept.append(text[last:max(start, last)])
        last = max(end, last)
    kept.append(text[last:])
    text = "".join(kept)
    return text.rstrip("\n") + "\n" if text.strip() and last >= len(text) else text


def begin(span: Value) -> int:
    return span.words[0].start if span.words else span.start


def inside(places: Places, span: Value) -> list[Value]:
    """Items of a list, or keys of a table in braces, in order."""
    depth = len(span.path)
    found = [other for path, other in places.values.items() if path[:depth] == span.path
             and len(path) - (len(other.words) or 1) == depth and other.line_end < 0]
    return sorted(found, key=begin)


def holder(places: Places, span: Value) -> Value:
    return places.values[span.path[:len(span.path) - (len(span.words) or 1)]]


def comma_after(text: str, place: int) -> int:
    """Its place, -1 without one."""
    at = BLANK.match(text, place).end()
    return at if text[at:at + 1] == "," else -1


def remove_inside(text: str, places: Places, span: Value) -> str:
    """With its comma, and with its line if nothing else stands on that."""
    row = inside(places, holder(places, span))
    number, start, end = row.index(span), begin(span), span.end
    comma = comma_after(text, end)
    if comma >= 0:
        end = comma + 1
    elif number:
        before = comma_after(text, row[number - 1].end)
        text = text[:before] + text[before + 1:]
        start, end = start - 1, end - 1
        if text[row[number - 1].end:start].isspace() and "\n" not in text[row[number - 1].end:start]:
            start = row[number - 1].end
    tail = text[end:line_end(text, end)]
    if not text[line_start(text, start):start].strip() and tail.endswith("\n") and \
            (not tail.strip() or tail.strip().startswith("#")):
        return text[:line_start(text, start)] + text[line_end(text, end):]
    while comma >= 0 and text[end:end + 1] == " ":
        end += 1
    return text[:start] + text[end:]


def insert_inside(text: str, places: Places, span: Value, words: str) -> str:
    """At the end of a list or of a table in braces."""
    row = inside(places, span)
    if not row:
        between = f" {words} " if span.kind == "table" else words
        return text[:span.start + 1] + between + text[span.end - 1:]
    return insert_behind(text, span, row[-1], words)


def insert_behind(text: str, around: Value, last: Value, words: str) -> str:
    line = text[line_start(text, begin(last)):begin(last)]
    if line.strip() or "\n" not in text[last.end:around.end] or around.kind == "table":
        return text[:last.end] + f", {words}" + text[last.end:]
    comma = comma_after(text, last.end)
    if comma < 0:
        text = text[:last.end] + "," + text[last.end:]
        comma = last.end
    place = line_end(text, comma)
    rest = text[comma + 1:place].strip()
    if rest and not rest.startswith("#"):  # another item on this line
        return text[:comma] + f", {words}" + text[comma:]
    return text[:place] + f"{line}{words},\n" + text[place:]


def insert_before(text: str, span: Value, words: str) -> str:
    start = begin(span)
    line = text[line_start(text, start):start]
    return text[:start] + words + (", " if line.strip() else f",\n{line}") + text[start:]


def copy_part(text: str, path: tuple, new: tuple) -> str:
    places = Places(text)
    span, name = places.values.get(path), key_text(new[-1]) if isinstance(new[-1], str) else ""
    if span and span.line_end < 0:
        words = f"{name} = " if name else ""
        return insert_behind(text, holder(places, span), span, words + text[span.start:span.end])
    region = places.region(path)
    if region:
        words = [word for block in places.below(path) for word in block.words if word.depth == len(path)]
        return put_between(text, region[1], replaced(text, region, words, name))
    lines = [line for line in places.lines() if line.path[:len(path)] == path]
    copies = "".join(replaced(text, (line_start(text, line.words[0].start), line.line_end),
                              [word for word in line.words if word.depth == len(path)], name) for line in lines)
    place = lines[-1].line_end
    return text[:place] + ("" if text[:place].endswith("\n") else "\n") + copies + text[place:]


def replaced(text: str, region: tuple[int, int], words: list, name: str) -> str:
    """A part of the text, with another word in these places if there is a name."""
    parts, last = [], region[0]
    for word in words if name else []:
        parts += [text[last:word.start], name]
        last = word.end
    return "".join([*parts, text[last:region[1]]])


def rename(text: str, path: tuple, name: str) -> str:
    places = Places(text)
    words = [word for block in places.below(path) for word in block.words if word.depth == len(path)]
    words += [word for value in places.values.values() for word in value.words
              if word.depth == len(path) and value.path[:len(path)] == path]
    words = sorted({(word.start, word.end): word for word in words}.values(), key=lambda word: word.start)
    return text[:0] + replaced(text, (0, len(text)), words, key_text(name))


def move(text: str, path: tuple, to: int) -> str:
    """An item of a list to the place that a number will be."""
    places = Places(text)
    span, target = places.values.get(path), (*path[:-1], to)
    if span:
        return move_inside(text, places, path, to)
    start, end = places.region(path)
    goal = places.region(target)[1 if to > path[-1] else 0]
    part = text[start:end]
    if goal > start:
        shorter = text[:start] + text[end:]
        return put_between(shorter, goal - (end - start), part)
    return put_between(text[:start] + text[end:], goal, part)


def move_inside(text: str, places: Places, path: tuple, to: int) -> str:
    """Values change places; comments stay on their lines."""
    row = inside(places, holder(places, places.values[path]))
    parts = [text[item.start:item.end] for item in row]
    parts.insert(to, parts.pop(path[-1]))
    for item, part in reversed(list(zip(row, parts))):
        text = text[:item.start] + part + text[item.end:]
    return text
