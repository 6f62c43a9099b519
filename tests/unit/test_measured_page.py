"""The page of measurements says what its tables say, and the tables what the laws give now."""

import math

import pytest

from docs.measured import make
from docs.measured.points import Point, bearings
from docs.page import ROOT, Page


def test_tables_of_the_page_are_up_to_date():
    """If not: python -m docs.measured.make --present."""
    page = Page("measured")
    make.put(page, *make.stored())
    assert page.text == Page("measured").text


def test_first_pages_have_the_verdict_of_the_page():
    points = make.stored()[0]
    films = [one.inside for one in points if one.unit == "nm"]
    torques = [one.inside for one in points if one.unit != "nm"]
    for text in (Page("trust").text, (ROOT / "README.md").read_text(encoding="utf-8")):
        assert f"{sum(films)} of {len(films)} films" in text
        assert f"{sum(torques)} of {len(torques)}" in text


def test_predictions_of_bearings_are_those_of_the_laws_today():
    """If not: python -m docs.measured.make, as films may be old too."""
    stored = {(one.data, one.where): one for one in make.stored()[0]}
    for one in bearings():
        kept = stored[one.data, one.where]
        assert kept.predicted == pytest.approx(one.predicted, rel=1e-4)  # five digits are kept
        assert kept.measured == pytest.approx(one.measured, rel=1e-4)


def test_a_point_is_inside_where_both_bars_together_hold_the_difference():
    point = Point("", "", "nm", 100.0, 1.1, 115.0, 1.1)
    # ln 1.15 = 0.1398 lies beyond the root of 2 times ln 1.1 = 0.1348
    assert not point.inside
    assert point._replace(predicted=100.0 * math.exp(0.134)).inside
    assert point._replace(predicted=100.0 * math.exp(-0.134)).inside


def test_summary_has_geometric_mean_and_rms_of_logarithms():
    points = [Point("", "", "nm", 1.0, 1.1, ratio, 1.1) for ratio in (0.5, 2.0)]
    assert make.summary("all", points) == ["all", "2", "1.00", "69 %", "0 of 2"]
