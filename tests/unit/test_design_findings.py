"""Findings, key numbers and report of a design, from a dataset with known answers."""

import json

import numpy as np
import pytest
import xarray as xr

from gearlube.report.page import report_html
from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.studies.design.figures import transmission_error
from gearlube.studies.design.findings import findings, missed_targets, numbers
from gearlube.studies.design.run import design_report
from tests.helpers.known_answers import assert_findings, assert_numbers, assert_tables

THIN = "pinion topland is thin: 0.40 mm at the toe, below 0.3 of the normal module (2.64 mm)."
UNMET = "The transmission error of the coast flanks came to 95 urad, asked 80 urad. Relax: more."


def design(
    coast=80e-6,
    centre=1e-5,
    teeth=(),
    contact=(),
    ratio=1.5,
    undercut=np.nan,
    pressure=(1.5e9, 1.6e9),
):
    """Both sides asked 50 and 80 µrad; the coast flanks come to `coast`, `centre` [m] off."""
    phase = np.arange(40) / 40
    both = {
        "asked_error": [50e-6, 80e-6],
        "found_error": [49e-6, coast],
        "asked_path_angle": np.radians([24.0, 148.0]),
        "found_path_angle": np.radians([24.5, 147.0]),
        "asked_length": [0.010, 0.010],
        "found_length": [0.0104, 0.010],
        "relieved_error": [63e-6, np.nan],
        "missed_error": np.array([49.0 / 50.0, coast / 80e-6]) - 1.0,
        "missed_path_angle": np.radians([0.5, -1.0]),
        "missed_centre": [1e-5, centre],
        "missed_length": [0.04, 0.0],
        "path_contact_ratio": [1.7, ratio],
        "relief_pressure": pressure,
        "asked_s": [0.50, 0.51],
        "found_s": [0.52, 0.53],
        "asked_t": [0.54, 0.55],
        "found_t": [0.56, 0.57],
    }
    data = {name: (("side",), np.asarray(values)) for name, values in both.items()}
    data["error"] = (("side", "mesh_phase"), np.tile(5e-5 * phase, (2, 1)))
    data["path_error"] = (("side", "path_phase"), np.tile(5e-5 * phase, (2, 1)))
    data["topland"] = (("member", "face"), 1e-3 * np.array([[0.4, 1.4], [2.0, 2.7]]))
    data["slot"] = (("member", "face"), 1e-3 * np.array([[1.9, 2.5], [0.9, 1.4]]))
    data["undercut"] = (("member", "side"), [[undercut, np.nan], [np.nan, np.nan]])
    data["relief"] = (("side", "edge"), 1e-6 * np.array([[20.0, 32.0, 30.0], [20.0, 25.0, 38.0]]))
    data["active"] = (("member",), [0.11, 0.12])
    said = {"blank": [], "contact": list(contact), "pair": [], "teeth": list(teeth)}
    inputs = [
        ["pair.offset_mm", "15", "mm", "given", ""],
        ["relief.tip_relief_um", "20", "um", "assumed", "this package's choice"],
    ]
    return xr.Dataset(
        data,
        coords={
            "side": ["drive", "coast"],
            "member": ["pinion", "gear"],
            "edge": ["pinion tip", "gear tip", "ends"],
            "face": [0.0, 1.0],
            "mesh_phase": phase,
            "path_phase": 4.0 * phase - 2.0,
        },
        attrs={
            "name": "mine",
            "method": 1,
            "cut": "form-cut",
            "relief_torque": 300.0,
            "warnings": json.dumps(said),
            "inputs": json.dumps(inputs),
            "blank": json.dumps([["working depth", "5.28", "mm", "inferred", ""]]),
            "settings": json.dumps([["pinion.machine.tilt_angle_deg", "20.2", "chosen"]]),
        },
    )


def told(dataset, part):
    return next(one for one in findings(dataset) if part in one.headline)


def test_a_design_has_its_known_key_numbers_findings_and_tables(tmp_path):
    made = design(coast=78e-6, undercut=0.2)
    known = [
        ("transmission error as cut, drive", 49.0, "µrad", "49.0"),
        ("contact ellipse, drive", 10.4, "mm", "10.4"),
        ("path of contact, drive", 1.7, "pitches", "1.70"),
        ("highest pressure, drive", 1.5, "GPa", "1.50"),
        ("transmission error as cut, coast", 78.0, "µrad", "78.0"),
        ("contact ellipse, coast", 10.0, "mm", "10.0"),
        ("path of contact, coast", 1.5, "pitches", "1.50"),
        ("highest pressure, coast", 1.6, "GPa", "1.60"),
        ("least topland, pinion", 0.4, "mm", "0.400"),
        ("least slot at the root, pinion", 1.9, "mm", "1.90"),
        ("least topland, gear", 2.0, "mm", "2.00"),
        ("least slot at the root, gear", 0.9, "mm", "0.900"),
    ]
    assert_numbers(numbers(made), known)
    said = [
        (GOOD, "With relief … (drive) and not parabolic (coast) … no edge carries … coast: pinion",
         "63.0 µrad, 300 N·m, 1.50 GPa, 1.60 GPa, 20 µm, 32 µm, 30 µm, 20 µm, 25 µm, 38 µm"),
        (GOOD, "Drive flanks as cut, before relief, as wanted: transmission error … ellipse … mean",
         "49.0 µrad, 50.0, 24.5 °, 24.0, 10.4 mm, 10.0, 0.010 mm"),
        (GOOD, "Coast flanks as cut, before relief, as wanted: transmission error … path at",
         "78.0 µrad, 80.0, 147 °, 148, 10.0 mm, 10.0, 0.010 mm"),
        (GOOD, "toplands are pinion … gear … Blade points … pinion … gear",
         "0.400 mm, 2.00 mm, 1.90 mm, 0.900 mm"),
        (NOTE, "contact ratio is … drive flanks … coast flanks", "1.70, 1.50, 1"),
        (NOTE, "fields were chosen, not given … table of inputs", "1, 2"),
    ]  # fmt: skip
    assert_findings(findings(made), said)
    contact = {
        "drive": (("50", "49"), ("24", "24.5"), ("10", "10.4"), ("0.5", "0.52"), ("0.54", "0.56"),
                  ("", "0.01"), ("", "63"), ("", "1.7")),
        "coast": (("80", "78"), ("148", "147"), ("10", "10"), ("0.51", "0.53"), ("0.55", "0.57"),
                  ("", "0.01"), ("", "none"), ("", "1.5")),
    }  # fmt: skip
    what = (("transmission error", "µrad"), ("path direction", "°"), ("ellipse length", "mm"),
            ("mean contact, s", ""), ("mean contact, t", ""), ("mean contact off by", "mm"),
            ("transmission error with relief", "µrad"), ("path of contact", "pitches"))  # fmt: skip
    widths = {
        "pinion": ("0.40 to 1.40 mm", "1.90 to 2.50 mm", "1.90 mm", "below s = 0.20", "0.11"),
        "gear": ("2.00 to 2.70 mm", "0.90 to 1.40 mm", "0.90 mm", "none", "0.12"),
    }
    tables = {
        "Contact: wanted and found": [
            ["flanks", "", "asked", "found", "unit"],
            *([side, words, *pair, unit]
              for side, pairs in contact.items()
              for (words, unit), pair in zip(what, pairs, strict=True)),
        ],
        "Teeth": [
            ["member", "", "value"],
            *([member, words, value]
              for member, (top, slot, point, cut, reach) in widths.items()
              for words, value in (
                ("topland, toe to heel", top), ("slot at the root, toe to heel", slot),
                ("blade points at most", point), ("undercut of the drive flank", cut),
                ("undercut of the coast flank", "none"), ("reach of the mate's tip, s", reach))),
        ],
        "Blank": [["what", "value", "unit"], ["working depth", "5.28", "mm"]],
        "Machine settings and cutters": [
            ["field", "value", "origin"], ["pinion.machine.tilt_angle_deg", "20.2", "chosen"]
        ],
    }  # fmt: skip
    report = design_report(made, tmp_path)
    assert_tables(report.tables, tables)
    assert "working depth" in report_html(report)


@pytest.mark.parametrize(
    ("changes", "missed"),
    # 15 % of error and 0.5 mm of place are what the coast flanks may miss
    [({"coast": 95e-6}, "transmission error"), ({"centre": 6e-4}, "mean contact")],
)
def test_a_side_that_misses_a_target_is_a_warning_that_names_it(changes, missed):
    dataset = design(**changes)
    assert missed_targets(dataset.sel(side="coast"), "coast") == [missed]
    assert missed_targets(dataset.sel(side="drive"), "drive") == []
    warning = told(dataset, "Coast flanks")
    assert warning.level == WARNING
    assert f"missed: {missed}" in warning.headline


def test_a_side_without_a_parabolic_error_is_a_warning():
    warning = told(design(coast=np.nan), "no parabolic")
    assert warning.level == WARNING


def test_warnings_on_contact_and_teeth_have_their_cure_behind_the_headline():
    dataset = design(teeth=[THIN], contact=[UNMET])
    relax = told(dataset, "came to 95 µrad, asked 80 µrad.")
    assert (relax.level, relax.detail) == (WARNING, "Relax: more.")
    thin = told(dataset, "Pinion topland is thin: 0.40 mm")
    assert thin.level == WARNING
    assert told(dataset, "smallest toplands").level == NOTE


def test_teeth_without_undercut_say_so():
    assert "; no flank is undercut" in told(design(), "smallest toplands").headline


def test_a_path_shorter_than_a_pitch_is_a_warning():
    assert told(design(), "contact ratio").level == NOTE
    assert told(design(ratio=0.9), "contact ratio").level == WARNING


def test_relief_is_told_with_its_torque_and_pressure_where_that_is_known():
    carried = told(
        design(contact=["At 300 N.m edges of the drive flanks carry: heel 3 GPa."]), "1.50"
    )
    assert (carried.level, "no edge" in carried.headline) == (NOTE, False)
    unknown = findings(design(pressure=(np.nan, np.nan)))
    assert not any("300 N·m" in one.headline for one in unknown)


def test_the_figure_of_the_error_shows_microradians_over_two_periods():
    """The error rises from 0 to 48.75 of 50 µrad; of the coast flanks its largest is drawn as 0.

    The titles have the errors of the findings, between the phases that are drawn.
    """
    rise = 50.0 * np.arange(40) / 40
    axes = transmission_error(design()).axes
    for ax, zero, found in zip(axes, (0.0, 48.75), (49, 80), strict=True):
        *singles, whole = ax.lines
        for shift, line in zip((-1, 0, 1, 2), singles, strict=True):
            np.testing.assert_allclose(line.get_ydata(), rise - zero, atol=1e-9)
            np.testing.assert_allclose(line.get_xdata(), rise / 12.5 - 2.0 + shift, atol=1e-12)
        np.testing.assert_allclose(whole.get_ydata(), np.tile(rise - zero, 2), atol=1e-9)
        np.testing.assert_allclose(whole.get_xdata(), np.arange(80) / 40)
        assert ax.get_title().endswith(f": {found} µrad")
        middle = 48.75 / 2.0 - zero
        np.testing.assert_allclose(ax.get_ylim(), (middle - 43.875, middle + 43.875))
