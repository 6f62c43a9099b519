"""Where each input of a model is from."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any, Literal, NamedTuple

Origin = Literal["given", "inferred", "assumed"]


class InputNote(NamedTuple):
    """One input of a model and where its value is from.

    `value` is in `unit`; `why` is empty where the file gives a value that is plausible.
    """

    field: str  # dotted name in the file
    value: Any
    unit: str
    origin: Origin
    why: str

    @property
    def value_text(self) -> str:
        """The value as a table shows it."""
        return _text(self.value)


def _text(value: Any) -> str:
    if isinstance(value, tuple | list):
        return ", ".join(_text(one) for one in value) or "none"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def notes_as_text(notes: Sequence[InputNote]) -> str:
    """Return notes as one text, for an attribute of a dataset."""
    return json.dumps([[n.field, n.value_text, n.unit, n.origin, n.why] for n in notes])
