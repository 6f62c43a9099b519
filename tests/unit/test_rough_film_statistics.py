"""Statistics of rough films against hand counts and closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
import xarray as xr

from gearlube_core.ehl.point.solid_contact import SolidContact
from gearlube_core.ehl.statistics.rough_film import (
    FilmFriction,
    RoughFilmStatistics,
    statistics_of_run,
)
from gearlube_core.ehl.statistics.zone import Distribution, FilmZone, weighted_percentiles
from gearlube_core.errors import ParameterError
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.each import each

A = 2e-4  # m
X = np.linspace(-3e-4, 3e-4, 121)  # half-width at nodes 20 and 100: 81 nodes inside
Y = 1e-3 / 16 * np.arange(16.0)
ZONE = FilmZone.line(X, Y, A * (1.0 + 1e-9))


def films(value: float = 4e-7) -> np.ndarray:
    return np.full((121, 16), value)


def gathered(*pairs: tuple[np.ndarray, np.ndarray], **other) -> xr.Dataset:
    found = RoughFilmStatistics(**({"zone": ZONE, "roughness": 2e-7} | other))
    for k, (film, pressure) in enumerate(pairs):
        found.add(1e-6 * k, film, pressure)
    return found.dataset()


def test_zones_have_the_areas_of_their_contacts():
    # a line's cells reach half a node beyond its outer nodes: 81 of 5 um, 16 of 62.5 um
    assert ZONE.cells[ZONE.inside].sum() == pytest.approx(81 * 5e-6 * 1e-3)
    x, y = np.linspace(-1.2, 1.2, 401), np.linspace(-2.2, 2.2, 401)
    ellipse = FilmZone.ellipse(x, y, 1.0, 2.0)
    # nodes on the rim make an area wrong by the order of a node over a radius
    assert ellipse.cells[ellipse.inside].sum() == pytest.approx(2.0 * math.pi, rel=2e-3)


def test_contact_is_counted_by_thresholds():
    film, pressure = films(), np.full((121, 16), 1e9)
    film[60, :8], film[61, 3], film[62, 5], film[63, 7] = 0.5e-9, 3e-9, 7e-9, 20e-9
    film[2, :] = 1e-9  # outside the zone
    found = gathered((film, pressure), (films(), pressure))
    assert found.contact_nodes[0].values.tolist() == [8, 9, 10, 11]
    assert found.contact_nodes[1].values.tolist() == [0, 0, 0, 0]
    assert found.contact_share[0].values == pytest.approx(np.array([8, 9, 10, 11]) / (81 * 16))
    assert found.threshold.values == pytest.approx(1e-9 * np.array([1, 5, 10, 25]))
    assert found.film_min.values == pytest.approx([0.5e-9, 4e-7])
    # half of the distribution's area is that of each film; bins of 1 nm hold what the thesis counts
    bins = found.film_histogram.values * 2 * 81 * 16
    assert bins[[0, 2, 6, 19]] == pytest.approx([8, 1, 1, 1])
    assert bins.sum() == pytest.approx(2 * 81 * 16)


def test_lambda_ratio_and_means():
    found = gathered((films(6e-7), np.full((121, 16), 1e9)), smooth_film=5e-7)
    assert found.lambda_smooth == pytest.approx(2.5)
    assert float(found.lambda_mean[0]) == pytest.approx(3.0)
    assert float(found.pressure_mean[0]) == pytest.approx(1e9)
    # all cells: 121 of 5 um over 1 mm
    assert float(found.film_load[0]) == pytest.approx(1e9 * 121 * 5e-6 * 1e-3)


def test_solids_carry_their_share():
    # 10 nm of layer at 5 nm carry 1 GPa: p_half (t/h - 1)^2 with t/h = 2
    film, pressure = films(), np.full((121, 16), 2e9)
    film[60:62, :] = 5e-9
    given = FilmFriction(
        oil=film_oil(eta0=0.01, alpha=0.0, law="barus"), sliding=(2.0, 0.0), solid_coefficient=0.12
    )
    found = gathered((film, pressure), solids=SolidContact(), friction=given)
    solid = 1e9 * 2 * 5e-6 * 1e-3
    assert float(found.solid_share[0]) == pytest.approx(solid / float(found.film_load[0]))
    assert float(found.solid_friction[0]) == pytest.approx(0.12 * solid)
    # the oil is Newtonian of one viscosity: eta u/h over each cell
    sheared = 0.01 * 2.0 * (2 / 5e-9 + 119 / 4e-7) * 5e-6 * 1e-3
    assert float(found.film_friction[0]) == pytest.approx(sheared)
    total = (sheared + 0.12 * solid) / float(found.film_load[0])
    assert float(found.friction_coefficient[0]) == pytest.approx(total)


def test_oil_between_touching_solids_has_its_own_pressure():
    # all the pressure is that of the solids: the oil keeps its viscosity at ambient pressure
    film = films(5e-9)
    given = FilmFriction(
        oil=film_oil(eta0=0.01, alpha=2e-8), sliding=(1.0, 0.0), solid_coefficient=0.1
    )
    found = gathered((film, np.full((121, 16), 1e9)), solids=SolidContact(), friction=given)
    expected = 0.01 * 1.0 / 5e-9 * 121 * 5e-6 * 1e-3
    assert float(found.film_friction[0]) == pytest.approx(expected)
    assert float(found.solid_share[0]) == pytest.approx(1.0)


def test_distribution_functions_are_those_of_the_values():
    random = np.random.default_rng(3)
    film = films()
    film[ZONE.inside] = 1e-7 * random.exponential(size=81 * 16)
    pressure = 1e9 * random.random((121, 16))
    found = gathered((film, pressure))
    h = film[ZONE.inside]
    share = np.mean(h[:, None] <= found.film_edge.values, axis=0)
    assert found.film_function.values == pytest.approx(share, abs=1e-12)
    # 1296 draws of an exponential lie within 0.05 of it with a probability of 0.998
    expected = 1.0 - np.exp(-found.film_edge.values / 1e-7)
    assert np.abs(found.film_function.values - expected).max() < 0.05
    for name, values in (("film", h), ("pressure", pressure[ZONE.inside])):
        exact = np.percentile(values, found.percent.values, method="inverted_cdf")
        assert found[f"{name}_percentile"][0].values == pytest.approx(exact, rel=1e-12)
        # gathered in bins: 10 MPa, 1 nm or 2 %
        width = np.maximum(1e-9, 0.02 * exact) if name == "film" else 1e7
        assert (np.abs(found[f"{name}_percentile_all"].values - exact) <= width).all()


def test_values_at_edges_and_beyond_count_where_they_should():
    of = Distribution(np.array([0.0, 1.0, 2.0]))
    assert np.isnan(of.function).all()
    assert np.isnan(of.percentiles(np.array([50.0]))).all()
    of.add(np.array([0.0, 1.0, 1.5, 3.0]), np.array([1.0, 2.0, 3.0, 4.0]))
    assert of.function == pytest.approx([0.1, 0.3, 0.6])
    assert of.shares == pytest.approx([0.3, 0.3])
    found = of.percentiles(np.array([5.0, 20.0, 30.0, 45.0, 61.0]))
    assert found[:4] == pytest.approx([0.0, 0.5, 1.0, 1.5])
    assert math.isnan(found[4])


def test_large_cells_weigh_more():
    values, areas = np.array([3.0, 1.0, 2.0]), np.array([1.0, 1.0, 8.0])
    found = weighted_percentiles(values, areas, np.array([5.0, 10.0, 11.0, 90.0, 91.0, 100.0]))
    assert found.tolist() == [1.0, 1.0, 2.0, 2.0, 3.0, 3.0]


def test_films_before_the_contact_is_rough_are_not_gathered():
    pressure = np.full((121, 16), 1e9)
    found = gathered((films(1e-9), pressure), (films(9e-7), pressure), gather_from=0.5e-6)
    assert found.gathered_films == 1
    assert found.film_min.size == 2
    # 2 % bins
    assert found.film_percentile_all.values == pytest.approx(9e-7, rel=0.02)


def test_a_saved_run_gives_the_same_without_solving(tmp_path):
    random = np.random.default_rng(4)
    film, pressure = 1e-7 * random.random((3, 121, 16)), 1e9 * random.random((3, 121, 16))
    direct = gathered(*zip(film, pressure, strict=True))
    run = xr.Dataset(
        {
            "film": (("y", "time", "x"), film.transpose(2, 0, 1)),
            "pressure": (("time", "x", "y"), pressure),
        },
        {"time": 1e-6 * np.arange(3), "x": X, "y": Y},
    )
    run.to_netcdf(tmp_path / "run.nc")
    with xr.open_dataset(tmp_path / "run.nc") as stored:
        whole = statistics_of_run(stored, RoughFilmStatistics(zone=ZONE, roughness=2e-7))
        parts = [stored.isel(time=slice(0, 2)), stored.isel(time=slice(2, 3))]
        pieces = statistics_of_run(parts, RoughFilmStatistics(zone=ZONE, roughness=2e-7))
    xr.testing.assert_identical(whole, direct)
    xr.testing.assert_identical(pieces, direct)


@each(
    ("wrong", "words"),
    [
        (lambda: gathered((films()[:-1], films())), r"film must have the shape \(121, 16\)"),
        (lambda: gathered((films(), np.full((121, 16), np.nan))), "pressure must be finite"),
        (lambda: gathered((films(-1e-9), films())), "film must be within 0"),
        (lambda: gathered((films(0.4), films())), "Give it in m"),
        (lambda: gathered((films(), films(1e15))), "Give it in Pa"),
        (lambda: gathered(), "Add at least one film"),
        (lambda: gathered((films(), films()), roughness=0.0), "roughness must be above 0 m"),
        (lambda: FilmZone.line(X + 1.0, Y, A), "must hold a node"),
        (lambda: FilmZone.line(X[::-1], Y, A), "x must be at least 4 rising"),
        (
            lambda: statistics_of_run(
                xr.Dataset({"film": ("x", X)}), RoughFilmStatistics(zone=ZONE, roughness=1e-7)
            ),
            "film must lie over time, x and y",
        ),
    ],
)
def test_films_that_cannot_be_are_refused(wrong, words: str):
    with pytest.raises(ParameterError, match=words):
        wrong()


def test_times_rise_and_nodes_are_those_of_the_zone():
    found = RoughFilmStatistics(zone=ZONE, roughness=2e-7)
    found.add(1e-6, films(), films(1e9))
    with pytest.raises(ParameterError, match="Times must rise, got 1e-06 s after 1e-06 s"):
        found.add(1e-6, films(), films(1e9))
    other = xr.Dataset(
        {name: (("time", "x", "y"), films()[None]) for name in ("film", "pressure")},
        {"time": [0.0], "x": 1e3 * X, "y": Y},
    )
    with pytest.raises(ParameterError, match="x of the run must be the nodes of the zone"):
        statistics_of_run(other, RoughFilmStatistics(zone=ZONE, roughness=2e-7))
