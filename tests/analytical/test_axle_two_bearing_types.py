"""An axle whose shafts run on different bearings: each shaft feels its own."""

import math
from dataclasses import replace

import pytest

from gearlube_core.bearings.standalone import RotorOnBearing
from gearlube_core.dynamics.hypoid_axle import HypoidAxle, mohammadpour_2015_axle
from gearlube_core.errors import ParameterError
from tests.helpers.axle_cases import running_axle

PAPER = mohammadpour_2015_axle(bearing_preload=3000.0)


def with_gear_bearing(**changes):
    return replace(PAPER, gear_bearing=replace(PAPER.bearing, **changes))


def test_load_drag_of_the_gears_shaft_is_that_of_its_own_preload_and_angle():
    # f1 F d_m for each of two bearings, F = 0.8 cot(angle) of the axial preload (Palmgren 1959)
    angle, preload, f1 = math.radians(20.0), 1200.0, 5e-4
    idle = replace(PAPER.bearing, f0=0.0, f1=0.0)
    other = replace(idle, f1=f1, preload=preload, contact_angle=angle)
    axle, _, _ = running_axle(60, replace(PAPER, bearing=idle, gear_bearing=other))
    d_m = 0.5 * (0.040 + 0.0837)
    torque = 2.0 * f1 * 0.8 / math.tan(angle) * preload * d_m
    speed = axle.output("wheel.speed")
    # smooth through zero speed: w/sqrt(w^2 + w0^2) with w0 = 1 rad/s
    expected = torque * speed * speed / math.hypot(speed, 1.0)
    assert axle.output("bearing.power_loss") == pytest.approx(expected, rel=1e-12)  # rounding


def test_equal_bearings_on_the_gears_shaft_change_nothing():
    same, *_ = running_axle(60, with_gear_bearing())
    plain, *_ = running_axle(60, PAPER)
    assert same.outputs.tolist() == plain.outputs.tolist()


def test_cages_turn_as_the_races_of_their_own_shaft_have_it():
    axle, pinion, wheel = running_axle(
        60, with_gear_bearing(inner_race_diameter=0.092, outer_race_diameter=0.125, n_rollers=16)
    )
    before = [axle.output(f"bearing[{j}].cage.angle") for j in (1, 3)]
    angles = axle.output("pinion.angle"), axle.output("wheel.angle")
    for _ in range(20):
        axle.step(1e-3, pinion, wheel, 368.15)
    turned = [
        axle.output(f"bearing[{j}].cage.angle") - a for j, a in zip((1, 3), before, strict=True)
    ]
    shafts = axle.output("pinion.angle") - angles[0], axle.output("wheel.angle") - angles[1]
    assert turned[0] / shafts[0] == pytest.approx(50.0 / 125.4, rel=1e-9)  # integration
    assert turned[1] / shafts[1] == pytest.approx(92.0 / 217.0, rel=1e-9)


def test_bearings_of_two_classes_are_refused():
    other = RotorOnBearing.mohammadpour_2015()
    with pytest.raises(ParameterError, match="gear_bearing must be a TaperedRollerBearing"):
        HypoidAxle(replace(PAPER, gear_bearing=other))
