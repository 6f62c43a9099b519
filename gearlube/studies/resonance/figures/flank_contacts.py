"""Contact properties of simultaneous tooth pairs over their contact."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import SERIES, house_style, new_figure
from gearlube.studies.resonance.figures.traction import case_label

_SUM = "#606060"
# name, label, scale; two names share an axis, the second dashed
_ROWS: tuple[tuple[tuple[str, str, float], ...], ...] = (
    (("R_sliding", "$R_{zx}$ [mm]", 1e3), ("entrainment_speed", "entrainment [m/s]", 1.0)),
    (("rise_centre", "rise [K]", 1.0), ("effective_viscosity", "effective viscosity [Pa s]", 1.0)),
    (("load", "load [N]", 1.0), ("film_thickness", "film [µm]", 1e6)),
    (("shear_rate", "shear rate [1/µs]", 1e-6), ("area", "contact area [mm²]", 1e6)),
    (
        ("viscous_friction", "viscous friction [N]", 1.0),
        ("boundary_friction", "boundary friction [N]", 1.0),
    ),
    (
        ("torque_pinion", "torque on pinion [N·m]", 1.0),
        ("friction_coefficient", "friction coefficient [-]", 1.0),
    ),
)


def contact_properties(cycle: xr.Dataset) -> Any:
    """Return contact properties of a tooth pair and its neighbours, from entry to exit.

    Compare [karagiannis_2012 fig. 18] [karagiannis_2012 fig. 20] [karagiannis_2012 fig. 21].
    """
    cases = cycle.sizes["case"]
    with house_style():
        figure = new_figure(4.6 * cases, 2.05 * len(_ROWS) + 0.8)
        axes = figure.subplots(len(_ROWS), cases, sharex=True, squeeze=False)
        for case in range(cases):
            part = cycle.isel(case=case)
            for ax, (solid, dashed) in zip(axes[:, case], _ROWS, strict=True):
                other = ax.twinx()
                other.spines["right"].set_visible(True)
                other.grid(False)
                _pairs(ax, part, solid, "-")
                _pairs(other, part, dashed, "--")
                _total(ax, part, solid)
                for which, (name, label, _) in ((ax, solid), (other, dashed)):
                    which.set_ylabel(label, fontsize=8.5)
                    if name == "R_sliding":
                        which.set_yscale("log")
                    elif name != "torque_pinion":
                        which.set_ylim(bottom=0.0)
                if dashed[0] == "boundary_friction":
                    both = (0.0, max(ax.get_ylim()[1], other.get_ylim()[1]))
                    ax.set_ylim(both)
                    other.set_ylim(both)
            axes[0, case].set_title(case_label(cycle, case))
            axes[-1, case].set_xlabel("pinion rotation [mesh periods]")
        axes[0, 0].set_xlim(0.0, 3.0)
        for pair, colour in enumerate(SERIES[:3]):
            axes[0, 0].plot([], [], color=colour, label=f"pair {pair + 1}")
        axes[0, 0].plot([], [], color=_SUM, label="sum")
        handles, labels = axes[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, ncols=4, loc="outside lower center")
        figure.suptitle(
            "Contacts of successive tooth pairs; solid: left scale, dashed: right scale",
            fontsize=11.5,
        )
    return figure


def _pairs(ax: Any, part: xr.Dataset, row: tuple[str, str, float], style: str) -> None:
    """Draw three successive pairs over three mesh periods; the first enters at the left."""
    name, _, scale = row
    life = scale * part[name].values.ravel()
    samples = part.sizes["phase"]
    x = np.arange(life.size) / samples
    for pair in range(part.sizes["pair"]):
        ax.plot(x, np.roll(life, pair * samples), color=SERIES[pair], ls=style, lw=1.2)


def _total(ax: Any, part: xr.Dataset, row: tuple[str, str, float]) -> None:
    if row[0] != "torque_pinion":
        return
    total = np.tile(np.nansum(part[row[0]].values, axis=0), part.sizes["pair"])
    ax.plot(np.arange(total.size) / part.sizes["phase"], row[2] * total, color=_SUM, lw=1.2)
    ax.axhline(0.0, color="black", lw=0.6)
