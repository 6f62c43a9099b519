"""Conversions between everyday units and SI units."""

from __future__ import annotations

import math
from typing import Any

ZERO_CELSIUS = 273.15  # K
MILLIMETRE = 1e-3  # m
DEGREE = math.pi / 180.0  # rad


def celsius_to_kelvin(temperature_degc: float) -> float:
    """Return the absolute temperature [K] for `temperature_degc` [degC].

    Examples
    --------
    >>> celsius_to_kelvin(95.0)
    368.15
    """
    return temperature_degc + ZERO_CELSIUS


def kelvin_to_celsius(temperature: float) -> float:
    """Return the Celsius temperature [degC] of `temperature` [K]."""
    return temperature - ZERO_CELSIUS


def kmh_to_ms(speed_kmh: float) -> float:
    """Return the speed [m/s] of `speed_kmh` [km/h]."""
    return speed_kmh / 3.6


def rpm_to_rads(speed_rpm: float) -> float:
    """Return the angular speed [rad/s] for `speed_rpm` [1/min].

    Examples
    --------
    >>> round(rpm_to_rads(3000.0), 2)
    314.16
    """
    return speed_rpm * math.pi / 30.0


def rads_to_rpm(speed: float) -> float:
    """Return the rotational speed [1/min] of `speed` [rad/s]."""
    return speed * 30.0 / math.pi


def labelled(
    dimensions: Any, values: Any, unit: str, words: str
) -> tuple[Any, Any, dict[str, str]]:
    """Return a variable of a dataset: its dimensions, its values, and what they are.

    Examples
    --------
    >>> labelled("time", [0.0, 0.1], "s", "time since the start")
    ('time', [0.0, 0.1], {'units': 's', 'long_name': 'time since the start'})
    """
    return dimensions, values, {"units": unit, "long_name": words}
