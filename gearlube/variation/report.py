"""The report of a variation: findings, charts, tables, inputs, limits."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.report.charts import COLOURS, Axis, bar_chart
from gearlube.report.numbers import number_text, quantity_text
from gearlube.report.parts import (
    GOOD,
    NOTE,
    WARNING,
    Figure,
    Finding,
    Input,
    Number,
    Report,
)
from gearlube.report.pictures import shown
from gearlube.variation.figures import line_axis, line_figure
from gearlube.variation.store import gridded
from gearlube.variation.summary import inputs_of, varies
from gearlube.variation.tables import MOST, Shown, conditions, shown_quantities, tables, units_of

_STRONG = 0.5  # rank correlation from which a quantity is said to follow an input
_NAMED = 2
_LIMITS = (
    "Each point holds what its study holds; the limits of that study apply.",
    "A rank correlation says that a quantity follows an input, not by how much; below about 50 "
    "samples it scatters by 0.15 and more.",
    "Shares and ends of a distribution are those of the samples drawn; with the seed they repeat.",
)


def findings(results: xr.Dataset, summary: xr.Dataset) -> list[Finding]:
    """Return the findings of a variation, the most important first."""
    failed, points = int(summary["failed"].sum()), results.sizes["point"]
    lacking = []
    if failed:
        lacking = [Finding(WARNING, f"{failed} of {points} points failed.", "points.csv says why.")]
    if failed == points:
        return lacking
    ranges = [
        _range(summary, one)
        for one in shown_quantities(results)
        if np.isfinite(results[one.name]).any()
    ]
    return [*_limits(summary), *ranges, *lacking, *_outside(results)]


def numbers(results: xr.Dataset, summary: xr.Dataset) -> list[Number]:
    """Return the key numbers of a variation: mean and ends of each shown quantity."""
    found = []
    for one in shown_quantities(results):
        values = one.factor * summary["statistics"].sel(quantity=one.name)
        found += [
            Number(f"{one.meaning}: {words}", _over_axes(values, statistic), one.unit)
            for statistic, words in (("low", "least"), ("mean", "mean"), ("high", "largest"))
        ]
    return found


def _over_axes(values: xr.DataArray, statistic: str) -> float:
    one = values.sel(statistic=statistic).values
    if not np.isfinite(one).any():
        return float("nan")
    return float({"low": np.nanmin, "high": np.nanmax}.get(statistic, np.nanmean)(one))


def _range(summary: xr.Dataset, one: Shown) -> Finding:
    values = one.factor * summary["statistics"].sel(quantity=one.name)
    low, mean, high = (_over_axes(values, name) for name in ("low", "mean", "high"))
    said = [*_axis_effects(values), *_strongest(summary, one.name)]
    if summary.sizes["input"]:
        said.append(_scatter(values, one))
    return Finding(
        NOTE,
        f"{one.meaning[0].upper()}{one.meaning[1:]}: {number_text(low)} to "
        f"{quantity_text(high, one.unit)}, mean {quantity_text(mean, one.unit)}.",
        " ".join(said),
    )


def _axis_effects(values: xr.DataArray) -> list[str]:
    """Return how the mean changes from the first to the last value of each axis with numbers."""
    mean = values.sel(statistic="mean")
    said = []
    for axis in mean.dims:
        if mean[axis].dtype.kind != "f" or mean.sizes[axis] < 2:
            continue
        first, last = (float(mean.isel({axis: i}).mean()) for i in (0, -1))
        if not (np.isfinite(first) and np.isfinite(last)) or first == 0.0:
            continue
        ends = (float(mean[axis][i]) for i in (0, -1))
        words = " to ".join(f"{end:g}" for end in ends)
        change = 100.0 * (last / first - 1.0)
        sign = "+" if change > 0.0 else ""
        said.append(f"Over {axis} {words} it changes by {sign}{number_text(change)} %.")
    return said


def _strongest(summary: xr.Dataset, name: str) -> list[str]:
    if not summary.sizes["input"]:
        return []
    ranks = summary["rank_correlation"].sel(quantity=name)
    mean = ranks.mean([d for d in ranks.dims if d != "input"]).values
    if not np.isfinite(mean).any():
        return []
    order = np.argsort(-np.abs(np.nan_to_num(mean)))
    strong = [
        f"{summary['input'].values[i]} ({mean[i]:+.2f})".replace("-", "−")
        for i in order[:_NAMED]
        if abs(np.nan_to_num(mean)[i]) >= _STRONG
    ]
    if not strong:
        return ["No single input dominates (rank correlations below 0.5)."]
    return [f"It follows most {' and '.join(strong)}, by rank correlation."]


def _scatter(values: xr.DataArray, one: Shown) -> str:
    low, high = (float(values.sel(statistic=p).mean()) for p in ("p2.5", "p97.5"))
    over = ", mean over the axes" if values.sel(statistic="mean").size > 1 else ""
    ends = f"{number_text(low)} and {quantity_text(high, one.unit)}"
    return f"95 % of the samples lie between {ends}{over}."


def _limits(summary: xr.Dataset) -> list[Finding]:
    if "limited" not in summary.coords:
        return []
    found = []
    for name, limit in zip(summary["limited"].values, summary["limit"].values, strict=True):
        unit = str(summary["unit"].sel(quantity=name).values)
        share = 100.0 * float(summary["share_above"].sel(limited=name).mean())
        found.append(
            Finding(
                GOOD if share == 0.0 else WARNING,
                f"{share:.3g} % of the points have a {name} above "
                f"{quantity_text(float(limit), '' if unit == '1' else unit)}.",
            )
        )
    return found


def _outside(results: xr.Dataset) -> list[Finding]:
    if "range_exceeded" not in results:
        return []
    outside = results["range_exceeded"].values
    share = 100.0 * float(np.mean(outside[np.isfinite(outside)] > 0.0))
    if share == 0.0:
        return [Finding(GOOD, "No point left the range of a formula or table.")]
    beyond = results.isel(point=np.flatnonzero(outside > 0.0))
    box = [
        f"{key} {number_text(beyond[key].values.min())} to {number_text(beyond[key].values.max())}"
        for key in units_of(results)
        if beyond[key].dtype.kind in "fiu"
    ]
    where = f" All lie within {', '.join(box)}; elsewhere results are usable." if box else ""
    return [
        Finding(
            WARNING,
            f"{share:.3g} % of the points are extrapolated beyond a formula or table.{where}",
            "points.csv says which.",
        )
    ]


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
        tables=tables(results, summary),
        inputs=_inputs(results),
        limits=_LIMITS,
        files=("results.zarr", "points.csv", "summary.csv", "figures/"),
    )


def _figures(results: xr.Dataset, summary: xr.Dataset) -> list[Figure]:
    found = []
    quantities = shown_quantities(results)
    if line_axis(summary):
        lines = "; the median of the samples, the band has 95 % of them."
        if not summary.sizes["input"]:
            lines = ", a line for each combination of the other axes."
        found.append(
            shown(
                "lines",
                f"Over {line_axis(summary)}",
                f"The quantities over the longest axis{lines}",
                line_figure(results, summary),
            )
        )
    if not summary.sizes["input"]:
        return found
    if drawn := [one for one in quantities if _varies(results, one)]:
        found.append(
            Figure(
                name="histograms",
                title="Distributions",
                caption="How many samples have which value, for each combination of the axes.",
                chart=histogram_chart(results, summary, drawn),
            )
        )
    for one in quantities[:MOST]:
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


def histogram_chart(results: xr.Dataset, summary: xr.Dataset, shown: list[Shown]) -> Any:
    """Return the distributions of the shown quantities, a panel for each."""
    from plotly.subplots import make_subplots

    chart = make_subplots(
        rows=len(shown),
        cols=1,
        vertical_spacing=0.36 / max(len(shown), 2),
    )
    chart.update_layout(template=None, height=300 * len(shown) + 80, barmode="overlay")
    over = gridded(results)[[one.name for one in shown]].load()
    for row, one in enumerate(shown, 1):
        for number, (words, cell) in enumerate(conditions(summary)[:MOST]):
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
        axis = Axis(one.meaning, one.unit)
        chart.update_xaxes(title_text=axis.label, row=row, col=1)
        chart.update_yaxes(title_text="points", row=row, col=1)
    return chart


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
