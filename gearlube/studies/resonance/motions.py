"""Periodic motions at chosen frequencies, and a Poincare section of transient motions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube.studies.resonance.response import Response
from gearlube.studies.resonance.settings import ResonanceSettings
from gearlube.studies.resonance.summary import rate_over_period
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import DE, R_G, R_P
from gearlube_core.dynamics.hypoid_torsional.mode_march import MARCH_WORK, N_RECORD, OK, march
from gearlube_core.dynamics.hypoid_torsional.period_problem import Orbit, PeriodProblem
from gearlube_core.dynamics.hypoid_torsional.rates import MICRO, UM
from gearlube_core.periodic import solve_periodic

ORBIT_STEPS = 256  # samples per mesh period
STROBES = 240  # mesh periods of the section


@dataclass(frozen=True, slots=True, kw_only=True)
class Motion:
    """One periodic motion.

    Parameters
    ----------
    model : str
        See `MODELS`.
    relative : float
        Mesh over natural frequency [-].
    stable : bool
    multiplier : float
        Largest modulus of the Floquet multipliers [-].
    problem : PeriodProblem
        `ORBIT_STEPS` steps per mesh period.
    unknowns : ndarray
        z of `problem`.
    orbit : Orbit
    rate : ndarray of shape (samples,)
        x' [m/s].
    """

    model: str
    relative: float
    stable: bool
    multiplier: float
    problem: PeriodProblem
    unknowns: Array
    orbit: Orbit
    rate: Array

    @property
    def peak_to_peak(self) -> float:
        """Of the dynamic transmission error [m]."""
        return float(np.ptp(self.orbit.x))


def motions_at(response: Response, settings: ResonanceSettings, relative: float) -> list[Motion]:
    """Return all motions found at a frequency of `settings.orbits_at`, smallest first."""
    found: list[Motion] = []
    for segment, row in response.motions(relative):
        problem = PeriodProblem(
            settings.parameters(response.model),
            periods=segment.problem.periods,
            steps_per_mesh_period=ORBIT_STEPS,
        )
        motion = motion_near(response.model, problem, segment.branch.unknowns[row], relative)
        if motion is not None:
            found.append(motion)
    return sorted(found, key=lambda motion: motion.peak_to_peak)


def motion_near(model: str, problem: PeriodProblem, start: Array, relative: float) -> Motion | None:
    """Return the periodic motion near a start, None where Newton's method does not find it."""
    pair = problem.model
    speed = pair.pinion_speed(relative * pair.natural_frequency)
    found = solve_periodic(problem.equations(), start, speed, throw=False)
    if not found.converged:
        return None
    orbit = problem.orbit(found.unknowns, speed)
    return Motion(
        model=model,
        relative=relative,
        stable=found.stable,
        multiplier=float(np.max(np.abs(found.multipliers))),
        problem=problem,
        unknowns=found.unknowns,
        orbit=orbit,
        rate=rate_over_period(orbit),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class PoincareSection:
    """Motions sampled once per mesh period, at mesh phase zero.

    Parameters
    ----------
    relative : float
        Mesh over natural frequency [-].
    x, rate : ndarray of shape (starts, STROBES + 1)
        Transmission error [m] and its rate [m/s]; NaN after a motion that is no longer finite.
    motions : list of Motion
        Periodic motions found by continuation at that frequency, stable and unstable.
    """

    relative: float
    x: Array
    rate: Array
    motions: list[Motion]


def richest_frequency(response: Response, settings: ResonanceSettings) -> float:
    """Return the middle one of the requested frequencies that have most motions."""
    counts = np.array([len(response.motions(value)) for value in settings.relative])
    most = settings.relative[counts == counts.max()]
    if counts.max() <= 1:
        return float(settings.relative[np.argmin(np.abs(settings.relative - 1.0))])
    return float(most[most.size // 2])


def poincare_section(
    response: Response, settings: ResonanceSettings, relative: float
) -> PoincareSection:
    """Return how motions from a grid of starting states approach periodic motions.

    Starts differ in the relative motion alone: each gets a transmission error and a rate of the
    mesh mode, without changing the momentum about the pinion.
    """
    problem = PeriodProblem(settings.parameters(response.model), steps_per_mesh_period=ORBIT_STEPS)
    pair, p = problem.model, problem.model.kernel_parameters
    rows = pair.rows(ORBIT_STEPS)
    speed = pair.pinion_speed(relative * pair.natural_frequency)
    starts = _starts(response, settings, relative, pair.natural_frequency)
    x = np.full((starts.shape[0], STROBES + 1), np.nan)
    rate = np.full_like(x, np.nan)
    nothing, work = np.zeros((0, N_RECORD)), np.zeros(MARCH_WORK)
    for number, (x_0, rate_0) in enumerate(starts):
        y = pair.initial_state(speed)
        y[0] = MICRO * x_0
        extra = rate_0 - _rate(y, rows, response.model, speed)
        if response.model == "one_dof":
            y[1] += extra
        else:
            y[1] += extra * p.m_eq * p.R_p0 / p.I_p
            y[2] -= extra * p.m_eq * p.R_g0 / p.I_g
        for strobe in range(STROBES + 1):
            x[number, strobe] = UM * y[0]
            rate[number, strobe] = _rate(y, rows, response.model, speed)
            if march(y, strobe, 1, pair.mean_load_torque, speed, rows, p, nothing, work) != OK:
                break
    return PoincareSection(
        relative=relative, x=x, rate=rate, motions=motions_at(response, settings, relative)
    )


def _rate(y: Array, rows: Array, model: str, speed: float) -> float:
    """Return x' [m/s] of a state at mesh phase zero."""
    if model == "one_dof":
        return float(y[1] - rows[0, DE] * speed)
    return float((rows[0, R_P] - rows[0, DE]) * y[1] - rows[0, R_G] * y[2])


def _starts(
    response: Response, settings: ResonanceSettings, relative: float, natural_frequency: float
) -> Array:
    """Return x [m] and x' [m/s] on two ellipses that hold all motions of the frequency, (n, 2)."""
    orbits = [segment.orbit(row).x for segment, row in response.motions(relative)]
    if not orbits:
        return np.zeros((0, 2))
    middle = float(np.mean(orbits[0]))
    reach = max(float(np.max(np.abs(x - middle))) for x in orbits)
    angle = 2.0 * np.pi * np.arange(settings.section_starts) / settings.section_starts
    size = reach * np.where(np.arange(settings.section_starts) % 2, 1.2, 0.6)
    pulse = 2.0 * np.pi * natural_frequency
    return np.column_stack([middle + size * np.cos(angle), size * pulse * np.sin(angle)])
