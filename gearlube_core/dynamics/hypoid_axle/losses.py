"""Mean losses of an axle in steady running, over torque, speed and oil temperature."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.dynamics.hypoid_axle.cycle_kernels import N_EXTREMES, cycle_kernels
from gearlube_core.dynamics.hypoid_axle.mesh_cycle import (
    LOSS_SOURCES,
    N_LOSSES,
    NO_BALANCE,
    cycle_work,
)
from gearlube_core.dynamics.hypoid_axle.model import NO_EQUILIBRIUM_CURE, torque_limits
from gearlube_core.dynamics.hypoid_axle.shafts_at_rest import NO_EQUILIBRIUM
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import without_losses
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.dynamics.ranges import MAX_SPEED
from gearlube_core.kernels.flat_tuples import flatten
from gearlube_core.progress import Progress, no_progress

SETTLED = 0.01  # K, error of the temperature

TOO_HOT = NO_BALANCE + 1
FAILURES = {
    0: "",
    NO_EQUILIBRIUM: f"no static equilibrium of the shafts. {NO_EQUILIBRIUM_CURE}",
    NO_BALANCE: "the torques on the pinion did not balance. Change the torque a little.",
    TOO_HOT: "the flanks' bulk gets hotter than 100 K above the oil's data. Give a smaller "
    "flank_bulk_resistance.",
}
_RUBBING = [LOSS_SOURCES.index(one) for one in ("friction_viscous", "friction_boundary")]
_OF_FILMS = [*_RUBBING, LOSS_SOURCES.index("friction_rolling")]  # at the flanks' temperature
_BEYOND = 100.0  # K above the oil's data, to which a bulk is looked for
ANGLES = 32  # of a mesh period; see docs/loss_map.md for what fewer and more give
_ROUNDING = 1e-12  # of the sum: the mesh is damped by rates that are zero but for rounding


@dataclass(frozen=True, slots=True, kw_only=True)
class AxleLosses:
    """Mean losses over a mesh period; arrays over (temperature, speed, torque).

    Parameters
    ----------
    power : ndarray of shape (temperatures, speeds, torques, sources)
        [W], sources as in LOSS_SOURCES; NaN where a point failed.
    carried : ndarray of shape (temperatures, speeds, torques)
        Torque that the teeth carry, at the pinion [N.m].
    film_ratio, flank_temperature : ndarray
        Least film ratio [-] and largest temperature [K] of a flank under load; infinite and that
        of the oil where none carries load. Empty where they were not asked for.
    friction_bound, share_outside : ndarray
        Bound of the power lost in flank friction [W], and share of the flanks' load outside the
        domain of the model of solved films [-], means over a mesh period; 0 with film formulas.
        Empty where extremes were not asked for.
    drag_bound, rollers_outside : ndarray
        The same of the drag of the bearings and of the load on their rollers, by solved films.
    pinion_drag : ndarray
        Drag loss of the bearings of the pinion's shaft alone [W]; empty likewise.
    bulk_temperature : ndarray
        Of the flanks' bulk [K]; that of the oil with `flank_bulk_resistance` 0.
    exceeded : ndarray
        Sum of 1, 2, 4, ... for each range that was left, see `ranges.RANGE_OUTPUTS`.
    status : ndarray of int
        Outcome of each point, a key of `FAILURES`.
    """

    power: Array
    carried: Array
    film_ratio: Array
    flank_temperature: Array
    friction_bound: Array
    share_outside: Array
    drag_bound: Array
    rollers_outside: Array
    pinion_drag: Array
    bulk_temperature: Array
    exceeded: Array
    status: Array

    @property
    def total(self) -> Array:
        """Power lost in all [W], (temperatures, speeds, torques)."""
        return np.asarray(self.power.sum(axis=-1))


def axle_losses(
    parameters: HypoidAxleParameters,
    *,
    torques: Array,
    speeds: Array,
    temperatures: Array,
    angles: int = ANGLES,
    extremes: bool = True,
    progress: Progress = no_progress,
) -> AxleLosses:
    """Return the mean losses in steady running by one mesh period at each point.

    Parameters
    ----------
    parameters
        Parameters of the hypoid axle.
    torques : ndarray of shape (n,)
        On the pinion from outside [N.m], within 1.5 times the mesh table; below 0 the wheels
        drive (coast).
    speeds : ndarray of shape (m,)
        Of the pinion [rad/s], above 0 to 5000.
    temperatures : ndarray of shape (k,)
        Of the oil [K], within the range of the oil's data.
    angles
        Equal parts of the mesh period.
    extremes
        Also find film ratio, flank temperature and ranges, at four angles.
    progress
        Called with the share that is done and a sentence.

    Raises
    ------
    ParameterError
        A number is out of range. Nothing has been computed then.

    Notes
    -----
    Friction and drag are those of the axle in motion, evaluated at rest at each angle: what a
    march in time adds is the swing of loads about their means and the damping of mesh and
    rollers. It matters near resonances and where teeth part. With `flank_bulk_resistance` films,
    friction and rolling of the flanks are those at the steady temperature of their bulk, see
    `flank_bulk`; all else is at the oil's. A bulk hotter than the oil's data counts as a range that
    was left.

    Examples
    --------
    >>> from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
    >>> found = axle_losses(
    ...     mohammadpour_2015_axle(), torques=np.array([50.0]), speeds=np.array([209.4]),
    ...     temperatures=np.array([333.15]),
    ... )
    >>> dict(zip(LOSS_SOURCES, found.power[0, 0, 0].round(1).tolist()))["friction_viscous"]  # W
    225.6
    """
    torques, speeds, temperatures = (
        np.atleast_1d(np.asarray(one, dtype=float)) for one in (torques, speeds, temperatures)
    )
    limits = torque_limits(parameters)
    for torque in torques:
        check_within("torque", torque, limits.pinion_low, limits.pinion_high, "N.m", limits.cure)
    for speed in speeds:
        check_within("speed", speed, 1e-3, MAX_SPEED, "rad/s", "A map has no point at rest.")
    for temperature in temperatures:
        parameters.oil.check_temperature(float(temperature))
    check_within("angles", angles, 4, 4096, "", "Default 32.")
    p = parameters.kernel_parameters()
    # over one mesh period
    mesh = replace(parameters, mesh=parameters.mesh.without_shaft_error()).packed_mesh()
    work = np.zeros(cycle_work(mesh.series_size, mesh.nodes))
    kernel = cycle_kernels(type(p.bearing_p), type(p.flank_law)).losses_along_torque
    constants = flatten(p), flatten(without_losses(p))
    models = parameters.film_model(), parameters.roller_model()
    fields = (*mesh.fields, *models, *parameters.oil.own_laws())
    shape = temperatures.size, speeds.size, torques.size
    power, carried = np.full((*shape, N_LOSSES), np.nan), np.full(shape, np.nan)
    found, status = np.full((*shape, N_EXTREMES), np.nan), np.zeros(shape)
    bulk = np.broadcast_to(temperatures[:, None, None], shape).copy()

    def write(speed: float, torques: Array, temperature: float, *of_torques: Array) -> None:
        kernel(speed, torques, temperature, angles, extremes, fields, *constants, work, *of_torques)

    for i, temperature in enumerate(temperatures):
        for j, speed in enumerate(speeds):
            progress((i * speeds.size + j) / (shape[0] * shape[1]), "losses")
            here = power[i, j], carried[i, j], found[i, j], status[i, j]
            write(speed, torques, temperature, *here)
            if parameters.flank_bulk_resistance > 0.0:
                for k in np.flatnonzero(here[-1] == 0):
                    warm = _warm_flanks(parameters, write, speed, torques[k], temperature)
                    bulk[i, j, k], status[i, j, k] = warm.temperature, warm.status
                    power[i, j, k, _OF_FILMS] = warm.power[_OF_FILMS]
                    exceeded = found[i, j, k, 2]
                    found[i, j, k] = warm.found
                    if extremes and warm.status == 0:
                        found[i, j, k, 2] = int(exceeded) | int(warm.found[2])
    power[status != 0] = np.nan
    power[np.abs(power) < _ROUNDING * power.sum(axis=-1, keepdims=True)] = 0.0
    carried[status != 0] = np.nan
    return AxleLosses(
        power=power,
        carried=carried,
        film_ratio=found[..., 0],
        flank_temperature=found[..., 1],
        exceeded=found[..., 2],
        friction_bound=found[..., 3],
        share_outside=found[..., 4],
        drag_bound=found[..., 5],
        rollers_outside=found[..., 6],
        pinion_drag=found[..., 7],
        bulk_temperature=bulk,
        status=status.astype(int),
    )


class _Warm(NamedTuple):
    """A point with warm flanks."""

    temperature: float  # of their bulk [K]
    status: int
    power: Array
    found: Array


def _warm_flanks(
    parameters: HypoidAxleParameters,
    write: Callable[..., None],
    speed: float,
    torque: float,
    oil: float,
) -> _Warm:
    """Return a point with films at the temperature of the flanks' bulk."""
    power, found = np.full((1, N_LOSSES), np.nan), np.full((1, N_EXTREMES), np.nan)
    carried, status = np.zeros(1), np.zeros(1)

    def friction(temperature: float) -> float:
        write(speed, np.array([torque]), temperature, power, carried, found, status)
        return float(power[0, _RUBBING].sum()) if status[0] == 0 else 0.0

    highest = parameters.oil.temperature_high + _BEYOND
    temperature = bulk_temperature(friction, oil, parameters.flank_bulk_resistance, highest)
    if np.isnan(temperature):
        return _Warm(temperature, TOO_HOT, power[0], np.full(N_EXTREMES, np.nan))
    friction(temperature)
    return _Warm(temperature, int(status[0]), power[0], found[0])


def bulk_temperature(
    friction: Callable[[float], float], oil: float, resistance: float, highest: float
) -> float:
    """Return the temperature of the flanks at which their friction keeps them warm [K].

    T = T_oil + R P(T)

    Parameters
    ----------
    friction
        Mean power lost in friction of the flanks [W] with films at a temperature [K].
    oil
        Temperature of the oil around the teeth [K].
    resistance
        From the flanks to that oil [K/W].
    highest
        Highest temperature at which the friction is known [K].

    Returns
    -------
    float
        The lowest such temperature within `SETTLED`; nan: above `highest`.

    Notes
    -----
    One temperature for both members, steady. Thin hot films may rub more: the friction need not
    fall with temperature.

    Examples
    --------
    >>> round(bulk_temperature(lambda T: 700.0 - T, 300.0, 0.25, 400.0), 2)
    380.0
    """

    def missing(temperature: float) -> float:
        return oil + resistance * friction(temperature) - temperature

    low, gap = oil, missing(oil)
    if gap <= SETTLED:
        return oil + max(gap, 0.0)
    while low < highest:
        high = min(low + 1.05 * gap + SETTLED, highest)
        above = missing(high)
        if above <= 0.0:
            return float(brentq(missing, low, high, xtol=SETTLED, rtol=1e-12))
        low, gap = high, above
    return math.nan
