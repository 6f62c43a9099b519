"""Periodic steady state of the linear pair with sliding friction, by its monodromy matrix."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.dynamics.helical_pair.linear.linear_system import (
    RELATIVE,
    LinearSystem,
    linear_system,
    system_moments,
)
from gearlube_core.dynamics.helical_pair.linear.period_march import PeriodMarch, march_period
from gearlube_core.dynamics.helical_pair.mesh.film_friction import FilmConstants, FilmField
from gearlube_core.dynamics.helical_pair.mesh.mesh_wrench import wrench_columns
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.dynamics.helical_pair.supports import bearing_forces
from gearlube_core.errors import ConvergenceError
from gearlube_core.periodic.floquet import floquet_multipliers

_INSIDE = 1e-9  # share of an interval
_FILM_ITERATIONS = 30
_FILM_TOLERANCE = 1e-6  # of the strains' swing
_SETTLES = 1e-9  # decay a period below which a motion counts as free, by rounding
COMPOSITES = ("delta_x", "delta_y", "delta_z")


@dataclass(frozen=True, slots=True, kw_only=True)
class ResponseSettings:
    """Resolution of a periodic response.

    Parameters
    ----------
    samples : int
        Equally spaced over the mesh period; harmonics up to an eighth of them are clean.
    steps_per_oscillation : int
        Time steps for one oscillation of the fastest motion of the pair.
    """

    samples: int = 256
    steps_per_oscillation: int = 20

    def __post_init__(self) -> None:
        check_within("samples", self.samples, 16, 65536)
        check_within("steps_per_oscillation", self.steps_per_oscillation, 4, 10000)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PeriodicResponse:
    """One mesh period of the steady state.

    Parameters
    ----------
    parameters : HelicalPairParameters
    pinion_speed : float
        [rad/s]
    period : float
        Of the mesh [s].
    phase : ndarray of shape (N,)
        [mesh periods]
    displacement, rate : ndarray of shape (N, 11)
        Of the coordinates `RELATIVE` [m, rad] and [m/s, rad/s]; zero where held.
    mesh_force : ndarray of shape (N, 12)
        Elastic and frictional forces and moments of the flanks on pinion, then gear [N, N.m].
    multipliers : ndarray of complex, shape (2n,)
        Floquet multipliers of the n free coordinates, largest first.
    friction_torque : float
        Mean torque of friction on the pair as a whole, at the pinion [N.m]. It stays unbalanced
        under constant torques and turns the pair away slowly; times pinion_speed it is the power
        that friction takes.
    steps : int
        Time steps of the march over the period.
    """

    parameters: HelicalPairParameters
    pinion_speed: float
    period: float
    phase: Array
    displacement: Array
    rate: Array
    mesh_force: Array
    multipliers: np.ndarray[Any, np.dtype[np.complex128]]
    friction_torque: float
    steps: int

    def signal(self, name: str) -> Array:
        """Return the history of a coordinate of `RELATIVE` or a composite, shape (N,) [m, rad]."""
        return self._combined(name, self.displacement)

    def signal_rate(self, name: str) -> Array:
        """Return its rate, shape (N,) [m/s, rad/s]."""
        return self._combined(name, self.rate)

    def _combined(self, name: str, values: Array) -> Array:
        """Return a coordinate, or delta_x, delta_y, delta_z of [he_2007 sec. 6].

        delta_z = psi - u_xp + u_xg is kinematic, with the signs of [he_2007 (4)] (printed + u_xp -
        u_xg); delta_x = r_bp th_xp + r_bg th_xg + u_zp - u_zg likewise; delta_y, with th_y, as
        defined.
        """
        column = {label: values[:, i] for i, label in enumerate(RELATIVE)}
        if name not in COMPOSITES:
            return np.asarray(column[name])
        if name == "delta_z":
            return np.asarray(column["psi"] - column["u_xp"] + column["u_xg"])
        axis, pair = name[-1], self.parameters.pair
        tilt = (
            pair.pinion_base_radius * column[f"th_{axis}p"]
            + pair.gear_base_radius * column[f"th_{axis}g"]
        )
        return np.asarray(tilt + column["u_zp"] - column["u_zg"])

    @property
    def bearing_force(self) -> Array:
        """Forces and moments of both members' bearings on them, see `bearing_forces`."""
        return bearing_forces(self.parameters.support_arrays(), self.displacement, self.rate)

    @property
    def friction_power(self) -> float:
        """Mean power that friction takes [W]."""
        return self.friction_torque * self.pinion_speed


def harmonics(history: Array, count: int = 15) -> Array:
    """Return the amplitudes of harmonics 1 to `count` of the mesh frequency along axis 0.

    Examples
    --------
    >>> phase = np.arange(64) / 64
    >>> harmonics(3.0 + 2.0 * np.cos(2.0 * np.pi * 4.0 * phase), 5).round(12).tolist()
    [0.0, 0.0, 0.0, 2.0, 0.0]
    """
    return np.asarray(2.0 * np.abs(np.fft.rfft(history, axis=0)[1 : count + 1]) / len(history))


def periodic_response(
    parameters: HelicalPairParameters,
    pinion_speed: float,
    settings: ResponseSettings | None = None,
    *,
    throw: bool = True,
) -> PeriodicResponse:
    """Return the periodic steady state of a helical pair at a pinion speed.

    z0 = (1 - M)^-1 z_forced with the monodromy matrix M, in relative coordinates. Film friction
    follows the loads of the response itself; the multipliers are computed with its coefficients
    fixed in phase.

    Parameters
    ----------
    parameters
        Parameters of the pair. Its contact is linear, so the loads at a light torque must be read
        with care.
    pinion_speed
        Speed of the steady rotation [rad/s], above zero.
    settings
        Resolution of the periodic response.
    throw
        True: raise an error if the pair is unstable; False: return its unstable periodic motion.

    Raises
    ------
    ConvergenceError
        A Floquet multiplier is on or outside the unit circle, so that no motion settles there; or
        the iteration between film friction and motion does not converge.

    Notes
    -----
    He et al. 2007 integrate their equations of motion until transients are gone. With friction the
    free rotation of their pair grows without limit, see `linear_system`; its vibration does not
    depend on that.

    As in the paper, no torque acts back on the pinion when loaded springs enter, leave or change.
    The time march can include it, see `HelicalMarchParameters.equations`. This torque is quadratic
    in the motion, and an impulse where whole lines of a spur pair enter or leave under load.
    So it cannot be part of a linear system with moments of the mesh.

    Examples
    --------
    >>> from gearlube_core.dynamics.helical_pair.gear_file_pair import helical_pair_parameters
    >>> from gearlube_core.helical_geometry.gear_file import HelicalGearFile
    >>> gears = HelicalGearFile.named("he_2007")
    >>> pair = helical_pair_parameters(gears, pinion_torque=226.0, mu=0.05)
    >>> psi = periodic_response(pair, 104.7).signal("psi")  # transmission error [m]
    >>> f"{1e6 * (psi.max() - psi.min()):.1f} um"
    '1.8 um'
    """
    check_positive("pinion_speed", pinion_speed, "rad/s")
    settings = settings or ResponseSettings()
    system = linear_system(parameters)
    period = 1.0 / parameters.pair.mesh_frequency(pinion_speed)
    march = march_period(system, period, settings.samples, settings.steps_per_oscillation)
    if parameters.film is not None and parameters.friction == "film":
        system, march = _with_film(
            system, march, parameters.film.constants(), pinion_speed, period, settings
        )
    multipliers = floquet_multipliers(march.transition[-1])
    if throw and not abs(multipliers[0]) < 1.0 - _SETTLES:
        raise ConvergenceError(
            "The pair must be stable to have a steady state, got a Floquet multiplier of modulus "
            f"{abs(multipliers[0]):.6g} at {pinion_speed:g} rad/s. Raise the damping ratios or "
            "move the speed; `instability_map` shows where it is stable."
        )
    return _response(parameters, system, pinion_speed, period, march, multipliers)


def _periodic_states(march: PeriodMarch) -> Array:
    """Return the states that repeat, shape (B, 2n)."""
    size = march.forced.shape[1]
    start = np.linalg.solve(np.eye(size) - march.transition[-1], march.forced[-1])
    return np.asarray(march.transition @ start + march.forced)


def _with_film(
    system: LinearSystem,
    march: PeriodMarch,
    film: FilmConstants,
    pinion_speed: float,
    period: float,
    settings: ResponseSettings,
) -> tuple[LinearSystem, PeriodMarch]:
    """Return system and march whose friction is that of their own periodic motion.

    Fixed-point iteration over the strain of the plane of contact, from no friction: friction moves
    it by mu times small lever arms, and the coefficient follows the load weakly.
    """
    n = len(system.names)
    strain = _periodic_states(march)[:, :n] @ system.E.T
    for _ in range(_FILM_ITERATIONS):
        system = system._replace(film=FilmField(film, pinion_speed, march.phase, strain))
        march = march_period(system, period, settings.samples, settings.steps_per_oscillation)
        before, strain = strain, _periodic_states(march)[:, :n] @ system.E.T
        if np.all(np.abs(strain - before).max(axis=0) <= _FILM_TOLERANCE * np.ptp(strain, axis=0)):
            return system, march
    raise ConvergenceError(
        f"Film friction and motion must agree within {_FILM_ITERATIONS} iterations, but they do "
        f"not at {pinion_speed:g} rad/s. Raise the damping ratios or move the speed off a "
        "resonance."
    )


def _response(
    parameters: HelicalPairParameters,
    system: LinearSystem,
    pinion_speed: float,
    period: float,
    march: PeriodMarch,
    multipliers: np.ndarray[Any, np.dtype[np.complex128]],
) -> PeriodicResponse:
    n, states = len(system.names), _periodic_states(march)
    phase, samples = march.phase[march.sample], states[march.sample]
    places = [RELATIVE.index(name) for name in system.names]
    displacement, rate = np.zeros((2, phase.size, len(RELATIVE)))
    displacement[:, places], rate[:, places] = samples[:, :n], samples[:, n:]
    return PeriodicResponse(
        parameters=parameters,
        pinion_speed=pinion_speed,
        period=period,
        phase=phase,
        displacement=displacement,
        rate=rate,
        mesh_force=_sums(system, phase, samples[:, :n]) @ wrench_columns(system.plane).T,
        multipliers=multipliers,
        friction_torque=_mean_friction_torque(system, march.phase, states[:, :n]),
        steps=march.steps,
    )


def _sums(system: LinearSystem, phase: Array, q: Array) -> Array:
    """Return the line loads' sums of `mesh_wrench`, shape (phases, 5)."""
    moments = system_moments(system, phase)
    return np.asarray(np.einsum("tij,tj->ti", moments[:, :, :2], q @ system.E.T) - moments[:, :, 2])


def _mean_friction_torque(system: LinearSystem, phase: Array, q: Array) -> float:
    """Return the mean over the period by trapezoids that end where the mesh jumps [N.m]."""
    plane, width, torques = system.plane, np.diff(phase), []
    for end, inwards in ((slice(None, -1), _INSIDE), (slice(1, None), -_INSIDE)):
        sums = _sums(system, phase[end] + inwards * width, q[end])
        r, rx = sums[:, 2], sums[:, 3]
        torques.append(rx - (plane.x_g * r - rx) * plane.r_bp / plane.r_bg)
    return float(0.5 * np.sum(width * (torques[0] + torques[1])))


def with_friction(parameters: HelicalPairParameters, mu: float) -> HelicalPairParameters:
    """Return the pair with a constant coefficient of friction [-]."""
    return replace(parameters, friction="constant", friction_coefficient=mu)
