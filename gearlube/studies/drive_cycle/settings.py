"""Settings of a drive cycle: the car, its trace, oil temperature, brakes and heat."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated

from drivetrain.axle_file.axle_file import CarAxle
from drivetrain.cycle.traces import DriveCycle
from drivetrain.sump_heat import SumpHeat
from gearlube_core.dynamics.hypoid_axle.uncertain import MOST_DRAWS, uncertain_of
from gearlube_core.number import Number, check_fields
from gearlube_core.units import celsius_to_kelvin

COAST_TORQUE = 30.0  # N.m at the pinion; assumed, 0 to 60 for a car of 1.3 t


@dataclass(frozen=True, slots=True, kw_only=True)
class LossGrid:
    """Grid of the loss map that a drive cycle is computed from.

    Parameters
    ----------
    torques, speeds : int
        Number of pinion torques, denser near zero, and of speeds, in a geometric series.
    temperature_step : float
        Step of the oil temperature [K].

    Examples
    --------
    >>> LossGrid().finer
    LossGrid(torques=48, speeds=32, temperature_step=5.0)
    """

    torques: Annotated[int, Number("1", 4, 400, "24 are usual.")] = 24
    speeds: Annotated[int, Number("1", 3, 400, "16 are usual.")] = 16
    temperature_step: Annotated[float, Number("K", 0.5, 50.0, "10 K is usual.")] = 10.0

    def __post_init__(self) -> None:
        check_fields(self)

    @property
    def finer(self) -> LossGrid:
        """Twice as many points along each of the three."""
        return LossGrid(
            torques=2 * self.torques,
            speeds=2 * self.speeds,
            temperature_step=0.5 * self.temperature_step,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class DriveCycleSettings:
    """Car, cycle and conditions of a drive-cycle study, for `run_cycle`.

    Parameters
    ----------
    car : CarAxle
        Axle and vehicle of an axle file, see `read_axle`.
    cycle : DriveCycle
    start_temperature, air_temperature : float
        Temperature of oil and housing at the start, and of the air [K]. Default: 23 degC.
    regeneration : float
        Share of the braking beyond coast torque that goes through the axle, 0 to 1. The friction
        brakes take the rest.
    coast_torque : float
        Drag of engine and gearbox with closed throttle, at the pinion [N.m]; assumed.
    heat : SumpHeat
    grid : LossGrid
    draws : int
        Number of samples of the uncertain data, 0 to 10000; 0: error bars of the heat data only.
    seed : int
        Seed of the random numbers.
    calibrated_bearings : bool
        True: f0 and f1 of Palmgren's law are from measured torques of these bearings.

    Examples
    --------
    >>> from drivetrain.axle_file.read_axle import read_axle
    >>> settings = DriveCycleSettings(
    ...     car=read_axle("mohammadpour_2015"), cycle=DriveCycle.named("nedc")
    ... )
    >>> settings.heat.capacity  # J/K, assumed
    18000.0
    """

    car: CarAxle
    cycle: DriveCycle
    start_temperature: float = celsius_to_kelvin(23.0)
    air_temperature: float = celsius_to_kelvin(23.0)
    regeneration: Annotated[float, Number("1", 0.0, 1.0, "A half is 0.5.")] = 0.0
    coast_torque: Annotated[float, Number("N.m", 0.0, 1e4, "30 N.m is usual.")] = COAST_TORQUE
    heat: SumpHeat = field(default_factory=SumpHeat)
    grid: LossGrid = field(default_factory=LossGrid)
    draws: Annotated[int, Number("1", 0, MOST_DRAWS, "60 are usual.")] = 60
    seed: Annotated[int, Number("1", 0, 2**32 - 1, "Any whole number.")] = 1
    calibrated_bearings: bool = False

    def __post_init__(self) -> None:
        oil = self.car.axle.oil
        for name in ("start_temperature", "air_temperature"):
            oil.check_temperature(getattr(self, name), name)
        check_fields(self)
        uncertain_of(self.car.axle, calibrated_bearings=self.calibrated_bearings)
