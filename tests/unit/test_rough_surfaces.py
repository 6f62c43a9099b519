"""Measured heights and shapes of micro-geometry: values, files, and grids that they refuse."""

from __future__ import annotations

import math

import numpy as np
import pytest
import xarray as xr

from gearlube_core.ehl.gap import Dent, Ridge, RoughGap, Waviness
from gearlube_core.errors import ParameterError
from gearlube_core.surface.measured_heights import (
    MeasuredMap,
    MeasuredProfile,
    read_map,
    read_profile,
)

X = np.array([-0.002, -0.0013, -0.0002, 0.0001, 0.0012, 0.0021])  # m
Y = np.array([0.001, 0.0014, 0.0023, 0.0031, 0.0034])


def cubic(x: np.ndarray) -> np.ndarray:
    return 2e-6 + 3e-3 * x - 4.0 * x**2 + 500.0 * x**3


def test_splines_of_measured_heights_are_exact_for_cubics():
    profile = MeasuredProfile(X, cubic(X))
    between = np.linspace(-0.002, 0.0021, 17)
    assert profile(between) == pytest.approx(cubic(between), rel=1e-9)
    surface = MeasuredMap(X, Y, cubic(X)[:, None] * (1.0 + 1e3 * Y - 2e8 * Y**3))
    y = np.linspace(0.001, 0.0034, 17)
    expected = cubic(between) * (1.0 + 1e3 * y - 2e8 * y**3)
    assert surface(between, y) == pytest.approx(expected, rel=1e-9)
    assert surface(between[:, None], y[:3]).shape == (17, 3)


def test_files_give_metres(tmp_path):
    table = tmp_path / "heights.csv"
    rows = "\n".join(f"{1e3 * x},{1e6 * z}" for x, z in zip(X, cubic(X), strict=True))
    table.write_text(f"# an instrument\nx_mm, height_um\n\n# more\n{rows}\n")
    profile = read_profile(table)
    assert profile.x == pytest.approx(X)
    assert profile.height == pytest.approx(cubic(X))
    assert profile.name == f"profile {table}"

    height = np.outer(cubic(X), Y)
    np.savez(tmp_path / "map.npz", x=1e3 * X, y=1e3 * Y, height=1e6 * height)
    data = {"height": (("y", "x"), 1e6 * height.T)}
    xr.Dataset(data, coords={"x": 1e3 * X, "y": 1e3 * Y}).to_netcdf(tmp_path / "map.nc")
    for name in ("map.npz", "map.nc"):
        stored = read_map(tmp_path / name)
        assert stored.x == pytest.approx(X)
        assert stored.y == pytest.approx(Y)
        assert stored.height == pytest.approx(height)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "must have a line of names"),
        ("x,height_um\n", "missing: x_mm; got x, height_um"),
        ("x_mm,height_um\n0,1\n1,2\n2;3,0,1\n", "line 4"),
    ],
)
def test_tables_of_another_kind_are_refused(tmp_path, text: str, words: str):
    table = tmp_path / "heights.csv"
    table.write_text(text)
    with pytest.raises(ParameterError, match=words):
        read_profile(table)
    with pytest.raises(ParameterError, match="table missing\\.csv was not found"):
        read_profile(tmp_path / "missing.csv")


def test_maps_of_another_kind_are_refused(tmp_path):
    np.savez(tmp_path / "map.npz", x=X, y=Y)
    with pytest.raises(ParameterError, match=r"'height.*' is missing|height.* is missing"):
        read_map(tmp_path / "map.npz")
    (tmp_path / "map.nc").write_text("no data")
    with pytest.raises(ParameterError, match="not a readable NetCDF"):
        read_map(tmp_path / "map.nc")


def test_places_must_rise_and_numbers_be_finite():
    four = np.array([0.0, 1.0, 2.0, 3.0]) * 1e-3
    assert MeasuredProfile(four, four)(1.5e-3) == pytest.approx(1.5e-3)
    with pytest.raises(ParameterError, match="at least 4 places along x"):
        MeasuredProfile(four[:3], four[:3])
    with pytest.raises(ParameterError, match="along x"):
        MeasuredProfile(four.reshape(1, 4), four)
    with pytest.raises(ParameterError, match=r"got 2 mm and then 1\.5 mm"):
        MeasuredProfile(np.array([0.0, 1.0, 2.0, 1.5, 3.0]) * 1e-3, np.zeros(5))
    with pytest.raises(ParameterError, match=r"shape \(4,\) of their places, got \(5,\)"):
        MeasuredProfile(four, np.zeros(5))
    heights = np.zeros((4, 4))
    heights[1, 2] = heights[3, 0] = math.nan
    with pytest.raises(ParameterError, match=r"2 of 16 numbers are not, the first at index \(1, 2"):
        MeasuredMap(four, four, heights)
    with pytest.raises(ParameterError, match="1 of 4 numbers are not, the first at index 3"):
        MeasuredProfile(four, np.array([0.0, 0.0, 0.0, math.inf]))


def test_grid_must_lie_within_the_places_but_for_rounding():
    places = np.linspace(-1e-3, 1e-3, 201)
    profile = MeasuredProfile(places, np.zeros(201))
    for less, more in ((1.0, 1.05), (1.05, 1.0)):  # 1e-6 of the range is rounding
        beyond = np.linspace(-1e-3 - less * 1e-6 * 2e-3, 1e-3 + more * 1e-6 * 2e-3, 81)
        with pytest.raises(ParameterError, match="must cover the domain -1 to 1 mm"):
            profile.check_serves(beyond)
    profile.check_serves(np.linspace(-1e-3 - 0.95e-9 * 2, 1e-3 + 0.95e-9 * 2, 81))


def test_grid_must_not_be_finer_than_the_places_on_it():
    # wide intervals beyond the grid do no harm
    places = np.array([-5.0, -1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 4.0]) * 1e-3
    surface = MeasuredMap(places, places, np.zeros((8, 8)))
    grid = np.linspace(-1e-3, 1e-3, 5)
    surface.check_serves(grid, grid)
    with pytest.raises(ParameterError, match=r"along y, 400 um, got places up to 500 .*most 5 "):
        surface.check_serves(grid, np.linspace(-1e-3, 1e-3, 6))
    with pytest.raises(ParameterError, match=r"along x, 1900 um, got places up to 3500 .*most 2 "):
        surface.check_serves(np.linspace(-1.8e-3, 2e-3, 3), grid)
    for share, served in ((0.95e-6, True), (1.05e-6, False)):
        finer = np.linspace(0.0, 0.5e-3 * (1.0 - share), 2)
        if served:
            surface.check_serves(finer, grid)
        else:
            with pytest.raises(ParameterError, match="along x"):
                surface.check_serves(finer, grid)


def test_ridge_is_half_as_high_half_a_width_from_its_crest():
    lies = Ridge(height=2e-6, width=4e-5)
    y = np.linspace(-1.0, 1.0, 3)
    assert lies(np.zeros(3), y) == pytest.approx(2e-6)  # across x through the middle
    assert lies(np.full(3, 2e-5), y) == pytest.approx(1e-6)
    assert lies(np.full(3, -4e-5), y) == pytest.approx(2e-6 / 16.0)
    assert Ridge(height=2e-6, width=4e-5, direction=0.0)(0.7, 0.0) == pytest.approx(2e-6)
    angle = 0.3
    along = np.array([math.cos(angle), math.sin(angle)])
    normal = np.array([math.sin(angle), -math.cos(angle)])
    crest = np.array([1e-4, -3e-4])
    ridge = Ridge(height=-2e-6, width=4e-5, x=crest[0], y=crest[1], direction=angle)
    for distance, share in ((0.0, 1.0), (2e-5, 0.5), (-2e-5, 0.5), (6e-5, 2.0**-9)):
        place = crest + 7e-4 * along + distance * normal
        assert ridge(*place) == pytest.approx(-2e-6 * share)


def test_dent_is_half_as_deep_half_a_width_from_its_middle():
    dent = Dent(depth=2e-6, width=4e-5)
    assert dent(0.0, 0.0) == pytest.approx(-2e-6)
    aside = Dent(depth=2e-6, width=4e-5, x=1e-4, y=-3e-4)
    for angle in (0.0, 0.7, 4.0):
        place = 1e-4 + 2e-5 * math.cos(angle), -3e-4 + 2e-5 * math.sin(angle)
        assert aside(*place) == pytest.approx(-1e-6)


def test_waves_repeat_after_a_wavelength_across_their_crests():
    wave = Waviness(amplitude=1e-6, wavelength=2e-4)
    assert wave(0.0, 5.0) == pytest.approx(1e-6)
    assert wave(1e-4, 5.0) == pytest.approx(-1e-6)
    assert wave(0.5e-4, 0.0) == pytest.approx(0.0, abs=1e-18)
    turned = Waviness(amplitude=1e-6, wavelength=2e-4, direction=0.4, phase=0.9)
    for part in (0.0, 0.2, 1.0, -0.7):
        place = part * 2e-4 * math.cos(0.4), part * 2e-4 * math.sin(0.4)
        expected = 1e-6 * math.cos(2.0 * math.pi * part + 0.9)
        assert turned(*place) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("shape", "nodes", "angle"),
    [
        (lambda size, d: Ridge(height=1e-6, width=size, direction=d + 0.5 * math.pi), 4.0, 0.6),
        (lambda size, d: Waviness(amplitude=1e-6, wavelength=size, direction=d), 8.0, 0.6),
        (lambda size, d: Dent(depth=1e-6, width=size), 4.0, 0.0),
    ],
    ids=["ridge", "waviness", "dent"],
)
def test_shapes_need_nodes_across_them(shape, nodes: float, angle: float):
    fine, coarse = np.linspace(0.0, 1.0, 1001) * 1e-3, np.linspace(0.0, 1.0, 101) * 1e-3
    along_y = math.sin(angle) if angle else 1.0
    for grid, share, axis in (
        ((coarse, fine), math.cos(angle), "x"),
        ((fine, coarse), along_y, "y"),
    ):
        needed = nodes * 1e-5 * share  # the widest interval counts
        shape(1.001 * needed, angle).check_serves(*grid)
        with pytest.raises(ParameterError, match=f"{nodes:g} nodes along {axis}"):
            shape(0.999 * needed, angle).check_serves(*grid)
    uneven = np.sort(np.append(coarse, 3e-6))
    with pytest.raises(ParameterError, match="nodes along x"):
        shape(0.999 * nodes * 1e-5 * math.cos(angle), angle).check_serves(uneven, fine)


def test_heights_narrow_the_gap():
    heights = (Ridge(height=1e-6, width=1e-4), Dent(depth=3e-6, width=1e-4))
    gap = RoughGap(lambda x, y: 5e-6 + 0.0 * x * y, heights)
    assert gap(np.zeros(1), np.zeros(1)) == pytest.approx(5e-6 - 1e-6 + 3e-6)
