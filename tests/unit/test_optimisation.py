"""Optimised flanks: files and findings."""

import numpy as np
import pytest
import xarray as xr

from gearlube.report.page import report_html
from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.report.pictures import save_pictures
from gearlube.report.redrawn import redrawn
from gearlube.studies.optimise.figures import drawn_figures
from gearlube.studies.optimise.findings import decibels, findings, numbers
from gearlube.studies.optimise.report import optimise_report
from gearlube_core.errors import ParameterError
from gearlube_core.flank_optimisation.problem import Problem
from gearlube_core.flank_optimisation.problem_file import OptimisationFile
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_contact.placement import Misalignment
from tests.helpers.each import each
from tests.helpers.known_answers import assert_findings, assert_numbers, assert_tables, quantities

CROWN = {"pinion.flank.crown_um": {"low": 0.0, "high": 9.0}}
TWIST = {"pinion.drive_flank.twist_um": {"low": -9.0, "high": 9.0, "start": 0.0}}


def problem(gear="he_2007", parameters=CROWN, **more):
    data = {"name": "p", "gear": gear, "torques_n_m": [50.0], "parameters": parameters, **more}
    return Problem.of(OptimisationFile.from_data(data, "p"))


@pytest.mark.parametrize("name", OptimisationFile.shipped())
def test_the_shipped_problems_can_be_posed(name):
    found = Problem.of(OptimisationFile.named(name))
    assert (found.low <= found.start).all()
    assert (found.start <= found.high).all()
    assert found.scenarios[0].name == "none"


def test_errors_are_taken_with_both_signs_one_at_a_time():
    helical = problem(errors={"lead_slope_um": 8.0, "fields": {"gear": {"flank": {"crown_um": 2}}}})
    added = [one.added for one in helical.scenarios]
    slope, crown = "gear.flank.lead_slope_um", "gear.flank.crown_um"
    assert added == [{}, {slope: 8.0}, {slope: -8.0}, {crown: 2.0}, {crown: -2.0}]
    hypoid = problem("mohammadpour_2015", TWIST, errors={"shaft_angle_mrad": 0.5})
    moved = [one.misalignment for one in hypoid.scenarios]
    assert moved == [Misalignment(shaft_angle=angle) for angle in (0.0, 5e-4, -5e-4)]


def test_settings_of_the_pinion_are_freed_and_gear_and_blades_kept():
    found = problem("mohammadpour_2015", {}, settings={"within_mm": 0.2, "within_deg": 0.1})
    assert {name.rsplit(".", 1)[0] for name in found.names} == {"pinion.machine"}
    at = dict(zip(found.names, found.high - found.start, strict=True))
    assert at["pinion.machine.radial_setting_mm"] == pytest.approx(0.2)
    assert at["pinion.machine.tilt_angle_deg"] == pytest.approx(0.1)
    assert at["pinion.machine.ratio_of_roll"] == pytest.approx(0.02762)
    assert not any("cradle" in name for name in found.names)  # only a phase
    blades = problem("mohammadpour_2015", {}, settings={"blades": True})
    cutter = {name for name in blades.names if ".cutter." in name}
    # the concave pinion flank drives
    assert "pinion.cutter.concave_flank_blade_angle_deg" in cutter
    assert "pinion.cutter.convex_flank_blade_angle_deg" not in cutter


def test_amounts_that_a_gear_file_does_not_take_are_tried_but_not_written():
    found = problem("mohammadpour_2015", TWIST)
    tried = found.tried(np.array([0.2]), found.scenarios[0])
    assert tried.correction("pinion", "drive").twist == pytest.approx(0.2e-6, rel=1e-12, abs=0.0)
    assert found.rounded(np.array([0.2])).tolist() == [0.0]
    assert found.rounded(np.array([-3.123456789])).tolist() == [-3.12346]


@each(
    ("gear", "more", "said"),
    [
        ("he_2007", {"torques_n_m": [5.0, 5.0]}, "torques_n_m must rise"),
        ("he_2007", {"orders": [5]}, "positions must be at least 11 for order 5, got 8"),
        ("he_2007", {"orders": [1, 1]}, "each order once"),
        ("he_2007", {"parameters": {}}, r"\[parameters\] must name a field"),
        ("he_2007", {"parameters": {"x.y": {"low": 1.0, "high": 0.0}}}, "low must be below high"),
        (
            "he_2007",
            {"parameters": {"x.y": {"low": 1.0, "high": 2.0, "start": 3.0}}},
            "start must lie within low and high, 1 to 2, got 3",
        ),
        (
            "he_2007",
            {"parameters": {"pinion.flank.crwn_um": {"low": 0.0, "high": 1.0}}},
            "Is it pinion.flank.crown_um?",
        ),
        (
            "he_2007",
            {"parameters": {"pinion.tip_diameter_mm": {"low": 80.0, "high": 90.0}}},
            "The blank cannot change",
        ),
        (
            "he_2007",
            {"parameters": {"pinion.flank.tip_relief_depth_mm": {"low": 1.0, "high": 2.0}}},
            "must have a start",
        ),
        (
            "he_2007",
            {"parameters": {"pinion.flank.crown_um": {"low": 2.0, "high": 3.0}}},
            "within low and high, 2 to 3, got 0",
        ),
        ("he_2007", {"errors": {"pinion_axial_um": 5.0}}, "is not for a helical pair"),
        ("he_2007", {"settings": {}}, "is only for a hypoid pair"),
        (
            "mohammadpour_2015",
            {"parameters": TWIST, "errors": {"lead_slope_um": 5.0}},
            "is not for a hypoid pair",
        ),
        (
            "mohammadpour_2015",
            {"parameters": {"pinion.coast_flank.twist_um": {"low": 1.0, "high": 2.0}}},
            "flanks without load",
        ),
        (
            "mohammadpour_2015",
            {
                "parameters": {
                    "pinion.drive_flank.tip_relief_um": {"low": 1, "high": 90, "start": 9},
                    "pinion.drive_flank.tip_relief_depth_mm": {"low": 0.5, "high": 2, "start": 1},
                }
            },
            "at most 10 % of tip_relief_depth_mm",
        ),
        ("no_such_pair", {}, "Or give a path"),
        ("missing.toml", {}, "gear file missing.toml was not found in"),
    ],
)
def test_wrong_problems_are_refused_with_a_sentence(gear, more, said):
    data = {"name": "p", "gear": gear, "torques_n_m": [50.0], "parameters": CROWN}
    with pytest.raises(ParameterError, match=said):
        Problem.of(OptimisationFile.from_data({**data, **more}, "p"))


# what, unit, before, after, limit: the pressure just at its limit, the loss within, the last worse
MEASURES = [
    ("mesh order 1", "urad", 20.0, 2.0, np.nan),
    ("highest pressure", "GPa", 1.0, 0.999, 1.0),
    ("sliding loss over friction coefficient", "1", 0.5, 0.4, 1.0),
    ("largest share of load in the border", "1", 0.10, 0.12, np.nan),
]


def optimised(measures=MEASURES, after=(2.0, 10.0), value=3.0, improved=1):
    """Two torques; all orders fall from 20 and 24 µrad to `after`; one field from 0 to 12 µm.

    At the higher torque all measures are 1.5 times as large.
    """
    whine = 1e-6 * np.array([[[20.0, 25.0], [24.0, 30.0]], [[after[0], 5.0], [after[1], 12.0]]])
    phase = np.arange(8) / 8
    error = 1e-5 * np.cos(2.0 * np.pi * phase) * np.ones((2, 2, 2, 1))
    torque, name, unit, before, later, limit = zip(
        *(
            (at, *row[:2], more * row[2], more * row[3], row[4])
            for at, more in ((50.0, 1.0), (100.0, 1.5))
            for row in measures
        ),
        strict=True,
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


def test_a_limit_that_is_passed_is_a_warning_and_slack_ones_are_good():
    passed = [(*MEASURES[1][:3], 1.1, 1.0), *MEASURES[2:]]
    broken = findings(optimised(passed))[1:3]
    said = [
        (WARNING, "the limit of highest pressure is not kept … allowed",
         "50 N·m, 1.10 GPa, 1.00 GPa"),
        (WARNING, "the limit of highest pressure is not kept … allowed",
         "100 N·m, 1.65 GPa, 1.50 GPa"),
    ]  # fmt: skip
    assert_findings(broken, said)
    slack = findings(optimised([(*MEASURES[1][:3], 0.9, 1.0)]))[1:3]
    assert_findings(
        slack, [(GOOD, "kept, none is active", "2"), (GOOD, "No measure got worse", "")]
    )
    assert findings(optimised(after=(2.0, 25.0)))[0].level == WARNING


def test_fields_on_their_bounds_a_search_without_success_and_the_nominal_pair_are_told():
    found = findings(optimised(value=12.0, improved=0))[3:]
    said = [
        (NOTE, "is at its bound: pinion.flank.crown_um", "1, 1, 12.0 µm"),
        (WARNING, "found nothing better", ""),
    ]
    assert_findings(found, said)
    pair = optimised()
    nominal = pair.sel(design="better").assign_coords(design="nominal")
    nominal["whine"] = 0.5 * nominal["whine"] + 7e-6 * (nominal["error"] != "none")
    three = xr.concat(
        [pair, nominal], "design", data_vars="different", coords="different", compat="equals"
    )
    # halves: 1 and 5 µrad without errors, 9.5 and 13 with
    said = (NOTE, "best without errors has … the better pair",
            "13.0 µrad, 12.0 µrad, −26.0 dB, 50 N·m, −13.6 dB, 100 N·m")  # fmt: skip
    assert_findings(findings(three)[-1:], [said])


def test_an_optimisation_has_its_known_key_numbers_findings_and_tables(tmp_path):
    assert list(decibels(optimised())) == [50.0, 100.0]
    known = [
        ("change of all mesh orders at 50 N·m", -20.0, "dB", "−20.0"),  # a tenth
        ("change of all mesh orders at 100 N·m", 20.0 * np.log10(10.0 / 24.0), "dB", "−7.60"),
        ("largest mesh orders before", 24.0, "µrad", "24.0"),
        ("largest mesh orders after", 10.0, "µrad", "10.0"),
        ("highest pressure before", 1.5, "GPa", "1.50"),
        ("highest pressure after", 1.5 * 0.999, "GPa", "1.50"),
        ("limits not kept", 0.0, "", "0"),
    ]
    assert_numbers(numbers(optimised()), known)
    # with the error 25 to 5 is -13.98 dB, 30 to 12 is -7.96 dB
    said = [
        (GOOD, "Without errors all mesh orders together change by … with the worst of … lead slope",
         "−20.0 dB, 50 N·m, −7.6 dB, 100 N·m, 1, −14.0 dB, 50 N·m, −8.0 dB, 100 N·m, 20.0, "
         "2.00 µrad, 50 N·m, 24.0, 10.0 µrad, 100 N·m, +5 µm"),
        (NOTE, "limits are active: highest pressure at 50 N·m; highest pressure",
         "2, 4, 50 N·m, 100 N·m"),
        (NOTE, "got worse … border", "2, 8, 50 N·m, 0.120, +20.0 %, 100 N·m, 0.180, +20.0 %"),
    ]  # fmt: skip
    assert_findings(findings(optimised()), said)
    better = optimised().assign(
        front_whine=("front", [0.6, 0.8]),
        front_loss=("front", [0.95, 0.9]),
        front_value=(("front", "parameter"), [[7.0], [5.0]]),
    )
    save_pictures(drawn_figures(better), tmp_path, better)
    report = optimise_report(better, tmp_path)
    assert [one.chart is None for one in report.figures] == [False] * 4
    drawn = {name: redrawn(one.draw(better)).data for name, one in drawn_figures(better).items()}
    charts = {name: [list(line.y) for line in lines] for name, lines in drawn.items()}
    np.testing.assert_allclose(charts["mesh_orders"], [[20.0], [2.0], [24.0], [10.0]])
    shape = 10.0 * np.cos(2.0 * np.pi * np.arange(17) / 8)  # with the error alike
    np.testing.assert_allclose(charts["transmission_error"], np.tile(shape, (8, 1)), atol=1e-5)
    spread = [[20.0, 25.0], [2.0, 5.0], [24.0, 30.0], [10.0, 12.0]]
    np.testing.assert_allclose([one.x for one in drawn["errors"]], spread)
    np.testing.assert_allclose(np.ravel(charts["front"][0]), [0.95, 0.9])
    assert quantities(report.subtitle) == ["1", "50", "100 N·m", "1", "8"]
    texts = {  # after 1.5 times: GPa, and the share of the border
        50: (("20", "2"), ("1", "0.999"), ("0.5", "0.4"), ("0.1", "0.12")),
        100: (("30", "3"), ("1.5", "1.498"), ("0.75", "0.6"), ("0.15", "0.18")),
    }
    changes = ("-20.0 dB", "-0.1 %", "-20.0 %", "+20.0 %")
    tables = {
        "Fields of the gear file": [
            ["field", "before", "after", "low", "high", "unit"],
            ["pinion.flank.crown_um", "1", "3", "0", "12", "µm"],
        ],
        "All measures before and after": [
            ["torque [N·m]", "measure", "unit", "before", "after", "change", "limit"],
            *([f"{torque}", row[0], {"urad": "µrad", "1": ""}.get(row[1], row[1]), *pair, change,
               "" if np.isnan(row[4]) else "kept"]
              for torque, pairs in texts.items()
              for row, pair, change in zip(MEASURES, pairs, changes, strict=True)),
        ],
        "With errors and without": [
            ["torque [N·m]", "error", "before [µrad]", "after [µrad]"],
            ["50", "none", 20.0, 2.0],
            ["50", "lead_slope +5 um", 25.0, 5.0],
            ["100", "none", 24.0, 10.0],
            ["100", "lead_slope +5 um", 30.0, 12.0],
        ],
        "Mesh orders against loss": [
            ["mesh orders", "sliding loss", "pinion.flank.crown_um"],
            [0.6, 0.95, 7.0],
            [0.8, 0.9, 5.0],
        ],
    }  # fmt: skip
    assert_tables(report.tables, tables)
    assert [one.folded for one in report.tables] == [False, True, True, True]
    assert "−20.0 dB" in report_html(report)
    undercut = optimised().assign_attrs(remarks="The pinion is undercut. Look.")
    assert optimise_report(undercut, tmp_path).findings[-1].headline == "The pinion is undercut."
