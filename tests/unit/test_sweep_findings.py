"""Findings of a sweep against a dataset whose numbers are written down."""

import math

import numpy as np
import pytest

from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.studies.sweep.crossings import crossings
from gearlube.studies.sweep.datasets import merge
from gearlube.studies.sweep.findings import findings
from gearlube.studies.sweep.peaks import numbers, peak_orders
from gearlube.studies.sweep.point import failed_point
from gearlube.studies.sweep.settings import SweepSettings, quick_sweep_settings
from tests.helpers import sweep_stand_in as stand_in

SPEEDS, PRELOAD = [20.0, 60.0, 100.0], 2500.0


def mesh_hz(speed_kmh):
    return stand_in.TEETH * stand_in.pinion_speed_at(speed_kmh) / (2.0 * math.pi)


@pytest.fixture(scope="module")
def sweep():
    settings = quick_sweep_settings(SweepSettings())
    points = {(v, PRELOAD): stand_in.point(None, v, PRELOAD, settings) for v in SPEEDS}
    dataset = merge([PRELOAD], SPEEDS, points)
    modes = [1.05 * mesh_hz(60.0), 3.0 * mesh_hz(110.0)]
    dataset["mode_frequency"] = (("preload", "mode"), np.array([modes]))
    return dataset.assign_coords(mode=["gear axial", "mesh"]).assign_attrs(title="Speed sweep")


def found(dataset, words):
    (one,) = [one for one in findings(dataset) if words in one.headline]
    return one


def test_largest_mesh_order_is_the_one_put_in_and_its_place_is_told(sweep):
    # the signal has 1 um of order 1 and 0.3 um of order 2 at every speed; 60 km/h gets twice that
    louder = sweep.copy(deep=True)
    louder["dte_spectrum"][0, 1] *= 2.0
    one = found(louder, "largest mesh order")
    assert "order 1: 2.00 µm at 60 km/h" in one.headline
    assert f"({mesh_hz(60.0):.0f} Hz)" in one.headline
    assert "order 2 0.600 µm at 60 km/h" in one.detail
    assert one.level == WARNING  # the mode lies 5 % above
    assert "5 % below the nearest natural frequency, 'gear axial'" in one.detail
    assert [p.order for p in peak_orders(louder)] == [1, 2, 3]


def test_a_peak_away_from_every_mode_is_no_warning(sweep):
    apart = sweep.assign(mode_frequency=2.5 * sweep["mode_frequency"])
    assert found(apart, "largest mesh order").level == NOTE
    assert found(sweep.drop_vars("mode_frequency"), "largest mesh order").level == NOTE


def test_orders_meet_natural_frequencies_where_their_frequencies_are_equal(sweep):
    by_order = {(c.mode, c.order): c for c in crossings(sweep)}
    for order in (1, 2, 3):
        # f_m is in proportion to speed
        assert by_order["gear axial", order].speed_kmh == pytest.approx(63.0 / order, rel=1e-4)
    assert by_order["mesh", 3].speed_kmh == pytest.approx(110.0, rel=1e-4)
    assert by_order["mesh", 3].margin == pytest.approx(10.0 / 110.0, rel=1e-3)
    assert by_order["mesh", 1].margin == pytest.approx(230.0 / 330.0, rel=1e-3)
    one = found(sweep, "meet natural frequencies")
    assert "3 times between 20 and 100 km/h; 1 of these are order 1" in one.headline
    assert "at 63 km/h" in one.detail


def test_margin_is_told_where_no_order_meets_a_mode(sweep):
    far = sweep.assign(mode_frequency=sweep["mode_frequency"].isel(mode=[1]))
    one = found(far, "the smallest margin is 9 %")
    assert one.level == NOTE  # below 10 %
    farther = far.assign(mode_frequency=2.0 * far["mode_frequency"])
    assert found(farther, "the smallest margin is 55 %").level == GOOD  # (220 - 100) / 220


def test_loss_and_its_largest_parts(sweep):
    one = found(sweep, "largest loss")
    assert "42.0 W" in one.headline
    assert "bearing drag 48 %" in one.headline  # 20 of 42 W
    assert "97.9 to 97.9 %" in one.detail  # 1 - 42 / 2000
    assert "windage" in one.detail
    assert "churning" not in one.detail


def test_film_contact_and_rollers_have_the_levels_of_their_numbers(sweep):
    film = found(sweep, "smallest film ratio")
    assert "is 1.0, at" in film.headline  # 1.1 - 0.1
    assert film.level == NOTE
    assert found(sweep.assign(film_ratio_min=sweep["film_ratio_min"] * 0.5), "ratio").level == (
        WARNING
    )
    assert found(sweep.assign(film_ratio_min=sweep["film_ratio_min"] * 4.0), "ratio").level == GOOD
    assert found(sweep, "stay in contact").level == GOOD
    apart = sweep.copy(deep=True)
    apart["separation"][0, 0] = 1
    apart["separation"][0, 2] = 2
    apart["separated_fraction"][0, 2] = 0.25
    one = found(apart, "teeth separate")
    assert "at 2 of 3 points: 20, 100 km/h" in one.headline
    assert "At most 25 % of the time" in one.detail
    assert "At 1 points the coast flanks come into contact too" in one.detail
    free = sweep.copy(deep=True)
    free["bearing_roller_load_min"][:] = 5.0
    assert found(free, "Every roller stays loaded: at least 5.00 N").level == GOOD
    free["bearing_roller_load_min"][0, 1, 3] = 0.0
    assert "at 1 of 3 points: 60 km/h" in found(free, "Rollers leave").headline


def test_ranges_balance_and_failed_points(sweep):
    assert found(sweep, "No finished point left").level == GOOD
    left = sweep.copy(deep=True)
    left["range_exceeded"][0, 1] = 2
    assert "1 of 3 points left" in found(left, "left the range").headline
    assert found(sweep, "energy balance closes").level == GOOD
    opened = sweep.copy(deep=True)
    opened["energy_closure_error"][0, 1] = -0.02
    assert "up to 20000 ppm" in found(opened, "energy balance has an error").headline
    failed = merge([PRELOAD], [20.0], {(20.0, PRELOAD): failed_point(20.0, PRELOAD, "no")})
    (only,) = findings(failed)
    assert only.headline == "1 of 1 points failed."
    assert numbers(failed) == []


def test_key_numbers_are_those_of_the_signal(sweep):
    known = {one.name: (one.value, one.unit) for one in numbers(sweep)}
    value, unit = known["largest mesh order of the transmission error, amplitude"]
    assert (value, unit) == (pytest.approx(1.0, rel=1e-3), "µm")
    assert known["largest loss"] == (pytest.approx(42.0), "W")
    assert known["least efficiency of the axle"] == (pytest.approx(97.9), "%")
    assert known["warmest flank film"] == (pytest.approx(370.0 - 273.15), "°C")


def test_a_sweep_says_how_far_solved_films_are_to_be_trusted(sweep):
    assert not [one for one in findings(sweep) if "solved films" in one.headline]
    parts = ["friction_viscous", "friction_boundary"]
    friction = sweep["loss"].sel(source=parts).sum("source")
    outside = 0.0 * friction
    outside[0, 2] = 0.03
    solved = sweep.assign(
        friction_loss_bound=0.02 * friction,
        share_outside=outside,
        efficiency_bound=0.0004 + 0.0 * friction,
    )
    one = found(solved, "solved films")
    assert "2.0 % of the flanks' friction loss" in one.headline
    assert "at most 0.040 % of efficiency" in one.detail
    assert "at most 3 % of the flanks' load, at 100 km/h and preload 2500 N" in one.detail
    assert one.level == NOTE
    assert found(solved.assign(share_outside=10.0 * outside), "solved films").level == WARNING


def test_a_sweep_says_how_far_solved_films_of_rollers_are_to_be_trusted(sweep):
    drag = sweep["loss"].sel(source="bearing_torque", drop=True)
    outside = 0.0 * drag
    outside[0, 2] = 0.2
    solved = sweep.assign(drag_bound=0.03 * drag, rollers_outside=outside)
    one = found(solved, "solved films")
    assert "3.0 % of the bearings' drag loss" in one.headline
    assert "at most 20 % of the rollers' load, at 100 km/h and preload 2500 N" in one.detail
    assert one.level == WARNING
