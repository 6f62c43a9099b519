"""A rigid rotor on one roller bearing under a constant radial load.

The stand-alone case of [mohammadpour_2015 Table A2]: a mass, a load and a speed that belong
to none of the vehicle's shafts.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.parameters import BearingParameters, cage_torque
from gearlube_core.bearings.roller_loads import bearing_forces, roller_loads
from gearlube_core.bearings.shaft_expansion import bearing_energy
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.checks import check_positive, check_within
from gearlube_core.kernels.jit import kernel

N_STATE = 6  # r1, r2 [m], their velocities [m/s], lost energy and work on the cage [J]


class Rotor(NamedTuple):
    """`RotorOnBearing` as the kernels read it."""

    mass: float  # kg
    load: float  # N
    shaft_speed: float  # rad/s
    f_ref: float  # reference frequency of the hysteresis [Hz]
    eta0: float  # Pa s
    alpha: float  # 1/Pa
    bearing: BearingParameters


@dataclass(frozen=True, slots=True)
class RotorHistory:
    """Result of `RotorOnBearing.simulate`; n samples at equal steps."""

    time: np.ndarray  # (n,) [s]
    displacement: np.ndarray  # (n, 2): along the load, across it [m]
    velocity: np.ndarray  # (n, 2) [m/s]
    roller_load: np.ndarray  # (n, n_rollers) [N]
    lost_energy: np.ndarray  # (n,) in the rollers since the start [J]
    cage_work: np.ndarray  # (n,) done by the rollers on the cage since the start [J]
    outcome: str  # "complete" or why not


@dataclass(frozen=True, slots=True, kw_only=True)
class RotorOnBearing:
    """A rigid mass on one bearing under a constant radial load, at constant speed.

    Parameters
    ----------
    bearing : TaperedRollerBearing
        With its interference, clearance or preload. The axial displacement is held at zero.
    mass : float
        [kg].
    load : float
        Radial, along the first displacement [N].
    shaft_speed : float
        [rad/s].
    eta0, alpha : float
        Viscosity [Pa s] and pressure-viscosity coefficient [1/Pa] of the oil.

    Examples
    --------
    >>> RotorOnBearing.mohammadpour_2015().load  # N
    1500.0
    """

    bearing: TaperedRollerBearing
    mass: float
    load: float
    shaft_speed: float
    eta0: float
    alpha: float

    def __post_init__(self) -> None:
        check_positive("mass", self.mass, "kg")
        check_within("load", self.load, -1e6, 1e6, "N")
        cure = "The hysteresis is referred to the passing of rollers."
        check_within("shaft_speed", self.shaft_speed, 1.0, 1e4, "rad/s", cure)
        check_within("eta0", self.eta0, 1e-5, 1e3, "Pa.s", "17.1 mPa s is 0.0171 Pa s.")
        check_within("alpha", self.alpha, 1e-10, 1e-6, "1/Pa", "20 1/GPa is 2e-8 1/Pa.")

    @classmethod
    def mohammadpour_2015(cls, fit: float = 10e-6) -> RotorOnBearing:
        """Return the case of Table A2 with an interference `fit` [m], negative for a clearance.

        Notes
        -----
        The table calls the 10 um a "radial interface" without saying which way. Its races close
        only for a cylindrical bearing, so the contact angle is zero; oil from Table A4.
        """
        bearing = TaperedRollerBearing.mohammadpour_2015(contact_angle=0.0)
        return cls(
            bearing=bearing.with_interference(fit),
            mass=50.0,
            load=1500.0,
            shaft_speed=209.0,
            eta0=0.0171,
            alpha=2.383e-8,
        )

    @property
    def cage_speed(self) -> float:
        """Speed of the cage [rad/s]."""
        return self.bearing.cage_ratio * self.shaft_speed

    @property
    def roller_pass_frequency(self) -> float:
        """Rate at which rollers pass the load, N cage_speed/(2 pi) [Hz].

        Also the reference frequency of the hysteresis, in place of the mesh frequency of
        [mohammadpour_2015 (25)], which this case lacks: rollers are loaded and unloaded at this
        rate.
        """
        return self.bearing.n_rollers * self.cage_speed / (2.0 * math.pi)

    def stored_energy(self, history: RotorHistory) -> np.ndarray:
        """Return kinetic plus elastic energy less the potential of the load, per sample [J]."""
        p = self.bearing.parameters()
        angle = self.cage_speed * history.time
        elastic = [
            bearing_energy(x, y, 0.0, a, self.shaft_speed, self.eta0, self.alpha, p, 1.0)
            for (x, y), a in zip(history.displacement, angle, strict=True)
        ]
        kinetic = 0.5 * self.mass * np.sum(history.velocity**2, axis=1)
        return np.asarray(kinetic + np.array(elastic) - self.load * history.displacement[:, 0])

    def simulate(
        self,
        duration: float,
        *,
        samples_per_pass: int = 32,
        steps_per_sample: int = 8,
        displacement: tuple[float, float] = (0.0, 0.0),
        velocity: tuple[float, float] = (0.0, 0.0),
    ) -> RotorHistory:
        """Return the motion from the given start, sampled at a fraction of the roller pass.

        Parameters
        ----------
        duration : float
            [s].
        samples_per_pass, steps_per_sample : int
            Samples per passing of a roller [-]; Runge-Kutta steps between samples [-].
        displacement, velocity : tuple of 2 floats
            At the start [m], [m/s].
        """
        check_positive("duration", duration, "s")
        check_within("samples_per_pass", samples_per_pass, 4, 4096)
        check_within("steps_per_sample", steps_per_sample, 1, 4096)
        interval = 1.0 / (self.roller_pass_frequency * samples_per_pass)
        n = round(duration / interval) + 1
        states = np.full((n, N_STATE), np.nan)
        loads = np.full((n, self.bearing.n_rollers), np.nan)
        rotor = Rotor(
            mass=self.mass,
            load=self.load,
            shaft_speed=self.shaft_speed,
            f_ref=self.roller_pass_frequency,
            eta0=self.eta0,
            alpha=self.alpha,
            bearing=self.bearing.parameters(),
        )
        status = rotor_history(
            np.array([*displacement, *velocity, 0.0, 0.0]),
            interval / steps_per_sample,
            steps_per_sample,
            rotor,
            states,
            loads,
            np.empty((5, N_STATE)),
        )
        return RotorHistory(
            time=interval * np.arange(n),
            displacement=states[:, 0:2],
            velocity=states[:, 2:4],
            roller_load=loads,
            lost_energy=states[:, 4],
            cage_work=states[:, 5],
            outcome="complete" if status == 0 else "not finite; take more steps_per_sample",
        )


@kernel
def rotor_rate(s: np.ndarray, cage_angle: float, rotor: Rotor, out: np.ndarray) -> None:
    """Write ds/dt: m r1'' = load + F_r1, m r2'' = F_r2, and the two powers."""
    p, shaft_speed = rotor.bearing, rotor.shaft_speed
    motion = ShaftMotion(s[0], s[1], 0.0, s[2], s[3], 0.0, cage_angle, shaft_speed)
    F_r1, F_r2, _, lost = bearing_forces(motion, rotor.f_ref, rotor.eta0, rotor.alpha, p, 1.0)
    out[0] = s[2]
    out[1] = s[3]
    out[2] = (rotor.load + F_r1) / rotor.mass
    out[3] = F_r2 / rotor.mass
    out[4] = lost
    out[5] = p.cage_ratio * shaft_speed * cage_torque(s[0], s[1], F_r1, F_r2)


@kernel
def rotor_history(
    s: np.ndarray,
    step: float,
    steps_per_sample: int,
    rotor: Rotor,
    states: np.ndarray,
    loads: np.ndarray,
    work: np.ndarray,
) -> int:
    """Integrate with the classical Runge-Kutta method and write every sample.

    Parameters
    ----------
    s : ndarray, shape (6,)
        Initial state, overwritten by the last one.
    step : float
        Time step [s].
    steps_per_sample : int
        Number of steps between two samples.
    rotor : Rotor
    states : ndarray, shape (n, 6)
        Receives the state at each sample.
    loads : ndarray, shape (n, n_rollers)
        Receives the roller loads [N].
    work : ndarray, shape (5, 6)
        Scratch memory, its values are lost.

    Returns
    -------
    int
        0, or 1 when the state is no longer finite.
    """
    p, shaft_speed = rotor.bearing, rotor.shaft_speed
    cage_speed = p.cage_ratio * shaft_speed
    turn = 2.0 * math.pi
    k1 = work[0]
    k2 = work[1]
    k3 = work[2]
    k4 = work[3]
    y = work[4]
    for i in range(states.shape[0]):
        for j in range(steps_per_sample if i > 0 else 0):
            a0 = (cage_speed * step * ((i - 1) * steps_per_sample + j)) % turn
            a1 = a0 + 0.5 * step * cage_speed
            a2 = a0 + step * cage_speed
            rotor_rate(s, a0, rotor, k1)
            for k in range(N_STATE):
                y[k] = s[k] + 0.5 * step * k1[k]
            rotor_rate(y, a1, rotor, k2)
            for k in range(N_STATE):
                y[k] = s[k] + 0.5 * step * k2[k]
            rotor_rate(y, a1, rotor, k3)
            for k in range(N_STATE):
                y[k] = s[k] + step * k3[k]
            rotor_rate(y, a2, rotor, k4)
            for k in range(N_STATE):
                s[k] += step / 6.0 * (k1[k] + 2.0 * (k2[k] + k3[k]) + k4[k])
        for k in range(N_STATE):
            states[i, k] = s[k]
        angle = (cage_speed * step * i * steps_per_sample) % turn
        motion = ShaftMotion(s[0], s[1], 0.0, s[2], s[3], 0.0, angle, shaft_speed)
        roller_loads(motion, rotor.f_ref, rotor.eta0, rotor.alpha, p, 1.0, loads[i])
        if not math.isfinite(s[0] + s[1] + s[2] + s[3]):
            return 1
    return 0
