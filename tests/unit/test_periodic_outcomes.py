"""How a search for periodic motions ends when it cannot go on, and what it refuses."""

import numpy as np
import pytest

from gearlube_core.errors import ConvergenceError, ParameterError
from gearlube_core.periodic import (
    ContinuationSettings,
    NewtonSettings,
    PeriodicProblem,
    fixed_point_residual,
    floquet_multipliers,
    follow,
    solve_periodic,
    stability_margin,
    switch_branch,
)
from tests.helpers.each import each
from tests.helpers.periodic_cases import (
    Oscillator,
    acceleration,
    logistic_map,
    map_problem,
    normal_form,
    oscillator_problem,
)

PARABOLA = normal_form(lambda z, p: p - z * z, lambda z, p: -2 * z, lambda z, p: 1.0)
LINE = normal_form(lambda z, p: p - z, lambda z, p: -1.0, lambda z, p: 1.0)


def test_no_motion_beyond_the_fold_is_an_error_or_a_status():
    with pytest.raises(ConvergenceError, match="at parameter -1"):
        solve_periodic(PARABOLA, np.array([1.3]), -1.0)
    motion = solve_periodic(PARABOLA, np.array([1.3]), -1.0, throw=False)
    assert not motion.converged
    assert 1.0 <= motion.residual < 2.7  # 1 + z^2 from z = 1.3
    assert motion.evaluations > motion.iterations


def test_iteration_limit_and_singular_derivative_are_told_apart():
    few = NewtonSettings(max_iterations=1)
    assert solve_periodic(PARABOLA, np.array([9.0]), 1.0, settings=few, throw=False).status == (
        "iteration limit"
    )
    assert solve_periodic(PARABOLA, np.zeros(1), 1.0, throw=False).status == "singular Jacobian"


def test_step_into_a_region_where_the_map_fails_is_shortened():
    def root(z, p):
        with np.errstate(invalid="ignore", divide="ignore"):
            value = np.log(z) - p
        return value, np.array([[1.0 / z[0]]]), -np.ones(1), np.zeros((0, 0))

    problem = PeriodicProblem(residual=root, unknown_scale=np.ones(1), parameter_scale=1.0)
    motion = solve_periodic(problem, np.array([8.0]), 0.0)  # the full step ends below zero
    assert motion.unknowns[0] == pytest.approx(1.0, abs=1e-9)
    assert motion.stable  # nothing to disturb
    outside = solve_periodic(problem, np.array([-1.0]), 0.0, throw=False)
    assert outside.status == "map not finite at the start"


def test_damping_reaches_the_root_where_full_steps_diverge():
    problem = normal_form(
        lambda z, p: p - np.arctan(z), lambda z, p: -1 / (1 + z * z), lambda z, p: 1.0
    )
    motion = solve_periodic(problem, np.array([3.0]), 0.0)  # full steps diverge from above 1.392
    assert motion.unknowns[0] == pytest.approx(0.0, abs=1e-9)


def test_interrupted_branch_is_handed_back():
    seen = []

    def progress(count, parameter):
        seen.append(parameter)
        if count >= 5:
            raise KeyboardInterrupt

    branch = follow(LINE, np.zeros(1), 0.0, limits=(0.0, 1e3), progress=progress)
    assert branch.ending == "interrupted"
    assert branch.parameter[1:].tolist() == seen
    assert branch.parameter.size == 5


def test_point_limit_ends_a_branch():
    branch = follow(
        LINE, np.zeros(1), 0.0, limits=(0.0, 1e3), settings=ContinuationSettings(max_points=7)
    )
    assert branch.ending == "point limit"
    assert branch.parameter.size == 7


def test_branch_that_stops_existing_ends_with_a_step_limit():
    def until_one(z, p):
        r = np.array([p - z[0] if p <= 1.0 else np.nan])
        return r, np.array([[-1.0]]), np.ones(1), np.zeros((0, 0))

    problem = PeriodicProblem(residual=until_one, unknown_scale=np.ones(1), parameter_scale=1.0)
    branch = follow(problem, np.zeros(1), 0.0, limits=(0.0, 2.0))
    assert branch.ending == "step limit"
    assert branch.parameter[-1] == pytest.approx(1.0, abs=1e-4)  # smallest step 1e-5


def test_start_on_a_limit_and_outward_is_a_branch_of_one_row():
    branch = follow(LINE, np.ones(1), 1.0, limits=(0.0, 1.0))
    assert branch.ending == "parameter limit"
    assert branch.parameter.tolist() == [1.0]
    assert branch.runs() == [(slice(0, 1), True)]


def test_rows_at_wanted_values_lie_on_every_pass():
    branch = follow(PARABOLA, np.ones(1), 1.0, limits=(-1.0, 1.0), heading=-1.0, at=[0.16, 0.49])
    assert branch.unknowns[branch.at(0.49), 0] == pytest.approx([0.7, -0.7], abs=1e-8)
    assert branch.unknowns[branch.at(0.16), 0] == pytest.approx([0.4, -0.4], abs=1e-8)
    assert branch.at(-0.5).size == 0


def test_scales_leave_the_answer_alone():
    z, p = 3e-6, 450.0
    problem = PeriodicProblem(
        residual=lambda unknowns, parameter: (
            np.array([parameter / p - (unknowns[0] / z) ** 2]) * 1e9,
            np.array([[-2.0 * unknowns[0] / z**2]]) * 1e9,
            np.array([1e9 / p]),
            np.zeros((0, 0)),
        ),
        unknown_scale=np.array([z]),
        parameter_scale=p,
        residual_scale=np.array([1e9]),
    )
    branch = follow(problem, np.array([z]), p, limits=(-p, p), heading=-1.0)
    assert branch.special[0].parameter == pytest.approx(0.0, abs=1e-7 * p)
    assert branch.unknowns[-1, 0] == pytest.approx(-z, rel=1e-8)


def test_multipliers_are_sorted_judged_and_freed_of_trivial_ones():
    monodromy = np.diag([0.5, 1.0 + 1e-9, -1.2])
    assert floquet_multipliers(monodromy, trivial=1).real.tolist() == [-1.2, 0.5]
    assert stability_margin(floquet_multipliers(monodromy, trivial=1)) == pytest.approx(-0.2)
    assert stability_margin(floquet_multipliers(np.zeros((0, 0)))) == 1.0


def test_switching_at_a_doubling_asks_for_two_periods():
    problem = map_problem(logistic_map, 1)
    branch = follow(problem, np.array([0.5]), 2.03, limits=(2.0, 3.6))
    with pytest.raises(ParameterError, match="two periods"):
        switch_branch(problem, branch.special[0])


def stated(unknown_scale, parameter_scale, **others):
    return PeriodicProblem(
        residual=PARABOLA.residual,
        unknown_scale=unknown_scale,
        parameter_scale=parameter_scale,
        **others,
    )


@each(
    ("build", "message"),
    [
        (lambda: stated(np.zeros(1), 1.0), "above zero"),
        (lambda: stated(np.ones(1), 0.0), "parameter_scale"),
        (lambda: stated(np.ones(1), 1.0, residual_scale=np.ones(2)), "one entry an unknown"),
        (lambda: stated(np.ones(1), 1.0, trivial_multipliers=-1), "0 or more"),
        (lambda: solve_periodic(PARABOLA, np.ones(2), 0.0), "1 finite numbers"),
        (lambda: solve_periodic(PARABOLA, np.array([np.nan]), 0.0), "1 finite numbers"),
        (lambda: follow(PARABOLA, np.ones(1), 1.0, limits=(1.0, 0.0)), "must rise"),
        (lambda: follow(PARABOLA, np.ones(1), 2.0, limits=(0.0, 1.0)), "within 0 to 1"),
        (lambda: follow(PARABOLA, np.ones(1), 1.0, limits=(0.0, 1.0), heading=0.0), "heading"),
        (lambda: ContinuationSettings(step=0.5, largest_step=0.1), "step"),
        (lambda: NewtonSettings(max_iterations=0), "max_iterations"),
        (lambda: fixed_point_residual(logistic_map, periods=0), "periods"),
        (lambda: floquet_multipliers(np.ones((2, 3))), "square"),
        (lambda: floquet_multipliers(np.ones((1, 1)), trivial=2), "at most"),
    ],
)  # fmt: skip
def test_malformed_input_is_refused_with_its_name(build, message):
    with pytest.raises(ParameterError, match=message):
        build()


def test_case_kernel_equals_its_python_source():
    o = Oscillator(damping=0.1, force=0.3, cubic=0.2, stop=4.0, gap=0.1, parametric=0.2)
    for x in (-0.4, 0.3):
        assert acceleration(x, 0.2, 0.7, o) == acceleration.py_func(x, 0.2, 0.7, o)
    assert oscillator_problem(o, "frequency").count == 2
