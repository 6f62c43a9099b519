"""Numbers reported for a line film, from fields with closed forms; how a state becomes a result."""

from __future__ import annotations

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.ehl.line import solution as module
from gearlube_core.ehl.line.oil_beyond import NOTHING
from gearlube_core.ehl.line.solution import LineSolution, build_solution, void_behind_ruptures
from tests.helpers.each import each

LOAD = 2e5  # N/m


def result(x: np.ndarray, **given) -> LineSolution:
    """Return a result that holds the fields given; others are not needed."""
    fields = dict.fromkeys(one.name for one in dataclasses.fields(LineSolution) if one.init)
    for name in ("coarser", "wider", "time_error"):
        del fields[name]
    fields |= {"beyond": NOTHING}
    fields |= {"mean_stress": np.zeros_like(x), "mass_flow": np.zeros(x.size - 1)}
    problem = SimpleNamespace(line_load=LOAD, entrainment_speed=3.0)
    fields |= {"problem": problem, "records": (), "converged": True}
    return LineSolution(**fields | {"x": x} | given)


@each(("first", "last"), [(-4.0, 3.0), (0.0, 7.0), (-7.0, 0.0), (-6.0, 1.0), (-1.0, 6.0)])
def test_central_film_is_that_of_the_cubic_through_four_nodes_around_the_middle(first, last):
    x = np.linspace(first, last, 8) * 1.1e-4 + 3e-5 * (first < 0.0 < last)
    film = 5e-7 + 2e-3 * x - 7.0 * x**2 + 4e4 * x**3
    assert result(x, film=film).central_film == pytest.approx(5e-7, rel=1e-10)


def test_central_film_takes_two_nodes_on_each_side():
    x = np.array([-2.5, -1.5, -0.5, 0.5, 1.5, 2.5]) * 1e-4
    film = np.array([9.0, 1.0, 2.0, 4.0, 3.0, 9.0]) * 1e-7
    # Lagrange's weights halfway between equal steps
    expected = (-1.0 + 9.0 * 2.0 + 9.0 * 4.0 - 3.0) / 16.0 * 1e-7
    assert result(x, film=film).central_film == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(("first", "node"), [(0.0, 0), (-1.0, 1), (-4.0, 4), (-5.0, 5)])
def test_central_film_of_a_node_at_the_middle_is_its_own_also_near_a_border(first, node):
    x = np.linspace(first, first + 5.0, 6) * 1e-4
    film = np.array([2.0, 9.0, 4.0, 7.0, 3.0, 8.0]) * 1e-7
    assert result(x, film=film).central_film == pytest.approx(film[node], rel=1e-9)


def test_extremes_are_those_of_parabolas_and_of_borders():
    x = np.linspace(-1.0, 1.0, 9)
    pressure = 6e8 - 3e8 * (x - 0.07) ** 2
    film = 4e-7 + 2e-7 * (x + 0.31) ** 2
    found = result(x, film=film, pressure=pressure)
    assert found.maximum_pressure == pytest.approx(6e8, rel=1e-12)
    assert found.minimum_film == pytest.approx(4e-7, rel=1e-12)
    for slope in (1e-7, -1e-7):
        assert result(x, film=4e-7 + slope * x).minimum_film == pytest.approx(3e-7, rel=1e-12)
    flat = np.full(9, 4e-7)
    assert result(x, film=flat).minimum_film == 4e-7


def test_stresses_on_both_bodies_balance_the_pressure_on_their_wedge():
    x = np.linspace(-1e-3, 1e-3, 41)
    slope, h, tau = 3e10, 4e-7, -2e5
    found = result(
        x,
        film=np.full(41, h),
        pressure=1e9 + slope * x,
        mean_stress=np.full(41, tau),
        mass_flow=np.zeros(40),
    )
    assert found.stress_1 == pytest.approx(tau - 0.5 * h * slope)
    assert found.stress_2 == pytest.approx(-tau - 0.5 * h * slope)
    length = 2e-3
    assert found.friction == pytest.approx(
        ((tau - 0.5 * h * slope) * length, (-tau - 0.5 * h * slope) * length)
    )
    assert found.friction_coefficient == pytest.approx(tau * length / LOAD)
    numbers = found.numbers
    assert (numbers.central_film, numbers.minimum_film) == pytest.approx((h, h))
    assert numbers.maximum_pressure == pytest.approx(1e9 + slope * 1e-3)
    assert numbers.friction == found.friction_coefficient
    assert found.nodes == (41,)
    assert found.axes[0] is x


def test_mass_balance_is_told_of_full_nodes_only():
    pressure = np.array([0.0, 1.0, 1.0, 1.0, 0.0, 1.0])
    flow = np.array([9.0, -2.0, -3.0, 9.0, 9.0])
    found = result(np.arange(6.0), pressure=pressure, mass_flow=flow)
    assert found.mass_balance == pytest.approx(1.0 / 2.5)
    assert result(np.arange(6.0), pressure=np.zeros(6), mass_flow=flow).mass_balance == 0.0
    still = result(np.arange(6.0), pressure=np.ones(6), mass_flow=np.zeros(5))
    assert still.mass_balance == 0.0


@pytest.mark.parametrize("way", [1, -1])
def test_streaks_behind_a_rupture_hold_the_oil_that_passed_it(way):
    pressure = np.array([0.0, 2.0, 1.0, 0.0, 0.0, 3.0, 0.0])[::way]
    mass = np.array([9.0, 4.0, 2.0, 4.0, 8.0, 1.0, 5.0])[::way]
    # nothing is broken upstream; 2 of 4 and of 8, 1 of 5
    expected = np.array([0.0, 0.0, 0.0, 0.5, 0.75, 0.0, 0.8])[::way]
    assert void_behind_ruptures(pressure, mass, way * 2.0) == pytest.approx(expected)


def record(converged: bool) -> SimpleNamespace:
    return SimpleNamespace(
        residual=[0.5, 3e-9], load_error=[0.1, 2e-10], converged=converged, reason="it swings"
    )


def test_state_becomes_a_result_in_si(monkeypatch):
    n = 6
    rng = np.random.default_rng(2)
    rows = SimpleNamespace(
        eta=rng.random(n), rho=rng.random(n), flux=rng.random(n - 1), residual=rng.random(n)
    )
    scales = SimpleNamespace(pressure=1e9, film=2e-7, speed=3.0)
    touching = np.array([False, True, False, True, True, False])
    evaluated, seen = [], {}
    system = SimpleNamespace(
        scales=scales, oil=SimpleNamespace(eta0=0.04, rho0=870.0), rows=rows, touching=touching,
        x=np.sort(rng.random(n)), H=rng.random(n) + 0.3, evaluate=evaluated.append,
        load_error=lambda state: 0.25, beyond=NOTHING,
        problem=SimpleNamespace(flooded_beyond=False),
    )  # fmt: skip
    state = SimpleNamespace(P=rng.random(n), H0=-0.7, void=rng.random(n))
    problem = SimpleNamespace(speed_1=1.5, speed_2=4.0, radius=9.0)
    settings = SimpleNamespace(cavitation="mass_conserving")

    def stress(p, slope, h, void, eta, sliding, oil, tau):
        seen.update(p=p, slope=slope, h=h, void=void, eta=eta, sliding=sliding)
        tau[:] = 7.0

    monkeypatch.setattr(module, "fill_mean_stress", stress)
    records = ((3, record(False)), (n, record(True)))
    found = build_solution(system, state, settings, records, problem)
    assert evaluated == [state]
    assert found.pressure == pytest.approx(1e9 * state.P)
    assert found.film == pytest.approx(2e-7 * system.H)
    assert found.viscosity == pytest.approx(0.04 * rows.eta)
    assert found.density == pytest.approx(870.0 * rows.rho)
    flow = 870.0 * 2e-7 * 3.0
    assert found.mass_flow == pytest.approx(flow * rows.flux)
    assert found.contact_flow == pytest.approx(flow * rows.residual[[1, 3, 4]].sum())
    assert found.approach == pytest.approx(-1.4e-7)
    assert (found.residual, found.load_error, found.converged) == (3e-9, 0.25, True)
    assert seen["sliding"] == 2.5
    assert seen["slope"] == pytest.approx(np.gradient(found.pressure, system.x))
    assert (seen["h"] == found.film).all()
    assert (seen["void"] == state.void).all()
    assert (found.mean_stress == 7.0).all()
    assert found.outcome == (
        "Converged on 6 nodes: unbalanced flow 3.0e-09, load error 2.0e-10, solids touch at 3 "
        "nodes."
    )
    failed = build_solution(system, state, settings, ((n, record(False)),), problem)
    assert f"it swings; unbalanced flow 3.0e-09, smallest film {2e-7 * system.H.min():.2e} m" in (
        failed.outcome
    )
    system.touching = np.zeros(n, dtype=bool)
    apart = build_solution(system, state, settings, records, problem)
    assert apart.outcome == "Converged on 6 nodes: unbalanced flow 3.0e-09, load error 2.0e-10."
