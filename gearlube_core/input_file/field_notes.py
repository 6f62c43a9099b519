"""What a data model says about its fields: one list for the reference page and the errors."""

from __future__ import annotations

from difflib import get_close_matches
from functools import cache
from typing import Any, NamedTuple

from pydantic import BaseModel

_UNITS = {  # of names; where two endings fit, the first counts
    "_rpm": "rpm",
    "_n_per_um": "N/um",
    "_kn_per_rad": "kN/rad",
    "_knm_per_rad": "kN.m/rad",
    "_mm": "mm",
    "_um": "um",
    "_deg": "deg",
    "_kg": "kg",
    "_kg_mm2": "kg.mm2",
    "_n_m": "N.m",
    "_pa_s": "Pa.s",
    "_per_gpa": "1/GPa",
    "_mpa": "MPa",
}


class FieldNote(NamedTuple):
    """One field of a data model, all as text.

    `limits` is empty where any text will do, `default` where the field must be given.
    """

    name: str  # dotted
    kind: str
    unit: str
    limits: str
    default: str
    meaning: str


@cache
def field_notes(model: type[BaseModel]) -> dict[str, FieldNote]:
    """Return the notes of all fields of a model and its sections, by dotted name, in order."""
    schema = model.model_json_schema()
    return dict(_walk(schema, schema.get("$defs", {}), ""))


def sentence(error: Any, notes: dict[str, FieldNote]) -> str:
    """Return one of pydantic's findings as: which field, what it must be, what was given."""
    field = ".".join(str(part) for part in error["loc"])
    kind, note = error["type"], notes.get(field)
    if kind == "value_error":
        return f"{f'{field}: ' if field else ''}{error['ctx']['error']}."
    if kind == "missing":
        return f"{field} is missing{f': {note.meaning}' if note else ''}."
    if kind == "extra_forbidden":
        near = get_close_matches(field, notes, n=1)
        return f"{field} is not a field of this file" + (f"; is it {near[0]}?" if near else ".")
    if note is None:
        return f"{field or 'The file'}: {error['msg'].lower()}, got {error['input']!r}."
    limits = f", {note.limits}" if note.limits else ""
    unit = f" {note.unit}" if note.unit else ""
    return f"{field} must be a {note.kind}{limits}{unit}, got {error['input']!r}. {note.meaning}."


def _walk(schema: Any, sections: Any, prefix: str) -> list[tuple[str, FieldNote]]:
    notes: list[tuple[str, FieldNote]] = []
    for key, entry in schema["properties"].items():
        name = f"{prefix}{key}"
        options = entry.get("anyOf", [])
        value = next((one for one in options if one.get("type") != "null"), entry)
        if "$ref" in value:
            section = sections[value["$ref"].rsplit("/", 1)[1]]
            notes += _walk(section, sections, f"{name}.")
            continue
        note = FieldNote(
            name=name,
            kind=_kind(value),
            unit=next((unit for suffix, unit in _UNITS.items() if key.endswith(suffix)), ""),
            limits=_limits(value),
            default=_default(entry),
            meaning=entry.get("description", ""),
        )
        notes.append((name, note))
    return notes


def _kind(value: Any) -> str:
    names = {
        "number": "number",
        "integer": "whole number",
        "string": "text",
        "array": "list of texts",
        "object": "table of texts",
    }
    return names[value["type"]]


def _limits(value: Any) -> str:
    if "enum" in value:
        return " or ".join(value["enum"])
    low, above, high = (value.get(k) for k in ("minimum", "exclusiveMinimum", "maximum"))
    if high is None:
        return ""
    return f"above {above:g} to {high:g}" if low is None else f"{low:g} to {high:g}"


def _default(entry: Any) -> str:
    if "default" not in entry:
        return ""
    value = entry["default"]
    if value is None or value in ([], {}):
        return "none"
    return f"{value:g}" if isinstance(value, float) else str(value)
