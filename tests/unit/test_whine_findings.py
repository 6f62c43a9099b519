"""Findings, key numbers and report of a whine study, from a dataset with known answers."""

import numpy as np
import pytest
import xarray as xr

from gearlube.report.page import report_html
from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.studies.whine.report import findings, meeting_speed, movers, numbers, whine_report
from gearlube.studies.whine.run import whine_rows
from tests.helpers.contact_cases import shipped_file
from tests.helpers.known_answers import (
    assert_cells,
    assert_findings,
    assert_numbers,
    assert_tables,
    quantities,
)

RPM, RPM_OF_RAD = np.array([1000.0, 2000.0, 3000.0]), 30.0 / np.pi
NAMES = ["misalignment.pinion_axial", "pinion.machine.radial_setting_mm", "gear.machine.still"]
# N per mm or per m: (speed, parameter, order)
FORCE = np.array([[10.0, 5.0], [40.0, 90.0], [20.0, 30.0]])


def whine(strong=1.0, unstable=False):
    """Order 2 is largest at 2000 rpm; the radial setting moves it by 9 N, the position by 2 N."""
    rate = np.zeros((3, 3, 2))
    rate[1, 0, 1], rate[1, 1, 1], rate[2, 1, 1] = -0.2e6, 900.0 * strong, 300.0
    rate[0, 0, 0] = 0.1e6
    return xr.Dataset(
        {
            "force": (("pinion_speed", "order"), FORCE),
            "force_rate": (("pinion_speed", "parameter", "order"), rate),
            "transmission_error": (("pinion_speed", "order"), 1e-6 * FORCE),
            "transmission_error_rate": (("pinion_speed", "parameter", "order"), 1e-6 * rate),
            "stable": (("pinion_speed",), [1.0, 0.0 if unstable else 1.0, 1.0]),
        },
        coords={
            "pinion_speed": RPM * np.pi / 30.0,
            "order": [1, 2],
            "phase": [0.0, 0.5],
            "parameter": NAMES,
            "unit": ("parameter", ["m", "mm", "mm"]),
            "tolerance": ("parameter", [1e-5, 0.01, 0.01]),
        },
        attrs={
            "name": "a pair",
            "torque": 50.0,
            "pinion_teeth": 13,
            "natural_frequency": 1300.0,
            "gear_file": shipped_file().model_dump_json(exclude_none=True),
        },
    )


def test_the_setting_that_moves_an_order_most_is_named_with_size_sign_and_speed():
    order_1, order_2 = movers(whine(), 1), movers(whine(), 2)
    # rate times tolerance: 0.1e6 N/m 10 um, 900 N/mm 0.01 mm, -0.2e6 N/m 10 um
    assert [(one.parameter, one.change) for one in order_1] == [(NAMES[0], pytest.approx(1.0))]
    assert [one.change for one in order_2] == pytest.approx([9.0, -2.0])
    assert order_2[0].speed_rpm == pytest.approx(2000.0)
    told = next(one for one in findings(whine()) if "Mesh order 2" in one.headline)
    assert told.level == NOTE
    assert "pinion radial setting, +0.01 mm: 9.00 N at 2000 rpm, 10 % of its force" in (
        told.headline
    )


def test_a_change_as_large_as_the_force_is_a_warning_that_the_size_is_rough():
    told = next(one for one in findings(whine(strong=20.0)) if "Mesh order 2" in one.headline)
    assert told.level == WARNING
    assert "the size is a rough estimate" in told.detail


def test_whine_has_its_known_key_numbers_findings_and_tables():
    # 60 1300 Hz over 13 teeth and the order
    assert [meeting_speed(whine(), order) for order in (1, 2)] == [6000.0, 3000.0]
    known = [
        ("natural frequency", 1300.0, "Hz", "1300"),
        ("largest mesh force, order 1", 40.0, "N", "40.0"),
        ("pinion speed of that force, order 1", 2000.0, "rpm", "2000"),
        ("largest transmission error, order 1", 40.0, "µrad", "40.0"),
        ("largest change of the force by one tolerance, order 1", 1.0, "N", "1.00"),
        ("largest mesh force, order 2", 90.0, "N", "90.0"),
        ("pinion speed of that force, order 2", 2000.0, "rpm", "2000"),
        ("largest transmission error, order 2", 90.0, "µrad", "90.0"),
        ("largest change of the force by one tolerance, order 2", 9.0, "N", "9.00"),
    ]
    assert_numbers(numbers(whine()), known)
    said = [
        (NOTE, "largest mesh force is that of … meets the natural frequency",
         "2, 90.0 N, 2000 rpm, 1300 Hz, 3000 rpm, 1, 40.0 N, 2000 rpm"),
        (NOTE, "most sensitive to misalignment",
         "1, +0.01 mm, 1.00 N, 1000 rpm, 10 %"),
        (NOTE, "most sensitive to pinion radial setting … Next",
         "2, +0.01 mm, 9.00 N, 2000 rpm, 10 %, +0.01 mm, −2.00 N, 2000 rpm"),
        (GOOD, "has a stable motion", "3"),
    ]  # fmt: skip
    assert_findings(findings(whine()), said)
    heads = ["parameter", "grows by", "change of the force [N]", "at [rpm]", "force there [N]",
             "change [%]"]  # fmt: skip
    axial, radial = "misalignment P (pinion)", "pinion: radial setting"
    tables = {
        "What small errors change of mesh order 1": [
            heads, [axial, "0.01 mm", 1.0, 1000.0, 10.0, 10.0]
        ],
        "What small errors change of mesh order 2": [
            heads,
            [radial, "0.01 mm", 9.0, 2000.0, 90.0, 10.0],
            [axial, "0.01 mm", -2.0, 2000.0, 90.0, -100.0 * 2.0 / 90.0],
        ],
    }  # fmt: skip
    report = whine_report(whine())
    assert_tables(report.tables, tables)
    assert quantities(report.subtitle) == ["50 N·m", "1000", "3000 rpm", "3"]
    force, changes, error = (one.chart.data for one in report.figures)
    for lines in (force, error):  # errors are a millionth of the forces, in µrad
        np.testing.assert_allclose([one.y for one in lines], FORCE.T)
    # of order 1 the position alone moves something, 1 N at 1000 rpm; it is on top, drawn last
    np.testing.assert_allclose(changes[0].z, [3 * [0.0], 3 * [0.0], [1.0, 0.0, 0.0]])
    assert report.figures[1].chart.layout.yaxis.ticktext[-1] == "misalignment P<br>(pinion)"
    # the largest change of order 1 of each: errors are a millionth of the forces
    rows = [
        [NAMES[0], 1e-5, "m", 1e-6, 1.0, 1000.0 / RPM_OF_RAD],
        [NAMES[1], 0.01, "mm", 0.0, 0.0, 1000.0 / RPM_OF_RAD],
        [NAMES[2], 0.01, "mm", 0.0, 0.0, 1000.0 / RPM_OF_RAD],
    ]
    for got, row in zip(whine_rows(whine()), rows, strict=True):
        assert_cells(list(got), row, "whine.csv")


def test_speeds_without_a_stable_motion_are_warnings():
    gaps = whine(unstable=True)
    gaps["force"][2] = np.nan
    said = [
        (WARNING, "no periodic motion was found, from", "1, 3, 3000, 3000 rpm"),
        (WARNING, "the motion is not stable, from", "1, 3, 2000, 2000 rpm"),
    ]
    assert_findings(findings(gaps)[-2:], said)


def test_the_report_has_its_figures_tables_and_inputs():
    html = report_html(whine_report(whine()))
    for part in ("What small errors change of mesh order 2", "pinion: radial setting", "50 N·m"):
        assert part in html
