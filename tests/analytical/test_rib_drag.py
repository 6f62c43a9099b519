"""Drag of ribs, steel and oil on the rollers of a shaft, alone and in the axle."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.losses.geometry import BearingGeometry, Rib, closing_inner_angle
from gearlube_core.bearings.losses.laws import ROLLING_LAWS
from gearlube_core.bearings.losses.loss import LossModel, bearing_loss
from gearlube_core.bearings.losses.rib import rib_friction
from gearlube_core.bearings.parameters import ROLLERS_MAX
from gearlube_core.bearings.roller_loads import roller_loads
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.bearings.tapered_roller_kernels import rib_contact, rib_drag, roller_half_cone
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, axle_losses
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import (
    mohammadpour_2015_axle,
)
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import lubricant_state
from tests.helpers.each import each

FVA = Lubricant.named("fva_3")
KELVIN, PRELOAD = 353.15, 5000.0
OIL = lubricant_state(FVA.parameters(), KELVIN)
OUTER = math.radians(15.64)
# bearing 32216 of Wingertszahn et al. 2023
GEOMETRY = BearingGeometry(
    bore_diameter=0.08, outside_diameter=0.14, pitch_diameter=0.1085, n_rollers=16,
    roller_diameter=0.017, roller_length=0.0227, rib=Rib(contact_height=0.0025),
    outer_angle=OUTER, inner_angle=closing_inner_angle(0.1085, 0.017, OUTER),
)  # fmt: skip


def on_a_shaft():
    """The same bearing as that of an axle, whose races lie by the cosine of the outer angle."""
    across = 0.017 * math.cos(GEOMETRY.mean_angle)
    return replace(
        TaperedRollerBearing.mohammadpour_2015(film="off", contact_angle=OUTER),
        bore_diameter=0.08,
        outside_diameter=0.14,
        inner_race_diameter=0.1085 - across,
        outer_race_diameter=max(0.1085 + across, 0.1085 - across + 0.017),
        roller_diameter=0.017,
        roller_length=0.0227,
        n_rollers=16,
        rib_height=0.0025,
        preload=PRELOAD,
    )


P = on_a_shaft().parameters()


def motion(speed, r1=0.0, axial=0.0):
    return ShaftMotion(r1, 0.0, axial, 0.0, 0.0, 0.0, 0.2, speed)


def test_half_cone_closes_the_apex():
    for k, degrees in ((0.05, 5.0), (0.157, 15.64), (0.3, 45.0)):
        angle = math.radians(degrees)
        found = math.atan(roller_half_cone(k, math.sin(angle), math.cos(angle)))
        assert math.tan(found) == pytest.approx(k * math.sin(angle - found), rel=1e-13)


def test_the_contact_is_that_of_the_bearing_alone():
    rib, share = rib_contact(P)
    alone = GEOMETRY.parameters()
    assert share == pytest.approx(alone.rib_share, rel=1e-6)
    # the outer race of a shaft's bearing leaves room for whole rollers: pitch 0.15 % larger
    assert rib == pytest.approx(alone.rib, rel=5e-3)


@each("rpm", [10.0, 100.0, 2000.0])
def test_two_preloaded_bearings_lose_twice_what_one_does_alone(rpm):
    speed = rpm * math.pi / 30.0
    one = bearing_loss(
        GEOMETRY, FVA, LossModel(law="zhou_hoeprich"), speed=speed, axial_load=PRELOAD,
        radial_load=0.0, temperature=KELVIN,
    )  # fmt: skip
    found = rib_drag(motion(speed), OIL, P)
    # rib: smoothed below 1 rad/s, geometry as above, and there the film falls with the height
    smooth = speed / math.hypot(speed, 1.0)
    assert found.rib == pytest.approx(2.0 * one.parts["rib"] * smooth, rel=0.01)
    # the race of a shaft's bearing takes the outer load on both races, alone 2 % less inside
    assert found.hysteresis == pytest.approx(2.0 * one.parts["hysteresis"], rel=0.02)
    assert found.oil == pytest.approx(2.0 * one.parts["drag"], rel=0.01)

    def torque(speed):
        rolling = P.raceway_torque(motion(speed), ROLLING_LAWS["zhou_hoeprich"], OIL)
        return rolling + P.beside_raceways(motion(speed), OIL)

    whole = torque(speed)
    alone = 2.0 * (one.torque - (1.0 - smooth) * one.parts["rib"])
    assert whole == pytest.approx(alone, rel=0.01)
    assert torque(-speed) == -whole


def test_one_coefficient_of_friction_stands_for_those_of_all_rollers():
    speed = 8.0
    rib, share = rib_contact(P)
    loads, expected, idle = np.zeros(ROLLERS_MAX), 0.0, 0
    at = motion(speed, r1=25e-6, axial=5e-6)
    still = P._replace(loss=0.0, cage_ratio=P.cage_ratio)
    for side in (1.0, -1.0):
        assert roller_loads(at, 1e12, OIL.eta0, OIL.alpha, still, side, loads) == 0
        idle += int(np.sum(loads[:16] == 0.0))
        expected += sum(
            rib_friction(rib, share * one, speed, OIL).power / speed for one in loads[:16]
        )
    assert idle > 0
    expected *= speed / math.hypot(speed, 1.0)
    # loads from 0 to twice the mean; the film falls with load^0.07, traction rises a little
    assert rib_drag(at, OIL, P).rib == pytest.approx(expected, rel=0.03)


def test_without_height_or_contact_angle_or_speed_there_is_no_rib():
    assert rib_drag(motion(5.0), OIL, P._replace(rib_height=0.0)).rib == 0.0
    assert rib_drag(motion(5.0), OIL, P._replace(sin_contact=0.0, cos_contact=1.0)).rib == 0.0
    assert rib_drag(motion(0.0), OIL, P) == (0.0, 0.0, 0.0)
    # fused multiply-add and libm round differently
    found = rib_drag(motion(5.0), OIL, P)
    assert rib_drag.py_func(motion(5.0), OIL, P) == pytest.approx(found, rel=1e-10)


def test_ribs_take_most_of_the_bearing_drag_of_a_slow_and_hot_axle_and_little_of_a_fast_one():
    base = replace(mohammadpour_2015_axle(), bearing_torque_loss="zhou_hoeprich_1991")
    smooth = replace(base, bearing=replace(base.bearing, rib_height=0.0))

    def drag(axle):
        return axle_losses(
            axle,
            torques=np.array([50.0]),
            speeds=np.array([3.0, 300.0]),
            temperatures=np.array([373.15]),
            angles=8,
            extremes=False,
        ).power[0, :, 0, LOSS_SOURCES.index("bearing_torque")]

    share = 1.0 - drag(smooth) / drag(base)
    assert share[0] > 0.5
    assert share[1] < 0.15
