"""Floquet multipliers of motions with teeth apart, against an adaptive integrator."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from gearlube.studies.resonance.settings import ResonanceSettings
from gearlube_core.dynamics.hypoid_torsional.parameters import karagiannis_2012_pair
from gearlube_core.dynamics.hypoid_torsional.period_problem import PeriodProblem
from gearlube_core.periodic import follow, solve_periodic
from tests.helpers.torsional_cases import reconstructed

SHIPPED = karagiannis_2012_pair()
LIMIT = 5e-4  # asked for: 1e-3; differences of the reference are good to 5e-5, with friction 3e-4
DRY, OILED = ResonanceSettings().steps_per_mesh_period, ResonanceSettings().lubricated_steps
# pair, mesh over natural frequency, rank by swing among the motions there (-1: the largest)
QUICK = {
    "shipped, upper": (SHIPPED, 0.9, -1),
    "1-DOF, unstable": (reconstructed(form="one_dof"), 0.93, 1),
}
TEN = QUICK | {
    "shipped, unstable": (SHIPPED, 0.9, 1),
    "shipped at resonance": (SHIPPED, 1.0, -1),
    "shipped, constant radii": (replace(SHIPPED, radii="mean"), 0.9, -1),
    "shipped, 1-DOF": (replace(SHIPPED, form="one_dof"), 0.9, -1),
    "shipped, lubricated": (replace(SHIPPED, friction="thermal_eyring"), 0.9, -1),
    "0.2 % mismatch at 0.65": (reconstructed(0.002), 0.65, -1),
    "0.2 % mismatch at 1.2": (reconstructed(0.002), 1.2, -1),
    "0.4 % mismatch at 0.8": (reconstructed(0.004), 0.8, -1),
}


def motion(parameters, ratio, rank, steps):
    """The problem, and a motion on the branch that comes down from above resonance."""
    problem = PeriodProblem(parameters, steps_per_mesh_period=steps)
    unit = problem.model.pinion_speed(problem.model.natural_frequency)
    top = 1.25 * unit
    branch = follow(
        problem.equations(), problem.initial_guess(top), top, limits=(ratio * unit, top),
        heading=-1.0,
    ) if rank == -1 else follow(
        problem.equations(), problem.initial_guess(top), top, limits=(0.8 * unit, top),
        heading=-1.0, at=[ratio * unit],
    )  # fmt: skip
    rows = branch.at(ratio * unit)
    swings = [np.ptp(problem.orbit(branch.unknowns[row], ratio * unit).x) for row in rows]
    row = rows[np.argsort(swings)[rank]]
    found = solve_periodic(problem.equations(), branch.unknowns[row], ratio * unit)
    assert problem.orbit(found.unknowns, ratio * unit).separation_share > 0.05
    return problem, found


def reference_multipliers(problem, found):
    """Multipliers of the period map that DOP853 gives at rtol 1e-11, by central differences."""
    model, speed = problem.model, found.parameter
    one = problem.size == 2
    y, load = problem.state(found.unknowns, speed)
    m = 2 if one else 3

    def slope(phi, s):
        if one:
            r = model.reduced_rates(s[0] * 1e-6, s[1], phi, speed)
            return np.array([r.x * 1e6, r.v]) / speed
        r = model.pair_rates(s[0] * 1e-6, s[1], s[2], phi, load, speed)
        return np.array([r.x * 1e6, r.w_p, r.w_g]) / s[1]

    def end(start):
        period = 2.0 * np.pi / 13
        s = solve_ivp(slope, (0.0, period), start, method="DOP853", rtol=1e-11, atol=1e-11)
        return s.y[:, -1]

    monodromy = np.empty((m, m))
    for j in range(m):
        h = np.zeros(m)
        h[j] = 2e-4 * problem.scales[j]  # DOP853 across kinks is exact to 1e-9 of the swing
        monodromy[:, j] = (end(y[:m] + h) - end(y[:m] - h)) / (2.0 * h[j])
    return np.linalg.eigvals(monodromy)


def distance(found, expected):
    """Largest distance of a multiplier to the nearest of the other set."""
    apart = np.abs(np.asarray(found)[:, None] - expected[None, :])
    return max(apart.min(axis=0).max(), apart.min(axis=1).max())


@pytest.mark.parametrize("case", QUICK)
def test_multipliers_are_those_of_an_adaptive_integrator(case):
    problem, found = motion(*QUICK[case], DRY)
    assert distance(found.multipliers, reference_multipliers(problem, found)) < LIMIT


@pytest.mark.slow
@pytest.mark.parametrize("case", TEN)
def test_ten_motions_with_teeth_apart(case):
    parameters, ratio, rank = TEN[case]
    problem, found = motion(parameters, ratio, rank, OILED if "lubricated" in case else DRY)
    off = distance(found.multipliers, reference_multipliers(problem, found))
    assert off < LIMIT, found.multipliers
