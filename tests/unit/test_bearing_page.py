"""The page on bearing friction says what the laws give now."""

from __future__ import annotations

import pytest

from docs.bearing import make
from docs.field_tables import field_tables
from gearlube_core.bearings.bearing_file import BearingFile
from tests.helpers.bearing_32216 import MEASURED

PAGE = make.PAGE.read_text(encoding="utf-8")


@pytest.mark.parametrize("part", [make.torques, make.misfits, make.parts])
def test_tables_of_the_page_are_up_to_date(part):
    """If not: python -m docs.bearing.make."""
    assert part().strip("\n") in PAGE


def test_fields_of_the_page_are_those_of_the_file():
    assert field_tables(BearingFile, {"bearing": "[bearing]"}).strip("\n") in PAGE


def test_the_page_compares_with_the_points_that_the_tests_know():
    points = {
        (degc, radial, rpm, torque)
        for (degc, radial), curve in MEASURED.items()
        for rpm, torque in curve.items()
    }
    assert {tuple(point) for point in make.POINTS} == points
