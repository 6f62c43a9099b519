"""Torques on the flanks of the other side: limits alone, with the rates of differences."""

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.flank_optimisation.held_model import (
    HYPOID_CELLS,
    CheckSettings,
    HeldModel,
    differences,
    plain_check,
)
from gearlube_core.flank_optimisation.problem import Problem
from gearlube_core.flank_optimisation.problem_file import Limits, OptimisationFile
from gearlube_core.flank_optimisation.search import Goal
from tests.helpers.loaded_cases import stiffness

TEETH = {"drive": stiffness(), "coast": stiffness(0.6e-9)}
CROWN, TILT = "pinion.coast_flank.lead_crown_um", "pinion.machine.tilt_angle_deg"
BOUNDS = {
    CROWN: {"low": 0.0, "high": 30.0, "start": 5.0},
    TILT: {"low": 31.0, "high": 32.5},
}


def problem(gear="mohammadpour_2015", bounds=BOUNDS, **limits):
    data = {"name": "p", "gear": gear, "torques_n_m": [50.0], "orders": [1], "positions": 6}
    return Problem.of(
        OptimisationFile.from_data({**data, "parameters": bounds, "limits": limits}, "p")
    )


GIVEN = problem(other_side_torques_n_m=[20.0], other_side_edge_share=0.2)


@pytest.fixture(scope="module")
def model():
    return HeldModel(GIVEN, TEETH, GIVEN.start)


@pytest.fixture(scope="module")
def here(model):
    return model.evaluate(GIVEN.start)


@pytest.mark.slow
def test_the_other_flanks_are_judged_as_the_plain_analysis_judges_them(here):
    settings = CheckSettings(positions=6, hypoid=HYPOID_CELLS)
    plain = plain_check(GIVEN, GIVEN.changed(GIVEN.start), TEETH, settings, jobs=1)
    assert here.rotation.shape == plain.rotation.shape == (1, 1, 6)
    # held cells are a quarter larger, and the highest of cells is taken
    assert here.other_pressure == pytest.approx(plain.other_pressure, rel=0.1)
    assert here.pressure == pytest.approx(plain.pressure, rel=0.1)
    # as a problem of its own on those flanks, with the teeth of that side
    alone = OptimisationFile.from_data(
        {
            **{"name": "p", "gear": "mohammadpour_2015", "side": "coast", "torques_n_m": [20.0]},
            **{"orders": [1], "positions": 6, "parameters": BOUNDS},
        },
        "p",
    )
    coast = HeldModel(Problem.of(alone), TEETH, GIVEN.start).evaluate(GIVEN.start)
    np.testing.assert_allclose(here.other_pressure, coast.pressure, rtol=1e-9)
    np.testing.assert_allclose(here.other_edge_share, coast.edge_share, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(here.other_pressure_rate, coast.pressure_rate, rtol=1e-9)


@pytest.mark.slow
def test_limits_of_the_other_flanks_have_the_rates_of_differences(model, here):
    limits = Limits(
        pressure=None,
        loss=None,
        sensitivity=None,
        other_side_torques_n_m=(20.0,),
        other_side_edge_share=0.2,
    )
    goal = Goal(before=here, orders=(1,), worst=False, limits=limits)
    steps = np.array([1e-4, 1e-6])
    ends = differences(model, GIVEN.start, steps)
    used, rates = goal.used(here)
    assert used.size == 6 + 6 + 6  # pressures, shares, and both ends of three of settings
    assert used[:6].max() == pytest.approx(1.0, rel=1e-12)
    for k, step in enumerate(steps):
        high, low = (goal.used(one)[0][:12] for one in ends[2 * k : 2 * k + 2])
        expected = (high - low) / (2.0 * step)
        # one cell of a hundred may change between the ends
        assert np.abs(rates[:12, k] - expected).max() < 0.01 * np.abs(expected).max()


def test_a_crown_of_the_other_flanks_changes_nothing_of_the_operating_ones(here):
    assert np.abs(here.other_pressure_rate[..., 0]).max() > 0.0
    for name in ("rotation", "pressure", "sliding", "edge_share", "force"):
        rates = getattr(here, f"{name}_rate")
        assert not rates[..., 0].any()
        assert rates[..., 1].any()


def test_what_does_not_fit_is_refused():
    crown = {"pinion.flank.crown_um": {"low": 0.0, "high": 9.0}}
    with pytest.raises(ParameterError, match="other_side_torques_n_m is only for a hypoid pair"):
        problem("he_2007", crown, other_side_torques_n_m=[20.0])
    with pytest.raises(ParameterError, match="puts load on the other flanks"):
        problem()
    with pytest.raises(ParameterError, match="needs other_side_torques_n_m"):
        problem(other_side_edge_share=0.2)
    with pytest.raises(ParameterError, match="other_side_torques_n_m must rise"):
        problem(other_side_torques_n_m=[20.0, 20.0])
