"""Boundaries of the traction map against scans of the thermal Eyring film."""

import math

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from gearlube_core.friction.johnson_greenwood_1980 import (
    thermal_eyring_film,
    thermal_newtonian_stress,
)
from gearlube_core.friction.traction_regime import (
    EYRING,
    LARGEST_X_STAR_SQUARED,
    NEWTONIAN,
    NEWTONIAN_LIMIT,
    PLASTIC,
    REGIMES,
    TractionRegime,
    largest_stress_ratio,
    traction_regime,
)
from tests.helpers.each import each

BETA, K, TAU0, H = 0.06, 0.112, 2e6, 0.5e-6
FILM_NUMBER_OF_UNIT_VISCOSITY = math.log(2.0 * K / (BETA * (TAU0 * H) ** 2))
LOG_ETA0 = math.log(0.095)


def place(
    map_number: float, slip: float, limiting: float = math.inf, G: float = math.inf
) -> TractionRegime:
    log_eta = map_number - FILM_NUMBER_OF_UNIT_VISCOSITY
    s = thermal_eyring_film(log_eta, BETA, K, TAU0, H, slip).stress_ratio
    return traction_regime(log_eta, LOG_ETA0, BETA, K, TAU0, H, slip, s, limiting, G, 4.6, 2e-4)


def best_stress(map_number: float, tau0: float) -> float:
    """Return the largest stress [Pa] over sliding speeds, by scan and refinement."""
    log_eta = map_number - FILM_NUMBER_OF_UNIT_VISCOSITY

    def loss(log_slip: float) -> float:
        slip = math.exp(log_slip)
        return -tau0 * thermal_eyring_film(log_eta, BETA, K, tau0, H, slip).stress_ratio

    start = min(np.linspace(-15.0, 12.0, 200), key=loss)
    return -float(minimize_scalar(loss, bracket=(start - 0.2, start, start + 0.2)).fun)


def test_largest_temperature_parameter() -> None:
    Y = np.linspace(0.5, 2.0, 300001)
    # grid: second order about the maximum
    assert pytest.approx(float(np.max(Y / np.cosh(Y))) ** 2, rel=1e-9) == LARGEST_X_STAR_SQUARED
    assert pytest.approx(-0.56356, abs=1e-5) == NEWTONIAN_LIMIT


@each("map_number", [-6.0, -0.5, 2.0, 7.0, 15.0])
def test_largest_stress_is_the_maximum_over_sliding_speeds(map_number: float) -> None:
    # maximum of a smooth curve: error of the search squared
    assert largest_stress_ratio(map_number) * TAU0 == pytest.approx(
        best_stress(map_number, TAU0), rel=1e-8
    )


@each("over", [-30.0, -3.0, -1e-12, 0.0, 1e-12, 1e-3, 1.0, 4.0, 200.0])
def test_largest_stress_solves_its_equation_on_the_boundary_too(over: float) -> None:
    # s sinh s = 4 X*^2 exp(L), which is 1 on the boundary
    s = largest_stress_ratio(NEWTONIAN_LIMIT + over)
    # the iteration ends at steps of 1e-8, and converges with their square
    assert math.log(s) + math.log(math.sinh(s)) == pytest.approx(over, abs=1e-13, rel=1e-13)


def test_newtonian_boundary_is_where_heat_keeps_the_stress_at_the_eyring_stress() -> None:
    log_eta = NEWTONIAN_LIMIT - FILM_NUMBER_OF_UNIT_VISCOSITY
    slips = np.geomspace(1e-3, 1e5, 20001)
    largest = max(thermal_newtonian_stress(log_eta, BETA, K, H, float(u)) for u in slips)
    # grid: second order about the maximum
    assert largest == pytest.approx(TAU0, rel=1e-6)


def test_regions_of_the_map() -> None:
    assert place(NEWTONIAN_LIMIT - 0.01, 1.0).limit == NEWTONIAN
    assert place(NEWTONIAN_LIMIT + 0.01, 1.0).limit == EYRING
    s = largest_stress_ratio(8.0)
    assert place(8.0, 1.0, limiting=1.001 * s * TAU0).limit == EYRING
    assert place(8.0, 1.0, limiting=0.999 * s * TAU0).limit == PLASTIC


def test_state_follows_sliding_speed() -> None:
    log_eta = 8.0 - FILM_NUMBER_OF_UNIT_VISCOSITY
    departure = TAU0 * H / math.exp(log_eta)  # eta dU/h = tau0
    assert place(8.0, 0.999 * departure).state == NEWTONIAN
    assert place(8.0, 1.001 * departure).state == EYRING
    assert place(8.0, departure).slip_number == pytest.approx(1.0, rel=1e-12)
    # asinh(1)/1: the departure is 12 % by then
    s = thermal_eyring_film(log_eta, BETA, K, TAU0, H, departure).stress_ratio
    assert s == pytest.approx(math.asinh(1.0), rel=1e-3)
    yielding = 0.5 * largest_stress_ratio(8.0) * TAU0
    assert place(8.0, 0.01 * departure, limiting=yielding).state == NEWTONIAN
    assert place(8.0, 1e4 * departure, limiting=yielding).state == PLASTIC


def test_thermal_onset_and_loss() -> None:
    slips = np.geomspace(1e-6, 30.0, 60)
    losses = [place(8.0, float(u)).thermal_loss for u in slips]
    assert np.all(np.diff(losses) > -1e-12)
    assert losses[0] == pytest.approx(0.0, abs=1e-9)
    assert losses[-1] > 0.5
    flags = [place(8.0, float(u)).thermal for u in slips]
    assert flags == [float(loss > 0.1) for loss in losses]


def test_coordinates_add_up_and_do_not_depend_on_units() -> None:
    here = place(6.0, 2.0)
    assert here.pressure_number + here.film_number == pytest.approx(6.0, abs=1e-12)
    assert place(6.0, 0.0).thermal_loss == 0.0
    # kelvin to rankine
    log_eta = 6.0 - FILM_NUMBER_OF_UNIT_VISCOSITY
    rankine = traction_regime(
        log_eta, LOG_ETA0, BETA / 1.8, K / 1.8, TAU0, H, 2.0,
        thermal_eyring_film(log_eta, BETA, K, TAU0, H, 2.0).stress_ratio,
        math.inf, math.inf, 4.6, 2e-4,
    )  # fmt: skip
    np.testing.assert_allclose(rankine, here, rtol=1e-12)


def test_deborah_number_is_relaxation_time_over_passage_time() -> None:
    log_eta = 6.0 - FILM_NUMBER_OF_UNIT_VISCOSITY
    # eta/G over a/U
    expected = math.exp(log_eta) / 1e9 / (2e-4 / 4.6)
    assert place(6.0, 1.0, G=1e9).deborah_number == pytest.approx(expected, rel=1e-13)
    assert place(6.0, 1.0).deborah_number == 0.0


def test_every_regime_has_a_name() -> None:
    assert sorted(REGIMES) == [NEWTONIAN, EYRING, PLASTIC]
