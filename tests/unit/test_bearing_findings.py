"""A bearing's friction: known answers of a made dataset."""

import numpy as np
import pytest
import xarray as xr

from gearlube.report.page import report_html
from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.studies.bearing.figures import _panel_grid
from gearlube.studies.bearing.report import bearing_report, findings, numbers
from tests.helpers.known_answers import assert_findings, assert_numbers, assert_tables

RPM = 30.0 / np.pi


@pytest.fixture
def a_bearing():
    dims = ("law", "speed", "axial_load", "radial_load", "temperature")
    torque = np.array([[[2.0, 1.0], [4.0, 2.0]], [[0.8, 0.4], [1.6, 0.8]]]).reshape(2, 2, 1, 1, 2)
    speed = np.array([100.0, 200.0])
    power = torque * speed[None, :, None, None, None]
    parts = np.stack([0.75 * torque, 0.25 * torque, 0.0025 * torque])  # too little to tell
    ones = np.ones(torque.shape)
    return xr.Dataset(
        {
            "torque": (dims, torque),
            "power": (dims, power),
            "factor": (dims, np.array([2.5, 1.5]).reshape(2, 1, 1, 1, 1) * ones),
            "film_ratio": (dims, 3.0 * ones),
            "out_of_range": (dims, 0.0 * ones),
            "torque_low": (dims, 0.5 * torque),
            "torque_high": (dims, 2.0 * torque),
            "part_torque": (("part", *dims), parts),
        },
        coords={
            "law": ["zhou_hoeprich", "palmgren"],
            "speed": speed,
            "axial_load": [5000.0],
            "radial_load": [0.0],
            "temperature": [313.15, 353.15],
            "part": ["rolling", "rib", "cage"],
        },
        attrs={
            "name": "made",
            "source": "",
            "oil": "an_oil",
            "inlet_layer_m": 0.0,
            "temperature_rise_k": 0.0,
        },
    )


LARGEST = (NOTE, "loses at most … Zhou and Hoeprich … rolling 75 %, rib 25 %",
           "800 W, 4.00 N·m, 1910 rpm, 5000 N, 0 N, 40 °C, 75 %, 25 %")  # fmt: skip
ERRORS = [
    (NOTE, "within a factor of … palmgren … not calibrated", "1.5, 2"),
    (NOTE, "within a factor of … zhou_hoeprich … not calibrated", "2.5, 2"),
]


@pytest.mark.slow
def test_bearing_has_its_known_key_numbers_findings_and_table(a_bearing):
    # means over 2, 1, 4 and 2 N.m and over 0.4 times these
    expected = [
        ("largest torque", 4.0, "N·m", "4.00"),
        ("largest power loss", 4.0 * 200.0, "W", "800"),
        ("error bar, factor (k = 2)", 2.5, "", "2.5"),
        ("mean torque", 9.0 / 4.0, "N·m", "2.25"),
        ("least film ratio of the raceways", 3.0, "", "3.0"),
        ("largest over least law, mean", 2.5, "", "2.5"),
    ]
    assert_numbers(numbers(a_bearing), expected)
    said = [
        LARGEST,
        (NOTE, "laws differ … Palmgren has the least … Zhou and Hoeprich the largest",
         "2.5, 0.900 N·m, 2.25 N·m"),
        *ERRORS,
        (NOTE, "Warming the oil … lowers the mean torque", "40, 80 °C, 50 %"),
        (GOOD, "All laws are within their range", ""),
    ]  # fmt: skip
    assert_findings(findings(a_bearing), said)
    report = bearing_report(a_bearing)
    heads = ["speed [rpm]", "axial load [N]", "radial load [N]", "oil [°C]"]
    conditions = [(100.0, 40.0, 2.0), (100.0, 80.0, 1.0), (200.0, 40.0, 4.0), (200.0, 80.0, 2.0)]
    table = [
        [*heads, "rolling [N·m]", "rib [N·m]", "cage [N·m]", "torque [N·m]", "power loss [W]"],
        *(
            [v * RPM, 5000.0, 0.0, degc, 0.75 * m, 0.25 * m, 0.0025 * m, m, m * v]
            for v, degc, m in conditions
        ),
    ]
    assert_tables(report.tables, {"Torque by Zhou and Hoeprich": table})
    assert "flooded" in report_html(report)


def test_bearing_warns_of_thin_films_and_of_laws_outside_their_range(a_bearing):
    a_bearing["film_ratio"][0, 0] = 0.4
    a_bearing["out_of_range"][0, 1] = 0.25
    said = findings(a_bearing)[-2:]
    left, thin = (one.headline + one.detail for one in said)
    assert [one.level for one in said] == [WARNING, WARNING]
    assert "from 1910 rpm on, up to 25 % of them" in left
    assert "falls to 0.4 of the roughness (oil up to 80 degC)" in thin
    solved = a_bearing.assign_coords(law=["solved_films", "palmgren"])
    solved.attrs |= {"film_model_roller": "mine", "calibrated": 1}
    films, *_ = (one for one in findings(solved) if "Model: mine" in one.detail)
    assert_findings([films], [(NOTE, "model of solved films", "25 %")])
    assert "calibrated with a measured torque" in findings(solved)[0].detail


def test_panels_of_a_figure_have_the_same_axes():
    _, panels = _panel_grid(3)
    panels[0].set(xlim=(1.0, 2.0), ylim=(3.0, 4.0))
    assert [(one.get_xlim(), one.get_ylim()) for one in panels] == 3 * [((1.0, 2.0), (3.0, 4.0))]
