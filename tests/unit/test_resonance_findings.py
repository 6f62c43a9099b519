"""Findings, key numbers and report of a resonance study, from a response with known folds."""

import numpy as np
import pytest
import xarray as xr

from gearlube.report.page import report_html
from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.studies.resonance.findings import (
    findings,
    jumps,
    leading_model,
    numbers,
    unstable_ranges,
)
from gearlube.studies.resonance.report import resonance_report, response_chart

# a branch that leans to low frequency: up to 0.95, back unstable to 0.85, and on with teeth apart
RELATIVE = np.array([0.5, 0.8, 0.9, 0.95, 0.92, 0.88, 0.85, 0.9, 1.0, 1.1, 1.2])
SIZE = np.array([1.0, 2.0, 4.0, 8.0, 12.0, 16.0, 20.0, 15.0, 10.0, 5.0, 2.0])
STABLE = np.array([1, 1, 1, 1, 0, 0, 1, 1, 1, 1, 1], float)
APART = np.array([0, 0, 0, 0, 0.1, 0.2, 0.4, 0.3, 0.1, 0, 0])


def response(bent=True, models=("two_dof",), interrupted=0):
    """One branch for each model: bent over with two folds, or straight and stable."""
    relative = RELATIVE if bent else np.linspace(0.5, 1.2, 11)
    rows = {
        "relative_frequency": relative,
        "frequency": 1000.0 * relative,
        "peak_to_peak": 1e-6 * SIZE,
        "minimum": 1e-6 * SIZE,
        "separation_share": APART if bent else np.zeros(11),
        "multiplier": np.where(STABLE > 0.5, 0.9, 1.2),
        "stable": STABLE if bent else np.ones(11),
        "segment": np.zeros(11),
        "periods": np.ones(11),
    }
    count = len(models)
    data = {name: (("model", "row"), np.tile(values, (count, 1))) for name, values in rows.items()}
    data["harmonics"] = (("model", "row", "harmonic"), np.ones((count, 11, 2)))
    kinds = ["fold", "fold"] if bent else ["", ""]
    data["special_kind"] = (("model", "special"), np.tile(np.array(kinds), (count, 1)))
    places = np.tile([0.95, 0.85], (count, 1))
    data["special_relative_frequency"] = (("model", "special"), places)
    data["special_segment"] = (("model", "special"), np.zeros((count, 2)))
    return xr.Dataset(
        data,
        coords={"model": list(models), "harmonic": [1, 2]},
        attrs={
            "first": 0.5,
            "last": 1.2,
            "interrupted": interrupted,
            "natural_frequency": 1300.0,
            "pinion_teeth": 13,
            "static_deflection": 5e-6,
            "pinion_torque": 50.0,
            "oil_temperature": 313.15,
            "roughness_rms": 5e-7,
            "radii": "consistent",
            "friction": "off",
            "source": "made by hand",
        },
    )


def test_sweeps_jump_at_the_folds_and_land_on_the_next_stable_motion():
    up, down = jumps(response(), "two_dof")
    # up: from 8 um at the fold 0.95 to the row at 1.0; down: from 20 um at 0.85 to that at 0.8
    assert tuple(up) == ("up", 0.95, pytest.approx(8e-6), pytest.approx(10e-6))
    assert tuple(down) == ("down", 0.85, pytest.approx(20e-6), pytest.approx(2e-6))
    assert unstable_ranges(response(), "two_dof") == [(0.88, 0.92)]


def test_a_bent_resonance_is_told_with_its_peak_jumps_parted_teeth_and_unstable_range():
    largest, jumped, parted, unstable = findings(response())
    assert (largest.level, jumped.level, parted.level) == (WARNING, WARNING, WARNING)
    assert "20.0 µm peak to peak, at 0.850" in largest.headline
    # 20 um over 5 um; 60 0.85 1300 Hz / 13
    assert "4.0 times" in largest.detail
    assert "5100 rpm" in largest.detail
    assert "twice: with rising speed at 0.950 (5700 rpm)" in jumped.headline
    assert "rising speed from 1.000 to 1.000, with falling speed from 1.000 to 0.850" in (
        parted.headline
    )
    assert "40 % of the time" in parted.detail
    assert (unstable.level, "from 0.880 to 0.920" in unstable.headline) == (NOTE, True)


def test_a_straight_response_has_no_jumps_and_no_parted_teeth():
    _, jumped, parted, unstable = findings(response(bent=False))
    assert [jumped.level, parted.level, unstable.level] == [GOOD, GOOD, GOOD]
    found = {one.name: one.value for one in numbers(response(bent=False))}
    assert found["jumps, 2-DOF, dry"] == 0.0
    assert found["widest range of parted teeth, 2-DOF, dry"] == 0.0


def test_the_lubricated_model_leads_and_others_are_laid_beside_it():
    several = response(models=("two_dof", "one_dof", "two_dof_lubricated"))
    assert leading_model(several) == "two_dof_lubricated"
    told = findings(several)[-1]
    assert "without friction 20.0 µm (+0 %), with one degree of freedom 20.0 µm" in told.headline


def test_a_stopped_study_says_so_even_without_a_model():
    assert findings(response(interrupted=1))[0].level == WARNING
    bare = xr.Dataset(attrs={"interrupted": 1})
    assert [one.level for one in findings(bare)] == [WARNING]
    assert numbers(bare) == []


def test_stretches_of_the_response_meet_where_stability_changes():
    solid, dashed = response_chart(response()).data[:2]
    assert dashed.name == "2-DOF, dry, unstable"
    # unstable rows and their neighbours
    np.testing.assert_array_equal(np.isfinite(dashed.y[:11]), [0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 0])
    np.testing.assert_array_equal(np.isfinite(solid.y[:11]), STABLE)


def test_the_report_has_models_inputs_and_limits(tmp_path):
    html = report_html(resonance_report(response(), tmp_path, command_line="gearlube resonance"))
    for part in ("Models side by side", "fold 0.9500, fold 0.8500", "roughness of both flanks"):
        assert part in html
