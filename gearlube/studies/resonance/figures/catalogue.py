"""The figures of a resonance study, in reading order."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import GREY, SERIES, WIDTHS, house_style, new_figure
from gearlube.report.pictures import Picture, save_pictures
from gearlube.studies.resonance.figures.motions import (
    constant_radii,
    dry_and_lubricated,
    phase_portraits,
    poincare_section,
    spectra,
    time_histories,
)
from gearlube.studies.resonance.figures.response_curves import harmonics, response_curves, stability
from gearlube_core.friction.traction_regime import NEWTONIAN_LIMIT, largest_stress_ratio

_NAMES = {"two_dof": "2-DOF, dry", "one_dof": "1-DOF, dry"}
_CURVES = {
    "thermal_eyring": ("thermal Eyring", "-", 2.0),
    "isothermal_eyring": ("isothermal Eyring", "--", 1.2),
    "thermal_newtonian": ("thermal Newtonian", "-.", 1.2),
    "isothermal_newtonian": ("isothermal Newtonian", ":", 1.2),
}

# name, label, scale; one panel each
_PANELS = (
    ("load", "load [N]", 1.0),
    ("R_sliding", "radius along\nsliding $R_{zx}$ [mm]", 1e3),
    ("area", "contact area [mm²]", 1e6),
    ("entrainment_speed", "entrainment [m/s]", 1.0),
    ("film_thickness", "film [µm]", 1e6),
    ("shear_rate", "shear rate [1/µs]", 1e-6),
    ("rise_centre", "temperature rise\nof the film [K]", 1.0),
    ("effective_viscosity", "effective\nviscosity [Pa s]", 1.0),
    ("friction_coefficient", "friction coefficient [-]", 1.0),
    ("viscous_friction", "viscous friction [N]", 1.0),
    ("boundary_friction", "boundary friction [N]", 1.0),
    ("torque_pinion", "torque of friction\non the pinion [N·m]", 1.0),
)

_COLUMNS = 3
_LOGARITHMIC = ("R_sliding", "effective_viscosity")
_BOTH = ("viscous_friction", "boundary_friction")  # on one scale

Draw = Callable[[xr.Dataset, xr.Dataset], Any]


def load_curves(dataset: xr.Dataset) -> Any:
    """Return peak to peak and time without contact over the pinion torque, by stability."""
    with house_style():
        figure = new_figure(8.4, 6.0)
        axes = figure.subplots(2, 1, sharex=True, height_ratios=[2.0, 1.0])
        for colour, form in zip(SERIES, dataset["form"].values, strict=False):
            part = dataset.sel(form=form)
            label: str | None = _NAMES[form]
            for number in part["branch"].values:
                branch = part.sel(branch=number)
                torque = branch["torque"].values
                stable = branch["stable"].values == 1.0
                for ax, name, scale in zip(
                    axes, ("peak_to_peak", "separation_share"), (1e6, 100.0), strict=True
                ):
                    values = scale * branch[name].values
                    held = np.where(stable, values, np.nan)
                    ax.plot(torque, held, color=colour, label=label)
                    ax.plot(torque, values, color=colour, ls=(0, (4, 2)), lw=1.0)
                label = None
                folds = branch["special_torque"].values, 1e6 * branch["special_peak_to_peak"].values
                axes[0].plot(*folds, "o", mfc="white", mec=colour)
        axes[0].set_ylabel("transmission error p-p [µm]")
        axes[1].set_ylabel("time without\ncontact [%]")
        axes[1].set_xlabel("pinion torque [N·m]")
        axes[0].legend()
        figure.suptitle(
            f"Response over load at {dataset.attrs['relative_frequency']:g} of the natural "
            "frequency; dashed: unstable; circles: folds and bifurcations",
            fontsize=10.5,
        )
    return figure


def _of_cycle(draw: Callable[[xr.Dataset], Any]) -> Draw:
    return lambda _, cycle: draw(cycle)


def contact_properties(cycle: xr.Dataset) -> Any:
    """Return contact properties of one tooth pair from entry to exit, a line for each case.

    Compare [karagiannis_2012 fig. 18] [karagiannis_2012 fig. 20] [karagiannis_2012 fig. 21].
    """
    with house_style():
        rows = len(_PANELS) // _COLUMNS
        figure = new_figure(11.0, 2.15 * rows + 1.0)
        axes = figure.subplots(rows, _COLUMNS, sharex=True)
        named = dict(zip((name for name, _, _ in _PANELS), axes.ravel(), strict=True))
        for (name, label, scale), ax in zip(_PANELS, axes.ravel(), strict=True):
            for case in range(cycle.sizes["case"]):
                samples = cycle.sizes["phase"]
                life = scale * cycle[name].isel(case=case).values.ravel()
                # a pair may leave after the three periods of the data: the end of its life is first
                life = np.roll(life, -samples // 2)
                x = 0.5 + np.arange(life.size) / samples
                ax.plot(
                    x, life, color=SERIES[case], lw=WIDTHS[case], label=_case_label(cycle, case)
                )
            ax.set_ylabel(label)
            if name in _LOGARITHMIC:
                ax.set_yscale("log")
            elif name == "torque_pinion":
                ax.axhline(0.0, color=GREY, lw=0.8)
            else:
                ax.set_ylim(bottom=0.0)
        top = max(named[name].get_ylim()[1] for name in _BOTH)
        for name in _BOTH:
            named[name].set_ylim(0.0, top)
        for ax in axes[-1]:
            ax.set_xlabel("pinion rotation [mesh periods]")
        axes[0, 0].set_xlim(0.5, 3.5)
        handles, labels = axes[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, ncols=3, loc="outside lower center")
        figure.suptitle(
            "One tooth pair from entry to exit; $f_n$: mesh at that share of the natural "
            "frequency, and oil temperature",
            fontsize=11.0,
        )
    return figure


def _case_label(cycle: xr.Dataset, case: int) -> str:
    """Return "0.3 of natural, 40 °C"."""
    relative = float(cycle["case_relative_frequency"][case])
    return f"{relative:g} $f_n$, {float(cycle['case_oil_temperature'][case]) - 273.15:.0f} °C"


def _traction_map(cycle: xr.Dataset) -> Any:
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
                label=_case_label(cycle, case),
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


def _traction_curves(cycle: xr.Dataset) -> Any:
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
                [], [], color=colour, label=f"{_case_label(cycle, case)}, {1e-9 * pressure:.2f} GPa"
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


# `needs`: a variable of the datasets without which there is no figure
RESONANCE_CATALOGUE: dict[str, Picture] = {
    "response": Picture(
        lambda response, _: response_curves(response),
        "Response over mesh frequency",
        "Transmission error and time without contact of all periodic motions; dashed: unstable "
        "ones, which do not run by themselves. Between two folds there are two stable motions: "
        "which one runs depends on whether the speed rose or fell. Triangles are slow sweeps in "
        "time, as a check.",
        "peak_to_peak",
    ),
    "harmonics": Picture(
        lambda response, _: harmonics(response),
        "Mesh orders over mesh frequency",
        "Order n has its peak at 1/n of the natural frequency: there its excitation meets the "
        "resonance.",
        "harmonics",
    ),
    "stability": Picture(
        lambda response, _: stability(response),
        "Stability",
        "Factor by which a small disturbance grows or dies out in one mesh period. Above 1 the "
        "motion is unstable and does not run by itself. Near 1 a disturbance dies out slowly.",
        "multiplier",
    ),
    "time_histories": Picture(
        _of_cycle(time_histories),
        "Waveforms",
        "Transmission error over two mesh periods at some frequencies; more than one line: "
        "coexisting motions. In grey the teeth are apart.",
        "x",
    ),
    "spectra": Picture(
        _of_cycle(spectra),
        "Orders of the transmission error",
        "Amplitudes of mesh orders at some frequencies, one scale for all. At the natural "
        "frequency order 1 stands out, below it the order that meets it.",
        "spectrum",
    ),
    "constant_radii": Picture(
        _of_cycle(constant_radii),
        "Constant contact radii",
        "Waveforms and orders with mean radii: both models then agree, which checks them.",
        "x",
    ),
    "phase_portraits": Picture(
        _of_cycle(phase_portraits),
        "Phase portraits",
        "Rate over transmission error. A loop that enters the grey is an impact.",
        "rate",
    ),
    "poincare_section": Picture(
        _of_cycle(poincare_section),
        "Where motions from many starts end",
        "State once a mesh period, from many starts; the colour says which motion was reached.",
        "section_x",
    ),
    "dry_and_lubricated": Picture(
        _of_cycle(dry_and_lubricated),
        "With and without flank friction",
        "Waveforms of both, and their difference on a scale of its own, in nm.",
        "load",
    ),
    "traction_map": Picture(
        _of_cycle(_traction_map),
        "Regime of the film",
        "All contacts of the cycles on the traction map: right of the line the film shears as an "
        "Eyring fluid, left of it heat limits the traction.",
        "load",
    ),
    "traction_curves": Picture(
        _of_cycle(_traction_curves),
        "Traction over shear rate",
        "Traction of the most heavily loaded contact, by four laws. Heat bends the curves down.",
        "load",
    ),
    "contact_properties": Picture(
        _of_cycle(contact_properties),
        "A tooth pair from entry to exit",
        "Load, film, temperature and friction of one pair from entry to exit, one line for each "
        "case. Warm oil: thinner film, boundary friction appears.",
        "load",
    ),
}


def save_resonance_figures(response: xr.Dataset, cycle: xr.Dataset, directory: Path) -> list[Path]:
    """Draw every figure for which there are data into `directory` as PNG; return the files."""
    drawn = {
        name: one
        for name, one in RESONANCE_CATALOGUE.items()
        if any(one.needs in data and data[one.needs].size for data in (response, cycle))
    }
    return save_pictures(drawn, directory, response, cycle)
