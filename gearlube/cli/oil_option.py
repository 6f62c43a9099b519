"""The oil of a command line and its temperature."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlube_core.checks import check_within
from gearlube_core.units import celsius_to_kelvin, kelvin_to_celsius

if TYPE_CHECKING:
    from gearlube_core.oil.lubricant import Lubricant


def oil_kelvin(
    oil_temperature: float, oil: str | Lubricant, option: str = "--oil-temperature"
) -> float:
    """Return the temperature of `option` [degC] in kelvin, checked against the oil's data.

    The oil is one of the library by its name, or any other.

    Examples
    --------
    >>> round(oil_kelvin(95.0, "mohammadpour_2015"), 2)
    368.15
    """
    from gearlube_core.oil.lubricant import Lubricant  # help does without NumPy

    data = Lubricant.named(oil) if isinstance(oil, str) else oil
    low, high = kelvin_to_celsius(data.temperature_low), kelvin_to_celsius(data.temperature_high)
    cure = f"The data of {data.name} are meant for this range.{kelvin_hint(oil_temperature)}"
    # limits that are whole numbers in kelvin plus 0.15 come out with roundings
    check_within(option, oil_temperature, round(low, 9), round(high, 9), "degC", cure)
    return celsius_to_kelvin(oil_temperature)


def kelvin_hint(degc: float) -> str:
    """Return a question with a space before it, if a temperature [degC] looks like kelvin.

    >>> kelvin_hint(353.15)
    ' Is it in K? 353.15 K is 80 degC.'
    """
    usual = 0.0 <= kelvin_to_celsius(degc) <= 150.0
    return f" Is it in K? {degc:g} K is {kelvin_to_celsius(degc):g} degC." if usual else ""
