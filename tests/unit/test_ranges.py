"""Ranges that a model leaves, and mean powers of a step."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.dynamics.helical_model.model import HelicalPairModel
from gearlube_core.dynamics.hypoid_axle import HypoidAxle, mohammadpour_2015_axle
from gearlube_core.dynamics.ranges import (
    MAX_SPEED,
    RANGE_OUTPUTS,
    Range,
    left_ranges,
    range_limits,
    write_ranges,
)
from gearlube_core.errors import ParameterError, StepError
from gearlube_core.film.groups import (
    line_groups,
    line_moes_groups,
    point_contact_groups,
    point_moes_groups,
)
from gearlube_core.friction.evans_johnson_1986 import MAP_RANGE, plateau_stress_ratio
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.mesh_table.line_mesh_file import named_line_mesh
from tests.helpers.fmu_cases import CASES
from tests.helpers.helical_march_cases import he_march, march_of

HOT = 368.15  # K
RATIO = 36 / 13


def axle_at(torque: float, speed: float = 200.0, oil: float = HOT) -> HypoidAxle:
    axle = HypoidAxle(mohammadpour_2015_axle())
    axle.initialise(
        pinion_speed=speed, pinion_torque=torque, wheel_torque=RATIO * torque, oil_temperature=oil
    )
    return axle


def test_a_usual_operating_point_is_within_all_ranges():
    axle = axle_at(50.0)
    assert axle.output("range.exceeded") == 0.0
    assert axle.exceeded() == {}


def test_a_torque_beyond_the_table_is_named_with_value_limit_and_unit():
    axle = axle_at(450.0)
    assert int(axle.output("range.exceeded")) & 1
    # the force of the teeth times the mean arm: the arm varies by less than a per cent
    assert axle.output("range.torque") == pytest.approx(450.0, rel=1e-2)
    assert "should be within -400 to 400 N.m, got 451.5 N.m" in axle.exceeded()["range.torque"]


def test_coasting_beyond_the_table_is_a_negative_torque():
    # the arm of the force varies by less than a per cent
    assert axle_at(-450.0).output("range.torque") == pytest.approx(-450.0, rel=1e-2)


def test_the_torque_that_the_teeth_carry_counts_where_the_pinion_has_none():
    """The level of the table follows the pinion's torque, the force of the teeth does not."""
    axle = axle_at(0.0)
    largest = 0.0
    for _ in range(20):
        axle.step(1e-3, 0.0, -1.6e3, HOT)
        largest = max(largest, abs(axle.output("range.torque")))
    assert largest > 100.0  # the level is that of 0 N.m throughout


def test_films_under_heavy_load_and_hot_films_have_names():
    slow = axle_at(390.0, speed=20.0)
    assert list(slow.exceeded()) == ["range.film_load"]
    hot = axle_at(200.0, oil=313.15, speed=400.0)
    assert "range.temperature" in hot.exceeded()


@pytest.mark.slow
def test_load_outside_a_film_model_is_named():
    axle = HypoidAxle(replace(mohammadpour_2015_axle(), film="solved"))
    cold = 275.0  # K; its film heats more than those that were solved
    axle.initialise(
        pinion_speed=300.0, pinion_torque=20.0, wheel_torque=RATIO * 20.0, oil_temperature=cold
    )
    share = axle.output("film.share_outside")
    assert share > 0.05
    said = axle.exceeded()["film.share_outside"]
    assert "share of the flanks' load outside their film model should be within 0 to 0.05" in said
    assert f"got {share:.4g}" in said


def test_at_rest_no_film_formula_is_in_use():
    still = axle_at(50.0, speed=0.0)
    assert still.output("range.film_load") == still.output("range.film_material") == 0.0
    assert still.output("range.exceeded") == 0.0


def test_outputs_of_ranges_do_not_depend_on_the_path_to_the_state():
    axle = axle_at(450.0)
    axle.step(1e-3, 440.0, 1000.0, HOT)
    outputs, state = axle.outputs.copy(), axle.get_state()
    axle.step(1e-3, 100.0, 1000.0, HOT)
    axle.set_state(state)
    np.testing.assert_array_equal(axle.outputs, outputs)


@pytest.mark.parametrize("torque", [601.0, -601.0])
def test_a_torque_far_beyond_the_table_is_refused(torque):
    with pytest.raises(ParameterError, match=r"-600 to 600 N\.m, got .* mesh data end at -400 and"):
        axle_at(torque)


def test_a_line_mesh_has_an_end_and_one_stiffness_density_has_none():
    mesh = named_line_mesh("he_2007")
    tabled = march_of(HelicalGearFile.named("he_2007"), line_mesh=mesh)
    end = float(mesh.torque[-1])
    assert tabled.torque_range == (-end, end)
    assert he_march().torque_range == (-math.inf, math.inf)
    model = HelicalPairModel(tabled)
    with pytest.raises(ParameterError, match=r"pinion\.torque must be within"):
        model.initialise(
            pinion_speed=100.0, pinion_torque=1.6 * end, wheel_torque=0.0, oil_temperature=HOT
        )


@pytest.mark.parametrize("which", ["axle", "pair"])
def test_a_shaft_that_runs_away_is_refused_and_the_model_stays(which):
    """A wheel torque that drives: 1 ms is refused where 6e5 rad/s were integrated before."""
    if which == "axle":
        model, torques = axle_at(50.0), (600.0, -1600.0)
    else:
        model, torques = HelicalPairModel(he_march(friction="off")), (1e5, -1e5)
        model.initialise(
            pinion_speed=100.0, pinion_torque=50.0, wheel_torque=0.0, oil_temperature=HOT
        )
    reason = ""
    while not reason:
        before = model.get_state()
        try:
            model.step(1e-2, *torques, HOT)
        except StepError as error:
            reason = str(error)
    assert "a shaft turns faster than 5000 rad/s" in reason
    np.testing.assert_array_equal(model.get_state(), before)
    assert abs(model.output("pinion.speed")) <= MAX_SPEED


def test_the_sum_of_what_is_exceeded_names_the_ranges():
    ranges = tuple(Range(name, name, 1.0, 2.0, "1", "") for name in RANGE_OUTPUTS[1:])
    out = np.zeros(len(RANGE_OUTPUTS))
    # below, within, above, not in use, no number, on the limit
    write_ranges(0.5, 1.5, 3.0, 0.0, math.nan, 2.0, range_limits(ranges), 0, out)
    left = [one.output for one in left_ranges(ranges, out[0])]
    assert left == ["range.torque", "range.film_material", "range.temperature"]


def test_kernels_of_the_groups_equal_the_checked_functions():
    numbers = (0.02, 0.03, 1.7e-8, 4.0, 2300.0, 2.2e11)
    R, eta0, alpha, speed, load, modulus = numbers
    point = point_contact_groups(
        viscosity=eta0, pressure_viscosity=alpha, entrainment_speed=speed, load=load, radius=R,
        reduced_modulus=modulus,
    )  # fmt: skip
    line = line_groups(
        viscosity=eta0, pressure_viscosity=alpha, entrainment_speed=speed, line_load=load,
        radius=R, reduced_modulus=modulus,
    )  # fmt: skip
    assert point_moes_groups(*numbers) == pytest.approx((point.M, point.L), rel=1e-12)
    assert line_moes_groups(*numbers) == pytest.approx((line.M, line.L), rel=1e-12)


@pytest.mark.parametrize(("end", "low"), [(MAP_RANGE[0], 0.14), (MAP_RANGE[1], 0.054)])
def test_the_traction_formula_is_as_low_at_the_ends_of_its_range_as_it_says(end, low):
    """Exact maximum of a heated Eyring film: s sinh s = 4 X^2 exp(L), X^2 = 0.4392.

    The formula is the straight line 1.74 (ln 1.2 + L/2) through it.
    """
    s = end
    for _ in range(200):
        s = math.asinh(4.0 * 0.43923 * math.exp(end) / s) if end < 5 else (
            end + math.log(8.0 * 0.43923) - math.log(s)
        )  # fmt: skip
    # eta0, K, beta and tau0 h such that the logarithm alone gives L
    h = 1e-6
    formula = plateau_stress_ratio(h, 0.0, math.exp(end) * 1e-6, 0.0, 2.0, 1e3, 1.0, 0.0)
    assert formula == pytest.approx(1.74 * (math.log(1.2) + 0.5 * end), rel=1e-12)
    assert 1.0 - formula / s == pytest.approx(low, abs=5e-4)


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
