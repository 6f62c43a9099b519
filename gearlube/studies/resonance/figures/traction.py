"""Traction map and traction curves of the flank contacts."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import GREY, SERIES, house_style, new_figure
from gearlube_core.friction.traction_regime import NEWTONIAN_LIMIT, largest_stress_ratio

_CURVES = {
    "thermal_eyring": ("thermal Eyring", "-", 2.0),
    "isothermal_eyring": ("isothermal Eyring", "--", 1.2),
    "thermal_newtonian": ("thermal Newtonian", "-.", 1.2),
    "isothermal_newtonian": ("isothermal Newtonian", ":", 1.2),
}


def case_label(cycle: xr.Dataset, case: int) -> str:
    """Return "0.3 of natural, 40 °C"."""
    relative = float(cycle["case_relative_frequency"][case])
    return f"{relative:g} $f_n$, {float(cycle['case_oil_temperature'][case]) - 273.15:.0f} °C"


def traction_map(cycle: xr.Dataset) -> Any:
    """Return all contacts of the cycles on the traction map.

    Compare [karagiannis_2012 fig. 15], after [evans_johnson_1986].
    """
    with house_style():
        figure = new_figure(8.0, 5.6)
        ax = figure.subplots()
        tau0 = cycle.attrs["eyring_stress"]
        for case in range(cycle.sizes["case"]):
            part = cycle.isel(case=case)
            ax.scatter(
                part["film_number"].values.ravel(),
                part["pressure_number"].values.ravel(),
                s=5.0,
                color=SERIES[case],
                label=case_label(cycle, case),
                zorder=3,
            )
        low = min(0.0, float(np.nanmin(cycle["film_number"]))) - 1.5
        high = float(np.nanmax(cycle["film_number"])) + 2.5
        top = max(1.25 * float(np.nanmax(cycle["pressure_number"])), 6.0)
        x = np.array([low, high])
        ax.fill_between(x, 0.0, NEWTONIAN_LIMIT - x, color=GREY, alpha=0.3, lw=0)
        ax.plot(x, NEWTONIAN_LIMIT - x, color="black", lw=1.2)
        for number in range(0, 40, 2):
            ax.plot(x, number - x, color=GREY, lw=0.8, zorder=1)
            place = number - 0.93 * top
            if low < place < high:
                stress = 1e-6 * tau0 * largest_stress_ratio(float(number))
                ax.text(
                    place,
                    0.93 * top,
                    f"{stress:.0f}",
                    fontsize=8.0,
                    ha="center",
                    bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8},
                )
        ax.text(low + 0.1, 0.35 * top, "Newtonian:\nheat limits\ntraction")
        ax.set(
            xlim=(low, high),
            ylim=(0.0, top),
            xlabel=r"film number $\ln[2K\eta_0/(\beta\tau_0^2h^2)]$",
            ylabel=r"pressure number $\ln(\eta/\eta_0)$",
            title=f"lines: largest shear stress of a film [MPa]; Eyring stress {1e-6 * tau0:g} MPa",
        )
        ax.legend(loc="lower right", markerscale=3.0, frameon=True, framealpha=1.0)
        figure.suptitle("Contacts over the mesh cycle on the traction map", fontsize=11.5)
    return figure


def traction_curves(cycle: xr.Dataset) -> Any:
    """Return traction and viscosity against shear rate of the hardest loaded contacts.

    Compare [karagiannis_2012 fig. 19].
    """
    with house_style():
        figure = new_figure(9.6, 4.8)
        left, right = figure.subplots(1, 2)
        rate = cycle["curve_shear_rate"].values
        for case in range(cycle.sizes["case"]):
            part = cycle.isel(case=case)
            colour, pressure = SERIES[case], float(part["curve_pressure"])
            for name, (_, style, width) in _CURVES.items():
                stress = part["curve_stress"].sel(curve=name).values / pressure
                left.plot(rate, stress, color=colour, ls=style, lw=width)
            stress = part["curve_stress"].sel(curve="thermal_eyring").values
            right.plot(rate, part["curve_effective_viscosity"], color=colour, lw=2.0)
            right.plot(rate, stress / rate, color=colour, ls="--", lw=1.2)
            states = {name: part[name].values.ravel() for name in ("shear_rate", "shear_stress")}
            at = states["shear_rate"]
            left.plot(
                at,
                states["shear_stress"] / part["mean_pressure"].values.ravel(),
                ".",
                color=colour,
                ms=2.5,
                alpha=0.5,
            )
            right.plot(
                at, part["effective_viscosity"].values.ravel(), ".", color=colour, ms=2.5, alpha=0.5
            )
            left.plot(
                [], [], color=colour, label=f"{case_label(cycle, case)}, {1e-9 * pressure:.2f} GPa"
            )
        for label, style, width in _CURVES.values():
            left.plot([], [], color="#404040", ls=style, lw=width, label=label)
        left.plot([], [], ".", color="#404040", label="contacts over the cycle")
        right.plot([], [], color="#404040", lw=2.0, label="effective, heat alone")
        right.plot([], [], color="#404040", ls="--", label="stress over shear rate")
        left.set(xscale="log", xlabel="shear rate [1/s]", ylabel="shear stress / mean pressure")
        highest = cycle["curve_stress"].sel(curve="isothermal_eyring") / cycle["curve_pressure"]
        left.set_ylim(0.0, 1.2 * float(highest.max()))
        left.legend(loc="upper left", fontsize=7.5)
        right.set(xscale="log", yscale="log", xlabel="shear rate [1/s]", ylabel="viscosity [Pa s]")
        right.legend(loc="lower left")
        figure.suptitle(
            "Film of the most heavily loaded contact at other shear rates", fontsize=11.5
        )
    return figure
