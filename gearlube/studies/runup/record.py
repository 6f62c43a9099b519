"""March the axle through the ramp and keep its motion and forces at a constant rate."""

from __future__ import annotations

import logging
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from drivetrain.ramp_vehicle import RampVehicle, gear_for_ramp
from drivetrain.speed_ramp import RampHold, SpeedRamp
from gearlube.studies.runup.settings import VEHICLE, RunupSettings
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES
from gearlube_core.dynamics.hypoid_axle.model import HypoidAxle
from gearlube_core.dynamics.hypoid_axle.output_names import OUTPUT_NAMES
from gearlube_core.errors import InterruptedRunError
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.resumable import ARRAYS, Record, ResultStore, deferred_interrupts
from gearlube_core.units import rads_to_rpm

logger = logging.getLogger(__name__)

BEARINGS = ("pinion", "gear")
DIRECTIONS = ("axial", "radial 1", "radial 2")
# axis of the fixed frame of each direction, see docs/conventions.md
AXES = (("x", "y", "z"), ("z", "x", "y"))
_OF_SHAFT = ((1, 2), (3, 4))  # bearings that carry it
MOTION = (
    "pinion.angle",
    "pinion.speed",
    "wheel.angle",
    "wheel.speed",
    "mesh.dte",
    "mesh.force",
    *(f"pinion.displacement.{axis}" for axis in "xyz"),
    *(f"wheel.displacement.{axis}" for axis in "xyz"),
)
_SHAFTS = 4  # of these, what a driver takes
_OF_SHAFTS = np.array([OUTPUT_NAMES.index(name) for name in MOTION[:_SHAFTS]])
FORCES = tuple(f"bearing.{one}.{direction}" for one in BEARINGS for direction in DIRECTIONS)
ENERGIES = ("energy.pinion_work", *(f"energy.{source}" for source in LOSS_SOURCES))
_PART = 2.0  # s of the record that are kept together
_SLOW = 0.02  # s between two samples of the energies
_MOST_SETTLING = 20  # mesh periods, at least
_OF_PART = {"motion", "forces", "energies", "outside", "axle_state", "driver_state", "warned"}


@dataclass(frozen=True, slots=True, kw_only=True)
class RampRecord:
    """A ramp at a constant rate.

    Parameters
    ----------
    time : array
        Since the ramp began [s], shape (n,).
    channels : dict of array
        `MOTION` and `FORCES` by name, SI, shape (n,).
    slow_time : array
        Times of `energies` [s], shape (m,).
    energies : array
        `ENERGIES` since the start [J], shape (m, sources + 1).
    outside : array of bool
        Something left the range of its formula or table then, shape (m,).
    warnings : tuple of str
        What left the range of its formula or table.
    torques : tuple of array
        On the pinion, expected loss [N m], at equal times.
    """

    time: Array
    channels: dict[str, Array]
    slow_time: Array
    energies: Array
    outside: Array
    warnings: tuple[str, ...]
    torques: tuple[Array, Array]

    @property
    def force_names(self) -> tuple[str, ...]:
        """Channels of the bearing forces: all directions of the pinion, then of the gear."""
        return FORCES

    def forces(self, bearing: int) -> Array:
        """Return the forces on one shaft [N], shape (n, directions)."""
        first = bearing * len(DIRECTIONS)
        names = FORCES[first : first + len(DIRECTIONS)]
        return np.stack([self.channels[name] for name in names], axis=1)

    @property
    def smooth_speed(self) -> Array:
        """Speed of the pinion without its vibration [rad/s]: means over about 1/20 s."""
        angle = self.channels["pinion.angle"]
        step = max(1, round(0.05 / (self.time[1] - self.time[0])))
        at = np.arange(0, angle.size, step)
        if at.size < 3:
            return np.gradient(angle, self.time)
        speed = np.diff(angle[at]) / np.diff(self.time[at])
        middle = 0.5 * (self.time[at][1:] + self.time[at][:-1])
        slope = np.polynomial.Polynomial.fit(middle, speed, 1)
        # beyond the first and the last middle the ramp's own slope goes on
        return np.asarray(
            slope(self.time) + np.interp(self.time, middle, speed - slope(middle)), dtype=np.float64
        )


def record_ramp(
    settings: RunupSettings, *, folder: Path | None = None, progress: Progress = no_progress
) -> RampRecord:
    """Return the record of a ramp.

    Parameters
    ----------
    settings : RunupSettings
    folder : path, optional
        Where finished parts are kept, so that a stopped run goes on from there.
    progress : callable

    Raises
    ------
    InterruptedRunError
        After Ctrl-C; finished parts are kept.
    GearLubeError
        The axle refused.
    """
    progress(0.0, f"{settings.name}: torques and losses; compiled the first time")
    axle = HypoidAxle(settings.car_axle.axle)
    torques = settings.torques()
    driver = driver_of(settings, settings.ramp, torques)
    h = 1.0 / settings.sample_rate
    warned: dict[str, str] = {}
    pinion_torque, wheel_torque = driver.initial_torques()
    axle.initialise(
        pinion_speed=driver.initial_pinion_speed,
        pinion_torque=pinion_torque,
        wheel_torque=wheel_torque,
        oil_temperature=settings.oil_temperature,
    )
    steps = math.ceil(settings.duration * settings.sample_rate)
    size = round(_PART * settings.sample_rate)
    parts = [min(size, steps - at) for at in range(0, steps, size)]
    store, whole = ResultStore(folder, ARRAYS), settings.key()
    found: list[Record] = []
    marched = False  # the last part, now
    with deferred_interrupts() as interrupt:
        for i, length in enumerate(parts):
            key = f"{whole}_{i}"
            part = store.read(key)
            if part is not None and part.keys() != _OF_PART:
                logger.warning("Part %d is from another version. It will be computed again.", i + 1)
                part = None
            if part is None:
                if not found:
                    progress(0.0, f"{settings.name}: settling at the first speed")
                    march_until(0.0, axle, driver, settings)
                elif not marched:
                    axle.set_state(found[-1]["axle_state"])
                    driver.set_state(found[-1]["driver_state"])
                marched = True
                part = _march(axle, driver, settings.oil_temperature, h, length, warned)
                store.keep(key, part)
            else:
                marched = False
            found.append(part)
            speed = rads_to_rpm(settings.ramp.speed((i * size + length) * h))
            progress((i + 1) / len(parts), f"{settings.name}, {speed:.0f} rpm")
            if interrupt.requested:
                kept = (
                    "lost, as no folder is given"
                    if folder is None
                    else (f"kept in {folder}. Run the same command again to go on")
                )
                raise InterruptedRunError(
                    f"Stopped: {sum(parts[: i + 1]) * h:.3g} of {steps * h:.3g} s of the "
                    f"{settings.name} are {kept}."
                )
    return _joined(found, h, torques)


def driver_of(
    settings: RunupSettings, ramp: SpeedRamp, torques: tuple[Array, Array]
) -> RampHold | RampVehicle:
    """Return what takes the axle through `ramp`, the whole one of the settings or a piece of it.

    `torques` are the torque on the pinion and the expected loss [N m] at equal times of `ramp`.
    """
    axle, ratio = settings.car_axle.axle, settings.car_axle.axle.mesh.ratio
    teeth = axle.mesh.pinion_teeth
    mesh_period = 2.0 * math.pi / (teeth * ramp.start)
    lead = max(settings.settling_time, _MOST_SETTLING * mesh_period)
    if settings.driver == VEHICLE:
        car = settings.car_axle.driveline
        return RampVehicle(car, ramp, torques[1], lead, gear=gear_for_ramp(car, settings.ramp))
    return RampHold(
        ramp,
        ratio=ratio,
        pinion_torque=torques[0],
        loss_torque=torques[1],
        axle_inertia=axle.pinion_inertia + axle.gear_inertia / ratio**2,
        lead=lead,
    )


def march_until(
    time: float, axle: HypoidAxle, driver: RampHold | RampVehicle, settings: RunupSettings
) -> None:
    """March until `time` of the driver's ramp [s], at the sample rate of the record."""
    h = 1.0 / settings.sample_rate
    while driver.time < time - 0.5 * h:
        march_step(h, axle, driver, settings)


def march_step(
    h: float, axle: HypoidAxle, driver: RampHold | RampVehicle, settings: RunupSettings
) -> None:
    """March by `h` [s]."""
    motion = axle.outputs[_OF_SHAFTS].tolist()
    axle.step(h, *driver.step(h, *motion), settings.oil_temperature)


def _column(axle: HypoidAxle, name: str) -> int:
    return axle.output_names.index(name)


def _march(
    axle: HypoidAxle,
    driver: RampHold | RampVehicle,
    oil_temperature: float,
    h: float,
    length: int,
    warned: dict[str, str],
) -> Record:
    """Return `length` samples, the first of them now, and the state after the last."""
    forces = [
        _column(axle, f"bearing[{j}].force.{axis}")
        for pair, axes in zip(_OF_SHAFT, AXES, strict=True)
        for axis in axes
        for j in pair
    ]
    columns = np.array([*(_column(axle, name) for name in MOTION), *forces])
    energies = np.array([_column(axle, name) for name in ENERGIES])
    slow = max(1, round(_SLOW / h))
    values = np.empty((length, columns.size))
    kept = np.empty((math.ceil(length / slow), energies.size))
    outside = np.zeros(kept.shape[0], dtype=bool)
    out, step, held = axle.outputs, axle.step, driver.step
    for i in range(length):
        out.take(columns, out=values[i])
        if i % slow == 0:
            kept[i // slow] = out[energies]
            exceeded = axle.exceeded()
            outside[i // slow] = bool(exceeded)
            for name, sentence in exceeded.items():
                warned.setdefault(name, f"{sentence} First at t = {max(0.0, driver.time):.3g} s.")
        row = values[i]
        torques = held(h, *row[:_SHAFTS].tolist())
        step(h, *torques, oil_temperature)
    motion = values[:, : len(MOTION)]
    both = values[:, len(MOTION) :]
    return {
        "motion": motion.copy(),
        "forces": both[:, 0::2] + both[:, 1::2],
        "energies": kept,
        "outside": outside,
        "axle_state": axle.get_state(),
        "driver_state": driver.get_state(),
        "warned": np.array([f"{name}\n{text}" for name, text in warned.items()], dtype=str),
    }


def _joined(parts: list[Record], h: float, torques: tuple[Array, Array]) -> RampRecord:
    motion = np.concatenate([part["motion"] for part in parts])
    forces = np.concatenate([part["forces"] for part in parts])
    energies = np.concatenate([part["energies"] for part in parts])
    slow = max(1, round(_SLOW / h))
    starts = np.cumsum([0, *(part["motion"].shape[0] for part in parts)])
    slow_time = np.concatenate(
        [
            h * (at + slow * np.arange(part["energies"].shape[0]))
            for at, part in zip(starts, parts, strict=False)
        ]
    )
    warned: dict[str, str] = {}
    for part in parts:
        for text in part["warned"].tolist():
            name, sentence = text.split("\n", 1)
            warned.setdefault(name, sentence)
    channels = {name: motion[:, i] for i, name in enumerate(MOTION)}
    channels |= {name: forces[:, i] for i, name in enumerate(FORCES)}
    return RampRecord(
        time=h * np.arange(motion.shape[0], dtype=np.float64),
        channels=channels,
        slow_time=slow_time,
        energies=energies,
        outside=np.concatenate([part["outside"] for part in parts]),
        warnings=tuple(warned.values()),
        torques=torques,
    )
