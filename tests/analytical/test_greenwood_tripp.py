"""Asperity integrals against quadrature of the Gaussian height distribution."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from gearlube_core.contact.greenwood_tripp_1971 import (
    LAMBDA_MAX,
    SurfaceParameters,
    asperity_area,
    asperity_integrals,
    asperity_load,
    f_2,
    f_2_as_printed,
    f_5_2,
    f_5_2_as_printed,
)
from tests.helpers.each import each

SURFACE = SurfaceParameters(sigma=0.5e-6, xi_beta_sigma=0.055, sigma_over_beta=0.001)


def gaussian_moment(order: float, separation: float) -> float:
    """Integral of (s - l)^n exp(-s^2/2)/sqrt(2 pi) over s > l, with s = l + t."""

    def integrand(t: float) -> float:
        return t**order * math.exp(-0.5 * t * t - separation * t)

    integral = quad(integrand, 0.0, 40.0, epsabs=0.0, epsrel=1e-11, points=[0.2, 1.0, 5.0])[0]
    return math.exp(-0.5 * separation**2) / math.sqrt(2.0 * math.pi) * integral


@each("separation", [0.0, 1e-6, 0.123, 0.7, 1.5, 2.2, 3.0, 3.9, 4.6, 4.999])
def test_integrals_agree_with_quadrature(separation: float) -> None:
    area, load = asperity_integrals(separation)
    # cubic interpolation with 1024 intervals: below 2e-9; the model needs 1e-7
    assert area == pytest.approx(gaussian_moment(2.0, separation), rel=1e-8)
    assert load == pytest.approx(gaussian_moment(2.5, separation), rel=1e-8)
    assert f_5_2(separation) == load
    # closed form: cancellation of three digits at l = 5
    assert f_2(separation) == pytest.approx(gaussian_moment(2.0, separation), rel=1e-10)


def test_integrals_of_touching_mean_planes_are_half_and_gamma_moments() -> None:
    assert f_2(0.0) == 0.5
    # integral of t^(5/2) exp(-t^2/2) = 2^(3/4) Gamma(7/4)
    expected = 2.0**0.75 * math.gamma(1.75) / math.sqrt(2.0 * math.pi)
    assert f_5_2(0.0) == pytest.approx(expected, rel=1e-14)


def test_integrals_fall_without_steps_between_intervals() -> None:
    separations = np.linspace(0.0, LAMBDA_MAX, 20011)[:-1]
    values = np.array([asperity_integrals(float(x)) for x in separations])
    assert np.all(np.diff(values, axis=0) < 0.0)


def test_asperities_are_dropped_beyond_five_roughness_heights() -> None:
    assert asperity_integrals(LAMBDA_MAX) == (0.0, 0.0)
    assert asperity_integrals(1e9) == (0.0, 0.0)
    # the step that is left, stated in the code as 1.93e-8 and 1.35e-8
    area, load = asperity_integrals(LAMBDA_MAX * (1.0 - 1e-12))
    assert area == pytest.approx(1.93e-8, rel=5e-3)
    assert load == pytest.approx(1.35e-8, rel=5e-3)


def test_asperity_load_is_linear_in_contact_modulus_and_area() -> None:
    one = asperity_load(1.0, 1e-6, 1e11, SURFACE)
    assert asperity_load(1.0, 2e-6, 3e11, SURFACE) == pytest.approx(6.0 * one, rel=1e-14)
    slope = 16.0 * math.sqrt(2.0) / 15.0 * math.pi * 0.055**2 * math.sqrt(0.001)
    expected = slope * 1e11 * 1e-6 * gaussian_moment(2.5, 1.0)
    # interpolation, as above
    assert one == pytest.approx(expected, rel=1e-8)


def test_asperity_area_is_a_small_part_of_the_apparent_area() -> None:
    expected = math.pi**2 * 0.055**2 * 1e-6 * gaussian_moment(2.0, 0.5)
    assert asperity_area(0.5, 1e-6, SURFACE) == pytest.approx(expected, rel=1e-8)
    assert asperity_area(0.0, 1.0, SURFACE) < 0.015


def test_printed_polynomials_hold_for_thin_films_only() -> None:
    for separation in (0.0, 0.5, 1.0):
        # three printed decimals: 0.0006 at worst up to l = 1
        assert f_5_2_as_printed(separation) == pytest.approx(f_5_2(separation), abs=0.001)
        assert f_2_as_printed(separation) == pytest.approx(f_2(separation), abs=0.001)


def test_printed_area_polynomial_is_negative_between_two_and_three() -> None:
    assert all(f_2_as_printed(float(x)) < 0.0 for x in np.linspace(2.0, 3.0, 11))
    # -0.002*243 + 0.028*81 - 0.173*27 + 0.526*9 - 0.804*3 + 0.5
    assert f_2_as_printed(3.0) == pytest.approx(-0.067, abs=1e-12)
    assert f_2_as_printed(3.0001) == 0.0


def test_printed_load_polynomial_is_five_hundred_times_too_large_at_three() -> None:
    # -0.004*243 + 0.057*81 - 0.296*27 + 0.784*9 - 1.078*3 + 0.617
    assert f_5_2_as_printed(3.0) == pytest.approx(0.092, abs=1e-12)
    assert f_5_2_as_printed(3.0) / f_5_2(3.0) == pytest.approx(538.0, rel=0.01)
    assert f_5_2_as_printed(3.0001) == 0.0
