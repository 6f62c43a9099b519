"""Carreau's law of shear thinning: its inverse, its slope, films and an oil file that name it."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube_core.ehl.line.traction import fill_mean_stress
from gearlube_core.errors import ParameterError
from gearlube_core.oil.carreau_law import Carreau
from gearlube_core.oil.film_laws import rate_ratio
from gearlube_core.oil.film_oil import stress_ratio
from gearlube_core.oil.film_oil_data import film_oil, film_oil_of
from gearlube_core.oil.oil_file import OilFile
from tests.helpers.each import each
from tests.helpers.source_of import source_of

LAW = Carreau(7e6, 0.463)
P = 0.92e9  # Pa


@each("n", [0.2, 0.463, 1.0])
@each("x", [1e-6, 0.3, 1.0, 20.0, 1e5])
def test_rate_is_the_inverse_of_the_printed_stress(x, n):
    # t = x (1 + x^2)^((n - 1)/2), x the Newtonian stress over the critical one
    t = x * (1.0 + x * x) ** (0.5 * (n - 1.0))
    law = Carreau(7e6, n)
    G, slope = source_of(Carreau.rate_ratio)(law, t * t)
    assert t * G == pytest.approx(x, rel=1e-11)
    step = 1e-4 * t * t
    up, down = (rate_ratio(law, t * t + s)[0] for s in (step, -step))
    # differences lose digits where G is one
    assert slope == pytest.approx((up - down) / (2.0 * step), rel=1e-6, abs=1e-11 / step)


def test_small_stress_is_newtonian():
    assert rate_ratio(LAW, 0.0) == (1.0, pytest.approx(0.5 * (1.0 - 0.463)))
    # of the series at q = 1e-12 two terms are left
    assert rate_ratio(LAW, 1e-12)[0] == pytest.approx(1.0 + 0.2685e-12, rel=1e-15)


def sheared(oil, eta: float = 8.03) -> float:
    tau, one = np.empty(1), np.ones(1)
    fill_mean_stress(P * one, 0.0 * one, 0.23e-6 * one, 0.0 * one, eta * one, 1.257, oil, tau)
    return float(tau[0])


def test_film_between_plates_has_the_printed_stress_up_to_its_limit():
    """8.03 Pa.s, 1.257 m/s over 0.23 um at 0.92 GPa: 16.3 MPa, 0.0177 of the pressure."""
    alpha = math.log(8.03 / 0.0106) / P
    oil = film_oil(eta0=0.0106, alpha=alpha, law="barus", shear_law=LAW)
    newtonian = 8.03 * 1.257 / 0.23e-6
    expected = newtonian * (1.0 + (newtonian / 7e6) ** 2) ** (0.5 * (0.463 - 1.0))
    assert sheared(oil) == pytest.approx(expected, rel=1e-9)
    assert sheared(oil) / P == pytest.approx(0.0177, abs=1e-4)
    assert sheared(oil._replace(limit_slope=0.01)) == pytest.approx(0.01 * P, rel=1e-14)


def test_an_oil_file_names_it_with_its_numbers_and_its_limit():
    sheet = {
        "name": "a sheet",
        "base_oil": "mineral",
        "density_kg_m3": 880.0,
        "viscosity_40_degc_mm2_s": 100.0,
        "viscosity_100_degc_mm2_s": 11.0,
        "shear_law": "carreau",
        "law_numbers": {"critical_stress": 5e6},
    }
    oil = film_oil_of(OilFile.from_data(sheet, "the test").described().lubricant, 353.15)
    assert oil.shear == Carreau(5e6, 0.463)
    assert (oil.tau_limit, oil.limit_slope) == (0.0, 0.047)
    assert stress_ratio(oil, 1e9, 1.0) == (1.0, 0.0)
    named = film_oil(eta0=0.01, alpha=2e-8, shear_law="carreau")
    assert named.shear == Carreau(6.94e6, 0.463)


def test_a_law_with_its_own_stress_takes_no_other():
    with pytest.raises(ParameterError, match="eyring_stress and eyring_slope must be left out"):
        film_oil(eta0=0.01, alpha=2e-8, shear_law=LAW, eyring_slope=0.05)
