"""A viscosity law written outside the package serves every film solution and film formula.

That films of it conserve mass is held by the tests of a density law, whose oil has both laws.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid

from gearlube.studies.films.film_formulas import line_film_formulas
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015
from gearlube_core.ehl.line.problem import LineSettings
from gearlube_core.ehl.line.thermal import ThermalSettings, solve_thermal_line
from gearlube_core.errors import ParameterError
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.film_laws import (
    cooling_at,
    cooling_factor,
    log_viscosity,
    viscosity_decline,
)
from gearlube_core.oil.film_oil import (
    pressure_viscosity,
    thermal_viscosity,
    viscosity,
    viscosity_cooling,
)
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.foreign_laws import FOREIGN_OIL, T0
from tests.helpers.oil_slopes import viscosity_slope
from tests.helpers.small_films import (
    SPEED,
    line_contact,
    line_film,
)

ALPHA, ETA0 = 15e-9, 0.05
BUILT_IN = film_oil(eta0=ETA0, alpha=ALPHA, law="barus")


class PlainBarus(NamedTuple):
    """ln(eta/eta0) = alpha p."""

    alpha: float

    @kernel
    def log_viscosity(self, p: float, cooling: float) -> tuple[float, float]:
        return self.alpha * p, self.alpha


PLAIN = film_oil(eta0=ETA0, law=PlainBarus(ALPHA))


def test_barus_written_anew_gives_the_numbers_of_the_built_in_law():
    for p in (-1e8, 0.0, 1e8, 1e9):
        # rounding of the exponent, up to 15
        assert viscosity(PLAIN, p) == pytest.approx(viscosity(BUILT_IN, p), rel=1e-13)
        assert viscosity_slope(PLAIN, p) == pytest.approx(viscosity_slope(BUILT_IN, p), rel=1e-13)
    assert pressure_viscosity(PLAIN) == ALPHA


def test_law_without_a_temperature_is_isothermal():
    law = PlainBarus(ALPHA)
    for temperature in (250.0, T0, 400.0):
        cooling = cooling_factor(law, temperature, T0)
        assert cooling == cooling_at(law, 1e9, ALPHA * 1e9) == 1.0
        assert log_viscosity(law, 1e9, cooling)[0] == ALPHA * 1e9
        assert viscosity_decline(law, 1e9, temperature, T0) == 0.0


def test_film_formulas_take_alpha_of_the_law():
    ours = line_film_formulas(line_contact(PLAIN))
    theirs = line_film_formulas(line_contact(BUILT_IN))
    for one, other in zip(ours, theirs, strict=True):
        assert one.film == pytest.approx(other.film, rel=1e-13)


def test_free_volume_law_has_the_slopes_of_its_values():
    for p in (1e7, 3e8, 1e9):
        d = 1e-5 * p
        slope = (viscosity(FOREIGN_OIL, p + d) - viscosity(FOREIGN_OIL, p - d)) / (2.0 * d)
        # second-order error of the difference, (d alpha)^2/6
        assert viscosity_slope(FOREIGN_OIL, p) == pytest.approx(slope, rel=1e-6)
        hot, cold = (thermal_viscosity(FOREIGN_OIL, p, 340.0 + e) for e in (1e-3, -1e-3))
        cooling = viscosity_cooling(FOREIGN_OIL, p, 340.0)
        assert cooling == pytest.approx(math.log(cold / hot) / 2e-3, rel=1e-6)
        law = FOREIGN_OIL.viscosity
        log_eta = math.log(thermal_viscosity(FOREIGN_OIL, p, 340.0) / FOREIGN_OIL.eta0)
        # the inverse loses the digits of C2 + X
        assert cooling_at(law, p, log_eta) == pytest.approx(cooling_factor(law, 340.0, T0))


def test_line_film_of_the_free_volume_law_satisfies_reynolds():
    film = line_film(FOREIGN_OIL, nodes=401)
    x, p, h, rho = film.x, film.pressure, film.film, film.density
    # printed law, not the kernel: log10(eta/eta0) at the oil's temperature
    T_g, F = 190.0 + 189.0 * np.log1p(0.719e-9 * p), 1.0 - 0.188 * np.log1p(27.52e-9 * p)
    X, X_0 = (T0 - T_g) * F, T0 - 190.0
    eta = 0.05 * 10.0 ** (16.04 * (X_0 / (18.18 + X_0) - X / (18.18 + X)))
    flow = film.mass_flow[film.x.size // 2]
    slope = 12.0 * eta * (rho * SPEED * h - flow) / (rho * h**3)
    inlet = (x < 0.0) & (p < 0.2 * p.max())
    rise = cumulative_trapezoid(slope[inlet], x[inlet], initial=0.0)
    # first-order carried mass on 400 cells
    assert rise[-1] == pytest.approx(p[inlet][-1] - p[inlet][0], rel=0.02)


@pytest.mark.slow
def test_heat_thins_the_film_of_the_free_volume_law():
    contact = line_contact(FOREIGN_OIL)
    settings = LineSettings(nodes=101)
    steel = STEEL_MOHAMMADPOUR_2015
    hot = solve_thermal_line(contact, steel, steel, settings, thermal=ThermalSettings(heights=9))
    cold = line_film(FOREIGN_OIL)
    assert hot.film.film.min() < cold.film.min()


def test_what_is_no_viscosity_law_is_refused():
    class Nothing(NamedTuple):
        alpha: float

    with pytest.raises(ParameterError, match="log_viscosity"):
        film_oil(eta0=ETA0, law=Nothing(1.0))
    with pytest.raises(ParameterError, match="alpha must be left out"):
        film_oil(eta0=ETA0, alpha=ALPHA, law=PlainBarus(ALPHA))
    with pytest.raises(ParameterError, match="alpha is missing"):
        film_oil(eta0=ETA0)
