"""The march over a mesh period against its own refinement and against another integrator."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from gearlube_core.dynamics.helical_pair.linear.linear_system import RELATIVE
from gearlube_core.dynamics.helical_pair.linear.periodic_response import (
    ResponseSettings,
    harmonics,
    periodic_response,
)
from gearlube_core.dynamics.helical_pair.mesh.contact_points import N_COLUMNS, point_capacity
from tests.helpers.he_2007 import he_2007_pair
from tests.helpers.helical_dynamics_cases import SPEED, spur_pair, state_rates


@pytest.mark.parametrize("case", [he_2007_pair, spur_pair])
def test_periodic_response_converges_with_fourth_order(case: object) -> None:
    """Kinks of the helical mesh and jumps of the spur mesh cost no order: steps end there."""
    parameters = case(0.1)
    responses = [
        periodic_response(
            parameters, SPEED, ResponseSettings(samples=16, steps_per_oscillation=steps)
        ).displacement
        for steps in (40, 80, 160)
    ]
    swing = np.ptp(responses[-1], axis=0)
    moving = swing > 1e-12 * swing.max()
    coarse, fine = (
        np.abs(b - a).max(axis=0)[moving] / swing[moving] for a, b in pairwise(responses)
    )
    # factor 2^4; whole steps in each interval make it vary
    assert np.all((coarse / fine > 10.0) | (fine < 1e-10))
    assert fine.max() < 1e-5


def test_default_resolution_is_good_to_a_thousandth() -> None:
    default = periodic_response(he_2007_pair(0.1), SPEED)
    fine = periodic_response(
        he_2007_pair(0.1), SPEED, ResponseSettings(samples=1024, steps_per_oscillation=160)
    )
    for name in ("u_xp", "u_yp", "u_zg", "psi", "delta_x", "delta_y", "delta_z"):
        expected = harmonics(fine.signal(name))
        # of the largest harmonic
        error = np.abs(harmonics(default.signal(name)) - expected)
        assert error.max() < 1e-3 * expected.max()


@pytest.mark.slow
@pytest.mark.parametrize(("case", "mu"), [(he_2007_pair, 0.1), (spur_pair, 0.05)])
def test_marching_through_time_settles_on_the_periodic_response(case: object, mu: float) -> None:
    """All twelve coordinates, SciPy's DOP853, until transients of 0.07 a period are gone."""
    parameters = case(mu)
    response = periodic_response(
        parameters, SPEED, ResponseSettings(samples=64, steps_per_oscillation=80)
    )
    c, mesh, supports = (
        parameters.kernel_parameters(), parameters.mesh_arrays(), parameters.support_arrays(),
    )  # fmt: skip
    points, work = np.zeros((point_capacity(mesh), N_COLUMNS)), np.zeros((3, 12))
    period, periods = response.period, 8

    def rates(t: float, state: np.ndarray) -> np.ndarray:
        return state_rates(t / period, state, mu, c, mesh, supports, points, work)

    solution = solve_ivp(
        rates, (0.0, periods * period), np.zeros(24), method="DOP853", rtol=1e-8, atol=1e-13,
        t_eval=np.append(periods - 1 + response.phase, periods) * period, max_step=period / 60,
    )  # fmt: skip
    q = solution.y[:12, :-1].T
    psi = c.plane.r_bp * q[:, 5] + c.plane.r_bg * q[:, 11]
    marched = np.column_stack((np.delete(q, [5, 11], axis=1), psi))
    for column, name in enumerate(RELATIVE):
        expected = response.displacement[:, column]
        # transients 0.067^7 of the mean deflection, which exceeds the swing up to a thousandfold
        assert np.abs(marched[:, column] - expected).max() < 2e-3 * np.ptp(expected) + 1e-14, name
    # the pair as a whole is turned by friction: r_bp (J_zp + J_zg (r_bp/r_bg)^2)^-1 T t
    ratio = c.plane.r_bp / c.plane.r_bg
    inertia = c.J_zp + c.J_zg * ratio**2
    rigid = (c.J_zp * solution.y[17] - c.J_zg * ratio * solution.y[23]) / inertia
    # over one period of the steady state
    gained = (rigid[-1] - rigid[0]) / (solution.t[-1] - solution.t[0])
    assert gained == pytest.approx(response.friction_torque / inertia, rel=1e-3)
