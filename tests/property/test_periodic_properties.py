"""What any way of walking along a branch must agree on."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gearlube_core.periodic import ContinuationSettings, follow, solve_periodic
from tests.helpers.periodic_cases import Oscillator, oscillator_map, oscillator_problem

DUFFING = Oscillator(damping=0.06, cubic=0.05, force=0.12)
VALUES = np.linspace(0.7, 1.6, 10)


def duffing_branch(heading, **changes):
    start, p = (np.array([0.15, 0.0]), 0.5) if heading > 0 else (np.array([-0.05, 0.0]), 1.8)
    return follow(
        oscillator_problem(DUFFING, "frequency", scale=changes.pop("scale", 1.0)),
        start,
        p,
        limits=(0.5, 1.8),
        heading=heading,
        at=VALUES,
        settings=ContinuationSettings(**changes),
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    "changes", [{}, {"step": 0.01, "largest_step": 0.03}, {"turn": 0.05}, {"scale": 0.3}]
)
def test_branch_is_the_same_forward_back_and_with_other_steps_or_scales(changes):
    forward, back = duffing_branch(1.0), duffing_branch(-1.0, **changes)
    for value in VALUES:
        there, again = forward.at(value), back.at(value)[::-1]
        assert there.size in (1, 3)
        # 1e-9 on the unknowns; near folds their slope against p is below 100
        assert back.unknowns[again] == pytest.approx(forward.unknowns[there], abs=1e-7)
        assert (back.stable[again] == forward.stable[there]).all()
    folds = [[p.parameter for p in b.of_kind("fold")] for b in (forward, back)]
    assert folds[0] == pytest.approx(folds[1][::-1], abs=1e-8)


def test_rows_are_motions_and_their_multipliers_those_of_the_map():
    branch = duffing_branch(1.0)
    advance = oscillator_map(DUFFING, "frequency")
    for z, p, multipliers in zip(
        branch.unknowns, branch.parameter, branch.multipliers, strict=True
    ):
        end, monodromy, _ = advance(z, p)
        assert end == pytest.approx(z, abs=1e-7)
        assert np.sort_complex(multipliers) == pytest.approx(
            np.sort_complex(np.linalg.eigvals(monodromy).astype(complex)), abs=1e-6
        )
    assert (np.diff(branch.arclength) > 0.0).all()


@settings(max_examples=30)
@given(
    w=st.floats(0.4, 2.0),
    force=st.floats(0.05, 1.0),
    stop=st.floats(0.0, 10.0),
    x=st.floats(-1.0, 1.0),
    v=st.floats(-1.0, 1.0),
)
def test_map_of_the_cases_has_the_derivatives_of_its_differences(w, force, stop, x, v):
    # the tests lean on these derivatives; corners of the force leave single steps, hence 1e-3
    oscillator = Oscillator(damping=0.1, force=force, cubic=0.3, stop=stop, gap=0.2)
    advance = oscillator_map(oscillator, "frequency")
    z, e = np.array([x, v]), 1e-6
    _, monodromy, by_p = advance(z, w)
    for j, unit in enumerate(np.eye(2)):
        difference = (advance(z + e * unit, w)[0] - advance(z - e * unit, w)[0]) / (2 * e)
        assert monodromy[:, j] == pytest.approx(difference, abs=1e-3, rel=0.05 if stop else 1e-5)
    difference = (advance(z, w + e)[0] - advance(z, w - e)[0]) / (2 * e)
    assert by_p == pytest.approx(difference, abs=1e-3, rel=0.05 if stop else 1e-5)


def test_two_periods_square_the_multipliers():
    one = solve_periodic(oscillator_problem(DUFFING, "frequency"), np.array([0.2, 0.0]), 0.7)
    two = solve_periodic(
        oscillator_problem(DUFFING, "frequency", periods=2), np.array([0.2, 0.0]), 0.7
    )
    assert two.unknowns == pytest.approx(one.unknowns, abs=1e-8)
    assert np.sort_complex(two.multipliers) == pytest.approx(
        np.sort_complex(one.multipliers**2), abs=1e-8
    )
