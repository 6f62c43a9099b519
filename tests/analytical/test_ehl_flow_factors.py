"""Flow factors of an Eyring film against velocity profiles, closed forms and symmetry."""

import math

import numpy as np
import pytest
from scipy.integrate import cumulative_simpson, simpson
from scipy.optimize import root

from gearlube_core.ehl.point.equations.film_shear import FilmShear
from gearlube_core.ehl.point.equations.shear_factors import ObliqueFactors
from gearlube_core.errors import ParameterError
from gearlube_core.oil.eyring_1936 import Eyring, eyring_flow_factor, eyring_mean_stress
from gearlube_core.oil.film_oil_data import film_oil
from gearlube_core.oil.shear_flow import shear_flow
from tests.helpers.each import each

UNLIMITED = math.inf
EYRING = Eyring(1.0)


def profile_flow(
    gradient: np.ndarray, sliding: float, eta: float, h: float, tau0: float
) -> np.ndarray:
    """Return the flow by pressure [m2/s] along s and r from integrated velocity profiles, in SI."""
    z = np.linspace(-0.5 * h, 0.5 * h, 4001)

    def rates(middle):
        stress = tau0 * middle[:, None] + gradient[:, None] * z
        size = np.hypot(*stress)
        size[size == 0.0] = 1e-30
        return stress / size * tau0 / eta * np.sinh(size / tau0)

    def slip(middle):
        return simpson(rates(middle), x=z) * eta / (h * tau0) - [sliding * eta / (h * tau0), 0.0]

    middle = root(slip, [math.asinh(eta * sliding / (h * tau0)), 0.0], tol=1e-12).x
    assert np.abs(slip(middle)).max() < 1e-9
    velocity = cumulative_simpson(rates(middle), x=z, initial=0.0)
    mean = np.array([0.5 * sliding, 0.0])  # of the surfaces, the lower one at rest
    return simpson(velocity - mean[:, None], x=z)


@each(
    ("slope_s", "slope_r", "sliding"),
    [
        (4e13, 0.0, 1.0),
        (4e13, 3e13, 0.3),
        (-1e14, 2e14, 2.0),
        (0.0, 1e14, 1.0),
        (1e12, -2e14, 0.02),
    ],
)
def test_factors_equal_the_flow_of_the_velocity_profile(slope_s, slope_r, sliding):
    # the profile is integrated itself, not by parts as the factors are; Simpson's rule on 4000
    # intervals is exact to 1e-10
    eta, h, tau0 = 2.0, 0.2e-6, 5e6
    flow = profile_flow(np.array([slope_s, slope_r]), sliding, eta, h, tau0)
    factors = shear_flow(
        EYRING,
        0.5 * h * slope_s / tau0,
        0.5 * h * slope_r / tau0,
        eta * sliding / (h * tau0),
        UNLIMITED,
    )
    newtonian = -(h**3) / (12.0 * eta)
    assert flow[0] == pytest.approx(newtonian * factors.along * slope_s, rel=1e-7, abs=1e-16)
    assert flow[1] == pytest.approx(newtonian * factors.across * slope_r, rel=1e-7, abs=1e-16)


def test_without_cross_slope_the_one_dimensional_factor_returns():
    # quadrature and an iteration to 1e-9 against the closed form; slopes a digit less
    for sigma in (0.0, 1e-7, 3e-5, 0.02, 0.4, 2.4, 6.9, 19.0, -70.0):
        for a in (0.0, 1e-3, 2.0, -1e4, 1e30):
            flow = shear_flow(EYRING, sigma, 0.0, a, UNLIMITED)
            factor, by_sigma, by_a = eyring_flow_factor(sigma, a)
            assert flow.along == pytest.approx(factor, rel=2e-9)
            assert flow.flow_ss == pytest.approx(factor + sigma * by_sigma, rel=1e-8)
            scale = factor * (abs(sigma) + 1e-3)
            assert flow.flow_s_a * a == pytest.approx(sigma * by_a * a, abs=1e-9 * scale)
            assert flow.stress_s == pytest.approx(eyring_mean_stress(sigma, a, 1.0), abs=1e-12)
            assert flow.stress_r == 0.0


def test_small_stress_is_newtonian_to_second_order():
    # tau sinh(t)/t: the first correction of any mean is of the order of the stress squared
    flow = shear_flow(EYRING, 1e-4, 2e-4, 3e-4, UNLIMITED)
    assert flow.along == pytest.approx(1.0, abs=1e-6)
    assert flow.across == pytest.approx(1.0, abs=1e-6)


def test_pumping_alone_does_not_know_directions():
    straight = shear_flow(EYRING, 3.0, 0.0, 0.0, UNLIMITED)
    turned = shear_flow(EYRING, 3.0 * math.cos(0.7), 3.0 * math.sin(0.7), 0.0, UNLIMITED)
    assert turned.along == pytest.approx(straight.along, rel=1e-12)
    assert turned.across == pytest.approx(straight.along, rel=1e-12)


def test_vanishing_slopes_leave_the_closed_limits():
    # S_s = sqrt(1 + a^2); across, all layers shear at the mean viscosity a/asinh(a)
    a = 40.0
    flow = shear_flow(EYRING, 0.0, 0.0, a, UNLIMITED)
    assert flow.along == pytest.approx(math.hypot(1.0, a), rel=1e-12)
    assert flow.across == pytest.approx(a / math.asinh(a), rel=1e-12)


def test_factor_is_smooth_where_its_ratio_ends():
    for sigma_r in (0.0, 0.8, 9.0):
        inside = shear_flow(EYRING, 0.99e-5, sigma_r, 12.0, UNLIMITED).along
        outside = shear_flow(EYRING, 1.01e-5, sigma_r, 12.0, UNLIMITED).along
        assert inside == pytest.approx(outside, rel=1e-9)


def test_slopes_match_differences_over_the_whole_range():
    # central differences with a step of 1e-5 of the size: truncation 1e-9, rounding 1e-9 where
    # the flow is not steep; 1e-5 leaves room for sizes up to e^40
    rng = np.random.default_rng(3)
    for _ in range(300):
        sigma = rng.normal(size=2) * 10 ** rng.uniform(-2.0, 1.4)
        a = 10 ** rng.uniform(-2.0, 12.0)
        here = shear_flow(EYRING, *sigma, a, UNLIMITED)
        assert here.flow_ss * here.flow_rr > here.flow_sr**2
        step = 1e-5
        for axis, (first, second) in enumerate(
            [(here.flow_ss, here.flow_sr), (here.flow_sr, here.flow_rr)]
        ):
            flows = []
            for sign in (1.0, -1.0):
                moved = sigma.copy()
                moved[axis] += sign * step
                there = shear_flow(EYRING, *moved, a, UNLIMITED)
                flows.append(np.array([there.along, there.across]) * moved)
            slope = (flows[0] - flows[1]) / (2.0 * step)
            size = max(here.flow_ss, here.flow_rr)
            assert slope == pytest.approx([first, second], abs=1e-5 * size)
        up, down = (shear_flow(EYRING, *sigma, a * (1.0 + e), UNLIMITED) for e in (1e-5, -1e-5))
        slope_s = (up.along - down.along) * sigma[0] / (2e-5 * a)
        slope_r = (up.across - down.across) * sigma[1] / (2e-5 * a)
        size = max(here.along, here.across) * float(np.hypot(*sigma)) / a
        assert here.flow_s_a == pytest.approx(slope_s, abs=1e-5 * size)
        assert here.flow_r_a == pytest.approx(slope_r, abs=1e-5 * size)


def test_extreme_films_stay_finite():
    for sigma_s, sigma_r, a in ((1e9, -1e9, 1e300), (0.0, 300.0, 1e300), (1e-300, 0.0, -1e200)):
        assert np.isfinite(shear_flow(EYRING, sigma_s, sigma_r, a, UNLIMITED)).all()


def test_limiting_stress_caps_mid_film_stress_and_the_factor():
    free = shear_flow(EYRING, 0.4, 0.2, 1e6, UNLIMITED)
    capped = shear_flow(EYRING, 0.4, 0.2, 1e6, 3.0)
    assert free.stress_s > 14.0
    assert capped.stress_s == 3.0
    # the film flows as one sheared just to its limit
    low, high = 1.0, 1e3
    while high - low > 1e-9:
        middle = 0.5 * (low + high)
        low, high = (
            (middle, high)
            if shear_flow(EYRING, 0.4, 0.2, middle, UNLIMITED).stress_s < 3.0
            else (low, middle)
        )
    equal = shear_flow(EYRING, 0.4, 0.2, low, UNLIMITED)
    assert capped.along == pytest.approx(equal.along, rel=1e-9)
    assert capped.across == pytest.approx(equal.across, rel=1e-9)
    assert shear_flow(EYRING, 0.4, 0.2, 2.0, 3.0) == shear_flow(EYRING, 0.4, 0.2, 2.0, UNLIMITED)
    assert capped.flow_s_a == 0.0


def grid():
    x, y = np.linspace(-1.0, 1.0, 21), np.linspace(-1.0, 1.0, 17)
    pressure = 8e8 * np.sqrt(np.maximum(1.0 - x**2 - y[:, None] ** 2, 0.0))
    film = 2e-7 * (1.0 + 0.3 * y[:, None] * x)
    return x * 1e-4, y * 1e-4, pressure, film, 1e-2 * np.exp(pressure / 1e8)


def shear_of(oil, sliding, x, y, **units):
    return FilmShear.of(oil, sliding, (x[1] - x[0], y[1] - y[0]), y.size, **units)


def test_arrays_hold_the_tensor_of_every_node_and_turn_with_sliding():
    oil = film_oil(eta0=0.01, alpha=2e-8, eyring_stress=6e6)
    x, y, pressure, film, eta = grid()
    fields = pressure, film, 1.0 / eta
    along_x = shear_of(oil, (0.5, 0.0), x, y).factors(*fields)
    assert not isinstance(along_x, ObliqueFactors)
    j, i = 5, 13
    slope_x = (pressure[j, i + 1] - pressure[j, i - 1]) / (2.0 * (x[1] - x[0]))
    slope_y = (pressure[j + 1, i] - pressure[j - 1, i]) / (2.0 * (y[1] - y[0]))
    half = 0.5 * film[j, i] / 6e6
    flow = shear_flow(
        EYRING, half * slope_x, half * slope_y, 0.5 * eta[j, i] / (film[j, i] * 6e6), UNLIMITED
    )
    # many points and one end their iterations at other roundings of the stress, found to 1e-9
    assert along_x.xx[j, i] == pytest.approx(flow.along, rel=1e-9)
    assert along_x.yy[j, i] == pytest.approx(flow.across, rel=1e-9)
    # mirrored in the diagonal, sliding along y is sliding along x
    turned = (np.ascontiguousarray(values.T) for values in fields)
    diagonal = shear_of(oil, (0.0, -0.5), y, x).factors(*turned)
    np.testing.assert_allclose(diagonal.yy.T, along_x.xx, rtol=1e-9)
    np.testing.assert_allclose(diagonal.xx.T, along_x.yy, rtol=1e-9)
    # sliding turned by 180 degrees changes nothing; the tensor stays positive definite
    at_angle = shear_of(oil, (0.4, 0.3), x, y).factors(*fields)
    reverse = shear_of(oil, (-0.4, -0.3), x, y).factors(*fields)
    for name in ("xx", "xy", "yy"):
        assert getattr(at_angle, name) == pytest.approx(getattr(reverse, name), rel=1e-9)
    assert np.all(at_angle.xx * at_angle.yy > at_angle.xy**2)
    one, other = (factors.rates(np.ones(film.shape)) for factors in (at_angle, reverse))
    for here, there in zip(one, other, strict=True):
        for rate, back in zip(here, there, strict=True):
            assert rate == pytest.approx(back, rel=1e-9, abs=1e-9 * np.abs(rate).max())


def test_series_of_small_stress_meet_the_factors():
    # sides of the switch at 0.01: terms of the fourth order, 1e-8, are left out below
    oil = film_oil(eta0=0.01, alpha=2e-8, eyring_stress=1e4)
    values = []
    for size in (0.00999, 0.01001):
        shear = FilmShear.of(oil, (1.0, 0.0), (0.25, 0.25), 3, pressure=1e4)
        shear.couette[:] = 0.7 * size
        pressure = size * np.array([[0.0, 0.0, 0.6], [0.0, 0.3, 1.0], [0.4, 0.5, 1.2]])
        ones = np.ones((3, 3))
        values.append(shear.factors(pressure, ones, ones))
    for name in ("xx", "yy"):
        low, high = (getattr(value, name)[1, 1] - 1.0 for value in values)
        # both grow with the square of the stress
        assert high == pytest.approx(low * (1.001 / 0.999) ** 2, abs=1e-7)
    low, high = (value.rates(np.ones((3, 3))) for value in values)
    for before, after in ((low.xx, high.xx), (low.yy, high.yy)):
        # slopes by pressure differences grow with the stress, those by ln(h) with its square
        for name, power in (("by_film", 2), ("by_rise_x", 1), ("by_rise_y", 1)):
            expected = getattr(before, name)[1, 1] * (1.001 / 0.999) ** power
            assert getattr(after, name)[1, 1] == pytest.approx(expected, rel=1e-3, abs=0.0)


def test_border_and_nodes_without_film_are_newtonian():
    oil = film_oil(eta0=0.01, alpha=2e-8, eyring_stress=6e6)
    x, y, pressure, film, eta = grid()
    film[6, 9] = 0.0
    plain = np.ones(film.shape, dtype=bool)
    plain[1:-1, 1:-1] = False
    plain[6, 9] = True
    found = shear_of(oil, (0.5, 0.0), x, y).factors(pressure, film, 1.0 / eta)
    for factor in (found.xx, found.yy):
        assert np.all(factor[plain] == 1.0)
        assert np.all(factor[~plain] > 1.0)
    for part in found.rates(np.ones(film.shape)):
        for rate in part:
            assert np.all(rate[plain] == 0.0)


@each("law", [{}, {"limiting_shear": (1e4, 0.02)}])
@each(("size", "a"), [(0.004, 0.006), (0.5, 0.7), (1.5, 3.0)])
def test_powers_of_the_flow_are_its_logarithmic_derivatives(size, a, law):
    """Flow along sliding goes as G(s, a)/eta, s as h dp/dx and a as eta/h."""
    oil = film_oil(eta0=0.01, alpha=2e-8, eyring_stress=1e4, **law)
    rise = size * np.array([[-0.5, 0.0, 0.5]] * 3)

    def factors(slope=1.0, viscosity=1.0, film=1.0, level=0.0):
        shear = FilmShear.of(oil, (1.0, 0.0), (0.25, 0.25), 3, pressure=1e4)
        shear.couette[:] = a
        pressure = 1.0 + slope * rise + level
        fluidity = np.full((3, 3), 1.0 / viscosity)
        return shear.factors(pressure, np.full((3, 3), film), fluidity)

    def power(step=1e-3, **given):
        name, value = next(iter(given.items()))
        low, high = (math.log(factors(**{name: value + s}).xx[1, 1]) for s in (-step, step))
        return (high - low) / (2.0 * step)

    thickening = 0.8
    found = factors().rates(np.full((3, 3), thickening)).xx
    xx = factors().xx[1, 1]
    # differences over 1e-3 are right to 1e-6; the series of small stress leaves out 1e-8
    by_viscosity = power(viscosity=1.0)
    expected = thickening * by_viscosity + power(level=0.0)
    assert found.by_pressure[1, 1] / xx == pytest.approx(expected, abs=3e-6)
    assert found.by_film[1, 1] / xx == pytest.approx(power(film=1.0), abs=3e-6)
    assert found.by_rise_x[1, 1] * size / xx == pytest.approx(power(slope=1.0), abs=3e-6)
    # without a slope of pressure across the motion a small one changes nothing
    assert found.by_rise_y[1, 1] == 0.0
    slips = bool(law) and a > 1.0
    assert (abs(by_viscosity) < 1e-9) == slips


def test_units_of_the_arrays_do_not_matter():
    oil = film_oil(eta0=0.01, alpha=2e-8, eyring_stress=6e6)
    x, y, pressure, film, eta = grid()
    si = shear_of(oil, (0.4, 0.3), x, y).factors(pressure, film, 1.0 / eta)
    scaled = shear_of(oil, (0.4, 0.3), x, y, film=1e-6, pressure=1e9, viscosity=0.01).factors(
        pressure / 1e9, film / 1e-6, 0.01 / eta
    )
    for name in ("xx", "xy", "yy"):
        assert getattr(scaled, name) == pytest.approx(getattr(si, name), rel=1e-9)


def test_a_newtonian_oil_is_refused():
    with pytest.raises(ParameterError, match="tau0"):
        FilmShear.of(film_oil(eta0=0.01, alpha=2e-8), (1.0, 0.0), (1e-6, 1e-6), 3)
