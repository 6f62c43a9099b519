"""Harmonics against the coefficient of friction at one speed."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import SERIES, house_style, new_figure
from gearlube.studies.helical.figures.layout import NOTHING, note_no_vibration, title
from gearlube_core.arrays import Array

_NAMED = 4  # orders with a colour of their own
_LEAST = 1e-4  # of the largest amplitude of all panels, that their scale reaches

_ROWS = (
    (("u_xp", "$u_{xp}$"), ("u_yp", "$u_{yp}$"), ("u_zp", "$u_{zp}$")),
    (("u_xg", "$u_{xg}$"), ("u_yg", "$u_{yg}$"), ("u_zg", "$u_{zg}$")),
    (("delta_x", r"$\delta_x$"), ("delta_y", r"$\delta_y$"), ("delta_z", r"$\delta_z$")),
)
_FORCES = (
    (("F_xp", "$F_{x}$, pinion"), ("F_yp", "$F_{y}$, pinion"), ("F_zp", "$F_{z}$, pinion")),
    (("F_xg", "$F_{x}$, gear"), ("F_yg", "$F_{y}$, gear"), ("F_zg", "$F_{z}$, gear")),
)


def friction_harmonics(sweep: xr.Dataset) -> Any:
    """Return mesh orders of motions against friction; [he_2007 sec. 6] discusses them."""
    return _panels(sweep, _ROWS, 1e6, "µm", "Mesh orders of the motions against friction")


def friction_force_harmonics(sweep: xr.Dataset) -> Any:
    """Return mesh orders of the bearing forces against friction."""
    return _panels(sweep, _FORCES, 1.0, "N", "Mesh orders of the bearing forces against friction")


def _panels(
    sweep: xr.Dataset,
    rows: tuple[tuple[tuple[str, str], ...], ...],
    scale: float,
    unit: str,
    what: str,
) -> Any:
    part = sweep.isel(speed=0)
    order, mu = part["harmonic"].values, part["mu"].values
    with house_style():
        figure = new_figure(10.5, 2.7 * len(rows) + 1.0)
        axes = figure.subplots(len(rows), len(rows[0]), sharex=True, sharey=True)
        tops = []
        for line, names in zip(axes, rows, strict=True):
            for ax, (name, symbol) in zip(line, names, strict=True):
                values = scale * part[f"{name}_harmonic"].transpose("mu", "harmonic").values
                tops.append(_orders(ax, mu, order, values))
                ax.set_title(symbol)
            line[0].set_ylabel(f"amplitude [{unit}]")
        if max(tops) > NOTHING:
            axes[0, 0].set_yscale("log")
            axes[0, 0].set_ylim(_LEAST * max(tops), 2.0 * max(tops))
        for ax in axes[-1]:
            ax.set_xlabel("coefficient of friction µ [-]")
            ax.set_xlim(mu[0], max(mu[-1], mu[0] + 1e-3))
        named = {
            label: handle
            for ax in axes.ravel()
            for handle, label in zip(*ax.get_legend_handles_labels(), strict=True)
        }
        labels = sorted(named)
        figure.legend(
            [named[label] for label in labels], labels, ncols=5, loc="outside lower center"
        )
        figure.suptitle(title(sweep, what), fontsize=11.0)
    return figure


def _orders(ax: Any, mu: Array, order: Array, values: Array) -> float:
    """Draw amplitudes over friction, shape (mu, orders); return the largest.

    Without friction an amplitude may be zero, which a logarithmic scale cannot show.
    """
    top = float(values.max())
    if not top > NOTHING:
        note_no_vibration(ax)
        return top
    for column in reversed(range(order.size)):
        named = column < _NAMED
        shown = np.where(values[:, column] > NOTHING, values[:, column], np.nan)
        ax.plot(
            mu,
            shown,
            color=SERIES[column] if named else "0.78",
            lw=1.8 if named else 0.8,
            zorder=2.5 if named else 1.5,
            label=f"order {order[column]}" if named else f"orders {order[_NAMED]} to {order[-1]}",
        )
    return top
