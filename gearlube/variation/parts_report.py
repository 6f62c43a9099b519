"""Report of many parts: figures and findings."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from textwrap import fill
from typing import Any

import numpy as np
import xarray as xr
from scipy.stats import binom

from gearlube.plotting.style import HATCHES, SERIES, house_style
from gearlube.report.numbers import number_text, quantity_text
from gearlube.report.parts import GOOD, NOTE, WARNING, Finding, Report
from gearlube.report.pictures import Picture, pictured, save_pictures
from gearlube.variation.figures import label_of, panels_of, scale_of
from gearlube.variation.parts import METHODS
from gearlube_core.storage.atomic_file import write_compressed_dataset

_BINS, _MOST_BARS, _LETTERS = 40, 12, 34
_NAMED = 3  # tolerances in a sentence
_LIMIT = 0.025  # chance of so few runs within bars that are right
_LENGTHS = ("predicted", "full", "quick", "bar", "bias", "bias_error", "rms", "scatter", "limit")


def _cells(results: xr.Dataset, many: xr.Dataset) -> Iterator[tuple[str, str, xr.Dataset]]:
    """Yield name, unit and data of each quantity, in the unit in which it is drawn."""
    for name in map(str, many["quantity"].values):
        factor, unit = scale_of(results, name)
        cell = many.sel(quantity=name)
        yield name, "" if unit == "-" else unit, cell.assign(factor * cell[list(_LENGTHS)])


def parts_figure(results: xr.Dataset, many: xr.Dataset) -> Any:
    """Return histograms of predicted parts and full runs, with limits and the shares above."""
    with house_style():
        title = f"{many.attrs['parts']} parts"
        figure, panels = panels_of(results, title, many.sizes["quantity"])
        for ax, (name, unit, cell) in zip(panels, _cells(results, many), strict=True):
            parts, full = cell["predicted"].values, cell["full"].dropna("run").values
            bins = np.linspace(min(parts.min(), full.min()), max(parts.max(), full.max()), _BINS)
            ax.hist(parts, bins, density=True, color=SERIES[0], alpha=0.45, label="quick model")
            ax.hist(
                full, bins[::3], density=True, histtype="step", color=SERIES[1], label="full runs"
            )
            if np.isfinite(limit := float(cell["limit"])):
                ax.axvline(limit, color="black", linestyle="--", lw=1.2, label="limit")
                share = _share(cell["share_above"])
                ax.set_title(f"above {quantity_text(limit, unit)}: {share}", fontsize=9.5)
            ax.set_xlabel(label_of(results, name))
            ax.set_ylabel(f"share of parts per {unit or 'unit'}")
        for ax in panels:
            ax.legend()
    return figure


def pays_figure(results: xr.Dataset, many: xr.Dataset) -> Any:
    """Return bars of the variance share of each tolerance by both methods."""
    shares = np.nan_to_num([many[method].values for method in METHODS])
    order = np.argsort(shares.max(axis=(0, 1)))[-_MOST_BARS:]
    rows = np.arange(order.size)
    with house_style():
        title = "Which tolerance pays"
        figure, panels = panels_of(results, title, many.sizes["quantity"], height=3.9)
        for ax, (name, _, cell) in zip(panels, _cells(results, many), strict=True):
            for i, (method, words) in enumerate(METHODS.items()):
                bars = 100.0 * cell[method].values[order]
                place = rows + 0.2 - 0.4 * i
                ax.barh(place, bars, 0.38, color=SERIES[i], hatch=HATCHES[i], label=words)
            ax.set_yticks(rows, many["input"].values[order] if ax in panels[::2] else [])
            ax.set_xlabel("share of the variance [%]")
            ax.set_title(fill(str(results[name].attrs["long_name"]), _LETTERS), fontsize=9.5)
        panels[0].legend(loc="lower right")
    return figure


def check_figure(results: xr.Dataset, many: xr.Dataset) -> Any:
    """Return the quick model's answers for runs that it has not seen, over the full runs."""
    with house_style():
        title = "Quick model and full runs that it has not seen"
        figure, panels = panels_of(results, title, many.sizes["quantity"], height=3.7)
        for ax, (name, unit, cell) in zip(panels, _cells(results, many), strict=True):
            seen = cell[["full", "quick"]].dropna("run")
            full, quick, bar = seen["full"].values, seen["quick"].values, float(cell["bar"])
            ends = np.array([min(full.min(), quick.min()), max(full.max(), quick.max())])
            ax.plot(full, quick, "o", ms=3.0, color=SERIES[0])
            ax.plot(ends, ends, color="black", lw=1.0)
            ax.fill_between(ends, ends - bar, ends + bar, alpha=0.2, lw=0.0, label="bar of 95 %")
            ax.set_xlabel(label_of(results, name))
            ax.set_ylabel(f"quick model [{unit}]")
            ax.set_title(
                f"bias {quantity_text(float(cell['bias']), unit, 2)}, "
                f"rms {quantity_text(float(cell['rms']), unit, 2)}, "
                f"{100.0 * float(cell['coverage']):.0f} % within bars",
                fontsize=9.5,
            )
        panels[0].legend()
    return figure


_PICTURES = {
    "parts": Picture(
        parts_figure,
        "Distribution",
        "All parts by the quick model, and the full runs; dashed the limit, with the share above "
        "it and its 95 % confidence.",
    ),
    "pays": Picture(
        pays_figure,
        "Which tolerance pays",
        "Share of the variance by tolerance: total effects of Sobol on the quick model, and a "
        "regression with a parabola in each tolerance on the full runs.",
    ),
    "check": Picture(
        check_figure,
        "Check of the quick model",
        "The last 30 % of the full runs against the model, which the others have trained.",
    ),
}


def save_parts(results: xr.Dataset, many: xr.Dataset, report: Report, folder: Path) -> Report:
    """Write parts.nc and the figures parts, pays and check; return the report with them first."""
    write_compressed_dataset(many, folder / "parts.nc")
    save_pictures(_PICTURES, folder / "figures", results, many)
    limited = bool(np.isfinite(many["limit"]).any())
    own, of_points = findings(results, many), list(report.findings)
    return replace(
        report,
        findings=[*own, *of_points] if limited else [*of_points, *own],
        figures=[  # the parts have the distribution of all
            *pictured(_PICTURES, folder / "figures"),
            *(one for one in report.figures if one.name != "histograms"),
        ],
        files=[*report.files, "parts.nc"],
    )


def findings(results: xr.Dataset, many: xr.Dataset) -> list[Finding]:
    """Return shares above limits, which tolerances pay, and how good the quick model is."""
    found = []
    for name, unit, cell in _cells(results, many):
        if np.isfinite(limit := float(cell["limit"])):
            found.append(
                Finding(
                    WARNING if float(cell["share_above"][0]) > 0.0 else GOOD,
                    f"{_share(cell['share_above'])} of {many.attrs['parts']} parts have a {name} "
                    f"above {quantity_text(limit, unit)}; of the full runs alone "
                    f"{_share(cell['share_of_runs'])}.",
                    "The first holds for errors of the quick model such as were seen; the second "
                    "needs no model.",
                )
            )
        (first, by), *others = METHODS.items()
        rest = "; ".join(f"by {words}: {_largest(cell[one])}" for one, words in others)
        found.append(
            Finding(
                NOTE,
                f"The scatter of {name} comes from {_largest(cell[first])}.",
                f"By {by}; {rest}.",
            )
        )
        checks = int(cell["quick"].notnull().sum())
        inside = round(float(cell["coverage"]) * checks)
        narrow = binom.cdf(inside, checks, 0.95) < _LIMIT
        bias, error, rms, scatter = (
            quantity_text(float(cell[one]), unit, 2)
            for one in ("bias", "bias_error", "rms", "scatter")
        )
        found.append(
            Finding(
                WARNING if narrow else GOOD,
                f"The quick model of {name} has an rms error of {rms} on {checks} full runs that "
                f"it has not seen, of {scatter} scatter; {inside} are within its 95 % bars.",
                f"Its bias is {bias}, with a standard error of {error}."
                + (" The bars are too narrow. Take more samples." if narrow else ""),
            )
        )
    return found


def _share(ends: xr.DataArray) -> str:
    value, low, high = (number_text(100.0 * float(one), 2) for one in ends)
    return f"{value} % (95 % confidence {low} to {high} %)"


def _largest(shares: xr.DataArray) -> str:
    values = np.nan_to_num(shares.values)
    order = np.argsort(-values)[:_NAMED]
    return ", ".join(f"{shares['input'].values[i]} {100.0 * values[i]:.0f} %" for i in order)
