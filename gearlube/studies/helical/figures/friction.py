"""Figures of the friction of a helical pair: along the lines, and over speed."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, GREEN, GREY, SERIES, VERMILLION, house_style, new_figure
from gearlube.studies.helical.figures.layout import (
    NOTHING,
    PERIODS,
    RPM,
    closed,
    note_no_vibration,
    title,
)
from gearlube_core.arrays import Array
from gearlube_core.film_model.model import MOST_OUTSIDE

_SHOWN = 3.0  # per cent of the points that lie beyond each end of a colour scale
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


def film_on_lines(film: xr.Dataset) -> Any:
    """Return maps of coefficient, film, rise and pressure over the way of a line and its width.

    Every column of a map is one contact line at one instant; a pair enters on the left.
    """
    from matplotlib.tri import Triangulation

    line = xr.DataArray(np.arange(film.sizes["friction_line"]), dims="friction_line")
    since = (film["friction_phase"] + line).broadcast_like(film["z"])
    age = since.transpose(*film["z"].dims).values
    across, load = 1e3 * film["z"].values, film["line_load"].values
    panels: tuple[tuple[str, float, str, str], ...] = (
        ("coefficient", 1.0, "size of the coefficient of friction [-]", "viridis"),
        ("central_film", 1e6, "central film [µm]", "viridis"),
        ("temperature_rise", 1.0, "temperature rise in the film [K]", "magma_r"),
        ("mean_pressure", 1e-9, "mean Hertz pressure [GPa]", "magma_r"),
    )
    kept = np.isfinite(film["x"].values) & np.isfinite(across) & (load > 0.0)
    # triangles between neighbours, counted in columns and points
    columns = film.sizes["friction_phase"] * age[kept]
    points = film.sizes["point"] * across[kept] / np.ptp(across[kept])
    net = Triangulation(age[kept], across[kept], Triangulation(columns, points).triangles)
    with house_style():
        figure = new_figure(10.0, 6.6)
        axes = figure.subplots(2, 2, sharex=True, sharey=True)
        for ax, (name, scale, label, colours) in zip(axes.ravel(), panels, strict=True):
            values = scale * np.abs(film[name].values)
            low, high = np.percentile(values[kept], (_SHOWN, 100.0 - _SHOWN))
            shown = ax.tripcolor(
                net, values[kept], shading="gouraud", cmap=colours, vmin=low, vmax=high,
                rasterized=True,
            )  # fmt: skip
            ax.tricontour(
                net,
                1e3 * (film["x"].values[kept] - film.attrs["pitch_point"]),
                levels=[0.0],
                colors=["black"],
                linestyles="--",
                linewidths=1.1,
            )
            ax.grid(visible=False)
            figure.colorbar(shown, ax=ax, label=label, extend="both")
        for ax in axes[1]:
            ax.set_xlabel("mesh periods since the pair enters")
        for ax in axes[:, 0]:
            ax.set_ylabel("distance from mid-face [mm]")
        mean = film.attrs["operating_mean_coefficient"]
        axes[0, 0].set_title(f"the same loss as µ = {mean:.4f} everywhere", fontsize=9)
        figure.suptitle(
            f"{_heading(film, 'Film on the contact lines')}; dashed: pitch line, where µ is zero",
            fontsize=10.5,
        )
    return figure


def film_over_mesh(film: xr.Dataset) -> Any:
    """Return friction force and power of the film over the mesh, and means over speed."""
    from matplotlib.ticker import LogLocator, NullFormatter

    phase, speed = film["friction_phase"].values, film["film_speed"].values / RPM
    with house_style():
        figure = new_figure(10.0, 6.6)
        (force, loss), (mean, thin) = figure.subplots(2, 2)
        for name, colour, label in (
            ("friction_force", GREEN, "oil film"),
            ("friction_force_constant", VERMILLION, "constant, same loss"),
        ):
            force.plot(*closed(phase, film[name].values), color=colour, label=label)
        force.set(xlim=(0.0, 2.0), xlabel=PERIODS, ylabel="friction on the pinion along y [N]")
        loss.plot(*closed(phase, film["power_loss"].values), color=GREEN, label="oil film")
        loss.set(xlim=(0.0, 2.0), xlabel=PERIODS, ylabel="friction power [W]", ylim=(0.0, None))
        mean.plot(speed, film["mean_coefficient"].values, color=GREEN, marker=".")
        by = film["film_share_outside"].values > MOST_OUTSIDE
        mean.plot(speed[by], film["mean_coefficient"].values[by], "o", mec=GREEN, mfc="white")
        mean.set(xlabel="pinion speed [rpm]", ylabel="mean coefficient of friction [-]")
        mean.set(ylim=(0.0, None), xscale="log")
        thin.plot(speed, 1e6 * film["smallest_film"].values, color=BLUE, marker=".")
        thin.axhline(1e6 * film.attrs["roughness_rms"], color=GREY, ls="--", lw=1.2)
        thin.set(xlabel="pinion speed [rpm]", xscale="log", yscale="log")
        thin.set_ylabel("smallest film, Dowson [µm]")
        thin.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        thin.yaxis.set_major_formatter("{x:g}")
        thin.yaxis.set_minor_formatter(NullFormatter())
        thin.set_title("dashed: composite roughness; dotted: operating speed", fontsize=9)
        hollow = "; hollow: formulas, beyond the film model" if by.any() else ""
        mean.set_title(f"dotted: operating speed{hollow}", fontsize=9)
        for ax in (mean, thin):
            ax.axvline(film.attrs["pinion_speed"] / RPM, color=GREY, ls=":", lw=1.0)
        figure.legend(*force.get_legend_handles_labels(), ncols=2, loc="outside lower center")
        figure.suptitle(_heading(film, "Friction of the film, static loads"), fontsize=10.5)
    return figure


def _heading(film: xr.Dataset, what: str) -> str:
    return (
        f"{title(film, what)}\noil {film.attrs['oil']}, "
        f"{film.attrs['oil_temperature'] - 273.15:.4g} °C, composite roughness "
        f"{1e6 * film.attrs['roughness_rms']:.3g} µm"
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
