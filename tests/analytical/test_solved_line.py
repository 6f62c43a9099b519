"""A helical pair with films from the model of solved films: domain, border, bounds, energy."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.contact.greenwood_tripp_1971 import gear_flanks
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, solid_parameters
from gearlube_core.dynamics.helical_model.model import HelicalPairModel
from gearlube_core.dynamics.helical_pair.march.gear_file_march import helical_march_parameters
from gearlube_core.errors import ParameterError
from gearlube_core.film_model.inlet import model_inlet
from gearlube_core.film_model.line_contact import LineContact
from gearlube_core.film_model.model import FilmModel
from gearlube_core.film_model.solved_film import solved_line
from gearlube_core.friction.line_points import line_friction
from gearlube_core.friction.solved_line import (
    LINE_FORMULA_FILM_BOUND,
    LINE_FORMULA_FRICTION_TOP,
    solved_line_friction,
)
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import lubricant_state

TEMPERATURE = 353.15
LUBRICANT = Lubricant.named("mohammadpour_2015")
OIL = lubricant_state(LUBRICANT.parameters(), TEMPERATURE)
SOLID = solid_parameters(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
MODEL = FilmModel.named("helical_line")
NUMBERS = MODEL.copied_numbers()
ROUGH, SMOOTH = gear_flanks(0.5e-6), gear_flanks(1e-8)
R, SPEED, SLIP = 0.01, 5.0, 1.5
OPERATION = {
    "pinion_speed": 104.7, "pinion_torque": 226.0, "wheel_torque": 280.2, "oil_temperature": 333.15
}  # fmt: skip


def solved(load, *, slip=SLIP, slope=0.0, surface=ROUGH):
    inlet = model_inlet(OIL, SOLID, slope)
    return solved_line_friction(load, R, SPEED, slip, OIL, surface, SOLID, inlet, NUMBERS)


def model_film(load):
    """The film model itself, from its plain numbers."""
    contact = LineContact(
        load, SOLID.contact_modulus, R, SPEED, SLIP, OIL.eta0, OIL.alpha, OIL.beta, OIL.tau0,
        0.0, 0.0, TEMPERATURE, OIL.conductivity, LUBRICANT.density * LUBRICANT.heat_capacity,
        SOLID.conductivity, SOLID.density * SOLID.heat_capacity,
    )  # fmt: skip
    return solved_line(NUMBERS, contact)


def test_inside_the_domain_film_and_friction_are_the_models():
    film, found = model_film(1e5), solved(1e5, surface=SMOOTH)
    assert found.outside == film.outside == 0.0
    assert found.state.film_thickness == pytest.approx(film.central_film, rel=1e-12)
    # smooth flanks under a film of a hundred roughnesses: all of the load is the film's
    assert found.state.viscous_friction == pytest.approx(1e5 * film.friction_coefficient, rel=1e-12)
    wanted = MODEL.friction_bound * film.friction_coefficient
    assert found.coefficient_bound == pytest.approx(wanted, rel=1e-12)
    assert found.film_bound == MODEL.film_bound
    # a band of 2 b that moves, joined with a round source at rest, and the film's own rise
    b = (4.0 * 1e5 * R / (math.pi * SOLID.contact_modulus)) ** 0.5
    flux = found.state.viscous_friction * SLIP / (2.0 * b)
    heat = SOLID.conductivity * SOLID.density * SOLID.heat_capacity
    moving = 2.0 / 3.0 * (2.0 * b / (math.pi * heat * SPEED)) ** 0.5
    still = 4.0 / (3.0 * math.pi) * 4.7 * b / SOLID.conductivity
    surface = (moving**-2 + still**-2) ** -0.5
    rise = flux * (surface + film.central_film / (12.0 * OIL.conductivity))
    assert found.state.temperature_rise == pytest.approx(rise, rel=1e-9)
    # a rough flank: asperities on the solved film, whose load a thinner film would raise
    rough = solved(1e5)
    assert rough.coefficient_bound * 1e5 > MODEL.friction_bound * rough.state.viscous_friction


def test_far_outside_all_is_the_formulas():
    for load in (0.0, 50.0):
        found = solved(load)
        formula = line_friction(load, R, SPEED, SLIP, OIL, ROUGH, SOLID)
        assert found.state == formula
        assert found.outside == 1.0
        assert found.film_bound == LINE_FORMULA_FILM_BOUND
        # an isothermal Eyring film as thick as the formula's, between flanks too smooth to touch
        found = solved(load, surface=SMOOTH)
        formula = line_friction(load, R, SPEED, SLIP, OIL, SMOOTH, SOLID)
        p, h = formula.mean_pressure, formula.film_thickness
        rate = OIL.eta0 * math.exp(OIL.alpha * p) * SLIP / (h * OIL.tau0)
        most = LINE_FORMULA_FRICTION_TOP * OIL.tau0 * math.asinh(rate) / p
        assert formula.viscous_friction < 0.5 * most * load or load == 0.0
        wanted = most * load / max(load, 1.0) - formula.friction_coefficient
        assert found.coefficient_bound == pytest.approx(wanted, abs=1e-3 * most)
    assert solved(1e5, slope=0.01).outside == 1.0  # of the limiting stress


def test_compiled_friction_equals_its_python_function():
    inlet = model_inlet(OIL, SOLID, 0.0)
    for load in (50.0, 1500.0, 1e5):
        given = (load, R, SPEED, -SLIP, OIL, ROUGH, SOLID, inlet, NUMBERS)
        compiled, python = solved_line_friction(*given), solved_line_friction.py_func(*given)
        # rounding, which the bound's small difference of asperities enlarges
        np.testing.assert_allclose(compiled.state, python.state, rtol=1e-12)
        np.testing.assert_allclose(compiled[1:], python[1:], rtol=1e-9)


def test_the_sign_follows_sliding():
    forward, back = solved(1e5).state, solved(1e5, slip=-SLIP).state
    assert back.signed_coefficient == -forward.signed_coefficient < 0.0
    assert back.friction_coefficient == forward.friction_coefficient


def test_film_and_friction_go_over_smoothly_into_the_formulas():
    # from well inside to well outside: light loads

    def bends(count):
        loads = np.exp(np.linspace(math.log(300.0), math.log(3e4), count))
        film = np.log([solved(load).state.film_thickness for load in loads])
        return np.abs(np.diff(film, n=2)).max()

    # half the step: a quarter for a smooth curve, a half at a kink, all of a jump
    assert bends(801) / bends(1601) == pytest.approx(4.0, rel=0.2)


def pair(**changes):
    parameters = helical_march_parameters(HelicalGearFile.named("he_2007"))
    return HelicalPairModel(replace(parameters, **changes))


def marched(model, steps=20):
    model.initialise(**OPERATION)
    inputs = [OPERATION[name] for name in ("pinion_torque", "wheel_torque", "oil_temperature")]
    for _ in range(steps):
        model.step(1e-4, *inputs)
    return model


def test_a_pair_with_solved_films_keeps_its_energy_and_tells_its_bounds():
    model = pair(film="solved")
    model.initialise(**OPERATION)
    start = model.output("energy.stored")
    model = marched(model, 100)
    lost = sum(
        model.output(f"energy.{name}") for name in ("friction", "mesh_damping", "bearing_damping")
    )
    put_in = model.output("energy.pinion_work") - model.output("energy.wheel_work")
    # integration error of the energy, as with the formulas
    assert put_in == pytest.approx(model.output("energy.stored") - start + lost, abs=1e-4 * lost)
    loss = model.output("friction.power_loss")
    assert (
        0.0 < MODEL.friction_bound * loss < 3.0 * model.output("friction.power_loss_bound") < loss
    )
    assert model.output("film.share_outside") < 0.2
    loaded = [i for i in range(1, 7) if model.output(f"line[{i}].load") > 0.0]
    assert loaded
    for i in range(1, 7):
        bound = model.output(f"line[{i}].film_bound")
        assert (bound > 0.999 * MODEL.film_bound) == (i in loaded)


def test_formulas_have_no_bounds_and_other_films():
    formula, other = marched(pair()), marched(pair(film="solved"))
    for name in ("film.share_outside", "friction.power_loss_bound", "line[1].film_bound"):
        assert formula.output(name) == 0.0
    thin = "mesh.film_thickness_min"
    # Dowson and Toyoda's film is up to 34 % thicker than isothermal solved ones, heat thins more
    assert 0.5 < other.output(thin) / formula.output(thin) < 1.1


def test_an_unknown_film_is_refused_in_words():
    with pytest.raises(ParameterError, match="film must be one of formula, solved; got 'thick'"):
        pair(film="thick")
