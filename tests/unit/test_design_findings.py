"""Findings, key numbers and report of a design, from a dataset with known answers."""

import json

import numpy as np
import pytest
import xarray as xr

from gearlube.report.page import report_html
from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.studies.design.findings import findings, missed_targets, numbers
from gearlube.studies.design.run import design_report

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
        "found_path_angle": np.radians([24.5, 148.0]),
        "asked_length": [0.010, 0.010],
        "found_length": [0.0104, 0.010],
        "relieved_error": [63e-6, np.nan],
        "missed_error": np.array([49.0 / 50.0, coast / 80e-6]) - 1.0,
        "missed_path_angle": np.radians([0.5, 0.0]),
        "missed_centre": [1e-5, centre],
        "missed_length": [0.04, 0.0],
        "path_contact_ratio": [1.7, ratio],
        "relief_pressure": pressure,
        **{f"{kind}_{name}": [0.5, 0.5] for kind in ("asked", "found") for name in "st"},
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


def test_what_was_asked_and_found_is_told_for_both_flanks():
    drive, coast = findings(design())[:2]
    assert (drive.level, coast.level) == (GOOD, GOOD)
    assert "transmission error 49.0 µrad (50.0 wanted)" in drive.headline
    assert "ellipse 10.4 mm (10.0 wanted), mean contact 0.010 mm off" in drive.headline
    assert "63.0 µrad" in drive.detail
    assert "no extreme" in coast.detail


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


def test_sound_teeth_say_their_least_widths_and_that_nothing_is_undercut():
    sound = told(design(), "smallest toplands")
    assert sound.level == GOOD
    assert "pinion 0.400 mm, gear 2.00 mm; no flank is undercut" in sound.headline
    assert "gear 0.900 mm" in sound.detail
    cut = told(design(undercut=0.2), "smallest toplands")
    assert "no flank" not in cut.headline


def test_a_path_shorter_than_a_pitch_is_a_warning():
    assert told(design(), "contact ratio").level == NOTE
    assert told(design(ratio=0.9), "contact ratio").level == WARNING


def test_relief_is_told_with_its_torque_and_pressure_where_that_is_known():
    relief = told(design(), "At 300 N·m")
    assert "1.50 GPa (drive) and 1.60 GPa (coast), and no edge carries." in relief.headline
    carried = told(
        design(contact=["At 300 N.m edges of the drive flanks carry: heel 3 GPa."]), "1.50"
    )
    assert (carried.level, "no edge" in carried.headline) == (NOTE, False)
    assert "drive: pinion tip 20 µm, gear tip 32 µm, ends 30 µm" in relief.detail
    unknown = findings(design(pressure=(np.nan, np.nan)))
    assert not any("300 N·m" in one.headline for one in unknown)


def test_what_was_chosen_is_told_and_the_report_has_it_all(tmp_path):
    chosen = told(design(), "1 of 2 fields were chosen")
    assert "relief.tip_relief_um 20 µm" in chosen.detail
    found = {one.name: one.value for one in numbers(design())}
    assert found["least topland, pinion"] == pytest.approx(0.4)
    html = report_html(design_report(design(undercut=0.2), tmp_path, "gearlube design"))
    for part in ("Contact: wanted and found", "below s = 0.20", "tilt_angle_deg", "working depth"):
        assert part in html
