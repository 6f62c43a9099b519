"""Continuation against time integration, the linear limit, starts and loose tolerances: rows."""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import solve_ivp

from docs.resonance.cases import E0, MISMATCHES, R_P0, TEETH, Curve, Point, reconstructed, respond
from docs.resonance.evidence import Evidence
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.mode_march import MARCH_WORK, N_RECORD, march
from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.rates import MICRO, UM
from gearlube_core.dynamics.hypoid_torsional.time_sweep import settle_load

AGREE_AT = (0.3, 0.5, 0.65, 0.9, 1.0, 1.3)  # mesh over natural frequency
PERIODS = 100  # mesh periods after a disturbance
DISTURBANCE = 0.03  # of the peak-to-peak motion
SAMPLES = 256
TOLERANCE = 1e-9
START_AT, REVOLUTIONS, SETTLING, STEPS = (0.3, 0.65, 1.0), 40, 600, 256
_MOST_PERIODS = 12
_SAME = 0.01
# of RK45, looser to tighter
TOLERANCES = ((1e-3, 1e-6), (1e-4, 1e-7), (1e-5, 1e-8), (1e-6, 1e-9), (1e-7, 1e-10), (1e-9, 1e-12))
DURATION = 0.3  # s
DRIFT_AT = 0.5
Rows = list[list[str]]


def agreements(evidence: Evidence) -> Rows:
    """Return motions by continuation and by integration in time, on every stable branch."""
    pairs = {
        "shipped, 2-DOF": evidence.two,
        "shipped, 1-DOF": evidence.one,
        "0.2 % mismatch, 2-DOF": evidence.mismatched[0.002],
        "0.4 % mismatch, 2-DOF": evidence.mismatched[0.004],
    }
    return [
        _agreement(pair, relative, points, point)
        for pair, curve in pairs.items()
        for relative in AGREE_AT
        for points in (curve.points.get(relative, []),)
        for point in points
    ]


def _agreement(pair: str, relative: float, points: list[Point], point: Point) -> list[str]:
    name = "only" if len(points) == 1 else "lower" if point is points[0] else "upper"
    backlash = point.segment.problem.model.kernel_parameters.backlash
    x = integrated(point)
    share, swing = float(np.mean((x < 0.0) & (x > -backlash))), float(np.ptp(x))
    off = 100.0 * (point.peak_to_peak / swing - 1.0)
    sizes = (f"{MICRO * one:.3f}" for one in (point.peak_to_peak, swing))
    apart = f"{100.0 * point.separation_share:.1f} / {100.0 * share:.1f}"
    return [pair, name, f"{relative:g}", *sizes, f"{off:+.4f}", apart]


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


def linear_limit() -> Rows:
    """Compare with the exact response over 0.2 to 1.6: constant stiffness, 10 nm of error."""
    amplitude = 10e-9
    mesh = {"stiffness_harmonics": (), "error_harmonics": ((amplitude, 0.0),)}
    found = []
    for form in ("one_dof", "two_dof"):
        curve = Curve(respond(form, reconstructed(form=form, mesh=mesh, hold_gain=0.0), steps=128))
        model = curve.response.segments[0].problem.model
        m, k, c = model.equivalent_mass, model.stiffness, model.kernel_parameters.c
        w = curve.relative * math.sqrt(k / m)
        exact = amplitude * m * w**2 / abs(k - m * w**2 + 1j * c * w)
        off = np.abs([curve.up(r).harmonics[0] for r in curve.relative] / exact - 1.0)
        at = int(off.argmax())
        found.append([form.replace("_", " "), f"{off[at]:.1e}", f"{curve.relative[at]:.2f}"])
    return found


def starts() -> Rows:
    """Return the motions after the load has settled, from three places with x' = 0."""
    rows = []
    for relative in START_AT:
        for mismatch in MISMATCHES:
            model = HypoidTorsional(reconstructed(mismatch))
            places = (model.static_deflection, 0.0, -0.5 * model.kernel_parameters.backlash)
            found = (settled_from(model, relative, x) for x in places)
            sizes = (f"{MICRO * swing:.2f} ({periods or 'none'})" for swing, periods in found)
            rows.append([f"{relative:g}", f"{100.0 * mismatch:g}", *sizes])
    return rows


def settled_from(model: HypoidTorsional, relative: float, x: float) -> tuple[float, int]:
    """Return the peak-to-peak motion [m] and its mesh periods, 0 if it does not repeat in 12."""
    rows, p = model.rows(STEPS), model.kernel_parameters
    speed = model.pinion_speed(relative * model.natural_frequency)
    y = model.initial_state(speed)
    y[0] = MICRO * x
    work = np.zeros(MARCH_WORK)
    load = settle_load(y, REVOLUTIONS, model.mean_load_torque, speed, rows, p, work)
    record = np.zeros((_MOST_PERIODS * STEPS, N_RECORD))
    march(y, 0, SETTLING, load, speed, rows, p, record[:0], work)
    march(y, SETTLING, _MOST_PERIODS, load, speed, rows, p, record, work)
    periods = record[:, 1].reshape(_MOST_PERIODS, STEPS)
    swing = float(np.ptp(periods))
    for count in (1, 2, 3, 4, 6):
        if np.max(np.abs(periods[count:] - periods[:-count])) < _SAME * swing:
            return swing * UM, count
    return swing * UM, 0


def drifts() -> Rows:
    """Integrate the pair at half its natural frequency by RK45 with looser and tighter tolerances.

    Once with both angles as states, x their difference, and once with x in micrometres.
    """
    model = HypoidTorsional(reconstructed(radii="mean", hold_gain=0.0))
    speed = model.pinion_speed(DRIFT_AT * model.natural_frequency)
    load = model.mean_load_torque
    R_g = R_P0 * 36.0 / 13.0

    def difference(s: Array) -> Array:
        return np.asarray(R_P0 * s[0] - R_g * s[1] - E0 * np.cos(TEETH * s[0]))

    def absolute(_: float, s: Array) -> list[float]:
        r = model.pair_rates(float(difference(s)), s[2], s[3], s[0], load, speed)
        return [s[2], s[3], r.w_p, r.w_g]

    def relative(_: float, s: Array) -> list[float]:
        r = model.pair_rates(s[0] * UM, s[1], s[2], s[3], load, speed)
        return [r.x * MICRO, r.w_p, r.w_g, s[1]]

    y = model.initial_state(speed)
    angles = np.array([0.0, (-E0 - y[0] * UM) / R_g, y[1], y[2]])
    ways = ((absolute, angles, difference), (relative, y, lambda s: s[0] * UM))
    found = []
    for rtol, atol in TOLERANCES:
        for rates, start, read in ways:
            s = solve_ivp(rates, (0.0, DURATION), start, "RK45", rtol=rtol, atol=atol)
            found.append((float(np.ptp(read(s.y[:, s.t > 0.5 * DURATION]))), int(s.nfev)))
    exact = found[-1][0]
    cells = [[f"{MICRO * swing:.3f}", f"{swing / exact:.3f}", str(n)] for swing, n in found]
    return [
        [f"{rtol:.0e} / {atol:.0e}", *cells[2 * k], *cells[2 * k + 1]]
        for k, (rtol, atol) in enumerate(TOLERANCES)
    ]
