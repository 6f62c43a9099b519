"""Continuation against time integration, the linear limit, and what loose tolerances do."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

from docs.resonance.cases import E0, R_P0, TEETH, Curve, Point, reconstructed, respond
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.rates import MICRO, UM

PERIODS = 100  # mesh periods after a disturbance
DISTURBANCE = 0.03  # of the peak-to-peak motion
SAMPLES = 256
TOLERANCE = 1e-9


@dataclass(frozen=True, slots=True)
class Agreement:
    """One stable motion by continuation and by integration in time from beside it."""

    pair: str
    form: str
    branch: str
    relative: float
    continued: Point
    peak_to_peak: float  # by integration [m]
    separation_share: float

    @property
    def off(self) -> float:
        """Peak to peak by continuation over that by integration, less one [-]."""
        return self.continued.peak_to_peak / self.peak_to_peak - 1.0


def agreements(curves: dict[tuple[str, str], Curve], ratios: tuple[float, ...]) -> list[Agreement]:
    """Return the comparison on every stable branch at chosen frequencies.

    Parameters
    ----------
    curves : dict of (str, str) to Curve
        By names of pair and form.
    ratios : tuple of float
        Mesh over natural frequency.
    """
    found = []
    for (pair, form), curve in curves.items():
        for relative in ratios:
            points = curve.points.get(relative, [])
            for number, point in enumerate(points):
                name = "only" if len(points) == 1 else ("lower", "upper")[min(number, 1)]
                x = integrated(point)
                apart = (x < 0.0) & (x > -_backlash(point))
                swing, share = float(np.ptp(x)), float(np.mean(apart))
                found.append(Agreement(pair, form, name, relative, point, swing, share))
    return found


def integrated(point: Point) -> Array:
    """Return x [m] over the last of `PERIODS` mesh periods, started beside a motion.

    DOP853 over time, states x in micrometres, speeds and angle: neither the integrator, nor the
    step, nor the independent variable of the period map.
    """
    problem = point.segment.problem
    model = problem.model
    p = model.kernel_parameters
    row = point.row
    z, speed = point.segment.branch.unknowns[row], float(point.segment.branch.parameter[row])
    y, load = problem.state(z, speed)
    period = 2.0 * math.pi / (p.z_p * speed)
    end = PERIODS * period
    times = np.linspace(end - period, end, SAMPLES, endpoint=False)
    two = problem.size == 4
    kick = MICRO * DISTURBANCE * point.peak_to_peak
    start = np.array([y[0] + kick, y[1], y[2], 0.0]) if two else np.array([y[0] + kick, y[1]])

    def pair(_: float, s: Array) -> list[float]:
        r = model.pair_rates(s[0] * UM, s[1], s[2], s[3], load, speed)
        return [r.x * MICRO, r.w_p, r.w_g, s[1]]

    def reduced(t: float, s: Array) -> list[float]:
        r = model.reduced_rates(s[0] * UM, s[1], speed * t, speed)
        return [r.x * MICRO, r.v]

    found = solve_ivp(
        pair if two else reduced, (0.0, end), start, "DOP853", times, rtol=TOLERANCE, atol=TOLERANCE
    )
    return np.asarray(found.y[0] * UM)


def _backlash(point: Point) -> float:
    return point.segment.problem.model.kernel_parameters.backlash


@dataclass(frozen=True, slots=True)
class LinearLimit:
    """Largest relative distance from the exact linear response, and where [-]."""

    form: str
    worst: float
    at: float


def linear_limit() -> list[LinearLimit]:
    """Compare with the exact response over 0.2 to 1.6: constant stiffness, 10 nm of error."""
    amplitude = 10e-9
    mesh = {"stiffness_harmonics": (), "error_harmonics": ((amplitude, 0.0),)}
    found = []
    for form in ("one_dof", "two_dof"):
        curve = Curve(respond(form, reconstructed(form=form, mesh=mesh, hold_gain=0.0), steps=128))
        model = curve.response.segments[0].problem.model
        m, k, c = model.equivalent_mass, model.stiffness, model.kernel_parameters.c
        worst, place = 0.0, 0.0
        for r in curve.relative:
            w = r * math.sqrt(k / m)
            exact = amplitude * m * w**2 / abs(k - m * w**2 + 1j * c * w)
            off = abs(curve.up(r).harmonics[0] / exact - 1.0)
            if off > worst:
                worst, place = off, float(r)
        found.append(LinearLimit(form, worst, place))
    return found


@dataclass(frozen=True, slots=True)
class Drift:
    """Peak-to-peak transmission error with one choice of states and tolerances."""

    states: str
    rtol: float
    atol: float
    peak_to_peak: float  # m
    evaluations: int


TOLERANCES = ((1e-3, 1e-6), (1e-4, 1e-7), (1e-5, 1e-8), (1e-6, 1e-9), (1e-7, 1e-10), (1e-9, 1e-12))
DURATION = 0.3  # s
DRIFT_AT = 0.5


def drifts() -> list[Drift]:
    """Integrate the pair at half its natural frequency by RK45 with looser and tighter tolerances.

    Once with both angles as states, x their difference, and once with x in micrometres.
    """
    model = HypoidTorsional(reconstructed(radii="mean", hold_gain=0.0))
    speed = model.pinion_speed(DRIFT_AT * model.natural_frequency)
    load = model.mean_load_torque
    R_g = R_P0 * 36.0 / 13.0

    def absolute(_: float, s: Array) -> list[float]:
        x = R_P0 * s[0] - R_g * s[1] - E0 * math.cos(TEETH * s[0])
        r = model.pair_rates(x, s[2], s[3], s[0], load, speed)
        return [s[2], s[3], r.w_p, r.w_g]

    def relative(_: float, s: Array) -> list[float]:
        r = model.pair_rates(s[0] * UM, s[1], s[2], s[3], load, speed)
        return [r.x * MICRO, r.w_p, r.w_g, s[1]]

    y = model.initial_state(speed)
    angles = np.array([0.0, (-E0 - y[0] * UM) / R_g, y[1], y[2]])
    found = []
    for rtol, atol in TOLERANCES:
        for name, rates, start in (("two angles", absolute, angles), ("x in um", relative, y)):
            s = solve_ivp(rates, (0.0, DURATION), start, "RK45", rtol=rtol, atol=atol)
            late = s.y[:, s.t > 0.5 * DURATION]
            x = (
                R_P0 * late[0] - R_g * late[1] - E0 * np.cos(TEETH * late[0])
                if name == "two angles"
                else late[0] * UM
            )
            found.append(Drift(name, rtol, atol, float(np.ptp(x)), int(s.nfev)))
    return found
