"""A density law written outside the package serves every film solution."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.density_law import density_in_units, density_ratio
from gearlube_core.oil.film_oil import density, density_slope
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.ehl_point_cases import flow_out
from tests.helpers.small_films import line_film, oil_balance, point_film


class Tait(NamedTuple):
    """V/V0 = 1 - ln[1 + (1 + K') p/K0]/(1 + K').

    Source: Tait's equation as Bair 2007 writes it; K0 and K' of mineral oils.
    """

    K0: float  # [Pa]
    K1: float  # K' [-]

    @kernel
    def density_ratio(self, p: float) -> tuple[float, float, float]:
        q = max(p, 0.0)
        up = 1.0 if p >= 0.0 else 0.0
        inner = 1.0 + (1.0 + self.K1) * q / self.K0
        ratio = 1.0 / (1.0 - math.log(inner) / (1.0 + self.K1))
        slope = up * ratio * ratio / (self.K0 * inner)
        bend = slope * (2.0 * slope / ratio - (1.0 + self.K1) / (self.K0 * inner))
        return ratio, slope, bend


LAW = Tait(1.2e9, 10.5)
OIL = film_oil(eta0=0.05, alpha=15e-9, density_law=LAW)


def tait(p: np.ndarray) -> np.ndarray:
    return 1.0 / (1.0 - np.log1p(11.5 * p / 1.2e9) / 11.5)


def test_derivatives_are_those_of_the_printed_law():
    for p in (1e7, 3e8, 1e9):
        d = 1e-4 * p
        low, here, high = tait(np.array([p - d, p, p + d]))
        assert density(OIL, p) == pytest.approx(870.0 * here, rel=1e-13)
        # differences: second order in 1e-4; rounding 1e-16 over 1e-8
        assert density_slope(OIL, p) == pytest.approx(870.0 * (high - low) / (2.0 * d), rel=1e-6)
        bend = density_ratio(LAW, p)[2]
        assert bend == pytest.approx((high - 2.0 * here + low) / d**2, rel=1e-3)


def test_another_unit_of_pressure_changes_no_number():
    in_units = density_in_units(LAW, 4e8)
    ratio, slope, bend = density_ratio(LAW, 2e8)
    assert density_ratio(in_units, 0.5) == pytest.approx((ratio, slope * 4e8, bend * 1.6e17))


def test_line_film_holds_oil_of_that_density():
    film = line_film(OIL)
    assert film.density == pytest.approx(870.0 * tait(np.maximum(film.pressure, 0.0)), rel=1e-12)
    # what flows through every section is the same, to the accuracy of the solution
    flow = film.mass_flow[5:75]
    assert flow == pytest.approx(flow[0], rel=1e-6)


def test_point_film_conserves_mass_with_it():
    # the printed flow of the fields in SI; the film is solved to 1e-9 of the entrained flow
    assert abs(flow_out(point_film(OIL), 7, 17, 11, 21)) < 1e-7


def test_film_in_time_conserves_mass_with_it():
    # solved to 1e-9 of the entrained flow
    assert abs(oil_balance(OIL)) < 1e-7


def test_a_law_of_another_reference_density_is_refused():
    class Doubled(NamedTuple):
        slope: float

        @kernel
        def density_ratio(self, p: float) -> tuple[float, float, float]:
            return 2.0 + self.slope * p, self.slope, 0.0

    with pytest.raises(ParameterError, match="rho/rho0 must be 1"):
        film_oil(eta0=0.05, alpha=15e-9, density_law=Doubled(1e-10))
