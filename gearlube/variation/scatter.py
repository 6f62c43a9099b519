"""Scatter from part to part: the tolerances of an input file as spreads."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from gearlube.variation.design import Spread
from gearlube.variation.keys import understood
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.input_file import InputFile
from gearlube_core.input_file.tolerance import Tolerance, Tolerances

if TYPE_CHECKING:  # which imports this module's sibling
    from gearlube.variation.point_study import PointStudy

_DEVIATIONS = 3.0  # that a tolerance of a normal distribution is: process capability Cp = 1


def scatter_of(
    name: str, tolerances: Mapping[str, Tolerance], values: Mapping[str, Any]
) -> tuple[Spread, ...]:
    """Return the spreads of a file's tolerances about the values of its fields.

    Parameters
    ----------
    name : str
        Of the file's subject.
    tolerances : mapping
        Tolerance of each dotted field.
    values : mapping
        Of the fields, defaults included.

    Raises
    ------
    ParameterError
        There are no tolerances, or a field has no value to scatter about.
    """
    if not tolerances:
        raise ParameterError(
            f"--scatter needs [tolerances] in the file, got none in the file of {name}. Add "
            "a field and its width, for instance gear_set.backlash_um = { plus_minus = 30.0 }."
        )
    spreads = []
    for field, tolerance in tolerances.items():
        value = values.get(field)
        if not isinstance(value, int | float):
            raise ParameterError(
                f"The tolerance of {field} needs a value to scatter about, got none: {name} does "
                "not use this field. Give it in the file, or remove its tolerance."
            )
        spreads.append(spread_about(field, float(value), tolerance))
    return tuple(spreads)


class ToleranceFile(InputFile):
    """Tolerances of any parameters of a study, fields of its file or not."""

    title: ClassVar[str] = "tolerance file"
    package: ClassVar[str] = "gearlube.variation"

    tolerances: Tolerances


def spreads_in(path: str | Path, study: PointStudy) -> tuple[Spread, ...]:
    """Return the spreads of a tolerance file about the values of a study.

    Raises
    ------
    ParameterError
        The file is wrong, or names a parameter without its unit or one that the study has not.
    """
    tolerances = ToleranceFile.from_toml(path).tolerances
    for name in tolerances:
        if (key := understood(name, study.keys, f"[tolerances] of {path}")).name != name:
            raise ParameterError(
                f"[tolerances] of {path} must name parameters with their unit, got {name}. Write "
                f"{key.name} [{key.unit}]."
            )
        if key.kind != "number":
            raise ParameterError(
                f"[tolerances] of {path} must name numbers, but {name} is a {key.kind}. Remove it."
            )
    return scatter_of(study.subject, tolerances, study.values())


def values_of(data: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Return the values of nested tables by dotted name.

    Examples
    --------
    >>> values_of({"pair": {"offset_mm": 24.0}})
    {'pair.offset_mm': 24.0}
    """
    found: dict[str, Any] = {}
    for key, value in data.items():
        whole = f"{prefix}{key}"
        found |= values_of(value, f"{whole}.") if isinstance(value, Mapping) else {whole: value}
    return found


def spread_about(name: str, value: float, tolerance: Tolerance) -> Spread:
    """Return the spread of a field about a value."""
    if tolerance.standard_deviation is not None:
        deviation = tolerance.standard_deviation
        return Spread(key=name, low=-math.inf, high=math.inf, mean=value, deviation=deviation)
    width = tolerance.plus_minus
    if tolerance.plus_minus_percent is not None:
        width = 0.01 * tolerance.plus_minus_percent * abs(value)
    if not width:
        raise ParameterError(
            f"The tolerance of {name} must be above 0, got a percentage of 0. Give plus_minus."
        )
    ends = {"low": value - width, "high": value + width}
    if tolerance.distribution == "uniform":
        return Spread(key=name, **ends)
    return Spread(key=name, **ends, mean=value, deviation=width / _DEVIATIONS)
