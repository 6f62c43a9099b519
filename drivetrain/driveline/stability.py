"""Stability of the co-simulation of driveline and axle at a given communication step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm

from drivetrain.driveline.equations import INDEX, STATES
from drivetrain.driveline.model import Driveline
from drivetrain.driveline.torsional_axle import TorsionalAxle
from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive, check_within
from gearlube_core.errors import ConvergenceError

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
    free, torque_rows = driveline.interval_jacobian(h)
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
    import casadi as ca

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
