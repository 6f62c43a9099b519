"""The expansion of the bearing forces of a shaft against the forces themselves."""

import math

import numpy as np
import pytest

from gearlube_core.bearings.bearing_type import N_EXPANSION, ShaftMotion
from gearlube_core.bearings.shaft_expansion import (
    CAGE,
    SUMS,
    expand_shaft_bearings,
    expanded_shaft_forces,
)
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.bearings.tapered_roller_kernels import shaft_bearing_forces
from tests.helpers.each import each

OIL = (0.0171, 2.383e-8)  # Pa s, 1/Pa
WET = TaperedRollerBearing.mohammadpour_2015().with_preload(2500.0).parameters()
DRY = TaperedRollerBearing.mohammadpour_2015(film="off").with_preload(2500.0).parameters()
CLIPPED = TaperedRollerBearing.mohammadpour_2015().with_clearance(1e-6).parameters()
BASE = np.array([3.1e-6, -1.2e-6, 0.7e-6, 1.3e-3, 2.1e-3, -0.9e-3])  # m, m/s
ANGLE, SPEED, F_REF = 0.37, 145.0, 300.0
N = 10 / 9


def forces(q, angle, p):
    """F_r1, F_r2, F_a [N] of both bearings together, and the power lost [W]."""
    F = shaft_bearing_forces(ShaftMotion(*q.tolist(), angle, SPEED), F_REF, *OIL, p)
    return np.array([F[0] + F[3], F[1] + F[4], F[2] + F[5], F[6]])


def expansion(q, angle, p):
    e = np.full(N_EXPANSION, math.nan)
    expand_shaft_bearings(ShaftMotion(*q.tolist(), angle, SPEED), F_REF, *OIL, p, e)
    return e


def expanded(q, angle, p, e):
    return np.array(expanded_shaft_forces(ShaftMotion(*q.tolist(), angle, SPEED), p, e))


def slopes(function, steps):
    """Central differences of function(q), a row for each coordinate."""
    rows = []
    for i, step in enumerate(steps):
        change = np.zeros(6)
        change[i] = step
        rows.append((function(BASE + change) - function(BASE - change)) / (2 * step))
    return np.array(rows)


@each(
    "p", [WET, DRY, CLIPPED, WET._replace(n=1.2), WET._replace(clip=0.0), WET._replace(squeeze=0.0)]
)
@each("angle", [0.0, ANGLE, 4.0])
def test_at_its_base_the_expansion_is_exact(p, angle):
    found = expanded(BASE, angle, p, expansion(BASE, angle, p))
    # 24 loads of up to 1 kN that cancel, summed in another order: a few 1e-16 of 24 kN
    np.testing.assert_allclose(found[:3], forces(BASE, angle, p)[:3], rtol=0, atol=1e-14 * 24e3)
    assert found[3] == pytest.approx(forces(BASE, angle, p)[3], rel=1e-13)


def test_slopes_are_those_of_the_forces_without_film():
    e = expansion(BASE, ANGLE, DRY)
    steps = [1e-9] * 3 + [1e-6] * 3
    found = slopes(lambda q: expanded(q, ANGLE, DRY, e)[:3], steps)
    wanted = slopes(lambda q: forces(q, ANGLE, DRY)[:3], steps)
    # differences: rounding 24e3 x 1e-16/(1e-9 m) of 1e9 N/m and 1e-6 of 1e4 N s/m, both below 1e-8
    for part in (slice(0, 3), slice(3, 6)):
        limit = 1e-8 * np.abs(wanted[part]).max()
        np.testing.assert_allclose(found[part], wanted[part], rtol=0, atol=limit)


def test_film_leaves_the_stiffness_and_changes_the_damping_by_its_squeeze():
    e = expansion(BASE, ANGLE, WET)
    steps = [1e-9] * 3 + [1e-6] * 3
    found = slopes(lambda q: expanded(q, ANGLE, WET, e)[:3], steps)
    wanted = slopes(lambda q: forces(q, ANGLE, WET)[:3], steps)
    # the slopes leave out the squeeze, a damper 0.3 % as strong as the hysteresis, whose change
    # with the approach is (0.5 mm/s)/(1 um 2 pi 300 Hz) x 0.3 % = 1e-5 of the stiffness or less
    np.testing.assert_allclose(found[:3], wanted[:3], rtol=0, atol=1e-5 * np.abs(wanted[:3]).max())
    np.testing.assert_allclose(found[3:], wanted[3:], rtol=0, atol=4e-3 * np.abs(wanted[3:]).max())


def test_turning_of_the_cage_is_followed_exactly_on_a_linear_spring():
    """With n = 1 and no film the forces are linear in everything but the cage angle."""
    p = DRY._replace(n=1.0, kn=5e7, clip=0.0)
    e = expansion(BASE, ANGLE, p)
    for angle in (ANGLE + 0.003, ANGLE + 0.02, ANGLE - 0.02):
        # the series of the turn ends at turn^6/720 = 1e-13 of loads of 0.3 kN
        np.testing.assert_allclose(
            expanded(BASE, angle, p, e)[:3], forces(BASE, angle, p)[:3], rtol=0, atol=1e-9
        )


@each("place", range(6))
def test_power_lost_in_linear_dampers_is_followed_exactly(place):
    """With n = 1 a roller loses the same d g'^2 at any approach: a quadratic form of the rates."""
    p = DRY._replace(n=1.0, kn=5e7, clip=0.0)
    e = expansion(BASE, ANGLE, p)
    q = BASE + np.array([4e-7, -3e-7, 2e-7, 5e-3, -4e-3, 6e-3]) * (np.arange(6) == place)
    for angle in (ANGLE, ANGLE + 0.02):
        power = forces(q, angle, p)[3]
        # rounding of the approaches, and the series of the turn as above
        assert expanded(q, angle, p, e)[3] == pytest.approx(power, rel=1e-9)


def test_error_falls_with_the_square_of_the_distance():
    e = expansion(BASE, ANGLE, DRY)
    direction = np.array([1e-6, 0.7e-6, -0.4e-6, 2e-4, -1e-4, 3e-4])
    errors = []
    for halvings in range(3, 7):
        d = 0.5**halvings
        q, angle = BASE + d * direction, ANGLE + 0.02 * d
        errors.append(np.abs(expanded(q, angle, DRY, e) - forces(q, angle, DRY))[:3])
    # one twentieth of the distance is left, and so of the third order: 2 + 0.1
    np.testing.assert_allclose(np.log2(np.array(errors[:-1]) / errors[1:]), 2.0, atol=0.15)


def test_one_per_cent_of_approach_costs_six_millionths_of_the_force():
    """One side lifted off: F_a = -N_r sin L kn d^n, so the error is n (n - 1)/2 0.01^2."""
    rest = DRY.interference
    axial = 3.0 * rest / DRY.sin_contact
    still = np.array([0.0, 0.0, axial, 0.0, 0.0, 0.0])
    e = np.empty(N_EXPANSION)
    expand_shaft_bearings(ShaftMotion(*still, 0.0, 0.0), F_REF, *OIL, DRY, e)
    moved = still.copy()
    moved[2] += 0.01 * 4.0 * rest / DRY.sin_contact
    found = expanded_shaft_forces(ShaftMotion(*moved, 0.0, 0.0), DRY, e)[2]
    exact = -12 * DRY.sin_contact * DRY.kn * (1.01 * 4.0 * rest) ** N
    assert e[8] > 0.0
    # third order: (2 - n)/3 of one per cent, and n of 1 % as the force grew
    assert (exact - found) / exact == pytest.approx(N * (N - 1) / 2 * 1e-4, rel=0.02)


def test_lost_power_keeps_the_damping_of_the_base():
    """The damping of a roller grows as d^(n-1): one ninth of the relative change is left out."""
    e = expansion(BASE, ANGLE, DRY)
    for d in (0.5, 0.25, 0.125):
        q = BASE + d * np.array([1e-6, 0.7e-6, -0.4e-6, 0.0, 0.0, 0.0])
        # approaches are above 1 um where the load is, so a shift of 1 um changes them by less
        # than 100 %; the cage's share of the rates moves with the shift and is followed
        change = abs(expanded(q, ANGLE, DRY, e)[3] / forces(q, ANGLE, DRY)[3] - 1.0)
        assert change < (N - 1.0) * d


@pytest.mark.parametrize("p", [DRY, WET])
def test_general_exponent_continues_the_line_contact(p):
    """n = 10/9 has its own path; exponents 1e-9 to either side use the general one."""
    line_forces, line = forces(BASE, ANGLE, p), expansion(BASE, ANGLE, p)
    around = [
        (forces(BASE, ANGLE, p._replace(n=N + d)), expansion(BASE, ANGLE, p._replace(n=N + d)))
        for d in (-1e-9, 1e-9)
    ]
    for general_forces, general in around:
        # K changes by 1e-9 ln(1e5 m^-1) = 1.2e-8, and the line path has a relative error of 1e-8
        np.testing.assert_allclose(general_forces, line_forces, rtol=3e-8)
        for part in (slice(0, 6), slice(6, 9), slice(9, 10), slice(10, 16), slice(16, 22)):
            limit = 3e-8 * np.abs(line[part]).max()
            np.testing.assert_allclose(general[part], line[part], rtol=0, atol=limit)


def test_rollers_out_of_contact_have_neither_force_nor_slope():
    p = TaperedRollerBearing.mohammadpour_2015(film="off").with_clearance(20e-6).parameters()
    assert np.all(expansion(BASE, ANGLE, p)[SUMS:CAGE] == 0.0)
    assert np.all(expanded(BASE, ANGLE, p, expansion(BASE, ANGLE, p)) == 0.0)


@each("position", range(6))
def test_a_non_number_in_the_motion_is_not_hidden(position):
    q = BASE.copy()
    q[position] = math.nan
    assert np.all(np.isnan(expanded(q, ANGLE, WET, expansion(q, ANGLE, WET))[:2]))
