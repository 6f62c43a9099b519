"""A flank with films from the model of solved films: domain, border, outside, bounds, energy."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.contact.greenwood_tripp_1971 import gear_flanks
from gearlube_core.contact.hertz import ellipticity, hertz_coefficients
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.dynamics.hypoid_axle import HypoidAxle, mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_axle.losses import axle_losses
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.groups import FilmContact
from gearlube_core.film_model.model import FilmModel
from gearlube_core.film_model.solved_film import solved_film
from gearlube_core.friction.flank_data import contact_geometry
from gearlube_core.friction.flank_film import FlankEllipse, flank_film_model
from gearlube_core.friction.flank_laws import (
    FORMULA_FILM_BOUND,
    FORMULA_FRICTION_TOP,
    SOLVED,
    Consistent,
    solved_flank_friction,
)
from gearlube_core.friction.mixed_friction import FormulaBounds, formula_error
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import lubricant_state
from tests.helpers.axle_cases import OIL as AXLE_OIL
from tests.helpers.axle_cases import operating_point
from tests.helpers.each import each

TEMPERATURE = 368.15
OIL = lubricant_state(Lubricant.named("mohammadpour_2015").parameters(), TEMPERATURE)
SOLID = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
R_X, R_Y, PSI, DELTA = 0.0125, 1.0, 0.85, 0.4
SPEED, SLIP = 5.0, 3.6
GEOMETRY = contact_geometry(R_X, R_Y, PSI, SOLID.contact_modulus)
ELLIPSE = FlankEllipse(R_X, R_Y, ellipticity(R_Y / R_X), PSI, DELTA)
MODEL = FilmModel.named("hypoid_flank")
ROUGH = gear_flanks(0.5e-6)
FORMULA = Consistent()(ROUGH, SOLID)
LAW = FORMULA._replace(film=float(SOLVED))


def solved(load, *, slip=SLIP, slope=0.0):
    """State of the flank with its bounds."""
    law, numbers = LAW._replace(limiting_slope=slope), flank_film_model(MODEL)
    film = law.model_film(load, SPEED, slip, GEOMETRY, ELLIPSE, OIL, numbers)
    return law.bounded_flank(load, SPEED, slip, GEOMETRY, film, OIL, numbers)


def formula(load, slip=SLIP):
    return FORMULA.flank_state(load, SPEED, slip, GEOMETRY, OIL)


def model_film(load):
    """The film model itself, from its plain numbers."""
    contact = FilmContact(
        load, SOLID.contact_modulus, R_X, R_Y, ELLIPSE.ellipticity,
        hertz_coefficients(R_X, R_Y, SOLID.contact_modulus)[2], SPEED, PSI, SLIP, DELTA,
        OIL.eta0, OIL.alpha, OIL.beta, OIL.tau0, 0.0, 0.0, TEMPERATURE, OIL.conductivity,
        870.0 * 2000.0, SOLID.conductivity, SOLID.density * SOLID.heat_capacity,
    )  # fmt: skip
    return solved_film(MODEL.copied_numbers(), contact)


def test_inside_the_domain_film_and_oil_friction_are_those_of_the_model():
    found, model = solved(2000.0), model_film(2000.0)
    assert (found.outside, model.outside) == (0.0, 0.0)
    # through a logarithm and back: a few roundings
    assert found.state.film_thickness == pytest.approx(model.central_film, rel=1e-12)
    film_ratio = model.central_film / 0.5e-6
    assert found.state.film_ratio == pytest.approx(film_ratio, rel=1e-12)
    # asperities carry some per cent and take that off the film: viscous <= mu F
    mu = found.state.viscous_friction / 2000.0
    assert 0.9 * model.friction_coefficient < mu < model.friction_coefficient
    # and the film is thinner and the oil's friction lower than by the formulas
    assert found.state.film_thickness < formula(2000.0).film_thickness
    assert found.state.viscous_friction < formula(2000.0).viscous_friction


def test_a_thinner_film_leaves_more_load_to_asperities():
    assert solved(2000.0).state.boundary_friction > formula(2000.0).boundary_friction > 0.0


def test_far_outside_the_domain_all_is_as_by_the_formulas():
    found = solved(1.0)
    assert found.outside == 1.0
    assert found.state == formula(1.0)
    resting = LAW.model_film(2e3, 0.0, 0.0, GEOMETRY, ELLIPSE, OIL, flank_film_model(MODEL))
    assert resting.outside == 1.0
    assert np.all(np.isfinite(resting))


def test_over_the_border_of_the_domain_film_and_friction_go_smoothly():
    loads = np.geomspace(5.0, 500.0, 401)
    outside = np.array([solved(load).outside for load in loads])
    assert outside[0] == 1.0
    assert outside[-1] == 0.0
    assert np.all(np.diff(outside) <= 0.0)
    inner = loads[(outside > 0.0) & (outside < 1.0)]
    low, high = 0.95 * inner[0], 1.05 * inner[-1]

    def bends(n):
        found = [solved(load) for load in np.geomspace(low, high, n)]
        film = np.log([one.state.film_thickness for one in found])
        friction = np.log([one.state.viscous_friction for one in found])
        return np.array([np.abs(np.diff(one, n=2)).max() for one in (film, friction)])

    # half the step: a quarter for a smooth curve, a half at a kink, all of a jump
    film, friction = bends(801) / bends(1601)
    assert film == pytest.approx(4.0, rel=0.1)
    assert friction > 1.9  # the formula has a kink of its own


def test_the_bound_of_friction_holds_that_of_the_film_and_what_asperities_add():
    found = solved(2000.0)
    state = found.state
    assert found.film_bound == MODEL.film_bound
    of_film = MODEL.friction_bound * state.viscous_friction
    total = state.viscous_friction + state.boundary_friction
    assert found.friction_bound * total > of_film
    # smoother flanks have no asperities in touch: the film's own bound remains
    law = LAW._replace(surface=gear_flanks(1e-8))
    numbers = flank_film_model(MODEL)
    film = law.model_film(2000.0, SPEED, SLIP, GEOMETRY, ELLIPSE, OIL, numbers)
    smooth = law.bounded_flank(2000.0, SPEED, SLIP, GEOMETRY, film, OIL, numbers)
    assert smooth.friction_bound == pytest.approx(MODEL.friction_bound, rel=1e-12)


def test_a_low_limiting_stress_leaves_the_film_to_the_formulas():
    assert solved(2000.0, slope=0.2).outside == 0.0
    assert solved(2000.0, slope=0.02).outside == 1.0


def test_the_axle_accounts_for_all_of_its_energy_with_solved_films():
    axle = HypoidAxle(replace(mohammadpour_2015_axle(), film="solved"))
    speed, pinion, wheel = operating_point(60)
    axle.initialise(
        pinion_speed=speed, pinion_torque=pinion, wheel_torque=wheel, oil_temperature=AXLE_OIL
    )
    start = axle.output("energy.stored")
    bound = 0.0
    for _ in range(100):
        axle.step(1e-4, pinion, wheel, AXLE_OIL)
        bound += 1e-4 * axle.output("friction.power_loss_bound")
        assert axle.output("film.share_outside") < 0.05
    lost = sum(
        axle.output(f"energy.{name}")
        for name in ("friction_viscous", "friction_boundary", "mesh_damping", "bearing_damping",
                     "bearing_torque")
    )  # fmt: skip
    put_in = axle.output("energy.pinion_work") - axle.output("energy.wheel_work")
    # integration error of the energy, as with the formulas
    assert put_in == pytest.approx(axle.output("energy.stored") - start + lost, abs=1e-5 * lost)
    friction = axle.output("energy.friction_viscous") + axle.output("energy.friction_boundary")
    assert MODEL.friction_bound * friction < 1.05 * bound < 0.6 * friction


def test_losses_at_rest_carry_the_bound_of_the_film_model():
    torque, speed = np.array([50.0]), np.array([145.0])
    at = {"torques": torque, "speeds": speed, "temperatures": np.array([AXLE_OIL])}
    found = axle_losses(replace(mohammadpour_2015_axle(), film="solved"), **at)
    friction = float(found.power[0, 0, 0, :2].sum())
    assert 0.5 * MODEL.friction_bound < found.friction_bound[0, 0, 0] / friction < 0.6
    assert 0.0 <= found.share_outside[0, 0, 0] < 0.05
    by_formula = axle_losses(mohammadpour_2015_axle(), **at)
    assert by_formula.friction_bound[0, 0, 0] == 0.0
    assert friction < by_formula.power[0, 0, 0, :2].sum()


def own_law(surface, solid):
    return Consistent()(surface, solid)


@each("friction", ["as_printed", "printed_traction_circular", own_law])
def test_friction_laws_with_films_of_their_own_refuse_a_solved_film(friction):
    axle = replace(mohammadpour_2015_axle(), film="solved", friction=friction)
    with pytest.raises(ParameterError, match="must come with the friction law consistent"):
        HypoidAxle(axle)


def test_an_unknown_film_model_is_refused_by_name():
    with pytest.raises(ParameterError, match=r"film must be one of .*formula.*solved.*'solve'"):
        replace(mohammadpour_2015_axle(), film="solve")


def test_where_the_formulas_stand_in_the_bound_reaches_an_isothermal_film_and_none():
    # at 1 N Evans and Johnson's line lies below zero: no friction of the film by the formula
    light, smooth = 1.0, LAW._replace(surface=gear_flanks(1e-8))
    numbers = flank_film_model(MODEL)

    def bounded(law):
        film = law.model_film(light, SPEED, SLIP, GEOMETRY, ELLIPSE, OIL, numbers)
        return law.bounded_flank(light, SPEED, SLIP, GEOMETRY, film, OIL, numbers)

    rough = bounded(LAW)
    assert rough.outside == 1.0
    assert rough.state.viscous_friction == 0.0
    assert rough.film_bound == FORMULA_FILM_BOUND
    p = GEOMETRY.pressure_coefficient * light ** (1.0 / 3.0)
    rate = SLIP / rough.state.film_thickness
    stress = OIL.tau0 * np.arcsinh(OIL.eta0 * np.exp(OIL.alpha * p) * rate / OIL.tau0)
    most = FORMULA_FRICTION_TOP * stress * light / p
    error = rough.friction_bound * rough.state.boundary_friction
    # and what asperities add under a film that is thinner by its bound: less than all of the load
    assert most < error < most + OIL.gamma * light
    # no friction at all: there is nothing that a relative bound could be of
    assert bounded(smooth).friction_bound == 0.0


@each("load", [1.0, 40.0, 2000.0])  # outside, on the border, inside
def test_flank_and_bound_are_the_same_compiled_and_in_python(load):
    numbers = flank_film_model(MODEL)
    film = LAW.model_film(load, SPEED, SLIP, GEOMETRY, ELLIPSE, OIL, numbers)
    given = (GEOMETRY, film, OIL, ROUGH, SOLID, 0, numbers)
    compiled = solved_flank_friction(load, SPEED, SLIP, *given)
    plain = solved_flank_friction.py_func(load, SPEED, SLIP, *given)
    for one, other in zip(
        (*compiled.state, *compiled[1:]), (*plain.state, *plain[1:]), strict=True
    ):
        assert one == pytest.approx(other, rel=1e-13)  # sums in another order
    bounds = FormulaBounds(FORMULA_FILM_BOUND, FORMULA_FRICTION_TOP)
    error = (load, SLIP, compiled.state, OIL, ROUGH, SOLID, 0, bounds)
    assert formula_error(*error) == pytest.approx(formula_error.py_func(*error), rel=1e-13)
