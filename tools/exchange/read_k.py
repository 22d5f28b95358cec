# SPDX-License-Identifier: GPL-3.0-or-later
"""Shells of an LS-DYNA keyword file: *NODE, *ELEMENT_SHELL with its options, *INCLUDE; fields of
standard width, of LONG=Y (20), or with commas."""

from collections.abc import Iterator
from pathlib import Path

from exchange.deck_lines import Deck, Line, included, lines_of, number, whole
from exchange.shell_mesh import ShellMesh

OTHERS = ("SOLID", "BEAM", "TSHELL", "DISCRETE", "MASS", "INERTIA", "SEATBELT", "SPH", "PLOTEL",
          "TRIM", "LANCING", "GENERALIZED", "INTERPOLATION", "BEARING", "BLANKING", "DIRECT", "RIGID")
CARDS_AFTER = {"THICKNESS": 1, "BETA": 1, "MCID": 1, "OFFSET": 1, "DOF": 1}  # an element


def read_k(path: Path) -> ShellMesh:
    deck = Deck(path)
    keyword, skip, cards, wide = "", 0, 0, False
    for line in decks(path, 0):
        text = line.text
        if text.startswith("*"):
            words = text[1:].upper().split()
            keyword = words[0] if words else ""
            wide = wide or (keyword == "KEYWORD" and "LONG=Y" in words)
            keyword, long_form = (keyword[:-1], True) if keyword[-1:] == "+" else (keyword, wide)
            cards, skip = cards_after(line, keyword), 0
        elif keyword == "NODE":
            words = fields_of(text, [20] * 4 if long_form else [8, 16, 16, 16])
            deck.add_node(line, whole(line, words[0], "a node's number"),
                          tuple(number(line, word or "0", "a coordinate") for word in words[1:4]))
        elif keyword.startswith("ELEMENT_SHELL"):
            if skip:
                skip -= 1
                continue
            words = fields_of(text, [20 if long_form else 8] * 10)
            if cards < 0 and not is_element(words, deck):
                continue
            add_shell(deck, line, words)
            # corners beyond the fourth make a second card of thicknesses
            skip = max(cards, 0) + (1 if "THICKNESS" in keyword and any(words[6:]) else 0)
        elif keyword.startswith("ELEMENT_"):
            deck.left_out[keyword] += 1
    return deck.mesh()


def cards_after(line: Line, keyword: str) -> int:
    """Cards that follow each element's first; -1: any number (plies). Raises Trouble for elements
    that are not known."""
    if not keyword.startswith("ELEMENT_"):
        return 0
    kind, *options = keyword.split("_")[1:]
    if kind in OTHERS:
        return 0
    unknown = [option for option in options
               if option not in (*CARDS_AFTER, "COMPOSITE", "LONG", "ID", "TITLE")]
    if kind != "SHELL" or unknown:
        raise line.wrong(f"*{keyword} is not known: shells are *ELEMENT_SHELL with "
                         f"{', '.join(CARDS_AFTER)} or COMPOSITE; take other elements out of the "
                         "file, or write them as one of these")
    if "COMPOSITE" in options:
        return -1
    one = 1 if {"THICKNESS", "BETA", "MCID"} & set(options) else 0
    return one + ("OFFSET" in options) + ("DOF" in options)


def is_element(words: list[str], deck: Deck) -> bool:
    """Tells an element's card from the plies below it: whole numbers, and new in the file."""
    first = [word for word in words[:6] if word]
    return (len(first) >= 5 and all(word.lstrip("+-").isdigit() for word in first)
            and int(first[0]) not in deck.shells)


def add_shell(deck: Deck, line: Line, words: list[str]) -> None:
    label = whole(line, words[0], "an element's number")
    part = whole(line, words[1] or "0", f"the part of element {label}")
    deck.add_shell(line, label, [whole(line, word or "0", f"a corner of element {label}")
                                 for word in words[2:6]], part)


def fields_of(text: str, widths: list[int]) -> list[str]:
    if "," in text:
        words = [word.strip() for word in text.split(",")]
        return words + [""] * (len(widths) - len(words))
    words, at = [], 0
    for width in widths:
        words.append(text[at:at + width].strip())
        at += width
    return words


def decks(path: Path, depth: int, lines: list[Line] | None = None) -> Iterator[Line]:
    awaited = None  # the name of an included file stands on the next line
    for line in lines if lines is not None else lines_of(path):
        text = line.text.split("$", 1)[0].rstrip()
        if not text:
            continue
        if text.upper().startswith("*END"):
            return
        if awaited is not None and not text.startswith("*"):
            yield from decks(path, depth + 1, included(line, text, depth))
        elif text.upper().split()[0] == "*INCLUDE":
            awaited = line
            continue
        elif text.upper().startswith("*INCLUDE_TRANSFORM"):
            raise line.wrong("*INCLUDE_TRANSFORM moves the mesh: write the moved mesh into the file")
        else:
            yield Line(line.path, line.number, text)
        awaited = None
