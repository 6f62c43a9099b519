"""Friction per unit length of a line: Hertz strip, flash, limits, the long ellipse."""

import math

import pytest
from scipy.integrate import quad

from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.hertz import LARGEST_OVER_MEAN, hertz_ellipse, line_mean_pressure
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.friction.flank import flank_friction
from gearlube_core.friction.flank_data import CONSISTENT, FlankState, contact_geometry
from gearlube_core.friction.line_points import LINE_LOAD_FLOOR, LineState, line_friction
from gearlube_core.friction.mixed_friction import BOUNDARY_SPEED
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import lubricant_state
from tests.helpers.each import each

STEEL = STEEL_MOHAMMADPOUR_2015
SOLID = solid_parameters(STEEL, STEEL)
E_STAR = SOLID.contact_modulus
OIL = lubricant_state(Lubricant.named("mohammadpour_2015").parameters(), 353.15)
SURFACE = SurfaceParameters(sigma=0.5e-6, xi_beta_sigma=0.055, sigma_over_beta=0.001)
SMOOTH = SurfaceParameters(sigma=0.02e-6, xi_beta_sigma=0.055, sigma_over_beta=0.001)
W, R, ROLLING, SLIDING = 1.4e5, 0.01, 2.0, 0.8


def line(
    w: float, rolling: float, sliding: float, surface: SurfaceParameters = SURFACE
) -> LineState:
    return line_friction(w, R, rolling, sliding, OIL, surface, SOLID)


def test_mean_pressure_is_that_of_a_strip_of_semi_elliptical_pressure() -> None:
    p = line_mean_pressure(W, R, E_STAR)
    b, p_0 = W / (2.0 * p), LARGEST_OVER_MEAN * p
    carried = quad(lambda x: p_0 * math.sqrt(1.0 - (x / b) ** 2), -b, b)[0]
    assert carried == pytest.approx(W, rel=1e-9)
    # semi-elliptical pressure flattens a cylinder with p_0 = E* b/(2 R)
    assert p_0 == pytest.approx(0.5 * E_STAR * b / R, rel=1e-14)


def test_a_long_ellipse_has_the_largest_pressure_of_a_line() -> None:
    F, ratio = 2000.0, 3000.0
    b, a, p = hertz_ellipse(R, ratio * R, E_STAR, F)
    # load per length in the middle is pi/2 b p_0 = 3 F/(4 a); the ends cost terms of (b/a)^2 ln
    line_p = line_mean_pressure(0.75 * F / a, R, E_STAR)
    assert LARGEST_OVER_MEAN * line_p == pytest.approx(1.5 * p, rel=1e-3)
    assert a / b > 90.0


def matching_flank(
    radius_ratio: float, sliding: float, surface: SurfaceParameters, p: float
) -> tuple[FlankState, float, LineState, float]:
    """An elliptical flank and the line with the same mean pressure; load of both."""
    geometry = contact_geometry(R, radius_ratio * R, 0.0, E_STAR)
    F = (p / geometry.pressure_coefficient) ** 3
    flank = flank_friction(F, ROLLING, sliding, geometry, OIL, surface, SOLID, CONSISTENT)
    w = 16.0 * R * p**2 / (math.pi * E_STAR)
    return flank, F, line(w, ROLLING, sliding, surface), w


@each("surface", [SURFACE, SMOOTH])
@each("sliding", [0.05, 0.8, -3.0])
def test_line_and_slender_flank_differ_by_their_films_only(
    surface: SurfaceParameters, sliding: float
) -> None:
    flank, F, state, w = matching_flank(2000.0, sliding, surface, 5e8)  # ellipse of ratio 100
    assert state.mean_pressure == pytest.approx(flank.mean_pressure, rel=1e-12)
    # traction falls with 1.74 tau0/p ln h at most; boundary friction by its share in mu, which
    # takes its load from the traction
    ratio = state.film_thickness / flank.film_thickness
    bound = 1.74 * OIL.tau0 / flank.mean_pressure * abs(math.log(ratio))
    bound += abs(state.boundary_friction / w - flank.boundary_friction / F)
    assert abs(state.friction_coefficient - flank.friction_coefficient) <= bound
    assert state.friction_coefficient == pytest.approx(flank.friction_coefficient, rel=0.1)


def test_films_of_line_and_ellipse_part_where_the_ellipse_is_too_slender_for_its_formula() -> None:
    ratios = {}
    loads = {}
    for radius_ratio in (10.0, 100.0, 2000.0):
        flank, loads[radius_ratio], state, _ = matching_flank(radius_ratio, SLIDING, SMOOTH, 5e8)
        ratios[radius_ratio] = state.film_thickness / flank.film_thickness
    # where Chittenden et al. 1985 computed, up to a radius ratio of 10: two regressions with
    # different exponents of G
    assert ratios[10.0] == pytest.approx(1.0, abs=0.15)
    # beyond, their W holds the length: at one pressure the film falls with length^-0.073, which a
    # line cannot know; the side flow still open at 10 is 0.3 %
    for slender in (100.0, 2000.0):
        drift = (loads[slender] / loads[10.0]) ** 0.073
        assert ratios[slender] / ratios[10.0] == pytest.approx(drift, rel=5e-3)
    assert ratios[2000.0] > 1.3


def test_flash_is_that_of_a_moving_strip() -> None:
    state = line(W, ROLLING, 10.0)
    p = state.mean_pressure
    b = W / (2.0 * p)
    q = (state.viscous_friction + state.boundary_friction) * 10.0 / (2.0 * b)
    e_squared = STEEL.conductivity * STEEL.density * STEEL.heat_capacity
    # Jaeger: mean rise under a fast strip (4/3) q [2 b/(pi e^2 u)]^(1/2), half of q to each side
    flash = 4.0 / 3.0 * 0.5 * q * math.sqrt(2.0 * b / (math.pi * e_squared * ROLLING))
    film = q * state.film_thickness / (12.0 * OIL.conductivity)
    # the stationary limit takes part: Peclet number u b/(2 kappa) is 16
    peclet = ROLLING * b * STEEL.density * STEEL.heat_capacity / (2.0 * STEEL.conductivity)
    assert peclet > 5.0
    assert state.temperature_rise == pytest.approx(flash + film, rel=0.05)
    assert state.temperature_rise < flash + film


def test_heat_at_rest_is_that_of_a_long_strip() -> None:
    state = line(W, 1e-6, 1e-3)
    b = W / (2.0 * state.mean_pressure)
    q = (state.viscous_friction + state.boundary_friction) * 1e-3 / (2.0 * b)
    # half of q on a strip 2 b x 200 b of a half-space, in its centre 2 q b/(pi K) (ln 200 + 1);
    # the mean over the width is lower by the variation across it, q b/(pi K) (2 ln 2 - 1)
    K = STEEL.conductivity
    centre = 0.5 * q * 2.0 * b / (math.pi * K) * (math.log(200.0) + 1.0)
    across = 0.5 * q * b / (math.pi * K) * (2.0 * math.log(2.0) - 1.0)
    film = q * state.film_thickness / (12.0 * OIL.conductivity)
    # the round source of 4.7 b and the mean along the strip: a tenth
    assert state.temperature_rise == pytest.approx(centre - across + film, rel=0.1)


def test_friction_vanishes_with_load_without_a_jump() -> None:
    loads = [LINE_LOAD_FLOOR * f for f in (0.0, 1e-6, 0.5, 0.999999, 1.000001, 2.0, 10.0)]
    states = [line(w, ROLLING, SLIDING) for w in loads]
    forces = [s.viscous_friction + s.boundary_friction for s in states]
    assert forces[0] == 0.0
    assert forces == sorted(forces)
    # continuous at the floor: the loads differ by 2e-6
    assert forces[4] == pytest.approx(forces[3], rel=1e-5)
    assert states[4].film_thickness == pytest.approx(states[3].film_thickness, rel=1e-5)


def test_an_open_line_has_no_friction_and_a_finite_film() -> None:
    state = line(-5e3, ROLLING, SLIDING)
    assert state.viscous_friction == state.boundary_friction == state.signed_coefficient == 0.0
    assert math.isfinite(state.film_thickness)


def test_friction_passes_through_zero_with_sliding_linearly() -> None:
    slow = [line(W, ROLLING, s).signed_coefficient for s in (-1e-9, 0.0, 1e-9, 2e-9)]
    assert slow[1] == 0.0
    assert slow[0] == -slow[2]
    # 1e-9 m/s against micrometres per second of the Eyring film: cubic terms below 1e-5
    assert slow[3] == pytest.approx(2.0 * slow[2], rel=1e-5)
    boundary = [line(W, ROLLING, s).boundary_friction for s in (0.5 * BOUNDARY_SPEED, 1.0)]
    assert boundary[0] / boundary[1] == pytest.approx(math.tanh(0.5), rel=1e-12)
