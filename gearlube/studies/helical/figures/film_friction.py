"""Film and friction along the contact lines over a mesh period, and over speed."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.plotting.style import BLUE, GREEN, GREY, VERMILLION, house_style, new_figure
from gearlube.studies.helical.figures.layout import PERIODS, RPM, closed, title


def film_on_lines(film: xr.Dataset) -> Any:
    """Return coefficient, film, rise and pressure at all points of a mesh period."""
    at = 1e3 * (film["x"].values - film.attrs["pitch_point"])
    load = 1e-3 * film["line_load"].values
    panels = (
        ("coefficient", 1.0, "coefficient of friction"),
        ("central_film", 1e6, "central film [µm]"),
        ("temperature_rise", 1.0, "rise in the film [K]"),
        ("mean_pressure", 1e-9, "mean Hertz pressure [GPa]"),
    )
    kept = np.isfinite(at) & (film["line_load"].values > 0.0)
    with house_style():
        figure = new_figure(10.0, 6.6)
        axes = figure.subplots(2, 2, sharex=True)
        for ax, (name, scale, label) in zip(axes.ravel(), panels, strict=True):
            values = scale * film[name].values
            shown = ax.scatter(
                at[kept], values[kept], c=load[kept], s=3.0, lw=0, cmap="viridis", rasterized=True
            )
            ax.axvline(0.0, color=GREY, lw=1.0, ls=":")
            ax.set_ylabel(label)
        mean = film.attrs["operating_mean_coefficient"]
        axes[0, 0].step(
            [np.nanmin(at), 0.0, np.nanmax(at)], [-mean, -mean, mean], color=VERMILLION, lw=1.3,
            where="pre", label=f"±{mean:.4f}: same loss",
        )  # fmt: skip
        axes[0, 0].legend(loc="upper left")
        for ax in axes[1]:
            ax.set_xlabel("distance from the pitch line along x [mm]")
        bar = figure.colorbar(shown, ax=axes, shrink=0.7, pad=0.015)
        bar.set_label("line load [N/mm]")
        figure.suptitle(_heading(film, "Film on the contact lines"), fontsize=10.5)
    return figure


def film_over_mesh(film: xr.Dataset) -> Any:
    """Return friction force and power of the film over the mesh, and means over speed."""
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
        mean.set(xlabel="pinion speed [rpm]", ylabel="mean coefficient of friction")
        mean.set(ylim=(0.0, None), xscale="log")
        thin.plot(speed, 1e6 * film["smallest_film"].values, color=BLUE, marker=".")
        thin.axhline(1e6 * film.attrs["roughness_rms"], color=GREY, ls="--", lw=1.2)
        thin.set(xlabel="pinion speed [rpm]", xscale="log", yscale="log")
        thin.set_ylabel("smallest film [µm]")
        thin.set_title("dashed: composite roughness", fontsize=9)
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
