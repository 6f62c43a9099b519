"""What the losses of an axle must do over torque, speed and temperature."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import gearlube as gl
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, axle_losses

AXLE = replace(
    gl.mohammadpour_2015_axle(),
    churning="changenet_velex_2007",
    rolling="biboulet_houpert_2010",
    pinion_seal_torque=0.15,
    wheel_seal_torque=0.3,
)
DEGC = np.array([20.0, 60.0, 100.0])
SPEEDS = np.array([20.0, 100.0, 400.0])
TORQUES = np.array([-300.0, -100.0, -20.0, -1e-4, 0.0, 1e-4, 20.0, 100.0, 300.0])


@pytest.fixture(scope="module")
def power():
    return axle_losses(
        AXLE, torques=TORQUES, speeds=SPEEDS, temperatures=DEGC + 273.15, extremes=False
    ).power


def part(power, *names):
    return power[..., [LOSS_SOURCES.index(one) for one in names]].sum(axis=-1)


def test_nothing_is_gained_and_all_sources_are_lost_power(power):
    assert np.all(power >= 0.0)


def test_drive_and_coast_meet_without_torque(power):
    total = power.sum(axis=-1)
    below, at, above = (total[..., k] for k in (3, 4, 5))
    # 1e-4 N.m moves the load by 1e-4 N.m, of which friction takes a tenth; drag is 0.5 N.m and more
    assert below == pytest.approx(at, rel=1e-4)
    assert above == pytest.approx(at, rel=1e-4)


def test_drive_and_coast_lose_differently(power):
    """Spiral flanks: other radii, other sliding and other shaft forces on the coast side."""
    total = power.sum(axis=-1)
    ratio = total[..., 1] / total[..., 7]
    assert np.all(np.abs(ratio - 1.0) > 0.02)


def test_hotter_oil_lowers_drag_and_rolling(power):
    for name in ("bearing_torque", "friction_rolling"):
        lost = part(power, name)[..., [1, 7]]
        assert np.all(np.diff(lost, axis=0) < 0.0), name


def test_hotter_oil_moves_friction_to_the_asperities(power):
    rough = part(power, "friction_boundary")[:, 0, -1]
    fluid = part(power, "friction_viscous")[:, 0, -1]
    assert np.all(np.diff(rough) > 0.0)
    assert np.all(np.diff(fluid) < 0.0)


def test_drag_without_load_rises_with_speed(power):
    """A load part free of speed, and a viscous part with its power 2/3 [palmgren_1959]."""
    drag = part(power, "bearing_torque")[..., 4] / SPEEDS
    assert np.all(np.diff(drag, axis=1) > 0.0)
    slow, middle, fast = SPEEDS ** (2.0 / 3.0)
    # both shafts, in oil of 20 degC: nu n is above 2000 mm2/s rpm throughout. At
    # 7 rad/s of the gear the smooth start of the law, w0 = 1 rad/s, takes 1 % of its drag
    ratio = (drag[0, 2] - drag[0, 1]) / (drag[0, 1] - drag[0, 0])
    assert ratio == pytest.approx((fast - middle) / (middle - slow), rel=5e-3)


def test_more_torque_loses_more_and_the_slope_falls_with_speed(power):
    total = power.sum(axis=-1) / SPEEDS[:, None]
    slope = (total[2, :, 8] - total[2, :, 7]) / 200.0
    assert np.all(np.diff(slope) < 0.0)  # thicker films, faster sliding: less traction
    # friction of 0.02 to 0.06 and sliding of a third of the pitch speed: 1 to 4 %
    assert np.all((slope > 0.01) & (slope < 0.04))


def test_hot_oil_raises_the_flank_loss_only_where_asperities_can_carry_the_load():
    """Slow flanks have no film in hot oil; fast ones lose least in between."""
    flanks = {}
    for law in ("consistent", "zhou_hoeprich_1991"):
        found = axle_losses(
            replace(gl.mohammadpour_2015_axle(), friction=law),
            torques=np.array([300.0]),
            speeds=np.array([3.0, 200.0]),
            temperatures=np.array([40.0, 60.0, 120.0]) + 273.15,
            angles=8,
            extremes=False,
        ).power
        flanks[law] = part(found, "friction_viscous", "friction_boundary")[..., 0]
    slow, fast = flanks["zhou_hoeprich_1991"].T
    assert slow[0] < slow[1] < slow[2]
    assert fast[1] < fast[0] < fast[2]
    # asperities that carry at most 32 MPa leave the film its load: colder oil always loses more
    assert np.all(np.diff(flanks["consistent"], axis=0) < 0.0)
    # without a film the flanks rub at the boundary coefficient: 0.17 of the load
    assert slow[2] / flanks["consistent"][2, 0] > 3.0
