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
    amplitude = np.zeros((2, 10))
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


def test_the_largest_deviation_is_told_with_its_sign_and_what_the_surface_leaves():
    (found,) = flank_findings(flanks())
    # rms of 0, 2, 1 and -6 um is sqrt(41 / 4) = 3.20 um
    assert found.level == GOOD
    assert "Gear drive deviates by at most −6.00 µm, 3.20 µm rms" in found.headline
    assert "degree 3 leaves 0.30 µm rms" in found.headline
    assert "4 teeth, which are 0.50 µm rms" in found.detail
    numbers = {one.name: one.value for one in flank_numbers(flanks())}
    assert numbers["largest deviation, gear drive"] == pytest.approx(6.0)


def test_a_surface_that_leaves_as_much_as_a_mesh_order_is_a_warning():
    assert flank_findings(flanks(rest=1.2e-6))[0].level == WARNING


@pytest.mark.parametrize(("uncertainty", "level"), [(0.01, NOTE), (0.03, WARNING)])
def test_a_fitted_setting_is_told_and_doubted_within_three_times_its_uncertainty(
    uncertainty, level
):
    told = flank_findings(flanks(fitted=True, uncertainty=uncertainty))[1]
    assert told.level == level
    assert "from 5.00 µm rms down to 0.40 µm: pinion tilt angle 0.0500 ±" in told.headline


def test_errors_of_single_teeth_that_the_gear_file_lacks_are_told():
    assert "--table" in flank_findings(flanks(single=1))[-1].detail


def test_the_largest_sideband_is_found_beside_the_mesh_order_and_not_on_it():
    # order 1 and the mesh order 5 are larger, but no sidebands
    assert largest_sideband(teeth(), "pinion") == (6, pytest.approx(0.5e-6), 100.0)
    largest, sideband, hunting = tooth_findings(teeth())
    assert "largest order of the pinion is 1: 8.00 µm" in largest.headline
    assert "mesh order 5 is order 6: 0.500 µm at 100 N·m" in sideband.headline
    assert "0.020 µm rms" in hunting.headline
    numbers = {one.name: one.value for one in tooth_numbers(teeth())}
    assert numbers["once a turn of the pinion, at most"] == pytest.approx(8.0)


def test_both_reports_have_figures_and_tables(tmp_path):
    (tmp_path / "flanks.png").write_bytes(b"a picture")
    html = report_html(flank_report(flanks(fitted=True), tmp_path / "flanks.png"))
    for part in ("Deviation of the gear drive flank", "Settings that explain", "14.95"):
        assert part in html
    html = report_html(tooth_report(teeth()))
    for part in ("Largest orders of the pinion", "Added error over a turn of the pinion"):
        assert part in html
    hunting = [one for one in tooth_report(teeth()).tables if "hunting" in one.title]
    order = 1.0 + TEETH / GEAR_TEETH
    assert hunting[0].rows[0][:2] == [f"{order:.4f}", f"{order * GEAR_TEETH / TEETH:.4f}"]
    assert hunting[0].rows[0][2:] == pytest.approx([0.0123, 0.0456])
    whole = teeth().isel(hunting_order=slice(0, 0))
    assert not any("hunting" in one.title for one in tooth_report(whole).tables)
