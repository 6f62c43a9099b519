import pytest

from examples.whine_gradient import INPUTS, main
from tests.helpers.fmu_cases import HYPOID_AXLE
from tests.helpers.native_fmus import native_fmus


def test_the_gradient_along_a_run_is_that_of_differences():
    level, exact, by_differences = main(native_fmus(HYPOID_AXLE).fmi2)
    # steps of 1e-6 leave 1e-6 of a gradient: rounding, and nodes that one run meets a step earlier
    assert exact == pytest.approx(by_differences, rel=1e-5)
    assert len(exact) == len(INPUTS)
    assert abs(exact / level).max() > 1e-3  # per N.m
