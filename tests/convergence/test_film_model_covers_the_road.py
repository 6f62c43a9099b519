"""The film models hold on the road: how much of the loss of the shipped axle they cover."""

from dataclasses import replace

import numpy as np
import pytest

import gearlube as gl
from gearlube_core.dynamics.hypoid_axle.losses import axle_losses
from gearlube_core.units import celsius_to_kelvin, kmh_to_ms

pytestmark = pytest.mark.slow

CAR = gl.read_axle("mohammadpour_2015")
AXLE = replace(CAR.axle, film="solved", bearing_torque_loss="solved_films")
COVERED = 0.99  # of the loss: what is asked of the models


def test_a_cold_start_of_the_wltc_is_covered():
    car = replace(CAR, axle=AXLE)
    found = gl.run_cycle(
        gl.DriveCycleSettings(car=car, cycle=gl.studies.DriveCycle.named("wltc"), draws=0)
    )
    loss = found["loss"].values.clip(0.0)
    sources = list(found["source"].values)
    for outside, names in (
        ("share_outside", ("friction_viscous", "friction_boundary")),
        ("rollers_outside", ("bearing_torque",)),
    ):
        of_source = sum(loss[:, sources.index(name)] for name in names)
        share = (of_source * np.nan_to_num(found[outside].values)).sum() / of_source.sum()
        assert share < 1.0 - COVERED, outside


def test_a_loss_map_is_covered():
    """From 5 to 180 km/h, 10 to 400 N.m and 40 to 120 degC, each point as long as another."""
    road = CAR.driveline.road_load
    losses = axle_losses(
        AXLE,
        torques=np.array([10.0, 30.0, 100.0, 200.0, 400.0]),
        speeds=np.array([road.pinion_speed(kmh_to_ms(v)) for v in (5, 10, 30, 60, 100, 140, 180)]),
        temperatures=np.array([celsius_to_kelvin(t) for t in (40.0, 80.0, 120.0)]),
    )
    friction = losses.power[..., 0] + losses.power[..., 1]
    assert (friction * losses.share_outside).sum() / friction.sum() < 1.0 - COVERED
