"""Scatter from part to part: the tolerances of an axle file as spreads."""

from __future__ import annotations

import math

from gearlube.variation.design import Spread
from gearlube.variation.file_variants import AxleVariants
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
        raise ParameterError(
            f"--scatter needs [tolerances] in the axle file, got none in {axle.file.name}. Write "
            "for instance gear_set.backlash_um = { plus_minus = 30.0 } there."
        )
    values = {note.field: note.value for note in axle.car_axle({}, notes=True).inputs}
    spreads = []
    for name, tolerance in tolerances.items():
        value = values.get(name)
        if not isinstance(value, int | float):
            raise ParameterError(
                f"The tolerance of {name} needs a value to scatter about, got none: the axle does "
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
