"""Solids that touch in a film: balances, limits and what is reported."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from gearlube_core.ehl.gears.helical_film import march_helical_cycle
from gearlube_core.ehl.point.contact_domain import ContactDomain, elliptical_contact
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solid_contact import SolidContact, SolidLayer
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.ehl.point.terms.solids import ContactPressure
from gearlube_core.ehl.transient.march import MARCH_SETTINGS, FilmMarch
from gearlube_core.errors import ParameterError
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.ehl_point_cases import ALPHA, ETA0, REDUCED_MODULUS, dry_contact, flow_out
from tests.helpers.jamali_2015 import jamali_2015_film


def _contact(speed: float, thickness: float | None) -> PointContactProblem:
    problem = elliptical_contact(
        R_x=0.01,
        R_y=0.01,
        entrainment=(speed, 0.0),
        load=50.0,
        contact_modulus=0.5 * REDUCED_MODULUS,
        lubricant=film_oil(eta0=ETA0, alpha=ALPHA),
        nodes=(49, 49),
        domain=ContactDomain(inlet=2.5, outlet=1.6, side=1.8),
    )
    solids = None if thickness is None else SolidContact(thickness=thickness)
    return dataclasses.replace(problem, solids=solids)


def test_the_law_of_the_layer() -> None:
    solids = SolidContact(thickness=8e-9, pressure=2e9)
    # by hand: t/h - 1 is 1, 1/3 and 0
    expected = [2e9, 2e9 / 9.0, 0.0, 0.0]
    assert solids(np.array([4e-9, 6e-9, 8e-9, 1e-6])) == pytest.approx(expected, rel=1e-12)
    assert solids.film(2e9) == pytest.approx(4e-9, rel=1e-12)
    # rises all the way down, far above any pressure of teeth before the film is gone
    film = np.linspace(-1e-9, 9e-9, 2001)
    pressure, slope = SolidLayer(8e-9, 2e9)(film)
    assert (np.diff(pressure) <= 0.0).all()
    assert solids(np.array([1e-12]))[0] > 1e11
    # differences of second order in a step of 5 pm, at films of 2 nm and more
    inner = film > 2e-9
    differences = np.gradient(pressure, film)
    assert np.abs(differences - slope)[inner][1:-1].max() < 1e-3 * np.abs(slope[inner]).max()
    for bad in ({"thickness": 0.0}, {"thickness": 1e-3}, {"pressure": -1.0}):
        with pytest.raises(ParameterError, match="must be"):
            SolidContact(**bad)


def test_a_film_thicker_than_the_layer_does_not_know_it() -> None:
    alone, layered = (solve_point_contact(_contact(1.0, t)) for t in (None, 10e-9))
    assert alone.minimum_film > 50e-9
    assert np.array_equal(alone.film, layered.film)
    assert np.array_equal(alone.pressure, layered.pressure)
    assert layered.outcome.touch.area == 0.0
    assert "touch" not in layered.outcome.sentence


@pytest.mark.slow
def test_oil_and_load_are_balanced_between_touching_solids() -> None:
    problem = _contact(0.03, 30e-9)
    settings = PointSolverSettings(tolerance=1e-10, load_tolerance=1e-10, wedge="central")
    solution = solve_point_contact(problem, settings)
    touch = solution.outcome.touch
    # a mixed film: both carry
    assert 0.2 < touch.share < 0.8
    oil = dataclasses.replace(solution, pressure=solution.pressure - solution.solid_pressure)
    # inside of the touching area, far from where oil has no pressure left
    middle = (slice(15, 34), slice(18, 31))
    assert (solution.film[middle] < 30e-9).mean() > 0.5
    assert oil.pressure[middle].min() > 0.0
    # bar of the issue; faces, viscosity and density of the oil's pressure, from fields in SI
    assert abs(flow_out(oil, 16, 32, 19, 29)) < 1e-8
    assert solution.load == pytest.approx(problem.load, rel=1e-9)
    # oil has no pressure below zero: what is left of 1 GPa is within the tolerance of the flow
    assert oil.pressure.min() > -0.1
    assert oil.load / problem.load == pytest.approx(1.0 - touch.share, abs=1e-9)
    x, y = problem.x, problem.y
    cell = (x[1] - x[0]) * (y[1] - y[0])
    assert touch.area == pytest.approx(cell * (solution.film < 30e-9).sum(), rel=1e-9)
    assert touch.largest == pytest.approx(solution.solid_pressure.max(), rel=1e-12)
    assert f"carry {100.0 * touch.share:.2g} % of the load" in solution.outcome.sentence


@pytest.mark.slow
@pytest.mark.parametrize("thickness", [pytest.param(3e-9, marks=pytest.mark.slow), 30e-9])
def test_without_speed_the_solids_carry_the_dry_contact(thickness: float) -> None:
    problem = _contact(1e-4, thickness)
    solution = solve_point_contact(problem)
    dry = dry_contact(problem)
    # entrainment of 0.1 mm/s brings a film of 0.4 nm
    assert solution.outcome.touch.share > 0.98
    # the layer gives way by less than its thickness, of the approach a^2/R of the dry contact
    softness = thickness * 0.01 / problem.hertz_contact[0] ** 2
    difference = np.abs(solution.pressure - dry.pressure).sum() / dry.pressure.sum()
    assert difference < softness
    assert solution.maximum_pressure == pytest.approx(dry.pressure.max(), rel=softness)


@pytest.mark.slow
def test_a_thin_film_of_a_helical_pair_touches_and_goes_on() -> None:
    # a hundredth of the thesis' speed: films of about 6 nm; layers of 3, 10 and 30 nm
    shares = []
    for thickness in (3e-9, 10e-9, 30e-9):
        film = jamali_2015_film("a", newtonian=True, nodes=(33, 49))
        film = dataclasses.replace(
            film, pinion_speed=0.01 * film.pinion_speed, solids=SolidContact(thickness=thickness)
        )
        cycle = march_helical_cycle(film, first=498, last=500)
        assert cycle.failures == 0
        assert np.abs(cycle["load_error"]).max() < 1e-6
        assert cycle["minimum_film"].min() > 0.2 * thickness
        shares.append(cycle["solid_share"][-1])
    # what touches depends on the layer, more than in proportion
    assert shares[0] < shares[1] < shares[2]
    assert shares[2] > 0.9


def test_flow_that_gathers_at_a_drained_node_is_not_hidden() -> None:
    # the solids lack a little pressure there, and far more oil runs in than that is worth
    left = np.full((1, 1), -0.03)
    share = ContactPressure(
        pressure=np.full((1, 1), 0.26),
        slope=np.full((1, 1), -1.0),
        left=left,
        oil=np.zeros((1, 1)),
        weight=0.4,
    )
    inflow = np.full((1, 1), 0.55)
    assert share.drained(inflow).all()
    # once the pressure is right the node is not drained any more and its whole inflow counts
    assert share.unbalanced_flows(inflow)[0, 0] >= 0.55
    assert share.unbalanced_flows(-inflow)[0, 0] == pytest.approx(0.4 * 0.03)


@pytest.mark.slow
def test_solids_at_the_edge_of_steep_relief_let_go_again() -> None:
    # at step 473 a node behind the edge stops draining: oil runs in and lifts the solids apart
    film = jamali_2015_film("a", k=0.02, nodes=(97, 161), solids=SolidContact(thickness=30e-9))
    film = dataclasses.replace(film, extent=(-2.75, 2.75))
    cycle = march_helical_cycle(film, first=460, last=475, throw=False)
    assert cycle.failures == 0


@pytest.mark.slow
def test_a_step_that_is_not_found_as_a_whole_is_taken_in_parts() -> None:
    # straight relief leaves the line with an edge, and solids touch there: whole steps take up to
    # nine Newton steps, so that one is not found with the eight that are allowed here
    film = jamali_2015_film("a", k=0.0, nodes=(97, 161), solids=SolidContact(thickness=10e-9))
    film = dataclasses.replace(film, extent=(-2.75, 2.75))
    march = FilmMarch(
        film.moving_film(),
        film.time_step,
        start_time=460 * film.time_step,
        settings=dataclasses.replace(MARCH_SETTINGS, newton_steps=8),
    )
    outcomes = [march.step(throw=False) for _ in range(30)]
    assert all(solution.converged for solution in outcomes)
    assert any("in 2 parts, by backward Euler" in solution.outcome for solution in outcomes)
    # the parts carry the load of the whole step's end
    assert max(abs(solution.load_error) for solution in outcomes) < 1e-3
