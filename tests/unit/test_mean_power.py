"""Mean powers over communication steps of any length."""

import numpy as np
import pytest

from tests.helpers.fmu_cases import CASES


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_a_step_too_short_for_a_mean_leaves_the_last_one(case):
    """A step of 1e-15 s changes no energy by what its rounding shows."""
    model = case.model(case.parameters())
    pinion, wheel = case.torques
    model.initialise(pinion_speed=150.0, pinion_torque=pinion, wheel_torque=wheel,
                     oil_temperature=333.15)  # fmt: skip
    powers = [name for name in model.output_names if "power_loss" in name or "efficiency" in name]

    def found() -> np.ndarray:
        assert np.isfinite(model.outputs).all()
        return np.array([model.output(name) for name in powers])

    at_start = found()
    for h in (1e-15, 5e-324, 2e-308):  # without a mean before: the present rates
        model.step(h, pinion, wheel, 333.15)
        assert found() == pytest.approx(at_start, rel=1e-6, abs=1e-9)  # W
    for _ in range(3):
        model.step(2.0**-10, pinion, wheel, 333.15)
    last = found()
    assert last[powers.index("efficiency")] > 0.9
    for h in (1e-15, 5e-324, 2e-308, 1e-12, 0.99e-7, *20 * (1e-10,)):
        model.step(h, pinion, wheel, 333.15)
        assert found() == pytest.approx(last, rel=1e-9)  # marks move with energies of 10 J
    model.step(1e-6, pinion, wheel, 333.15)
    # the largest is that of the bearings or the flanks at that moment, not in a mesh period
    assert found().max() == pytest.approx(last.max(), rel=0.5)
    assert not np.array_equal(found(), last)
