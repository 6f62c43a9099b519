"""Designs: combinations in order, samples that fill their ranges."""

import math

import numpy as np
import pytest

from gearlube.variation.design import Axis, Design, Sampling, Spread
from gearlube_core.errors import ParameterError
from tests.helpers.each import each

A, B = Axis("a", (1.0, 2.0)), Axis("b", ("x", "y", "z"))
U = Spread(key="u", low=-1.0, high=3.0)
N = Spread(key="n", low=-math.inf, high=math.inf, mean=5.0, deviation=2.0)


def test_every_combination_comes_once_with_the_last_axis_first_to_change():
    points = [Design(axes=(A, B)).point(i) for i in range(6)]
    assert [(p["a"], p["b"]) for p in points] == [
        (1.0, "x"), (1.0, "y"), (1.0, "z"), (2.0, "x"), (2.0, "y"), (2.0, "z"),
    ]  # fmt: skip


def test_a_column_is_what_the_points_say():
    design = Design(axes=(A, B), spreads=(U, N), sampling=Sampling("lhs", 5))
    points = [design.point(i) for i in range(design.size)]
    assert design.size == 30
    for key in ("a", "u", "n"):
        assert design.column(key).tolist() == [point[key] for point in points]
    assert [B.values[i] for i in design.column("b")] == [point["b"] for point in points]


def test_every_combination_has_the_same_samples():
    design = Design(axes=(A,), spreads=(U,), sampling=Sampling("random", 7))
    column = design.column("u")
    assert column[:7].tolist() == column[7:].tolist()


@pytest.mark.parametrize("method", ["lhs", "sobol"])
def test_each_sixteenth_of_a_range_has_one_of_sixteen_samples(method):
    design = Design(spreads=(U, N), sampling=Sampling(method, 16))
    cells = np.floor((design.column("u") + 1.0) / 4.0 * 16.0)
    assert sorted(cells) == list(range(16))


def test_a_normal_spread_has_its_mean_and_deviation():
    found = Design(spreads=(N,), sampling=Sampling("sobol", 4096)).column("n")
    # 4096 samples, one in each of as many equally likely intervals: the mean is met far better
    # than by random numbers, where it would miss by 2/sqrt(4096) = 0.03
    assert found.mean() == pytest.approx(5.0, abs=0.01)
    assert found.std() == pytest.approx(2.0, rel=0.01)
    assert np.mean(np.abs(found - 5.0) < 2.0) == pytest.approx(0.6827, abs=2e-3)


def test_a_cut_normal_spread_keeps_its_ends_and_its_shape_between():
    cut = Spread(key="n", low=3.0, high=7.0, mean=5.0, deviation=2.0)
    found = Design(spreads=(cut,), sampling=Sampling("sobol", 1024)).column("n")
    assert found.min() >= 3.0
    assert found.max() <= 7.0
    # of a normal distribution 38.29 % lies within half a deviation, 68.27 % within one
    share = np.mean(np.abs(found - 5.0) < 1.0)
    assert share == pytest.approx(0.3829 / 0.6827, abs=3e-3)


def test_a_seed_repeats_the_samples_and_another_changes_them():
    columns = [
        Design(spreads=(U,), sampling=Sampling("lhs", 8, seed)).column("u").tolist()
        for seed in (1, 1, 2)
    ]
    assert columns[0] == columns[1] != columns[2]


@each(
    ("made", "said"),
    [
        (lambda: Design(), "got none. Give --vary"),
        (lambda: Design(axes=(A, A)), "a must be varied only once"),
        (lambda: Design(spreads=(U,)), "range without steps"),
        (lambda: Design(axes=(A,), sampling=Sampling("lhs", 5)), "needs ranges to sample"),
        (lambda: Sampling("sobol", 100), "Take 64 or 128"),
        (lambda: Sampling("lhs", 0), "within 1 to"),
        (lambda: Spread(key="u", low=2.0, high=2.0), "must be above the lower, 2, got 2"),
        (lambda: Axis("a", ()), "one or more different values"),
    ],
)
def test_a_wrong_design_is_refused(made, said):
    with pytest.raises(ParameterError, match=said):
        made()
