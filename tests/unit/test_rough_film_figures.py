"""Figures of rough films show the statistics that they are given."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from PIL import Image

from gearlube.studies.films.figures.rough import (
    rough_distributions,
    rough_frame,
    rough_history,
    rough_thin_films,
)
from gearlube.studies.films.rough.animation import save_rough_animation
from gearlube_core.ehl.statistics.rough_film import RoughFilmStatistics
from gearlube_core.ehl.statistics.zone import FilmZone
from gearlube_core.errors import ParameterError

X = np.linspace(-4e-4, 4e-4, 41)
Y = np.arange(16) * 1e-3 / 16
HALF_WIDTH = 2.1e-4
STEP = 1e-7


def frames(thin: float) -> xr.Dataset:
    """Films that are `thin` on every fourth row, under a pressure that grows with time."""
    film = np.full((3, X.size, Y.size), 4e-7)
    film[:, :, ::4] = thin
    pressure = (
        np.array([1e9, 2e9, 3e9])[:, None, None]
        * np.maximum(1.0 - (X / HALF_WIDTH) ** 2, 0.0)[:, None]
    )
    pressure = np.broadcast_to(pressure, film.shape)
    dims = ("time", "x", "y")
    return xr.Dataset(
        {"film": (dims, film), "pressure": (dims, pressure)},
        {"time": STEP * np.arange(3), "x": X, "y": Y},
    )


def statistics(thin: float) -> xr.Dataset:
    found = RoughFilmStatistics(zone=FilmZone.line(X, Y, HALF_WIDTH), roughness=2e-7)
    run = frames(thin)
    for k in range(3):
        one = run.isel(time=k)
        found.add(float(one["time"]), one["film"].values, one["pressure"].values)
    return found.dataset()


@pytest.fixture(scope="module")
def runs() -> dict[str, xr.Dataset]:
    return {"crossed": statistics(4.5e-9), "straight": statistics(2e-7)}


def test_history_counts_steps_and_shows_every_run(runs):
    pressure, film, share, _ = rough_history(runs, STEP).axes
    for line in pressure.lines:
        assert line.get_xdata() == pytest.approx([0.0, 1.0, 2.0], abs=1e-12)
        assert line.get_ydata() == pytest.approx([1.0, 2.0, 3.0], rel=1e-12)
    assert [line.get_ydata()[0] for line in film.lines] == pytest.approx([4.5, 200.0], rel=1e-9)
    # one row in four is below 25 nm
    assert [line.get_ydata()[0] for line in share.lines] == pytest.approx([25.0, 0.0], rel=1e-9)


def test_distributions_tell_shares_below_films_and_above_pressures(runs):
    film, pressure = rough_distributions(runs).axes
    crossed = film.lines[0]
    # all thin rows and none of the others lie below 0.3 um
    assert np.interp(0.3, crossed.get_xdata(), crossed.get_ydata()) == pytest.approx(25.0, rel=1e-9)
    above = pressure.lines[0]
    inside = np.abs(X) < HALF_WIDTH
    expected = np.mean(frames(2e-7)["pressure"].values[:, inside] > 1.5e9)
    # a bin of 10 MPa holds a hundredth of the zone at most
    found = np.interp(1.5, above.get_xdata(), above.get_ydata())
    assert found == pytest.approx(100.0 * expected, abs=1.0)


def test_thin_films_stand_in_their_bins_beside_each_other(runs):
    bars = rough_thin_films(runs).axes[0].patches
    high = [bar for bar in bars if bar.get_height() > 0.0]
    assert len(high) == 1
    assert high[0].get_height() == pytest.approx(25.0, rel=1e-9)
    assert 4.0 < high[0].get_x() < 5.0


def test_frame_shows_pressure_film_and_a_row():
    figure = rough_frame(frames(4.5e-9).isel(time=1))
    maps = [ax.collections[0] for ax in figure.axes[:2]]
    assert float(np.max(maps[0].get_array())) == pytest.approx(2.0, rel=1e-12)
    assert float(np.min(maps[1].get_array())) == pytest.approx(0.0045, rel=1e-12)
    assert "at 0.1 µs" in figure.axes[0].get_title()


def test_animation_has_a_picture_for_every_frame_and_leaves_no_part(tmp_path: Path):
    path = save_rough_animation(frames(4.5e-9), tmp_path / "film.gif", per_second=10)
    with Image.open(path) as animation:
        assert animation.n_frames == 3
        assert animation.info["duration"] == 100
        shown = []
        for k in range(3):
            animation.seek(k)
            shown.append(np.asarray(animation.convert("RGB"), dtype=float))
    assert [file.name for file in tmp_path.iterdir()] == ["film.gif"]
    # one scale of colours: the pressure of 1 to 3 GPa brightens its map picture by picture,
    # the film and its colour bar stay as they are
    height = shown[0].shape[0]
    pressure = [one[: height // 3].mean() for one in shown]
    assert pressure[0] < pressure[1] < pressure[2]
    middle = slice(int(0.42 * height), int(0.6 * height))
    for one in shown[1:]:
        assert np.abs(one[middle] - shown[0][middle]).mean() < 1.0


def test_an_animation_of_one_film_is_refused(tmp_path: Path):
    with pytest.raises(ParameterError, match="at least 2 films over time, got 1"):
        save_rough_animation(frames(4.5e-9).isel(time=[0]), tmp_path / "film.gif")


def test_figures_ask_for_runs_by_name():
    with pytest.raises(ParameterError, match="statistics by label"):
        rough_history([statistics(2e-7)])
