"""Films of the helical pairs of Jamali 2015: loads, speeds, steady and transient lines."""

from __future__ import annotations

import numpy as np
import pytest

from gearlube_core.ehl.gears.helical_film import (
    HelicalFilm,
    march_helical_cycle,
    solve_helical_line,
)
from gearlube_core.ehl.point.dry_contact import dry_contact_of_gap
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.meshing_steps import meshing_steps
from gearlube_core.oil.film_oil_data import jamali_2015_oil
from tests.helpers.jamali_2015 import jamali_2015_film


@pytest.mark.parametrize(
    ("design", "step", "speed"),
    [("a", 300, 6.7), ("b", 0, 5.8)],  # sec. 4.2; B at its first position
)
def test_entrainment_of_the_thesis(design, step, speed):
    film = jamali_2015_film(design)
    plane = film.modified.pair.plane
    X = film.line(step * film.time_step)
    where = 0.0
    if design == "b":  # where contact starts: x = A on the line
        where = (plane.A - X + 0.5 * plane.W * plane.sin_b / plane.cos_b) / plane.sin_b
    u1, u2 = film.surface_speeds(np.array([where]), X)
    assert 0.5 * float(u1[0] + u2[0]) == pytest.approx(speed, abs=0.05)


def test_largest_load_and_domain_of_the_thesis():
    film = jamali_2015_film("a")
    load, _ = film.largest_load()
    assert load == pytest.approx(14.4e3, abs=50.0)  # sec. 4.1
    moving = film.moving_film()
    # 4.5 semi-widths in 182 nodes a/40 apart: sec. 4.4
    width = moving.x_limits[1] - moving.x_limits[0]
    assert width / film.semi_width() == pytest.approx(181.0 / 40.0, rel=1e-12)


def test_step_out_of_the_cycle_is_refused():
    with pytest.raises(ParameterError, match="first"):
        march_helical_cycle(jamali_2015_film("a"), first=600)


def test_coarse_line_carries_its_load_close_to_the_dry_pressure():
    film = jamali_2015_film("a", newtonian=True, nodes=(49, 65))
    line = solve_helical_line(film, 300)
    X = film.line(300 * film.time_step)
    load = film.load(X)
    assert line.load == pytest.approx(load, rel=1e-5)
    dry = dry_contact_of_gap(
        film.gap(line.x, line.y, X),
        line.x[1] - line.x[0],
        line.y[1] - line.y[0],
        film.contact_modulus,
        load,
    )
    # smooth films reach the dry maximum within a few per cent
    assert line.maximum_pressure == pytest.approx(dry.pressure.max(), rel=0.03)
    assert 0.1e-6 < line.minimum_film < 0.25e-6


@pytest.mark.slow
def test_line_with_sharp_ends_carries_its_load():
    """The pair of He 2007 has neither crown nor relief: the line ends at full height."""
    modified = HelicalGearFile.named("he_2007").modified_pair()
    film = HelicalFilm(
        modified=modified,
        steps=meshing_steps(modified, 0.1e-3, 0.16),
        torque=225.97,
        pinion_speed=104.7,
        lubricant=jamali_2015_oil(newtonian=True),
        contact_modulus=113.75e9,
        nodes=(65, 65),
    )
    line = solve_helical_line(film, 0.5 * film.steps.count)
    assert line.load == pytest.approx(film.load(film.line(line.time)), rel=1e-5)
    middle = line.pressure.max(axis=0)[24:41]
    # pressure rises towards a sharp end, here between the last nodes
    assert line.maximum_pressure > 1.1 * middle.max()
    ends = np.flatnonzero(line.pressure.max(axis=0))
    assert (ends[0], ends[-1]) == (1, 63)
    assert middle.max() / middle.min() < 1.1


@pytest.mark.slow
def test_interrupted_cycle_gives_the_same_curves(tmp_path):
    film = jamali_2015_film("a", newtonian=True, nodes=(33, 49))
    keep = (300, 302, 304)
    whole = march_helical_cycle(film, first=300, last=304, checkpoint=tmp_path / "whole.npz",
                                checkpoint_every=2, keep=keep)  # fmt: skip
    part = tmp_path / "part.npz"

    class StopError(Exception):
        pass

    def stop(step, last, solution):
        if step == 303:
            raise StopError

    with pytest.raises(StopError):
        march_helical_cycle(film, first=300, last=304, checkpoint=part, checkpoint_every=2,
                            keep=keep, progress=stop)  # fmt: skip
    rest = march_helical_cycle(film, first=300, last=304, checkpoint=part, checkpoint_every=2,
                               keep=keep)  # fmt: skip
    assert whole.failures == 0
    for column in ("step", "load", "pressure_max", "minimum_film"):
        assert np.array_equal(whole[column], rest[column])
    # also the solutions from before the interruption
    assert set(rest.kept) == set(whole.kept) == set(keep)
    for n in keep:
        assert np.array_equal(rest.kept[n].pressure, whole.kept[n].pressure)
        assert np.array_equal(rest.kept[n].film, whole.kept[n].film)
        for name in ("time", "approach", "load", "residual", "outcome", "newton_steps"):
            assert getattr(rest.kept[n], name) == getattr(whole.kept[n], name)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("design", "pressures", "films"),
    [("a", (1.02, 1.25), (0.16, 0.22)), ("b", (0.82, 1.12), (0.16, 0.25))],
)
@pytest.mark.parametrize("step", [75, 300, 500])
def test_steady_lines_lie_in_the_ranges_of_the_thesis(design, pressures, films, step):
    """Sec. 5.2: ranges over the transient cycle; 5 % on pressure, 15 % on film."""
    film = jamali_2015_film(design, nodes=(97, 257))
    line = solve_helical_line(film, step)
    assert 0.95 * pressures[0] < 1e-9 * line.maximum_pressure < 1.05 * pressures[1]
    assert 0.85 * films[0] < 1e6 * line.minimum_film < 1.15 * films[1]
