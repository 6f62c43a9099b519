"""The oil of a command line and its temperature."""

from __future__ import annotations

from gearlube_core.checks import check_within
from gearlube_core.units import celsius_to_kelvin, kelvin_to_celsius


def oil_kelvin(oil_temperature: float, oil: str, option: str = "--oil-temperature") -> float:
    """Return the temperature of `option` [degC] in kelvin, checked against the oil's data.

    Examples
    --------
    >>> round(oil_kelvin(95.0, "mohammadpour_2015"), 2)
    368.15
    """
    from gearlube_core.oil.lubricant import Lubricant  # help does without NumPy

    data = Lubricant.named(oil)
    low, high = kelvin_to_celsius(data.temperature_low), kelvin_to_celsius(data.temperature_high)
    cure = f"The data of {oil} are meant for this range."
    # limits that are whole numbers in kelvin plus 0.15 come out with roundings
    check_within(option, oil_temperature, round(low, 9), round(high, 9), "degC", cure)
    return celsius_to_kelvin(oil_temperature)
