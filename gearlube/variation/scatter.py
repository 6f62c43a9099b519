"""Scatter from part to part: the tolerances of a file as spreads."""

from __future__ import annotations

import math
from collections.abc import Mapping

from gearlube.variation.design import Spread
from gearlube.variation.file_variants import AxleVariants
from gearlube_core.bearings.bearing_file import BearingFile
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.tolerance import Tolerance

_DEVIATIONS = 3.0  # that a tolerance of a normal distribution is: process capability Cp = 1


def scatter_of(axle: AxleVariants) -> tuple[Spread, ...]:
    """Return the spreads of an axle file's tolerances about the values of its fields.

    A field that the file leaves out scatters about its default.

    Raises
    ------
    ParameterError
        There are no tolerances, or a field has no value to scatter about.

    Examples
    --------
    >>> file = AxleVariants.read("mohammadpour_2015").file.varied(
    ...     {"tolerances": {"gear_set.backlash_um": {"plus_minus": 30.0}}}
    ... )
    >>> scatter_of(AxleVariants(file=file))[0].deviation
    10.0
    """
    tolerances = axle.file.tolerances
    if not tolerances:
        raise _without_tolerances("axle file", axle.file.name, "gear_set.backlash_um")
    values = {note.field: note.value for note in axle.car_axle({}, notes=True).inputs}
    return _spreads(tolerances, values, "the axle")


def scatter_of_bearing(file: BearingFile) -> tuple[Spread, ...]:
    """Return the spreads of a bearing file's tolerances about the values of its fields.

    Raises
    ------
    ParameterError
        There are no tolerances, or a field has no value to scatter about.

    Examples
    --------
    >>> file = BearingFile.named("wingertszahn_2023").varied(
    ...     {"tolerances": {"rib.contact_height_mm": {"plus_minus": 0.3}}}
    ... )
    >>> scatter_of_bearing(file)[0].mean
    2.5
    """
    if not file.tolerances:
        raise _without_tolerances("bearing file", file.name, "rib.contact_height_mm")
    values = {}
    for name in file.tolerances:
        section, _, key = name.rpartition(".")
        values[name] = getattr(getattr(file, section) if section else file, key)
    return _spreads(file.tolerances, values, "the bearing")


def _without_tolerances(title: str, name: str, field: str) -> ParameterError:
    return ParameterError(
        f"--scatter needs [tolerances] in the {title}, got none in {name}. Write for instance "
        f"{field} = {{ plus_minus = 0.3 }} there."
    )


def _spreads(
    tolerances: Mapping[str, Tolerance], values: Mapping[str, object], user: str
) -> tuple[Spread, ...]:
    spreads = []
    for name, tolerance in tolerances.items():
        value = values.get(name)
        if not isinstance(value, int | float):
            raise ParameterError(
                f"The tolerance of {name} needs a value to scatter about, got none: {user} does "
                "not use this field. Give it in the file, or take its tolerance away."
            )
        spreads.append(spread_about(name, float(value), tolerance))
    return tuple(spreads)


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
