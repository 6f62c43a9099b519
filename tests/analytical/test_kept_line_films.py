"""Solved films that the marching pair keeps, against the film model evaluated at each point."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from gearlube_core.dynamics.helical_model.model import HelicalPairModel
from gearlube_core.dynamics.helical_model.outputs import LOAD_TORQUE, MARKS
from gearlube_core.dynamics.helical_pair.march import kept_films, line_points
from gearlube_core.dynamics.helical_pair.march.flanks import (
    POINTS_PER_LINE,
    FlankView,
    coast_view,
    drive_view,
)
from gearlube_core.dynamics.helical_pair.march.gear_file_march import helical_march_parameters
from gearlube_core.dynamics.helical_pair.march.line_points import refresh_friction
from gearlube_core.dynamics.helical_pair.march.line_sums import pair_slot
from gearlube_core.dynamics.helical_pair.march.mesh_data import KEPT_AT, LEAST_OFFSET
from gearlube_core.film.line_film import line_film_thickness
from gearlube_core.film_model.inlet import model_inlet
from gearlube_core.friction.solved_line import line_film, solved_line_friction
from gearlube_core.helical_geometry.contact_line import line_kinematics
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.oil.lubricant_state import lubricant_state
from tests.helpers.helical_march_cases import pair_data_of
from tests.helpers.pair_motions import motion_of

PARAMETERS = replace(helical_march_parameters(HelicalGearFile.named("he_2007")), film="solved")
TEETH = HelicalGearFile.named("he_2007").pinion.teeth
NUMBERS = PARAMETERS.film_model().copy()
RATIO = 1.24


def running(speed: float, torque: float, temperature: float) -> HelicalPairModel:
    model = HelicalPairModel(PARAMETERS)
    model.initialise(
        pinion_speed=speed,
        pinion_torque=torque,
        wheel_torque=torque * RATIO,
        oil_temperature=temperature,
    )
    return model


def evaluated(model: HelicalPairModel, view: FlankView, line: int, place: int, oil: Any) -> Any:
    """Film and friction by the film model itself, sliding speed; None where there is no line."""
    constants, flanks = model.parameters.constants(), model.parameters.constants().flanks
    plane = flanks.plane
    point = line_points.line_place(view.phase - math.floor(view.phase), line, place, plane)
    if point.length == 0.0:
        return None
    g = view.a + view.tilt * (point.z * plane.cos_b + point.x * plane.sin_b)
    load = line_points.point_load(g, point.at_line, view.phase, line, pair_data_of(model), flanks)
    m = line_kinematics(point.x, abs(motion_of(model).w_p), plane)
    inlet = model_inlet(oil, constants.solid, constants.limiting_slope)
    solved = solved_line_friction(
        load, m.R, m.entrainment, m.sliding, oil, constants.surface, constants.solid, inlet, NUMBERS
    )
    return solved.state, m.sliding


def carried_film(model: HelicalPairModel, view: FlankView, coast: bool, line: int, place: int,
                 load: float, oil: Any) -> float:  # fmt: skip
    """Film by the film model at the node, carried on by the formula of Dowson and Toyoda [m]."""
    p, plane = model.parameters.constants(), model.parameters.constants().flanks.plane
    modulus, speed = 2.0 * p.solid.contact_modulus, abs(motion_of(model).w_p)
    node, part = line_points.film_node(view.phase, coast, p)
    then = line_points.line_place(part, line, place, plane)
    now = line_points.line_place(view.phase - math.floor(view.phase), line, place, plane)
    if node < 0 or then.length == 0.0:
        then = now
    m, m_now = (line_kinematics(one.x, speed, plane) for one in (then, now))
    inlet = model_inlet(oil, p.solid, p.limiting_slope)
    there = line_film(NUMBERS, load, m.R, m.entrainment, m.sliding, p.solid, inlet)
    formula, formula_now = (
        line_film_thickness(one.R, oil.eta0, oil.alpha, one.entrainment, load, modulus)
        for one in (m, m_now)
    )
    return there.central_film / formula * formula_now


def marched(speed: float, torque: float, temperature: float, *, kept: bool) -> tuple[Any, Any]:
    """Transmission error [m] and friction power [W] of some mesh periods, step by step."""
    model = running(speed, torque, temperature)
    oil = lubricant_state(model.parameters.constants().oil, temperature)
    flanks = model.parameters.constants().flanks
    h = 0.9 * 2.0 * math.pi / (TEETH * speed) / 64.0  # one step of the integrator
    found = []
    for _ in range(200):
        friction = model._state[LOAD_TORQUE + 1 : MARKS]  # when computed, then coefficients
        if refresh_friction(motion_of(model), friction, pair_data_of(model), oil) and not kept:
            view = drive_view(motion_of(model), flanks)
            for line in range(int(flanks.lines)):
                slot = 1 + POINTS_PER_LINE * pair_slot(view.phase, line, int(flanks.lines))
                for place in range(POINTS_PER_LINE):
                    point = evaluated(model, view, line, place, oil)
                    if point is not None:
                        friction[slot + place] = point[0].friction_coefficient
        model.step(h, torque, torque * RATIO, temperature)
        found.append((model.output("mesh.dte"), model.output("friction.power_loss")))
    return tuple(np.transpose(found))


@pytest.mark.parametrize(
    ("speed", "torque", "temperature"), [(104.7, 226.0, 353.15), (314.0, 80.0, 363.15)]
)
def test_the_motion_is_that_with_the_model_at_every_point(speed, torque, temperature):
    dte, loss = marched(speed, torque, temperature, kept=True)
    exact, exact_loss = marched(speed, torque, temperature, kept=False)
    # what the integrator's step is chosen for
    assert np.abs(dte - exact)[70:].max() < 1e-4 * np.ptp(exact[70:])
    assert loss[70:].mean() == pytest.approx(exact_loss[70:].mean(), rel=5e-4)


@pytest.mark.slow
@pytest.mark.parametrize("coast", [False, True])
def test_films_and_frictions_are_the_models_at_any_load_speed_and_phase(coast):
    # bins are a tenth wide: what bends within them is left out, and how far a node lies behind
    sign = -1.0 if coast else 1.0
    misses, rng = [], np.random.default_rng(3)
    for _ in range(12):
        speed, torque = math.exp(rng.uniform(3.5, 6.0)), sign * math.exp(rng.uniform(4.0, 6.0))
        temperature = rng.uniform(315.0, 385.0)
        model = running(speed, torque, temperature)
        for _ in range(int(rng.integers(1, 40))):
            model.step(1e-5, torque, torque * RATIO, temperature)
        oil = lubricant_state(model.parameters.constants().oil, temperature)
        constants = model.parameters.constants()
        flanks = constants.flanks
        view = (
            coast_view(motion_of(model), flanks) if coast else drive_view(motion_of(model), flanks)
        )
        for line in range(int(flanks.lines)):
            for place in range(POINTS_PER_LINE):
                known = evaluated(model, view, line, place, oil)
                pinion_speed = abs(motion_of(model).w_p)
                load, length, _, found = line_points.line_point(
                    view,
                    coast,
                    line,
                    place,
                    pinion_speed,
                    pair_data_of(model),
                    oil,
                    model.parameters.constants(),
                )
                assert (length == 0.0) == (known is None)
                if known is not None and load > 1e3:
                    state = found.state
                    film_then = state.film_thickness
                    if found.outside == 0.0:
                        film_then = carried_film(model, view, coast, line, place, load, oil)
                    misses.append(
                        (
                            state.film_thickness / known[0].film_thickness - 1.0,
                            state.film_thickness / film_then - 1.0,
                            state.friction_coefficient - known[0].friction_coefficient,
                            known[0].friction_coefficient,
                        )
                    )
    film, carried, friction, whole = np.abs(np.transpose(misses))
    assert len(misses) > 60
    # bins are a tenth wide and the slopes are those in their middle: what is left is of second
    # order, (0.05)^2 of a logarithm that bends by about one
    assert carried.max() < 2.5e-3
    assert np.sqrt((film**2).mean()) < 2.5e-3
    # of the largest: at the pitch line friction is next to nothing
    assert friction.max() < 1e-2 * whole.max()
    assert np.sqrt((friction**2).mean()) < 2e-3 * whole.max()


def test_what_is_kept_from_before_changes_nothing():
    # a film follows from node and bin alone
    first, other = running(150.0, 226.0, 353.15), running(90.0, 100.0, 333.15)
    for _ in range(60):
        first.step(1e-4, 226.0, 226.0 * RATIO, 353.15)
        other.step(1e-4, 60.0, 80.0, 340.0)
    other.set_state(first.get_state())
    for model in (first, other):
        for _ in range(40):
            model.step(1e-4, 226.0, 226.0 * RATIO, 353.15)
    np.testing.assert_array_equal(first.get_state(), other.get_state())
    names = ("mesh.film_thickness_min", "friction.power_loss_bound", "line[2].film_bound")
    assert [first.output(name) for name in names] == [other.output(name) for name in names]


def test_neighbouring_bins_have_places_of_their_own_and_nothing_is_left_after_forgetting():
    kept = np.zeros(kept_films.N_KEPT_FILMS)
    box = kept_films.bin_of(1e5, 100.0, 350.0)
    boxes = [
        box._replace(load=box.load + i, speed=box.speed + j) for i in range(2) for j in range(2)
    ]
    places = [kept_films.place_of(True, 15, 5, 3, one) for one in boxes]
    assert len(set(places)) == 4
    # the last point of the last node is within the array, too
    assert sorted(places)[-1] == kept_films.N_KEPT_FILMS - kept_films.N_KEPT
    for at, one in zip(places, boxes, strict=True):
        kept_films.begin_bin(kept, at, one, 1e-3)
        assert kept_films.is_kept(kept, at, one)
        assert not kept_films.is_kept(kept, at, one._replace(oil=one.oil + 1.0))
        assert not kept_films.is_kept(kept, at, one._replace(load=one.load + 2.0))
    kept_films.forget(kept)
    assert not any(kept_films.is_kept(kept, at, one) for at, one in zip(places, boxes, strict=True))


def test_what_is_kept_is_a_plane_through_its_films():
    kept = np.zeros(kept_films.N_KEPT)
    box = kept_films.bin_of(2e5, 120.0, 341.0)
    load, speed, oil = kept_films.middle_of(box)

    def film(ln_load, ln_speed, oil, ln_slide):
        first = 0.2 * ln_load - 0.3 * ln_speed + 0.01 * oil
        second = -0.1 * ln_load + 0.4 * ln_speed - 0.02 * oil + 0.7 * ln_slide
        return kept_films.NodeFilm(first, second, 0.05 * ln_load)

    nudges = np.vstack([np.zeros(4), np.diag(kept_films.NUDGES)])
    middle = np.array([math.log(load), math.log(speed), oil, math.log(2e-3)])
    kept_films.begin_bin(kept, 0, box, -2e-3)
    for n, nudge in enumerate(nudges):
        kept_films.keep_film(kept, 0, n, film(*(middle + nudge)))
    found = kept_films.film_in(kept, 0, box, -3e-3)
    wanted = film(math.log(2e5), math.log(120.0), 341.0, math.log(3e-3))
    np.testing.assert_allclose(found, wanted, rtol=1e-9)
    # across the pitch line: the node's own friction
    node = film(math.log(2e5), math.log(120.0), 341.0, math.log(2e-3))
    assert kept_films.film_in(kept, 0, box, 1e-3).log_friction == pytest.approx(node[1], rel=1e-9)


def test_compiled_kernels_equal_their_python_functions():
    model = running(150.0, 226.0, 353.15)
    model.step(1e-4, 226.0, 226.0 * RATIO, 353.15)
    oil, constants = (
        lubricant_state(model.parameters.constants().oil, 353.15),
        model.parameters.constants(),
    )
    view = drive_view(motion_of(model), constants.flanks)
    box = kept_films.bin_of(1.3e5, 150.0, 353.15)
    assert kept_films.bin_of.py_func(1.3e5, 150.0, 353.15) == pytest.approx(box, rel=1e-12)
    x = constants.flanks.plane.P + 1e-3
    for n in range(kept_films.N_FILMS):
        given = (x, box, n, pair_data_of(model), constants)
        compiled = line_points.bin_film(*given)
        np.testing.assert_allclose(line_points.bin_film.py_func(*given), compiled, rtol=1e-10)
    node = line_points.film_node
    assert node(view.phase, False, constants) == node.py_func(view.phase, False, constants)
    pair_data_of(model)[KEPT_AT:LEAST_OFFSET] = 0.0
    given = (view, False, 1, 0, 150.0, pair_data_of(model), oil, constants)
    compiled = line_points.line_point(*given)
    python = line_points.line_point.py_func(*given)
    np.testing.assert_allclose(python[3].state, compiled[3].state, rtol=1e-10)
    kept = pair_data_of(model)[KEPT_AT:LEAST_OFFSET]
    assert (kept != 0.0).sum() == pytest.approx(kept_films.N_KEPT, abs=6)  # one bin of one point


def test_nothing_is_kept_with_more_refreshes_than_nodes_or_near_rest():
    many = replace(PARAMETERS, friction_updates_per_mesh_period=kept_films.NODES_KEPT + 1)
    model = HelicalPairModel(many)
    model.initialise(
        pinion_speed=100.0, pinion_torque=226.0, wheel_torque=280.0, oil_temperature=353.15
    )
    model.step(1e-4, 226.0, 280.0, 353.15)
    still = running(0.0, 226.0, 353.15)
    still.step(1e-6, 226.0, 226.0 * RATIO, 353.15)
    for one in (model, still):
        assert not pair_data_of(one)[KEPT_AT:LEAST_OFFSET].any()
