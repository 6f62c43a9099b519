"""Inputs of a report from what input files know of their fields."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from gearlube.report.parts import ASSUMED, GIVEN, Input
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.input_file.input_file import InputFile
from gearlube_core.input_file.input_note import InputNote


def noted_inputs(notes: Sequence[InputNote]) -> list[Input]:
    """Return the inputs of an input file, each as given, inferred or assumed.

    Examples
    --------
    >>> (found,) = noted_inputs([InputNote("oil.density", 870.0, "kg/m3", "assumed", "usual")])
    >>> found.value, found.unit, found.origin
    ('870', 'kg/m3', 'assumed')
    """
    return [Input(n.field, n.value_text, n.unit, n.origin, n.why) for n in notes]


def file_inputs(file: InputFile) -> list[Input]:
    """Return the fields of an input file: what it gives, and the defaults of what it does not.

    Fields that are empty or lists of tables are left out.

    Examples
    --------
    >>> from gearlube_core.bearings.bearing_file import BearingFile
    >>> found = {one.name: one for one in file_inputs(BearingFile.named("wingertszahn_2023"))}
    >>> found["bearing.rollers"].origin
    'given'
    """
    notes = field_notes(type(file))
    doubtful = file.doubts()
    given = dict(_flat(file.model_dump(exclude_unset=True)))
    found = []
    for name, value in _flat(file.model_dump(exclude_none=True)):
        note = notes.get(name)
        text = _text(value)
        if not text:
            continue
        is_given = name in given
        found.append(
            Input(
                name,
                text,
                "" if note is None else note.unit,
                GIVEN if is_given else ASSUMED,
                doubtful.get(name, "") if is_given else "default",
            )
        )
    return found


def _flat(values: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    for name, value in values.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", value


def _text(value: Any) -> str:
    if isinstance(value, list | tuple):
        return (
            "" if any(isinstance(one, Mapping) for one in value) else ", ".join(map(_text, value))
        )
    return f"{value:.6g}" if isinstance(value, float) else str(value)
