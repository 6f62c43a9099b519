"""Results of the roughness commands: statistics of surfaces, flow factors, asperity load."""

from __future__ import annotations

import math
from dataclasses import fields
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from gearlube.output.csv_text import csv_text
from gearlube.plotting.style import BLUE, GREEN, GREY, VERMILLION, house_style, new_figure
from gearlube_core.arrays import Array
from gearlube_core.contact.greenwood_tripp_1971 import asperity_load, gear_flanks
from gearlube_core.errors import ParameterError
from gearlube_core.rough_patch.flow import PEKLENIK, pressure_flow_factor, shear_flow_factor
from gearlube_core.storage.atomic_file import write_dataset, write_figure, write_text
from gearlube_core.surface.files import write_surface
from gearlube_core.surface.generator import Generated
from gearlube_core.surface.heights import HeightMap, Profile, Surface
from gearlube_core.surface.spectrum import (
    CORRELATION_LEVEL,
    Spectrum,
    map_autocorrelation,
    map_spectrum,
    profile_autocorrelation,
    profile_spectrum,
)
from gearlube_core.surface.statistics import map_statistics, profile_statistics

_RATIO = "film h over roughness σ"
_SHOWN = {
    "pressure_x": "phi_x",
    "pressure_y": "phi_y",
    "shear_x": "Phi_s",
    "contact_share": "overlap",
    "asperity_pressure": "p/E*",
    "asperity_area": "area",
}
_LENGTHS_SHOWN = 8.0  # correlation lengths
_MOST_BINS = 50
_ONES = {"Rsk", "Rku", "Rdq", "steepest", "Ssk", "Sku", "Sdq", "Str"}
_ANGLES = {"fastest_direction"}


def shown_rows(table: xr.Dataset) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Return headings and rows of the numbers that a terminal shows."""
    names = [name for name in _SHOWN if name in table]
    rows = [
        (f"{float(ratio):g}", *(f"{float(table[name][k]):.3g}" for name in names))
        for k, ratio in enumerate(table.film_ratio)
    ]
    return ("h/sigma", *(_SHOWN[name] for name in names)), rows


def flow_results(table: xr.Dataset, out: Path, peklenik: float | None) -> list[Path]:
    """Write a table as NetCDF and CSV, and its figure; return their places."""
    netcdf, sheet, picture = (out / f"flow_factors.{end}" for end in ("nc", "csv", "png"))
    write_dataset(table, netcdf)
    names = [str(name) for name in table.data_vars]
    rows = (
        (f"{float(ratio):g}", *(f"{float(table[name][k]):.9g}" for name in names))
        for k, ratio in enumerate(table.film_ratio)
    )
    write_text(csv_text(("film_ratio", *names), rows), sheet)
    write_figure(flow_figure([(peklenik, table)]), picture)
    return [netcdf, sheet, picture]


def flow_figure(tables: list[tuple[float | None, xr.Dataset]]) -> Any:
    """Return a figure of flow factors, and of asperity load where there is any.

    Parameters
    ----------
    tables
        Peklenik number, or None where it is not known, and table of each kind of surface.
    """
    loaded = [one for one in tables if "asperity_pressure" in one[1]]
    with house_style():
        figure = new_figure(12.0 if loaded else 8.5, 4.0)
        axes = figure.subplots(1, 3 if loaded else 2)
        for (peklenik, table), colour in zip(tables, (BLUE, VERMILLION, GREEN), strict=False):
            name = "patches" if peklenik is None else f"γ = {_fraction(peklenik)}"
            _factor(axes[0], table, "pressure_x", colour, f"{name}, flow along motion")
            if peklenik != 1.0:
                _factor(axes[0], table, "pressure_y", colour, f"{name}, flow across", style=":")
            _factor(axes[1], table, "shear_x", colour, name)
            if peklenik is not None:
                _published(axes, peklenik, colour)
        axes[0].axhline(1.0, color=GREY, lw=0.8)
        axes[0].set(xlabel=_RATIO, ylabel="pressure flow factor", ylim=(0.0, 2.0))
        axes[1].set(xlabel=_RATIO, ylabel="shear flow factor", ylim=(0.0, None))
        for ax in axes[:2]:
            ax.plot([], [], "k--", lw=1.0, label="Patir and Cheng")
            ax.legend(fontsize=7.5)
        if loaded:
            _asperities(axes[2], loaded)
        figure.suptitle(
            "Flow of oil between rough surfaces over that between smooth ones; "
            "γ: length of asperities along the motion over that across; bands: spread",
            fontsize=9.5,
        )
    return figure


def _factor(
    ax: Any, table: xr.Dataset, name: str, colour: str, label: str, style: str = "-"
) -> None:
    x, mean = table.film_ratio.values, table[name].values
    spread = np.nan_to_num(table[f"{name}_spread"].values)
    ax.plot(x, mean, style, marker="o", ms=3.5, color=colour, label=label)
    ax.fill_between(x, mean - spread, mean + spread, color=colour, alpha=0.15, lw=0.0)


def _published(axes: Any, peklenik: float, colour: str) -> None:
    for ax, law, number in (
        (axes[0], pressure_flow_factor, peklenik),
        (axes[0], pressure_flow_factor, 1.0 / peklenik),
        (axes[1], shear_flow_factor, peklenik),
    ):
        if not any(abs(one / number - 1.0) < 1e-9 for one in PEKLENIK):
            continue
        for low in (0.5, 0.75, 1.0):
            ratios = np.linspace(low, 6.0, 101)
            try:
                ax.plot(ratios, law(ratios, number), "--", color=colour, lw=1.0)
            except ParameterError:
                continue  # the fit begins at a thicker film
            break


def _asperities(ax: Any, tables: list[tuple[float | None, xr.Dataset]]) -> None:
    for (peklenik, table), colour in zip(tables, (BLUE, VERMILLION, GREEN), strict=False):
        name = "patches" if peklenik is None else f"γ = {_fraction(peklenik)}"
        x = table.film_ratio.values
        ax.semilogy(x, table.asperity_pressure.values, "o-", ms=3.5, color=colour, label=name)
    sigma = float(tables[0][1].attrs["roughness"])
    ratios = np.linspace(0.5, 4.0, 71)
    law = [asperity_load(float(one), 1.0, 1.0, gear_flanks(sigma)) for one in ratios]
    ax.semilogy(ratios, law, "k--", lw=1.0, label="Greenwood and Tripp,\nξβσ 0.055, σ/β 0.001")
    ax.set(xlabel=_RATIO, ylabel="mean pressure of asperities over E*", ylim=(1e-8, 1e-1))
    ax.legend(fontsize=7.5)


def _fraction(peklenik: float) -> str:
    return f"{peklenik:g}" if peklenik >= 1.0 else f"1/{1.0 / peklenik:g}"


class Row(NamedTuple):
    """One number of a surface."""

    name: str
    value: float
    unit: str
    asked: float | None = None


def statistics_rows(surface: Surface) -> list[Row]:
    """Return all statistics in um, deg and 1."""
    of = profile_statistics(surface) if isinstance(surface, Profile) else map_statistics(surface)
    rows = []
    for one in fields(of):
        value = getattr(of, one.name)
        if isinstance(value, tuple):
            rows += [
                _row(f"{one.name} {axis}", one.name, part)
                for axis, part in zip("xy", value, strict=True)
            ]
        else:
            rows.append(_row(one.name, one.name, value))
    return rows


def reached_rows(generated: Generated[Profile] | Generated[HeightMap]) -> list[Row]:
    """Return reached and requested statistics of a generated surface."""
    rows = []
    for one in generated.statistics:
        factor, unit = (1e6, "um") if one.unit == "m" else (1.0, one.unit)
        rows.append(Row(one.name, factor * one.reached, unit, factor * one.asked))
    return rows


def write_results(surfaces: dict[str, Surface], out: Path) -> list[Path]:
    """Write heights, statistics and figure of each surface into a folder; return their places."""
    written = []
    for name, surface in surfaces.items():
        rows = statistics_rows(surface)
        heights = out / f"{name}{'.csv' if isinstance(surface, Profile) else '.npz'}"
        write_surface(surface, heights)
        table = out / f"{name}_statistics.csv"
        write_text(
            csv_text(("name", "value", "unit"), ((r.name, f"{r.value:.9g}", r.unit) for r in rows)),
            table,
        )
        picture = out / f"{name}.png"
        write_figure(_surface_figure(surface), picture)
        written += [heights, table, picture]
    return written


def _row(shown: str, name: str, value: float) -> Row:
    if name in _ONES:
        return Row(shown, value, "1")
    if name in _ANGLES:
        return Row(shown, math.degrees(value), "deg")
    return Row(shown, 1e6 * value, "um")


def _surface_figure(surface: Surface) -> Any:
    """Return a figure of a profile or map with its main statistics."""
    with house_style():
        figure = new_figure(9.0, 6.6)
        grid = figure.add_gridspec(2, 3, height_ratios=(1.25, 1.0))
        top = figure.add_subplot(grid[0, :])
        distribution, correlation, spectrum = (
            figure.add_subplot(grid[1, column]) for column in range(3)
        )
        if isinstance(surface, Profile):
            _profile(top, surface)
            curves = {"": profile_autocorrelation(surface)}
            steps, spectra = {"": surface.spacing}, {"": profile_spectrum(surface)}
            of = profile_statistics(surface)
            reach = of.Ral
            title = (
                f"Ra {1e6 * of.Ra:.3g} µm, Rq {1e6 * of.Rq:.3g} µm, Rsk {of.Rsk:.2f}, "
                f"Rku {of.Rku:.2f}, rms slope {of.Rdq:.3f}, Ral {1e6 * of.Ral:.3g} µm"
            )
        else:
            _map(top, surface)
            both = map_autocorrelation(surface)
            half = [count // 2 + 1 for count in both.shape]
            curves = {"along x": both[: half[0], 0], "along y": both[0, : half[1]]}
            steps = dict(zip(curves, surface.spacing, strict=True))
            spectra = {name: map_spectrum(surface, axis) for axis, name in enumerate(curves)}
            whole = map_statistics(surface)
            reach = float(np.nanmax((*whole.correlation_lengths, whole.Sal)))
            title = (
                f"Sa {1e6 * whole.Sa:.3g} µm, Sq {1e6 * whole.Sq:.3g} µm, Ssk {whole.Ssk:.2f}, "
                f"Sku {whole.Sku:.2f}, rms slope {whole.Sdq:.3f}, Sal {1e6 * whole.Sal:.3g} µm"
            )
        _distribution(distribution, surface.height)
        _correlation(correlation, curves, steps, reach)
        _spectrum(spectrum, spectra)
        figure.suptitle(f"{surface.name}\n{title}", fontsize=10.5)
    return figure


def _profile(ax: Any, profile: Profile) -> None:
    ax.plot(1e3 * profile.x, 1e6 * profile.height, color=BLUE, lw=0.8)
    ax.set(xlabel="x [mm]", ylabel="height [µm]", xlim=(0.0, 1e3 * profile.length))


def _map(ax: Any, surface: HeightMap) -> None:
    heights = 1e6 * surface.height.T
    limit = float(np.abs(heights - heights.mean()).max())
    (width, depth), (dx, dy) = surface.lengths, surface.spacing
    drawn = ax.imshow(
        heights - heights.mean(), origin="lower", aspect="auto", cmap="RdBu_r",
        extent=(-5e2 * dx, 1e3 * width + 5e2 * dx, -5e2 * dy, 1e3 * depth + 5e2 * dy),
        vmin=-limit, vmax=limit, interpolation="nearest",
    )  # fmt: skip
    ax.set(xlabel="x [mm]", ylabel="y [mm]")
    ax.grid(visible=False)
    ax.figure.colorbar(drawn, ax=ax, label="height [µm]")


def _distribution(ax: Any, height: Array) -> None:
    values = 1e6 * (height - height.mean()).ravel()
    bins = int(np.clip(np.sqrt(values.size), 10, _MOST_BINS))
    ax.hist(values, bins=bins, density=True, color=BLUE, alpha=0.6, label="heights")
    rms = values.std()
    x = np.linspace(values.min(), values.max(), 201)
    normal = np.exp(-0.5 * (x / rms) ** 2) / (rms * np.sqrt(2.0 * np.pi))
    ax.plot(x, normal, color=VERMILLION, lw=1.2, label="normal")
    ax.set(xlabel="height [µm]", ylabel="share [1/µm]", ylim=(0.0, 1.3 * ax.get_ylim()[1]))
    ax.legend(ncols=2, loc="upper center")


def _correlation(ax: Any, curves: dict[str, Array], steps: dict[str, float], reach: float) -> None:
    for (name, curve), colour in zip(curves.items(), (BLUE, GREEN), strict=False):
        ax.plot(1e6 * steps[name] * np.arange(curve.size), curve, color=colour, label=name)
    ax.axhline(CORRELATION_LEVEL, color=GREY, ls="--", lw=1.0)
    longest = max(steps[name] * (curve.size - 1) for name, curve in curves.items())
    shown = min(_LENGTHS_SHOWN * reach, longest) if np.isfinite(reach) else longest
    ax.set(xlabel="distance [µm]", ylabel="autocorrelation", xlim=(0.0, 1e6 * shown))
    if len(curves) > 1:
        ax.legend()


def _spectrum(ax: Any, spectra: dict[str, Spectrum]) -> None:
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    for (name, one), colour in zip(spectra.items(), (BLUE, GREEN), strict=False):
        # below, there is rounding and no surface
        drawn = one.density > 1e-12 * one.density.max()
        drawn[0] = False
        ax.loglog(
            1e6 / one.frequency[drawn], 1e18 * one.density[drawn], color=colour, lw=1.0, label=name
        )
    ax.set(xlabel="wavelength [µm]", ylabel="spectral density [µm³]")
    ax.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0), numticks=12))
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.tick_params(axis="x", labelsize=7.5)
    ax.invert_xaxis()
