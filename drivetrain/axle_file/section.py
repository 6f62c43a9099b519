"""Base class of the sections of an axle file, and the fields of parts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import MISSING, fields
from typing import Any, ClassVar, NamedTuple

from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.field_notes import likely_fields
from gearlube_core.input_file.field_units import (
    attribute_of,
    field_value,
    from_si,
    limits_in,
    si_value,
    to_si,
    unit_ending,
    unit_of,
)
from gearlube_core.input_file.input_file import InputNote, Origin, Section
from gearlube_core.number import Number, numbers_of
from gearlube_core.part import Part


class PartField(NamedTuple):
    """A number of a part as a field of a file, which has its name with the unit."""

    name: str  # of the number
    number: Number
    unit: str  # in the file
    default: Any  # in SI units; MISSING: it must be given

    def problem(self, key: str, value: Any) -> str:
        """Return the error of a value in the file; "" for none."""
        if isinstance(value, bool | str) or not isinstance(value, float | int):
            return f"{key} must be a number, got {value!r}; {self.number.text}"
        try:
            check_within(
                key, value, *limits_in(self.unit, self.number), self.unit, self.number.cure
            )
        except ParameterError as reason:
            return str(reason).removesuffix(".")
        return ""


def part_fields(kind: type[Part]) -> dict[str, PartField]:
    """Return the numbers of a part as fields of a file, by name with unit."""
    defaults = {one.name: one.default for one in fields(kind)}
    found = {}
    for name, number in numbers_of(kind).items():
        unit = number.shown or number.unit
        found[name + unit_ending(unit)] = PartField(name, number, unit, defaults[name])
    return found


def part_numbers(kind: type[Part], data: Mapping[str, Any]) -> dict[str, float]:
    """Return the numbers that a file gives of a part, in SI units by their names.

    Raises
    ------
    ParameterError
        Names every field that is wrong, unknown or missing.
    """
    known = part_fields(kind)
    wrong = [one.problem(key, data[key]) for key, one in known.items() if key in data]
    for key in data:
        if key not in known:
            meant = " or ".join(likely_fields(key, known)) or f"one of {', '.join(known)}"
            wrong.append(f"{key} is not a number of {kind.name}; is it {meant}?")
    wrong += [
        f"{key} is missing: {one.number.text}"
        for key, one in known.items()
        if one.default is MISSING and key not in data
    ]
    if any(wrong):
        raise ParameterError(". ".join(one for one in wrong if one))
    return {one.name: to_si(one.unit, data[key]) for key, one in known.items() if key in data}


def part_notes(prefix: str, part: Part, data: Mapping[str, Any]) -> list[InputNote]:
    """Return a note on every number of a part; `data` is what the file gives of them."""
    known = part_fields(type(part))
    fields_of = {one.name: (key, one.unit) for key, one in known.items()}
    notes = []
    for note in part.notes("", [known[key].name for key in data]):
        key, unit = fields_of[note.field]
        value = from_si(unit, note.value)
        notes.append(note._replace(field=prefix + key, value=value, unit=unit))
    return notes


class ModelSection(Section):
    """A section whose fields fall back to those of a model.

    A field is named as the model's attribute with its unit, e.g. `rolling_radius_mm`; `renamed`
    holds those that are not. Fields that the file leaves out are None.
    """

    renamed: ClassVar[Mapping[str, str]] = {}  # field: attribute
    sources: ClassVar[Mapping[str, str]] = {}  # field: where its default is from

    @classmethod
    def attribute(cls, key: str) -> str:
        """Return the name of the model's attribute of a field."""
        return cls.renamed.get(key) or attribute_of(key)

    def has(self, key: str) -> bool:
        """Whether the file gives a field."""
        return getattr(self, key) is not None

    def si(self, key: str) -> Any:
        """Return the value of a given field in SI units."""
        return si_value(key, getattr(self, key))

    def changes(self, model: object) -> dict[str, Any]:
        """Return the given fields that are attributes of `model`, in SI units."""
        named = {key: self.attribute(key) for key in type(self).model_fields if self.has(key)}
        return {name: self.si(key) for key, name in named.items() if hasattr(model, name)}

    def notes(
        self, prefix: str, model: object, why: str, inferred: Mapping[str, str] | None = None
    ) -> list[InputNote]:
        """Return a note on every field that is given or an attribute of `model`.

        Parameters
        ----------
        prefix : str
            Of the dotted names, with its dot.
        model : object
            Built with this section.
        why : str
            Where the values are from that the file leaves out, if `sources` says nothing else.
        inferred : mapping of str to str
            Fields that follow from given ones, and how.
        """
        notes = []
        for key in type(self).model_fields:
            name = self.attribute(key)
            if isinstance(getattr(self, key), Section):
                continue
            if self.has(key):
                value = getattr(self, key)
                notes.append(InputNote(prefix + key, value, unit_of(key), "given", ""))
            elif hasattr(model, name) and getattr(model, name) is not None:
                value = field_value(key, getattr(model, name))
                how = (inferred or {}).get(key)
                origin: Origin = "inferred" if how else "assumed"
                reason = how or self.sources.get(key, why)
                notes.append(InputNote(prefix + key, value, unit_of(key), origin, reason))
        return notes
