"""Statistics of a surface as rows, and the files of a result: heights, statistics, figure."""

from __future__ import annotations

import math
from dataclasses import fields
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from gearlube.output.csv_text import csv_text
from gearlube.plotting.style import BLUE, GREEN, GREY, VERMILLION, house_style, new_figure
from gearlube_core.arrays import Array
from gearlube_core.storage.atomic_file import write_figure, write_text
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

_LENGTHS_SHOWN = 8.0  # correlation lengths
_MOST_BINS = 50
_ONES = {"Rsk", "Rku", "Rdq", "steepest", "Ssk", "Sku", "Sdq", "Str"}
_ANGLES = {"fastest_direction"}


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
    """Return what a generated surface reached against what was asked."""
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
