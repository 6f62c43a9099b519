"""Contact properties of a tooth pair from entry to exit."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import GREY, SERIES, WIDTHS, house_style, new_figure
from gearlube.studies.resonance.figures.traction import case_label

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
