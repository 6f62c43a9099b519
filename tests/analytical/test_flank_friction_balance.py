"""Flank friction put together by hand from the published equations."""

import math

import pytest
from scipy.integrate import quad
from scipy.special import ellipe, erfc

from gearlube_core.contact.greenwood_tripp_1971 import (
    SurfaceParameters,
    asperity_area,
    asperity_load,
)
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.dynamics.packed_mesh import PRESSURE, R_E
from gearlube_core.friction.flank import LOAD_FLOOR, flank_friction
from gearlube_core.friction.flank_data import (
    AS_PRINTED,
    CONSISTENT,
    PRINTED_TRACTION,
    ZHOU_HOEPRICH_SHARE,
    FlankState,
    contact_geometry,
)
from gearlube_core.friction.flank_laws import PrintedTraction
from gearlube_core.friction.mixed_friction import BOUNDARY_SPEED, contact_temperature_rise
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import lubricant_state
from tests.helpers.axle_cases import axle_with
from tests.helpers.each import each
from tests.references.hertz_reference import HertzContact

STEEL = STEEL_MOHAMMADPOUR_2015
SOLID = solid_parameters(STEEL, STEEL)
E_STAR = SOLID.contact_modulus
SURFACE = SurfaceParameters(sigma=0.5e-6, xi_beta_sigma=0.055, sigma_over_beta=0.001)
OIL = lubricant_state(Lubricant.named("mohammadpour_2015").parameters(), 368.15)
R_X, R_Y, PSI = 0.011, 0.6, 0.3
GEOMETRY = contact_geometry(R_X, R_Y, PSI, E_STAR)
LOAD, ROLLING, SLIDING = 1200.0, 3.0, 2.0


def flank(load: float, rolling: float, sliding: float, form: int = CONSISTENT) -> FlankState:
    return flank_friction(load, rolling, sliding, GEOMETRY, OIL, SURFACE, SOLID, form)


class ByHand:
    """Eq. (13)-(22) of Mohammadpour et al. 2015 in plain Python; printed = as the paper has it.

    `traction` is what stands for beta in (13), by default what `printed` says [1/K]; `circular`:
    pressure of the circle that replaces the ellipse, Karagiannis et al. 2012 (21).
    """

    def __init__(
        self, *, printed: bool, traction: float | None = None, circular: bool = False
    ) -> None:
        E_reduced = 2.0 * E_STAR
        p = HertzContact(R_x=R_X, R_y=R_Y, contact_modulus=E_STAR, load=LOAD).mean_pressure
        if circular:
            R = math.sqrt(R_X * R_Y)
            p = LOAD / (math.pi * (0.75 * LOAD * R / E_STAR) ** (2.0 / 3.0))
        area = LOAD / p
        R_e = 1.0 / (math.cos(PSI) ** 2 / R_X + math.sin(PSI) ** 2 / R_Y)
        R_s = 1.0 / (math.sin(PSI) ** 2 / R_X + math.cos(PSI) ** 2 / R_Y)
        U, G, W = (
            OIL.eta0 * ROLLING / (E_reduced * R_e),
            OIL.alpha * E_reduced,
            LOAD / (E_reduced * R_e**2),
        )
        side = 1.0 - math.exp(-1.23 * (R_s / R_e) ** (2.0 / 3.0))
        self.h = h = 4.31 * R_e * U**0.68 * G**0.49 * W**-0.073 * side
        l = h / SURFACE.sigma  # noqa: E741
        if printed:
            F_52 = sum(
                c * l**n for n, c in enumerate((0.617, -1.078, 0.784, -0.296, 0.057, -0.004))
            )
            F_2 = sum(c * l**n for n, c in enumerate((0.5, -0.804, 0.526, -0.173, 0.028, -0.002)))
        else:
            tail = quad(lambda s: (s - l) ** 2.5 * math.exp(-0.5 * s * s), l, 12.0, epsrel=1e-11)
            F_52 = tail[0] / math.sqrt(2.0 * math.pi)
            F_2 = 0.5 * (1.0 + l * l) * erfc(l / math.sqrt(2.0)) - 0.5 * l * math.sqrt(
                2.0 / math.pi
            ) * math.exp(-0.5 * l * l)
        modulus = E_reduced if printed else E_STAR
        load_factor = 16.0 * math.sqrt(2.0) / 15.0 * math.pi * 0.055**2 * math.sqrt(0.001)
        W_a = load_factor * modulus * area * F_52
        A_a = math.pi**2 * 0.055**2 * area * F_2
        beta = traction or (1.0 if printed else OIL.beta)
        e2 = STEEL.conductivity * STEEL.density * STEEL.heat_capacity
        film_resistance = OIL.conductivity / (h / R_e)
        zeta = 4.0 / math.pi * film_resistance * (p / (E_reduced * R_e * e2 * ROLLING)) ** 0.5
        root = math.sqrt(2.0 * OIL.conductivity * OIL.eta0 / (beta * (1.0 + 9.6 * zeta)))
        mu = 0.87 * OIL.alpha * OIL.tau0 + 1.74 * OIL.tau0 / p * math.log(
            1.2 / (OIL.tau0 * h) * root
        )
        self.f_v = mu * (LOAD if printed else LOAD - W_a)
        self.f_b = OIL.tau_l0 * A_a + OIL.gamma * W_a
        b = 16.0 / math.pi * p * R_e / E_reduced
        q = (self.f_v + self.f_b) * SLIDING / area
        flash = 4.0 / 3.0 * 0.5 * q * math.sqrt(2.0 * b / (math.pi * e2 * ROLLING))
        self.dT = flash + q * h / (12.0 * OIL.conductivity)


@pytest.mark.parametrize("form", [CONSISTENT, AS_PRINTED])
def test_friction_of_a_loaded_flank_agrees_with_the_equations_by_hand(form: int) -> None:
    state, expected = flank(LOAD, ROLLING, SLIDING, form), ByHand(printed=form == AS_PRINTED)
    assert state.film_thickness == pytest.approx(expected.h, rel=1e-12)
    assert state.film_ratio == pytest.approx(expected.h / 0.5e-6, rel=1e-12)
    assert state.viscous_friction == pytest.approx(expected.f_v, rel=1e-10)
    # interpolated asperity integrals, 1e-8
    assert state.boundary_friction == pytest.approx(expected.f_b, rel=1e-8)
    total = expected.f_v + expected.f_b
    assert state.friction_coefficient == pytest.approx(total / LOAD, rel=1e-9)
    # the stationary limit takes off (m/s)^2/2 = 0.1 % of the flash at a Peclet number of 20
    assert state.temperature_rise == pytest.approx(expected.dT, rel=2e-3)


def test_printed_traction_at_circular_pressure_agrees_with_the_equations_by_hand() -> None:
    law = PrintedTraction()(SURFACE, SOLID)
    R = math.sqrt(R_X * R_Y)
    circle = 1.0 / (math.pi * (0.75 * R / E_STAR) ** (2.0 / 3.0))
    geometry = GEOMETRY._replace(pressure_coefficient=circle)
    state = law.flank_state(LOAD, ROLLING, SLIDING, geometry, OIL)
    expected = ByHand(printed=False, traction=1.0, circular=True)
    assert state.film_thickness == pytest.approx(expected.h, rel=1e-12)
    assert state.viscous_friction == pytest.approx(expected.f_v, rel=1e-8)  # as W_a
    # interpolated asperity integrals, 1e-8
    assert state.boundary_friction == pytest.approx(expected.f_b, rel=1e-8)


@pytest.mark.parametrize("friction", ["printed_traction_circular", "as_printed"])
def test_only_the_circular_reading_gives_the_axle_the_pressure_of_a_circle(friction: str) -> None:
    parameters = axle_with(friction=friction)
    packed = parameters.packed_mesh()
    # first node of the first level of load
    R_x, R_y = (parameters.mesh.windows[name][0, 0] for name in ("R_x", "R_y"))
    if friction == "printed_traction_circular":
        expected = 1.0 / (math.pi * (0.75 * math.sqrt(R_x * R_y) / E_STAR) ** (2.0 / 3.0))
    else:
        expected = HertzContact(R_x=R_x, R_y=R_y, contact_modulus=E_STAR, load=1.0).mean_pressure
    # scipy's elliptic integrals near m = 1
    assert packed.windows[PRESSURE] == pytest.approx(expected, rel=1e-11)
    assert packed.windows[R_E] == axle_with().packed_mesh().windows[R_E]


def test_printed_form_has_less_viscous_and_more_boundary_friction() -> None:
    consistent, printed = flank(LOAD, ROLLING, SLIDING), flank(LOAD, ROLLING, SLIDING, AS_PRINTED)
    assert printed.viscous_friction < consistent.viscous_friction
    # E' = 2 E*; the polynomials are within 1 % at a film ratio of 0.74
    assert printed.boundary_friction / consistent.boundary_friction == pytest.approx(2.0, rel=0.02)


def test_friction_is_even_in_the_direction_of_sliding_and_rolling() -> None:
    assert flank(LOAD, -ROLLING, SLIDING) == flank(LOAD, ROLLING, SLIDING)
    assert flank(LOAD, ROLLING, -SLIDING) == flank(LOAD, ROLLING, SLIDING)


def test_film_and_asperities_of_the_share_carry_the_load_once_between_them() -> None:
    """f_v = mu F (1 - s), f_b = gamma F s + tau A_a, s = exp(-2.32 Lambda^0.97)."""
    plain = flank(LOAD, ROLLING, SLIDING)
    state = flank(LOAD, ROLLING, SLIDING, ZHOU_HOEPRICH_SHARE)
    area = LOAD / state.mean_pressure
    of_law = asperity_load(plain.film_ratio, area, E_STAR, SURFACE)
    junctions = OIL.tau_l0 * asperity_area(plain.film_ratio, area, SURFACE)
    mu = plain.viscous_friction / (LOAD - of_law)  # of the same film
    share = math.exp(-2.32 * plain.film_ratio**0.97)
    assert 0.05 < share < 0.5  # mixed
    assert state.viscous_friction == pytest.approx(mu * LOAD * (1.0 - share), rel=1e-12)
    expected = OIL.gamma * LOAD * share + junctions
    assert state.boundary_friction == pytest.approx(expected, rel=1e-8)  # asperity integrals


def test_without_a_film_asperities_carry_all_load_by_the_share_and_little_by_the_usual_law() -> (
    None
):
    creep, slip = 1e-7, 10.0 * BOUNDARY_SPEED
    state = flank(LOAD, creep, slip, ZHOU_HOEPRICH_SHARE)
    assert state.film_ratio < 1e-4  # the share is 1 to 2.32 (1e-4)^0.97 = 3e-4
    assert state.boundary_friction >= OIL.gamma * LOAD * (1.0 - 3e-4)
    assert state.viscous_friction < 1e-3 * state.boundary_friction
    usual = flank(LOAD, creep, slip)
    # (16 sqrt 2/15) pi 0.055^2 0.001^0.5 115.4 GPa 0.617 = 32 MPa, the integral at 0
    assert usual.boundary_friction < OIL.gamma * 33e6 * LOAD / usual.mean_pressure + 0.02 * LOAD
    fast = flank(LOAD, 300.0, SLIDING, ZHOU_HOEPRICH_SHARE)
    assert fast.film_ratio > 10.0  # asperities carry 1e-9
    assert fast.viscous_friction == pytest.approx(
        flank(LOAD, 300.0, SLIDING).viscous_friction, rel=1e-8
    )


@each("form", [CONSISTENT, AS_PRINTED, PRINTED_TRACTION, ZHOU_HOEPRICH_SHARE])
def test_an_unloaded_flank_has_no_friction(form: int) -> None:
    for load in (0.0, -100.0):
        state = flank(load, ROLLING, SLIDING, form)
        assert state[2:6] == (0.0, 0.0, 0.0, 0.0)
        assert state.film_thickness == flank(LOAD_FLOOR, ROLLING, SLIDING, form).film_thickness


@each("form", [CONSISTENT, AS_PRINTED, PRINTED_TRACTION])
def test_friction_grows_linearly_from_rest(form: int) -> None:
    assert flank(LOAD, ROLLING, 0.0, form)[2:6] == (0.0, 0.0, 0.0, 0.0)
    one, two = flank(LOAD, ROLLING, 1e-9, form), flank(LOAD, ROLLING, 2e-9, form)
    # asinh(x) with x of 1e-3 and tanh with 1e-6: x^2/6
    assert two.viscous_friction == pytest.approx(2.0 * one.viscous_friction, rel=1e-5)
    assert two.boundary_friction == pytest.approx(2.0 * one.boundary_friction, rel=1e-9)


def test_boundary_friction_is_complete_at_a_few_times_its_build_up_speed() -> None:
    full = flank(LOAD, ROLLING, SLIDING).boundary_friction
    part = flank(LOAD, ROLLING, BOUNDARY_SPEED).boundary_friction
    assert part == pytest.approx(math.tanh(1.0) * full, rel=1e-13)
    # tanh(20) is 1 to rounding: no step where the factor is left out
    below = flank(LOAD, ROLLING, 19.9999 * BOUNDARY_SPEED).boundary_friction
    assert below == pytest.approx(full, rel=1e-14)


def test_friction_vanishes_continuously_with_load() -> None:
    loads = [LOAD_FLOOR * f for f in (1e-3, 0.5, 0.999999, 1.000001, 2.0)]
    friction = [sum(flank(load, ROLLING, SLIDING)[2:4]) for load in loads]
    assert friction == sorted(friction)
    # either side of the floor: 2e-6 apart in load
    assert friction[3] == pytest.approx(friction[2], rel=1e-5)


def test_a_flank_at_rest_keeps_a_finite_state() -> None:
    state = flank(LOAD, 0.0, 1.0)
    assert all(math.isfinite(value) for value in state)
    # without rolling all heat spreads from the contact: some hundred kelvin per m/s
    assert state.temperature_rise < 1000.0


def test_slow_contacts_heat_up_like_a_stationary_round_source() -> None:
    area, K_solid, q = 1.7e-6, 46.0, 1e7
    r = math.sqrt(area / math.pi)
    # T(x) = 2 q r E(x^2)/(pi K) over the disc, half of the heat to each surface
    scale = 2.0 * r / (math.pi * K_solid)
    mean = quad(lambda x: 2.0 * x * scale * ellipe(x * x), 0.0, 1.0, epsabs=0.0)[0]
    # a resistance of 1 m2 K/W stands for no rolling: (s/m)^2 is 1e-10
    rise = contact_temperature_rise(q, 0.0, area, 1.0, 0.14, K_solid)
    assert rise == pytest.approx(0.5 * q * mean, rel=1e-9)


def test_film_alone_heats_up_like_a_slab_with_uniform_sources() -> None:
    q, h, K = 1e8, 5e-7, 0.14
    # dT(z) = (q/h) (h^2/4 - z^2)/(2 K)
    mean = quad(lambda z: q / h * (0.25 * h * h - z * z) / (2.0 * K), -h / 2, h / 2)[0] / h
    assert contact_temperature_rise(q, h, 1e-6, 0.0, K, 46.0) == pytest.approx(mean, rel=1e-12)


def test_pressure_of_the_state_is_the_mean_hertz_pressure() -> None:
    expected = HertzContact(R_x=R_X, R_y=R_Y, contact_modulus=E_STAR, load=LOAD).mean_pressure
    # scipy's elliptic integrals near m = 1
    assert flank(LOAD, ROLLING, SLIDING).mean_pressure == pytest.approx(expected, rel=1e-11)


def test_rough_thin_film_loads_the_asperities_but_never_more_than_the_flank() -> None:
    coarse = SurfaceParameters(sigma=5e-6, xi_beta_sigma=0.2, sigma_over_beta=0.05)
    state = flank_friction(50.0, 0.01, 0.5, GEOMETRY, OIL, coarse, SOLID, CONSISTENT)
    area = 50.0 / state.mean_pressure
    ceiling = OIL.gamma * 50.0 + OIL.tau_l0 * area
    assert state.viscous_friction == 0.0
    assert OIL.gamma * 50.0 <= state.boundary_friction <= ceiling
