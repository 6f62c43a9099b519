"""The film fit of Nijenbanning, Venner and Moes: values, regimes, and films of this solver."""

import numpy as np
import pytest

from gearlube_core.ehl.point.settings import PointSolverSettings
from gearlube_core.ehl.point.solver import solve_point_contact
from gearlube_core.errors import ParameterError
from gearlube_core.film.line_film import central_film_group as line_film_group
from gearlube_core.film.point_film import central_film_group, regime_films
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.each import each
from tests.helpers.ehl_point_cases import moes_contact, moes_film


@each(
    ("M", "L", "value"),
    [
        (20.0, 5.0, 2.866),
        (20.0, 10.0, 4.265),
        (50.0, 10.0, 4.195),
        (100.0, 10.0, 4.128),
        (200.0, 10.0, 4.042),
    ],
)
def test_circular_values(M, L, value):
    assert central_film_group(M, L) == pytest.approx(value, abs=6e-4)


def test_regimes_return_at_their_ends():
    # s decides how sharp the corners are; far from them one regime is left, within 1 %
    assert central_film_group(0.3, 0.0) == pytest.approx(regime_films(0.3, 0.0)[0], rel=0.01)
    assert central_film_group(1e7, 0.0) == pytest.approx(regime_films(1e7, 0.0)[1], rel=0.01)
    assert central_film_group(3.0, 500.0) == pytest.approx(regime_films(3.0, 500.0)[2], rel=0.05)
    assert central_film_group(1e7, 30.0) == pytest.approx(regime_films(1e7, 30.0)[3], rel=0.05)


def test_more_load_never_thickens_and_material_never_thins():
    for ratio in (0.02, 0.3, 1.0):
        over_load = [central_film_group(M, 8.0, ratio) for M in np.geomspace(1.0, 1e4, 30)]
        assert np.all(np.diff(over_load) < 0.0)
        over_material = [central_film_group(60.0, L, ratio) for L in np.linspace(0.0, 20.0, 30)]
        assert np.all(np.diff(over_material) > 0.0)


def test_wide_contact_nears_the_line_in_the_piezoviscous_rigid_film():
    # 1.29 against 1.287 L^(2/3) of a line, less side flow 2/3 0.691 lam
    wide, line = regime_films(10.0, 10.0, 0.01).rigid_piezoviscous, 1.287 * 10.0 ** (2.0 / 3.0)
    assert wide == pytest.approx(line, rel=0.007)
    assert line_film_group(1e-3, 10.0) > line


@pytest.mark.parametrize(
    ("M", "L", "ratio"),
    [
        pytest.param(30.0, 6.0, 2.0, marks=pytest.mark.slow),
        pytest.param(120.0, 8.0, 5.0, marks=pytest.mark.slow),
        (400.0, 10.0, 20.0),
    ],
)
def test_solved_elliptical_films_lie_within_the_fit(M, L, ratio):
    # the fit knows no density; that of Dowson and Higginson takes 7 % to 12 % off these films
    oil = film_oil(eta0=0.04, alpha=2e-8, density_law="incompressible")
    problem = moes_contact(M, L, nodes=(129, 97), radius_ratio=ratio, lubricant=oil)
    solution = solve_point_contact(problem, PointSolverSettings(estimate_error=False))
    assert moes_film(problem, solution.central_film) == pytest.approx(
        central_film_group(M, L, 1.0 / ratio), rel=0.1
    )


def test_arguments_out_of_range_are_refused():
    with pytest.raises(ParameterError, match="radius_ratio"):
        central_film_group(10.0, 5.0, 3.0)
    with pytest.raises(ParameterError, match="M"):
        central_film_group(0.0, 5.0)
