"""Mean losses of an axle by one mesh period against the same axle marched in time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, axle_losses
from gearlube_core.dynamics.hypoid_axle.model import HypoidAxle
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import (
    mohammadpour_2015_axle,
)
from gearlube_core.errors import ParameterError
from tests.helpers.each import each

AXLE = mohammadpour_2015_axle()
RATIO = AXLE.mesh.ratio


def one_point(torque, speed, temperature, axle=AXLE, **options):
    found = axle_losses(
        axle,
        torques=np.array([torque]),
        speeds=np.array([speed]),
        temperatures=np.array([temperature]),
        **options,
    )
    return found.power[0, 0, 0], found


def marched(torque, speed, temperature, loss, mesh_periods=60, parameters=AXLE):
    """Return the mean powers lost [W] of a march under the torques that keep the speed."""
    axle = HypoidAxle(parameters)
    wheel_torque = (torque - loss / speed) * RATIO
    axle.initialise(
        pinion_speed=speed,
        pinion_torque=torque,
        wheel_torque=wheel_torque,
        oil_temperature=temperature,
    )
    step = 2.0 * np.pi / (AXLE.mesh.pinion_teeth * speed)  # a mesh period
    names = [f"energy.{name}" for name in LOSS_SOURCES]
    for _ in range(max(mesh_periods, int(0.2 / step))):
        axle.step(step, torque, wheel_torque, temperature)
    before = np.array([axle.output(name) for name in names])
    for _ in range(mesh_periods):
        axle.step(step, torque, wheel_torque, temperature)
    after = np.array([axle.output(name) for name in names])
    return (after - before) / (mesh_periods * step)


# 1 %: what a user of the map is promised; friction rises less than in proportion to the load, so
# the swing about its mean changes the mean loss in second order
@each(("torque", "speed", "degc"), [(50.0, 209.4, 60.0), (-30.0, 209.4, 60.0), (100.0, 60.0, 80.0)])
def test_the_mean_losses_are_those_of_the_march(torque, speed, degc):
    loss, _ = one_point(torque, speed, degc + 273.15)
    found = marched(torque, speed, degc + 273.15, loss.sum())
    assert loss.sum() == pytest.approx(found.sum(), rel=0.01)
    assert loss[0] == pytest.approx(found[0], rel=0.01)  # flank friction by the fluid alone


def test_shafts_rest_under_friction_too_where_rollers_leave_their_races():
    """At 120 N.m rollers of the pinion part; a shift of 1 % of a micrometre changes their drag."""
    axle = replace(AXLE, bearing_torque_loss="zhou_hoeprich_1991")
    loss, _ = one_point(120.0, 200.0, 333.15, axle)
    found = marched(120.0, 200.0, 333.15, loss.sum(), parameters=axle)
    # shafts at rest without friction would lose 0.9 % less; what the swing of the loads adds is
    # a third of that at most
    assert loss.sum() == pytest.approx(found.sum(), rel=0.003)


@pytest.mark.slow
def test_twenty_points_by_chance_are_those_of_the_march():
    rng = np.random.default_rng(20)
    for _ in range(20):
        torque, speed = rng.uniform(-150.0, 380.0), rng.uniform(30.0, 500.0)
        temperature = rng.uniform(313.0, 373.0)
        loss, _ = one_point(torque, speed, temperature)
        found = marched(torque, speed, temperature, loss.sum())
        assert loss.sum() == pytest.approx(found.sum(), rel=0.01), (torque, speed, temperature)


def test_more_angles_change_nothing():
    torques, speeds = np.linspace(-200.0, 400.0, 7), np.array([20.0, 200.0, 500.0])
    grid = {"torques": torques, "speeds": speeds, "temperatures": np.array([313.15, 363.15])}
    usual = axle_losses(AXLE, extremes=False, **grid).total
    fine = axle_losses(AXLE, extremes=False, angles=256, **grid).total
    # the mean of equal steps over a period converges fast; kinks where pairs enter leave 1e-4
    assert usual == pytest.approx(fine, rel=2e-4)


def test_the_teeth_carry_what_friction_and_drag_leave():
    """The torques on the pinion balance: by its own bearings' drag and half of the friction."""
    dry = replace(AXLE, friction="off")
    loss, found = one_point(80.0, 150.0, 333.15, axle=dry)
    axle = HypoidAxle(dry)
    axle.initialise(
        pinion_speed=150.0, pinion_torque=80.0, wheel_torque=200.0, oil_temperature=333.15
    )
    # without friction the pinion's share of the drag is what the teeth do not carry
    drag = 80.0 - found.carried[0, 0, 0]
    gear_drag = (loss[LOSS_SOURCES.index("bearing_torque")] - drag * 150.0) / (150.0 / RATIO)
    assert 0.0 < gear_drag < drag  # the same bearings at a lower speed
    assert loss[0] == loss[1] == 0.0


def test_a_free_axle_loses_its_drag_alone_between_drive_and_coast():
    """Where the teeth carry nothing, the loss is the drag; to either side it is more."""
    torques = np.linspace(-8.0, 8.0, 65)
    found = axle_losses(
        AXLE, torques=torques, speeds=np.array([100.0]), temperatures=np.array([333.15])
    )
    total, carried = found.total[0, 0], found.carried[0, 0]
    lowest = int(np.argmin(total))
    assert abs(carried[lowest]) <= 0.25  # a step of the torques
    drag = found.power[0, 0, lowest, LOSS_SOURCES.index("bearing_torque")]
    assert total[lowest] == pytest.approx(drag, rel=0.01)  # what a quarter N.m adds
    assert np.all(np.diff(total[: lowest + 1]) < 0.0)
    assert np.all(np.diff(total[lowest:]) > 0.0)


def test_extremes_are_those_of_the_outputs():
    _, found = one_point(60.0, 200.0, 333.15)
    axle = HypoidAxle(AXLE)
    axle.initialise(
        pinion_speed=200.0, pinion_torque=60.0, wheel_torque=160.0, oil_temperature=333.15
    )
    axle.step(1e-5, 60.0, 160.0, 333.15)
    ratios = [axle.output(f"flank[{i}].film_ratio") for i in (1, 2, 3)]
    least = min(one for one in ratios if one > 0.0)
    # the march starts at one angle under the whole torque, the map looks at four under 3 % less
    assert found.film_ratio[0, 0, 0] == pytest.approx(least, rel=0.1)
    assert 333.15 < found.flank_temperature[0, 0, 0] < 500.0


@each(
    ("changed", "words"),
    [
        ({"torques": np.array([900.0])}, "torque"),
        ({"speeds": np.array([0.0])}, "speed"),
        ({"temperatures": np.array([60.0])}, "temperature"),
        ({"angles": 2}, "angles"),
    ],
)
def test_what_is_out_of_range_is_refused_before_anything_is_computed(changed, words):
    grid = {
        "torques": np.array([50.0]),
        "speeds": np.array([100.0]),
        "temperatures": np.array([333.15]),
    }
    with pytest.raises(ParameterError, match=words):
        axle_losses(AXLE, **(grid | changed))
