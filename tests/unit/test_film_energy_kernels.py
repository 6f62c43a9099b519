"""Energy of a point contact's film: kernels against whole arrays and dense matrices of columns."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from gearlube_core.ehl.line import energy as line_energy
from gearlube_core.ehl.line.energy import FilmFields
from gearlube_core.ehl.point.thermal import energy
from gearlube_core.ehl.point.thermal.energy import PointFilm, PointHeat, PointMotion
from gearlube_core.oil.film_oil import FilmOil, limiting_stress, thermal_viscosity
from gearlube_core.oil.film_oil_data import film_oil
from gearlube_core.oil.oil_heat import OilHeat
from tests.helpers.source_of import interpret

NY, NX, M = 4, 5, 6
N = NY * NX
MOTION = PointMotion(1.5, -0.6, 2.5, 0.5, 2e-5, 3e-5, 330.0)
OIL = film_oil(
    eta0=0.04, alpha=2e-8, law="houpert", temperature=330.0, temperature_exponent=1.1,
    heat=OilHeat(expansion=6.5e-4),
)  # fmt: skip
# under pressure it conducts more: 0.315 W/(m K) at 1 GPa for 0.154 at ambient
PRESSED = film_oil(
    eta0=0.04, alpha=2e-8, law="houpert", temperature=330.0, temperature_exponent=1.1,
    heat=OilHeat(6.5e-4, 0.154, 2080.0, "pao"),
)  # fmt: skip
ROUNDING = 1e-10  # relative: sums in another order, and solutions of well-conditioned columns


@pytest.fixture(autouse=True)
def uncompiled(monkeypatch):
    interpret(monkeypatch, energy, line_energy)


def film_and_heat() -> tuple[PointFilm, PointHeat, np.ndarray]:
    """Return fields without any order, so that nothing cancels; oil flows both ways."""
    any_of = np.random.default_rng(3)

    def field(low: float, high: float, *shape: int) -> np.ndarray:
        return any_of.uniform(low, high, shape or (N,))

    wet = field(0.2, 1.0)
    along = FilmFields(
        field(1e8, 9e8), field(-1e12, 1e12), field(2e-7, 9e-7), field(850, 990), field(-1, 1), wet
    )
    film = PointFilm(
        along, field(-1e12, 1e12), field(-2e12, 2e12), field(-2e12, 2e12), field(-3, 3),
        field(-2, 2),
    )  # fmt: skip
    heat = PointHeat(field(1e12, 9e12, N, M), field(0.01, 0.04), field(0, 1), field(0, 1))
    return film, heat, field(330.0, 400.0, N, M)


def carried_in(T: np.ndarray, speed: np.ndarray, axis: int, step: float) -> np.ndarray:
    """Return -|u| dT/dx upstream of (ny, nx, m), of second order where oil has come two nodes."""
    inlet = MOTION.temperature

    def difference(ahead: bool) -> np.ndarray:
        moved = T if ahead else np.flip(T, axis)
        moved = np.moveaxis(moved, axis, 0)
        change = np.diff(moved, axis=0, prepend=np.full_like(moved[:1], inlet))
        if ahead:  # oil that flows back is carried by differences of first order
            change[2:] = 1.5 * moved[2:] - 2.0 * moved[1:-1] + 0.5 * moved[:-2]
        change = np.moveaxis(change, 0, axis)
        return change if ahead else np.flip(change, axis)

    return -np.abs(speed) * np.where(speed > 0.0, difference(True), difference(False)) / step


def heat_left(
    film: PointFilm, heat: PointHeat, T: np.ndarray, warmed: np.ndarray, oil: FilmOil = OIL
) -> np.ndarray:
    """Return heat made less carried less conducted of all cells (n, m) [W/m2].

    Compression warms the oil as if it had the temperatures `warmed`.
    """
    f, grid = film.along, (NY, NX, M)
    zeta = np.linspace(0.0, 1.0, M)
    bulge = 6.0 * zeta * (1.0 - zeta)  # of mean 1 over the film
    u = np.outer(film.pumped_x, bulge) + (1.0 - zeta) * MOTION.u_1 + zeta * MOTION.u_2
    v = np.outer(film.pumped_y, bulge) + (1.0 - zeta) * MOTION.v_1 + zeta * MOTION.v_2
    between = f.h[:, None] / (M - 1)
    thickness = between * np.array([0.5] + [1.0] * (M - 2) + [0.5])
    whole = T.reshape(grid)
    brought = carried_in(whole, u.reshape(grid), 1, MOTION.dx)
    brought += carried_in(whole, v.reshape(grid), 0, MOTION.dy)
    conductivity, capacity = np.full(N, OIL.conductivity), OIL.heat_capacity * f.rho
    if oil is PRESSED:
        GPa = 1e-9 * f.p
        conductivity = 0.154 * (1.0 + 1.40 * GPa / (1.0 + 0.34 * GPa))
        capacity = oil.rho0 * 2080.0 * (1.0 + 0.41 * GPa / (1.0 + 1.05 * GPa))
    left = capacity[:, None] * brought.reshape(N, M)
    rising = u * film.slope_x[:, None] + v * film.slope_y[:, None]
    left += OIL.expansion * f.wet[:, None] * warmed * rising
    left = (left + heat.source) * thickness
    conducted = conductivity[:, None] * np.diff(T, axis=1) / between
    left[:, :-1] += conducted
    left[:, 1:] -= conducted
    return left


@pytest.mark.parametrize("oil", [OIL, PRESSED], ids=["constant", "under pressure"])
def test_balance_of_every_cell_is_that_of_whole_arrays(oil):
    film, heat, T = film_and_heat()
    flux = np.empty((2, N))
    lacking, made = energy.heat_balance(film, MOTION, oil, heat, T, NX, flux)
    left = heat_left(film, heat, T, T, oil)
    assert flux == pytest.approx(left[:, [0, -1]].T, rel=ROUNDING)
    assert lacking == pytest.approx(np.abs(left[:, 1:-1]).sum(), rel=ROUNDING)
    assert made == pytest.approx((np.trapezoid(heat.source) * film.along.h / (M - 1)).sum())


def test_oil_at_the_inlet_temperature_at_rest_keeps_it():
    film, heat, _ = film_and_heat()
    still = film._replace(pumped_x=np.zeros(N), pumped_y=np.zeros(N))
    motion = PointMotion(0.0, 0.0, 0.0, 0.0, 2e-5, 3e-5, 330.0)
    heat.source[:] = 0.0
    flux = np.empty((2, N))
    lacking, made = energy.heat_balance(still, motion, OIL, heat, np.full((N, M), 330.0), NX, flux)
    assert (lacking, made) == (0.0, 0.0)
    assert not flux.any()


@pytest.mark.parametrize("upwards", [True, False])
@pytest.mark.parametrize(("forwards", "oil"), [(True, OIL), (False, OIL), (False, PRESSED)])
def test_sweep_solves_columns_in_turn_as_dense_matrices_do(
    upwards: bool, forwards: bool, oil: FilmOil
):
    film, heat, start = film_and_heat()
    T = start.copy()
    flux, conductance, shape = np.empty((2, N)), np.empty((3, N)), np.empty((2, N, M))
    energy.sweep_film(film, MOTION, oil, heat, NX, upwards, forwards, T, flux, conductance, shape)

    expected = start.copy()
    weights = np.array([0.5] + [1.0] * (M - 2) + [0.5])
    falls = heat.decline[:, None] * heat.source * film.along.h[:, None] / (M - 1) * weights
    rows, columns = range(NY)[:: 1 if upwards else -1], range(NX)[:: 1 if forwards else -1]
    inner = slice(1, M - 1)
    for node in (row * NX + column for row in rows for column in columns):

        def column_left(column: np.ndarray, node: int = node) -> np.ndarray:
            changed = expected.copy()
            changed[node] = column
            left = heat_left(film, heat, changed, start, oil)[node]
            return np.asarray(left - falls[node] * (column - start[node]))

        now = expected[node].copy()
        left = column_left(now)
        # linear in the column's temperatures, so that differences are derivatives
        matrix = np.array([column_left(now + 10.0 * unit) - left for unit in np.eye(M)]).T / 10.0
        solved = matrix[inner, inner]
        expected[node, inner] -= np.linalg.solve(solved, left[inner])
        assert flux[:, node] == pytest.approx(column_left(expected[node])[[0, -1]], rel=1e-7)
        by_walls = np.zeros((M, 2))
        by_walls[[0, -1], [0, 1]] = 1.0
        by_walls[inner] = -np.linalg.solve(solved, matrix[inner][:, [0, -1]])
        assert shape[:, node] == pytest.approx(by_walls.T, abs=1e-9)
        (own_1, both), (also, own_2) = matrix[[0, -1]] @ by_walls
        assert also == pytest.approx(both, rel=1e-7)
        assert conductance[:, node] == pytest.approx([-own_1, both, -own_2], rel=1e-7)
    assert expected == pytest.approx(T, rel=1e-9)


def test_change_of_surfaces_goes_through_the_film_by_its_shape():
    any_of = np.random.default_rng(5)
    change, shape, T = any_of.random((2, N)), any_of.random((2, N, M)), any_of.random((N, M))
    expected = T + change[0][:, None] * shape[0] + change[1][:, None] * shape[1]
    energy.add_surface_change(change, shape, T)
    assert pytest.approx(expected, rel=1e-14) == T


def sheared(film: PointFilm, i: int, T: np.ndarray, sliding: float, oil: FilmOil) -> tuple:
    """Return stress [Pa] at mid-film and heat (m,) [W/m3] of a full film along sliding, Eyring."""
    f, z = film.along, np.linspace(-0.5, 0.5, M)
    eta = np.array([thermal_viscosity(oil, f.p[i], one) for one in T[i]])
    tau0 = oil.shear.tau0

    def rate(stress: np.ndarray) -> np.ndarray:
        return np.asarray(tau0 / eta * np.sinh(stress / tau0) if tau0 > 0.0 else stress / eta)

    def missing(tau: float) -> float:
        return float(np.trapezoid(rate(tau + f.p_slope[i] * f.h[i] * z), z) - sliding / f.h[i])

    tau = brentq(missing, -5e8, 5e8, xtol=1e-6, rtol=1e-15) if tau0 == 0.0 else brentq(
        missing, -40.0 * tau0, 40.0 * tau0, xtol=1e-6, rtol=1e-15)  # fmt: skip
    slipping, limit = 0.0, limiting_stress(oil, f.p[i])
    if abs(tau) > limit:
        tau = math.copysign(limit, tau)
        slipping = -missing(tau)
    stress = tau + f.p_slope[i] * f.h[i] * z
    return tau, stress * rate(stress) + tau * slipping


@pytest.mark.parametrize(
    "oil",
    [
        OIL,
        film_oil(
            eta0=0.04, alpha=1.2e-8, temperature=330.0, temperature_exponent=1.1, law="houpert",
            eyring_stress=5e5, limiting_shear=(1e5, 0.0005),
        ),
    ],
    ids=["newton", "eyring"],
)  # fmt: skip
def test_heat_of_shear_is_stress_times_rate_and_falls_as_differences_say(oil: FilmOil):
    film, heat, T = film_and_heat()
    f = film.along
    f.p[:] *= 0.3
    f.p_slope[:4], film.across[:4] = 0.0, 0.0  # shear alone
    f.wet[:] = 1.0
    f.wet[3], f.wet[9], f.wet[10] = 0.4, 0.0, 0.0
    film.across[[3, 8]] = 0.0
    sliding, dT = -2.0, 1e-3
    z, slips = np.linspace(-0.5, 0.5, M), 0
    for everywhere in (True, False):
        energy.fill_heat(film, T, sliding, everywhere, oil, heat)
        for i in range(N):
            eta = np.array([thermal_viscosity(oil, f.p[i], one) for one in T[i]])
            # what flows by pressure is the integral of z^2/eta, whatever the rule's own error
            fluidity = np.trapezoid(z * z / eta, z) / np.trapezoid(z * z, z)
            assert heat.viscosity[i] == pytest.approx(1.0 / fluidity, rel=1e-12)
            if f.wet[i] == 0.0 and not everywhere:
                assert not heat.source[i].any()
                assert (heat.stress[i], heat.decline[i]) == (0.0, 0.0)
                continue
            tau, source = sheared(film, i, T, sliding, oil)
            assert heat.stress[i] == pytest.approx(tau, rel=1e-8)
            source *= f.wet[i]
            if f.wet[i] > 0.0:
                source += (film.across[i] * f.h[i] * z) ** 2 * fluidity
            assert heat.source[i] == pytest.approx(source, rel=1e-7, abs=1e-9 * source.max())
            if abs(tau) == pytest.approx(limiting_stress(oil, f.p[i])):
                slips += 1
                assert heat.decline[i] == 0.0
                continue
            # stress at the same rate, the viscosity of mid-film a little warmer and colder
            tau0, mid, middle = oil.shear.tau0, T[i, M // 2], []
            for warmer in (mid + dT, mid - dT):
                ratio = thermal_viscosity(oil, f.p[i], warmer) / eta[M // 2]
                here = tau * ratio
                if tau0 > 0.0:
                    here = tau0 * math.asinh(ratio * math.sinh(tau / tau0))
                middle.append(math.log(abs(here)))
            assert heat.decline[i] == pytest.approx((middle[1] - middle[0]) / (2 * dT), rel=1e-5)
    assert (slips > 0) == (oil.limit_slope > 0.0)
    assert slips < N
