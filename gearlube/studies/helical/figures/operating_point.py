"""Motions and bearing forces at the operating point: histories and spectra."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import house_style, new_figure
from gearlube.report.numbers import number_text
from gearlube.studies.helical.figures.layout import (
    PERIODS,
    cases,
    closed,
    mark_orders,
    stems,
    title,
)


def displacements(response: xr.Dataset) -> Any:
    """Return the pinion's translations. Compare [he_2007 fig. 6]."""
    rows = (
        ("u_xp", "$u_{xp}$", 1e6, "µm"),
        ("u_yp", "$u_{yp}$", 1e6, "µm"),
        ("u_zp", "$u_{zp}$", 1e6, "µm"),
    )
    return _histories(response, rows, "Displacements of the pinion")


def bearing_forces(response: xr.Dataset) -> Any:
    """Return the forces of the pinion's bearings. Compare [he_2007 fig. 7], in lbf."""
    rows = (
        ("F_xp", "$F_{x}$", 1.0, "N"),
        ("F_yp", "$F_{y}$", 1.0, "N"),
        ("F_zp", "$F_{z}$", 1.0, "N"),
    )
    return _histories(response, rows, "Forces of both bearings on the pinion")


def composites(response: xr.Dataset) -> Any:
    """Return the composite displacements. Compare [he_2007 fig. 8]."""
    rows = (
        ("delta_x", r"$\delta_x$", 1e6, "µm"),
        ("delta_y", r"$\delta_y$", 1e6, "µm"),
        ("delta_z", r"$\delta_z$", 1e6, "µm"),
        ("delta_z_rate", r"$\dot\delta_z$", 1e6, "µm/s"),
    )
    return _histories(response, rows, "Composite displacements")


def _histories(
    response: xr.Dataset, rows: tuple[tuple[str, str, float, str], ...], what: str
) -> Any:
    phase, order = response["phase"].values, response["harmonic"].values
    shown = cases(response)
    with house_style():
        figure = new_figure(10.0, 2.35 * len(rows) + 0.9)
        axes = figure.subplots(len(rows), 2, sharex="col", gridspec_kw={"width_ratios": (1.0, 1.2)})
        for (left, right), (name, symbol, scale, unit) in zip(axes, rows, strict=True):
            means = []
            sets = []
            for case, label, colour in shown:
                values = scale * response[name].sel(case=case).values
                x, y = closed(phase, values - values.mean())
                left.plot(x, y, color=colour, label=label, lw=1.3)
                means.append(number_text(float(values.mean())))
                sets.append((_amplitude(response, name, case, scale), colour, label))
            left.set_ylabel(f"{symbol} minus mean [{unit}]")
            if not name.endswith("_rate"):
                left.set_title(f"means {', '.join(means)} {unit}", fontsize=8.5, loc="right")
            stems(right, order, sets)
            mark_orders(right, response)
            right.set_ylabel(f"amplitude of {symbol} [{unit}]")
        axes[-1, 0].set(xlim=(0.0, 2.0), xlabel=PERIODS)
        axes[-1, 1].set_xlabel("mesh order n; dotted: natural frequencies")
        figure.legend(*axes[0, 0].get_legend_handles_labels(), ncols=4, loc="outside lower center")
        figure.suptitle(title(response, what), fontsize=11.0)
    return figure


def _amplitude(response: xr.Dataset, name: str, case: str, scale: float) -> Any:
    if f"{name}_harmonic" in response:
        return scale * response[f"{name}_harmonic"].sel(case=case).values
    base = response[f"{name.removesuffix('_rate')}_harmonic"].sel(case=case)
    speed = 2.0 * np.pi * response.attrs["mesh_frequency"] * response["harmonic"].values
    return scale * base.values * speed
