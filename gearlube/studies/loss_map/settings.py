"""Settings of a loss map."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from drivetrain.steady_temperature import Cooling
from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.dynamics.hypoid_axle.uncertain import MOST_DRAWS, Uncertain, uncertain_of
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.errors import ParameterError
from gearlube_core.units import celsius_to_kelvin

MOST_POINTS = 200_000


@dataclass(frozen=True, slots=True, kw_only=True)
class LossMapSettings:
    """Axle, grid and uncertain data of a loss map, for `run_loss_map`.

    Parameters
    ----------
    axle : HypoidAxleParameters
    torques : ndarray of shape (n,)
        Torques on the pinion [N.m], rising; below 0 the wheels drive. Default: 21 from half the
        coast end of the mesh table to its drive end.
    speeds : ndarray of shape (m,)
        Speeds of the pinion [rad/s], rising. Default: 20 from 25 to 525 rad/s.
    temperatures : ndarray of shape (k,)
        Temperatures of the oil [K], rising. Default: 40, 60, 80 and 100 degC.
    draws : int
        Number of samples of the uncertain data, 0 to 10000; 0: no error bars.
    seed : int
        Seed of the random numbers.
    calibrated_bearings : bool
        True: f0 and f1 of Palmgren's law are from measured torques of these bearings, so their drag
        is known to a factor of 1.25.
    uncertain : tuple of Uncertain, optional
        Default: `uncertain_of` the axle.
    cooling : Cooling, optional
        Cooling of the axle in a car. If given, the map also has the steady oil temperature of each
        torque and speed, at which heat in and out balance, and the loss there.

    Examples
    --------
    >>> from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
    >>> settings = LossMapSettings(axle=mohammadpour_2015_axle())
    >>> settings.shape
    (4, 20, 21)
    """

    axle: HypoidAxleParameters
    torques: Array | None = None
    speeds: Array | None = None
    temperatures: Array | None = None
    draws: int = 60
    seed: int = 1
    calibrated_bearings: bool = False
    uncertain: tuple[Uncertain, ...] = ()
    cooling: Cooling | None = None

    def __post_init__(self) -> None:
        if not self.uncertain:
            usual = uncertain_of(self.axle, calibrated_bearings=self.calibrated_bearings)
            object.__setattr__(self, "uncertain", usual)
        low, high = self.axle.torque_range
        given = {
            "torques": (self.torques, _usual_torques(0.5 * low, high)),
            "speeds": (self.speeds, np.linspace(25.0, 525.0, 20)),
            "temperatures": (
                self.temperatures,
                np.array([celsius_to_kelvin(t) for t in (40.0, 60.0, 80.0, 100.0)]),
            ),
        }
        for name, (values, default) in given.items():
            chosen = default if values is None else np.atleast_1d(np.asarray(values, dtype=float))
            if chosen.ndim != 1 or chosen.size == 0 or np.any(np.diff(chosen) <= 0.0):
                raise ParameterError(
                    f"{name} must be a list of rising numbers, got {chosen}. Sort the list, and "
                    "remove values that occur twice."
                )
            object.__setattr__(self, name, chosen)
        if self.cooling is not None:
            self.axle.oil.check_temperature(self.cooling.air_temperature, "air_temperature")
        check_within("draws", self.draws, 0, MOST_DRAWS, "", "60 are usual.")
        check_within("seed", self.seed, 0, 2**32 - 1, "", "Any whole number.")
        points = math.prod(self.shape)
        if points > MOST_POINTS:
            raise ParameterError(
                f"A map has at most {MOST_POINTS} points, got {points}. Take longer steps."
            )

    @property
    def shape(self) -> tuple[int, int, int]:
        """Numbers of temperatures, speeds and torques."""
        return self.grid[2].size, self.grid[1].size, self.grid[0].size

    @property
    def grid(self) -> tuple[Array, Array, Array]:
        """Torques [N.m], speeds [rad/s] and temperatures [K]."""
        return np.asarray(self.torques), np.asarray(self.speeds), np.asarray(self.temperatures)


def _usual_torques(low: float, high: float) -> Array:
    """Return 21 torques with 0 among them, where the loss has its kink."""
    return np.concatenate([np.linspace(low, 0.0, 7, endpoint=False), np.linspace(0.0, high, 14)])
