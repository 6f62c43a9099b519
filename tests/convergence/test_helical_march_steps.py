"""The marched pair against its own refinement and against SciPy's DOP853."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from gearlube_core.dynamics.helical_pair.march.state import N_ODE, PINION_WORK, PSI
from tests.helpers.helical_march_cases import PERIOD, RATIO, TORQUE, he_march, history, started

NAMES = ["mesh.dte", "mesh.load", "pinion.displacement.y", "pinion.tilt.x", "bearing[1].force.x"]


def marched(steps: int, **settings: object) -> np.ndarray:
    parameters = he_march(steps_per_highest_period=steps, **settings)
    return history(started(parameters), NAMES, 40, PERIOD / 4)


def test_finer_steps_change_less_and_less() -> None:
    fine = marched(256)
    swing = np.ptp(fine, axis=0)
    errors = np.array([np.abs(marched(n) - fine).max(axis=0) / swing for n in (8, 16, 32, 64)])
    # second order at the kinks where lines enter and leave, first order at the 1e-4 of the torque
    # that enters and leaves with them
    assert (errors[-1] < 0.3 * errors[0]).all()
    # the default: a thousandth of the transmission error's swing, a hundredth of forces and tilt
    assert errors[0, 0] < 1e-3
    assert errors[0].max() < 2e-2


def test_an_adaptive_integrator_finds_the_same_motion() -> None:
    model = started(he_march(friction_coefficient=0.05, steps_per_highest_period=400))
    start = model.get_state()
    begin = model.state_view[:N_ODE].copy()
    duration = 1.5 * PERIOD
    history(model, NAMES, 20, duration / 20)
    marched_state = model.state_view[:N_ODE].copy()
    model.set_state(start)
    solution = solve_ivp(
        lambda t, y: model.derivative(y), (0.0, duration), begin, method="DOP853", rtol=1e-10,
        atol=1e-15, max_step=2e-6,
    )  # fmt: skip
    found = solution.y[:, -1]
    travel = np.abs(solution.y - begin[:, None]).max(axis=1)
    # both step over the kinks of the mesh; the adaptive one far more finely
    np.testing.assert_allclose(marched_state[:PINION_WORK], found[:PINION_WORK], rtol=0.0,
                               atol=1e-4 * travel[:PINION_WORK].max())  # fmt: skip
    assert marched_state[PSI] == pytest.approx(found[PSI], abs=1e-4 * travel[PSI])
    assert TORQUE * RATIO > 0.0
