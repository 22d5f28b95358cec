# SPDX-License-Identifier: GPL-3.0-or-later
"""Two changes of one text, put together line by line: what only one side has changed is taken from it, and
what both have changed, or lines that touch, is for somebody to decide."""

from dataclasses import dataclass
from difflib import SequenceMatcher

from base.ending import one_line

from ..project.project import Changed

MOST_COMPARED = 4_000_000  # pairs of lines; of longer texts what lies between their ends is one change
MOST_SHOWN = 400  # characters of lines in a question


@dataclass
class Hunk:
    """Lines `begin` to `end` of the text before have become others."""

    begin: int
    end: int
    lines: list[str]


def hunks(before: list[str], after: list[str]) -> list[Hunk]:
    most = min(len(before), len(after))
    head = next((k for k in range(most) if before[k] != after[k]), most)
    tail = next((k for k in range(most - head) if before[-1 - k] != after[-1 - k]), most - head)
    old, new = before[head:len(before) - tail], after[head:len(after) - tail]
    if len(old) * len(new) > MOST_COMPARED:
        return [Hunk(head, head + len(old), new)]
    return [Hunk(head + i, head + j, new[k:l]) for word, i, j, k, l in
            SequenceMatcher(None, old, new, autojunk=False).get_opcodes() if word != "equal"]


def merged(base: str, mine: str, theirs: str, over: bool = False) -> str:
    """Raises Changed, unless what both have changed is to be as `mine` has it; lines that only touch stay then."""
    before = base.splitlines(keepends=True)
    own, other = (hunks(before, text.splitlines(keepends=True)) for text in (mine, theirs))
    made, at, clashes = [], 0, []
    for begin, end, ours, foreign in groups(own, other, not over):
        made += before[at:begin]
        at = end
        wanted, there = (applied(before, begin, end, some) for some in (ours, foreign))
        if ours and foreign and wanted != there and not over:
            clashes.append({"what": f"line {begin + 1}", "now": shown(there), "wanted": shown(wanted)})
        made += wanted if ours else there
    if clashes:
        words = "; ".join(f"{one['what']} is now {one['now'] or 'away'}" for one in clashes[:3])
        raise Changed(f"the same lines have been changed meanwhile by another page or program: {words}", clashes)
    return "".join([*made, *before[at:]])


def groups(own: list[Hunk], other: list[Hunk], touching: bool) -> list[tuple[int, int, list[Hunk], list[Hunk]]]:
    """Hunks of both sides that share lines, or touch each other, with the lines from the first to the last."""
    found: list[tuple[int, int, list[Hunk], list[Hunk]]] = []
    for hunk, side in sorted([(hunk, 0) for hunk in own] + [(hunk, 1) for hunk in other],
                             key=lambda one: (one[0].begin, one[0].end)):
        if not found or hunk.begin > found[-1][1] or hunk.begin == found[-1][1] and not touching:
            found.append((hunk.begin, hunk.end, [], []))
        begin, end, *sides = found[-1]
        sides[side].append(hunk)
        found[-1] = (begin, max(end, hunk.end), *sides)
    return found


def applied(before: list[str], begin: int, end: int, changes: list[Hunk]) -> list[str]:
    lines, at = [], begin
    for hunk in changes:
        lines += [*before[at:hunk.begin], *hunk.lines]
        at = hunk.end
    return [*lines, *before[at:end]]


def shown(lines: list[str]) -> str:
    return one_line(" / ".join(line.strip() for line in lines if line.strip()), MOST_SHOWN)
