# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases: read, changed, checked."""

from __future__ import annotations

import json
import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Mapping, Union

from . import _plyform
from ._plyform import Mistake, Outlook, PredictedError, Scene

#: What a key can be set to: numbers, texts, lists of them, tables; NumPy's numbers and arrays too.
Value = Any


#: Lists and tables within each other: no key takes as many.
_MOST_NESTED = 20


def _toml(value: Value, deep: int = 0) -> str:
    """`value` as TOML in one line."""
    if deep > _MOST_NESTED:
        raise TypeError(f"a key cannot be set to what holds more than {_MOST_NESTED} lists or tables within "
                        "each other, or itself")
    if hasattr(value, "tolist"):  # NumPy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(value)  # inf and nan are the same words in TOML
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, Mapping):
        inside = (f"{_toml(_word(key))} = {_toml(item, deep + 1)}" for key, item in value.items())
        return "{" + ", ".join(inside) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(item, deep + 1) for item in value) + "]"
    raise TypeError(f"a key cannot be set to {value!r}: give a number, text, list or table")


def _word(key: object) -> str:
    """A key, of a case or of a table. Raises TypeError unless it is a text."""
    if not isinstance(key, str):
        raise TypeError(f"{key!r} is no key: a key is a text, as 'ply.0.angle'")
    return key


@dataclass(frozen=True)
class Warned:
    """One warning, with its place if it has one."""

    #: File, as it was named; `--set` for a value set from Python.
    file: str
    #: Line and column, from 1; None for what is said of the file as a whole.
    line: int | None
    column: int | None
    #: Key as a dotted path with numbers, as of a Mistake; None if it is of no single key.
    item: str | None
    #: What is said, without the place.
    text: str


def _warned(message: str, tables: set[str]) -> Warned:
    """A message as the program prints it: file:line:column: warning: key = value: text."""
    place = re.match(r"(.*?)(?::(\d+):(\d+))?: warning: ", message, re.DOTALL)
    if not place:
        return Warned("", None, None, None, message)
    file, line, column = place.groups()
    text = message[place.end():]
    key = re.match(r"([A-Za-z]\w*)(?:\.[\w-]+)*(?=: | = )", text)
    item = key[0] if key and key[1] in tables else None
    return Warned(file, int(line) if line else None, int(column) if column else None, item, text)


@dataclass(frozen=True)
class Check:
    """What a check found."""

    #: All mistakes; none if the case can run.
    mistakes: list[Mistake]
    #: What can run but should be looked at, each with its place.
    warnings: list[str]
    #: What the accuracy asked for left as it was.
    notes: list[str]
    #: Estimates in the place of what the fabrics do not say.
    assumed: list[str]

    @property
    def warnings_at(self) -> list[Warned]:
        """`warnings` in parts."""
        tables = {re.split(r"[.\[]", key.key)[0] for key in _plyform.keys()}
        return [_warned(message, tables) for message in self.warnings]

    @property
    def sound(self) -> bool:
        """Whether the case can run."""
        return not self.mistakes


class Case:
    """A case file with the values that were changed from Python; the file stays as it is.

    file: a case file, or the folder of a `case.toml`.
    settings: values by key, as of `set`.
    accuracy: "instant", "draft", "standard", "reference", or an rms error of the shear angle in
        degrees: picks the cost parameters that `settings` do not give, as `--accuracy` does.
        Raises ValueError for another word.

    The file is read when its contents are asked for, and then again if asked once more.
    """

    def __init__(self, file: Union[str, os.PathLike[str]],
                 settings: Union[Mapping[str, Value], None] = None,
                 accuracy: Union[str, float, None] = None):
        path = Path(file)
        #: The case file.
        self.file: Path = path / "case.toml" if path.is_dir() else path
        self._settings: dict[str, str] = {}
        self._accuracy: float | None = None
        for key, value in (settings or {}).items():
            self.set(key, value)
        if accuracy == "instant":
            self.set("accuracy.instant", True)
        elif isinstance(accuracy, str):
            self._accuracy = _plyform.preset_error(accuracy)
            if self._accuracy <= 0.0:
                raise ValueError(f"accuracy {accuracy!r} is none of instant, draft, standard, reference")
        elif accuracy is not None:
            self._accuracy = float(accuracy)

    def set(self, key: str, value: Value) -> None:
        """Changes a key, a dotted path with list items by name or number: `tool.punch.stroke`; units of the
        file.

        What cannot be is found by `check`. Raises TypeError for values that TOML does not have, and for
        a key that is no text.
        """
        text = _toml(value)
        key = _word(key)
        self._settings.pop(key, None)  # the last one counts
        self._settings[key] = text

    def get(self, key: str) -> Value:
        """The value that the case has for a key, as `set` takes it: the file's, one that was set,
        the default, or as picked for the accuracy asked for. Tables are dicts.

        None if a key that has no default is not given: `keys()` says what holds then. Raises
        KeyError for a key that does not exist, TypeError for one that is no text.
        """
        return _plyform.value_of(self.file, self._overrides(), _word(key))

    @property
    def settings(self) -> dict[str, str]:
        """What was set, by key, as TOML."""
        return dict(self._settings)

    def check(self, quick: bool = False) -> Check:
        """Checks the case and the scene that it makes. Raises nothing for what is wrong in it. quick:
        with the largest elements where mesh_from = "scene" takes a fast run to find smaller ones,
        unless they are known from before.
        """
        found = self._prepare(quick)
        return Check(found.mistakes, found.warnings, found.notes, found.assumed)

    def outlook(self, threads: int | None = None, quick: bool = False) -> Outlook:
        """What will be modelled, the stable step, and about how long a run takes, from some steps
        of it; threads: as many as there are cores unless given; quick: as of check. Raises CaseError.
        """
        return _plyform.look_ahead(self._prepare(quick), threads or 0)

    def scene(self, threads: int | None = None) -> Scene:
        """The case as it will stand before the first step, and how its tools will move: for a
        picture. Fast, and of a file with mistakes all that can be told: other parts have a
        `trouble`. Raises nothing for what is wrong in it. threads: as many as there are cores
        unless given.
        """
        return _plyform.preview(self.file, self._overrides(), threads or 0)

    def _overrides(self) -> list[tuple[str, str]]:
        accuracy = [] if self._accuracy is None else [("accuracy.shear_deg", _toml(self._accuracy))]
        return [*self._settings.items(), *accuracy]

    def _prepare(self, quick: bool = False) -> _plyform.Prepared:
        return _plyform.prepare(self.file, self._overrides(), quick)

    def __repr__(self) -> str:
        return f"<Case {self.file}>"


def predicted_error(case: Case) -> PredictedError:
    """How far the shear angles will be from those of a converged run, as predicted from the cost
    parameters: degrees, rms over all plies, by cause. NaN without a stroke. Raises CaseError.
    """
    return case._prepare().predicted_error
