"""Rolling and films of the axle's rollers by the model of solved films."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.bearings.bearing_type import NO_RACEWAYS, RollerFilms, ShaftMotion
from gearlube_core.bearings.losses.laws import NO_HEATING, ROLLING_LAWS, SOLVED_FILMS
from gearlube_core.bearings.losses.physical_loss import LossSettings, physical_loss
from gearlube_core.bearings.losses.race_rolling import (
    FORMULA_FORCE_BOUND,
    ROLLER_MODEL,
    roller_film_model,
)
from gearlube_core.bearings.parameters import ROLLERS_MAX
from gearlube_core.bearings.raceway_drag import line_radii, raceway_drag
from gearlube_core.bearings.roller_loads import roller_loads
from gearlube_core.bearings.roller_nodes import (
    N_ROLLER_NODES,
    centre_nodes,
    kept_roller_film,
    races_of,
    roller_film,
    solved_raceway_drag,
)
from gearlube_core.bearings.tapered_roller_bearing import TaperedRollerBearing
from gearlube_core.bearings.tapered_roller_kernels import rib_drag
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.dynamics.hypoid_axle.losses import axle_losses
from gearlube_core.dynamics.hypoid_axle.model import HypoidAxle
from gearlube_core.dynamics.hypoid_axle.mohammadpour_2015 import mohammadpour_2015_axle
from gearlube_core.film_model.model import FilmModel
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.oil.lubricant_state import lubricant_state
from tests.helpers.bearing_32216 import BEARING
from tests.helpers.each import each

SPEED, TEMPERATURE = 200.0, 353.15
LAW = "solved_films"
MODEL = FilmModel.named(ROLLER_MODEL)


def oil(temperature=TEMPERATURE):
    parameters = Lubricant.named("mohammadpour_2015").parameters()
    return lubricant_state(parameters, temperature)


OIL = oil()
# without films in the approach and without rates: loads that `roller_loads` tells as well
P = TaperedRollerBearing.mohammadpour_2015(film="off").with_preload(2500.0).parameters()
P = P._replace(loss=0.0)
# a third of the rollers carries nothing
MOVED = ShaftMotion(50e-6, -30e-6, 8e-6, 0.0, 0.0, 0.0, 0.3, SPEED)


def films(kept=0.0):
    return RollerFilms(roller_film_model(LAW), np.zeros(N_ROLLER_NODES), kept)


def loads(side):
    found = np.zeros(ROLLERS_MAX)
    still = P._replace(cage_ratio=0.0)
    assert roller_loads(MOVED, 1e3, OIL.eta0, OIL.alpha, still, side, found) == 0
    return found


def alone():
    """Losses of both bearings by the law of `gearlube bearing`, under the same loads."""
    R_inner, R_outer = line_radii(P)
    solid = SolidParameters(0.5 * P.reduced_modulus, P.conductivity, P.density, P.heat_capacity)
    one = BEARING.parameters()._replace(
        n_rollers=P.n_rollers,
        length=P.roller_length,
        mean_ratio=P.film_speed_radius,
        R_inner=R_inner,
        R_outer=R_outer,
        inner_share=1.0,
        reduced_modulus=P.reduced_modulus,
        roughness=1.0,
        rolling_scale=1.0,
        solid=solid,
    )
    settings = LossSettings(SOLVED_FILMS, NO_HEATING, 0.0)
    model = roller_film_model(LAW)
    return [physical_loss(one, settings, loads(k), SPEED, OIL, model) for k in (1.0, -1.0)]


def test_raceways_of_a_shaft_lose_what_the_bearing_study_finds_under_the_same_loads():
    found, two = solved_raceway_drag(MOVED, OIL, P, films()), alone()
    power = sum(one.inner + one.outer for one in two)
    assert found.torque * SPEED == pytest.approx(power, rel=1e-9)  # ninth root of the kernels
    # roughness of 1 m: the film ratio is the film
    assert found.first_film == pytest.approx(two[0].film_ratio, rel=1e-9)
    assert found.second_film == pytest.approx(two[1].film_ratio, rel=1e-9)
    assert found.load == pytest.approx(loads(1.0).sum() + loads(-1.0).sum(), rel=1e-9)
    assert np.count_nonzero(loads(-1.0)[:12]) < 12


def test_either_bearing_alone_loses_its_part():
    for side, one in zip((1.0, -1.0), alone(), strict=True):
        found = solved_raceway_drag(MOVED, OIL, P, films(), side)
        assert found.torque * SPEED == pytest.approx(one.inner + one.outer, rel=1e-9)
        thinnest = found.first_film if side > 0.0 else found.second_film
        assert thinnest == pytest.approx(one.film_ratio, rel=1e-9)
        assert found.load == pytest.approx(loads(side).sum(), rel=1e-9)
    for law in ROLLING_LAWS.values():
        parts = [raceway_drag(MOVED, law, OIL, P, side) for side in (1.0, -1.0, 0.0)]
        assert 0.0 < parts[1] != parts[0] > 0.0
        assert parts[0] + parts[1] == pytest.approx(parts[2], rel=1e-12)
    first, second, both = (rib_drag(MOVED, OIL, P, side) for side in (1.0, -1.0, 0.0))
    assert np.add(first, second) == pytest.approx(both, rel=1e-12)
    assert first.oil == second.oil


@pytest.mark.parametrize("kept", [0.0, 1.0])
def test_the_torque_opposes_either_way_ends_at_rest_and_is_that_of_the_source(kept):
    forward = solved_raceway_drag(MOVED, OIL, P, films(kept))
    back = solved_raceway_drag(MOVED._replace(speed=-SPEED), OIL, P, films(kept))
    assert back == forward._replace(torque=-forward.torque)
    assert solved_raceway_drag(MOVED._replace(speed=0.0), OIL, P, films(kept)) == NO_RACEWAYS
    # fused multiply-add and libm round differently
    source = solved_raceway_drag.py_func(MOVED, OIL, P, films(kept))
    assert source == pytest.approx(forward, rel=1e-11)


def rollers(loads, speed, kept, centre=None, temperature=TEMPERATURE):
    """(force, log film, outside, bounds) over loads per length, nodes found at speed `centre`."""
    state = oil(temperature)
    races, model = races_of(state, P), roller_film_model(LAW)
    u = P.film_speed_radius * speed
    if not kept:
        return np.array([roller_film(q, u, races, model) for q in loads])
    nodes = np.zeros(N_ROLLER_NODES)
    centre_nodes(nodes, P.film_speed_radius * (centre or speed), temperature)
    faster = centre_nodes(nodes, u, temperature)
    return np.array([kept_roller_film(q, u, faster, races, nodes, model) for q in loads])


@each("by", [0.975, 1.0, 1.025])
@each("temperature", [333.15, 353.15, 383.15])
def test_between_kept_loads_force_and_film_are_those_of_the_model(by, temperature):
    # from 0.22 GPa mean pressure on, within the domain by more than the distance of two nodes
    inside = np.geomspace(2e4, 2.4e5, 300)
    exact = rollers(inside, by * SPEED, False, temperature=temperature)
    kept = rollers(inside, by * SPEED, True, SPEED, temperature)
    assert np.all(exact[:, 2] == 0.0)
    # slopes over the next 2 % of speed: 0.025 (0.025 + 0.02)/2 times a curvature of a tenth
    np.testing.assert_allclose(kept[:, 0], exact[:, 0], rtol=1e-4)
    # the film bends more over load; a fifteenth of its bound
    np.testing.assert_allclose(kept[:, 1], exact[:, 1], atol=6e-4)
    np.testing.assert_allclose(kept[:, 2:], exact[:, 2:], rtol=1e-14)


def test_over_the_border_of_the_domain_force_and_bound_stay_smooth_and_near_the_model():
    across = np.geomspace(400.0, 4e4, 4000)
    exact, kept = (rollers(across, SPEED, one) for one in (False, True))
    assert exact[0, 2] == 1.0
    assert exact[-1, 2] == 0.0
    step = math.log(across[1] / across[0])
    for found in (exact, kept):
        slope = np.diff(np.log(found[:, 0])) / step
        # force rises with a power of the load below one half, slower at the border by the
        # formula's tenth over its width of a half in ln(load); a jump of 1e-4 would show as 0.1
        assert np.all(np.abs(slope) < 0.6)
        assert np.all(np.diff(found[:, 3]) <= 1e-12)
    # the share outside bends within the distance of two nodes; the bound there is above 2 %
    np.testing.assert_allclose(kept[:, 0], exact[:, 0], rtol=0.02)
    assert kept[0, 3] == pytest.approx(FORMULA_FORCE_BOUND, rel=1e-12)
    assert kept[-1, 3] == pytest.approx(MODEL.friction_bound, rel=1e-12)


@each(
    ("speed", "temperature", "holds"),
    [(1.02, 0.0, True), (0.96, 0.0, False), (1.0, 0.01, True), (1.0, 0.05, False)],
)
def test_what_is_kept_is_forgotten_when_speed_or_oil_have_changed(speed, temperature, holds):
    nodes = np.zeros(N_ROLLER_NODES)
    assert centre_nodes(nodes, 2.0, TEMPERATURE) == 0.0
    nodes[2] = 1.0
    faster = centre_nodes(nodes, 2.0 * speed, TEMPERATURE + temperature)
    assert (nodes[2] == 1.0) == holds
    assert faster == pytest.approx(math.log(speed) if holds else 0.0, abs=1e-15)


def axle(**changes):
    made = HypoidAxle(replace(mohammadpour_2015_axle(), bearing_torque_loss=LAW, **changes))
    made.initialise(
        pinion_speed=SPEED, pinion_torque=60.0, wheel_torque=150.0, oil_temperature=TEMPERATURE
    )
    return made


def test_an_axle_in_motion_tells_films_bounds_and_what_lies_outside():
    made = axle()
    at_rest = made.outputs.copy()
    for _ in range(30):
        made.step(1e-3, 60.0, 150.0, TEMPERATURE)
    loss, bound = made.output("bearing.power_loss"), made.output("bearing.power_loss_bound")
    # of the torque the ribs, hysteresis and oil have no bound: less than the model's of the whole
    assert 0.3 * MODEL.friction_bound < bound / loss <= MODEL.friction_bound
    put_in = made.output("pinion.speed") * 60.0
    assert made.output("axle.efficiency_bound") == pytest.approx(bound / put_in, rel=1e-3)
    assert made.output("bearing.share_outside") == 0.0
    for j in (1, 2, 3, 4):
        film = made.output(f"bearing[{j}].film_thickness")
        assert 1e-7 < film < 3e-6
        assert made.output(f"bearing[{j}].film_bound") == pytest.approx(MODEL.film_bound)
    # before the first step each roller is evaluated by itself; speeds are nearly those of later
    index = made.output_names.index("bearing[1].film_thickness")
    assert at_rest[index] == pytest.approx(made.output("bearing[1].film_thickness"), rel=0.1)


def test_energy_is_kept_and_a_restored_state_goes_on_to_the_bit():
    made, again = axle(film="solved"), axle(film="solved")
    for _ in range(20):
        made.step(1e-3, 60.0, 150.0, TEMPERATURE)
    again.set_state(made.get_state())
    for one in (made, again):
        for _ in range(5):
            one.step(1e-3, 90.0, 150.0, TEMPERATURE)
    np.testing.assert_array_equal(made.outputs, again.outputs)


def test_other_laws_and_bearings_that_stay_at_rest_have_no_bounds():
    made = HypoidAxle(mohammadpour_2015_axle())
    made.initialise(
        pinion_speed=SPEED, pinion_torque=60.0, wheel_torque=150.0, oil_temperature=TEMPERATURE
    )
    for name in ("bearing.power_loss_bound", "bearing.share_outside", "bearing[2].film_bound"):
        assert made.output(name) == 0.0


def test_losses_at_rest_are_those_of_a_march_with_their_bound():
    found = axle_losses(
        replace(mohammadpour_2015_axle(), bearing_torque_loss=LAW),
        torques=np.array([2.0, 60.0]),
        speeds=np.array([SPEED]),
        temperatures=np.array([TEMPERATURE]),
    )
    drag = found.power[0, 0, :, 4]
    assert np.all(found.drag_bound[0, 0] > 0.3 * MODEL.friction_bound * drag)
    assert np.all(found.drag_bound[0, 0] < FORMULA_FORCE_BOUND * drag)
    assert np.all(found.rollers_outside[0, 0] < 0.05)
    # flooded films lose much the same by Biboulet and Houpert's law
    formula = axle_losses(
        replace(mohammadpour_2015_axle(), bearing_torque_loss="biboulet_houpert_2010"),
        torques=np.array([60.0]),
        speeds=np.array([SPEED]),
        temperatures=np.array([TEMPERATURE]),
        extremes=False,
    )
    assert drag[1] == pytest.approx(formula.power[0, 0, 0, 4], rel=1.0 / 6.0)
    assert raceway_drag(MOVED, 0, OIL, P) == pytest.approx(
        solved_raceway_drag(MOVED, OIL, P, films()).torque, rel=1.0 / 6.0
    )
