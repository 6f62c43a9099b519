"""A table of traction to start from, computed for an oil that ships with the package."""

from __future__ import annotations

from gearlube_core.friction.traction_curve import film_point, traction_coefficient
from gearlube_core.friction.traction_fit import steel_on_steel
from gearlube_core.oil.lubricant_state import lubricant_state
from gearlube_core.oil.oil_file import read_oil
from gearlube_core.units import celsius_to_kelvin

OIL = "iso_vg_220_pao"
RADIUS = 0.01  # m
EYRING_STRESS = 5e6  # Pa, what a fit must find
_SPEED = 3.0  # m/s
_PRESSURE = 0.8e9  # Pa, mean of a circular contact
_DEGC = (60.0, 80.0)
_SLIPS = (0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.4)


def example_text() -> str:
    """Return the text of a CSV file for `read_traction`: 14 points on two curves."""
    parameters, pair = read_oil(OIL).lubricant.parameters(), steel_on_steel()
    lines = [
        "slide_roll_ratio,entrainment_speed_m_s,mean_pressure_gpa,temperature_degc,"
        "traction_coefficient"
    ]
    for degc in _DEGC:
        for slip in _SLIPS:
            point = film_point(
                lubricant_state(parameters, celsius_to_kelvin(degc)),
                pair,
                contact="point",
                radius=RADIUS,
                entrainment_speed=_SPEED,
                sliding_speed=slip * _SPEED,
                mean_pressure=_PRESSURE,
            )
            found = traction_coefficient(point, EYRING_STRESS, float("inf"))
            lines.append(f"{slip:g},{_SPEED:g},{_PRESSURE * 1e-9:g},{degc:g},{found:.5f}")
    return "\n".join(lines) + "\n"
