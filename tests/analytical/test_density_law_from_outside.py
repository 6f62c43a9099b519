"""A density law written outside the package serves every film solution.

Its oil has a viscosity law from outside as well: neither what the films hold nor what flows through
them depends on that.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.film_laws import density_in_units, density_ratio
from gearlube_core.oil.film_oil import density
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.ehl_point_cases import flow_out
from tests.helpers.foreign_laws import FOREIGN_OIL, TAIT
from tests.helpers.oil_slopes import density_slope
from tests.helpers.small_films import line_film, oil_balance, point_film


def tait(p: np.ndarray) -> np.ndarray:
    return 1.0 / (1.0 - np.log1p(11.5 * p / 1.2e9) / 11.5)


def test_derivatives_are_those_of_the_printed_law():
    for p in (1e7, 3e8, 1e9):
        d = 1e-4 * p
        low, here, high = tait(np.array([p - d, p, p + d]))
        assert density(FOREIGN_OIL, p) == pytest.approx(870.0 * here, rel=1e-13)
        # differences: second order in 1e-4; rounding 1e-16 over 1e-8
        assert density_slope(FOREIGN_OIL, p) == pytest.approx(
            870.0 * (high - low) / (2.0 * d), rel=1e-6
        )
        bend = density_ratio(TAIT, p)[2]
        assert bend == pytest.approx((high - 2.0 * here + low) / d**2, rel=1e-3)


def test_another_unit_of_pressure_changes_no_number():
    in_units = density_in_units(TAIT, 4e8)
    ratio, slope, bend = density_ratio(TAIT, 2e8)
    assert density_ratio(in_units, 0.5) == pytest.approx((ratio, slope * 4e8, bend * 1.6e17))


def test_line_film_holds_oil_of_that_density():
    film = line_film(FOREIGN_OIL)
    assert film.density == pytest.approx(870.0 * tait(np.maximum(film.pressure, 0.0)), rel=1e-12)
    # what flows through every section is the same, to the accuracy of the solution
    flow = film.mass_flow[5:75]
    assert flow == pytest.approx(flow[0], rel=1e-6)


def test_point_film_conserves_mass_with_both_laws():
    # the printed flow of the fields in SI; the film is solved to 1e-9 of the entrained flow
    assert abs(flow_out(point_film(FOREIGN_OIL), 7, 17, 11, 21)) < 1e-7


def test_film_in_time_conserves_mass_with_both_laws():
    # solved to 1e-9 of the entrained flow
    assert abs(oil_balance(FOREIGN_OIL)) < 1e-7


def test_a_law_of_another_reference_density_is_refused():
    class Doubled(NamedTuple):
        slope: float

        @kernel
        def density_ratio(self, p: float) -> tuple[float, float, float]:
            return 2.0 + self.slope * p, self.slope, 0.0

    with pytest.raises(ParameterError, match="rho/rho0 must be 1"):
        film_oil(eta0=0.05, alpha=15e-9, density_law=Doubled(1e-10))
