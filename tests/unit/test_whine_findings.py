"""Findings, key numbers and report of a whine study, from a dataset with known answers."""

import numpy as np
import pytest
import xarray as xr

from gearlube.report.page import report_html
from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.studies.whine.findings import findings, meeting_speed, movers, numbers
from gearlube.studies.whine.report import whine_report
from tests.helpers.contact_cases import shipped_file

RPM = np.array([1000.0, 2000.0, 3000.0])
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


def test_the_largest_order_is_told_with_its_speed_and_where_it_meets_the_natural_frequency():
    # 60 1300 Hz / (2 13)
    assert meeting_speed(whine(), 2) == pytest.approx(3000.0)
    first = findings(whine())[0]
    assert "mesh order 2: 90.0 N, at 2000 rpm" in first.headline
    assert "at 3000 rpm" in first.detail
    found = {one.name: one.value for one in numbers(whine())}
    assert found["largest change of the force by one tolerance, order 2"] == pytest.approx(9.0)


def test_speeds_without_a_stable_motion_are_warnings():
    assert findings(whine())[-1].level == GOOD
    told = findings(whine(unstable=True))[-1]
    assert (told.level, "At 1 of 3 speeds" in told.headline) == (WARNING, True)
    gaps = whine()
    gaps["force"][2] = np.nan
    assert any("no periodic motion" in one.headline for one in findings(gaps))


def test_the_report_has_its_figures_tables_and_inputs():
    html = report_html(whine_report(whine(), "gearlube whine"))
    for part in ("What small errors change of mesh order 2", "pinion: radial setting", "50 N·m"):
        assert part in html
