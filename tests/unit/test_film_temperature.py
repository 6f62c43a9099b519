"""Temperatures of a film and its surfaces on one grid: what goes in, balance, turns, factors."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.signal import convolve2d

from gearlube_core.contact.solid import Solid
from gearlube_core.ehl.line import energy as line_energy
from gearlube_core.ehl.point.scaling import PointScales
from gearlube_core.ehl.point.thermal import energy, surfaces
from gearlube_core.ehl.point.thermal.surfaces import FilmTemperature, moving_heat_coefficients
from gearlube_core.oil.film_laws import log_viscosity
from gearlube_core.oil.film_oil_data import film_oil
from gearlube_core.oil.oil_heat import OilHeat
from gearlube_core.oil.roelands_1966 import GLASS_TEMPERATURE
from tests.helpers.ehl_point_cases import moes_contact
from tests.helpers.source_of import interpret, source_of

STEEL = Solid(
    youngs_modulus=210e9, poisson_ratio=0.3, density=7850.0, conductivity=46.0, heat_capacity=470.0
)
GLASS = replace(STEEL, density=2500.0, conductivity=1.1, heat_capacity=840.0)
T0, HEIGHTS, NODES = 330.0, 5, (9, 7)
SPEED = (0.9, 0.5)


@pytest.fixture(autouse=True)
def uncompiled(monkeypatch):
    interpret(monkeypatch, surfaces, energy, line_energy)


def temperatures(oil_heat: OilHeat, slide_roll: float | None = 0.4) -> FilmTemperature:
    oil = film_oil(
        eta0=0.04, alpha=1.5e-8, law="houpert", temperature=T0, temperature_exponent=1.1,
        heat=oil_heat,
    )  # fmt: skip
    problem = replace(
        moes_contact(50.0, 8.0, nodes=(17, 17), lubricant=oil),
        entrainment=SPEED,
        # not along entrainment
        sliding=slide_roll and (slide_roll * SPEED[0], -0.5 * slide_roll * SPEED[1]),
    )
    spacing = SimpleNamespace(dx=0.41, dy=0.37)
    level = SimpleNamespace(scales=PointScales.of(problem), shape=NODES[::-1], grid=spacing)
    return FilmTemperature(problem, (STEEL, GLASS), level, HEIGHTS)


def state_of(one: FilmTemperature, pressure: np.ndarray, film: np.ndarray) -> SimpleNamespace:
    """Return a state with a fluidity of its own along each axis, and a given cross flow."""
    like = np.ones(one.level.shape)
    return SimpleNamespace(
        oil=pressure / one.level.scales.pressure,
        film=film / one.level.scales.film,
        density=1.07 * like,
        fluidity=0.3 * like,
        film_flow=SimpleNamespace(fluidity_x=0.2 * like, fluidity_y=0.35 * like),
        shear=SimpleNamespace(with_cross_velocity=lambda flow, *_: (flow[0] + 1e-3, flow[1])),
    )


def bump(one: FilmTemperature, low: float = 1e7) -> SimpleNamespace:
    y, x = (np.linspace(-1.0, 1.0, n) for n in one.level.shape)
    round_ = np.maximum(0.0, 1.0 - x**2 - 0.5 * y[:, None] ** 2)
    return state_of(one, low + 4e8 * round_, 3e-7 * (1.5 - 0.5 * round_))


def test_a_plane_of_pressure_pumps_oil_by_its_slopes():
    one = temperatures(OilHeat())
    scales, (ny, nx) = one.level.scales, one.level.shape
    dx, dy = one.steps
    assert (dx, dy) == pytest.approx(
        (one.level.grid.dx * scales.length, one.level.grid.dy * scales.length)
    )
    j, i = np.indices((ny, nx))
    slope_x, slope_y, h = 2e10, -3e10, 4e-7
    p = 5e8 + slope_x * dx * i + slope_y * dy * j
    found = one.film(state_of(one, p, np.full((ny, nx), h)))
    assert found.slope_x == pytest.approx(slope_x, rel=1e-9)
    assert found.slope_y == pytest.approx(slope_y, rel=1e-9)
    # mean speed of Poiseuille's flow, viscosity over the fluidity of its axis
    assert found.pumped_x == pytest.approx(-(h**2) * 0.2 * slope_x / (12 * 0.04) + 1e-3)
    assert found.pumped_y == pytest.approx(-(h**2) * 0.35 * slope_y / (12 * 0.04))
    sliding = np.array([0.4 * SPEED[0], -0.2 * SPEED[1]])
    unit = sliding / np.linalg.norm(sliding)
    assert one.sliding == pytest.approx(np.linalg.norm(sliding))
    assert found.along.p_slope == pytest.approx(unit @ (slope_x, slope_y), rel=1e-9)
    assert found.across == pytest.approx(unit @ (slope_y, -slope_x), rel=1e-9)
    assert found.along.p == pytest.approx(p.ravel())
    assert found.along.h == pytest.approx(h)
    assert found.along.rho == pytest.approx(1.07 * 870.0)


def test_oil_is_not_pumped_faster_than_it_is_carried_and_films_are_never_closed():
    one = temperatures(OilHeat())
    j, i = np.indices(one.level.shape)
    steep = 5e8 + 4e13 * (one.steps[0] * i + one.steps[1] * j)
    found = one.film(state_of(one, steep, np.full(i.shape, 4e-7)))
    assert np.hypot(found.pumped_x, found.pumped_y) == pytest.approx(math.hypot(*SPEED))
    closed = one.film(state_of(one, np.full(i.shape, 5e8), np.zeros(i.shape)))
    assert (closed.along.h == 1e-12).all()


def test_half_of_the_film_counts_as_broken_at_a_millionth_of_the_dry_pressure():
    one = temperatures(OilHeat())
    hertz = one.level.scales.pressure
    film = np.full(one.level.shape, 4e-7)
    for share, wet in ((1e-6, 0.5), (3e-6, 0.75), (0.0, 0.0), (1.0, 1.0)):
        found = one.film(state_of(one, np.full(film.shape, share * hertz), film))
        assert found.along.wet == pytest.approx(wet, rel=2e-6)


def test_surfaces_move_with_half_the_sliding_less_and_more():
    one = temperatures(OilHeat())
    m = one.motion
    assert (m.u_1, m.v_1) == pytest.approx((0.8 * SPEED[0], 1.1 * SPEED[1]))
    assert (m.u_2, m.v_2) == pytest.approx((1.2 * SPEED[0], 0.9 * SPEED[1]))
    assert (m.dx, m.dy, m.temperature) == (*one.steps, T0)
    assert (T0 == one.T).all()
    rolling = temperatures(OilHeat(), slide_roll=None)
    m = rolling.motion
    assert (m.u_1, m.v_1, m.u_2, m.v_2) == pytest.approx((*SPEED, *SPEED))
    assert rolling.direction == pytest.approx(np.array(SPEED) / np.hypot(*SPEED))
    film = rolling.film(state_of(rolling, np.full((7, 9), 5e8), np.full((7, 9), 4e-7)))
    rolling.judge(film)
    assert rolling.balance == math.inf  # no heat at all


def rises(one: FilmTemperature, flux: np.ndarray) -> list[np.ndarray]:
    """Return rises of temperature (ny, nx) of the two surfaces, added up one by one."""
    m, (ny, nx) = one.motion, one.level.shape
    found = []
    for solid, u, q in zip((STEEL, GLASS), ((m.u_1, m.v_1), (m.u_2, m.v_2)), flux, strict=True):
        coefficients = moving_heat_coefficients(solid, u, one.steps, (nx, ny))
        # every cell under every other: offsets from -(n - 1) to n - 1
        whole = convolve2d(coefficients, q.reshape(ny, nx))
        found.append((whole[ny - 1 : 2 * ny - 1, nx - 1 : 2 * nx - 1], coefficients.sum()))
    return found


def test_balance_before_any_turn_is_all_heat_and_what_it_would_warm_the_surfaces_by():
    one = temperatures(OilHeat())
    film = one.film(bump(one))
    one.judge(film)
    # oil and surfaces as warm as the inlet: nothing is carried or conducted
    cells = one.heat.source * film.along.h[:, None] / (HEIGHTS - 1)
    flux = 0.5 * cells[:, [0, -1]].T
    assert one.flux == pytest.approx(flux)
    made = cells[:, 1:-1].sum() + flux.sum()
    lacking = cells[:, 1:-1].sum()
    lacking += sum(np.abs(rise).sum() / total for rise, total in rises(one, flux))
    assert one.balance == pytest.approx(lacking / made)


def test_everywhere_gives_stress_to_a_broken_film():
    one = temperatures(OilHeat())
    film = one.film(bump(one, low=0.0))
    broken = film.along.wet == 0.0
    assert broken.any()
    one.judge(film)
    assert not one.heat.stress[broken].any()
    one.judge(film, everywhere=True)
    assert one.heat.stress[broken].all()


def test_one_turn_solves_film_and_surfaces_where_the_oil_carries_no_heat():
    # columns meet through the surfaces alone, and the heat of shear does not change
    one = temperatures(OilHeat(heat_capacity=1e-6))
    film = one.film(bump(one))
    one.judge(film)
    one.heat.decline[:] = 0.0
    lacking = np.empty(2)
    for turn in range(2):
        one.turn(film)
        flux = np.empty((2, one.T.shape[0]))
        nx = one.level.shape[1]
        inner, made = energy.heat_balance(film, one.motion, one.oil, one.heat, one.T, nx, flux)
        assert inner < 1e-9 * made
        wrong = [
            np.abs(T0 + rise.ravel() - surface).sum() / (surface - T0).sum()
            for (rise, _), surface in zip(rises(one, flux), one.T[:, [0, -1]].T, strict=True)
        ]
        lacking[turn] = max(wrong)
    assert lacking[0] < 0.04  # the surfaces' equations are solved to 0.02
    assert lacking[1] < 0.04 * lacking[0]
    assert one.T.max() > T0 + 1.0


def test_turns_end_with_all_heat_in_the_bodies_and_the_oil_that_leaves():
    one = temperatures(OilHeat(expansion=6e-4))
    film = one.film(bump(one))
    for _ in range(12):
        one.judge(film)
        if one.balance < 1e-5:
            break
        one.turn(film)
    assert one.balance < 1e-5
    surfaces_ = one.T[:, [0, -1]].T
    for (rise, _), surface in zip(rises(one, one.flux), surfaces_, strict=True):
        assert surface - T0 == pytest.approx(rise.ravel(), abs=1e-4 * rise.max())


@pytest.mark.parametrize(("heat", "share"), [(1e25, 20.0), (-1e25, 0.3)])
def test_temperatures_of_a_turn_stay_within_bounds(heat: float, share: float):
    one = temperatures(OilHeat())
    film = one.film(bump(one))
    one.heat.source[:] = heat
    one.turn(film)
    bound = GLASS_TEMPERATURE + share * (T0 - GLASS_TEMPERATURE)
    assert (one.T.max() if heat > 0.0 else one.T.min()) == pytest.approx(bound)
    assert ((bound - one.T) * math.copysign(1.0, heat) >= -1e-9).all()


def test_factors_are_those_of_the_viscosity_and_of_the_mean_temperature():
    one = temperatures(OilHeat(expansion=6e-4))
    film = one.film(bump(one))
    rng = np.random.default_rng(4)
    one.T[:] = T0 + rng.uniform(0.0, 60.0, one.T.shape)
    one.heat.viscosity[:] = 0.02 * np.exp(1e-8 * film.along.p)
    cooling, dilation = one.factors(film)
    mean = np.trapezoid(one.T, axis=1) / (HEIGHTS - 1)
    assert dilation.ravel() == pytest.approx(1.0 - 6e-4 * (mean - T0))
    law = source_of(log_viscosity)
    for p, factor, eta in zip(film.along.p, cooling.ravel(), one.heat.viscosity, strict=True):
        assert 0.04 * math.exp(law(one.oil.viscosity, p, factor)[0]) == pytest.approx(eta)
    one.T[:] = T0 + 2000.0
    assert (one.factors(film)[1] == 0.1).all()
