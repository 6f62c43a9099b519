"""The report of a variation: findings, charts, tables, inputs, limits."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.report.charts import Axis, Line, add_line, bar_chart, panels
from gearlube.report.parts import Cell, Column, Figure, Input, Report, Table
from gearlube.variation.figures import line_axis
from gearlube.variation.findings import (
    Shown,
    conditions,
    findings,
    numbers,
    shown_quantities,
    units_of,
)
from gearlube.variation.store import gridded
from gearlube.variation.summary import inputs_of, quantities_of, varies

_MOST = 6  # series of a chart, and charts of ranks
_FEW = 24  # rows of a table that is shown at once
_MOST_ROWS = 200
_STATISTICS = (
    ("mean", "mean"),
    ("deviation", "standard deviation"),
    ("low", "least"),
    ("p2.5", "2.5 %"),
    ("p50", "median"),
    ("p97.5", "97.5 %"),
    ("high", "largest"),
)
_LIMITS = (
    "Each point holds what its study holds; the limits of that study apply.",
    "A rank correlation says that a quantity follows an input, not by how much; below about 50 "
    "samples it scatters by 0.15 and more.",
    "Shares and ends of a distribution are those of the samples drawn; with the seed they repeat.",
)


def variation_report(results: xr.Dataset, summary: xr.Dataset) -> Report:
    """Return the report of a variation from its results and their statistics."""
    title = str(results.attrs["title"]).partition(",")[0]
    keys = ", ".join(one["key"] for one in inputs_of(results))
    return Report(
        study=f"vary {results.attrs['study']}",
        title=f"Variation: {title}",
        subtitle=f"{results.sizes['point']} points; varied: {keys}.",
        findings=findings(results, summary),
        numbers=numbers(results, summary),
        figures=_figures(results, summary),
        tables=_tables(results, summary),
        inputs=_inputs(results),
        limits=_LIMITS,
        files=("results.zarr", "points.csv", "summary.csv", "figures/"),
    )


def _figures(results: xr.Dataset, summary: xr.Dataset) -> list[Figure]:
    found = []
    shown = shown_quantities(results)
    if line_axis(summary):
        found.append(
            Figure(
                name="lines",
                title=f"Over {line_axis(summary)}",
                caption="The quantities over the longest axis"
                + (
                    "; the median of the samples, dashed the ends of 95 % of them."
                    if summary.sizes["input"]
                    else ", a line for each combination of the other axes."
                ),
                chart=line_panels(results, summary, shown),
            )
        )
    if not summary.sizes["input"]:
        return found
    if drawn := [one for one in shown if _varies(results, one)]:
        found.append(
            Figure(
                name="histograms",
                title="Distributions",
                caption="How many samples have which value, for each combination of the axes.",
                chart=histogram_chart(results, summary, drawn),
            )
        )
    for one in shown[:_MOST]:
        ranks = summary["rank_correlation"].sel(quantity=one.name)
        mean = ranks.mean([d for d in ranks.dims if d != "input"]).values
        over = ", mean over the axes" if ranks.size > mean.size else ""
        if np.isfinite(mean).any():
            order = np.argsort(-np.abs(np.nan_to_num(mean)))[:12]
            found.append(
                Figure(
                    name=f"ranks_{one.name.replace('.', '_')}",
                    title=f"Which input it follows: {one.meaning}",
                    caption=f"Rank correlation with each sampled input{over}: near +1 or −1 it "
                    "follows this input alone, near 0 not at all.",
                    chart=bar_chart(
                        [str(summary["input"].values[i]) for i in order],
                        mean[order],
                        Axis("rank correlation", "-"),
                    ).update_xaxes(range=[-1.0, 1.0]),
                )
            )
    return found


def _varies(results: xr.Dataset, one: Shown) -> bool:
    values = results[one.name].values
    values = values[np.isfinite(values)]
    return bool(values.size > 1 and varies(values))


def line_panels(results: xr.Dataset, summary: xr.Dataset, shown: list[Shown]) -> Any:
    """Return the shown quantities over the longest axis, a panel for each."""
    along = line_axis(summary)
    x_axis = Axis(along, units_of(results)[along])
    axes = [Axis(one.name.replace("_", " "), one.unit) for one in shown]
    chart = panels([one.meaning for one in shown], x_axis, axes, height=280)
    first = conditions(summary.isel({along: 0}))[:_MOST]
    for row, (one, axis) in enumerate(zip(shown, axes, strict=True), 1):
        values = one.factor * summary["statistics"].sel(quantity=one.name)
        for number, (words, cell) in enumerate(first):
            others = [d for d in values.dims if d in cell["failed"].coords and d != along]
            at = values.sel({d: cell[d].values.item() for d in others})
            ends = ("p50", "p2.5", "p97.5") if summary.sizes["input"] else ("p50",)
            for end in ends:
                line = Line(
                    name=words or one.name,
                    x=summary[along].values,
                    y=at.sel(statistic=end).values,
                    dash=int(end != "p50"),
                )
                shows = row == 1 and end == "p50" and bool(words)
                add_line(chart, line, number, x_axis, axis, row=row, col=1, showlegend=shows)
    return chart


def histogram_chart(results: xr.Dataset, summary: xr.Dataset, shown: list[Shown]) -> Any:
    """Return the distributions of the shown quantities, a panel for each."""
    from plotly.subplots import make_subplots

    from gearlube.report.charts import COLOURS

    chart = make_subplots(
        rows=len(shown),
        cols=1,
        subplot_titles=[one.meaning for one in shown],
        vertical_spacing=0.36 / max(len(shown), 2),
    )
    chart.update_layout(template=None, height=300 * len(shown) + 80, barmode="overlay")
    chart.update_annotations(x=0.0, xanchor="left", font_size=13)
    over = gridded(results)[[one.name for one in shown]].load()
    for row, one in enumerate(shown, 1):
        for number, (words, cell) in enumerate(conditions(summary)[:_MOST]):
            others = [d for d in over[one.name].dims if d in cell["failed"].coords]
            at = over[one.name].sel({d: cell[d].values.item() for d in others})
            values = one.factor * at.values[np.isfinite(at.values)]
            chart.add_histogram(
                x=values.astype(np.float32),
                nbinsx=30,
                name=words or one.name,
                legendgroup=words,
                showlegend=row == 1 and bool(words),
                opacity=0.65,
                marker_color=COLOURS[number % len(COLOURS)],
                row=row,
                col=1,
            )
        axis = Axis(one.name.replace("_", " "), one.unit)
        chart.update_xaxes(title_text=axis.label, row=row, col=1)
        chart.update_yaxes(title_text="points", row=row, col=1)
    return chart


def _tables(results: xr.Dataset, summary: xr.Dataset) -> list[Table]:
    """Return the statistics of each shown quantity, and of all others folded."""
    shown = {one.name for one in shown_quantities(results)}
    others = [name for name in quantities_of(results) if name not in shown]
    sampled = bool(summary.sizes["input"])
    found = [_statistics_table(results, summary, name, sampled) for name in [*shown, *others]]
    ranked = sorted(found, key=lambda one: one.folded)
    return [one for one in ranked if one.rows][:_MOST]


def _statistics_table(results: xr.Dataset, summary: xr.Dataset, name: str, sampled: bool) -> Table:
    statistics = _STATISTICS if sampled else (("mean", "value"),)
    unit = str(summary["unit"].sel(quantity=name).values)
    unit = "" if unit == "1" else unit.replace("N m", "N·m")
    axes = [str(axis) for axis in summary["failed"].dims]
    rows: list[list[Cell]] = []
    for _, cell in conditions(summary)[:_MOST_ROWS]:
        values = cell["statistics"].sel(quantity=name)
        where = [cell[axis].values.item() for axis in axes]
        rows.append([*where, *(float(values.sel(statistic=key)) for key, _ in statistics)])
    shown = name in results.attrs["shown"]
    return Table(
        title=f"{results[name].attrs['long_name']}",
        columns=[
            *(Column(axis, units_of(results)[axis], 4) for axis in axes),
            *(Column(words, unit, 4) for _, words in statistics),
        ],
        rows=rows,
        caption="summary.csv has all quantities." if shown else "",
        folded=not shown or len(rows) > _FEW,
    )


def _inputs(results: xr.Dataset) -> list[Input]:
    found = []
    for one in inputs_of(results):
        values = results[one["key"]].values
        if values.dtype.kind in "fiu":
            text = f"{values.min():.4g} to {values.max():.4g}"
            if not one["sampled"]:
                text += f", {np.unique(values).size} values"
        else:
            text = ", ".join(dict.fromkeys(map(str, values)))
        how = "sampled" if one["sampled"] else "each value"
        found.append(Input(str(one["key"]), text, str(one["unit"]), why=f"{how}: {one['meaning']}"))
    return found
