"""The page on bearing friction says what the laws give now."""

from __future__ import annotations

from docs.bearing import make
from docs.page import Page
from tests.helpers.bearing_32216 import MEASURED


def test_tables_of_the_page_are_up_to_date():
    """If not: python -m docs.bearing.make."""
    page = Page("bearing")
    make.measured(page)
    assert page.text == Page("bearing").text


def test_the_page_compares_with_the_points_that_the_tests_know():
    points = {
        (degc, radial, rpm, torque)
        for (degc, radial), curve in MEASURED.items()
        for rpm, torque in curve.items()
    }
    assert {tuple(point) for point in make.POINTS} == points
