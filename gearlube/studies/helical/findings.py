"""Findings of a study of a helical pair as sentences with numbers."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr

from gearlube.report.films import (
    film_ratio_level,
    film_ratio_words,
    formulas_stand_in,
    hot_film,
    model_of,
    solved_films,
)
from gearlube.report.numbers import number_text, quantity_text
from gearlube.report.parts import GOOD, NOTE, WARNING, Finding
from gearlube.studies.helical.pair_losses import efficiency_band, in_operation, loss_band
from gearlube.studies.helical.settings import RPM, SHOWN_MU
from gearlube_core.arrays import Array
from gearlube_core.film_model.model import LINE, MOST_OUTSIDE
from gearlube_core.tooth_contact.sharp_edge import EDGE_PRESSURE
from gearlube_core.units import ZERO_CELSIUS

Datasets = Mapping[str, xr.Dataset]
NEAR = 0.1  # of a natural frequency, within which an order is close to it
ORDERS = (1, 2, 3)  # mesh orders that are compared with natural frequencies


class Peak(NamedTuple):
    """The largest mesh order of the dynamic transmission error, at one speed or in a sweep."""

    amplitude: float  # um
    order: int
    speed: float  # rpm
    frequency: float  # Hz
    film: bool  # with the friction of the oil film, else with a constant coefficient


class Meeting(NamedTuple):
    """A mesh order and the natural frequency next to it."""

    order: int
    frequency: float  # Hz
    natural: float  # Hz
    margin: float  # of the order's frequency over the natural one, less 1


def findings(datasets: Datasets) -> list[Finding]:
    """Return the findings of a study from the datasets that it has.

    Examples
    --------
    >>> findings({"sweep": xr.load_dataset("gearlube_helical/sweep.nc")})  # doctest: +SKIP
    """
    found: list[Finding] = []
    for name, of in (
        ("losses", _losses),
        ("response", _operation),
        ("response", _margins),
        ("sweep", _sweep),
        ("separation", _separation),
        ("contact", _edges),
        ("stability", _stability),
        ("film", _film),
    ):
        if name in datasets:
            found += of(datasets[name])
    return found


def order_amplitudes(sweep: xr.Dataset) -> tuple[Array, bool]:
    """Return mesh orders of the dynamic transmission error [um], shape (speeds, orders).

    With the friction of the oil film if the sweep has it (the second value is True); else with
    the constant coefficient next to 0.1.
    """
    film = "film_delta_z_harmonic" in sweep
    found = (
        sweep["film_delta_z_harmonic"]
        if film
        else sweep["delta_z_harmonic"].sel(mu=SHOWN_MU[-1], method="nearest")
    )
    return 1e6 * found.transpose("speed", "harmonic").values, film


def largest_error(sweep: xr.Dataset) -> Peak | None:
    """Return the largest mesh order of the dynamic transmission error; None without values."""
    amplitude, film = order_amplitudes(sweep)
    if not np.isfinite(amplitude).any():
        return None
    row, column = np.unravel_index(int(np.nanargmax(amplitude)), amplitude.shape)
    order = int(sweep["harmonic"][column])
    return Peak(
        float(amplitude[row, column]),
        order,
        float(sweep["speed"][row]) / RPM,
        order * float(sweep["mesh_frequency"][row]),
        film,
    )


def meeting(order: int, mesh_frequency: float, natural: Array) -> Meeting:
    """Return the natural frequency [Hz] next to a mesh order, and how far it is."""
    frequency = order * mesh_frequency
    next_one = float(natural[int(np.argmin(np.abs(frequency / natural - 1.0)))])
    return Meeting(order, frequency, next_one, frequency / next_one - 1.0)


def operating_error(response: xr.Dataset) -> Peak:
    """Return the largest mesh order of the dynamic transmission error at the operating point.

    With the friction of the oil film if there is one, else with the largest coefficient.
    """
    amplitude = 1e6 * response["delta_z_harmonic"].transpose("case", "harmonic").values[-1]
    column = int(np.argmax(amplitude))
    order = int(response["harmonic"][column])
    return Peak(
        float(amplitude[column]),
        order,
        response.attrs["pinion_speed"] / RPM,
        order * float(response.attrs["mesh_frequency"]),
        str(response["case"].values[-1]) == "film",
    )


def _operation(response: xr.Dataset) -> list[Finding]:
    peak = operating_error(response)
    return [
        Finding(
            NOTE,
            f"At {peak.speed:.0f} rpm the largest order of the dynamic transmission error is "
            f"{quantity_text(peak.amplitude, 'µm')}: mesh order {peak.order}, at "
            f"{quantity_text(1e-3 * peak.frequency, 'kHz')}.",
            f"{_friction(peak)} This is the speed at which the pair runs.",
        )
    ]


def _friction(peak: Peak) -> str:
    return f"Friction of {'the oil film' if peak.film else 'a constant coefficient'}."


def _sweep(sweep: xr.Dataset) -> list[Finding]:
    found = []
    peak = largest_error(sweep)
    if peak is not None:
        met = meeting(1, peak.frequency, sweep["natural_frequency"].values)
        own = sweep.attrs["pinion_speed"] / RPM
        runs_there = abs(peak.speed / own - 1.0) < NEAR
        found.append(
            Finding(
                WARNING if runs_there and abs(met.margin) < NEAR else NOTE,
                f"Over the sweep the largest order is {quantity_text(peak.amplitude, 'µm')}: mesh "
                f"order {peak.order} at {peak.speed:.0f} rpm, {_away(peak.speed, own)}.",
                f"That is {quantity_text(1e-3 * peak.frequency, 'kHz')}, {_beside(met)}. "
                f"{_friction(peak)} The sweep goes from {float(sweep['speed'][0]) / RPM:.0f} to "
                f"{float(sweep['speed'][-1]) / RPM:.0f} rpm, so that it shows the resonances.",
            )
        )
    if "film_share_outside" in sweep:
        share, rpm = sweep["film_share_outside"].values, sweep["speed"].values / RPM
        found += formulas_stand_in("Films of the vibrating pair, in part,", share, rpm)
    margin = float(sweep["stability_margin"].min())
    if margin <= 0.0:
        found.append(
            Finding(
                WARNING,
                "The vibration is unstable at some speeds of the sweep.",
                "sweep.nc has no values there. More damping or a smaller swing of the stiffness "
                "helps.",
            )
        )
    return found


def _away(speed: float, own: float) -> str:
    """Return how far a speed is from the one at which the pair runs [rpm]."""
    ratio = speed / own
    if abs(ratio - 1.0) < NEAR:
        return f"within {100.0 * NEAR:.0f} % of the {own:.0f} rpm at which the pair runs"
    return f"{ratio:.2g} times the {own:.0f} rpm at which the pair runs"


def _beside(met: Meeting) -> str:
    side = "above" if met.margin >= 0.0 else "below"
    return (
        f"{100.0 * abs(met.margin):.1f} % {side} the natural frequency of "
        f"{quantity_text(1e-3 * met.natural, 'kHz')}"
    )


def _margins(response: xr.Dataset) -> list[Finding]:
    natural = response["natural_frequency"].values
    mesh = float(response.attrs["mesh_frequency"])
    met = [meeting(order, mesh, natural) for order in ORDERS]
    least = min(met, key=lambda one: abs(one.margin))
    speed = f"{response.attrs['pinion_speed'] / RPM:.0f} rpm"
    near = abs(least.margin) < NEAR
    return [
        Finding(
            WARNING if near else GOOD,
            f"At {speed} mesh order {least.order} is {_beside(least)}.",
            "Of mesh orders 1 to 3 this is the nearest. "
            + (
                "Move the speed or change teeth, supports or masses."
                if near
                else f"None is within {100.0 * NEAR:.0f} % of a natural frequency."
            ),
        )
    ]


def _separation(separation: xr.Dataset) -> list[Finding]:
    own = float(separation.attrs["mesh_damping_ratio"])
    runs_at = separation.attrs["pinion_speed"] / RPM
    found = []
    for ratio in separation["damping"].values:
        at = separation.sel(damping=ratio)
        share, speed = at["separation_share"].values, at["speed"].values / RPM
        what = f"with damping ratio {ratio:g}"
        apart = share > 0.0
        if not apart.any():
            found.append(
                Finding(
                    GOOD,
                    f"The teeth stay in contact {what}.",
                    f"From {np.nanmin(speed):.0f} to {np.nanmax(speed):.0f} rpm.",
                )
            )
            continue
        folds = int((at["special_kind"] == "fold").sum())
        low, high = speed[apart].min(), speed[apart].max()
        runs_there = (1.0 - NEAR) * low < runs_at < (1.0 + NEAR) * high
        found.append(
            Finding(
                WARNING if runs_there and np.isclose(ratio, own) else NOTE,
                f"The teeth separate from {low:.0f} to {high:.0f} rpm "
                f"{what}, up to {100.0 * np.nanmax(share):.0f} % of the time.",
                f"The pair runs at {runs_at:.0f} rpm, and its own damping ratio is {own:g}. "
                + (f"{folds} folds: the motion jumps there." if folds else "No jumps."),
            )
        )
    return found


def _edges(contact: xr.Dataset) -> list[Finding]:
    at = contact.sel(torque=contact.attrs["pinion_torque"], method="nearest")
    highest, torque = 1e-9 * float(at["pressure_max"].max()), float(at["torque"])
    if highest <= 1e-9 * EDGE_PRESSURE:
        return [
            Finding(
                GOOD,
                f"No sharp edge presses at {torque:.4g} N·m: the highest pressure is "
                f"{quantity_text(highest, 'GPa')}.",
                f"Pressures above {1e-9 * EDGE_PRESSURE:g} GPa would be those of edges.",
            )
        ]
    return [
        Finding(
            WARNING,
            f"Sharp edges of tips or ends press at {torque:.4g} N·m, with up to "
            f"{quantity_text(highest, 'GPa')}.",
            "This pressure has no meaning as a number, because it rises with finer cells: it only "
            "shows the place. Tip and end relief in the gear file remove it.",
        )
    ]


def least_unstable(stability: xr.Dataset) -> float:
    """Return the least factor on the swing of the stiffness that is unstable; NaN if none."""
    unstable = (stability["growth_variation"] > 0.0).any("mesh_frequency").values
    first = stability["variation"].values[unstable]
    return float(first[0]) if first.size else float("nan")


def _stability(stability: xr.Dataset) -> list[Finding]:
    factor, top = least_unstable(stability), float(stability["variation"][-1])
    if np.isnan(factor):
        return [
            Finding(
                GOOD,
                f"No parametric instability, up to {top:g} times the swing of the mesh stiffness.",
                "With the damping of the pair, over all mesh frequencies that were computed.",
            )
        ]
    own = factor <= 1.0
    return [
        Finding(
            WARNING if own else GOOD,
            f"Parametric instability begins at {factor:.3g} times the swing of the mesh stiffness.",
            "The pair itself is unstable at some speeds." if own else "The pair itself is stable.",
        )
    ]


def _solved(film: xr.Dataset) -> list[Finding]:
    of = film.attrs
    if of.get("film_model") != "solved":
        return []
    share, loss = of["operating_share_outside"], of["operating_power_loss"]
    if share > MOST_OUTSIDE:
        speed = np.array([of["pinion_speed"] / RPM])
        return formulas_stand_in("Film and friction in operation", np.array([share]), speed)
    return [
        solved_films(
            of["operating_power_loss_bound"] / loss if loss > 0.0 else 0.0,
            share,
            f"{100.0 * share:.0f} % of the load on the lines",
            "That is "
            f"{quantity_text(of['operating_power_loss_bound'], 'W', 2)} or "
            f"{quantity_text(100.0 * of['operating_efficiency_bound'], '%', 2)} of efficiency.",
            model_of(film, LINE),
        )
    ]


def _film(film: xr.Dataset) -> list[Finding]:
    ratio = float(np.nanmin(film["film_ratio"].where(film["line_load"] > 0.0).values))
    of = film.attrs
    return [
        Finding(
            film_ratio_level(ratio),
            f"The smallest film ratio λ is {ratio:.2f}, the mean coefficient of friction "
            f"{of['operating_mean_coefficient']:.4f}, and sliding loses "
            f"{quantity_text(of['operating_power_loss'], 'W')}.",
            f"Film over a composite roughness of {1e6 * of['roughness_rms']:.3g} µm, at "
            f"{of['oil_temperature'] - ZERO_CELSIUS:.0f} °C. {film_ratio_words(ratio)}",
        ),
        *hot_film(
            of["oil_temperature"] - ZERO_CELSIUS + film["temperature_rise"],
            of.get("oil_data_high_degc", math.nan),
            lambda _: "this speed and torque",
        ),
        *_solved(film),
    ]


def _words_of(point: xr.Dataset | xr.DataArray) -> str:
    return (
        f"{float(point['torque']):.4g} N·m, {float(point['speed']):.0f} rpm and "
        f"{float(point['temperature']):.4g} °C oil"
    )


def _loads(losses: xr.Dataset) -> str:
    if not str(losses.attrs["loads"]).endswith("constant density"):
        return "Static loads."
    return (
        "Static loads by one stiffness along all contact lines, which leaves out relief and crown: "
        "--parts all takes those of the loaded contact."
    )


def _losses(losses: xr.Dataset) -> list[Finding]:
    power = losses["loss"].sum("part")
    worst = losses.isel(power.argmax(list(power.dims)))  # type: ignore[arg-type]
    own = in_operation(losses)
    total, sliding = float(own["loss"].sum()), float(own["loss"].sel(part="sliding"))
    lost, kept = loss_band(own), efficiency_band(own)
    ends = [
        ""
        if band is None
        else f" ({number_text(band[0], digits)} to {number_text(band[1], digits)})"
        for band, digits in ((lost, 3), (kept, 4))
    ]
    found = [
        Finding(
            NOTE,
            f"At {_words_of(own)} the teeth lose {quantity_text(total, 'W')}{ends[0]} and are "
            f"{quantity_text(100.0 * float(own['efficiency']), '%', 4)}{ends[1]} efficient.",
            ("" if lost is None else "In brackets: 95 % of the draws of the uncertain data. ")
            + f"Sliding makes {100.0 * sliding / total:.0f} % of it. The most over all points is "
            f"{quantity_text(float(worst['loss'].sum()), 'W')}, at {_words_of(worst)}. "
            f"{_loads(losses)} Not modelled: {losses.attrs['not_modelled']}.",
        ),
        *hot_film(
            losses["temperature"] + losses["temperature_rise"],
            losses.attrs.get("oil_data_high_degc", math.nan),
            _words_of,
            {"torque": "N·m", "speed": "rpm", "temperature": "°C"},
        ),
    ]
    if "share_outside" not in losses:
        return found
    outside, solved = losses["share_outside"].values, losses["share_outside"].values <= MOST_OUTSIDE
    if solved.any():
        share = np.nanmax((losses["loss_bound"] / losses["loss"].sel(part="sliding")).values)
        words = f"at most {100.0 * outside[solved].max():.1f} % of the load, where they count"
        where = "" if solved.all() else f" at {solved.sum()} of {solved.size} points"
        model = model_of(losses, LINE)
        found.append(solved_films(float(share), 0.0, words, model=model, where=where))
    return found + formulas_stand_in("Losses", outside, losses["speed"].values)
