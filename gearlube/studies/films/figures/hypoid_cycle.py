"""Films, pressure and friction of a hypoid flank along its engagement, formulas overlaid."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import (
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PURPLE,
    VERMILLION,
    house_style,
    new_figure,
)

_FORMULAS = {
    "central_film": (
        ("chittenden_central", "Chittenden at the entrainment's angle (axle)", VERMILLION, "-"),
        ("component_central", "Chittenden, minor-axis component", GREEN, "-"),
        ("grubin", "Grubin", PURPLE, "-"),
    ),
    "minimum_film": (
        ("chittenden_minimum", "Chittenden at the entrainment's angle (axle)", VERMILLION, "-"),
        ("component_minimum", "Chittenden, minor-axis component", GREEN, "-"),
    ),
    "pressure_max": (("hertz_pressure", "Hertz", ORANGE, "--"),),
    "traction_heated": (
        ("steady_traction_eyring", "Eyring, isothermal", GREEN, "--"),
        ("evans_johnson", "Evans-Johnson, Chittenden's film", VERMILLION, "-"),
        ("evans_johnson_roelands", "Evans-Johnson, solved film and viscosity", PURPLE, "-"),
        ("axle_friction", "axle, with asperities", ORANGE, "--"),
    ),
}
_PANELS = (
    ("central_film", 1e6, "central film [µm]"),
    ("minimum_film", 1e6, "smallest film [µm]"),
    ("pressure_max", 1e-9, "largest pressure [GPa]"),
    ("traction_heated", 1.0, "coefficient of friction [-]"),
)
_RATIOS = (
    ("chittenden_central", "steady_central_film", "Chittenden, central", VERMILLION, "-"),
    ("chittenden_minimum", "steady_minimum_film", "Chittenden, smallest", VERMILLION, "--"),
    ("component_central", "steady_central_film", "minor-axis component, central", GREEN, "-"),
    ("component_minimum", "steady_minimum_film", "minor-axis component, smallest", GREEN, "--"),
    ("grubin", "steady_central_film", "Grubin", PURPLE, "-"),
)
_SQUEEZE = (
    ("squeeze_central_film", "central film", BLUE, "-"),
    ("squeeze_minimum_film", "smallest film", BLUE, "--"),
    ("squeeze_pressure_max", "largest pressure", ORANGE, "-"),
)


def hypoid_curves(dataset: xr.Dataset) -> Any:
    """Return film, pressure and friction over the phase, steady and in time, with formulas.

    Films that did not converge are crossed out.
    """
    with house_style():
        figure = new_figure(9.6, 10.4)
        for ax, (name, factor, label) in zip(
            figure.subplots(len(_PANELS), 1, sharex=True), _PANELS, strict=True
        ):
            place = dataset["steady_phase"].values
            steady = factor * dataset[f"steady_{name}"].values
            for formula, text, colour, line in _FORMULAS[name]:
                values = factor * dataset[formula].values
                ax.plot(place, values, color=colour, ls=line, lw=1.2, label=text)
            if "phase" in dataset:
                ax.plot(
                    dataset["phase"], factor * dataset[name], color=GREY, lw=3.0, label="in time"
                )
            ax.plot(place, steady, "o", color=BLUE, ms=3.8, label="solution, steady")
            failed = dataset["steady_converged"].values == 0.0
            ax.plot(place[failed], steady[failed], "kx", ms=9.0)
            ax.set(ylabel=label, ylim=(0.0, None))
            ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), fontsize=8)
        ax.set_xlabel("phase of the pair [mesh periods]")
        figure.suptitle(_title(dataset), fontsize=11.5)
    return figure


def hypoid_ratios(dataset: xr.Dataset) -> Any:
    """Return formulas over solutions, and films in time over steady ones, along the phase."""
    with house_style():
        panels = 3 if "squeeze_central_film" in dataset else 2
        figure = new_figure(8.8, 2.9 * panels)
        axes = figure.subplots(panels, 1, sharex=True)
        place = dataset["steady_phase"].values
        for name, solved, text, colour, line in _RATIOS:
            axes[0].plot(place, dataset[name] / dataset[solved], color=colour, ls=line, label=text)
        axes[0].set_ylabel("formula over solution [-]")
        if panels == 3:
            for name, text, colour, line in _SQUEEZE:
                axes[1].plot(place, dataset[name], color=colour, ls=line, label=text)
            axes[1].set_ylabel("in time over steady [-]")
        for ax in axes[:-1]:
            ax.axhline(1.0, color=GREY, lw=0.8)
            ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), fontsize=8)
        load, angle = axes[-1], axes[-1].twinx()
        load.plot(place, 1e-3 * dataset["steady_load"], color=BLUE)
        load.set(ylabel="load [kN]", ylim=(0.0, None), xlabel="phase of the pair [mesh periods]")
        load.yaxis.label.set_color(BLUE)
        low, high = 0.0, 90.0
        for name, text, line in (("psi", "entrainment", "-"), ("chi", "sliding", "--")):
            degrees = np.degrees(dataset[f"steady_{name}"])
            angle.plot(place, degrees, color=VERMILLION, ls=line, label=text)
            low, high = min(low, float(degrees.min())), max(high, float(degrees.max()))
        angle.set(ylabel="from the minor axis [°]", ylim=(low, 1.05 * high))
        angle.legend(loc="center left", bbox_to_anchor=(1.12, 0.5), fontsize=8)
        angle.yaxis.label.set_color(VERMILLION)
        angle.grid(visible=False)
        figure.suptitle(_title(dataset), fontsize=11.5)
    return figure


def _title(dataset: xr.Dataset) -> str:
    of = dataset.attrs
    state = f"{of['failures']} films NOT CONVERGED, " if of["failures"] else ""
    rpm = of["pinion_speed"] * 30.0 / np.pi
    return (
        f"{of['name']}: {state}{of['flank']} flank, {of['pinion_torque']:.4g} N·m, {rpm:.0f} rpm, "
        f"{of['oil_temperature'] - 273.15:.0f} °C"
    )
