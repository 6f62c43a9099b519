"""Findings of measured flanks and of errors of single teeth, from datasets with known answers."""

import numpy as np
import pytest
import xarray as xr

from gearlube.report.page import report_html
from gearlube.report.parts import GOOD, NOTE, WARNING
from gearlube.studies.measured.findings import (
    flank_findings,
    flank_numbers,
    largest_sideband,
    tooth_findings,
    tooth_numbers,
)
from gearlube.studies.measured.report import flank_report, tooth_report
from tests.helpers.contact_cases import shipped_file
from tests.helpers.known_answers import assert_findings, assert_numbers, assert_tables

TEETH, GEAR_TEETH, PHASES = 5, 3, 4


def flanks(rest=0.3e-6, fitted=False, uncertainty=0.01, single=0):
    """One flank, 6 µm less at one corner of three rows and two columns, a row without data."""
    deviation = np.array([[0.0, 2e-6], [1e-6, -6e-6], [np.nan, np.nan]])
    places = np.where(np.isfinite(deviation), 0.5, np.nan)
    data = {
        "deviation": (("flank", "row", "column"), deviation[None]),
        "s": (("flank", "row", "column"), (places * np.array([[0.4], [1.6], [1.0]]))[None]),
        "t": (("flank", "row", "column"), (places * np.array([0.2, 1.8]))[None]),
        "teeth": (("flank",), [4]),
        "rest_rms": (("flank",), [rest]),
        "scatter_rms": (("flank",), [0.5e-6]),
    }
    if fitted:
        data |= {
            "setting_nominal": (("setting",), [15.0]),
            "setting_change": (("setting",), [0.05]),
            "setting_uncertainty": (("setting",), [uncertainty]),
            "setting_corrective": (("setting",), [14.95]),
            "setting_unit": (("setting",), ["deg"]),
            "fit_before": (("setting",), [5e-6]),
            "fit_after": (("setting",), [0.4e-6]),
            "setting": (("setting",), ["pinion.machine.tilt_angle_deg"]),
        }
    return xr.Dataset(
        data,
        coords={"flank": ["gear drive"]},
        attrs={
            "name": "mine",
            "source": "made",
            "degree": 3,
            "single_teeth": single,
            "gear_file": shipped_file().model_dump_json(exclude_none=True),
        },
    )


def teeth():
    """Once a turn 8 µm; beside the mesh order of five teeth, order 6 has 0.5 µm at 100 N·m."""
    amplitude = 1e-9 * np.array([np.arange(10.0, 0.0, -1.0)] * 2)
    amplitude[:, 0], amplitude[:, 4], amplitude[:, 5] = 8e-6, 3e-6, [0.2e-6, 0.5e-6]
    return xr.Dataset(
        {
            "error": (("torque", "mesh", "phase"), np.zeros((2, TEETH * GEAR_TEETH, PHASES))),
            "rest_rms": (("torque",), [0.01e-6, 0.02e-6]),
            "pinion_amplitude": (("torque", "pinion_order"), amplitude),
            "hunting_amplitude": (("torque", "hunting_order"), [[0.0123e-6], [0.0456e-6]]),
        },
        coords={
            "torque": [50.0, 100.0],
            "pinion_order": np.arange(1, 11),
            "hunting_order": [1.0 + TEETH / GEAR_TEETH],
        },
        attrs={"name": "mine", "pinion_teeth": TEETH, "gear_teeth": GEAR_TEETH},
    )


def test_measured_flanks_have_their_known_key_numbers_findings_and_tables(tmp_path):
    known = [
        ("largest deviation, gear drive", 6.0, "µm", "6.00"),
        ("rest of the smooth surface, at most", 0.3, "µm rms", "0.300"),
        ("teeth from their mean, at most", 0.5, "µm rms", "0.500"),
    ]
    assert_numbers(flank_numbers(flanks()), known)
    said = [
        (GOOD, "up to … from nominal, on gear drive; a smooth surface of degree … leaves at most",
         "6.00 µm, 3, 0.30 µm rms, 0.50 µm rms"),
        (NOTE, "explain the deviations from … pinion tilt angle … ±",
         "5.00 µm rms, 0.40 µm, 0.0500, 0.010 °"),
        (NOTE, "not in the gear file … --table", ""),
    ]  # fmt: skip
    assert_findings(flank_findings(flanks(fitted=True, single=1)), said)
    (tmp_path / "flanks.png").write_bytes(b"a picture")
    tables = {
        "Settings that explain the deviations": [
            ["setting", "unit", "nominal", "change", "uncertainty", "corrective"],
            ["pinion.machine.tilt_angle_deg", "deg", "15", "0.05", "0.01", "14.95"],
        ],
        "Measured flanks": [
            ["flank", "teeth", "least deviation [µm]", "largest deviation [µm]", "rest [µm rms]",
             "apart [µm rms]"],
            ["gear drive", 4, -6.0, 2.0, 0.3, 0.5],
        ],
    }  # fmt: skip
    report = flank_report(flanks(fitted=True), tmp_path / "flanks.png")
    assert_tables(report.tables, tables)
    assert "Deviation of the gear drive flank" in report_html(report)


def test_a_surface_that_leaves_as_much_as_a_mesh_order_is_a_warning():
    found = flank_findings(flanks(rest=1.2e-6))[0]
    said = (WARNING, "gear drive … On gear drive the rest is as large as a mesh order",
            "6.00 µm, 3, 1.2 µm rms, 0.50 µm rms")  # fmt: skip
    assert_findings([found], [said])


def test_a_fitted_setting_within_three_times_its_uncertainty_is_doubted():
    sure = flank_findings(flanks(fitted=True, uncertainty=0.0166))[1]
    doubted = flank_findings(flanks(fitted=True, uncertainty=0.0167))[1]
    assert [sure.level, doubted.level] == [NOTE, WARNING]
    assert "Not significantly different from zero: pinion: tilt angle" in doubted.detail


def test_the_largest_sideband_is_found_beside_the_mesh_order_and_not_on_it():
    # order 1 and the mesh order 5 are larger, but no sidebands
    assert largest_sideband(teeth(), "pinion") == (6, pytest.approx(0.5e-6), 100.0)
    said = [
        (NOTE, "largest order of the pinion", "1, 8.00 µm, 50 N·m, 1, 5"),
        (NOTE, "largest sideband of the pinion beside its mesh order",
         "5, 6, 0.500 µm, 100 N·m"),
        (NOTE, "hunting turn", "0.020 µm rms"),
    ]  # fmt: skip
    assert_findings(tooth_findings(teeth()), said)
    known = [
        ("once a turn of the pinion, at most", 8.0, "µm", "8.00"),
        ("largest sideband of the pinion", 0.5, "µm", "0.500"),
        ("hunting turn alone", 0.02, "µm rms", "0.0200"),
    ]
    assert_numbers(tooth_numbers(teeth()), known)


def test_the_report_of_single_teeth_has_its_known_tables(tmp_path):
    picture = tmp_path / "tooth_errors.png"
    picture.write_bytes(b"a picture")
    report = tooth_report(teeth(), picture)
    order = 1.0 + TEETH / GEAR_TEETH  # 2.667 of the pinion, 1.6 of the gear
    rows = {1: (8.0, 8.0), 5: (3.0, 3.0), 6: (0.2, 0.5)}
    rows |= {one: 2 * (1e-3 * (11 - one),) for one in (2, 3, 4, 7, 8, 9, 10)}
    tables = {
        "Largest orders of the pinion": [
            ["order", "50 N·m [µm]", "100 N·m [µm]"],
            *([order, *sizes] for order, sizes in rows.items()),
        ],
        "Orders of the hunting turn alone": [
            ["order of the pinion", "order of the gear", "50 N·m [µm]", "100 N·m [µm]"],
            ["2.6667", "1.6000", 0.0123, 0.0456],
        ],
    }
    assert order == teeth()["hunting_order"]
    assert_tables(report.tables, tables)
    assert "Added error over a turn" in report_html(report)
    whole = teeth().isel(hunting_order=slice(0, 0))
    titles = [one.title for one in tooth_report(whole, picture).tables]
    assert titles == ["Largest orders of the pinion"]
