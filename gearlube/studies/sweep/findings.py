"""Findings of a sweep as sentences with numbers."""

from __future__ import annotations

import numpy as np
import xarray as xr

from gearlube.plotting.range_words import usable_words
from gearlube.plotting.words import held_words, largest_losses, not_modelled
from gearlube.report.churning import regime_findings
from gearlube.report.films import (
    bearing_drag,
    covered_share,
    efficiency_error,
    film_ratio_level,
    film_ratio_words,
    flank_friction,
    model_of,
    points_beyond,
    solved_films,
    solved_rollers,
)
from gearlube.report.numbers import quantity_text
from gearlube.report.parts import GOOD, NOTE, WARNING, Finding
from gearlube.studies.sweep.datasets import GRID
from gearlube.studies.sweep.peaks import (
    ORDERS,
    PEAKS,
    NearMode,
    Peak,
    crossings,
    largest_loss,
    largest_peaks,
    loss_band,
    nearest_mode,
    peak_orders,
)
from gearlube.studies.sweep.point import FINISHED
from gearlube.studies.sweep.scalars import DOUBLE_SIDED, NONE
from gearlube_core.arrays import Array
from gearlube_core.film_model.model import FLANK, ROLLER
from gearlube_core.units import ZERO_CELSIUS

NEAR = 0.1  # of a natural frequency, within which an order is said to sit on it
_CLOSED = 1e-3  # of the input, below which the energy balance is called closed
_SAME = 0.01  # of a natural frequency, within which a peak is said to lie at it
_FAR = 0.5  # of a natural frequency, from which it has nothing to do with a peak
_OF_CAR = 0.3  # of the strain energy, from which a mode is said to be one of the car
_FINE = 1.5  # km/h, a gap between speeds that resolves a resonance of 2 % damping from 40 km/h on
_LEAST_LOSS = 1e-9  # W
_NAMED = 3  # crossings that are named one by one


def findings(dataset: xr.Dataset) -> list[Finding]:
    """Return the findings of a merged sweep, the most important first.

    Examples
    --------
    >>> findings(gl.run_sweep(settings, [60.0], [2500.0]))[0].headline  # doctest: +SKIP
    'Bearing 1 shakes the housing most with mesh order 1: 57.6 N across the pinion (y) at 52 ...'
    """
    failed = int((dataset["status"] != FINISHED).sum())
    points = dataset["status"].size
    found = []
    if failed:
        found.append(
            Finding(
                WARNING,
                f"{failed} of {points} points failed.",
                "The reasons are in the table of failed points.",
            )
        )
    if failed < points:
        answers = [*_whine(dataset), *_contact(dataset)]
        found = [
            *answers[:1],
            *found,
            *answers[1:],
            *_resonance(dataset),
            *_loss(dataset),
            *_film(dataset),
            *_solved(dataset),
            *_solved_rollers(dataset),
            *_rollers(dataset),
            *_churning(dataset),
            *_ranges(dataset),
            *_balance(dataset),
        ]
    return found


def _whine(dataset: xr.Dataset) -> list[Finding]:
    tops = largest_peaks(dataset)
    found = []
    top = tops.get("bearing_force_spectrum")
    if top and top.amplitude > 0.0:
        headline = (
            f"Bearing 1 shakes the housing most with mesh order {top.order}: "
            f"{quantity_text(top.amplitude, 'N')} across the pinion (y)"
        )
        found.append(_peak(dataset, top, "bearing_force_spectrum", headline))
    if top := tops.get("dte_spectrum"):
        words = "; ".join(
            f"order {p.order} {quantity_text(1e6 * p.amplitude, 'µm')} at {p.speed_kmh:g} km/h"
            for p in sorted(peak_orders(dataset), key=lambda one: -one.amplitude)[1:]
        )
        headline = (
            f"The largest mesh order of the transmission error is order {top.order}: "
            f"{quantity_text(1e6 * top.amplitude, 'µm')}"
        )
        others = f"The others: {words}." if words else ""
        found.append(_peak(dataset, top, "dte_spectrum", headline, others))
    return found


def _peak(
    dataset: xr.Dataset, top: Peak, variable: str, headline: str, others: str = ""
) -> Finding:
    """Return the finding of a peak: its place, its resonance, and what it is without the car."""
    said, resonant = [others] if others else [], False
    if near := nearest_mode(dataset, top):
        off = top.frequency / near.frequency - 1.0
        resonant = abs(off) < NEAR
        if abs(off) < _FAR:
            side = "above" if off > 0.0 else "below"
            apart = f"{100.0 * abs(off):.0f} % {side}" if abs(off) > _SAME else "at"
            said.append(
                f"The peak lies {apart} the nearest natural frequency, '{near.name}' at "
                f"{near.frequency:.0f} Hz."
            )
        if resonant:
            said.append("So the peak is a resonance, or close to one.")
            if near.car_strain > _OF_CAR:
                said.append(_of_the_car(dataset, near, top.amplitude, variable))
    speeds = dataset["speed_kmh"].values
    at = int(np.argmin(np.abs(speeds - top.speed_kmh)))
    gap = float(np.diff(speeds)[max(at - 1, 0) : at + 1].max(initial=0.0))
    if gap > _FINE:
        said.append(
            f"Speeds lie up to {gap:g} km/h apart here: a narrow peak can be larger between them."
        )
    return Finding(
        WARNING if resonant else NOTE,
        f"{headline} at {top.speed_kmh:g} km/h ({top.frequency:.0f} Hz), preload "
        f"{top.preload:g} N.",
        " ".join(said),
    )


def _of_the_car(dataset: xr.Dataset, near: NearMode, amplitude: float, variable: str) -> str:
    """Say how much of a resonance is in the car, and what the order is without the car."""
    given = dataset.attrs.get("inputs_assumed", "")
    assumed = ", whose stiffnesses are assumed" if "driveline.propshaft_stiffness" in given else ""
    said = (
        f"{100.0 * near.car_strain:.0f} % of its strain energy is in springs of the car{assumed}, "
        f"most in the {near.spring}."
    )
    without = float(dataset.get(PEAKS[variable], np.nan))
    if without > 0.0:
        force = variable.startswith("bearing")
        size = quantity_text(without if force else 1e6 * without, "N" if force else "µm")
        said += f" {held_words(size, amplitude / without)}"
    return said


def _resonance(dataset: xr.Dataset) -> list[Finding]:
    all_of_them = crossings(dataset)
    if not all_of_them:
        return []
    low, high = (float(dataset["speed_kmh"].values[i]) for i in (0, -1))
    span = f"between {low:g} and {high:g} km/h" if high > low else f"at {low:g} km/h"
    first = [one for one in all_of_them if one.preload == all_of_them[0].preload]
    inside = [one for one in first if one.margin == 0.0]
    if not inside:
        nearest = min(all_of_them, key=lambda one: one.margin)
        level = GOOD if nearest.margin > NEAR else NOTE
        return [
            Finding(
                level,
                f"No mesh order 1 to {ORDERS[-1]} meets a natural frequency {span}; the smallest "
                f"margin is {100.0 * nearest.margin:.0f} %.",
                f"That is {nearest}.",
            )
        ]
    first_order = [one for one in inside if one.order == 1]
    listed = first_order or inside
    more = f", and {len(listed) - _NAMED} more" if len(listed) > _NAMED else ""
    return [
        Finding(
            NOTE,
            f"Mesh orders 1 to {ORDERS[-1]} meet natural frequencies {len(inside)} times {span}; "
            f"{len(first_order)} of these are order 1.",
            f"At preload {listed[0].preload:g} N: {'; '.join(map(str, listed[:_NAMED]))}{more}. "
            "The table of natural frequencies lists all.",
        )
    ]


def _contact(dataset: xr.Dataset) -> list[Finding]:
    kinds = dataset["separation"].values
    known = np.isfinite(kinds)
    apart = known & (kinds != NONE)
    if not np.any(apart):
        least = 1e6 * _least(dataset["dte_min"])
        return [
            Finding(
                GOOD,
                "The teeth stay in contact at every point.",
                f"The smallest transmission error is {quantity_text(least, 'µm')}; contact is lost "
                "below zero.",
            )
        ]
    speeds = _speeds_where(dataset, apart)
    double = int(np.sum(kinds[known] == DOUBLE_SIDED))
    share = 100.0 * _most(dataset["separated_fraction"])
    return [
        Finding(
            WARNING,
            f"The teeth separate at {int(apart.sum())} of {int(known.sum())} points: {speeds}.",
            f"At most {share:.0f} % of the time is without contact. "
            + (
                f"At {double} points the coast flanks come into contact too."
                if double
                else "The coast flanks do not come into contact."
            ),
        )
    ]


def _loss(dataset: xr.Dataset) -> list[Finding]:
    point = largest_loss(dataset)
    parts = largest_losses(dataset["source"].values, point["loss"].values)
    band = " (95 %: {:.0f} to {:.0f} W)".format(*ends) if (ends := loss_band(point)) else ""
    efficiency = dataset["efficiency_axle"]
    losing = {
        str(name)
        for name in dataset["source"].values
        if np.any(np.nan_to_num(dataset["loss"].sel(source=name).values) > 0.0)
    }
    return [
        Finding(
            NOTE,
            f"The largest loss is {quantity_text(float(point['loss'].sum()), 'W')}{band} at "
            f"{float(point['speed_kmh']):g} km/h and preload {float(point['preload']):g} N: "
            f"{parts}.",
            f"The efficiency of the axle is {100.0 * _least(efficiency):.1f} to "
            f"{100.0 * _most(efficiency):.1f} %. Not modelled: "
            f"{', '.join(not_modelled(losing))}.",
        )
    ]


def _film(dataset: xr.Dataset) -> list[Finding]:
    ratio = dataset["film_ratio_min"].values
    if not np.any(np.isfinite(ratio)):
        return []
    row, column = _place(-ratio)
    least, point = float(ratio[row, column]), dataset.isel(preload=row, speed=column)
    film = quantity_text(1e6 * float(point["film_thickness_min"]), "µm")
    names = ["friction_viscous", "friction_boundary"]
    oil, touch = point["loss"].reindex(source=names, fill_value=0.0).values
    share = 100.0 * touch / max(oil + touch, _LEAST_LOSS)
    part = f" Asperities cause {share:.0f} % of the flank friction there." if share > 0.0 else ""
    return [
        Finding(
            film_ratio_level(least),
            f"The smallest film ratio λ of a loaded flank is {quantity_text(least, '', 2)}, at "
            f"{float(point['speed_kmh']):g} km/h and preload {float(point['preload']):g} N "
            f"(film {film}).",
            film_ratio_words(least) + part,
        )
    ]


def _solved(dataset: xr.Dataset) -> list[Finding]:
    """Say how far the model of solved films is to be trusted, where the axle took it."""
    if not _taken(dataset, "friction_loss_bound", "share_outside"):
        return []
    bound = covered_share(dataset["friction_loss_bound"], flank_friction(dataset["loss"]))
    most, words = _outside(dataset["share_outside"], "flanks")
    error, model = efficiency_error(dataset), model_of(dataset, FLANK)
    return [solved_films(bound, most, words, error, model)]


def _taken(dataset: xr.Dataset, bound: str, outside: str) -> bool:
    """Return whether a film model was taken: bounds are 0 else, nan where it covers too little."""
    if bound not in dataset:
        return False
    return bool(((dataset[bound] > 0.0) | (dataset[outside] > 0.0)).any())


def _solved_rollers(dataset: xr.Dataset) -> list[Finding]:
    """Say the same of the model of rollers."""
    if not _taken(dataset, "drag_bound", "rollers_outside"):
        return []
    bound = covered_share(dataset["drag_bound"], bearing_drag(dataset["loss"]))
    most, words = _outside(dataset["rollers_outside"], "rollers")
    return [solved_rollers(bound, most, words, model=model_of(dataset, ROLLER))]


def _outside(share: xr.DataArray, whose: str) -> tuple[float, str]:
    """Return the largest share of load outside a film model [-], and it in words with its place."""
    row, column = _place(share.values)
    point = share.isel(preload=row, speed=column)
    most = float(point)
    return most, (
        f"at most {100.0 * most:.0f} % of the {whose}' load, at {float(point['speed_kmh']):g} km/h "
        f"and preload {float(point['preload']):g} N{points_beyond(share)}"
    )


def _churning(dataset: xr.Dataset) -> list[Finding]:
    if "churning_regime" not in dataset:
        return []
    grid = dataset.transpose(*GRID, ...)
    regime, oil = grid["churning_regime"].values, grid["oil_temperature"].values - ZERO_CELSIUS
    speed = np.broadcast_to(grid["speed_kmh"].values, regime.shape)
    loss = grid["loss"].sel(source="churning").values
    return regime_findings(regime, speed, "km/h", loss, oil)


def _rollers(dataset: xr.Dataset) -> list[Finding]:
    least = dataset["bearing_roller_load_min"].min("bearing").values
    known = np.isfinite(least)
    free = known & (least <= 0.0)
    most = quantity_text(_most(dataset["bearing_roller_load_max"]), "N")
    if np.any(free):
        return [
            Finding(
                WARNING,
                f"Rollers leave their races at {int(free.sum())} of {int(known.sum())} points: "
                f"{_speeds_where(dataset, free)}.",
                f"There the preload is too low. The largest load of a roller is {most}.",
            )
        ]
    return [
        Finding(
            GOOD,
            f"Every roller stays loaded: at least {quantity_text(_least(least), 'N')}, at most "
            f"{most}.",
        )
    ]


def _ranges(dataset: xr.Dataset) -> list[Finding]:
    if "range_exceeded" not in dataset:
        return []
    left = np.nan_to_num(dataset["range_exceeded"].values) > 0.0
    good = dataset["status"].values == FINISHED
    axes = [(dataset["preload"].values, "N"), (dataset["speed_kmh"].values, "km/h")]
    if not np.any(left):
        return [Finding(GOOD, "No finished point left the range of a formula or table.")]
    return [
        Finding(
            WARNING,
            f"{int(left.sum())} of {int(good.sum())} points left the range of a formula or table. "
            f"{usable_words(good & ~left, axes)}",
            "What is computed there is extrapolated; the table of ranges says which.",
        )
    ]


def _balance(dataset: xr.Dataset) -> list[Finding]:
    worst = float(np.nanmax(np.abs(dataset["energy_closure_error"].values)))
    if not np.isfinite(worst):
        return []
    size = quantity_text(1e6 * worst, "ppm of the input", 2)
    if worst < _CLOSED:
        return [Finding(GOOD, f"The energy balance closes to {size} at every point.")]
    return [
        Finding(
            WARNING,
            f"The energy balance has an error of up to {size}.",
            "Use more time steps per mesh period.",
        )
    ]


def _speeds_where(dataset: xr.Dataset, where: Array) -> str:
    """Return the speeds at which a condition holds at any preload, as ranges if they are many."""
    speeds = dataset["speed_kmh"].values[np.any(where, axis=0)]
    if speeds.size > 4:
        return f"{speeds[0]:g} to {speeds[-1]:g} km/h"
    return f"{', '.join(f'{one:g}' for one in speeds)} km/h"


def _place(values: Array) -> tuple[int, int]:
    row, column = np.unravel_index(int(np.nanargmax(values)), values.shape)
    return int(row), int(column)


def _least(values: xr.DataArray | Array) -> float:
    return float(np.nanmin(np.asarray(values)))


def _most(values: xr.DataArray | Array) -> float:
    return float(np.nanmax(np.asarray(values)))
