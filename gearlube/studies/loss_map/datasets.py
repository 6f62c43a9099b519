"""The loss map as an xarray Dataset, every variable with unit and long name."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from drivetrain.steady_temperature import Cooling
from gearlube.plotting.words import left_out
from gearlube.report.churning import REGIME, churning_regime
from gearlube.report.films import covered_alone, film_model_attributes
from gearlube.studies.loss_map.sampling import Spread
from gearlube.studies.loss_map.settings import LossMapSettings
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.losses import FAILURES, LOSS_SOURCES, AxleLosses
from gearlube_core.dynamics.ranges import left_ranges
from gearlube_core.units import ZERO_CELSIUS, kelvin_to_celsius, labelled

GRID = ("temperature", "speed", "torque")
_LEAST_INPUT = 0.5  # share of the input that is lost, above which no efficiency is stated


def loss_map_dataset(
    settings: LossMapSettings, losses: AxleLosses, spread: Spread | None
) -> xr.Dataset:
    """Return the map over temperature [degC], speed [rpm] and torque [N.m] of the pinion."""
    torques, speeds, temperatures = settings.grid
    ratio = settings.axle.mesh.ratio
    turning = speeds[None, :, None]
    total = losses.total
    wheel_torque = (torques - total / turning) * ratio
    variables = {
        "loss_torque": (GRID, total / turning, "N.m", "loss torque at the pinion"),
        "loss": ((*GRID, "source"), losses.power, "W", "power lost"),
        "efficiency": (GRID, _efficiency(total, turning * torques), "1", "efficiency of the axle"),
        "wheel_torque": (GRID, wheel_torque, "N.m", "torque of both wheels together"),
        "pinion_bearing_loss": (GRID, losses.pinion_drag, "W", "bearing drag of the pinion alone"),
        "carried_torque": (GRID, losses.carried, "N.m", "torque of the teeth at the pinion"),
        "film_ratio": (GRID, _finite(losses.film_ratio), "1", "least film ratio of a flank"),
        "flank_temperature": (
            GRID,
            losses.flank_temperature - ZERO_CELSIUS,
            "degC",
            "hottest flank film",
        ),
        "range_exceeded": (GRID, losses.exceeded, "1", "sum of 1, 2, 4, ... for each range left"),
        "status": (GRID, losses.status, "1", "0: computed; others: see the attribute reasons"),
    }
    regime = churning_regime(settings.axle, temperatures[:, None], speeds / ratio)
    if regime is not None:
        variables["churning_regime"] = (GRID[:2], regime, *REGIME)
    if settings.axle.flank_bulk_resistance > 0.0:
        bulk = losses.bulk_temperature - ZERO_CELSIUS
        variables["bulk_temperature"] = (GRID, bulk, "degC", "bulk of the flanks")
    if settings.axle.film == "solved":
        variables |= _of_film_model(losses, turning * torques, total)
    if settings.axle.bearing_torque_loss == "solved_films":
        variables |= {
            "drag_bound": (
                GRID,
                covered_alone(losses.drag_bound, losses.rollers_outside),
                "W",
                "bound of the bearings' drag loss where the film model covers the rollers",
            ),
            "rollers_outside": (
                GRID,
                losses.rollers_outside,
                "1",
                "share of the rollers' load outside the domain of their film model",
            ),
        }
    if spread is not None:
        names = [one.name for one in settings.uncertain]
        variables |= {
            "loss_torque_low": (GRID, spread.low / turning, "N.m", "2.5 % of draws are below"),
            "loss_torque_high": (GRID, spread.high / turning, "N.m", "97.5 % of draws are below"),
            "swing": (
                ("input", *GRID),
                spread.swing / turning,
                "N.m",
                "change of the loss torque by one uncertain input, to its factor",
            ),
        }
    coordinates = {
        "temperature": labelled("temperature", temperatures - ZERO_CELSIUS, "degC", "oil"),
        "speed": labelled("speed", speeds * 30.0 / np.pi, "rpm", "speed of the pinion"),
        "torque": labelled("torque", torques, "N.m", "torque on the pinion; < 0: coast"),
        "source": ("source", np.array(LOSS_SOURCES), {"long_name": "kind of loss"}),
    }
    if spread is not None:
        coordinates["input"] = ("input", np.array(names), {"long_name": "uncertain input"})
    return xr.Dataset(
        {name: labelled(*variable) for name, variable in variables.items()},
        coords=coordinates,
        attrs=_attributes(settings, losses),
    )


def with_steady_temperature(
    dataset: xr.Dataset, cooling: Cooling, temperature: Array, power: Array
) -> xr.Dataset:
    """Return the map with the oil temperature at rest [K] and the loss there [W].

    Both over (speed, torque); NaN where the oil would leave the range of its data.
    """
    turning = dataset["speed"].values[:, None] * np.pi / 30.0
    heat = cooling.heat
    return dataset.assign(
        {
            "steady_temperature": labelled(
                GRID[1:],
                temperature - ZERO_CELSIUS,
                "degC",
                "oil temperature at constant running",
            ),
            "steady_loss_torque": labelled(
                GRID[1:],
                power / turning,
                "N.m",
                "loss torque at the pinion, at that temperature",
            ),
        }
    ).assign_attrs(
        air_temperature_degc=cooling.air_temperature - ZERO_CELSIUS,
        conductance_at_rest_w_k=heat.conductance_at_rest,
        conductance_at_100_kmh_w_k=heat.conductance_at_100_kmh,
    )


def _of_film_model(losses: AxleLosses, pinion_power: Array, total: Array) -> dict[str, Any]:
    """Return name and bounds of a model of solved films."""
    put_in = np.where(pinion_power > 0.0, pinion_power, total - pinion_power)
    bound = covered_alone(losses.friction_bound, losses.share_outside)
    return {
        "friction_bound": (GRID, bound, "W", "bound of the flanks' friction loss, where covered"),
        "efficiency_bound": (
            GRID,
            np.divide(bound, put_in, out=np.full(bound.shape, np.nan), where=put_in > 0.0),
            "1",
            "the same of the efficiency",
        ),
        "share_outside": (
            GRID,
            losses.share_outside,
            "1",
            "share of the flanks' load outside the domain of the film model",
        ),
    }


def _finite(values: Array) -> Array:
    return np.where(np.isinf(values), np.nan, values)


def _efficiency(total: Array, pinion_power: Array) -> Array:
    """Return output over input power; NaN where more than half of the input is lost."""
    put_in = np.where(pinion_power > 0.0, pinion_power, total - pinion_power)
    with np.errstate(divide="ignore", invalid="ignore"):
        lost = total / put_in
    return np.where(lost < _LEAST_INPUT, 1.0 - lost, np.nan)


def _attributes(settings: LossMapSettings, losses: AxleLosses) -> dict[str, object]:
    axle = settings.axle
    exceeded = losses.exceeded[losses.status == 0].astype(int)
    left = left_ranges(axle.ranges, float(np.bitwise_or.reduce(exceeded, None)))
    return {
        "ratio": axle.mesh.ratio,
        "pinion_seal_torque": float(axle.pinion_seal_torque),
        "mesh": axle.mesh.name,
        "oil": axle.oil.name,
        "oil_data_high_degc": kelvin_to_celsius(axle.oil.temperature_high),
        **film_model_attributes(axle.film_models),
        "not_modelled": ", ".join(left_out(axle)),
        "reasons": "; ".join(f"{key}: {words}" for key, words in FAILURES.items() if key),
        "ranges_left": "; ".join(f"{one.what} ({one.output})" for one in left),
        "draws": settings.draws,
        "seed": settings.seed,
        "uncertain": "; ".join(
            f"{one.name}: factor {one.factor:g} (k = 2), {one.why}" for one in settings.uncertain
        ),
    }
