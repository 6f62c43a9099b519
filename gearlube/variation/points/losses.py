"""Losses of an axle at one torque, speed and oil temperature: a point of the loss map."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gearlube.variation.design import Point
from gearlube.variation.keys import Keys
from gearlube.variation.point_study import Quantity
from gearlube.variation.points.of_file import AxlePoint, operand, value
from gearlube_core.checks import check_within
from gearlube_core.dynamics.hypoid_axle.losses import FAILURES, LOSS_SOURCES, axle_losses
from gearlube_core.dynamics.hypoid_axle.model import torque_limits
from gearlube_core.errors import ConvergenceError
from gearlube_core.units import ZERO_CELSIUS, celsius_to_kelvin, rpm_to_rads

TORQUE = operand("pinion.torque_n_m", "N.m", "On the pinion; below 0: coast", 50.0)
SPEED = operand("pinion.speed_rpm", "rpm", "Of the pinion", 2000.0, 1.0, 47_000.0)
TEMPERATURE = operand("oil.temperature_degc", "degC", "Of the oil", 80.0, -60.0, 250.0)
_OPERANDS = {key.name: key for key in (TORQUE, SPEED, TEMPERATURE)}

_QUANTITIES = (
    Quantity("loss", "W", "total power lost"),
    Quantity("loss_torque", "N m", "loss torque at the pinion"),
    Quantity("efficiency", "1", "efficiency of the axle"),
    *(Quantity(f"loss_{name}", "W", f"power lost by {name}") for name in LOSS_SOURCES),
    Quantity("film_ratio", "1", "least film ratio of a flank"),
    Quantity("flank_temperature", "degC", "hottest flank film"),
    Quantity("share_outside", "1", "flanks' load outside their film model; 0 with formulas"),
    Quantity("rollers_outside", "1", "rollers' load outside theirs"),
    Quantity("range_exceeded", "1", "sum of 1, 2, 4, ... for each range left; 0: none"),
)


@dataclass(frozen=True, kw_only=True)
class LossPoint(AxlePoint):
    """The loss map's study at one point.

    Examples
    --------
    >>> from gearlube.variation.file_variants import AxleVariants
    >>> study = LossPoint(axle=AxleVariants.read("mohammadpour_2015"))
    >>> round(study.compute({"pinion.bearing.preload_n": 4000.0})[1], 2)  # N.m, both shafts
    2.31
    """

    name: ClassVar[str] = "map"
    block: ClassVar[int] = 100
    shown: ClassVar[tuple[str, ...]] = ("loss", "efficiency", "film_ratio")
    operands: ClassVar[Keys] = _OPERANDS
    quantities: ClassVar[tuple[Quantity, ...]] = _QUANTITIES

    def check(self, point: Point) -> None:
        """Raise ParameterError where axle, torque or temperature are out of range."""
        axle = self.axle.car_axle(point).axle
        limits = torque_limits(axle)
        low, high, cure = limits.pinion_low, limits.pinion_high, limits.cure
        check_within(TORQUE.name, value(point, TORQUE), low, high, "N.m", cure)
        axle.oil.check_temperature(celsius_to_kelvin(value(point, TEMPERATURE)), "oil.temperature")

    def compute(self, point: Point) -> Sequence[float]:
        """Return the losses at a point."""
        torque, speed = value(point, TORQUE), rpm_to_rads(value(point, SPEED))
        found = axle_losses(
            self.axle.car_axle(point).axle,
            torques=np.array([torque]),
            speeds=np.array([speed]),
            temperatures=np.array([celsius_to_kelvin(value(point, TEMPERATURE))]),
        )
        status = int(found.status[0, 0, 0])
        if status:
            raise ConvergenceError(FAILURES[status])
        powers = found.power[0, 0, 0]
        total = float(powers.sum())
        through = torque * speed
        put_in = through if through > 0.0 else total - through
        works = 0.0 < total < put_in
        ratio = float(found.film_ratio[0, 0, 0])
        return (
            total,
            total / speed,
            1.0 - total / put_in if works else float("nan"),
            *map(float, powers),
            ratio if np.isfinite(ratio) else float("nan"),
            float(found.flank_temperature[0, 0, 0]) - ZERO_CELSIUS,
            float(found.share_outside[0, 0, 0]),
            float(found.rollers_outside[0, 0, 0]),
            float(found.exceeded[0, 0, 0]),
        )
