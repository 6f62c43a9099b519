from dataclasses import replace

import pytest

from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.errors import ParameterError
from tests.helpers.each import each

BEARING = TaperedRollerBearing.mohammadpour_2015()


def test_preload_and_interference_exclude_each_other():
    with pytest.raises(ParameterError, match="Give one of them"):
        BEARING.with_preload(2500.0).with_interference(10e-6)
    with pytest.raises(ParameterError, match="Give one of them"):
        BEARING.with_clearance(10e-6).with_preload(2500.0)


def test_cylindrical_rollers_refuse_a_preload_and_name_the_cure():
    straight = TaperedRollerBearing.mohammadpour_2015(contact_angle=0.0)
    with pytest.raises(ParameterError, match="with_interference"):
        straight.with_preload(2500.0)
    assert straight.with_preload(0.0).rest_approach == 0.0
    assert straight.with_interference(1e-5).preload_force() == 0.0


def test_preload_is_what_the_rollers_carry_at_rest():
    b = BEARING.with_preload(2500.0)
    assert b.preload_force() == 2500.0
    # rounding
    back = BEARING.with_interference(b.rest_approach).preload_force()
    assert back == pytest.approx(2500.0, rel=1e-12)
    assert BEARING.with_clearance(1e-5).preload_force() == 0.0
    assert BEARING.rest_approach == 0.0


def test_preload_can_be_changed():
    assert BEARING.with_preload(2500.0).with_preload(6000.0).preload_force() == 6000.0


@each(
    ("name", "value", "message"),
    [
        ("n_rollers", 41, "within 3 to 40"),
        ("n_rollers", 11.5, "whole number"),
        ("exponent", 3.0, "10/9"),
        ("contact_angle", 15.0, "15 deg is 0.2618 rad"),
        ("roller_diameter", 12.7, "12.7 mm"),
        ("outer_race_diameter", 60e-3, "between the races"),
        ("interference", 10.0, "10 um is 1e-5 m"),
        ("preload", -1.0, "cannot pull"),
        ("approach", "half", "must be one of"),
        ("film", "yes", "must be one of"),
        ("stiffness_constant", float("nan"), "finite"),
    ],
)
def test_bad_inputs_say_what_and_how_to_cure_it(name, value, message):
    with pytest.raises(ParameterError, match=message):
        replace(BEARING, **{name: value})


def test_printed_approach_is_halved_and_may_pull():
    p = TaperedRollerBearing.mohammadpour_2015(approach="as_printed").parameters()
    assert (p.approach_factor, p.clip) == (0.5, 0.0)
    p = BEARING.parameters()
    assert (p.approach_factor, p.clip) == (1.0, 1.0)


def test_film_options_reach_the_kernels():
    for film, constant, squeeze in (("off", False, 0), ("steady", True, 0), ("squeeze", True, 1)):
        p = TaperedRollerBearing.mohammadpour_2015(film=film).parameters()
        assert (p.film_constant > 0.0, p.squeeze) == (constant, squeeze)
