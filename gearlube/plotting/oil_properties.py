"""Figure of an oil's properties over temperature and pressure."""

from __future__ import annotations

from typing import Any

import numpy as np

from gearlube.plotting.style import BLUE, GREY, ORANGE, VERMILLION, house_style, new_figure
from gearlube_core.oil.film_oil import viscosity
from gearlube_core.oil.film_oil_data import film_oil_of
from gearlube_core.oil.oil_file import DescribedOil
from gearlube_core.oil.property_table import property_table
from gearlube_core.units import celsius_to_kelvin

_MEASURED = 0.5  # GPa, where measurements of the classes of base oils end
_HIGHEST = 1.5  # GPa
_CURVES = ((40.0, BLUE), (80.0, ORANGE), (120.0, VERMILLION))  # degC


def properties_figure(oil: DescribedOil) -> Any:
    """Return viscosity, density, pressure-viscosity coefficient, and viscosity over pressure."""
    rows = property_table(oil, 61)
    degc = [row.degc for row in rows]
    factor = oil.lubricant.alpha_factor
    alpha = [1e9 * row.alpha for row in rows]
    with house_style():
        figure = new_figure(9.0, 7.0)
        (ambient, density), (pressure, under) = figure.subplots(2, 2)
        ambient.plot(degc, [1e6 * row.nu for row in rows], color=BLUE)
        ambient.set(ylabel="kinematic viscosity [mm²/s]", yscale="log")
        density.plot(degc, [row.density for row in rows], color=BLUE)
        density.set(ylabel="density [kg/m³]")
        if factor is not None:
            low, high = [one / factor for one in alpha], [one * factor for one in alpha]
            pressure.fill_between(
                degc, low, high, color=GREY, alpha=0.4, lw=0.0, label=f"factor {factor:g}, k = 2"
            )
        pressure.plot(degc, alpha, color=BLUE)
        pressure.set(ylabel="pressure-viscosity coefficient [1/GPa]")
        pressure.set_ylim(bottom=0.0)
        if factor is not None:
            pressure.legend()
        _viscosity_over_pressure(under, oil)
        for axes in (ambient, density, pressure):
            axes.set_xlabel("temperature [°C]")
        figure.suptitle(oil.name, fontsize=11.5)
    return figure


def _viscosity_over_pressure(axes: Any, oil: DescribedOil) -> None:
    """Draw the viscosity over pressure, dashed beyond the pressures of the measurements."""
    lubricant = oil.lubricant
    pressures = np.linspace(0.0, _HIGHEST, 61)
    for degc, color in _CURVES:
        kelvin = celsius_to_kelvin(degc)
        if not lubricant.temperature_low <= kelvin <= lubricant.temperature_high:
            continue
        of_film = film_oil_of(lubricant, kelvin)
        eta = np.array([viscosity(of_film, 1e9 * p) for p in pressures])
        known = pressures <= _MEASURED
        axes.plot(pressures[known], eta[known], color=color, label=f"{degc:.0f} °C")
        axes.plot(pressures[~known], eta[~known], color=color, ls="--")
    axes.set(xlabel="pressure [GPa]", ylabel="viscosity [Pa s]", yscale="log")
    axes.axvspan(_MEASURED, _HIGHEST, color=GREY, alpha=0.15, lw=0.0)
    axes.text(_MEASURED, axes.get_ylim()[0], " beyond measurements", va="bottom", fontsize=8.5)
    axes.legend()
