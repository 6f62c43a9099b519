"""What the axle refuses, in words, and that a refusal leaves it as it was."""

import copy
import math
import pickle

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_axle import (
    OUTPUT_INDEX,
    OUTPUT_NAMES,
    HypoidAxle,
    mohammadpour_2015_axle,
)
from gearlube_core.dynamics.hypoid_axle.state import W_P, X
from gearlube_core.errors import GearLubeError, ParameterError, StepError
from tests.helpers.axle_cases import OIL, axle_with, running_axle
from tests.helpers.each import each

START = {
    "pinion_speed": 145.0,
    "pinion_torque": 40.0,
    "wheel_torque": 106.0,
    "oil_temperature": OIL,
}


@pytest.fixture(scope="module")
def shared():
    return running_axle(60)


@pytest.fixture
def axle(shared):
    return shared[0]


@each(
    ("change", "message"),
    [
        ({"bearing_preload": -1.0}, r"bearing_preload must be .* got -1 N\. Preload cannot pull"),
        ({"bearing_preload": 2e5}, r"bearing_preload must be within 0 to 100000 N, got 200000 N"),
        ({"bearing_preload": math.nan}, "bearing_preload must be finite, got nan N"),
        ({"roughness_rms": 0.5}, r"roughness_rms must be .* got 0\.5 m\. 0\.5 um is 5e-7 m"),
        ({"roughness_rms": 0.0}, "roughness_rms must be within 1e-09 to 2e-05 m, got 0 m"),
        ({"backlash": 150.0}, r"backlash must be .* got 150 m\. 150 um is 1\.5e-4 m"),
        ({"backlash": -1e-6}, "backlash must be within 0 to 0.002 m, got -1e-06 m"),
        ({"modal_loss_factor": 1.5}, r"modal_loss_factor must be within 0 to 1, got 1\.5"),
        (
            {"mesh_damping": "modal", "modal_loss_factor": 0.0},
            r"modal_loss_factor must be above 0 .* Give about 0\.06",
        ),
        ({"steps_per_mesh_period": 4}, r"steps_per_mesh_period must be .* got 4\. Default 56"),
        ({"steps_per_highest_period": 7}, r"steps_per_highest_period .* got 7\. Default 17"),
        ({"steps_per_highest_period": math.inf}, "steps_per_highest_period must be finite"),
        ({"backlash": "wide"}, "backlash must be a number in m, got 'wide'"),
    ],
)
def test_a_parameter_out_of_range_says_what_limit_and_cure(change, message):
    with pytest.raises(ParameterError, match=message):
        axle_with(**change)


@each(
    ("option", "choices"),
    [
        ("equations", "consistent, as_printed"),
        ("radii", "consistent, paper, mean"),
        ("mesh_damping", "hysteretic, modal"),
        (
            "friction",
            "consistent, as_printed, off, printed_traction_circular, "
            "zhou_hoeprich_1991, arana_2019",
        ),
        ("bearing_approach", "full, as_printed"),
        (
            "bearing_torque_loss",
            "none, palmgren, zhou_hoeprich_1991, biboulet_houpert_2010, aihara_1987, "
            "palmgren_loaded, skf_2013, solved_films",
        ),
    ],
)
def test_an_unknown_option_is_refused_with_the_choices(option, choices):
    with pytest.raises(ParameterError, match=f"{option} must be one of {choices}; got 'magic'"):
        axle_with(**{option: "magic"})


def test_an_unknown_oil_is_refused_with_the_oils_there_are():
    with pytest.raises(ParameterError, match="karagiannis_2012, mohammadpour_2015; got 'salad'"):
        mohammadpour_2015_axle(oil="salad")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"pinion_torque": math.nan}, r"pinion\.torque must be finite, got nan N\.m"),
        ({"wheel_torque": math.inf}, r"wheel\.torque must be finite, got inf N\.m"),
        # 1.5 times the 400 N.m at which the table ends; at the wheel times the ratio of 36/13
        ({"pinion_torque": 601.0}, r"pinion\.torque must be within -600 to 600 N\.m, got 601 N\.m"),
        (
            {"wheel_torque": -2e3},
            r"wheel\.torque must be within -1661\.54 to 1661\.54 N\.m, got -2000",
        ),
        ({"oil_temperature": 500.0}, r"oil\.temperature must be within .* K, got 500 K.*363\.15 K"),
        ({"oil_temperature": 90.0}, r"oil\.temperature must be .* got 90 K.*90 degC is 363\.15 K"),
        ({"oil_temperature": math.nan}, r"oil\.temperature must be finite, got nan K"),
    ],
)
def test_a_bad_input_is_refused_by_name_at_the_start_and_in_a_step(axle, change, message):
    before, shown = axle.get_state(), axle.outputs.copy()
    with pytest.raises(ParameterError, match=message):
        axle.initialise(**{**START, **change})
    inputs = {key: value for key, value in START.items() if key != "pinion_speed"}
    with pytest.raises(ParameterError, match=message):
        axle.step(1e-4, **{**inputs, **change})
    np.testing.assert_array_equal(axle.get_state(), before)
    np.testing.assert_array_equal(axle.outputs, shown)


@pytest.mark.parametrize("speed", [math.nan, 6e3, -6e3])
def test_a_pinion_speed_beyond_any_car_is_refused(axle, speed):
    before = axle.get_state()
    with pytest.raises(ParameterError, match="pinion_speed must be"):
        axle.initialise(**{**START, "pinion_speed": speed})
    np.testing.assert_array_equal(axle.get_state(), before)


@pytest.mark.parametrize(
    ("h", "message"),
    [
        (0.0, "step size must be above 0 and at most 0.1 s, got 0 s"),
        (-1e-4, "step size must be above 0"),
        (0.2, r"at most 0\.1 s, got 0\.2 s\. A communication step of about 1e-4 s"),
        (1e9, "at most 0.1 s"),
    ],
)
def test_an_absurd_step_is_refused_and_the_axle_stays_as_it_was(axle, h, message):
    before, shown = axle.get_state(), axle.outputs.copy()
    with pytest.raises(StepError, match=message):
        axle.step(h, 40.0, 106.0, OIL)
    np.testing.assert_array_equal(axle.get_state(), before)
    np.testing.assert_array_equal(axle.outputs, shown)


@pytest.mark.parametrize("h", [math.nan, math.inf])
def test_a_step_that_is_no_number_is_refused(axle, h):
    before = axle.get_state()
    with pytest.raises(GearLubeError, match="step size must be finite"):
        axle.step(h, 40.0, 106.0, OIL)
    np.testing.assert_array_equal(axle.get_state(), before)


@each("copied", [copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))])
def test_a_copy_is_a_model_of_its_own_in_the_same_state(copied):
    model, *torques = running_axle(60)
    model.step(1e-4, *torques, OIL)
    other, state = copied(model), model.get_state()
    np.testing.assert_array_equal(other.outputs, model.outputs)
    other.step(1e-4, *torques, OIL)
    np.testing.assert_array_equal(model.get_state(), state)
    model.step(1e-4, *torques, OIL)
    np.testing.assert_array_equal(other.outputs, model.outputs)
    np.testing.assert_array_equal(other.get_state(), model.get_state())


def test_a_copy_before_the_start_starts_as_the_model_does():
    model = HypoidAxle(axle_with())
    other = copy.deepcopy(model)
    for one in (model, other):
        one.initialise(**START)
    np.testing.assert_array_equal(other.outputs, model.outputs)


def spoiled(axle, index, value):
    state = axle.get_state()
    state[index] = value
    return state


@pytest.mark.parametrize("longer", [-1, 1])
def test_a_state_of_the_wrong_length_is_refused(axle, longer):
    before = axle.get_state()
    wrong = np.resize(before, before.size + longer)
    with pytest.raises(
        StepError, match=rf"has {before.size} finite numbers, got shape \({wrong.size},\)"
    ):
        axle.set_state(wrong)
    np.testing.assert_array_equal(axle.get_state(), before)


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_a_state_that_is_not_finite_is_refused(axle, value):
    before = axle.get_state()
    with pytest.raises(StepError, match=f"finite numbers, .* {value} at place 3"):
        axle.set_state(spoiled(axle, 3, value))
    np.testing.assert_array_equal(axle.get_state(), before)


def test_a_step_that_blows_up_is_refused_and_can_be_retried():
    """Teeth 2 m apart are no axle: the step is refused, the same state goes on with a cure."""
    axle, *torques = running_axle(60)
    good = axle.get_state()
    axle.set_state(spoiled(axle, X, 2.0))
    broken, shown = axle.get_state(), axle.outputs.copy()
    with pytest.raises(StepError, match=r"step of 0\.0001 s refused: .* Reduce the torques"):
        axle.step(1e-4, *torques, OIL)
    np.testing.assert_array_equal(axle.get_state(), broken)
    np.testing.assert_array_equal(axle.outputs, shown)
    axle.set_state(good)
    axle.step(1e-4, *torques, OIL)
    assert np.all(np.isfinite(axle.outputs))


def test_a_speed_beyond_that_of_any_shaft_is_refused():
    axle, *torques = running_axle(60)
    axle.set_state(spoiled(axle, W_P, 1e7))
    broken = axle.get_state()
    with pytest.raises(StepError, match="faster than 5000 rad/s"):
        axle.step(0.1, *torques, OIL)
    np.testing.assert_array_equal(axle.get_state(), broken)


def test_after_a_refused_step_the_motion_goes_on_as_if_it_had_not_been_asked():
    refused, *torques = running_axle(60)
    smooth, *_ = running_axle(60)
    for _ in range(5):
        with pytest.raises(GearLubeError):
            refused.step(1e-4, math.nan, torques[1], OIL)
        with pytest.raises(GearLubeError):
            refused.step(5.0, *torques, OIL)
        refused.step(1e-4, *torques, OIL)
        smooth.step(1e-4, *torques, OIL)
    np.testing.assert_array_equal(refused.get_state(), smooth.get_state())
    np.testing.assert_array_equal(refused.outputs, smooth.outputs)


def test_outputs_have_one_name_each():
    assert len(set(OUTPUT_NAMES)) == len(OUTPUT_NAMES)
    assert [OUTPUT_INDEX[name] for name in OUTPUT_NAMES] == list(range(len(OUTPUT_NAMES)))


def test_outputs_and_state_view_cannot_be_written(axle):
    assert axle.outputs.shape == (len(OUTPUT_NAMES),)
    for array in (axle.outputs, axle.state_view):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0


def test_a_state_is_a_copy_that_the_axle_does_not_follow(axle):
    state = axle.get_state()
    kept = state.copy()
    state[:] = 0.0
    np.testing.assert_array_equal(axle.get_state(), kept)


def test_two_axles_of_one_parameter_set_share_nothing():
    parameters = mohammadpour_2015_axle()
    one, two = HypoidAxle(parameters), HypoidAxle(parameters)
    for axle in (one, two):
        axle.initialise(**START)
    before, shown = two.get_state(), two.outputs.copy()
    one.step(1e-3, 60.0, 106.0, OIL)
    np.testing.assert_array_equal(two.get_state(), before)
    np.testing.assert_array_equal(two.outputs, shown)
