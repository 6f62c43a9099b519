"""Continuation against time integration, and the linear limit."""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import solve_ivp

from docs.resonance.cases import Curve, Point, reconstructed, respond
from docs.resonance.evidence import Evidence
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.rates import MICRO, UM

AGREE_AT = (0.3, 0.5, 0.65, 0.9, 1.0, 1.3)  # mesh over natural frequency
PERIODS = 100  # mesh periods after a disturbance
DISTURBANCE = 0.03  # of the peak-to-peak motion
SAMPLES = 256
TOLERANCE = 1e-9


def agreements(evidence: Evidence) -> tuple[int, float]:
    """Return how many stable motions were integrated in time, and the largest distance [%]."""
    curves = (evidence.two, evidence.one, evidence.mismatched[0.002], evidence.mismatched[0.004])
    points = [p for curve in curves for at in AGREE_AT for p in curve.points.get(at, [])]
    offs = [p.peak_to_peak / float(np.ptp(integrated(p))) - 1.0 for p in points]
    return len(offs), 100.0 * float(np.abs(offs).max())


def integrated(point: Point) -> Array:
    """Return x [m] over the last of `PERIODS` mesh periods, started beside a motion.

    DOP853 over time, states x in micrometres, speeds and angle: neither the integrator, nor the
    step, nor the independent variable of the period map.
    """
    problem = point.segment.problem
    model = problem.model
    row = point.row
    z, speed = point.segment.branch.unknowns[row], float(point.segment.branch.parameter[row])
    y, load = problem.state(z, speed)
    period = 2.0 * math.pi / (model.kernel_parameters.z_p * speed)
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


def linear_limit() -> list[str]:
    """Return how far 1-DOF and 2-DOF are from the closed form over 0.2 to 1.6.

    Constant stiffness, 10 nm of error.
    """
    amplitude = 10e-9
    mesh = {"stiffness_harmonics": (), "error_harmonics": ((amplitude, 0.0),)}
    found: list[str] = []
    for form in ("one_dof", "two_dof"):
        curve = Curve(respond(form, reconstructed(form=form, mesh=mesh, hold_gain=0.0), steps=128))
        model = curve.response.segments[0].problem.model
        m, k, c = model.equivalent_mass, model.stiffness, model.kernel_parameters.c
        w = curve.relative * math.sqrt(k / m)
        exact = amplitude * m * w**2 / abs(k - m * w**2 + 1j * c * w)
        off = np.abs([curve.up(r).harmonics[0] for r in curve.relative] / exact - 1.0)
        found.append(f"{off.max():.1e}")
    return found
