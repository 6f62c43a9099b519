"""Findings, key numbers and report of a resonance study, from a response with known folds."""

from itertools import pairwise

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

from gearlube.report.page import report_html
from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.report.redrawn import redrawn
from gearlube.studies.resonance.figures.response_curves import draw_branch
from gearlube.studies.resonance.findings import (
    findings,
    jumps,
    leading_model,
    numbers,
    unstable_ranges,
)
from gearlube.studies.resonance.report import resonance_report
from tests.helpers.known_answers import assert_findings, assert_numbers

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


def test_a_bent_resonance_has_its_known_key_numbers_and_findings():
    # 20 um over 5 um; 60 0.85 1300 Hz / 13 = 5100 rpm; a step is above 5 % of the larger motion
    expected = [
        (WARNING, "largest response … static deflection … Model: 2-DOF, dry",
         "20.0 µm, 0.850, 4.0, 5100 rpm, 1300 Hz, 2"),
        (WARNING, "jumps twice: with rising speed at … with falling speed at",
         "0.950, 5700 rpm, 8.00 µm, 10.0 µm, 0.850, 5100 rpm, 20.0 µm, 2.00 µm"),
        (WARNING, "teeth separate: with rising speed … with falling speed",
         "1.000, 1.000, 1.000, 0.850, 40 %"),
        (NOTE, "unstable from", "0.880, 0.920"),
    ]  # fmt: skip
    assert_findings(findings(response()), expected)
    known = [
        ("natural frequency", 1300.0, "Hz", "1300"),
        ("largest response, 2-DOF, dry", 20.0, "µm", "20.0"),
        ("mesh over natural frequency there, 2-DOF, dry", 0.85, "", "0.850"),
        ("jumps, 2-DOF, dry", 2.0, "", "2"),
        ("widest range of parted teeth, 2-DOF, dry", 0.15, "", "0.150"),
    ]
    assert_numbers(numbers(response()), known)


def test_a_straight_response_has_its_known_key_numbers_and_findings():
    straight = response(bent=False)
    expected = [
        # the seventh of eleven places from 0.5 to 1.2
        (WARNING, "largest response", "20.0 µm, 0.920, 4.0, 5520 rpm, 1300 Hz, 2"),
        (GOOD, "no jumps", ""),
        (GOOD, "never separate", ""),
        (GOOD, "are stable from", "0.5, 1.2"),
    ]
    assert_findings(findings(straight), expected)
    assert [one.value for one in numbers(straight)] == pytest.approx([1300.0, 20.0, 0.92, 0.0, 0.0])
    longer = straight.assign(periods=(("model", "row"), [[1.0] * 10 + [2.0]]))
    assert findings(longer)[3].level == GOOD


def test_what_happens_over_the_torque_is_told_from_stable_motions_alone():
    torque = [20.0, 30.0, 50.0, 70.0]
    load = xr.Dataset(
        {
            "separation_share": (("form", "row"), [[0.4, 0.3, 0.2, 0.0]]),
            "stable": (("form", "row"), [[0.0, 1.0, 1.0, 1.0]]),
            "torque": (("form", "row"), [torque]),
        },
        attrs={"relative_frequency": 0.9},
    )
    last = findings(response(), load)[-1]
    assert_findings([last], [(WARNING, "teeth apart exist from", "0.9, 30, 50 N·m")])
    none = findings(response(), load.assign(stable=0.0 * load["stable"]))[-1]
    assert_findings([none], [(GOOD, "no stable motion has teeth apart", "0.9")])


def test_the_lubricated_model_leads_and_others_are_laid_beside_it():
    several = response(models=("two_dof", "one_dof", "two_dof_lubricated"))
    assert leading_model(several) == "two_dof_lubricated"
    several["peak_to_peak"][0], several["peak_to_peak"][1] = 1.1e-6 * SIZE, 0.75e-6 * SIZE
    said = (NOTE, "simpler models is without friction … with one degree of freedom … lubricated",
            "22.0 µm, +10 %, 15.0 µm, −25 %, 20.0 µm, 2")  # fmt: skip
    assert_findings(findings(several)[4:], [said])


def test_a_stopped_study_says_so_even_without_a_model():
    assert findings(response(interrupted=1))[0].level == WARNING
    bare = xr.Dataset(attrs={"interrupted": 1})
    assert [one.level for one in findings(bare)] == [WARNING]
    assert numbers(bare) == []


def test_stretches_of_the_response_meet_where_stability_changes():
    figure = Figure()
    branch = response().sel(model="two_dof")
    draw_branch(figure.subplots(), branch, SIZE, "#0072B2")
    drawn = redrawn(figure).data
    assert [one.line.dash == "solid" for one in drawn] == [True, False, True]
    for one, following in pairwise(drawn):
        assert (one.x[-1], one.y[-1]) == (following.x[0], following.y[0])
    # rows up to the first unstable one, and so on
    np.testing.assert_allclose(drawn[0].y, SIZE[:5])
    np.testing.assert_allclose(drawn[1].y, SIZE[4:7])
    np.testing.assert_allclose(drawn[2].y, SIZE[6:])


def test_the_report_has_models_inputs_and_limits(tmp_path):
    html = report_html(resonance_report(response(), tmp_path))
    for part in ("Models side by side", "fold 0.9500, fold 0.8500", "roughness of both flanks"):
        assert part in html
