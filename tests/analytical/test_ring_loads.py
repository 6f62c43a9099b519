"""Loads between the rings of ball and cylindrical roller bearings."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

from gearlube_core.bearings.ball_rings import ball_rings
from gearlube_core.bearings.bearing_under_load import UnderLoad, bearing_under_load
from gearlube_core.bearings.cylinder_rings import cylinder_rings
from gearlube_core.bearings.ring_loads import RingMotion, moment_on_cage
from gearlube_core.errors import ConvergenceError, ParameterError
from tests.helpers.each import each

STEEL = 0.5 * 210e9 / (1.0 - 0.3**2)  # E* [Pa]
NONE = np.empty(0)
# c_p of ISO 16281 has the printed factor 1.48 for pi 2^0.5/3
PRINTED = 1.48 / (math.pi * math.sqrt(2.0) / 3.0)


class Bearing:
    """Numbers between both rings, as an element has them."""

    def __init__(self, rings, gaps=NONE):
        self.made = rings, gaps

    def rings(self):
        return self.made


def deep_groove(clearance=0.0, **more):
    return ball_rings(7, 11.5e-3, 43.5e-3, 0.52, 0.53, STEEL, clearance=clearance, **more)


def under(rings, *load, gaps=NONE) -> UnderLoad:
    return bearing_under_load(Bearing(rings, gaps), load)


# Deep groove bearing, first ball at x: clearance [um], load [N, N.m], radial and axial displacement
# [um] and tilt [mrad] that MASTA gives, as listed in the tests of github.com/minzhun/ISO16281.
# Their axial ones count from where the clearance is taken up, ours from the middle.
MASTA = (
    (0.0, (1000, 0, 0, 0, 0), 15.1101, None, None),
    (10.0, (1000, 0, 0, 0, 0), 21.2230, None, None),
    (0.0, (0, 0, 1000, 0, 0), None, 133.5381, None),
    (10.0, (0, 0, 1000, 0, 0), None, 149.1717, None),
    (10.0, (1000, 0, 1000, 0, 0), 19.5923, 146.4603, 2.6872),
    (0.0, (0, 0, 0, 0, 1), None, None, 3.6957),
    (10.0, (1000, 0, 1000, 1, 0), 19.7144, 146.3084, 2.7239),
)


@each("clearance, load, radial, axial, tilt", MASTA)
def test_deep_groove_bearing_moves_as_masta_has_it(clearance, load, radial, axial, tilt):
    """To 0.05 %; the printed values are 1e-6 to 2e-4 away."""
    x, y, z, rx, ry = under(deep_groove(1e-6 * clearance), *load).displacement
    found = 1e6 * math.hypot(x, y), 1e6 * z, 1e3 * math.hypot(rx, ry)
    for value, wanted in zip(found, (radial, axial, tilt), strict=True):
        if wanted is not None:
            assert value == pytest.approx(wanted, rel=5e-4)


def stiffness_in_mm(found: UnderLoad):
    """k_xx, k_zz [N/mm], k_tilt [N.mm/rad], k_x_ry [N/rad]."""
    K = found.stiffness
    return 1e-3 * K[0, 0], 1e-3 * K[2, 2], 1e3 * K[3, 3], K[0, 4]


# stiffness under an axial load, with the printed c_p and the tilt at the groove centres, by an
# independent script to the digits given: load [N], z [mm], angle [deg], load of a ball [N], K
ANGULAR = ball_rings(
    16, 22.225e-3, 125.26e-3, 0.5232, 0.5232, 0.5 * 206e9 / 0.91,
    contact_angle=math.radians(40.0), tilt_on_grooves=True,
)  # fmt: skip
STIFFNESS = (
    (deep_groove(tilt_on_grooves=True), 1e3, None, 13.0767, 631.40,
     (205652, 29274.5, 7.07156e6, -1.03084e6)),
    (ANGULAR, 1e4, 0.0248569, 41.0417, 951.862,
     (405453.8, 618094.0, 1.227581e9, -2.184727e7)),
)  # fmt: skip


@each("rings, load, z, angle, ball, stiffness", STIFFNESS)
def test_stiffness_under_an_axial_load(rings, load, z, angle, ball, stiffness):
    """To the digits given, at least five."""
    found = under(rings._replace(stiffness=PRINTED * rings.stiffness), 0, 0, load, 0, 0)
    assert stiffness_in_mm(found) == pytest.approx(stiffness, rel=5e-6)
    assert math.degrees(math.asin(found.loads.high)) == pytest.approx(angle, abs=5e-5)
    assert found.loads.largest == pytest.approx(ball, rel=1e-5)
    if z is not None:
        assert 1e3 * found.displacement[2] == pytest.approx(z, rel=5e-6)


ROLLERS, GAPS = cylinder_rings(
    6, 9e-3, 43.5e-3, 13.6e-3, STEEL, laminae=40, clearance=1e-5, flange=1e8, flange_gap=3e-6
)


def test_cylindrical_rollers_move_as_an_independent_script_has_it():
    """To the digits given."""
    radial = under(ROLLERS, 1000, 0, 0, 0, 0, gaps=GAPS)
    assert 1e6 * radial.displacement[0] == pytest.approx(12.40485, rel=1e-6)
    k_xx, k_ry = 1e-3 * radial.stiffness[0, 0], 1e3 * radial.stiffness[4, 4]
    assert (k_xx, k_ry) == pytest.approx((226463, 2.05998e6), rel=5e-6)
    assert radial.loads.largest == pytest.approx(942.700, rel=1e-6)
    tilted = under(ROLLERS, 1000, 0, 0, 0, 1, gaps=GAPS).displacement
    assert 1e6 * tilted[0] == pytest.approx(12.22859, rel=1e-6)
    assert 1e3 * tilted[4] == pytest.approx(0.51434, rel=1e-5)
    loaded = under(ROLLERS, 1e4, 0, 0, 0, 0, gaps=GAPS).displacement
    assert 1e6 * loaded[0] == pytest.approx(39.0725, rel=2e-6)


def test_pressure_is_that_of_hertz():
    """Line contact: p = (E* q/(pi R))^0.5 with q of the worst lamina."""
    found = under(ROLLERS, 1000, 0, 0, 0, 0, gaps=GAPS)
    d = 12.40485e-6 - 5e-6 - 2 * 0.00035 * 9e-3 * -math.log1p(-((1.0 / 40.0) ** 2))
    q = 35948.0 * 13.6 ** (8.0 / 9.0) * (1e3 * d) ** (10.0 / 9.0) / 13.6e-3  # N/m
    R = 1.0 / (1.0 / 4.5e-3 + 1.0 / 17.25e-3)
    assert found.pressure == pytest.approx(math.sqrt(STEEL * q / (math.pi * R)), rel=1e-5)


def test_pressure_of_a_ball_is_that_of_hertz():
    """The ellipse by scipy: p = 3 Q/(2 pi a b) with b/a from both curvatures at the inner ring."""
    found = under(ANGULAR, 0, 0, 1e4, 0, 0)
    Dw, modulus, Q = 22.225e-3, 0.5 * 206e9 / 0.91, found.loads.largest
    ratio = Dw * math.cos(math.radians(40.0)) / 125.26e-3
    R_x, R_y = 0.5 * Dw * (1.0 - ratio), 0.5 * Dw / (1.0 - 0.5 / 0.5232)

    def excess(k):  # k = a/b
        m = 1.0 - 1.0 / k**2
        K, E = ellipk(m), ellipe(m)
        return (k**2 * E - K) / (K - E) - R_y / R_x

    k = brentq(excess, 1.01, 100.0)
    R = 1.0 / (1.0 / R_x + 1.0 / R_y)
    b = (3.0 * ellipe(1.0 - 1.0 / k**2) * R * Q / (math.pi * k * modulus)) ** (1.0 / 3.0)
    assert found.pressure == pytest.approx(1.5 * Q / (math.pi * k * b * b), rel=1e-9)


def test_stiffness_of_a_ball_is_the_printed_one():
    """333375.6 N/mm^1.5 with the factor 1.48, by an independent script."""
    printed = PRINTED * deep_groove().stiffness * 1e-3**1.5
    assert printed == pytest.approx(333375.6, rel=1e-7)


KINDS = ((deep_groove(1e-5), NONE), (ANGULAR, NONE), (ROLLERS, GAPS))
SIZES = np.array([2e-5, 2e-5, 4e-5, 4e-4, 4e-4])
STEP = 1e-10
ARMS = np.array([1.0, 1.0, 1.0, 0.03, 0.03])


def moved(u, cage=0.0, rates=(0.0,) * 5, cage_speed=0.0):
    return RingMotion(*u, *rates, cage, cage_speed)


def positions(seed=3, number=12):
    chance = np.random.default_rng(seed)
    for _ in range(number):
        yield chance.normal(size=5) * SIZES, chance.uniform(0.0, 6.0), chance.normal(size=6)


def slopes(value, u):
    """Central differences over all five displacements; tilts by as much at 30 mm."""
    found = []
    for j in range(5):
        h = np.zeros(5)
        h[j] = STEP / ARMS[j]
        found.append((np.asarray(value(u + h)) - np.asarray(value(u - h))) / (2.0 * h[j]))
    return np.array(found)


@each("rings, gaps", KINDS)
def test_force_is_the_slope_of_the_energy_and_stiffness_that_of_the_force(rings, gaps):
    """To 1e-6: differences over 0.1 nm of energies that have 13 digits, kinks of laminae."""
    for u, cage, _ in positions():
        at = moved(u, cage)
        force = np.array(rings.ring_loads(at, 0.0, gaps)[:5])

        def loads(v, cage=cage):
            return rings.ring_loads(moved(v, cage), 0.0, gaps)

        by_energy = -slopes(lambda v, loads=loads: loads(v).energy, u)
        size = np.abs(force).max() + 1.0
        np.testing.assert_allclose(force, by_energy, atol=1e-5 * size, rtol=1e-6)
        K = np.zeros(25)
        rings.ring_stiffness(at, gaps, K)
        by_force = -slopes(lambda v, loads=loads: loads(v)[:5], u)
        # all as forces per displacement: tilts count by their displacement at 30 mm
        units = np.outer(ARMS, ARMS)
        wanted, K = by_force.T / units, K.reshape(5, 5) / units
        np.testing.assert_allclose(K, wanted, atol=1e-5 * K.max(), rtol=1e-5)
        tilting = slice(3, 5)
        limit = 1e-4 * K[tilting, tilting].max()
        np.testing.assert_allclose(K[tilting, tilting], wanted[tilting, tilting], atol=limit)


@each("rings, gaps", KINDS)
def test_power_on_ring_and_cage_is_stored_or_lost(rings, gaps):
    """-F.v - T_c w_c = dV/dt + loss, to the differences of V along the motion."""
    for u, cage, rates in positions():
        v, w = rates[:5] * np.array([1e-3, 1e-3, 1e-3, 0.02, 0.02]), 30.0 * rates[5]
        at = moved(u, cage, v, w)
        found = rings.ring_loads(at, 1e-5, gaps)
        given = -float(np.dot(found[:5], v)) - moment_on_cage(at, found) * w
        dt = 1e-8
        stored = [
            rings.ring_loads(moved(u + k * dt * v, cage + k * dt * w), 0.0, gaps).energy
            for k in (-1.0, 1.0)
        ]
        rate = (stored[1] - stored[0]) / (2.0 * dt)
        assert found.lost >= 0.0
        assert given == pytest.approx(rate + found.lost, rel=1e-5, abs=1e-6 * abs(rate) + 1e-7)


def test_loads_turn_with_the_bearing():
    """A position turned by the spacing of the balls gives forces that are turned as much."""
    turn = 2.0 * math.pi / 7.0
    c, s = math.cos(turn), math.sin(turn)
    rings = deep_groove(1e-5)
    for (x, y, z, rx, ry), cage, _ in positions():
        one = rings.ring_loads(moved((x, y, z, rx, ry), cage), 0.0, NONE)
        turned = c * x - s * y, s * x + c * y, z, c * rx - s * ry, s * rx + c * ry
        other = rings.ring_loads(moved(turned, cage), 0.0, NONE)
        wanted = c * one.f_x - s * one.f_y, s * one.f_x + c * one.f_y, one.f_z
        assert other[:3] == pytest.approx(wanted, rel=1e-9, abs=1e-9)
        wanted = c * one.m_x - s * one.m_y, s * one.m_x + c * one.m_y
        assert other[3:5] == pytest.approx(wanted, rel=1e-9, abs=1e-9)


def test_ribs_stop_one_way_or_both():
    """A spring behind a gap of 3 um: 7 um of 1e8 N/m are 700 N."""
    for side, at, force in ((0, 1e-5, -700), (0, -1e-5, 700), (1, -1e-5, 0), (-1, -1e-5, 700)):
        rings = ROLLERS._replace(side=float(side))
        found = rings.ring_loads(moved((0.0, 0.0, at, 0.0, 0.0)), 0.0, GAPS)
        assert found.f_z == pytest.approx(force, rel=1e-9)


def test_loads_that_nothing_bears_are_refused():
    with pytest.raises(ConvergenceError, match="F_z = 100 N"):
        under(ROLLERS._replace(flange=0.0), 100, 0, 100, 0, 0, gaps=GAPS)
    with pytest.raises(ParameterError, match="5 numbers"):
        under(ROLLERS, 100, 0, gaps=GAPS)
    with pytest.raises(ParameterError, match="F_y must be finite"):
        under(ROLLERS, 100, math.nan, 0, 0, 0, gaps=GAPS)


@each("slope, laminae", product([0.0, 1e-5, -3e-4, 2e-3, -2e-3], [1, 2, 30, 31]))
def test_largest_load_per_length_is_that_of_the_deepest_lamina(slope, laminae):
    """Of one tilted roller at x, against all its laminae."""
    rings, gaps = cylinder_rings(6, 9e-3, 43.5e-3, 13.6e-3, STEEL, laminae=laminae, clearance=1e-5)
    x = 8e-6 if abs(slope) < 1e-3 else 2e-6  # the larger tilts leave the middle apart
    found = rings.ring_loads(moved((x, 0.0, 0.0, 0.0, slope)), 0.0, gaps)
    t = ((np.arange(laminae) + 0.5) / laminae - 0.5) * 13.6e-3
    d = np.array([c * (x + t * slope) - gaps for c in (1.0, 0.5, -0.5, -1.0)])
    q = rings.stiffness * np.maximum(0.0, d) ** (10 / 9)
    assert found.high == pytest.approx(q.max() * laminae / 13.6e-3, rel=1e-9)
    assert found.largest == pytest.approx(q.sum(axis=1).max(), rel=1e-9)
