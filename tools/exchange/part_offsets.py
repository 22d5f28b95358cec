# SPDX-License-Identifier: GPL-3.0-or-later
"""Offsets of a part's shells: where its laminate lies when the mesh is one of its faces, or any other
surface than its middle. The files that are written have sections of their own, about the nodes: what the
part had is told on the screen and at their heads."""

from collections import Counter

from exchange.shell_mesh import ShellMesh

MIDDLE = ("", "MID")  # words of formats for none


def is_offset(word: str) -> bool:
    """Whether what a file gives moves the laminate off its nodes."""
    word = word.strip().upper()
    if word in MIDDLE:
        return False
    try:
        return float(word) != 0.0
    except ValueError:
        return True  # a face by its name, a distribution, 1.0-3


class Offsets:
    def __init__(self) -> None:
        self.given: Counter[str] = Counter()

    def note(self, what: str, word: str, count: int = 1) -> None:
        """`what` is the format's own name of it, with its keyword."""
        if is_offset(word):
            self.given[what] += count

    def tell(self, mesh: ShellMesh) -> None:
        if self.given:
            named = ", ".join(f"{what} ({count} times)" for what, count in self.given.items())
            mesh.notes.append(f"the part's shells have offsets, {named}: not taken over, the layers written here "
                              "lie about the nodes; give their sections the offset")
