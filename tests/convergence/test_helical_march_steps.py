"""The marched pair against its own refinement and against SciPy's DOP853."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from gearlube_core.dynamics.helical_model.outputs import STATE_NAMES
from tests.helpers.helical_march_cases import PERIOD, RATIO, TORQUE, he_march, history, started

PSI, PINION_WORK = (STATE_NAMES.index(name) for name in ("mesh.rotation", "energy.pinion_work"))
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


@pytest.mark.parametrize("friction", ["constant", "film"])
def test_result_depends_little_on_the_communication_step(friction: str) -> None:
    def run(h: float, turn: float) -> np.ndarray:
        model, rows = started(he_march(friction=friction)), []
        for k in range(round(0.04 / h)):
            sign = 1.0 if k * h < turn - 1e-9 else -0.7
            one = history(model, NAMES[:2], 1, h, sign * TORQUE)
            if (k + 1) % round(1e-3 / h) == 0:
                rows.append(one[0])
        return np.array(rows)

    # documented: 3e-4 of the value
    long, short = (run(h, 1.0) for h in (1e-3, 1e-4))
    assert np.max(np.abs(long / short - 1.0)) < 3e-4
    # teeth part and meet on the other side; documented as 6e-3 of the transmission error's swing.
    # The phase at which they meet decides: 5e-4 to 5.3e-3
    for turn in (0.010, 0.012, 0.013):
        long, short = (run(h, turn)[:, 0] for h in (1e-3, 1e-4))
        assert np.max(np.abs(long - short)) < 6e-3 * np.ptp(short)


def test_an_adaptive_integrator_finds_the_same_motion() -> None:
    model = started(he_march(friction_coefficient=0.05, steps_per_highest_period=400))
    start = model.get_state()
    begin = model.continuous
    duration = 1.5 * PERIOD
    history(model, NAMES, 20, duration / 20)
    marched_state = model.continuous
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
