"""Harmonics against the coefficient of friction at one speed."""

from __future__ import annotations

from typing import Any

import xarray as xr

from gearlube.plotting.style import house_style, new_figure
from gearlube.studies.helical.figures.layout import NOTHING, note_no_vibration, title

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
    import matplotlib

    part = sweep.isel(speed=0)
    order, mu = part["harmonic"].values, part["mu"].values
    colours = matplotlib.colormaps["viridis"].resampled(order.size)
    with house_style():
        figure = new_figure(10.5, 2.7 * len(rows) + 1.0)
        axes = figure.subplots(len(rows), len(rows[0]), sharex=True)
        for line, names in zip(axes, rows, strict=True):
            for ax, (name, symbol) in zip(line, names, strict=True):
                values = scale * part[f"{name}_harmonic"].transpose("mu", "harmonic").values
                for column in range(order.size):
                    wide = 2.0 if column < 2 else 1.1
                    ax.plot(mu, values[:, column], color=colours(column), lw=wide)
                top = float(values.max())
                ax.set_title(symbol)
                if top > NOTHING:
                    ax.set_yscale("log")
                    ax.set_ylim(1e-4 * top, 2.0 * top)
                else:
                    note_no_vibration(ax)
            line[0].set_ylabel(f"amplitude [{unit}]")
        for ax in axes[-1]:
            ax.set_xlabel("coefficient of friction µ")
            ax.set_xlim(mu[0], max(mu[-1], mu[0] + 1e-3))
        norm = matplotlib.colors.BoundaryNorm(
            [n - 0.5 for n in (*order, order[-1] + 1)], order.size
        )
        mappable = matplotlib.cm.ScalarMappable(norm=norm, cmap=colours)
        bar = figure.colorbar(mappable, ax=axes, shrink=0.7, pad=0.015)
        bar.set_ticks(list(order[::2]))
        bar.set_label("mesh order n (1 and 2 drawn wide)")
        figure.suptitle(title(sweep, what), fontsize=11.0)
    return figure
