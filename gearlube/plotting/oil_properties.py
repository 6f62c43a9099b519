"""Figure of an oil's properties over temperature."""

from __future__ import annotations

from typing import Any

from gearlube.plotting.style import BLUE, GREY, house_style, new_figure
from gearlube_core.oil.oil_file import DescribedOil
from gearlube_core.oil.property_table import property_table


def properties_figure(oil: DescribedOil) -> Any:
    """Return viscosity, density and pressure-viscosity coefficient over temperature."""
    rows = property_table(oil, 61)
    degc = [row.degc for row in rows]
    factor = oil.lubricant.alpha_factor
    alpha = [1e9 * row.alpha for row in rows]
    with house_style():
        figure = new_figure(10.5, 3.6)
        viscosity, density, pressure = figure.subplots(1, 3)
        viscosity.plot(degc, [1e6 * row.nu for row in rows], color=BLUE)
        viscosity.set(ylabel="kinematic viscosity [mm²/s]", yscale="log")
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
        for axes in (viscosity, density, pressure):
            axes.set_xlabel("temperature [°C]")
        figure.suptitle(oil.name, fontsize=11.5)
    return figure
