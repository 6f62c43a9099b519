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
from gearlube.studies.resonance.figures.response_curves import (
    harmonics,
    response_curves,
    stability,
)
from gearlube.studies.resonance.figures.traction import case_label, traction_curves, traction_map

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
                ax.plot(x, life, color=SERIES[case], lw=WIDTHS[case], label=case_label(cycle, case))
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
        _of_cycle(traction_map),
        "Regime of the film",
        "All contacts of the cycles on the traction map: right of the line the film shears as an "
        "Eyring fluid, left of it heat limits the traction.",
        "load",
    ),
    "traction_curves": Picture(
        _of_cycle(traction_curves),
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
