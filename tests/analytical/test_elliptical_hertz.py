"""Hertz ellipse against scipy's elliptic integrals, closed limits and the elastic half-space."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ellipe, ellipk, ellipkm1

from gearlube_core.contact.hertz import (
    complete_elliptic_k_d,
    ellipticity,
    hertz_coefficients,
    hertz_ellipse,
)
from tests.helpers.each import each
from tests.references.hertz_reference import HertzContact

E_STAR = 115.4e9


@each("axis_ratio", [1.0, 0.999, 0.7, 0.3, 0.05, 1e-3, 1e-6])
def test_elliptic_integrals_agree_with_scipy(axis_ratio: float) -> None:
    K, D = complete_elliptic_k_d(axis_ratio)
    m = (1.0 - axis_ratio) * (1.0 + axis_ratio)
    # double precision; ellipkm1 takes 1 - m and so keeps its digits for slender ellipses
    assert pytest.approx(ellipkm1(axis_ratio**2), rel=1e-14) == K
    assert K - m * D == pytest.approx(ellipe(m), rel=1e-13)


def test_difference_integral_of_a_circle_is_a_quarter_pi() -> None:
    assert complete_elliptic_k_d(1.0)[1] == pytest.approx(math.pi / 4.0, rel=1e-15)


@each("ratio", [1.0, 1.0000003, 1.01, 1.7, 5.0, 16.0, 54.5, 2e3, 1e6])
def test_ellipticity_solves_the_curvature_equation(ratio: float) -> None:
    # bracketed root with scipy's integrals; scipy's K loses digits as m approaches 1
    reference = HertzContact(R_x=1.0, R_y=ratio, contact_modulus=1.0, load=1.0).ellipticity
    assert ellipticity(ratio) == pytest.approx(reference, rel=1e-9)


def test_slender_ellipse_meets_its_asymptote() -> None:
    k = 1e7
    ratio = k**2 / (math.log(4.0 * k) - 1.0)  # K = ln 4k, E = 1
    # the next term is of order ln(k)/k^2
    assert ellipticity(ratio) == pytest.approx(k, rel=1e-11)


def test_circular_contact_meets_the_sphere_formulas() -> None:
    R, W = 0.02, 150.0
    a_x, a_y, p_mean = hertz_ellipse(2.0 * R, 2.0 * R, E_STAR, W)  # R: sphere on sphere 2R
    a = (3.0 * W * 2.0 * R / (4.0 * E_STAR)) ** (1.0 / 3.0)
    assert (a_x, a_y) == pytest.approx((a, a), rel=1e-14)
    assert p_mean == pytest.approx(W / (math.pi * a**2), rel=1e-14)


@each(("R_x", "R_y"), [(0.01, 0.01), (0.01, 0.03), (0.011, 0.6)])
def test_kernel_and_reference_class_agree(R_x: float, R_y: float) -> None:
    a_x, a_y, p_mean = hertz_ellipse(R_x, R_y, E_STAR, 800.0)
    reference = HertzContact(R_x=R_x, R_y=R_y, contact_modulus=E_STAR, load=800.0)
    # scipy's K at m near 1
    assert a_x == pytest.approx(reference.semi_minor, rel=1e-11)
    assert a_y == pytest.approx(reference.semi_major, rel=1e-11)
    assert p_mean == pytest.approx(reference.mean_pressure, rel=1e-11)
    assert reference.maximum_pressure == 1.5 * reference.mean_pressure


def test_exchanging_the_radii_exchanges_the_axes() -> None:
    c_x, c_y, c_p = hertz_coefficients(0.01, 0.3, E_STAR)
    assert hertz_coefficients(0.3, 0.01, E_STAR) == (c_y, c_x, c_p)


def surface_displacement(contact: HertzContact, x: float, y: float) -> float:
    """Elastic displacement of an elliptical Hertz pressure: chords through (x, y)."""
    b, a = contact.semi_minor, contact.semi_major

    def chord(theta: float) -> float:
        c, s = math.cos(theta), math.sin(theta)
        C = c**2 / b**2 + s**2 / a**2
        B = x * c / b**2 + y * s / a**2
        A = 1.0 - x**2 / b**2 - y**2 / a**2
        # integral of sqrt(A - 2 B r - C r^2) over the chord
        return 0.5 * math.pi * (A * C + B**2) / C**1.5

    peak = math.atan2(b, a)
    integral = quad(chord, -peak, peak, epsrel=1e-12)[0]
    integral += quad(chord, peak, math.pi - peak, epsrel=1e-12, points=[math.pi / 2])[0]
    return contact.maximum_pressure / (math.pi * contact.contact_modulus) * integral


@each("R_y", [0.01, 0.04, 0.6])
def test_deformed_surfaces_conform_inside_the_ellipse(R_y: float) -> None:
    contact = HertzContact(R_x=0.01, R_y=R_y, contact_modulus=E_STAR, load=1000.0)
    for share in (0.0, 0.5, 0.9):
        x, y = share * contact.semi_minor, share * contact.semi_major
        # quadrature to 1e-12; the scale of the tolerance is the approach
        for u, gap in (
            (surface_displacement(contact, x, 0.0), x**2 / (2.0 * contact.R_x)),
            (surface_displacement(contact, 0.0, y), y**2 / (2.0 * contact.R_y)),
        ):
            assert u + gap == pytest.approx(contact.approach, rel=1e-9)


def test_pressure_over_the_ellipse_carries_the_load() -> None:
    c_x, c_y, c_p = hertz_coefficients(0.01, 0.2, E_STAR)
    load = 512.0  # cube of 8
    assert math.pi * c_x * c_y * c_p * 8.0**3 == pytest.approx(load, rel=1e-14)


def test_an_unloaded_contact_has_no_area_and_no_pressure() -> None:
    assert hertz_ellipse(0.01, 0.2, E_STAR, 0.0) == (0.0, 0.0, 0.0)
    assert hertz_ellipse(0.01, 0.2, E_STAR, -5.0) == (0.0, 0.0, 0.0)


def test_ellipse_grows_more_slender_with_the_radius_ratio() -> None:
    k = [ellipticity(r) for r in np.geomspace(1.0, 1e10, 200)]
    assert np.all(np.diff(k) > 0.0)
    assert float(ellipk(0.0)) == pytest.approx(complete_elliptic_k_d(1.0)[0], rel=1e-15)
