"""Inputs of a report from what input files know of their fields."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from gearlube.report.numbers import unit_words
from gearlube.report.parts import ASSUMED, GIVEN, INFERRED, NOTE, WARNING, Finding, Input
from gearlube_core.input_file.field_notes import field_notes
from gearlube_core.input_file.input_file import InputFile, InputNote

try:  # newer versions of typer have a click of their own
    from typer._click.globals import get_current_context
except ImportError:
    from click import get_current_context  # type: ignore[no-redef, assignment]


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

    Fields that are empty, lists of tables or about the file itself are left out. A gear file gives
    itself which fields are inferred or completed.

    Examples
    --------
    >>> from gearlube_core.bearings.bearing_file import BearingFile
    >>> found = {one.name: one for one in file_inputs(BearingFile.named("wingertszahn_2023"))}
    >>> found["bearing.rollers"].origin
    'given'
    """
    notes = field_notes(type(file))
    unusual = file.unusual_numbers()
    given = dict(_flat(file.model_dump(exclude_unset=True)))
    found = []
    for name, value in _flat(file.model_dump(exclude_none=True, exclude=_OF_THE_FILE)):
        text = _text(value)
        if not text:
            continue
        origin, why = (GIVEN, unusual.get(name, "")) if name in given else (ASSUMED, "default")
        for kind, field in ((INFERRED, "inferred"), (ASSUMED, "completed")):
            reasons = getattr(file, field, {})
            for one in reasons:
                if name == one or name.startswith(f"{one}."):
                    origin, why = kind, reasons[one] if isinstance(reasons, Mapping) else ""
        unit = unit_words(notes[name].unit) if name in notes else ""
        found.append(Input(name, text, unit, origin, why))
    return found


def remark_attributes(file: InputFile) -> dict[str, str]:
    """Return the remarks and guesses of an input file that a dataset keeps, a line each."""
    return {"remarks": "\n".join(file.remarks()), "guessed": "\n".join(file.guesses())}


def remark_findings(attributes: Mapping[str, Any]) -> list[Finding]:
    """Return the findings in `remark_attributes`, headline and detail parted at the first stop.

    They are for reports: the terminal has them from reading the file.

    Examples
    --------
    >>> remark_findings({"guessed": "x is guessed: 0.1. Give it."})[0].headline
    'x is guessed: 0.1.'
    """
    found = []
    for level, name in ((WARNING, "remarks"), (NOTE, "guessed")):
        for sentences in str(attributes.get(name, "")).splitlines():
            headline, _, detail = sentences.partition(". ")
            found.append(Finding(level, f"{headline.removesuffix('.')}.", detail))
    return found


_OF_THE_FILE = {"name", "source", "compared_with", "inferred", "completed", "tolerances"}


def stored_inputs(attributes: Mapping[Any, Any], *names: str) -> list[Input]:
    """Return the inputs in attributes of a dataset, see `notes_as_text`; attributes may lack."""
    return [Input(*row) for name in names for row in json.loads(str(attributes.get(name, "[]")))]


OF_AXLE = GIVEN, "axle file or its default"  # what an option replaces


def origin_of(*options: str, otherwise: tuple[str, str] = (ASSUMED, "default")) -> tuple[str, str]:
    """Return origin and reason of an input that options of the running command set.

    `options` are the names of their parameters, `otherwise` holds where none was typed. Without a
    command all settings count as given, by the call.
    """
    context = get_current_context(silent=True)
    if context is None:
        return GIVEN, "setting"
    sources = (context.get_parameter_source(one) for one in options)
    typed = any(one is not None and one.name == "COMMANDLINE" for one in sources)
    return (GIVEN, "option") if typed else otherwise


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
