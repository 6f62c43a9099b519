"""Roller loads, forces and energy of the dynamic bearings against closed forms."""

import itertools
import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.ninth_root import (
    ROOT_MAX,
    ROOT_MIN,
    ninth_root,
    ninth_root_change,
)
from gearlube_core.bearings.parameters import FILM_FLOOR_APPROACH, FILM_RANGE, cage_torque
from gearlube_core.bearings.roller_contact import (
    N_LINE,
    approach_with_film,
    film_amplitude,
    roller_load_general,
    roller_load_line,
    roller_response_general,
    roller_response_line,
)
from gearlube_core.bearings.roller_loads import bearing_forces, roller_loads
from gearlube_core.bearings.shaft_expansion import roller_energy, shaft_bearing_energy
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.bearings.tapered_roller_kernels import shaft_bearing_forces
from gearlube_core.film.mostofi_gohar_1983 import central_film
from tests.helpers.each import each

OIL = (0.0171, 2.383e-8)  # Pa s, 1/Pa
BEARING = TaperedRollerBearing.mohammadpour_2015().with_preload(2500.0)
DRY = TaperedRollerBearing.mohammadpour_2015(film="off").with_preload(2500.0).parameters()
WET = BEARING.parameters()
U = (3.1e-6, -1.2e-6, 0.7e-6)
V = (1.3e-3, 2.1e-3, -0.9e-3)
ANGLE, SPEED, F_REF = 0.37, 145.0, 300.0
MOTION = ShaftMotion(*U, *V, ANGLE, SPEED)


def total(forces):
    return np.array(forces[0:3]) + np.array(forces[3:6])


def by_hand(u, v, p, angle, speed, f_ref):
    """Eq. (24)-(26) written out, dry."""
    out = np.zeros((2, 3))
    for k, s in enumerate((1.0, -1.0)):
        for i in range(12):
            th = angle + 2 * math.pi * i / 12
            e = np.array([math.cos(th), math.sin(th), 0.0]) * p.cos_contact
            e[2] = s * p.sin_contact
            turn = np.array([-math.sin(th), math.cos(th), 0.0]) * p.cos_contact
            d = p.interference + float(e @ u)
            d_rate = float(e @ v) + p.cage_ratio * speed * float(turn @ u)
            if d > 0:
                w = p.kn * d**p.n + 0.009 * p.n * p.kn * d ** (p.n - 1) * d_rate / f_ref
                out[k] -= max(w, 0.0) * e
    return out.ravel()


def test_ninth_root_agrees_with_the_power_function():
    x = np.geomspace(ROOT_MIN, ROOT_MAX, 20001)
    root = np.array([ninth_root(a) for a in x])
    # 3e-15: a few roundings of 2.2e-16
    assert np.max(np.abs(root / x ** (1 / 9) - 1)) < 3e-15
    u = np.linspace(-0.05, 0.05, 1001)
    change = np.array([ninth_root_change(a) for a in u])
    # 0.012 u^7, the first term left out
    assert np.max(np.abs(change - np.expm1(np.log1p(u) / 9))) < 0.012 * 0.05**7 * 1.2


def test_forces_are_the_printed_sums():
    forces = shaft_bearing_forces(MOTION, F_REF, *OIL, DRY)
    # 1e-13 of the largest: 24 sums of rounding errors
    expected = by_hand(np.array(U), np.array(V), DRY, ANGLE, SPEED, F_REF)
    assert np.allclose(forces[:6], expected, rtol=0, atol=1e-13 * np.abs(expected).max())


def test_one_bearing_and_the_opposed_pair_agree():
    for p in (DRY, WET, WET._replace(n=1.5, kn=1e10)):
        args = (MOTION, F_REF, *OIL, p)
        pair = shaft_bearing_forces(*args)
        one, two = bearing_forces(*args, 1.0), bearing_forces(*args, -1.0)
        # rounding of sums in a different order
        assert np.allclose(pair[:6], [*one[:3], *two[:3]], rtol=1e-12, atol=0)
        assert pair[6] == pytest.approx(one[3] + two[3], rel=1e-11)


def test_written_roller_loads_add_up_to_the_force():
    out = np.full(14, -1.0)
    args = (MOTION, F_REF, *OIL, WET)
    for k, s in enumerate((1.0, -1.0)):
        assert roller_loads(*args, s, out) == 0
        th = ANGLE + 2 * np.pi * np.arange(12) / 12
        w = out[:12]
        F = np.array(shaft_bearing_forces(*args)[3 * k : 3 * k + 3])
        sums = [
            -np.sum(w * np.cos(th)) * WET.cos_contact,
            -np.sum(w * np.sin(th)) * WET.cos_contact,
            -s * np.sum(w) * WET.sin_contact,
        ]
        # rounding of sums in a different order
        assert pytest.approx(sums, rel=1e-12) == F
    assert np.all(out[12:] == -1.0)
    assert roller_loads(*args, 1.0, out[:11]) == 1


@each("film", [0.0, 0.2, 0.8, 2.0])
def test_fast_load_of_a_line_contact_agrees_with_the_iterated_one(film):
    K, c = 40.0, 3e-5
    for g, rate in itertools.product(np.linspace(-2.0, 250.0, 401), (-4e3, 0.0, 300.0)):
        fast = roller_load_line(g, rate, film, 3e-5, K, c, -math.inf)
        exact = roller_load_general(g, rate, film, 3e-5, K, c, -math.inf, N_LINE)
        # fit of d^-0.05 (1.6e-8) times H/d; a film of 2 is 1 um, thick oil at low load
        tolerance = 1e-13 if film == 0.0 else 2.5e-8 * film
        assert fast[1] == pytest.approx(exact[1], rel=tolerance, abs=K * 1e-13)
        # hysteresis and squeeze: the rate of the film is expanded to second order
        extra = exact[0] - exact[1]
        assert fast[0] - fast[1] == pytest.approx(extra, rel=1e-11 + 2e-5 * film, abs=1e-10)


def test_force_is_the_gradient_of_the_energy():
    h = 4e-8
    for p in (DRY, WET, DRY._replace(approach_factor=0.5), WET._replace(n=1.5, kn=1e10)):
        still = p._replace(loss=0.0, squeeze=0.0)
        forces = total(
            shaft_bearing_forces(ShaftMotion(*U, 0.0, 0.0, 0.0, ANGLE, SPEED), F_REF, *OIL, still)
        )
        for k in range(3):
            value = []
            for step in (-2, -1, 1, 2):
                u = list(U)
                u[k] += step * h
                value.append(shaft_bearing_energy(*u, ANGLE, SPEED, *OIL, p))
            gradient = (value[0] - 8 * value[1] + 8 * value[2] - value[3]) / (12 * h)
            # fourth-order differences: rounding of V (0.07 J x 1e-16 / h), film solved to 1e-9
            assert forces[k] == pytest.approx(-gradient, rel=2e-8, abs=2e-5)


def test_roller_energy_is_the_work_of_its_load():
    for film, n in itertools.product((0.0, 0.8), (N_LINE, 1.5)):
        for g in (-0.5, 0.1, 5.0, 1.3 * FILM_RANGE):
            contact = -film

            def load(z, film=film, n=n):
                return max(approach_with_film(z, film, n), 0.0) ** n

            kinks = [z for z in (1.0 - film, FILM_RANGE - film * FILM_RANGE**-0.05) if z < g]
            work = quad(load, contact, g, points=kinks or None, limit=400, epsabs=0, epsrel=1e-11)[
                0
            ]
            # 1e-9: adaptive quadrature across the root at contact
            assert roller_energy(g, film, n) == pytest.approx(work, rel=1e-9, abs=1e-12)


def test_energy_given_up_is_work_on_the_shaft_the_cage_and_the_rollers():
    """dV/dt = -F.v - T_c cage_speed - lost power, including unloaded rollers."""
    for p, u in itertools.product(
        (DRY, WET._replace(squeeze=0.0), WET, DRY._replace(clip=0.0)),
        (U, (8e-6, 2e-6, 4e-6)),
    ):
        *F, lost = shaft_bearing_forces(ShaftMotion(*u, *V, ANGLE, SPEED), F_REF, *OIL, p)
        force = total(F)
        cage_speed = p.cage_ratio * SPEED
        h = 2e-6
        V_t = [
            shaft_bearing_energy(
                *(np.array(u) + t * np.array(V)), ANGLE + t * cage_speed, SPEED, *OIL, p
            )
            for t in (-2 * h, -h, h, 2 * h)
        ]
        rate = (V_t[0] - 8 * V_t[1] + 8 * V_t[2] - V_t[3]) / (12 * h)
        work = force @ np.array(V) + cage_speed * cage_torque(u[0], u[1], force[0], force[1])
        # differences of a 0.1 J energy over 2 us against powers of several W
        assert rate + work + lost == pytest.approx(0.0, abs=1e-6 * np.abs(work))
        assert lost > 0.0


def test_forces_vanish_by_symmetry_at_rest_and_preload_is_carried():
    *F, lost = shaft_bearing_forces(ShaftMotion(*6 * [0.0], ANGLE, 0.0), F_REF, *OIL, WET)
    # rounding of a sum of 2500 N
    assert np.array(F) == pytest.approx([0, 0, -2500.0, 0, 0, 2500.0], abs=1e-9)
    assert lost == 0.0


def test_opposed_bearings_mirror_each_other():
    one = shaft_bearing_forces(MOTION, F_REF, *OIL, WET)
    mirrored = (U[0], U[1], -U[2], V[0], V[1], -V[2])
    two = shaft_bearing_forces(ShaftMotion(*mirrored, ANGLE, SPEED), F_REF, *OIL, WET)
    # the same numbers in another place
    assert two[0:2] == pytest.approx(one[3:5], rel=1e-13)
    assert two[2] == pytest.approx(-one[5], rel=1e-13)


def test_turning_shaft_and_rollers_together_turns_the_force():
    turn = 0.8
    Q = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    one = total(shaft_bearing_forces(MOTION, F_REF, *OIL, WET))
    u, v = Q @ U[:2], Q @ V[:2]
    turned = ShaftMotion(*u.tolist(), U[2], *v.tolist(), V[2], ANGLE + turn, SPEED)
    two = total(shaft_bearing_forces(turned, F_REF, *OIL, WET))
    # rounding
    assert two[:2] == pytest.approx(Q @ one[:2], rel=1e-12)
    assert two[2] == pytest.approx(one[2], rel=1e-10)


def test_film_in_the_roller_equation_is_mostofi_and_gohar():
    """The approach g + H carries the load at which eq. (27) gives that H."""
    p = WET._replace(squeeze=0.0, loss=0.0)
    out = np.zeros(12)
    roller_loads(ShaftMotion(*6 * [0.0], ANGLE, SPEED), F_REF, *OIL, p, 1.0, out)
    ri, ro, r = 25e-3, 37.7e-3, 6.35e-3
    E_r = math.pi * 210e9 / (2 * (1 - 0.3**2))
    u = SPEED * ri * ro / (ri + ro)

    def excess(w):
        H = central_film(w, u, 0.0, *OIL, r, E_r)
        return 5e8 * (p.interference + H) ** (10 / 9) - w

    # 1e-8: the fit of the film's load factor
    assert out[0] == pytest.approx(brentq(excess, 100.0, 2000.0, rtol=1e-14), rel=1e-8)


def test_squeeze_changes_the_film_by_about_a_ten_thousandth():
    """A shaft 5 um off centre at 145 rad/s: the film is a memoryless function of the load."""
    film, scale = film_amplitude(SPEED, *OIL, WET)
    g = WET.interference / FILM_FLOOR_APPROACH
    x = approach_with_film(g, film, N_LINE)
    d_rate = 5e-6 * WET.cage_ratio * SPEED
    v = -0.045 * N_LINE * (x - g) / x * d_rate
    u = WET.film_speed_radius * SPEED
    change = (1 - 0.75 * math.exp(132 * v / u)) / 0.25 - 1
    assert v / u == pytest.approx(-3e-7, rel=0.3)  # order of magnitude
    assert 0.5e-4 < change < 2e-4
    rate = d_rate / FILM_FLOOR_APPROACH
    K = WET.kn * FILM_FLOOR_APPROACH**N_LINE
    with_squeeze, steady = roller_load_line(g, rate, film, scale, K, 0.0, 0.0)
    # load gained: n w change H/d to first order; 1e-2 covers the slope of the film
    assert with_squeeze / steady - 1 == pytest.approx(N_LINE * change * (x - g) / x, rel=1e-2)
    hysteresis = roller_load_line(g, rate, film, 0.0, K, 0.009 / F_REF, 0.0)[0] - steady
    # it acts as a damper 0.3 % as strong as the hysteresis
    assert (with_squeeze - steady) / hysteresis == pytest.approx(3e-3, rel=0.3)


@each(
    ("respond", "edge"),
    [
        (roller_response_line, 0.0),
        (roller_response_line, 1.0),
        (roller_response_line, FILM_RANGE),
        (roller_response_general, 1.0),
        (roller_response_general, FILM_RANGE),
    ],
)
def test_a_moving_roller_has_no_jump_where_its_film_begins_or_ends_to_give_way(respond, edge):
    """The slope of the film jumps at both limits, and damping begins where the races touch."""
    film, scale = film_amplitude(SPEED, *OIL, WET)
    exponent = () if respond is roller_response_line else (N_LINE,)
    K, c, rate = WET.kn * FILM_FLOOR_APPROACH**N_LINE, 0.009 / F_REF, 3e3  # 1.5 mm/s

    def load(g):
        return respond(g, rate, film, scale, K, c, 0.0, *exponent)[0]

    at = edge - film * (min(edge, FILM_RANGE) ** -0.05 if edge > 0.0 else 1.0)
    moved = 1e-7 * max(edge, 1e-3)
    jump = abs(load(at + moved) - load(at - moved))
    # the slope of the load times the move of 2e-7, and the fit of the film's load factor
    assert jump <= 3e-7 * load(at + 0.5)


def test_slopes_of_a_roller_over_its_rate_are_those_of_its_load():
    film, scale = film_amplitude(SPEED, *OIL, WET)
    K, c = WET.kn * FILM_FLOOR_APPROACH**N_LINE, 0.009 / F_REF
    for respond, exponent in ((roller_response_line, ()), (roller_response_general, (N_LINE,))):
        for g, rate in ((0.6, 2e3), (8.0, -3e3), (30.0, 1e5)):
            ends = [
                respond(g, rate * (1.0 + d), film, scale, K, c, 0.0, *exponent)[0]
                for d in (1e-4, -1e-4)
            ]
            slope = respond(g, rate, film, scale, K, c, 0.0, *exponent)[3]
            # the share of the squeeze is 0.3 %: 1e-5 tells whether it is in; rounding is 1e-8
            assert slope == pytest.approx((ends[0] - ends[1]) / (2e-4 * rate), rel=1e-5)


def test_halved_approach_halves_the_stiffness():
    h = 1e-9
    slopes = []
    for p in (DRY, DRY._replace(approach_factor=0.5)):
        F = [
            total(shaft_bearing_forces(ShaftMotion(s * h, *7 * [0.0]), F_REF, *OIL, p))[0]
            for s in (1, -1)
        ]
        slopes.append((F[0] - F[1]) / h)
    # rounding of a difference of 1e-6 N in sums of 2500 N
    assert slopes[1] / slopes[0] == pytest.approx(0.5, rel=1e-6)


def test_rollers_pull_only_in_the_printed_form():
    out = np.zeros(12)
    fast = (ShaftMotion(0.0, 0.0, 0.0, -0.5, 0.0, 0.0, 0.0, 0.0), F_REF, *OIL)
    roller_loads(*fast, DRY, 1.0, out)
    assert np.min(out) == 0.0
    roller_loads(*fast, DRY._replace(clip=0.0), 1.0, out)
    assert np.min(out) < -100.0


def test_nan_in_any_input_reaches_the_forces():
    good = [*MOTION, F_REF]
    for k in range(len(good)):
        bad = list(good)
        bad[k] = math.nan
        assert math.isnan(sum(shaft_bearing_forces(ShaftMotion(*bad[:-1]), bad[-1], *OIL, WET)[:6]))


def test_loads_stay_finite_and_continuous_through_contact():
    K = 40.0
    g = np.linspace(-0.8 - 1e-6, -0.8 + 1e-6, 2001)
    w = np.array([roller_load_line(a, 0.0, 0.8, 0.0, K, 0.0, 0.0)[0] for a in g])
    assert np.all(np.isfinite(w))
    assert w[0] == 0.0
    # the load at 1e-6 of the floor approach is 40 x 1e-6 x (1e-6)^(1/9); it grows from zero
    assert np.all(np.diff(w) >= 0.0)
    assert 0.0 < w[-1] < 40e-6
