# SPDX-License-Identifier: GPL-3.0-or-later
"""Plies, tools and boundaries in their order, or by name."""

from __future__ import annotations

from typing import Generic, Iterable, Iterator, TypeVar

Part = TypeVar("Part")


class Parts(Generic[Part]):
    """Bodies by number from 0 (plies: from the bottom up), negative from the end, or by name.

    Raises IndexError and KeyError, which names the bodies that there are.
    """

    def __init__(self, items: Iterable[Part]):
        self._items = list(items)

    @property
    def names(self) -> list[str]:
        """Names, in order."""
        return [item.name for item in self._items]  # type: ignore[attr-defined]

    def __getitem__(self, which: int | str) -> Part:
        if not isinstance(which, str):
            return self._items[which]
        if which not in self.names:
            raise KeyError(f"{which}: there are {', '.join(self.names) or 'none'}")
        return self._items[self.names.index(which)]

    def __len__(self) -> int:
        return len(self._items)

    def __iter__(self) -> Iterator[Part]:
        return iter(self._items)

    def __repr__(self) -> str:
        return f"<Parts {', '.join(self.names)}>"
