"""The response over the pinion torque as a dataset."""

import numpy as np
import pytest

from gearlube.studies.resonance import run as load_response
from gearlube.studies.resonance.figures.catalogue import load_curves
from gearlube.studies.resonance.response import Response, follow_response
from gearlube.studies.resonance.settings import ResonanceSettings
from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.period_problem import PeriodProblem
from gearlube_core.periodic import solve_periodic

STEPS = 64


@pytest.fixture(scope="module")
def response():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(load_response, "SPAN", (0.9, 1.1))
        patch.setattr(load_response, "_STEPS", STEPS)
        return load_response.load_response(ResonanceSettings(), 0.5, {})


def test_every_variable_says_its_unit_and_meaning(response):
    for variable in response.data_vars.values():
        assert variable.attrs["units"]
        assert variable.attrs["long_name"]


def test_rows_span_the_torques_asked_for(response):
    for form in ("two_dof", "one_dof"):
        torque = response["torque"].sel(form=form, branch=0).dropna("row").values
        assert torque[0] == pytest.approx(55.0)
        assert torque[-1] == pytest.approx(45.0)


def test_amplitude_is_that_of_the_motion_at_the_same_speed_and_torque(response):
    parameters = ResonanceSettings(pinion_torque=55.0).parameters("two_dof")
    nominal = HypoidTorsional(ResonanceSettings().parameters("two_dof"))
    speed = nominal.pinion_speed(0.5 * nominal.natural_frequency)
    problem = PeriodProblem(parameters, steps_per_mesh_period=STEPS)
    motion = solve_periodic(problem.equations(), problem.initial_guess(speed), speed)
    expected = np.ptp(problem.orbit(motion.unknowns, speed).x)
    # both solved to 1e-9 of the deflection
    found = response["peak_to_peak"].sel(form="two_dof", branch=0).values[0]
    assert found == pytest.approx(expected, rel=1e-6)


def test_figure_shows_both_forms(response):
    upper, lower = load_curves(response).axes
    assert len(upper.get_legend().get_texts()) == 2
    assert lower.get_xlabel().endswith("[N·m]")


@pytest.mark.slow
def test_a_closed_branch_with_teeth_apart_is_found():
    """At 0.9 the branch that comes down from the highest torque never reaches it."""
    settings = ResonanceSettings(
        first=0.85, last=1.0, frequencies=2, load_at=0.9, steps_per_mesh_period=64
    )
    response = Response(model="two_dof")
    follow_response(response, settings, doubled=False)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(load_response, "_STEPS", 64)
        patch.setattr(load_response, "FORMS", ("two_dof",))
        load = load_response.load_response(settings, 0.9, {"two_dof": response})
    speed = sorted(np.ptp(segment.orbit(row).x) for segment, row in response.motions(0.9))
    at = np.abs(load["torque"].values - 50.0) < 1e-4
    found = load["peak_to_peak"].values[at]
    # three motions at 50 N.m: in contact, unstable, and 23.0 um with teeth apart
    assert speed == pytest.approx([6.00e-6, 21.56e-6, 23.03e-6], rel=5e-3)
    for swing in speed:
        assert np.min(np.abs(found - swing)) < 1e-4 * swing
    closed = load.sel(form="two_dof", branch=1).dropna("row", subset=["torque"])
    assert closed["torque"].values[0] == pytest.approx(closed["torque"].values[-1])
    assert closed["special_torque"].dropna("row").size == 2  # went around once
    assert load.sizes["branch"] == 2
