"""Branches whose folds, crossings and bifurcations have closed forms."""

import math

import numpy as np
import pytest

from gearlube_core.periodic import PeriodicProblem, follow, switch_branch
from tests.helpers.each import each
from tests.helpers.periodic_cases import (
    delayed_logistic_map,
    logistic_map,
    map_problem,
    normal_form,
)

# asked for in the search: 1e-7 of arclength; at a fold p is flat, elsewhere its slope is below 1
PLACE = 1e-6


def kinds(branch):
    return [point.kind for point in branch.special]


def test_cubic_hysteresis_has_its_two_folds_and_an_unstable_middle():
    problem = normal_form(lambda z, p: p + z - z**3, lambda z, p: 1 - 3 * z * z, lambda z, p: 1.0)
    branch = follow(problem, np.array([-1.3]), -1.0, limits=(-1.0, 1.0))
    assert kinds(branch) == ["fold", "fold"]
    at = 1.0 / math.sqrt(3.0)
    assert [p.unknowns[0] for p in branch.special] == pytest.approx([-at, at], abs=PLACE)
    assert [p.parameter for p in branch.special] == pytest.approx(
        [2 * at / 3, -2 * at / 3], abs=PLACE
    )
    assert [stable for _, stable in branch.runs()] == [True, False, True]
    assert branch.ending == "parameter limit"
    assert branch.parameter[-1] == 1.0
    z, p = branch.unknowns[:, 0], branch.parameter
    assert z**3 - z == pytest.approx(p, abs=1e-8)  # tolerance 1e-9 on z, slope below 5


def test_cusp_passes_from_one_curve_to_hysteresis_as_its_second_parameter_grows():
    # p + a z - z^3: folds at p^2 = 4 a^3/27, none for a <= 0
    for a, expected in ((-0.2, []), (0.05, [2 * (0.05 / 3) ** 1.5, -2 * (0.05 / 3) ** 1.5])):
        problem = normal_form(
            lambda z, p, a=a: p + a * z - z**3, lambda z, p, a=a: a - 3 * z * z, lambda z, p: 1.0
        )
        branch = follow(problem, np.array([-1.0]), -1.0, limits=(-1.0, 1.0))
        assert [p.parameter for p in branch.of_kind("fold")] == pytest.approx(expected, abs=PLACE)


def test_pitchfork_arms_leave_the_branch_point_as_the_square_root():
    problem = normal_form(lambda z, p: p * z - z**3, lambda z, p: p - 3 * z * z, lambda z, p: z)
    trunk = follow(problem, np.zeros(1), -0.53, limits=(-0.53, 1.0))
    (point,) = trunk.special
    assert point.kind == "branch point"
    assert point.parameter == pytest.approx(0.0, abs=PLACE)
    for step in (0.1, -0.1):
        start = switch_branch(problem, point, step=step)
        arm = follow(
            problem, start.unknowns, start.parameter, limits=(-0.5, 1.0), heading=start.heading
        )
        assert arm.parameter[-1] == 1.0
        assert arm.unknowns[:, 0] ** 2 == pytest.approx(arm.parameter, abs=1e-8)
        assert np.sign(arm.unknowns[-1, 0]) == np.sign(step)
        assert arm.stable.all()
    # along the arms p has its least value at the branch point: no fold beside it
    whole = follow(problem, np.array([-0.7]), 0.49, limits=(-0.5, 0.5), heading=-1.0)
    assert kinds(whole) == ["branch point"]
    assert whole.unknowns[-1, 0] == pytest.approx(math.sqrt(0.5), abs=1e-8)


def test_transcritical_branches_exchange_stability_where_they_cross():
    problem = normal_form(lambda z, p: p * z - z * z, lambda z, p: p - 2 * z, lambda z, p: z)
    trunk = follow(problem, np.zeros(1), -0.47, limits=(-0.47, 1.0))
    assert kinds(trunk) == ["branch point"]
    assert [stable for _, stable in trunk.runs()] == [True, False]
    start = switch_branch(problem, trunk.special[0])
    assert start.unknowns[0] == pytest.approx(start.parameter, abs=1e-8)


def test_isola_is_followed_once_around():
    problem = normal_form(
        lambda z, p: z * z + 4 * p * p - 1, lambda z, p: 2 * z, lambda z, p: 8 * p
    )
    branch = follow(problem, np.ones(1), 0.0, limits=(-2.0, 2.0))
    assert branch.ending == "closed"
    assert [p.parameter for p in branch.special] == pytest.approx([0.5, -0.5], abs=PLACE)
    assert branch.unknowns[-1, 0] == pytest.approx(1.0, abs=1e-8)
    # perimeter 4.8442 of the ellipse; chords of 0.15 rad fall short by 0.15^2/24 = 0.1 %
    assert branch.arclength[-1] == pytest.approx(4.8442, rel=0.004)


def test_logistic_map_doubles_at_3_and_again_at_1_plus_root_6():
    single = follow(map_problem(logistic_map, 1), np.array([0.5]), 2.03, limits=(2.0, 3.6))
    (first,) = single.special
    assert first.kind == "period doubling"
    assert first.parameter == pytest.approx(3.0, abs=PLACE)
    assert [stable for _, stable in single.runs()] == [True, False]
    doubled = map_problem(logistic_map, 1, periods=2)
    start = switch_branch(doubled, first)
    branch = follow(
        doubled, start.unknowns, start.parameter, limits=(2.5, 3.6), heading=start.heading
    )
    p, z = branch.parameter, branch.unknowns[:, 0]
    cycle = (p + 1 + np.sqrt((p - 3) * (p + 1))) / (2 * p)
    assert z == pytest.approx(cycle, abs=1e-7)  # steep at p = 3, where the start is not
    (second,) = branch.special
    assert second.kind == "period doubling"
    assert second.parameter == pytest.approx(1 + math.sqrt(6.0), abs=PLACE)


def test_delayed_logistic_map_starts_to_turn_at_2_by_60_degrees():
    # fixed point 1 - 1/p, characteristic equation mu^2 - mu + (p - 1) = 0
    branch = follow(map_problem(delayed_logistic_map, 2), np.full(2, 0.4), 1.6, limits=(1.6, 2.5))
    (point,) = branch.special
    assert point.kind == "Neimark-Sacker"
    assert point.parameter == pytest.approx(2.0, abs=PLACE)
    assert np.abs(np.angle(branch.multipliers[point.index])) == pytest.approx(
        [math.pi / 3] * 2, abs=1e-6
    )
    assert [stable for _, stable in branch.runs()] == [True, False]


def test_prescribed_speed_walks_past_the_folds_of_a_prescribed_load_and_tells_the_exchange():
    # z' = z - z^3/3 + c with z = p prescribed and the load c an unknown: single-valued in p, but
    # at a fixed load the slope 1 - z^2 changes sign at z = -1 and 1
    def residual(unknowns, p):
        z, c = unknowns
        slope = 1 - z * z
        return (
            np.array([z - z**3 / 3 + c, z - p]),
            np.array([[slope, 1.0], [1.0, 0.0]]),
            np.array([0.0, -1.0]),
            np.array([[math.exp(slope)]]),
        )

    problem = PeriodicProblem(residual=residual, unknown_scale=np.ones(2), parameter_scale=1.0)
    branch = follow(problem, np.array([-2.0, 0.0]), -2.0, limits=(-2.0, 2.0))
    assert kinds(branch) == ["exchange", "exchange"]
    assert [p.parameter for p in branch.special] == pytest.approx([-1.0, 1.0], abs=PLACE)
    assert [stable for _, stable in branch.runs()] == [True, False, True]


@each("way", [1.0, -1.0])
@each(("slope", "size"), [(0.3, 1.0), (1.0, 1.0), (3.0, 1.0), (3.0, 0.1)])
def test_corner_of_a_piecewise_linear_branch_is_passed(slope, size, way):
    # way p = slope z up to the corner at 0, then -slope z: blunter and sharper than a right angle;
    # the size of the equation does not matter
    problem = normal_form(
        lambda z, p: size * (way * p + slope * abs(z)),
        lambda z, p: size * math.copysign(slope, z),
        lambda z, p: size * way,
    )
    limits = sorted([-2.0 * way, way])
    start = -0.5 * way * slope
    branch = follow(problem, np.array([-0.5]), start, limits=limits, heading=way)
    assert branch.ending == "parameter limit"
    assert branch.unknowns[-1, 0] == pytest.approx(2.0 / slope, abs=1e-8)
    places = -slope * np.abs(branch.unknowns[:, 0])
    assert way * branch.parameter == pytest.approx(places, abs=1e-8)
    # steps shrink to it
    assert np.max(way * branch.parameter) == pytest.approx(0.0, abs=slope * 1e-2)
