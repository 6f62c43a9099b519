"""Measurements against the results of a run: residuals, what may explain them, a report."""

from __future__ import annotations

import io
import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlube.output.csv_text import csv_text
from gearlube.output.csv_text import number_text as csv_number
from gearlube.plotting.style import BLUE, GREY, house_style, new_figure
from gearlube.report.numbers import quantity_text, unit_words
from gearlube.report.parts import (
    GOOD,
    NOTE,
    WARNING,
    Column,
    Figure,
    Finding,
    Number,
    Report,
    Table,
)
from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.field_units import field_unit
from gearlube_core.input_file.measurements import KINDS, Measurements
from gearlube_core.storage.atomic_file import read_dataset
from gearlube_core.units import ZERO_CELSIUS, rpm_to_rads

if TYPE_CHECKING:  # help does without it
    import xarray as xr

FEWEST = 3  # points inside the run's range
_SAME = 1e-6  # relative distance of equal coordinates
_CHANCE = 0.01  # by which fewer points are inside, if the bars hold 95 %
_LEAST_EXPLAINED = 0.3  # share of the residuals' squares
_DPI = 150
_AXES = {  # of the residuals
    "order": "order of the mesh frequency",
    "speed_rpm": "speed [rpm]",
    "entrainment_m_s": "mean speed of the surfaces [m/s]",
}
_FROM = {"rad/s": (rpm_to_rads(1.0), 0.0), "K": (1.0, ZERO_CELSIUS)}  # of a run, from a table's


@dataclass(frozen=True, kw_only=True)
class Compared:
    """Measurements beside what a run predicts for them.

    Parameters
    ----------
    measured : Measurements
        The points inside the range of the run.
    left_out : str
        The others in words; "" for none.
    predicted, low, high : ndarray of shape (n,)
        In the unit of the measurements; the bar is NaN where the run has none.
    swings : mapping of str to ndarray of shape (n,)
        By how much an uncertain input at its factor moves what is predicted.

    Examples
    --------
    >>> measured = Measurements(path="a.csv", kind="axle_loss", lines=np.arange(2, 6),
    ...     conditions={"speed_rpm": np.array([1e3, 2e3, 3e3, 4e3])},
    ...     value=np.array([1.1, 2.2, 3.3, 4.4]), uncertainty=np.full(4, 0.2))
    >>> found = Compared(measured=measured, left_out="", predicted=np.array([1.0, 2.0, 3.0, 4.0]),
    ...     low=np.full(4, np.nan), high=np.full(4, np.nan),
    ...     swings={"seals": np.ones(4), "churning": np.array([1.0, 2.0, 3.0, 4.0])})
    >>> found.en.round(2).tolist(), found.share_inside
    ([0.5, 1.0, 1.5, 2.0], 0.5)
    >>> round(found.explained["churning"][0], 3)  # all of it
    1.0
    """

    measured: Measurements
    left_out: str
    predicted: Array
    low: Array
    high: Array
    swings: Mapping[str, Array]

    @property
    def residual(self) -> Array:
        """Measured less predicted."""
        return self.measured.value - self.predicted

    @property
    def share(self) -> Array:
        """Residual over what is predicted; NaN where that is next to nothing."""
        least = _SAME * float(np.abs(self.predicted).max())
        nothing = np.abs(self.predicted) <= least
        return np.asarray(self.residual / np.where(nothing, np.nan, self.predicted))

    @cached_property
    def bar(self) -> Array:
        """Length of the run's bar towards the measured value; 0 where it has none."""
        above = self.residual > 0.0
        return np.nan_to_num(np.where(above, self.high - self.predicted, self.predicted - self.low))

    @cached_property
    def en(self) -> Array:
        """Residual over both uncertainties (k = 2) together, the number E_n of ISO/IEC 17043."""
        return np.asarray(self.residual / np.hypot(self.measured.uncertainty, self.bar))

    @property
    def share_inside(self) -> float:
        """Share of the points with |E_n| of at most 1."""
        return float(np.mean(np.abs(self.en) <= 1.0 + 1e-12))

    @cached_property
    def explained(self) -> dict[str, tuple[float, float]]:
        """By input: the share of the residuals' squares that it takes away alone, largest first.

        And how much of its bar that needs, below 0: smaller values. Both with the residuals weighed
        by the uncertainty of the measurements, and with the bar as prior.
        """
        weighed = self.residual / (0.5 * self.measured.uncertainty)
        found = {}
        for name, swing in self.swings.items():
            column = swing / (0.5 * self.measured.uncertainty)
            part = float(column @ weighed / (column @ column + 4.0))  # the end is 2 deviations
            left = weighed - part * column
            found[name] = 1.0 - float(left @ left / (weighed @ weighed)), part
        return dict(sorted(found.items(), key=lambda one: -one[1][0]))


def compared(folder: Path, measured: Measurements) -> Compared:
    """Return measurements beside the results of a run in a folder, between its points by lines.

    Raises
    ------
    ParameterError
        The folder has no results of the kind that was measured, or fewer than three points are in
        their range.
    FileError
        The results are damaged.
    """
    kind = KINDS[measured.kind]
    if not kind.file:
        from gearlube.report.measured_films import compared_films  # which knows this module

        return compared_films(folder, measured)
    if not (folder / kind.file).is_file():
        raise ParameterError(
            f"{folder} must be a folder of `{kind.command}` with its {kind.file}, got none. "
            f"{measured.path} measures {kind.words}. Give the folder of such a run."
        )
    dataset = read_dataset(folder / kind.file)
    if measured.kind == "transmission_error":
        dataset = _orders(dataset)
    dataset = dataset.isel(law=0) if "law" in dataset.dims else dataset
    places: dict[str, Array] = {}
    inside, ranges = np.ones(measured.value.size, dtype=bool), []
    for column, values in measured.conditions.items():
        unit, ending = field_unit(column)
        dim = column.removesuffix(ending)
        dataset = dataset.sortby(dim)  # loads of bearings stand as they were asked for
        factor, zero = _FROM.get(dataset[dim].attrs.get("units", ""), (1.0, 0.0))
        grid = (dataset[dim].values - zero) / factor
        room = _SAME * max(float(np.abs(grid).max()), 1.0)
        inside &= (values >= grid.min() - room) & (values <= grid.max() + room)
        places[dim] = values * factor + zero
        words = f"{dim.replace('_', ' ')} {grid.min():.6g} to {grid.max():.6g} {unit}"
        ranges.append(words.strip())
    names = [kind.variable, f"{kind.variable}_low", f"{kind.variable}_high"]
    found = [
        _between(dataset[name], places) if name in dataset else np.full(inside.size, np.nan)
        for name in names
    ]
    inside &= np.isfinite(found[0])  # a point of the run may have failed
    left_out = (
        f"{measured.named(~inside)}. The run has {', '.join(ranges)}; nothing is extrapolated."
    )
    if inside.sum() < FEWEST:
        raise ParameterError(
            f"At least {FEWEST} points of {measured.path} must be in the range of {folder}, got "
            f"{inside.sum()} of {inside.size}. Outside: {left_out} Run `{kind.command}` over the "
            "range that was measured."
        )
    inputs = dataset["input"].values if "swing" in dataset else ()
    value, low, high = (np.asarray(one[inside]) for one in found)
    return Compared(
        measured=measured.chosen(inside),
        left_out="" if inside.all() else left_out,
        predicted=value,
        low=low,
        high=high,
        swings={
            str(one): _between(dataset["swing"].sel(input=one), places)[inside] for one in inputs
        },
    )


def _orders(dataset: xr.Dataset) -> xr.Dataset:
    """Return the amplitudes of the loaded transmission error [urad] over torque and order."""
    import xarray as xr

    rotation = dataset["rotation"].sel(side="drive").transpose("torque", "phase").values
    amplitude = 2e6 * np.abs(np.fft.rfft(rotation, axis=1)) / rotation.shape[1]
    coords = {"torque": dataset["torque"].values, "order": np.arange(1.0, amplitude.shape[1])}
    return xr.Dataset({"amplitude": (tuple(coords), amplitude[:, 1:])}, coords=coords)


def _between(values: xr.DataArray, places: Mapping[str, Array]) -> Array:
    """Return values at places by lines along each axis; beyond an axis those at its end."""
    from scipy.interpolate import interpn

    values = values.transpose(*places)
    wide = [dim for dim in places if values.sizes[dim] > 1]
    if not wide:
        return np.full(len(next(iter(places.values()))), values.values.item())
    axes = [values[dim].values for dim in wide]
    at = [np.clip(places[dim], x[0], x[-1]) for dim, x in zip(wide, axes, strict=True)]
    return np.asarray(interpn(axes, values.values.squeeze(), np.stack(at, axis=-1)))


def comparison_with_measured(found: Compared, run: str) -> Report:
    """Return the report on measurements beside a run; `run` is what the run is called."""
    measured, unit = found.measured, _unit(found)
    residual, share = found.residual, found.share
    columns = _columns(found)
    return Report(
        study="compare",
        title=f"{Path(measured.path).name} and {run}",
        subtitle=f"{KINDS[measured.kind].words.capitalize()} as measured, beside the results of "
        f"{run}: {residual.size} points.",
        findings=_findings(found),
        numbers=[
            Number("points compared", residual.size, digits=1),
            Number("bias, measured less predicted", float(residual.mean()), unit),
            Number("bias over what is predicted", 100.0 * float(np.nanmean(share)), "%"),
            Number("rms of the residuals", _rms(residual), unit),
            Number("rms over what is predicted", 100.0 * _rms(share), "%"),
            Number("points within the bars of 95 %", 100.0 * found.share_inside, "%"),
            Number("largest |E_n|", float(np.abs(found.en).max())),
        ],
        figures=[
            Figure(
                name="measured",
                title="Measured and predicted",
                caption="Left: on the line both agree. Right: measured less predicted; grey is the "
                "bar of the run. All bars hold 95 %.",
                picture=png_bytes(measured_figure(found)),
            )
        ],
        tables=[
            *_explained(found),
            Table(
                title="Points",
                columns=[Column("point"), *(Column(name, unit) for name in columns), Column("E_n")],
                rows=[
                    [measured.where(k), *(_cell(one[k]) for one in (*columns.values(), found.en))]
                    for k in range(residual.size)
                ],
                folded=True,
            ),
        ],
        limits=(
            "Between the points of the run its results are taken along straight lines; beyond "
            "them nothing is compared. Films are solved at each point.",
            "E_n is the residual over the root of the sum of the squares of both uncertainties "
            "(k = 2). Up to 1 in size it is within them.",
            "One bar of the run holds for all its points together: with the same cause, all "
            "points are off to the same side.",
            "Of an input the run keeps how far it moves each point, not the direction: an input "
            "that raises some points and lowers others is not recognised.",
        ),
        facts=[("measurements", measured.path), ("run", run)],
        files=("residuals.csv", "figures/measured.png"),
    )


def residuals_text(found: Compared) -> str:
    """Return a table of the points, with names that end with their unit."""
    measured = found.measured
    ending = KINDS[measured.kind].uncertainty.removeprefix("uncertainty")
    values = {f"{name.replace(' ', '_')}{ending}": one for name, one in _columns(found).items()}
    columns = [measured.lines, *measured.conditions.values(), *values.values(), found.en]
    rows = [[csv_number(float(cell)) for cell in row] for row in zip(*columns, strict=True)]
    return csv_text(("line", *measured.conditions, *values, "en"), rows)


def measured_figure(found: Compared) -> Any:
    """Return measured against predicted values, and residuals over the speed or the order."""
    measured, unit = found.measured, _unit(found)
    column = next(name for name in _AXES if name in measured.conditions)
    at, value, own = measured.conditions[column], measured.value, measured.uncertainty
    below, above = np.maximum(
        np.nan_to_num([found.predicted - found.low, found.high - found.predicted]), 0.0
    )
    look: dict[str, Any] = {"fmt": "o", "color": BLUE, "elinewidth": 0.8}
    grey: dict[str, Any] = {"fmt": "none", "ecolor": GREY, "elinewidth": 5.0, "alpha": 0.5}
    with house_style():
        figure = new_figure(9.4, 4.2)
        left, right = figure.subplots(1, 2)
        left.errorbar(found.predicted, value, own, [below, above], ecolor=GREY, **look)
        ends = np.array([min(0.0, value.min()), 1.05 * max(value.max(), found.predicted.max())])
        left.plot(ends, ends, color="black", lw=1.0, label="equal")
        left.set(xlabel=f"predicted [{unit}]", ylabel=f"measured [{unit}]")
        right.errorbar(at, 0.0 * at, [below, above], label="bar of the run", **grey)
        right.errorbar(at, found.residual, own, label="point with its bar", **look)
        right.axhline(0.0, color="black", lw=1.0)
        right.set(xlabel=_AXES[column], ylabel=f"measured less predicted [{unit}]")
        figure.legend(loc="outside lower center", ncols=3)
    return figure


def png_bytes(figure: Any) -> bytes:
    """Return a figure of matplotlib as PNG."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=_DPI)
    return buffer.getvalue()


def _columns(found: Compared) -> dict[str, Array]:
    return {
        "measured": found.measured.value,
        "uncertainty": found.measured.uncertainty,
        "predicted": found.predicted,
        "predicted low": found.low,
        "predicted high": found.high,
        "residual": found.residual,
    }


def _cell(value: float) -> float | None:
    return None if math.isnan(value) else float(value)


def _unit(found: Compared) -> str:
    return unit_words(KINDS[found.measured.kind].unit)


def _rms(values: Array) -> float:
    return float(np.sqrt(np.nanmean(values**2)))


def _findings(found: Compared) -> list[Finding]:
    from scipy.stats import binom

    measured, unit, size = found.measured, _unit(found), found.residual.size
    inside = round(found.share_inside * size)
    believed = binom.cdf(inside, size, 0.95) >= _CHANCE
    off = 100.0 * float(np.nanmean(found.share))
    worst = int(np.argmax(np.abs(found.en)))
    result = [
        Finding(
            GOOD if believed else WARNING,
            f"{inside} of {size} points are within the bars of 95 %.",
            f"The farthest is {measured.where(worst)}: {quantity_text(measured.value[worst], unit)}"
            f" measured, {quantity_text(found.predicted[worst], unit)} predicted, E_n "
            f"{found.en[worst]:.2g}.",
        ),
        Finding(
            NOTE,
            f"Measured is {abs(off):.1f} % {'above' if off > 0.0 else 'below'} predicted as a mean "
            f"({quantity_text(abs(float(found.residual.mean())), unit)}), the residuals' rms is "
            f"{quantity_text(_rms(found.residual), unit)}.",
        ),
    ]
    if found.left_out:
        words = "Points outside the run were left out."
        result.append(Finding(WARNING, words, f"Left out: {found.left_out}"))
    if not np.isfinite(found.low).any():
        words = "The run has no error bars: only the uncertainty of the measurements counts."
        of_map = measured.kind == "axle_loss"
        result.append(Finding(NOTE, words, "`gearlube map --draws 60` has some." * of_map))
    for name, (share, part) in list(found.explained.items())[:1]:
        words = f"No uncertain input alone explains the residuals; best is {_words(name)}."
        if share >= _LEAST_EXPLAINED:
            words = (
                f"The input {_words(name)} alone explains {100.0 * share:.0f} % of the residuals' "
                f"squares, with {abs(part):.2f} of its bar towards "
                f"{'larger' if part > 0.0 else 'smaller'} values."
            )
        result.append(Finding(NOTE, words, "The table has all inputs."))
    return result


def _words(name: str) -> str:
    return name.replace("_", " ")


def _explained(found: Compared) -> list[Table]:
    table = Table(
        title="What may explain the residuals",
        columns=[Column("input"), Column("explains", "%", 2), Column("of its bar", "", 2)],
        rows=[[_words(name), 100.0 * s, part] for name, (s, part) in found.explained.items()],
        caption="Share of the residuals' squares, weighed by the measurements' uncertainty, that "
        "one input takes away alone, and the part of its bar that this needs; below 0: smaller "
        "values. Above 1 the input is hardly the only cause.",
    )
    return [table] if found.explained else []
