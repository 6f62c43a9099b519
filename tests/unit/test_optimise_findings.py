"""Findings, key numbers and report of an optimisation, from a dataset with known answers."""

import numpy as np
import pytest
import xarray as xr

from gearlube.report.page import report_html
from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.studies.optimise.findings import decibels, findings, numbers
from gearlube.studies.optimise.report import optimise_report
from gearlube_core.helical_geometry.gear_file import HelicalGearFile

# what, unit, before, after, limit: the pressure just at its limit, the loss within, the last worse
MEASURES = [
    ("mesh order 1", "urad", 20.0, 2.0, np.nan),
    ("highest pressure", "GPa", 1.0, 0.999, 1.0),
    ("sliding loss over friction coefficient", "1", 0.5, 0.4, 1.0),
    ("largest share of load in the border", "1", 0.10, 0.12, np.nan),
]


def optimised(measures=MEASURES, after=(2.0, 10.0), value=3.0, improved=1):
    """Two torques; all orders fall from 20 µrad to `after`; one field between 0 and 12 µm."""
    whine = 1e-6 * np.array([[[20.0, 25.0], [20.0, 30.0]], [[after[0], 5.0], [after[1], 12.0]]])
    phase = np.arange(8) / 8
    error = 1e-5 * np.cos(2.0 * np.pi * phase) * np.ones((2, 2, 2, 1))
    torque, name, unit, before, later, limit = zip(
        *((at, *row) for at in (50.0, 100.0) for row in measures), strict=True
    )
    return xr.Dataset(
        {
            "whine": (("design", "torque", "error"), whine),
            "amplitude": (("design", "torque", "error", "order"), whine[..., None]),
            "transmission_error": (("design", "torque", "error", "phase"), error),
            "value": (("design", "parameter"), [[1.0], [value]]),
            "value_unit": (("parameter",), ["um"]),
            "low": (("parameter",), [0.0]),
            "high": (("parameter",), [12.0]),
            "measure_torque": (("measure",), list(torque)),
            "measure_name": (("measure",), list(name)),
            "measure_unit": (("measure",), list(unit)),
            "measure_before": (("measure",), list(before)),
            "measure_after": (("measure",), list(later)),
            "measure_limit": (("measure",), list(limit)),
        },
        coords={
            "design": ["before", "better"],
            "torque": [50.0, 100.0],
            "error": ["none", "lead_slope +5 um"],
            "order": [1],
            "phase": phase,
            "parameter": ["pinion.flank.crown_um"],
        },
        attrs={
            "name": "mine",
            "pair": "he_2007",
            "kind": "helical",
            "aim": "mean",
            "improved": improved,
            "gear_file": HelicalGearFile.named("he_2007").model_dump_json(exclude_none=True),
        },
    )


def told(dataset, part):
    return next(one for one in findings(dataset) if part in one.headline)


def test_the_change_at_each_torque_is_told_in_decibels():
    # a tenth is -20 dB, a half -6.02 dB; with the error 25 to 5 is -13.98 dB, 30 to 12 is -7.96 dB
    assert list(decibels(optimised()).values()) == pytest.approx([-20.0, -6.0206], abs=1e-3)
    first, second = findings(optimised())[:2]
    assert (first.level, second.level) == (GOOD, GOOD)
    assert "−20.0 dB at 50 N·m, −6.0 dB at 100 N·m" in first.headline
    assert "−14.0 dB at 50 N·m, −8.0 dB at 100 N·m" in second.headline
    assert "lead slope +5 µm" in second.detail
    assert findings(optimised(after=(2.0, 21.0)))[0].level == WARNING


def test_a_limit_that_is_reached_is_active_and_one_that_is_passed_is_a_warning():
    active = told(optimised(), "active")
    assert active.level == NOTE
    assert "2 of 4 limits are active: highest pressure at 50 N·m" in active.headline
    passed = [(*MEASURES[1][:3], 1.1, 1.0), *MEASURES[2:]]
    broken = told(optimised(passed), "is not kept")
    assert broken.level == WARNING
    assert "1.10 GPa, allowed 1.00 GPa" in broken.headline
    slack = [(*MEASURES[1][:3], 0.9, 1.0)]
    assert told(optimised(slack), "none is active").level == GOOD


def test_what_got_worse_is_named_with_its_growth():
    worse = told(optimised(), "got worse")
    assert worse.level == NOTE
    assert "2 of 8 measures got worse" in worse.headline
    assert "border at 50 N·m, 0.120 (+20.0 %)" in worse.headline
    assert told(optimised(MEASURES[:3]), "No measure got worse").level == GOOD


def test_fields_on_their_bounds_and_a_search_without_success_are_told():
    assert not [one for one in findings(optimised()) if "bound" in one.headline]
    assert "pinion.flank.crown_um = 12.0 µm" in told(optimised(value=12.0), "bound").headline
    assert told(optimised(improved=0), "found nothing better").level == WARNING


def test_the_report_has_key_numbers_and_tables_before_and_after():
    found = {one.name: one.value for one in numbers(optimised())}
    assert found["change of all mesh orders at 50 N·m"] == pytest.approx(-20.0)
    assert found["limits not kept"] == 0.0
    dataset = optimised().assign_attrs(remarks="The pinion is undercut. Look.")
    html = report_html(optimise_report(dataset, "gearlube optimise"))
    for part in (
        "The pinion is undercut.",
        "Fields of the gear file",
        "All measures before and after",
        "−20.0 dB",
    ):
        assert part in html
