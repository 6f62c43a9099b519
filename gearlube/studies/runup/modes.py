"""Natural modes of the axle along a ramp, and the speeds at which mesh orders meet them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from drivetrain.driveline.model import Driveline
from drivetrain.driveline.modes import LOWEST, coupled_modes, numbered
from drivetrain.ramp_vehicle import gear_for_ramp
from gearlube.studies.runup.settings import VEHICLE, RunupSettings
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.linearise import linearise, named_modes
from gearlube_core.dynamics.hypoid_axle.model import HypoidAxle
from gearlube_core.errors import ParameterError

COORDINATES = (
    "pinion turning", "pinion x", "pinion y", "pinion z",
    "gear turning", "gear x", "gear y", "gear z",
)  # fmt: skip
_PLACES = (0, 2, 3, 4, 1, 5, 6, 7)  # of these in linearise.COORDINATES
_NODES = 7  # speeds at which the modes are found
_WIDER = 3.0  # critical speeds are kept up to this factor beyond the ramp


@dataclass(frozen=True, slots=True, kw_only=True)
class RampModes:
    """Modes along a ramp.

    Parameters
    ----------
    speed : array
        Pinion speeds at which they were found [rad/s], ascending, shape (n,).
    names : tuple of str
        Those at the middle speed.
    frequency, damping_ratio : array
        [Hz], [-], shape (n, modes).
    shape : array
        At the middle speed, in the order of COORDINATES, turning as displacement at the contact
        [m kg^-1/2], modal mass 1, shape (8, modes).
    mass : array
        Of each coordinate, turning reduced to the contact [kg], shape (8,).
    radii : tuple of float
        Contact radii of pinion and gear [m].
    car_strain : array, optional
        Share of the strain energy in springs of the car [-], at the middle speed, shape (modes,).
    """

    speed: Array
    names: tuple[str, ...]
    frequency: Array
    damping_ratio: Array
    shape: Array
    mass: Array
    radii: tuple[float, float]
    car_strain: Array | None = None

    def critical_speed(self, mode: int, order: float) -> float:
        """Return the pinion speed [rad/s] at which `order` (of the pinion) meets a mode.

        NaN where it lies more than a factor of 3 beyond the ramp. Beyond the ramp the frequency is
        that at its end.
        """
        excited = order * self.speed / (2.0 * math.pi)
        gap = excited - self.frequency[:, mode]
        crossing = np.flatnonzero(np.diff(np.signbit(gap)))
        if crossing.size:
            i = int(crossing[0])
            share = gap[i] / (gap[i] - gap[i + 1])
            return float(self.speed[i] + share * (self.speed[i + 1] - self.speed[i]))
        end = 0 if gap[0] > 0.0 else -1
        speed = 2.0 * math.pi * float(self.frequency[end, mode]) / order
        within = self.speed[0] / _WIDER <= speed <= _WIDER * self.speed[-1]
        return speed if within else math.nan

    def damping_at(self, mode: int, speed: float) -> float:
        """Return the damping ratio [-] of a mode at a pinion speed [rad/s]."""
        return float(np.interp(speed, self.speed, self.damping_ratio[:, mode]))


def ramp_modes(settings: RunupSettings, torque: Array) -> RampModes:
    """Return the modes at speeds of the ramp, matched by their shapes.

    Parameters
    ----------
    settings : RunupSettings
    torque : array
        On the pinion [N m] at equal times of the ramp, shape (n,).
    """
    low, high = sorted((settings.start_speed, settings.end_speed))
    speeds = np.linspace(low, high, _NODES)
    given = np.linspace(settings.start_speed, settings.end_speed, torque.size)
    order = np.argsort(given)
    torques = np.interp(speeds, given[order], torque[order])
    axle = HypoidAxle(settings.car_axle.axle)
    mass = _masses(axle)
    middle = _NODES // 2
    found: dict[int, list[_Mode]] = {}
    for i in sorted(range(_NODES), key=lambda one: abs(one - middle)):
        axle.initialise(
            pinion_speed=float(speeds[i]),
            pinion_torque=float(torques[i]),
            wheel_torque=float(torques[i]) * axle.parameters.mesh.ratio,
            oil_temperature=settings.oil_temperature,
        )
        modes = _modes(settings, axle, float(speeds[i]), float(torques[i]))
        # the neighbour towards the middle is known already
        before = found.get(i + (1 if i < middle else -1))
        found[i] = modes if before is None else _matched(before, modes, mass)
    table = axle.parameters.mesh
    radii = (table.mean("R_p", float(torques[middle])), table.mean("R_g", float(torques[middle])))
    at_contact = np.ones(8)
    at_contact[0], at_contact[1] = radii
    shapes = np.stack([one.shape * at_contact for one in found[middle]], axis=1)
    places = list(_PLACES)
    return RampModes(
        speed=speeds,
        names=tuple(one.name for one in found[middle]),
        frequency=np.array([[one.frequency for one in found[i]] for i in range(_NODES)]),
        damping_ratio=np.array([[one.damping_ratio for one in found[i]] for i in range(_NODES)]),
        shape=shapes[places],
        mass=(mass / at_contact**2)[places],
        radii=radii,
        car_strain=np.array([one.car_strain for one in found[middle]]),
    )


class _Mode(NamedTuple):
    name: str
    frequency: float
    damping_ratio: float
    shape: Array
    car_strain: float = 0.0


def _modes(settings: RunupSettings, axle: HypoidAxle, speed: float, torque: float) -> list[_Mode]:
    """Return the modes of what is simulated: of the axle, or of axle and car together."""
    kelvin, car = settings.oil_temperature, settings.car_axle.driveline
    if settings.driver != VEHICLE:
        modes = named_modes(axle, kelvin, torque)
        return [_Mode(one.name, one.frequency, one.damping_ratio, one.shape) for one in modes]
    linear = linearise(axle, kelvin, torque)
    line = Driveline(
        car, speed * car.rolling_radius / car.axle_ratio, gear=gear_for_ramp(car, settings.ramp)
    )
    found = [one for one in coupled_modes(linear, line) if one.frequency > LOWEST]
    return [
        _Mode(name, one.frequency, one.damping_ratio, one.shape, one.car_strain)
        for name, one in zip(numbered([one.name for one in found]), found, strict=True)
        if one.shape is not None
    ]


def _masses(axle: HypoidAxle) -> Array:
    p = axle.kernel_parameters
    return np.array([p.I_p, p.I_g, *3 * [p.m_p], *3 * [p.m_g]])


def _matched(before: list[_Mode], modes: list[_Mode], mass: Array) -> list[_Mode]:
    """Return `modes` in the order of those before, each with the shape most like it."""
    from scipy.optimize import linear_sum_assignment

    if len(before) != len(modes):
        return modes[: len(before)]
    like = np.abs([[float(a.shape @ (mass * b.shape)) for b in modes] for a in before])
    _, columns = linear_sum_assignment(-like)
    return [modes[j] for j in columns]


def engine_orders(settings: RunupSettings) -> tuple[int, tuple[float, ...]]:
    """Return gear and engine orders in cycles per pinion revolution; gear 0 without an engine.

    The gear is that of the ramp, without the engine's orders in it that of the faster end.
    """
    car = settings.car_axle.driveline
    try:
        if settings.driver == VEHICLE:
            gear = gear_for_ramp(car, settings.ramp)
        else:
            fast = max(settings.start_speed, settings.end_speed)
            gear = car.gearbox.gear_for(fast, car.engine)
    except ParameterError:
        return 0, ()
    return gear, tuple(one.order * car.gearbox.ratios[gear - 1] for one in car.engine.orders)
