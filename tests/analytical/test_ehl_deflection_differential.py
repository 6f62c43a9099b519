"""The differential formulation of deflection against the integral one."""

import numpy as np
import pytest

from gearlube_core.contact.half_space import HalfSpaceConvolution, love_coefficients
from gearlube_core.errors import ParameterError
from tests.helpers.deflection_differential import (
    DifferentialDeflection,
    laplacian_coefficients,
)
from tests.references.hertz_reference import HertzContact

E = 1.1375e11


def ellipse(nx, ny):
    """Return spacing and Hertz pressure of a 1 : 4 contact on a domain of 1.6 semi-axes."""
    hertz = HertzContact(R_x=0.01, R_y=0.09, contact_modulus=E, load=200.0)
    b, a = hertz.semi_minor, hertz.semi_major
    x, y = np.linspace(-1.6 * b, 1.6 * b, nx), np.linspace(-1.6 * a, 1.6 * a, ny)
    inside = 1.0 - (x[:, None] / b) ** 2 - (y / a) ** 2
    return x, y, hertz, hertz.maximum_pressure * np.sqrt(np.maximum(inside, 0.0))


def integral(dx, dy, nx, ny):
    return HalfSpaceConvolution(love_coefficients(dx, dy, nx, ny, E) * (dx * dy))


@pytest.mark.parametrize("rough", [False, True])
@pytest.mark.parametrize("shape", [(65, 65), (48, 91), (3, 7)])
def test_equals_the_convolution(shape, rough):
    # asked for: 1e-6; both are exact sums over the same cells, so rounding is all that remains
    x, y, _, pressure = ellipse(*shape)
    if rough:
        pressure = pressure * (1.0 + 0.8 * np.random.default_rng(1).normal(size=shape))
    dx, dy = x[1] - x[0], y[1] - y[0]
    expected = integral(dx, dy, *shape)(pressure)
    found = DifferentialDeflection(dx, dy, *shape, E)(pressure)
    assert found == pytest.approx(expected, abs=1e-12 * expected.max())


def test_pressure_on_the_border_counts():
    pressure = np.random.default_rng(2).random((20, 17))
    expected = integral(1e-6, 2e-6, 20, 17)(pressure)
    found = DifferentialDeflection(1e-6, 2e-6, 20, 17, E)(pressure)
    assert found == pytest.approx(expected, abs=1e-12 * expected.max())


def test_hertz_pressure_takes_the_paraboloid_out():
    # approach - gap inside the contact; 129 nodes leave (1/80)^1.5 = 1.4e-3 at the edge
    x, y, hertz, pressure = ellipse(129, 129)
    found = DifferentialDeflection(x[1] - x[0], y[1] - y[0], 129, 129, E)(pressure)
    flat = hertz.approach - x[:, None] ** 2 / (2 * hertz.R_x) - y**2 / (2 * hertz.R_y)
    inside = (x[:, None] / hertz.semi_minor) ** 2 + (y / hertz.semi_major) ** 2 < 0.8
    assert np.abs(found - flat)[inside].max() < 1.4e-3 * hertz.approach


def test_laplacian_decays_with_the_cube_of_distance():
    # the deflection itself falls as 1/r; 1 % for the finite cell at 16 cells and beyond
    g = love_coefficients(1e-6, 1e-6, 129, 2, E)[:, 0]
    f = laplacian_coefficients(1e-6, 1e-6, 129, 2, E)[:, 0]
    assert np.log2(g[16] / g[32]) == pytest.approx(1.0, abs=0.01)
    for i in (16, 32, 64):
        assert np.log2(f[i] / f[2 * i]) == pytest.approx(3.0, abs=0.02)
    assert f[0] < 0.0 < f[1]
    assert f[8] / -f[0] < 3e-4 < 0.03 < g[8] / g[0]


def test_all_coefficients_sum_to_the_tail_they_leave():
    # a plane under uniform pressure does not curve: within n cells the sum is minus what lies
    # outside, int r^-3 dA = 8 sqrt(2)/((2 n + 1) dx) over the outside of a square
    n, dx = 200, 1e-6
    f = laplacian_coefficients(dx, dx, n + 1, n + 1, E)
    total = 4.0 * f[1:, 1:].sum() + 2.0 * (f[0, 1:].sum() + f[1:, 0].sum()) + f[0, 0]
    outside = 8.0 * np.sqrt(2.0) / ((2 * n + 1) * dx) / (np.pi * E)
    assert total == pytest.approx(-outside, rel=1e-3)


def test_difference_tends_to_derivative_far_away_to_second_order():
    difference = laplacian_coefficients(1e-6, 2e-6, 60, 60, E)
    derivative = laplacian_coefficients(1e-6, 2e-6, 60, 60, E, "derivative")
    off = np.abs(derivative / difference - 1.0)
    # fourth derivatives of 1/r: of the order of 10 (dy/r)^2
    assert off[40, 20] < 10.0 * 2.0**2 / (40.0**2 + 40.0**2)
    assert off[20, 10] / off[40, 20] == pytest.approx(4.0, rel=0.05)


def test_dropping_far_coefficients_does_not_pay():
    x, y, _, pressure = ellipse(65, 65)
    dx, dy = x[1] - x[0], y[1] - y[0]
    expected = integral(dx, dy, 65, 65)(pressure)
    errors = [
        np.abs(DifferentialDeflection(dx, dy, 65, 65, E, reach)(pressure) - expected).max()
        / expected.max()
        for reach in (4, 8, 16, 64)
    ]
    assert errors == sorted(errors, reverse=True)
    assert errors[1] > 0.1
    assert errors[3] < 1e-12


def test_inputs_out_of_range_are_refused():
    with pytest.raises(ParameterError, match="3 or more"):
        DifferentialDeflection(1e-6, 1e-6, 2, 5, E)
    with pytest.raises(ParameterError, match="form"):
        laplacian_coefficients(1e-6, 1e-6, 4, 4, E, "spectral")
    with pytest.raises(ParameterError, match="dx"):
        laplacian_coefficients(-1e-6, 1e-6, 4, 4, E, "derivative")
