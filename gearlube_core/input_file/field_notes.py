"""Notes on the fields of a data model, for reference pages and error messages."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache
from types import MappingProxyType
from typing import Any, NamedTuple

from pydantic import BaseModel
from pydantic_core import PydanticKnownError, core_schema

from gearlube_core.input_file.field_units import (
    attribute_of,
    field_unit,
    in_other_units,
    limits_in,
    unit_of,
)
from gearlube_core.number import Number, numbers_of

_ENTRY = re.compile(r"(\.\d+)+$")  # of a list, in the path of an error
_LIMITS = ("greater_than", "greater_than_equal", "less_than", "less_than_equal")
_KINDS = {
    "number": "number",
    "integer": "whole number",
    "boolean": "true or false",
    "string": "text",
    "array": "list",
    "object": "table",
}


@dataclass(frozen=True, slots=True)
class Usual:
    """Mark of a field's type: between which values the field usually lies, in its unit.

    Outside them a number is allowed, but unusual. 0 and signs are never unusual, unless `low` is
    below 0.
    """

    low: float
    high: float

    def __get_pydantic_json_schema__(self, core: Any, handler: Any) -> Any:
        return handler(core) | {"usual": (self.low, self.high)}


@dataclass(frozen=True, slots=True)
class OneOf:
    """Mark of a text field: one of the names of a registry, asked for when a file is read."""

    names: Callable[[str], Iterable[str]]  # takes the name that is wanted, "" for none

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> Any:
        return core_schema.no_info_after_validator_function(self._check, handler(source))

    def __get_pydantic_json_schema__(self, core: Any, handler: Any) -> Any:
        return handler(core) | {"enum": list(self.names(""))}

    def _check(self, value: str) -> str:
        if value not in (names := list(self.names(value))):
            raise PydanticKnownError("literal_error", {"expected": " or ".join(names)})
        return value


@dataclass(frozen=True)
class Declared:
    """Mark of a field's type: its limits are those of a number, or of one that a model declares."""

    model: type | Number
    field: str
    number: str = ""  # name in the model, where it is not that of the field without its unit

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> Any:
        number = self.model
        if not isinstance(number, Number):
            number = numbers_of(number)[self.number or attribute_of(self.field)]
        low, high = limits_in(unit_of(self.field), number)
        if source is int:
            return core_schema.int_schema(ge=int(low), le=int(high))
        return core_schema.float_schema(ge=low, le=high, allow_inf_nan=False)


# shares of equal letters, as difflib has them, from which a word or a whole name is the same
_SAME_WORD, _SAME_LETTERS = 0.75, 0.9


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
    usual: tuple[float, float] | None = None

    def warning(self, value: object) -> str:
        """Return why a number of the field is hardly meant, as a sentence; "" for nothing."""
        if isinstance(value, tuple | list):
            return next((said for one in value if (said := self.warning(one))), "")
        if self.usual is None or not isinstance(value, float | int) or not value:
            return ""
        low, high = self.usual
        if self._is_usual(value):
            return ""
        meant = self._usualin_other_units(value)
        question = (
            _question(value, *meant, self.unit) if meant else " Check the number and its unit."
        )
        return (
            f"{self.name} = {value:g} {self.unit} is unusual; {low:g} to {high:g} {self.unit} is "
            f"usual.{question}"
        )

    def hint(self, error: Any) -> str:
        """Return in which unit a number out of range would be usual, or within it."""
        value, context = error["input"], error.get("ctx", {})
        bounds = [context.get(name) for name in ("ge", "gt", "le", "lt")]
        if error["type"] not in _LIMITS or not isinstance(value, float | int) or value <= 0.0:
            return ""
        if self.usual is not None:
            meant = self._usualin_other_units(value)
            return _question(value, *meant, self.unit) if meant else ""
        bound = next(float(one) for one in bounds if one is not None)
        rises = error["type"].startswith("greater")
        for other, converted in in_other_units(self.unit, value):
            if (converted > value) == rises and (converted > bound) == rises:
                return _question(value, other, converted, self.unit)
        return ""

    def _is_usual(self, number: float) -> bool:
        low, high = self.usual or (math.inf, math.inf)
        return low <= (number if low < 0.0 else abs(number)) <= high

    def _usualin_other_units(self, value: float) -> tuple[str, float] | None:
        meant = in_other_units(self.unit, value)
        return next((one for one in meant if self._is_usual(one[1])), None)


@cache
def field_notes(model: type[BaseModel]) -> dict[str, FieldNote]:
    """Return the notes of all fields of a model and its sections, by dotted name, in order."""
    return notes_of_schema(model.model_json_schema())


def notes_of_schema(schema: Mapping[str, Any]) -> dict[str, FieldNote]:
    """Return the notes of all fields in the JSON schema of a model, by dotted name, in order."""
    return dict(_walk(schema, schema.get("$defs", {}), ""))


def unusual_numbers(
    data: Mapping[str, Any], notes: Mapping[str, FieldNote], prefix: str = ""
) -> dict[str, str]:
    """Return the numbers in the data of a file that are hardly meant: sentences by dotted name."""
    found: dict[str, str] = {}
    for key, value in data.items():
        name = f"{prefix}{key}"
        if isinstance(value, Mapping):
            found |= unusual_numbers(value, notes, f"{name}.")
        elif name in notes and (warning := notes[name].warning(value)):
            found[name] = warning
    return found


def sentence(
    error: Any, notes: dict[str, FieldNote], unmodelled: Mapping[str, str] = MappingProxyType({})
) -> str:
    """Return a pydantic error as a sentence: field, allowed value, given value.

    `unmodelled` has, by words in unknown fields and values, the reason why no such field exists.
    """
    field = ".".join(str(part) for part in error["loc"])
    whole = _ENTRY.sub("", field)
    kind, note = error["type"], notes.get(whole)
    if kind == "value_error":
        said = str(error["ctx"]["error"])
        return f"{f'{field}: ' if field else ''}{said}{'' if said.endswith('?') else '.'}"
    if kind == "missing":
        needed = [n for n, one in notes.items() if n.startswith(f"{field}.") and not one.default]
        what = note.meaning if note else f"a section with {', '.join(needed)}" if needed else ""
        if note and note.limits:
            what = f"{what} ({note.limits}{f' {note.unit}' if note.unit else ''})"
        return f"{field} is missing{f': {what}' if what else ''}."
    if kind == "extra_forbidden":
        value = error["input"] if isinstance(error["input"], str) else ""
        for word, why in unmodelled.items():
            if word in f"{field} {value}".lower():
                return f"{field} is not a field of this file: {why}."
        near = " or ".join(likely_fields(field, _like(error["input"], notes)))
        return f"{field} is not a field of this file" + (f"; is it {near}?" if near else ".")
    cure = _rewritten(kind, error["input"])
    if kind == "model_type" or (kind == "dict_type" and note is None):
        return f"{field} must be a section [{field}], got {error['input']!r}.{cure}"
    if note is None:
        return f"{field or 'The file'}: {error['msg'].lower()}, got {error['input']!r}.{cure}"
    limits = f", {note.limits}" if note.limits else ""
    unit = f" {note.unit}" if note.unit else ""
    what = note.kind if note.kind == _KINDS["boolean"] else f"a {note.kind}"
    hint = note.hint(error) or cure
    got = f"{error['input']!r}{'' if whole == field else ' in it'}"
    return f"{whole} must be {what}{limits}{unit}, got {got}. {note.meaning}.{hint}"


def likely_fields(field: str, names: Iterable[str]) -> list[str]:
    """Return the fields that a misspelt one is likely to be, the nearest first.

    A likely field has all its words, or words that read nearly the same. Letters count where words
    were joined: alone they would take profile_shift for profile_slope.
    """
    names, words = list(names), _words(field.rpartition(".")[2])
    near = [
        name
        for name in names
        if max(map(len, words)) > 1
        and all(any(_alike(word, other) for other in _words(name)) for word in words)
    ] or [name for name in names if get_close_matches(field, [name], cutoff=_SAME_LETTERS)]
    ranked = get_close_matches(field, near, n=len(near) or 1, cutoff=0.0)
    sections, keys = field.rpartition(".")[0], [name.rpartition(".")[2] for name in ranked]
    same = [name for name, key in zip(ranked, keys, strict=True) if key == keys[0]]
    own = [name for name in same if name.rpartition(".")[0] == sections]
    return own or same[:2]


def _like(value: object, notes: Mapping[str, FieldNote]) -> list[str]:
    """Return the names of all sections where the value is one, else those of all fields."""
    if not isinstance(value, dict):
        return list(notes)
    tables = [f"{name}." for name, one in notes.items() if one.kind.startswith("table")]
    parts = [name.split(".")[:-1] for name in (*notes, *tables)]
    return list(dict.fromkeys(".".join(one[: i + 1]) for one in parts for i in range(len(one))))


def _words(name: str) -> list[str]:
    """Return the words of a field, without its unit."""
    ending = field_unit(name)[1]
    return name.removesuffix(ending).replace(".", "_").split("_")


def _alike(word: str, other: str) -> bool:
    long_enough = min(len(word), len(other)) > 2
    begins = other.startswith(word) or word.startswith(other)
    close = get_close_matches(word, [other], cutoff=_SAME_WORD)
    return word == other or (long_enough and (begins or bool(close)))


def as_meant(
    data: Mapping[str, Any], errors: Sequence[Any], notes: Mapping[str, FieldNote]
) -> dict[str, Any] | None:
    """Return data with misspelt fields under the names that they are likely to have.

    None if no field is misspelt, or if it is not known what one of them is: what is missing then
    would only seem to be wrong.
    """
    changed = deepcopy(dict(data))
    unknown = [error for error in errors if error["type"] == "extra_forbidden"]
    for error in unknown:
        *sections, key = (str(part) for part in error["loc"])
        likely = likely_fields(".".join((*sections, key)), _like(error["input"], notes))
        *meant_sections, meant = likely[0].split(".") if likely else [""]
        section: Any = changed
        for part in sections:
            section = section.get(part) if isinstance(section, dict) else None
        if not isinstance(section, dict) or meant_sections != sections or meant in section:
            return None
        section[meant] = section.pop(key)
    return changed if unknown else None


def _rewritten(kind: str, value: object) -> str:
    """Return how a value of the wrong type is to be written; "" where that is not clear."""
    if kind in ("float_type", "int_type"):
        if isinstance(value, str):
            return " Write numbers without quotes, with a point as decimal mark."
        if isinstance(value, list | tuple):
            return " Give one number, without brackets."
        if isinstance(value, float) and value.is_integer():
            return f" Write {value:.0f}, without a point."
    if kind in ("tuple_type", "list_type") and not isinstance(value, dict):
        return " Write a list in brackets, such as [1.0, 2.0]."
    if kind == "string_type" and isinstance(value, bool | int | float):
        return ' Write a text in quotes, such as "name".'
    if kind == "bool_type":
        return " Write true or false, without quotes."
    if kind == "model_type" and isinstance(value, list):
        return " Write its name in single brackets."
    return ""


def _question(value: float, other: str, converted: float, unit: str) -> str:
    return f" Is it in {other}? {value:g} {other} is {converted:.6g} {unit}."


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
            unit=field_unit(key)[0],
            limits=_limits(value),
            default=_default(entry),
            meaning=entry.get("description", ""),
            usual=_usual(value),
        )
        notes.append((name, note))
    return notes


def _kind(value: Any) -> str:
    kind = _KINDS[value["type"]]
    entries = value.get("items", value.get("additionalProperties"))
    if not isinstance(entries, dict):
        return kind
    return f"{kind} of {_KINDS[entries.get('type', 'object')]}s"


def _limits(value: Any) -> str:
    if "enum" in value:
        return " or ".join(value["enum"])
    if "const" in value:
        return str(value["const"])
    low, above, high = (value.get(k) for k in ("minimum", "exclusiveMinimum", "maximum"))
    if high is None:
        return ""
    return f"{low:g} to {high:g}" if above is None else f"above {above:g} to {high:g}"


def _usual(value: Any) -> tuple[float, float] | None:
    items = value.get("items")
    return value.get("usual") or (items.get("usual") if isinstance(items, dict) else None)


def _default(entry: Any) -> str:
    if "default" not in entry:
        return ""
    value = entry["default"]
    if value is None or value in ([], {}):
        return "none"
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:g}" if isinstance(value, float) else str(value)
