"""Claim 14: a ratio mismatch of the radii is a transmission error."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from docs.resonance.cases import MISMATCHES, R_P0, TEETH, equivalent_error, reconstructed
from gearlube_core.dynamics.hypoid_torsional.parameters import HypoidTorsionalParameters
from gearlube_core.dynamics.hypoid_torsional.period_problem import Orbit, PeriodProblem
from gearlube_core.periodic import solve_periodic

RATIOS = (0.3, 0.5, 0.65, 1.0)


@dataclass(frozen=True, slots=True)
class DoubleCount:
    """Peak-to-peak transmission errors [m] of one pair told in three ways."""

    mismatch: float
    relative: float
    error: float  # R_p0 d/z [m]
    radii: float
    error_in_two_dof: float
    error_in_one_dof: float


def swing(parameters: HypoidTorsionalParameters, relative: float) -> float:
    """Return the peak-to-peak motion that static deflection leads to [m], NaN if none is found."""
    orbit = settled(parameters, relative)
    return float(np.ptp(orbit.x)) if orbit is not None else float("nan")


def apart(parameters: HypoidTorsionalParameters, relative: float) -> float:
    """Return the share of the period without contact of that motion, NaN if none is found."""
    orbit = settled(parameters, relative)
    return orbit.separation_share if orbit is not None else float("nan")


def settled(parameters: HypoidTorsionalParameters, relative: float) -> Orbit | None:
    """Return the stable periodic motion that Newton's method finds from static deflection."""
    problem = PeriodProblem(parameters, steps_per_mesh_period=256)
    model = problem.model
    speed = model.pinion_speed(relative * model.natural_frequency)
    start = problem.initial_guess(speed)
    found = solve_periodic(problem.equations(), start, speed, throw=False)
    if not (found.converged and found.stable):
        return None
    return problem.orbit(found.unknowns, speed)


def double_counts() -> list[DoubleCount]:
    """Return the comparison for all mismatches but none and the frequencies `RATIOS`."""
    found = []
    for d in MISMATCHES[1:]:
        error = equivalent_error(d)
        for relative in RATIOS:
            found.append(
                DoubleCount(
                    d,
                    relative,
                    R_P0 * d / TEETH,
                    swing(reconstructed(d), relative),
                    swing(reconstructed(radii="mean", mesh=error), relative),
                    swing(reconstructed(form="one_dof", mesh=error), relative),
                )
            )
    return found
