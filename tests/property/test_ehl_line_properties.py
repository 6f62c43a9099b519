"""Line contact: void shares, traction, Newton's Jacobian, robustness over a map."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.ehl.line.newton import newton
from gearlube_core.ehl.line.problem import LineProblem, LineSettings
from gearlube_core.ehl.line.rows import fill_jacobian
from gearlube_core.ehl.line.solver import hertz_start, solve_line
from gearlube_core.ehl.line.system import LineState, LineSystem
from gearlube_core.oil.film_oil_data import film_oil, jamali_2015_oil
from tests.helpers.each import each
from tests.helpers.ehl_line_cases import thesis_line

THESIS = thesis_line(domain=(-1.0e-3, 0.38e-3))


@each("stencil", ["central", "upwind-1", "upwind-2", "galerkin"])
@each("speed", [1.0, -1.0])
def test_jacobian_is_the_derivative_of_the_balance(stencil, speed):
    contact = replace(THESIS, speed_1=speed * THESIS.speed_1, speed_2=speed * THESIS.speed_2)
    n = 41
    system = LineSystem(contact, n, stencil, True)
    rng = np.random.default_rng(3)
    void = np.zeros(n)
    if stencil != "galerkin":
        void[30:36] = rng.uniform(0.1, 0.5, 6)
    P = np.where(void > 0.0, 0.0, rng.uniform(0.05, 0.6, n))
    P[[0, -1]] = 0.0
    state = LineState(P, void, 1.5)
    system.coefficients = system.coefficients._replace(storage=3.0, weight=0.5)
    system.evaluate(state)
    nodes = np.arange(1, n - 1)
    voids = state.void[nodes] > 0.0
    J = np.empty((n - 1, n - 1), order="F")
    fill_jacobian(system.rows, system.deflection.influence, nodes, voids, J)
    direction = rng.uniform(-1.0, 1.0, n - 1)
    linear = J[:-1] @ direction
    dP, dvoid = np.zeros(n), np.zeros(n)
    dP[nodes[~voids]] = direction[:-1][~voids]
    dvoid[nodes[voids]] = direction[:-1][voids]
    quotient = np.zeros(n)
    eps = 1e-6
    for sign in (1.0, -1.0):
        moved = LineState(
            state.P + sign * eps * dP,
            state.void + sign * eps * dvoid,
            state.H0 + sign * eps * direction[-1],
        )
        system.evaluate(moved)
        quotient += sign * system.rows.residual / (2.0 * eps)
    # central differences: (1e-6)^2 of the curvature, rounding 1e-16/1e-6 of the largest term
    assert linear == pytest.approx(quotient[nodes], rel=1e-6, abs=1e-7 * np.abs(quotient).max())


def test_mass_conserving_rupture_keeps_the_flooded_film_and_the_flow():
    plain = solve_line(THESIS, LineSettings(nodes=501))
    kept = solve_line(THESIS, LineSettings(nodes=501, cavitation="mass_conserving"))
    # without reformation the pressure cannot tell; below 1e-3 p_H the stencil passes to first
    # order, which costs less than the grid's own 2e-3
    assert kept.central_film == pytest.approx(plain.central_film, rel=1e-3)
    assert kept.maximum_pressure == pytest.approx(plain.maximum_pressure, rel=1e-4)
    assert np.ptp(kept.mass_flow) < 1e-8 * kept.mass_flow.mean()
    assert np.ptp(plain.mass_flow) > 0.1 * plain.mass_flow.mean()
    # either full or without pressure, and the void carries what passed the exit
    assert np.all(kept.pressure * kept.void == 0.0)
    assert 0.3 < kept.void.max() < 1.0


@pytest.mark.slow
def test_starved_inlet_gives_the_film_that_the_supply_allows():
    flooded = solve_line(THESIS, LineSettings(nodes=501))
    gap = flooded.film[0]
    films = []
    for share in (0.8, 0.4):
        supply = share * flooded.central_film
        contact = replace(THESIS, inlet_fill=supply / gap)
        film = solve_line(contact, LineSettings(nodes=501, cavitation="mass_conserving"))
        assert np.ptp(film.mass_flow) < 1e-8 * film.mass_flow.mean()
        # all of the supply passes, none flows back: rho h u = rho0 supply u
        centre = np.interp(0.0, film.x, film.density * film.film) / 870.0
        assert centre == pytest.approx(supply * film.film[0] / gap, rel=0.02)
        assert film.void[0] > 0.9
        films.append(film.central_film)
        # the meniscus stands inside the inlet
        assert film.pressure[1] == 0.0
    assert films[1] < films[0] < flooded.central_film


def test_forces_on_the_two_bodies_and_the_pressure_balance():
    film = solve_line(THESIS, LineSettings(nodes=501))
    on_1, on_2 = film.friction
    # equilibrium of the oil along x: shear on both walls against p dh, to the grid's order
    slope = np.gradient(film.film, film.x)
    pushed = np.trapezoid(film.pressure * slope, film.x)
    assert on_1 + on_2 == pytest.approx(pushed, abs=2e-3 * abs(on_1))
    # body 1 is the faster one and is braked
    assert on_1 < 0.0 < on_2


def test_eyring_traction_is_below_newtonian_and_tends_to_it():
    newtonian = solve_line(replace(THESIS, lubricant=jamali_2015_oil(newtonian=True)))
    thinning = [
        solve_line(
            replace(THESIS, lubricant=film_oil(eta0=0.00625, alpha=13.3e-9, eyring_stress=t))
        )
        for t in (5e6, 20e6, 1e11)
    ]
    mu = [abs(film.friction_coefficient) for film in thinning]
    assert mu[0] < mu[1] < mu[2]
    # sinh x = x to x^2/6 at tau/tau0 < 1e-2
    assert mu[2] == pytest.approx(abs(newtonian.friction_coefficient), rel=1e-4)
    assert thinning[0].central_film <= newtonian.central_film


def test_limiting_stress_bounds_the_traction():
    oil = film_oil(eta0=0.00625, alpha=13.3e-9, eyring_stress=10e6, limiting_shear=(1e6, 0.02))
    film = solve_line(replace(THESIS, lubricant=oil), LineSettings(nodes=301))
    assert np.all(np.abs(film.mean_stress) <= 1e6 + 0.02 * film.pressure + 1e-6)
    assert abs(film.friction_coefficient) < 0.0215


def test_solution_does_not_depend_on_its_start():
    cold = solve_line(THESIS, LineSettings(nodes=301))
    light = solve_line(replace(THESIS, line_load=3e5), LineSettings(nodes=301))
    warm = solve_line(THESIS, LineSettings(nodes=301), start=light)
    system = LineSystem(THESIS, 301, "upwind-2", False)
    thick, record = newton(system, hertz_start(system, 5e-6), 1e-8, 60)
    assert record.converged
    # residual 1e-8 of the flow
    assert warm.film == pytest.approx(cold.film, rel=1e-6)
    assert system.film(thick) * system.scales.film == pytest.approx(cold.film, rel=1e-6)


def moes_contact(M: float, L: float, slide_roll: float, eyring_stress: float) -> LineProblem:
    """Return steel bodies, alpha 20 1/GPa, at given groups; L 0 at U = 1e-11."""
    modulus, radius, eta0 = 2.2e11, 0.01, 0.04
    alpha = 20e-9 if L > 0.0 else 0.0
    U = 0.5 * (L / (alpha * modulus)) ** 4 if L > 0.0 else 1e-11
    u = U * modulus * radius / eta0
    return LineProblem(
        lubricant=film_oil(
            eta0=eta0, alpha=alpha, eyring_stress=eyring_stress if slide_roll else None
        ),
        radius=radius,
        line_load=M * (2.0 * U) ** 0.5 * modulus * radius,
        reduced_modulus=modulus,
        speed_1=u * (1.0 + 0.5 * slide_roll),
        speed_2=u * (1.0 - 0.5 * slide_roll),
    )


@pytest.mark.slow
def test_every_contact_of_a_map_converges_without_tuning():
    # M 0.1 to 200, L 0 to 20 (Hertz pressure to 5.6 GPa), rolling to slide-roll 2 with 5 MPa
    failed = []
    count = 0
    for M in (0.1, 0.5, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0):
        for L in (0.0, 1.0, 2.5, 5.0, 7.5, 10.0, 15.0, 20.0):
            for slide_roll in (0.0, 0.1, 0.5, 1.0, 2.0):
                count += 1
                contact = moes_contact(M, L, slide_roll, 5e6)
                film = solve_line(contact, LineSettings(nodes=401), throw=False)
                if not (film.converged and film.film.min() > 0.0 and film.pressure.min() >= 0.0):
                    failed.append((M, L, slide_roll, film.outcome))
    assert count == 360
    assert not failed
