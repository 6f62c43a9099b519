"""Dry contact on the grid of a film against Hertz, and against itself."""

import math

import numpy as np
import pytest
from scipy.special import ellipe, ellipk

from gearlube_core.contact.half_space import HalfSpaceConvolution, love_coefficients
from gearlube_core.ehl.point.contact_domain import elliptical_contact
from gearlube_core.ehl.point.dry_contact import dry_contact_of_gap
from gearlube_core.errors import ParameterError
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.each import each
from tests.helpers.ehl_point_cases import dry_contact
from tests.references.hertz_reference import HertzContact

E = 1.1375e11
OIL = film_oil(eta0=0.04, alpha=2e-8)


def hertz_grid(hertz, nx, ny, reach=1.25):
    """Return gap and spacing around an ellipse with its short axis along x."""
    b, a = hertz.semi_minor, hertz.semi_major
    x, y = np.linspace(-reach * b, reach * b, nx), np.linspace(-reach * a, reach * a, ny)
    gap = x[:, None] ** 2 / (2.0 * hertz.R_x) + y**2 / (2.0 * hertz.R_y)
    return gap, x, y


def radius_ratio(ellipticity):
    m = 1.0 - ellipticity**-2
    return (ellipticity**2 * ellipe(m) - ellipk(m)) / (ellipk(m) - ellipe(m))


@each("ellipticity", [1.0001, 5.0, 30.0, 100.0])
def test_ellipse_of_hertz(ellipticity):
    hertz = HertzContact(
        R_x=0.012, R_y=0.012 * radius_ratio(ellipticity), contact_modulus=E, load=300.0
    )
    gap, x, y = hertz_grid(hertz, 81, 81)
    dry = dry_contact_of_gap(gap, x[1] - x[0], y[1] - y[0], E, 300.0, tolerance=1e-8)
    # first order in the cell over the semi-axis at the edge, its square root of pressure inside
    cell = 1.0 / 32.0
    assert dry.pressure.max() == pytest.approx(hertz.maximum_pressure, rel=0.3 * cell)
    assert dry.approach == pytest.approx(hertz.approach, rel=0.1 * cell)
    area = np.count_nonzero(dry.pressure) * (x[1] - x[0]) * (y[1] - y[0])
    assert area == pytest.approx(math.pi * hertz.semi_major * hertz.semi_minor, rel=cell)
    inside = 1.0 - (x[:, None] / hertz.semi_minor) ** 2 - (y / hertz.semi_major) ** 2
    expected = hertz.maximum_pressure * np.sqrt(np.maximum(inside, 0.0))
    rms = math.sqrt(float(np.mean((dry.pressure - expected) ** 2)))
    assert rms < cell * hertz.maximum_pressure
    assert not dry.touches_border


def test_problem_of_a_film_is_solved_on_its_nodes():
    film = elliptical_contact(
        R_x=0.01,
        R_y=0.03,
        entrainment=(1.0, 0.5),
        load=50.0,
        contact_modulus=1.15e11,
        lubricant=OIL,
        nodes=(65, 49),
    )
    dry = dry_contact(film)
    assert dry.pressure.shape == dry.separation.shape == film.nodes
    dx, dy = film.x[1] - film.x[0], film.y[1] - film.y[0]
    assert dry.pressure.sum() * dx * dy == pytest.approx(50.0, rel=1e-12)
    # 10 nodes or so over the short half of the contact
    assert dry.pressure.max() == pytest.approx(film.hertz_contact[2], rel=0.03)


def test_complementarity_and_film_equation_hold_at_every_node():
    rng = np.random.default_rng(4)
    hertz = HertzContact(R_x=0.01, R_y=0.02, contact_modulus=E, load=30.0)
    gap, x, y = hertz_grid(hertz, 60, 50, 1.6)
    gap = gap + 2e-8 * rng.normal(size=gap.shape) - 3e-6
    dx, dy = x[1] - x[0], y[1] - y[0]
    dry = dry_contact_of_gap(gap, dx, dy, E, 30.0, tolerance=1e-10)
    u = HalfSpaceConvolution(love_coefficients(dx, dy, 60, 50, E) * dx * dy)(dry.pressure)
    film = gap - gap.min() - dry.approach + u
    assert film == pytest.approx(dry.separation, abs=1e-15)
    assert dry.pressure.min() == 0.0
    assert film.min() > -1e-9 * u.max()
    assert (dry.pressure * film).max() < 1e-8 * dry.pressure.max() * u.max()


def test_constant_of_the_gap_and_start_do_not_matter():
    hertz = HertzContact(R_x=0.01, R_y=0.02, contact_modulus=E, load=30.0)
    gap, x, y = hertz_grid(hertz, 40, 40)
    args = (x[1] - x[0], y[1] - y[0], E, 30.0)
    one = dry_contact_of_gap(gap, *args, tolerance=1e-10)
    two = dry_contact_of_gap(gap + 1e-3, *args, tolerance=1e-10, start=np.roll(one.pressure, 3))
    assert two.pressure == pytest.approx(one.pressure, abs=1e-6 * one.pressure.max())
    assert two.approach == pytest.approx(one.approach, rel=1e-9)


def test_where_there_is_no_solid_there_is_no_pressure():
    hertz = HertzContact(R_x=0.01, R_y=0.02, contact_modulus=E, load=30.0)
    gap, x, y = hertz_grid(hertz, 40, 40)
    gap[:, 25:] = math.inf
    dry = dry_contact_of_gap(gap, x[1] - x[0], y[1] - y[0], E, 30.0)
    assert np.all(dry.pressure[:, 25:] == 0.0)
    assert dry.pressure.max() > hertz.maximum_pressure


def test_a_grid_too_small_says_so():
    hertz = HertzContact(R_x=0.01, R_y=0.02, contact_modulus=E, load=30.0)
    gap, x, y = hertz_grid(hertz, 30, 30, 0.6)
    assert dry_contact_of_gap(gap, x[1] - x[0], y[1] - y[0], E, 30.0).touches_border


def test_bad_input_and_failure_are_reported():
    gap = np.zeros((4, 4))
    with pytest.raises(ParameterError, match="load"):
        dry_contact_of_gap(gap, 1e-6, 1e-6, E, 0.0)
    with pytest.raises(ParameterError, match="gap"):
        dry_contact_of_gap(gap[0], 1e-6, 1e-6, E, 1.0)
    with pytest.raises(ParameterError, match="start"):
        dry_contact_of_gap(gap, 1e-6, 1e-6, E, 1.0, start=gap[0])
    with pytest.raises(ParameterError, match="gap"):
        dry_contact_of_gap(np.full((4, 4), math.inf), 1e-6, 1e-6, E, 1.0)
    with pytest.raises(ParameterError, match="gap"):
        dry_contact_of_gap(np.full((4, 4), math.nan), 1e-6, 1e-6, E, 1.0)
