"""The axle at one operating point: its driver, and a recording of its outputs once settled."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from drivetrain.driveline.parameters import DrivelineParameters
from drivetrain.drivers import CoupledVehicle, Driver, SpeedHold
from gearlube.studies.sweep.settings import SweepSettings
from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive
from gearlube_core.errors import StepError
from gearlube_core.spectra import whole_revolutions
from gearlube_core.units import kmh_to_ms

FLANKS = (1, 2, 3)
BEARINGS = (1, 2, 3, 4)
AXES = ("x", "y", "z")
LOSSES = (
    "friction_viscous",
    "friction_boundary",
    "mesh_damping",
    "bearing_damping",
    "bearing_torque",
    "churning",
    "seals",
    "friction_rolling",
)
FLANK_QUANTITIES = ("load", "film_thickness", "film_ratio", "friction_coefficient", "temperature")

CHANNELS = (
    "pinion.angle",
    "pinion.speed",
    "wheel.angle",
    "wheel.speed",
    "mesh.dte",
    "mesh.force",
    "mesh.frequency",
    *(f"pinion.displacement.{axis}" for axis in AXES),
    *(f"wheel.displacement.{axis}" for axis in AXES),
    *(f"flank[{i}].{quantity}" for i in FLANKS for quantity in FLANK_QUANTITIES),
    *(f"bearing[{j}].force.{axis}" for j in BEARINGS for axis in AXES),
    *(f"bearing[{j}].roller_load_{end}" for j in BEARINGS for end in ("max", "min")),
    "bearing[1].roller[1].load",
    "bearing[1].cage.angle",
    "bearing[3].cage.angle",
    "energy.pinion_work",
    "energy.wheel_work",
    *(f"energy.{loss}" for loss in LOSSES),
    "energy.stored",
    "film.share_outside",
    "friction.power_loss_bound",
    "bearing.share_outside",
    "bearing.power_loss_bound",
)
LEAST_SETTLING = 20  # mesh periods
_MARGIN = 4  # samples before the window, so that the end of the spline has no effect in it
_SLOWEST = 0.8  # the shaft may slow down to this fraction before a point is given up


@dataclass(frozen=True, slots=True, kw_only=True)
class Operation:
    """Operating point of the axle.

    Parameters
    ----------
    driver : Driver
        Partner of the axle.
    pinion_speed : float
        Speed of the pinion at the start [rad/s].
    """

    driver: Driver
    pinion_speed: float


def operation(
    settings: SweepSettings,
    speed_kmh: float,
    driveline: DrivelineParameters,
    axle_power_loss: float = 0.0,
) -> Operation:
    """Return the driver and the start of the point at `speed_kmh` [km/h] in a car.

    The drivers start in the steady state with an axle that loses `axle_power_loss` [W].
    """
    speed = kmh_to_ms(speed_kmh)
    driver: CoupledVehicle | SpeedHold
    if settings.driver == "vehicle":
        driver = CoupledVehicle(driveline, speed, axle_power_loss=axle_power_loss)
    else:
        driver = SpeedHold(driveline.road_load, speed, axle_power_loss=axle_power_loss)
    return Operation(driver=driver, pinion_speed=driver.initial_pinion_speed)


class SteppedAxle(Protocol):
    """Interface of an axle for a run: `FmuAxle`, or a test model with known motion."""

    def initialise(self, pinion_torque: float, wheel_torque: float, temperature: float) -> None:
        """Start from these inputs [N.m, N.m, K]."""

    def step(self, h: float, pinion_torque: float, wheel_torque: float) -> None:
        """Advance by `h` [s]."""

    def read(self) -> Array:
        """Return the current channels."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Recording:
    """Channels of a settled axle at equal time steps.

    Parameters
    ----------
    time : array
        Sample times [s], shape (n,).
    channels : tuple of str
        Names of the columns.
    values : array
        Samples in SI units, shape (n, channels).
    torques : array
        Torques on pinion and wheel that led to each sample [N.m], shape (n, 2).
    step : float
        Communication step [s].
    steps_per_mesh_period : int
        Communication steps in one nominal mesh period [-].
    teeth : int
        Teeth of the pinion [-].
    revolutions : int
        Whole pinion revolutions to analyse, at the end of the record [-].
    vehicle_speed : float
        Mean of the vehicle speeds at the start and at the end of the record [m/s].
    warnings : tuple of str
        What the axle warned of since its start.
    oil_temperature : float
        That of the whole run [K].
    """

    time: Array
    channels: tuple[str, ...]
    values: Array
    torques: Array
    step: float
    steps_per_mesh_period: int
    teeth: int
    revolutions: int
    vehicle_speed: float
    warnings: tuple[str, ...] = ()
    oil_temperature: float = math.nan

    def __getitem__(self, channel: str) -> Array:
        """Return the samples of one channel, shape (n,)."""
        column: Array = self.values[:, self.channels.index(channel)]
        return column


def record(
    axle: SteppedAxle, driver: Driver, settings: SweepSettings, channels: Sequence[str]
) -> Recording:
    """Let the axle settle, then record whole pinion revolutions.

    Parameters
    ----------
    axle : SteppedAxle
        Parameters set, not yet initialised; `read` returns `channels`.
    driver : Driver
        Partner that turns shaft motion into torques.
    settings : SweepSettings
        Temperature and timing.
    channels : sequence of str
        Must contain the angles, speeds, cage angle and mesh frequency.

    Returns
    -------
    Recording
        At least `record_time` and `cage_turns` turns of the pinion cages.
    """
    columns = {name: index for index, name in enumerate(channels)}
    motion = [
        columns[name] for name in ("pinion.angle", "pinion.speed", "wheel.angle", "wheel.speed")
    ]
    pinion, cage = columns["pinion.angle"], columns["bearing[1].cage.angle"]

    torques = driver.initial_torques()
    axle.initialise(*torques, settings.oil_temperature)
    now = axle.read()
    speed = check_positive("pinion.speed", float(now[columns["pinion.speed"]]), "rad/s")
    mesh_frequency = float(now[columns["mesh.frequency"]])
    check_positive("mesh.frequency", mesh_frequency, "Hz")
    teeth = round(2.0 * math.pi * mesh_frequency / speed)
    steps_per_period = math.ceil(1.0 / (mesh_frequency * settings.communication_step))
    h = 1.0 / (mesh_frequency * steps_per_period)
    a, b, c, d = motion

    start_angle, start_cage = float(now[pinion]), float(now[cage])
    settling = max(settings.settling_time, LEAST_SETTLING / mesh_frequency)
    for _ in range(math.ceil(settling / h)):
        torques = driver.step(h, now[a], now[b], now[c], now[d])
        axle.step(h, *torques)
        now = axle.read()

    cage_order = (float(now[cage]) - start_cage) / (float(now[pinion]) - start_angle)
    revolutions = revolutions_to_record(settings, speed, cage_order)
    stop_angle = float(now[pinion]) + 2.0 * math.pi * revolutions
    sweep_steps = 2.0 * math.pi * revolutions / (speed * h)
    capacity = math.ceil(sweep_steps / _SLOWEST) + _MARGIN
    values = np.empty((capacity, len(columns)))
    applied = np.empty((capacity, 2))
    size, beyond = 0, 0
    vehicle_speed = driver.vehicle_speed
    while beyond < _MARGIN:
        if size == capacity:
            raise StepError(
                f"The pinion must turn through {revolutions} rev in {capacity * h:.3f} s, but it "
                f"turned less: {float(now[b]):.2f} rad/s at the end, {speed:.2f} rad/s at the "
                "start. The driver does not hold the speed; settle for longer or use driver "
                "'hold'."
            )
        torques = driver.step(h, now[a], now[b], now[c], now[d])
        axle.step(h, *torques)
        now = axle.read()
        values[size] = now
        applied[size] = torques
        size += 1
        beyond += now[pinion] >= stop_angle
    return Recording(
        time=h * np.arange(size, dtype=np.float64),
        channels=tuple(channels),
        values=values[:size].copy(),
        torques=applied[:size].copy(),
        step=h,
        steps_per_mesh_period=steps_per_period,
        teeth=teeth,
        revolutions=revolutions,
        vehicle_speed=0.5 * (vehicle_speed + driver.vehicle_speed),
        oil_temperature=settings.oil_temperature,
    )


def revolutions_to_record(settings: SweepSettings, speed: float, cage_order: float) -> int:
    """Return the number of whole pinion revolutions to record, nearly whole cage turns."""
    for_time = settings.record_time * speed / (2.0 * math.pi)
    for_cage = settings.cage_turns / cage_order if cage_order > 0.0 else 0.0
    return whole_revolutions([cage_order], math.ceil(max(1.0, for_time, for_cage)), search=5)
