"""Displacement under pressure periodic along one axis against sums, lines and waves."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import k0

from gearlube_core.contact.half_space import love_coefficients
from gearlube_core.contact.half_space_periodic import PeriodicDeflection, periodic_modes
from gearlube_core.errors import ParameterError
from tests.helpers.each import each

E = 1.1375e11  # contact modulus of steel on steel, E' 227.5 GPa


def deflection(dx, dy, nx, ny, axis="last", reference=1e-3):
    return PeriodicDeflection(periodic_modes(dx, dy, nx, ny, E, reference), ny, axis)


@each(("dx", "dy"), [(1e-6, 1e-6), (1e-6, 3.3e-6), (2e-6, 0.7e-6)])
@each("ny", [6, 7])
def test_equals_the_sum_over_many_periods_up_to_the_lines_constant(dx, dy, ny):
    # images beyond H leave 2/L ln(2H/reference) and an end correction of the order (L/H)^2
    nx, images = 5, 400
    period = ny * dy
    aperiodic = love_coefficients(dx, dy, nx, (images + 1) * ny, E) * dx * dy
    columns = np.abs(np.arange(-images, images + 1) * ny + np.arange(ny)[:, None])
    summed = np.take(aperiodic, columns, axis=1).sum(axis=-1)
    load = np.zeros((nx, ny))
    load[0, 0] = 1.0
    periodic = np.array(deflection(dx, dy, nx, ny)(load))
    half_length = (images + 0.5) * period
    constant = 2.0 * dx * dy / (math.pi * E * period) * math.log(2.0 * half_length / 1e-3)
    assert summed - constant == pytest.approx(periodic, abs=3e-6 * summed[0, 0])


def test_pressure_uniform_along_y_is_a_line_contact():
    # exact integral of the logarithm over each cell; ten digits
    dx, nx, ny = 2e-6, 40, 8
    x = (np.arange(nx) - 20.0) * dx
    profile = 1e9 * np.sqrt(np.maximum(1.0 - (x / 2.2e-5) ** 2, 0.0))
    u = deflection(dx, 5e-6, nx, ny)(np.repeat(profile[:, None], ny, axis=1))
    assert np.ptp(u, axis=1).max() < 1e-12 * np.abs(u).max()
    for i in (0, 19, 20, 33):
        total = sum(
            p * quad(lambda s, i=i: math.log(abs(x[i] - s) / 1e-3), x_k - dx / 2, x_k + dx / 2)[0]
            if k != i
            else p * dx * (math.log(0.5 * dx / 1e-3) - 1.0)
            for k, (p, x_k) in enumerate(zip(profile, x, strict=True))
        )
        assert u[i, 3] == pytest.approx(-2.0 / (math.pi * E) * total, rel=1e-9)


def test_hertz_line_pressure_flattens_a_cylinder():
    # inside the contact u = const - x^2 p_0/(a E*); cells at the root-like edge leave
    # (1/200)^1.5 = 3.5e-4 of p_0 a/E*
    a, p_0, n = 1e-4, 1e9, 441
    x = np.linspace(-1.1 * a, 1.1 * a, n)
    dx = x[1] - x[0]
    profile = p_0 * np.sqrt(np.maximum(1.0 - (x / a) ** 2, 0.0))
    u = deflection(dx, 3e-5, n, 4)(np.repeat(profile[:, None], 4, axis=1))[:, 0]
    inside = np.abs(x) < 0.9 * a
    flat = u + x**2 * p_0 / (a * E)
    assert np.ptp(flat[inside]) < 3.5e-4 * p_0 * a / E


def test_wave_along_y_follows_k0():
    # far from a narrow loaded strip, a fine grid: the wave sin(k y) decays as K0(k x)
    dx, nx, ny = 1e-6, 200, 128
    k = 2.0 * math.pi / (ny * dx)
    load = np.zeros((nx, ny))
    load[0] = np.cos(k * dx * np.arange(ny))
    u = deflection(dx, dx, nx, ny)(load)[:, 0]
    for i in (20, 60, 150):
        # the strip's own width and the step along y each leave (k dx)^2/24 = 1e-4
        assert u[i] == pytest.approx(2.0 / (math.pi * E) * dx * k0(k * i * dx), rel=3e-4)


def test_wave_everywhere_is_the_classic_half_space_wave():
    # p = cos(k y) uniform along x over many wavelengths: u = 2 p/(E* k) in the middle, less what
    # a step profile of 32 cells a wave loses, (k dy)^2/24
    nx, ny = 401, 32
    dx = dy = 1e-6
    k = 2.0 * math.pi / (ny * dy)
    load = np.repeat(np.cos(k * dy * np.arange(ny))[None, :], nx, axis=0)
    u = deflection(dx, dy, nx, ny)(load)
    assert u[200, 0] == pytest.approx(2.0 / (E * k), rel=2.0 * (k * dy) ** 2 / 24.0)


def test_shift_by_cells_and_periods_and_reversal():
    rng = np.random.default_rng(5)
    for ny in (12, 13):
        pressure = rng.random((9, ny))
        grid = deflection(1e-6, 2e-6, 9, ny)
        u = np.array(grid(pressure))
        shifted = np.array(grid(np.roll(pressure, 5, axis=1)))
        assert shifted == pytest.approx(np.roll(u, 5, axis=1), abs=1e-13 * np.ptp(u))
        whole = np.array(grid(np.roll(pressure, ny, axis=1)))
        assert np.array_equal(whole, u)
        assert grid(pressure[::-1, ::-1])[::-1, ::-1] == pytest.approx(u, abs=1e-13 * np.ptp(u))
        other = deflection(1e-6, 2e-6, 9, ny, "first")
        np.testing.assert_allclose(other(pressure.T).T, u, atol=1e-13 * np.ptp(u))


def test_two_periods_equal_one_twice():
    rng = np.random.default_rng(6)
    pressure = rng.random((7, 10))
    once = np.array(deflection(1e-6, 2e-6, 7, 10)(pressure))
    twice = deflection(1e-6, 2e-6, 7, 20)(np.tile(pressure, 2))
    assert twice == pytest.approx(np.tile(once, 2), abs=1e-10 * np.ptp(once))


def test_reference_only_lifts_the_whole_surface():
    pressure = np.random.default_rng(7).random((6, 8)) * 1e9
    near, far = (np.array(deflection(1e-6, 2e-6, 6, 8, reference=r)(pressure)) for r in (1e-4, 1.0))
    line_load = pressure.mean(axis=1).sum() * 1e-6
    lift = 2.0 / (math.pi * E) * line_load * math.log(1e4)
    assert far - near == pytest.approx(lift, rel=1e-9)


def test_wrong_modes_are_refused():
    with pytest.raises(ParameterError, match="modes"):
        PeriodicDeflection(np.ones((4, 4)), 9)
    with pytest.raises(ParameterError, match="dx"):
        periodic_modes(0.0, 1e-6, 4, 4, E, 1e-3)
    with pytest.raises(ParameterError, match="ny"):
        periodic_modes(1e-6, 1e-6, 4, 0, E, 1e-3)
