"""Flanks that their own friction warms: the balance of heat, and what it changes in a map."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_axle.losses import (
    FAILURES,
    LOSS_SOURCES,
    SETTLED,
    TOO_HOT,
    AxleLosses,
    axle_losses,
    bulk_temperature,
)
from gearlube_core.dynamics.hypoid_axle.model import HypoidAxle
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
from gearlube_core.errors import ParameterError

AXLE = mohammadpour_2015_axle()
OIL, RESISTANCE = 333.15, 0.05  # K, K/W
RUBBING = [LOSS_SOURCES.index(one) for one in ("friction_viscous", "friction_boundary")]
OTHERS = [n for n in range(len(LOSS_SOURCES)) if n not in RUBBING]


def losses(axle=AXLE, temperature=OIL) -> AxleLosses:
    return axle_losses(
        axle,
        torques=np.array([20.0, 150.0]),
        speeds=np.array([150.0]),
        temperatures=np.array([temperature]),
        angles=8,
    )


def test_friction_that_falls_with_temperature_balances_where_two_lines_meet():
    # T = 300 + 0.2 (500 - 2 (T - 300)): rise 100/(1 + 0.4)
    found = bulk_temperature(lambda T: 500.0 - 2.0 * (T - 300.0), 300.0, 0.2, 500.0)
    assert found == pytest.approx(300.0 + 100.0 / 1.4, abs=SETTLED)


def test_friction_that_rises_with_temperature_warms_more_and_may_find_no_rest():
    # rise 0.1 (400 + 5 rise): 40/(1 - 0.5); with 12 W/K the heat outruns the cooling
    assert bulk_temperature(
        lambda T: 400.0 + 5.0 * (T - 300.0), 300.0, 0.1, 500.0
    ) == pytest.approx(380.0, abs=SETTLED)
    assert math.isnan(bulk_temperature(lambda T: 400.0 + 12.0 * (T - 300.0), 300.0, 0.1, 500.0))


def test_flanks_without_friction_stay_at_the_temperature_of_the_oil():
    assert bulk_temperature(lambda _: 0.0, 350.0, 1.0, 400.0) == 350.0


def test_a_map_with_warm_flanks_has_the_films_of_the_bulk_and_all_else_of_the_oil():
    """At the temperature found the axle's own friction is what keeps the flanks warm."""
    warm, cool = losses(replace(AXLE, flank_bulk_resistance=RESISTANCE)), losses()
    bulk = warm.bulk_temperature[0, 0]
    rubbed = warm.power[0, 0][:, RUBBING].sum(axis=1)
    # the root is known to SETTLED, and the last evaluation is at it
    assert bulk - OIL == pytest.approx(RESISTANCE * rubbed, abs=2.0 * SETTLED)
    assert bulk[1] > bulk[0] > OIL
    assert np.all(cool.bulk_temperature == OIL)
    assert warm.power[0, 0][:, OTHERS] == pytest.approx(cool.power[0, 0][:, OTHERS])
    for k in range(2):
        alike = losses(temperature=float(bulk[k]))
        # what an axle in oil as hot as the flanks loses there
        assert warm.power[0, 0, k, RUBBING] == pytest.approx(alike.power[0, 0, k, RUBBING])
        assert warm.film_ratio[0, 0, k] == pytest.approx(alike.film_ratio[0, 0, k])
    assert np.all(warm.film_ratio < cool.film_ratio)


def test_flanks_hotter_than_the_data_of_the_oil_leave_a_range():
    """The map of a drive cycle goes to the end of the oil's data, and the flanks beyond it."""
    oil = AXLE.oil.temperature_high - 20.0  # films at 20 N.m are some 10 K warmer
    warm, cool = losses(replace(AXLE, flank_bulk_resistance=0.5), oil), losses(temperature=oil)
    assert warm.status[0, 0, 0] == 0
    assert warm.bulk_temperature[0, 0, 0] > AXLE.oil.temperature_high
    bit = 1 << [one.output for one in AXLE.ranges].index("range.temperature")
    assert int(warm.exceeded[0, 0, 0]) & bit
    assert not int(cool.exceeded[0, 0, 0]) & bit


def test_flanks_that_get_far_too_hot_fail_with_a_reason():
    found = losses(replace(AXLE, flank_bulk_resistance=5.0))
    assert np.all(found.status == TOO_HOT)
    assert np.all(np.isnan(found.power))
    assert np.all(np.isnan(found.film_ratio))
    assert "smaller flank_bulk_resistance" in FAILURES[TOO_HOT]


def test_a_march_in_time_refuses_warm_flanks():
    with pytest.raises(ParameterError, match=r"must be 0 K/W in a march .* Got 0\.05 K/W"):
        HypoidAxle(replace(AXLE, flank_bulk_resistance=RESISTANCE))
