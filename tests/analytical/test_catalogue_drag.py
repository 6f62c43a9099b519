"""Drag of bearings by the laws of the catalogues under their real loads, alone and in the axle."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.bearings.bearing_type import ShaftMotion, loaded_drag
from gearlube_core.bearings.losses.laws import PALMGREN, SKF
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.bearings.tapered_roller_kernels import skf_drag
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES, axle_losses
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import (
    mohammadpour_2015_axle,
)
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import lubricant_state
from tests.helpers.each import each

PRELOAD, SPEED, OIL_TEMPERATURE = 3000.0, 180.0, 343.15
OIL = lubricant_state(Lubricant.named("mohammadpour_2015").parameters(), OIL_TEMPERATURE)
BEARING = TaperedRollerBearing.mohammadpour_2015(film="off").with_preload(PRELOAD)
P = BEARING.parameters()
SIN, COS = math.sin(BEARING.contact_angle), math.cos(BEARING.contact_angle)
# rollers at rest, so that none has a rate; what sides and rollers carry is then exact
STILL = P._replace(cage_ratio=0.0)
ANGLES = 2.0 * math.pi * np.arange(12) / 12


def motion(r1=0.0, axial=0.0, speed=SPEED):
    return ShaftMotion(r1, 0.0, axial, 0.0, 0.0, 0.0, 0.0, speed)


def loads_by_hand(r1, axial):
    """Axial and radial load of either bearing: 12 rollers, kn d^(10/9) each."""
    rest = (PRELOAD / (12 * 5e8 * SIN)) ** 0.9
    found = []
    for side in (1.0, -1.0):
        approach = rest + r1 * np.cos(ANGLES) * COS + side * axial * SIN
        w = 5e8 * np.maximum(approach, 0.0) ** (10.0 / 9.0)
        found.append((SIN * w.sum(), abs(COS * (w * np.cos(ANGLES)).sum())))
    return found


def palmgren(axial, radial):
    """In the units of the catalogue: N mm, mm2/s, rpm, mm."""
    dm, nu, n = 0.5 * (40.0 + 83.7), 1e6 * OIL.nu, SPEED * 30.0 / math.pi
    viscous = 1e-7 * 6.0 * max((nu * n) ** (2.0 / 3.0), 160.0) * dm**3
    return 1e-3 * (viscous + 4e-4 * max(0.8 * COS / SIN * axial, radial) * dm)


def skf(axial, radial):
    """Likewise; series 303."""
    dm, nu, n = 0.5 * (40.0 + 83.7), 1e6 * OIL.nu, SPEED * 30.0 / math.pi
    Y = 0.4 * COS / SIN
    heat = 1.0 / (1.0 + 1.84e-9 * (n * dm) ** 1.28 * nu**0.64)
    thin = math.exp(-3e-8 * nu * n * (40.0 + 83.7) * math.sqrt(6.0 / (2.0 * (83.7 - 40.0))))
    rolling = heat * thin * 1.69e-6 * dm**2.38 * (radial + 10.9 * Y * axial) ** 0.31
    share = math.exp(-2.6e-8 * (n * nu) ** 1.4 * dm)
    mu = 0.12 * share + 0.002 * (1.0 - share)
    return 1e-3 * (rolling * (nu * n) ** 0.6 + 0.017 * dm**0.82 * (radial + 2.0 * Y * axial) * mu)


@each(("law", "by_hand"), [(PALMGREN, palmgren), (SKF, skf)])
@each("at", [(0.0, 0.0), (0.0, 20e-6), (15e-6, 5e-6), (60e-6, 50e-6)])
def test_each_bearing_has_the_drag_of_its_own_loads(law, by_hand, at):
    made = replace(BEARING, series="303").parameters()._replace(cage_ratio=0.0)
    expected = sum(by_hand(*loads) for loads in loads_by_hand(*at))
    # the factor that smooths the start, w/sqrt(w^2 + 1)
    expected *= SPEED / math.hypot(SPEED, 1.0)
    # the kernels' ninth root: 1e-9
    assert loaded_drag(made, motion(*at), law, OIL) == pytest.approx(expected, rel=1e-7)


def test_at_rest_in_its_bearings_a_shaft_has_the_drag_of_the_preload():
    of_preload = 2.0 * P.shaft_drag(SPEED, PRELOAD, 0.0, PALMGREN, OIL)
    assert loaded_drag(STILL, motion(), PALMGREN, OIL) == pytest.approx(of_preload, rel=1e-9)


def test_the_torque_opposes_either_way_and_ends_at_rest():
    for law in (PALMGREN, SKF):
        forward = loaded_drag(STILL, motion(1e-5, 1e-5), law, OIL)
        assert forward > 0.0
        assert loaded_drag(STILL, motion(1e-5, 1e-5, -SPEED), law, OIL) == -forward
        assert loaded_drag(STILL, motion(1e-5, 1e-5, 0.0), law, OIL) == 0.0
    # another processor instruction may round differently
    compiled = skf_drag(SPEED, 900.0, 300.0, OIL.nu, P)
    assert skf_drag.py_func(SPEED, 900.0, 300.0, OIL.nu, P) == pytest.approx(compiled, rel=1e-12)


def test_load_of_the_axle_raises_the_drag_after_palmgren_and_hardly_that_after_skf():
    base = mohammadpour_2015_axle()
    dry = replace(base.bearing, film="off")  # films would add their thickness to the preload

    def drag(law):
        return axle_losses(
            replace(base, bearing=dry, bearing_torque_loss=law),
            torques=np.array([5.0, 300.0]),
            speeds=np.array([SPEED]),
            temperatures=np.array([OIL_TEMPERATURE]),
            angles=8,
            extremes=False,
        ).power[0, 0, :, LOSS_SOURCES.index("bearing_torque")]

    fixed, loaded, by_skf = drag("palmgren"), drag("palmgren_loaded"), drag("skf_2013")
    assert fixed[1] == pytest.approx(fixed[0], rel=1e-3)  # the gear's speed swings by 1e-4
    # at 5 N.m the forces of the mesh, 200 N, are a tenth of the preload, and opposed bearings
    # gain and lose the axial ones alike
    assert loaded[0] == pytest.approx(fixed[0], rel=0.02)
    assert loaded[1] > 1.1 * loaded[0]
    # load^0.31: what one bearing of a pair gains the other about loses
    assert by_skf[1] == pytest.approx(by_skf[0], rel=0.15)
