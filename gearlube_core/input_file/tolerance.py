"""Tolerances of the fields of an input file: how they scatter from part to part."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, model_validator

from gearlube_core.input_file.field_notes import FieldNote, likely_fields
from gearlube_core.input_file.input_file import Section

Width = Annotated[float, Field(gt=0.0, le=1e12, allow_inf_nan=False)]
Percent = Annotated[float, Field(gt=0.0, le=100.0, allow_inf_nan=False)]
_WIDTHS = ("plus_minus", "plus_minus_percent", "standard_deviation")
_NUMBERS = ("number",)


class Tolerance(Section):
    """How one field scatters about its value, in the unit of the field.

    Examples
    --------
    >>> Tolerance(plus_minus=30.0, distribution="uniform").plus_minus
    30.0
    """

    plus_minus: Width | None = Field(
        default=None, description="Half of the tolerance range: value plus and minus this"
    )
    plus_minus_percent: Percent | None = Field(
        default=None, description="The same as a percentage of the value [%]"
    )
    standard_deviation: Width | None = Field(
        default=None, description="Standard deviation of a normal distribution without limits"
    )
    distribution: Literal["normal", "uniform"] = Field(
        default="normal",
        description="normal: the tolerance is three standard deviations, and parts outside it "
        "are rejected; uniform: all values within it are equally likely",
    )

    @model_validator(mode="after")
    def _check_width(self) -> Tolerance:
        given = [name for name in _WIDTHS if getattr(self, name) is not None]
        if len(given) != 1:
            got = ", ".join(given) or "none"
            raise ValueError(f"one of {', '.join(_WIDTHS)} must be given, got {got}")
        if self.standard_deviation is not None and self.distribution == "uniform":
            raise ValueError(
                "a uniform distribution must have plus_minus, got standard_deviation; its half "
                "width is 1.732 standard deviations"
            )
        return self


def _flat(data: Any, prefix: str = "") -> Any:
    """Return tables in tables as dotted names, so that names need no quotes in the file."""
    if not isinstance(data, dict):
        return data
    found: dict[str, Any] = {}
    for name, entry in data.items():
        whole = f"{prefix}{name}"
        if not isinstance(entry, dict):
            raise ValueError(
                f"{whole} must be a table such as {{ plus_minus = 30.0 }}, got {entry!r}"
            )
        own = not entry or any(key in Tolerance.model_fields for key in entry)
        found |= {whole: entry} if own else _flat(entry, f"{whole}.")
    return found


Tolerances = Annotated[
    dict[str, Tolerance],
    BeforeValidator(_flat),
    Field(description="Scatter of fields from part to part, by their dotted names"),
]


def check_tolerances(tolerances: Mapping[str, Tolerance], fields: Mapping[str, FieldNote]) -> None:
    """Raise ValueError where a tolerance is not of a field that is a number."""
    numbers = [name for name, note in fields.items() if note.kind in _NUMBERS]
    for name in tolerances:
        if name not in numbers:
            near = likely_fields(name, numbers)
            cure = f"is it {near[0]}" if near else "write its whole name, with sections and unit"
            raise ValueError(f"tolerances must name fields that are numbers, got {name}; {cure}")
