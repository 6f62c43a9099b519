"""Files and figure of flow factors and asperity load."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.output.csv_text import csv_text
from gearlube.plotting.style import BLUE, GREEN, GREY, VERMILLION, house_style, new_figure
from gearlube_core.contact.greenwood_tripp_1971 import asperity_load, gear_flanks
from gearlube_core.errors import ParameterError
from gearlube_core.rough_patch.flow import (
    PEKLENIK,
    pressure_flow_factor,
    shear_flow_factor,
)
from gearlube_core.storage.atomic_file import write_dataset, write_figure, write_text

_RATIO = "film h over roughness σ"
_SHOWN = {
    "pressure_x": "phi_x",
    "pressure_y": "phi_y",
    "shear_x": "Phi_s",
    "contact_share": "overlap",
    "asperity_pressure": "p/E*",
    "asperity_area": "area",
}


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
