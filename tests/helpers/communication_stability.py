"""Stability of the co-simulation of driveline and axle at a given communication step."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from scipy.linalg import expm

from drivetrain.driveline.equations import (
    INDEX,
    LONGEST_INNER_STEP,
    MEMORY,
    STATES,
    driveline_stepper,
)
from drivetrain.driveline.model import Driveline
from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.errors import ConvergenceError
from tests.helpers.torsional_axle import TorsionalAxle

_Matrix = Array


@dataclass(frozen=True, slots=True, kw_only=True)
class CommunicationMode:
    """One mode of the coupled system, exact and in the co-simulation.

    Parameters
    ----------
    frequency : float
        Undamped natural frequency [Hz].
    damping_ratio : float
        Of the continuous system [-].
    cosimulated_damping_ratio : float
        Of the co-simulation [-].
    """

    frequency: float
    damping_ratio: float
    cosimulated_damping_ratio: float

    @property
    def added_damping_ratio(self) -> float:
        """Numerical damping; negative feeds energy in [-]."""
        return self.cosimulated_damping_ratio - self.damping_ratio


@dataclass(frozen=True, slots=True, kw_only=True)
class CommunicationStability:
    """Linear stability of the co-simulation.

    Parameters
    ----------
    step : float
        Communication step [s].
    spectral_radius : float
        Growth per step of the fastest growing motion [-]; stable below 1.
    modes : tuple of CommunicationMode
        Modes below half the communication rate, highest first.
    """

    step: float
    spectral_radius: float
    modes: tuple[CommunicationMode, ...]

    @property
    def stable(self) -> bool:
        """Whether every motion decays."""
        return self.spectral_radius < 1.0


def communication_stability(
    driveline: Driveline, h: float, axle: TorsionalAxle | None = None
) -> CommunicationStability:
    """Return the stability of driveline and axle exchanging torques every `h` [s].

    Parameters
    ----------
    driveline : Driveline
        At its steady state.
    h : float
        Communication step [s].
    axle : TorsionalAxle, optional
        By default rigid.

    Notes
    -----
    The map is that of the real loop, linearised: the driveline continues the axle's angles
    linearly and integrates; the axle then moves exactly under the mean torques, held constant.
    """
    axle = TorsionalAxle() if axle is None else axle
    step_map = communication_map(driveline, h, axle)
    multipliers = np.linalg.eigvals(step_map)
    nonzero = multipliers[np.abs(multipliers) > 1e-12]
    found = np.log(nonzero.astype(complex)) / h
    modes = []
    for exact in np.linalg.eigvals(coupled_jacobian(driveline, axle)):
        if not 1e-6 * abs(exact) < exact.imag < np.pi / h:
            continue
        near = found[np.argmin(np.abs(found - exact))]
        modes.append(
            CommunicationMode(
                frequency=float(abs(exact) / (2.0 * np.pi)),
                damping_ratio=float(-exact.real / abs(exact)),
                cosimulated_damping_ratio=float(-near.real / abs(near)),
            )
        )
    return CommunicationStability(
        step=h,
        spectral_radius=float(np.max(np.abs(multipliers))),
        modes=tuple(sorted(modes, key=lambda mode: -mode.frequency)),
    )


def largest_stable_step(
    driveline: Driveline,
    axle: TorsionalAxle | None = None,
    shortest: float = 1e-5,
    longest: float = 1e-2,
) -> float:
    """Return the step [s] at which the co-simulation first becomes unstable, by bisection.

    Notes
    -----
    Steps are tried upwards in ratios of 1.05 first, so that an unstable band is not jumped over.
    Returns `longest` when all are stable.
    """
    axle = TorsionalAxle() if axle is None else axle

    def stable(h: float) -> bool:
        radius = np.max(np.abs(np.linalg.eigvals(communication_map(driveline, h, axle))))
        return bool(radius < 1.0)

    low = check_positive("shortest", shortest, "s")
    if not stable(low):
        raise ConvergenceError(
            f"The co-simulation must be stable at some step, it is not at {low:g} s. "
            "Give the driveline some damping, or try a shorter step."
        )
    high = low
    while stable(high):
        if high >= longest:
            return longest
        low, high = high, min(1.05 * high, longest)
    while high - low > 1e-3 * low:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if stable(middle) else (low, middle)
    return low


def communication_map(driveline: Driveline, h: float, axle: TorsionalAxle) -> _Matrix:
    """Return the linear map of one interval on (driveline states but crank angle, axle states)."""
    check_within("h", h, 1e-7, 1e-2, "s", "A communication step of 1e-4 s keeps a margin.")
    free, torque_rows = steady_interval(driveline, h)
    size = len(STATES) - 1
    a, b, speeds = axle.matrices(driveline.parameters.axle_ratio)
    n = len(a)
    # Axle over h: state, and the angles that it covers, from state and held torques.
    block = np.zeros((n + 4, n + 4))
    block[:n, :n] = a
    block[:n, n : n + 2] = b
    block[n + 2 :, :n] = speeds
    moved = expm(block * h)
    total = np.zeros((size + n, size + n))
    drive = np.hstack([free[:, :size], free[:, size:] @ speeds])
    torques = np.hstack([torque_rows[:, :size], torque_rows[:, size:] @ speeds])
    on_axle = np.hstack([np.zeros((n, size)), np.eye(n)])
    total[:size] = drive
    total[size:] = moved[:n, :n] @ on_axle + moved[:n, n : n + 2] @ torques
    covered = moved[n + 2 :, :n] @ on_axle + moved[n + 2 :, n : n + 2] @ torques
    continued = h * speeds @ on_axle
    # The twists follow the angles that the axle has covered, not those continued.
    total[INDEX["propshaft_twist"] - 1] += continued[0] - covered[0]
    total[INDEX["half_shaft_twist"] - 1] += covered[1] - continued[1]
    return total


def coupled_jacobian(driveline: Driveline, axle: TorsionalAxle) -> _Matrix:
    """Return the Jacobian of driveline and axle coupled without delay."""
    steady = driveline.steady
    a, b, speeds = axle.matrices(driveline.parameters.axle_ratio)
    y = ca.MX.sym("y", len(STATES) - 1 + len(a))
    x, axle_state = y[: len(STATES) - 1], y[len(STATES) - 1 :]
    inputs = driveline.inputs
    inputs[2] = 0.0
    rates, torques, _, _ = driveline.equations(
        ca.vertcat(0.0, x), ca.DM(speeds) @ axle_state, inputs
    )
    all_rates = ca.vertcat(rates[1:], ca.DM(a) @ axle_state + ca.DM(b) @ torques)
    function = ca.Function("coupled", [y], [ca.jacobian(all_rates, y)])
    motion = [steady.pinion_speed, steady.wheel_speed]
    point = np.concatenate([steady.state[1:], np.zeros(len(a) - len(motion[: len(a)])), motion])
    return np.array(function(point[: len(STATES) - 1 + len(a)]))


def steady_interval(driveline: Driveline, h: float) -> tuple[Array, Array]:
    """Return the linear map of one interval of `h` [s] at the smooth steady state.

    Returns
    -------
    tuple of array
        Derivatives of the states but the crank angle, shape (9, 11), and of the mean torques,
        shape (2, 11), by these states, pinion speed and wheel speed.
    """
    steady, inputs, a = driveline.steady, driveline.inputs, driveline.parameters
    interval = driveline_stepper(
        driveline.equations,
        max(1, math.ceil(h / LONGEST_INNER_STEP)),
        a.propshaft_stiffness,
        a.half_shaft_stiffness,
    )
    inputs[2] = 0.0
    point = np.concatenate([steady.state[1:], [steady.pinion_speed, steady.wheel_speed]])
    states, torques = interval_jacobian(interval)(point, h, inputs)
    return np.array(states), np.array(torques)


def interval_jacobian(interval: Any) -> Any:
    """Return the derivatives of a map from `driveline_stepper` as a casadi Function.

    Returns
    -------
    casadi.Function
        (y, h, p) -> (d states / d y, d mean torques / d y), with y the states but the crank angle,
        pinion speed and wheel speed. The axle's angles are those that were expected.
    """
    size = len(STATES) - 1
    y, h, p = ca.MX.sym("y", size + 2), ca.MX.sym("h"), ca.MX.sym("p", 3)
    memory = ca.vertcat(0.0, y[:size], ca.DM.zeros(len(MEMORY) - len(STATES)))
    end, torques = interval(memory, ca.vertcat(h, 0.0, y[size], 0.0, y[size + 1]), p)
    return ca.Function(
        "interval_jacobian",
        [y, h, p],
        [ca.jacobian(end[1 : len(STATES)], y), ca.jacobian(torques[:2], y)],
    )
