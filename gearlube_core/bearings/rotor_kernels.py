"""Motion of a rigid rotor on one bearing: right-hand side and Runge-Kutta steps."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.cage_frame import cage_torque
from gearlube_core.bearings.parameters import BearingParameters
from gearlube_core.bearings.roller_loads import bearing_forces, roller_loads
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


@kernel
def rotor_rate(
    s: np.ndarray,
    cage_angle: float,
    rotor: Rotor,
    out: np.ndarray,
) -> None:
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
        Steps between samples.
    rotor : Rotor
    states : ndarray, shape (n, 6)
        Receives the state at each sample.
    loads : ndarray, shape (n, n_rollers)
        Receives the roller loads [N].
    work : ndarray, shape (5, 6)
        Scratch.

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
